use crate::engine::{Depth, EngineBias, OfEngine};
use crate::moments::MomentValues;
use crate::pattern::PatternName;
use crate::preset::ByEngine;
use crate::settings::Settings;
use crate::{PresetName, RecipeError};
use umbrage_bake::{Deep, Refinement};
use umbrage_depth::{Midpoint, SameSurface, Stored};
use umbrage_engines::Engine;
use umbrage_plane::Bias;
use umbrage_sample::{Disc, Jittered};
use umbrage_shadow::williams::{Dither, Guard, Lookup};
use umbrage_shadow::{
    AnyDepth, BiasCone, Biased, Conditional, DualPlane, HdrpPcss, MapRadius, NormalOffset, OccluderFalloff, OnPlane,
    Opacity, Pcf, Radius, SlopeScaled, Soft, Softness, Spread, VirtualWhen, Williams, presets,
};

/// Which surface of a texel is stored, and how it is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    First,
    Second,
    BackFace,
    Normals,
    Midpoint,
    Deep,
    Facets,
}

impl Rule {
    /// What a map made by this rule records.
    pub fn stored(self) -> Stored {
        match self {
            Self::First | Self::Deep | Self::Facets => Stored::First,
            Self::Second => Stored::Second,
            Self::BackFace | Self::Normals => Stored::BackFace,
            Self::Midpoint => Stored::Midpoint,
        }
    }
}

/// Which depth is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthName {
    Constant,
    Plane,
    Cone,
    SlopeScaled,
    NormalOffset,
    /// An engine's own default.
    Engine(EngineBias),
}

/// Maps of at most this many texels along their larger side are refined more finely by default.
const SMALL: u32 = 128;

/// Where a light's map lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Window {
    /// In the light's own view.
    Given,
    /// Around the points that will be shaded.
    Fitted,
}

/// The values of all fields, whether a recipe's own filter uses them or not. Those that it does not use stay as in the preset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Values {
    pub rule: Rule,
    pub midpoint: Midpoint,
    pub deep: Deep,
    /// Samples along a texel's side, where they are given.
    pub sub_samples: Option<u32>,
    pub pattern: PatternName,
    pub jittered: Jittered,
    pub integer_first: bool,
    pub unit: f32,
    pub res_factor: f32,
    pub min_size: f32,
    pub depth: DepthName,
    /// Of the engine whose bias `depth` is.
    pub settings: Settings,
    pub biased: Biased,
    pub slope: f32,
    pub radius: Radius,
    /// Its constant part is `biased`'s.
    pub scaled: SlopeScaled,
    /// Its bias is `biased`'s.
    pub offset: NormalOffset,
    pub slack: f32,
    pub reach: f32,
    pub when: VirtualWhen,
    pub min_cos: f32,
    pub dark_backs: bool,
    pub min: MapRadius,
    pub max: MapRadius,
    /// Radius of a disc light, which stands for `min` and `max`.
    pub light: Option<f32>,
    pub nearest: Option<f32>,
    pub search: Disc,
    pub blur: Disc,
    pub falloff: OccluderFalloff,
    pub shape: f32,
    pub opacity: Opacity,
    pub rescue: bool,
    pub lookup: Lookup,
    pub dither: Dither,
    /// Samples along a refined texel's side and slots of a link, where they are given.
    pub fine: Option<u32>,
    pub slots: Option<u32>,
    pub dual: DualPlane,
    /// Points of an area light, where they are given.
    pub maps: Option<u32>,
    pub window: Window,
    pub moments: MomentValues,
    /// Its depth is left to `compared`.
    pub hdrp: HdrpPcss,
}

