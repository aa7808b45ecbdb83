//! The rows of the table.

use crate::engine::EngineBias;
use crate::groups::{
    AUTO, CLOSER, COMPARED, CONDITIONAL, DEVIATION, FACTORS, HDRP, MOMENTS, PLANES, PREFILTERED, REGIONS, SINGLE, SOFT,
    STORING, VARIANCE, WILLIAMS,
};
use crate::kind::Value;
use crate::pattern::PatternName;
use crate::values::{DepthName, Rule, Window};
use crate::{Field, Kind, PresetName};
use umbrage_depth::{Moments, SameSurface};
use umbrage_plane::Bias;
use umbrage_sample::Density;
use umbrage_shadow::williams::{DitherLaw, Guard, Lookup};
use umbrage_shadow::{OccluderFalloff, OffsetGrowth, Radius, Spread, VirtualWhen};

/// A field that is one value of the recipe.
macro_rules! plain {
    ($name:literal, $of:expr, $kind:expr, |$v:ident| $place:expr, $doc:literal, $source:literal) => {
        Field {
            name: $name,
            of: $of,
            kind: $kind,
            doc: $doc,
            source: $source,
            set: |$v, text, kind| Value::read(text, kind).map(|value| $place = value).is_some(),
            get: |$v| Some(Value::write(&$place)),
        }
    };
}

/// A field whose absence its documentation describes.
macro_rules! optional {
    ($name:literal, $of:expr, $kind:expr, |$v:ident| $place:expr, $doc:literal, $source:literal) => {
        Field {
            name: $name,
            of: $of,
            kind: $kind,
            doc: $doc,
            source: $source,
            set: |$v, text, kind| Value::read(text, kind).map(|value| $place = Some(value)).is_some(),
            get: |$v| $place.as_ref().map(Value::write),
        }
    };
}

/// A field of words, each with what it means.
macro_rules! words {
    ($name:literal, $of:expr, [$(($word:literal, $meant:expr)),+ $(,)?], |$v:ident| $place:expr, $doc:literal, $source:literal) => {
        Field {
            name: $name,
            of: $of,
            kind: Kind::Words(&[$($word),+]),
            doc: $doc,
            source: $source,
            set: |$v, text, _| {
                match text {
                    $($word => $place = $meant,)+
                    _ => return false,
                }
                true
            },
            get: |$v| {
                $(if $place == $meant {
                    return Some($word.into());
                })+
                None
            },
        }
    };
}

/// A field that sets more than one value.
macro_rules! own {
    ($name:literal, $of:expr, $kind:expr, $set:expr, $get:expr, $doc:literal, $source:literal) => {
        Field { name: $name, of: $of, kind: $kind, doc: $doc, source: $source, set: $set, get: $get }
    };
}

const COUNT: Kind = Kind::Whole(65_536);
const SHARE: Kind = Kind::UpTo(1.0);

