//! Every filter of the crates, and those of strangers.

use super::subject::Subject;
use crate::outside::{Pcss, Variance};
use umbrage_depth::{DepthMap, Map, MomentMap, Moments};
use umbrage_plane::Bias;
use umbrage_sample::{
    AnyPattern, AreaTent, Castano, Centre, Disc, EveryTexel, Gaussian, InsideQuadReject, InsideQuadWarp, Jittered,
    Spiral, Table, Tent, Uniform, Vogel,
};
use umbrage_shadow::williams::{Dither, Guard, Lookup};
use umbrage_shadow::{
    AnyDepth, BiasCone, Biased, Conditional, DualPlane, FilteredDepth, FromMoments, HdrpPcss, IntegerFirst, MapRadius,
    NormalOffset, OnPlane, Opacity, Pcf, Radius, SlopeScaled, Soft, Softness, VirtualWhen, Williams, presets,
};

/// Each filter with the parameters that change what it does. Patterns and depths are chosen when the program runs, so that this costs
/// one compiled body per filter; the types that have no choice are listed as users name them.
pub fn every_filter() -> Vec<Subject> {
    let reeves = |pattern: AnyPattern, depth: AnyDepth| {
        Pcf::default().with_pattern(pattern).with_depth(depth).with_res_factor(1.0).with_min_size(1.0)
    };
    let plane = || OnPlane::biased(Bias::Texels(0.5)).into();
    let wang = |pattern: AnyPattern| Conditional::default().with_pattern(pattern);
    let burley = || Soft::default().with_depth(AnyDepth::from(BiasCone::default()));
    let light = |radius| Softness::Light { radius, nearest: 2.0 };
    let between = Softness::Between { min: MapRadius::Fraction(0.01), max: MapRadius::World(0.9) };
    let bilinear = |guard| Williams::default().with_lookup(Lookup::Bilinear(guard));
    vec![
        Subject::new("pcf", Pcf::default()),
        Subject::new(
            "pcf without culling",
            reeves(Jittered::default().into(), Biased::default().into()).with_cull(false),
        ),
        Subject::new("every texel on the plane", reeves(EveryTexel.into(), plane())),
        Subject::new("one tap", reeves(Centre.into(), Biased::constant(Bias::Texels(1.0)).into())),
        Subject::new("a tent in a cone", reeves(Tent.into(), BiasCone::default().into())),
        Subject::new("uniform taps", reeves(Uniform::default().into(), Biased::default().into())),
        Subject::new("taps of a table", reeves(Table::default().into(), Biased::default().into())),
        Subject::new("normal taps", reeves(Gaussian::default().into(), plane())),
        Subject::new("inside the quadrilateral", reeves(InsideQuadReject::default().into(), Biased::default().into())),
        Subject::new("warped onto it", reeves(InsideQuadWarp::default().into(), plane())),
        Subject::new(
            "a disc in a nominal cone",
            reeves(Disc::default().into(), BiasCone::default().with_radius(Radius::Nominal).into()),
        ),
        Subject::new("castaño's bell, slope-scaled", reeves(Castano::Seven.into(), SlopeScaled::default().into())),
        Subject::new("unity's tent, offset", reeves(AreaTent.into(), NormalOffset::default().into())),
        Subject::new("vogel's disc", reeves(Vogel::default().into(), Biased::constant(Bias::Texels(1.0)).into())),
        Subject::new("a spiral", reeves(Spiral::default().into(), Biased::constant(Bias::Texels(1.0)).into())),
        Subject::new("whole units first", IntegerFirst::default()),
        Subject::new(
            "depths filtered first",
            FilteredDepth::default().with_bias(Bias::World(0.3)).with_res_factor(2.0),
        ),
        Subject::new("williams", Williams::default().with_dither(Dither::HALF_TEXEL)),
        Subject::new("williams, interpolated", bilinear(Guard::default())),
        Subject::new("williams, faithful", bilinear(Guard::Faithful).with_bias(Bias::Steps(1.0))),
        Subject::new("wang and molnar", wang(Jittered::default().into())),
        Subject::new("wang and molnar, weighted", wang(Tent.into()).with_res_factor(1.0)),
        Subject::new(
            "wang and molnar, always",
            wang(EveryTexel.into()).with_when(VirtualWhen::Always).with_min_size(1.5),
        ),
        Subject::new("two planes without facets", DualPlane::default()),
        Subject::new("moments without moments", FromMoments::default()),
        Subject::new("burley", burley()),
        Subject::new("burley, rescued", burley().with_rescue(true)),
        Subject::new("burley, radii of several units", burley().with_softness(between).with_radius_gamma(0.5)),
        Subject::new("burley, by the light's size", burley().with_softness(light(0.5))),
        Subject::new("burley, offset", burley().with_depth(AnyDepth::from(NormalOffset::default()))),
        Subject::new("burley, on the plane", burley().with_depth(AnyDepth::from(OnPlane::default().with_slack(1.0)))),
        Subject::new("hdrp's soft shadows", HdrpPcss::default().with_depth(AnyDepth::from(NormalOffset::default()))),
        Subject::new(
            "hdrp's, of large lights",
            HdrpPcss::default().with_diameter(9.0).with_radius(0.5).with_search(64).with_blur(33),
        ),
        Subject::new("a stranger's variance", Variance::default()),
        Subject::new(
            "a stranger's soft shadow",
            Pcss { taps: Disc::default(), depth: BiasCone::default(), light: 4.0 },
        ),
    ]
}

/// A filter whose shadows thin with the distance of what casts them: no law about how dark they are is for it.
pub fn thinning() -> Subject {
    let opacity = Opacity::default().with_near(0.9).with_far(0.2).with_fade(20.0).with_gamma(0.7);
    let burley = Soft::default().with_depth(AnyDepth::from(BiasCone::default()));
    Subject::new("burley, faint far away", burley.with_opacity(opacity))
}

/// The presets over maps of moments. The law that opaque surfaces of a deep map are those of a plain one is not for them: deep maps know each
/// texel's own surfaces, moments the mean of several.
pub fn prefiltered() -> Vec<Subject> {
    fn with(kind: Moments, map: Map) -> Map {
        let bare = map.moments().is_none() && map.translucent().is_none();
        if bare { MomentMap::of(&map, kind, 1.0).into() } else { map }
    }
    vec![
        Subject::new("vsm", presets::vsm().filter).through(|map| with(Moments::Variance, map)),
        Subject::new("esm", presets::esm().filter).through(|map| with(Moments::ESM, map)),
        Subject::new("evsm2", presets::evsm2().filter).through(|map| with(Moments::EVSM2, map)),
        Subject::new("evsm4", presets::evsm4().filter).through(|map| with(Moments::EVSM4, map)),
        Subject::new("msm", presets::msm().filter).through(|map| with(Moments::Four, map)),
        Subject::new("mean and deviation", FromMoments::default().with_bleeding(0.3).with_lit_from(0.95))
            .through(|map| with(Moments::Deviation { samples: 8 }, map)),
    ]
}