impl Values {
    /// Those of a preset.
    pub fn of(preset: PresetName) -> Self {
        let parts = Self::common();
        if let Some(by) = preset.by_engine() {
            return parts.by_engine(preset, &by);
        }
        match preset {
            PresetName::Auto => {
                Self { rule: Rule::Facets, biased: Biased::constant(Bias::ZERO), dual: presets::auto().filter, ..parts }
            }
            PresetName::Williams78 => {
                let Williams { bias, lookup, dither, .. } = presets::williams78().filter;
                Self { biased: Biased::constant(bias), lookup, dither, ..parts }
            }
            PresetName::Reeves87 => parts.closer(presets::reeves87().filter),
            PresetName::Reeves87Recommended => parts.closer(presets::reeves87_recommended().filter),
            PresetName::Woo92 => Self { rule: Rule::Midpoint, ..parts.closer(presets::woo92().filter) },
            PresetName::WangMolnar94 => {
                let Conditional { res_factor, min_size, plane, min_cos, when, dark_backs, .. } =
                    presets::wang_molnar94().filter;
                let OnPlane { bias, slack, reach, .. } = plane;
                let (rule, pattern, biased) = (Rule::BackFace, PatternName::Every, Biased::constant(bias));
                let parts = Self { rule, pattern, biased, slack, reach, ..parts };
                Self { res_factor, min_size, when, min_cos, dark_backs, ..parts }
            }
            PresetName::Burley => {
                let soft = presets::burley().filter;
                let BiasCone { base, slope, radius, .. } = soft.depth;
                let parts = Self { depth: DepthName::Cone, slope, radius, ..parts.soft(&soft) };
                Self { biased: Biased::constant(Bias::World(base)), ..parts }
            }
            PresetName::Fernando => {
                // One texel, for want of any knowledge of the scene.
                let fernando = presets::fernando(Bias::Texels(1.0)).filter;
                let biased = fernando.depth;
                Self { depth: DepthName::Constant, biased, ..parts.soft(&fernando) }
            }
            PresetName::Ordinary => Self { biased: Biased::constant(Bias::ZERO), res_factor: 1.0, ..parts },
            preset if preset.is_prefiltered() => {
                let moments = MomentValues::of(preset);
                Self { biased: moments.filter.depth, moments, ..parts }
            }
            _ => parts,
        }
    }

    /// An engine's kernel about the receiver, and its default bias.
    fn by_engine(self, preset: PresetName, by: &ByEngine) -> Self {
        let ByEngine { bias, pattern, half, samples } = *by;
        let rule = if preset.expects() == [Stored::BackFace] { Rule::BackFace } else { Rule::First };
        let jittered = self.jittered.with_num_samples(samples);
        let biased = Biased::constant(Bias::ZERO);
        let depth = DepthName::Engine(bias);
        let moments = MomentValues::of(preset);
        Self { rule, pattern, jittered, res_factor: 0.0, min_size: half, depth, biased, moments, ..self }
    }

    /// The values of presets that do not set others.
    fn common() -> Self {
        let (pcf, cone, plane) = (Pcf::default(), BiasCone::default(), OnPlane::default());
        let (conditional, williams) = (Conditional::default(), Williams::default());
        let soft = Soft::default();
        Self {
            rule: Rule::First,
            midpoint: Midpoint::default(),
            deep: Deep::default(),
            sub_samples: None,
            pattern: PatternName::Jittered,
            jittered: pcf.pattern,
            integer_first: false,
            unit: 1.0,
            res_factor: pcf.res_factor,
            min_size: pcf.min_size,
            depth: DepthName::Constant,
            settings: Settings::default(),
            biased: pcf.depth,
            slope: cone.slope,
            radius: cone.radius,
            scaled: SlopeScaled::default(),
            offset: NormalOffset::default(),
            slack: plane.slack,
            reach: plane.reach,
            when: conditional.when,
            min_cos: conditional.min_cos,
            dark_backs: conditional.dark_backs,
            min: MapRadius::Texels(0.0),
            max: MapRadius::Texels(0.0),
            light: None,
            nearest: None,
            search: soft.search,
            blur: soft.blur,
            falloff: soft.falloff,
            shape: soft.radius_gamma,
            opacity: soft.opacity,
            rescue: soft.rescue,
            lookup: williams.lookup,
            dither: williams.dither,
            fine: None,
            slots: None,
            dual: DualPlane::default(),
            maps: None,
            window: Window::Given,
            moments: MomentValues::of(PresetName::Vsm),
            hdrp: HdrpPcss::default(),
        }
    }