pub const FIELDS: &[Field] = &[
    words!(
        "fine",
        AUTO,
        [("1", Some(1)), ("2", Some(2)), ("4", Some(4)), ("8", Some(8))],
        |values| values.fine,
        "samples along the side of a refined texel; 1 refines none; by default 8 in maps of at most 128 texels per side, 4 in larger ones",
        ""
    ),
    words!(
        "across",
        AUTO,
        [("1", 1), ("2", 2), ("4", 4), ("8", 8), ("16", 16)],
        |values| values.dual.across,
        "lines across a region along which edges are searched for; 1 looks up its point alone",
        ""
    ),
    words!(
        "slots",
        AUTO,
        [("2", Some(2)), ("4", Some(4)), ("8", Some(8)), ("16", Some(16)), ("32", Some(32))],
        |values| values.slots,
        "parts of a link between two samples, one of which is stored as the place where the surface changes; at most 64/`fine`, and by default 16 or that",
        ""
    ),
    own!(
        "width-term",
        AUTO,
        Kind::Number,
        |values, text, kind| f32::read(text, kind).map(|term| values.dual.width_term = f64::from(term)).is_some(),
        |values| Some((values.dual.width_term as f32).write()),
        "margin by which a sample must be passed for its width, in widths of it",
        ""
    ),
    own!(
        "slope-term",
        AUTO,
        Kind::Number,
        |values, text, kind| f32::read(text, kind).map(|term| values.dual.slope_term = f64::from(term)).is_some(),
        |values| Some((values.dual.slope_term as f32).write()),
        "margin for the gentler slope, in changes of depth over a sample",
        ""
    ),
    optional!(
        "light",
        AUTO,
        Kind::Number,
        |values| values.light,
        "radius of a disc light, world units (tangent of its angle if directional): the mean of `maps` maps",
        ""
    ),
    optional!(
        "maps",
        AUTO,
        Kind::Whole(1024),
        |values| values.maps,
        "with `light`: points of the disc, each with a map; by default 16 to 64, by the width of its penumbra",
        ""
    ),
    words!(
        "stored",
        STORING,
        [
            ("first", Rule::First),
            ("second", Rule::Second),
            ("back-face", Rule::BackFace),
            ("normals", Rule::Normals),
            ("midpoint", Rule::Midpoint),
            ("deep", Rule::Deep),
        ],
        |values| values.rule,
        "which surface of a texel is stored; `normals` are back faces by interpolated normals, `deep` all surfaces",
        ""
    ),
    plain!(
        "ratio",
        STORING,
        Kind::Ratio,
        |values| values.midpoint.ratio,
        "midpoints: the position of the depth between the first surface, 0, and the second, 1",
        "Woo 1992"
    ),
    plain!(
        "merge",
        STORING,
        Kind::Number,
        |values| values.midpoint.merge,
        "midpoints: fraction of the distance within which surfaces are one",
        "Woo 1992"
    ),
    words!(
        "same",
        STORING,
        [("depth", SameSurface::Depth), ("object", SameSurface::Object), ("surface", SameSurface::Surface)],
        |values| values.midpoint.same,
        "midpoints: which fragments are one surface; `surface` with several `sub-samples`",
        "Woo 1992"
    ),
    own!(
        "epsilon",
        STORING,
        Kind::BelowOne,
        |values, text, kind| {
            let deep = f32::read(text, kind).and_then(|epsilon| values.deep.with_epsilon(epsilon).ok());
            deep.map(|deep| values.deep = deep).is_some()
        },
        |values| Some(values.deep.epsilon().write()),
        "deep maps: bound on the error of a transmittance",
        "Burley 2006"
    ),
    optional!(
        "sub-samples",
        STORING,
        Kind::Whole(8),
        |values| values.sub_samples,
        "samples along a texel's side: deep maps average them (4, rounded down to a power of 2), others keep the nearest surfaces over them (1; not `normals`)",
        "Woo 1992"
    ),
    words!(
        "pattern",
        CLOSER,
        [
            ("jittered", PatternName::Jittered),
            ("table", PatternName::Table),
            ("uniform", PatternName::Uniform),
            ("gaussian", PatternName::Gaussian),
            ("inside", PatternName::Inside),
            ("warp", PatternName::Warp),
            ("every", PatternName::Every),
            ("tent", PatternName::Tent),
            ("centre", PatternName::Centre),
            ("disc", PatternName::Disc),
            ("castano5", PatternName::Castano5),
            ("castano7", PatternName::Castano7),
            ("area-tent", PatternName::AreaTent),
            ("vogel", PatternName::Vogel),
        ],
        |values| values.pattern,
        "where in the region the map is looked up; the last four are the kernels of engines",
        "Reeves 1987, §3"
    ),
    words!(
        "pattern",
        CONDITIONAL,
        [("every", PatternName::Every), ("tent", PatternName::Tent)],
        |values| values.pattern,
        "how the texels of the region are weighted",
        "Wang & Molnar 1994"
    ),
    plain!(
        "samples",
        CLOSER,
        COUNT,
        |values| values.jittered.num_samples,
        "number of samples of a region (`NumSamples`)",
        "Reeves 1987, Fig. 11"
    ),
    plain!(
        "min-samples",
        CLOSER,
        COUNT,
        |values| values.jittered.min_samples,
        "least number of samples along an axis (`MinSamples`), at most `samples`",
        "Reeves 1987, Fig. 11"
    ),
    plain!(
        "jitter",
        CLOSER,
        SHARE,
        |values| values.jittered.jitter,
        "fraction of its cell over which a sample is moved; 0 is a regular grid",
        "Reeves 1987, §3.1"
    ),
    plain!(
        "hard-cap",
        CLOSER,
        Kind::Switch,
        |values| values.jittered.hard_cap,
        "whether `samples` is never exceeded",
        ""
    ),
    words!(
        "compare",
        CLOSER,
        [("float", false), ("integer", true)],
        |values| values.integer_first,
        "whether whole units are compared first, which requires `pattern=jittered`, `depth=constant` and a bias of 0",
        "Woo 1992"
    ),
    plain!(
        "unit",
        CLOSER,
        Kind::Positive,
        |values| values.unit,
        "size of a whole unit for `compare=integer`, map units",
        "Woo 1992"
    ),
    own!(
        "nearby",
        CONDITIONAL,
        Kind::Words(&["four", "region", "box3", "box4", "box5", "box6", "box7", "box8", "box9"]),
        |values, text, _| nearby(text)
            .map(|(factor, size)| (values.res_factor, values.min_size) = (factor, size))
            .is_some(),
        |_| None,
        "a neighbourhood by name: sets `res-factor` and `min-size`",
        "Wang & Molnar 1994"
    ),
    plain!(
        "res-factor",
        FACTORS,
        Kind::Number,
        |values| values.res_factor,
        "size of the region, in footprints of the receiver (`ResFactor`)",
        "Reeves 1987, Fig. 11"
    ),
    plain!(
        "min-size",
        REGIONS,
        Kind::Number,
        |values| values.min_size,
        "least half-extent of the region, texels (`MinSize`)",
        "Reeves 1987, Fig. 11"
    ),
    own!(
        "bias",
        COMPARED,
        Kind::BiasRange,
        |values, text, kind| Value::read(text, kind)
            .map(|(low, high)| (values.biased.low, values.biased.high) = (low, high))
            .is_some(),
        |values| Some((values.biased.low, values.biased.high).write()),
        "moves the receiver toward the light; a range only with `depth=constant`, world units with `depth=cone`, 0 with an engine's own",
        "Reeves 1987, §3.2"
    ),
    own!(
        "bias",
        SINGLE,
        Kind::Bias,
        |values, text, kind| Bias::read(text, kind)
            .map(|bias| (values.biased.low, values.biased.high) = (bias, bias))
            .is_some(),
        |values| Some(values.biased.low.write()),
        "moves the receiver toward the light",
        ""
    ),
    words!(
        "spread",
        COMPARED,
        [("random", Spread::Random), ("ramp", Spread::Ramp)],
        |values| values.biased.spread,
        "how a tap's bias is chosen from the range, with `depth=constant`",
        "Reeves 1987, §3.2"
    ),
    words!(
        "depth",
        COMPARED,
        [
            ("constant", DepthName::Constant),
            ("plane", DepthName::Plane),
            ("cone", DepthName::Cone),
            ("slope-scaled", DepthName::SlopeScaled),
            ("normal-offset", DepthName::NormalOffset),
            ("three", DepthName::Engine(EngineBias::Three)),
            ("babylon", DepthName::Engine(EngineBias::Babylon)),
            ("babylon-pcf", DepthName::Engine(EngineBias::BabylonPcf)),
            ("filament", DepthName::Engine(EngineBias::Filament)),
            ("bevy", DepthName::Engine(EngineBias::Bevy)),
            ("godot", DepthName::Engine(EngineBias::Godot)),
            ("urp", DepthName::Engine(EngineBias::Urp)),
            ("urp-soft", DepthName::Engine(EngineBias::UrpSoft)),
            ("hdrp", DepthName::Engine(EngineBias::Hdrp)),
            ("hdrp-pcss", DepthName::Engine(EngineBias::HdrpPcss)),
        ],
        |values| values.depth,
        "which depth is compared: the receiver's own, its tangent plane's, the bias cone's, its own moved by a bias that grows with its slope, that of the \
         receiver moved along its normal, or its own moved by an engine's default bias",
        ""
    ),
    plain!(
        "slope",
        COMPARED,
        Kind::Number,
        |values| values.slope,
        "the bias cone's tangent, with `depth=cone`",
        "Burley 2006"
    ),
    words!(
        "radius",
        COMPARED,
        [("texel-centre", Radius::TexelCentre), ("nominal", Radius::Nominal)],
        |values| values.radius,
        "the place to which the bias cone measures, with `depth=cone`",
        "Burley 2006"
    ),
    plain!(
        "slope-scale",
        COMPARED,
        Kind::Number,
        |values| values.scaled.slope,
        "changes of the receiver's depth from texel to texel, a row's or a column's, that are added to `bias`, with `depth=slope-scaled`",
        "Direct3D 11"
    ),
    plain!(
        "clamp",
        COMPARED,
        Kind::Number,
        |values| values.scaled.most,
        "largest sum of both, world units, with `depth=slope-scaled`",
        "Direct3D 11"
    ),
    plain!(
        "normal-offset",
        COMPARED,
        Kind::Number,
        |values| values.offset.texels,
        "texels by which the receiver is moved along its normal, with `depth=normal-offset`",
        "Holbert 2011"
    ),
    words!(
        "offset-growth",
        COMPARED,
        [("even", OffsetGrowth::Even), ("sine", OffsetGrowth::Sine), ("versine", OffsetGrowth::Versine)],
        |values| values.offset.growth,
        "factor of that: 1, the sine of the angle to the light, or 1 minus its cosine",
        ""
    ),
    plain!(
        "slack",
        PLANES,
        SHARE,
        |values| values.slack,
        "number of roundings by which a tangent plane is moved",
        "Wang & Molnar 1994"
    ),
    plain!(
        "reach",
        PLANES,
        Kind::Number,
        |values| values.reach,
        "largest distance of a tangent plane from the receiver's own depth, map units",
        "Wang & Molnar 1994"
    ),
    words!(
        "virtual",
        CONDITIONAL,
        [("mixed", VirtualWhen::Mixed), ("always", VirtualWhen::Always), ("never", VirtualWhen::Never)],
        |values| values.when,
        "when the tangent plane is compared",
        "Wang & Molnar 1994"
    ),
    plain!(
        "min-cos",
        CONDITIONAL,
        SHARE,
        |values| values.min_cos,
        "least cosine between normal and light at which the plane is compared",
        "Wang & Molnar 1994"
    ),
    words!(
        "backs",
        CONDITIONAL,
        [("shaded", false), ("dark", true)],
        |values| values.dark_backs,
        "whether surfaces that face away from the light are left to shading, or dark",
        "Wang & Molnar 1994"
    ),
    plain!("min", SOFT, Kind::Radius, |values| values.min, "radius of the blur at contact", "Burley 2006"),
    plain!(
        "max",
        SOFT,
        Kind::Radius,
        |values| values.max,
        "largest radius of the blur, and the radius of the search",
        "Burley 2006"
    ),
    optional!(
        "light",
        SOFT,
        Kind::Number,
        |values| values.light,
        "radius of a disc light, world units (tangent of its angle if directional); instead of `min` and `max`",
        ""
    ),
    optional!(
        "nearest",
        SOFT,
        Kind::Positive,
        |values| values.nearest,
        "with `light`: no occluder is nearer to the light, world units; the near plane by default",
        ""
    ),
    plain!(
        "search",
        SOFT,
        COUNT,
        |values| values.search.num_samples,
        "number of taps that search for occluders",
        "Burley 2006"
    ),
    plain!("blur", SOFT, COUNT, |values| values.blur.num_samples, "number of taps that are compared", "Burley 2006"),
    plain!(
        "search",
        HDRP,
        Kind::Whole(64),
        |values| values.hdrp.search,
        "number of samples that search for blockers",
        "HDRP"
    ),
    plain!("blur", HDRP, Kind::Whole(64), |values| values.hdrp.blur, "number of bilinear comparisons", "HDRP"),
    plain!(
        "rotate",
        HDRP,
        Kind::Switch,
        |values| values.hdrp.rotate,
        "whether each region turns its samples by an angle of its own",
        "HDRP"
    ),
    plain!(
        "angular-diameter",
        HDRP,
        Kind::UpTo(90.0),
        |values| values.hdrp.diameter,
        "the angle under which the source of parallel light is seen, degrees (`angularDiameter`)",
        "HDRP"
    ),
    plain!(
        "shape-radius",
        HDRP,
        Kind::Number,
        |values| values.hdrp.radius,
        "the radius of a lamp, world units (`shapeRadius`)",
        "HDRP"
    ),
    own!(
        "rotate",
        SOFT,
        Kind::Switch,
        |values, text, kind| bool::read(text, kind)
            .map(|on| (values.search.rotate, values.blur.rotate) = (on, on))
            .is_some(),
        |values| Some(values.blur.rotate.write()),
        "whether each region turns the taps by an angle of its own",
        "Burley 2006"
    ),
    own!(
        "half-offset",
        SOFT,
        Kind::Switch,
        |values, text, kind| bool::read(text, kind)
            .map(|on| (values.search.half_offset, values.blur.half_offset) = (on, on))
            .is_some(),
        |values| Some(values.blur.half_offset.write()),
        "whether taps begin half a step from the centre",
        "Burley 2006"
    ),
    plain!(
        "rescue",
        SOFT,
        Kind::Switch,
        |values| values.rescue,
        "whether a receiver without occluders is still looked up at the least radius",
        ""
    ),
    own!(
        "falloff",
        SOFT,
        Kind::Words(&["linear", "smooth", "square", "flat"]),
        |values, text, _| falloff(text)
            .map(|(weight, density)| (values.falloff, values.search.density) = (weight, density))
            .is_some(),
        |values| ["linear", "smooth", "square", "flat"]
            .into_iter()
            .find(|name| falloff(name) == Some((values.falloff, values.search.density)))
            .map(Into::into),
        "how the search weighs its taps: `square` is 1 − .9·r², `flat` is their plain mean, evenly spread",
        "Burley 2006"
    ),
    plain!("shape", SOFT, Kind::Positive, |values| values.shape, "exponent of the radius", "Burley 2006"),
    own!(
        "opacity",
        SOFT,
        Kind::Pair,
        |values, text, kind| Value::read(text, kind)
            .map(|(near, far)| values.opacity = values.opacity.with_near(near).with_far(far))
            .is_some(),
        |values| Some((values.opacity.near, values.opacity.far).write()),
        "how dark a shadow is near its occluder and far from it",
        "Burley 2006"
    ),
    plain!(
        "fade",
        SOFT,
        Kind::Positive,
        |values| values.opacity.fade,
        "distance over which `opacity` goes from near to far, world units",
        "Burley 2006"
    ),
    plain!(
        "opacity-shape",
        SOFT,
        Kind::Positive,
        |values| values.opacity.gamma,
        "exponent of that transition",
        "Burley 2006"
    ),
    own!(
        "lookup",
        WILLIAMS,
        Kind::Words(&["nearest", "bilinear", "faithful"]),
        |values, text, _| lookup(text).map(|lookup| values.lookup = lookup).is_some(),
        |values| Some(
            match values.lookup {
                Lookup::Nearest => "nearest",
                Lookup::Bilinear(Guard::Steps(_)) => "bilinear",
                Lookup::Bilinear(Guard::Faithful) => "faithful",
            }
            .into()
        ),
        "how the stored depth is read; `faithful` blends across silhouettes too",
        "Williams 1978"
    ),
    own!(
        "guard",
        WILLIAMS,
        Kind::Number,
        |values, text, kind| f32::read(text, kind)
            .map(|steps| values.lookup = Lookup::Bilinear(Guard::Steps(steps)))
            .is_some(),
        |values| values.guard().map(|steps| steps.write()),
        "depth steps of difference up to which `bilinear` interpolates; setting it chooses `bilinear`",
        ""
    ),
    plain!(
        "dither",
        WILLIAMS,
        Kind::UpTo(2.0),
        |values| values.dither.amplitude,
        "full range of a random displacement, texels",
        "Williams 1978"
    ),
    words!(
        "dither-law",
        WILLIAMS,
        [("normal", DitherLaw::TruncatedNormal), ("uniforms", DitherLaw::ThreeUniforms)],
        |values| values.dither.law,
        "the law of the displacement",
        "Williams 1978"
    ),
    plain!(
        "dither-depth",
        WILLIAMS,
        Kind::Number,
        |values| values.dither.depth,
        "full range of a displacement in depth, map units",
        "Williams 1978"
    ),
    plain!(
        "exponent",
        &[PresetName::Esm],
        Kind::UpTo(Moments::MOST_SHARPNESS),
        |values| values.moments.exponent,
        "sharpness of the exponential of the depth, which is scaled to 0..1",
        "Annen et al. 2008"
    ),
    plain!(
        "exponent",
        &[PresetName::Evsm2, PresetName::Evsm4],
        Kind::UpTo(Moments::MOST_EXPONENT),
        |values| values.moments.exponent,
        "exponent of the depth, which is scaled to −1..1",
        "Lauritzen & McCool 2008"
    ),
    plain!(
        "negative",
        &[PresetName::Evsm4],
        Kind::UpTo(Moments::MOST_EXPONENT),
        |values| values.moments.negative,
        "exponent of the second, negative exponential",
        "Lauritzen & McCool 2008"
    ),
    plain!(
        "bleeding",
        MOMENTS,
        Kind::BelowOne,
        |values| values.moments.filter.bleeding,
        "fraction of the visibility that is cut off, against light bleeding",
        "GPU Gems 3, ch. 8"
    ),
    plain!(
        "lit-from",
        MOMENTS,
        SHARE,
        |values| values.moments.filter.lit_from,
        "visibility from which all counts as lit; what is between the fraction that is cut off and this is stretched",
        "three.js r187"
    ),
    plain!(
        "prefilter",
        PREFILTERED,
        Kind::UpTo(64.0),
        |values| values.moments.prefilter,
        "standard deviation of the blur of the map, texels",
        ""
    ),
    plain!(
        "prefilter",
        DEVIATION,
        Kind::UpTo(64.0),
        |values| values.moments.prefilter,
        "how far the box by which the map is blurred reaches to each side, texels (`radius`)",
        "three.js r187"
    ),
    plain!(
        "blur-samples",
        DEVIATION,
        Kind::Whole(Moments::MOST_SAMPLES),
        |values| values.moments.samples,
        "samples along a row and along a column of that box (`blurSamples`)",
        "three.js r187"
    ),
    plain!(
        "least-variance",
        VARIANCE,
        SHARE,
        |values| values.moments.filter.least_variance,
        "least variance that is used, in squares of the depth's range",
        "Donnelly & Lauritzen 2006"
    ),
    plain!(
        "moment-bias",
        &[PresetName::Msm],
        Kind::UpTo(0.5),
        |values| values.moments.filter.moment_bias,
        "fraction by which moments are mixed with harmless ones, against rounding",
        "Peters & Klein 2015"
    ),
    words!(
        "window",
        &PresetName::ALL,
        [("given", Window::Given), ("fitted", Window::Fitted)],
        |values| values.window,
        "what a map covers: the light's whole view, or the part of it around the points that will be looked up",
        ""
    ),
];