    fn closer(self, pcf: Pcf) -> Self {
        let Pcf { pattern, depth, res_factor, min_size, .. } = pcf;
        Self { jittered: pattern, biased: depth, res_factor, min_size, ..self }
    }

    fn soft<D>(self, soft: &Soft<D>) -> Self {
        let Soft { softness, search, blur, falloff, radius_gamma, opacity, rescue, .. } = *soft;
        let parts = match softness {
            Softness::Between { min, max } => Self { min, max, ..self },
            Softness::Light { radius, nearest } => Self { light: Some(radius), nearest: Some(nearest), ..self },
        };
        Self { search, blur, falloff, shape: radius_gamma, opacity, rescue, ..parts }
    }

    /// How finely maps of facets are refined whose larger side has this many texels: small ones have room for more samples, so that there are about
    /// as many across all of them.
    pub fn refinement(&self, texels: u32) -> Refinement {
        let small = texels <= SMALL && self.slots.is_none_or(|slots| slots <= 8);
        let fine = self.fine.unwrap_or(if small { 8 } else { 4 });
        let slots = self.slots.unwrap_or((64 / fine).min(16));
        Refinement::default().with_fine(fine).with_slots(slots)
    }

    /// The default's values, but for those that maps depend on.
    pub fn pass_1(&self) -> Self {
        let Self { rule, midpoint, deep, sub_samples, fine, slots, window, .. } = *self;
        Self { rule, midpoint, deep, sub_samples, fine, slots, window, ..Self::of(PresetName::Auto) }
    }

    /// The default's values for casters that let light pass.
    pub fn deep(self) -> Self {
        Self { rule: Rule::Deep, light: None, ..self }
    }

    /// The radii in combination.
    pub fn softness(&self) -> Softness {
        match self.light {
            Some(radius) => Softness::Light { radius, nearest: self.nearest.unwrap_or(0.0) },
            None => Softness::Between { min: self.min, max: self.max },
        }
    }

    pub fn plane(&self) -> OnPlane {
        OnPlane::default().with_bias(self.biased.low).with_slack(self.slack).with_reach(self.reach)
    }

    /// The engine whose bias is compared.
    pub fn engine(&self) -> Option<Engine> {
        if let DepthName::Engine(bias) = self.depth { Some(bias.engine()) } else { None }
    }

    pub fn of_engine(&self, bias: EngineBias) -> OfEngine {
        OfEngine { bias, settings: self.settings, lamp: self.hdrp.radius }
    }

    /// The depth that is compared.
    pub fn compared(&self) -> Depth {
        let any: AnyDepth = match self.depth {
            DepthName::Constant => self.biased.into(),
            DepthName::Plane => self.plane().into(),
            DepthName::Cone => {
                let base = if let Bias::World(base) = self.biased.low { base } else { 0.0 };
                BiasCone::default().with_base(base).with_slope(self.slope).with_radius(self.radius).into()
            }
            DepthName::SlopeScaled => self.scaled.with_constant(self.biased.low).into(),
            DepthName::NormalOffset => self.offset.with_bias(self.biased.low).into(),
            DepthName::Engine(bias) => return Depth::Engine(self.of_engine(bias)),
        };
        Depth::Any(any)
    }

    /// Checks that need all fields together; `given` are the names of those that were written.
    pub fn check(&self, preset: PresetName, given: &[&str]) -> Result<(), RecipeError> {
        let several = self.sub_samples.is_some_and(|axis| axis > 1);
        if self.rule == Rule::Midpoint && several && self.midpoint.same != SameSurface::Surface {
            // One surface has several depths in a texel then, and would shadow itself all over.
            let same = if self.midpoint.same == SameSurface::Depth { "depth" } else { "object" };
            return Err(RecipeError::value("same", same, "surface, with several sub-samples over midpoints"));
        }
        match preset {
            PresetName::Burley | PresetName::Fernando => self.check_soft(given)?,
            PresetName::Auto => return self.check_auto(),
            PresetName::Williams78 | PresetName::WangMolnar94 | PresetName::Ordinary => return Ok(()),
            // They compare more than a bias there.
            PresetName::ThreeVsm | PresetName::HdrpPcss => {}
            preset if preset.is_prefiltered() => return Ok(()),
            _ => self.check_closer()?,
        }
        self.check_depth()
    }

    fn check_auto(&self) -> Result<(), RecipeError> {
        match (self.fine, self.slots) {
            (Some(fine), Some(slots)) if fine * slots > 64 => {
                let most = format!("at most {} with fine={fine}", 64 / fine);
                Err(RecipeError::value("slots", &slots.to_string(), most))
            }
            _ => Ok(()),
        }
    }

    fn check_closer(&self) -> Result<(), RecipeError> {
        let Jittered { num_samples, min_samples, .. } = self.jittered;
        if min_samples > num_samples {
            return Err(RecipeError::value("min-samples", &min_samples.to_string(), "at most samples"));
        }
        let plain = self.pattern == PatternName::Jittered && self.biased == Biased::constant(Bias::ZERO);
        if self.integer_first && !(plain && self.depth == DepthName::Constant) {
            let expected = "float, unless pattern=jittered, depth=constant, bias=0";
            return Err(RecipeError::value("compare", "integer", expected));
        }
        Ok(())
    }

    fn check_soft(&self, given: &[&str]) -> Result<(), RecipeError> {
        let radius = ["min", "max"].into_iter().find(|radius| given.contains(radius));
        if let (Some(_), Some(field)) = (self.light, radius) {
            return Err(RecipeError::value(field, "given", "no such field beside light"));
        }
        if let (Some(nearest), None) = (self.nearest, self.light) {
            return Err(RecipeError::value("nearest", &nearest.to_string(), "light too"));
        }
        let larger = match (self.min, self.max) {
            (MapRadius::Texels(min), MapRadius::Texels(max))
            | (MapRadius::Fraction(min), MapRadius::Fraction(max))
            | (MapRadius::World(min), MapRadius::World(max)) => min > max,
            _ => false,
        };
        if larger && self.light.is_none() {
            return Err(RecipeError::value("min", &crate::kind::Value::write(&self.min), "at most max"));
        }
        Ok(())
    }

    fn check_depth(&self) -> Result<(), RecipeError> {
        let Biased { low, high, spread, .. } = self.biased;
        let written = || crate::kind::Value::write(&(low, high));
        if self.depth != DepthName::Constant && low != high {
            return Err(RecipeError::value("bias", &written(), "one bias, unless depth=constant"));
        }
        if self.depth != DepthName::Constant && spread != Spread::default() {
            return Err(RecipeError::value("spread", "ramp", "none, unless depth=constant"));
        }
        if self.depth == DepthName::Cone && !matches!(low, Bias::World(_)) {
            return Err(RecipeError::value("bias", &written(), "world units, with depth=cone"));
        }
        if matches!(self.depth, DepthName::Engine(_)) && low != Bias::ZERO {
            return Err(RecipeError::value("bias", &written(), "0, with an engine's own bias as depth"));
        }
        Ok(())
    }

    /// Depth steps up to which `bilinear` interpolates, where it has such a bound.
    pub fn guard(&self) -> Option<f32> {
        if let Lookup::Bilinear(Guard::Steps(steps)) = self.lookup { Some(steps) } else { None }
    }
}