/// `ResFactor` and least half-extent of a named neighbourhood (Wang & Molnar 1994).
fn nearby(text: &str) -> Option<(f32, f32)> {
    match text {
        "four" => Some((0.0, 1.0)),
        "region" => Some((1.0, 1.0)),
        _ => {
            let side: u8 = text.strip_prefix("box")?.parse().ok()?;
            (3..=9).contains(&side).then(|| (0.0, 0.5 * f32::from(side)))
        }
    }
}

fn falloff(text: &str) -> Option<(OccluderFalloff, Density)> {
    match text {
        "linear" => Some((OccluderFalloff::Linear { rim: 0.1 }, Density::Centred)),
        "smooth" => Some((OccluderFalloff::Smooth { rim: 0.1 }, Density::Centred)),
        "square" => Some((OccluderFalloff::Power { rim: 0.1, exponent: 2.0 }, Density::Centred)),
        "flat" => Some((OccluderFalloff::Flat, Density::Uniform)),
        _ => None,
    }
}

fn lookup(text: &str) -> Option<Lookup> {
    match text {
        "nearest" => Some(Lookup::Nearest),
        "bilinear" => Some(Lookup::Bilinear(Guard::default())),
        "faithful" => Some(Lookup::Bilinear(Guard::Faithful)),
        _ => None,
    }
}
