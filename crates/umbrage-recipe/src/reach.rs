//! How far a recipe's filter looks, and the same recipe without its biases: both are needed to judge a picture.

use crate::settings::Settings;
use crate::values::{DepthName, Values};
use crate::{PresetName, Recipe};
use umbrage_plane::glam::Vec2;
use umbrage_plane::{Bias, Receiver, View};
use umbrage_shadow::williams::Lookup;
use umbrage_shadow::{Biased, MapRadius, Moved, Softness};

/// The largest distance from where a filter looks to the sample of the texel there.
const TO_SAMPLE: f32 = 0.5;

impl Recipe {
    /// The same recipe with all its biases set to zero: the bias, or the two of a range, the base and the slope of a bias cone, what grows with the slope, the
    /// offset along the normal, or an engine's default. `None` where it has none, so that it would stay as it is.
    ///
    /// What a tangent plane allows for rounding (`slack`) and what `auto` allows for a sample's width are not biases.
    ///
    /// ```
    /// use umbrage_recipe::Recipe;
    ///
    /// let recipe: Recipe = "reeves87,samples=32,bias=0.3..0.4".parse()?;
    /// assert_eq!(recipe.unbiased().map(|recipe| recipe.to_string()), Some("reeves87,samples=32,bias=0".into()));
    /// assert_eq!(Recipe::default().unbiased(), None);
    /// # Ok::<(), umbrage_recipe::RecipeError>(())
    /// ```
    #[must_use]
    pub fn unbiased(&self) -> Option<Self> {
        let values = &self.values;
        let without = Values { biased: Biased::constant(Bias::ZERO), settings: Settings::default(), ..*values };
        // What the compared depth adds by itself.
        let (without, own) = match values.depth {
            DepthName::Cone => (Values { slope: 0.0, ..without }, values.slope != 0.0),
            DepthName::SlopeScaled => {
                (Values { scaled: values.scaled.with_slope(0.0), ..without }, values.scaled.slope != 0.0)
            }
            DepthName::NormalOffset => {
                (Values { offset: values.offset.with_texels(0.0), ..without }, values.offset.texels != 0.0)
            }
            DepthName::Engine(_) => (Values { depth: DepthName::Constant, ..without }, true),
            DepthName::Constant | DepthName::Plane => (without, false),
        };
        let zero =
            |bias: Bias| matches!(bias, Bias::World(b) | Bias::Texels(b) | Bias::Steps(b) | Bias::Map(b) if b == 0.0);
        let Biased { low, high, .. } = values.biased;
        let is_biased = !zero(low) || !zero(high) || own;
        is_biased.then_some(Self { values: without, ..*self })
    }

    /// How far in front of a plane of a slope the compared depth lies at an axial distance, beyond [`bias`](Self::bias): by a bias that grows with the slope,
    /// by a
    /// normal offset, or by an engine's default. World units along the light's axis; 0 for other depths.
    #[must_use]
    pub fn lift(&self, light: &View, zeta: f64, slope: f64) -> f64 {
        let texel = light.texel_world(zeta).max_element();
        let (scaled, offset) = (self.values.scaled, self.values.offset);
        match self.values.depth {
            DepthName::SlopeScaled => (f64::from(scaled.slope) * texel * slope).min(f64::from(scaled.most)),
            DepthName::NormalOffset => {
                let facing = 1.0 / slope.hypot(1.0);
                f64::from(offset.texels) * texel * offset.growth.of(slope * facing, facing) / facing
            }
            DepthName::Engine(bias) => self.values.of_engine(bias).lift(light, zeta, slope),
            DepthName::Constant | DepthName::Plane | DepthName::Cone => 0.0,
        }
    }

    /// The most by which what is compared anywhere in a receiver's region lies nearer to the light than without a bias ([`unbiased`](Self::unbiased)): the
    /// larger end of a range, a cone's bias as far out as the filter looks, what grows with the slope, and how far nearer an offset along the
    /// normal brings the receiver. World units along the light's axis (along the ray in a radial map), from 0; 0 for a recipe that has no bias, +∞ where a
    /// bias has no bound, as on an edge-on surface.
    ///
    /// ```
    /// use umbrage_plane::glam::{DVec3, UVec2, Vec3};
    /// use umbrage_plane::{SurfacePoint, View};
    /// use umbrage_recipe::Recipe;
    ///
    /// let light = View::orthographic(DVec3::Z * 5.0, DVec3::ZERO, DVec3::Y, 2.0, 0.1, 9.0, UVec2::splat(64))?;
    /// let receiver = light.receiver(&SurfacePoint::at(Vec3::ZERO, Vec3::Z)).expect("before the light");
    /// let most = |text: &str| -> Result<f32, umbrage_recipe::RecipeError> { Ok(text.parse::<Recipe>()?.largest_bias(&light, &receiver)) };
    /// assert_eq!(most("reeves87,bias=0.3..0.4")?, 0.4);
    /// assert_eq!(most("auto")?, 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn largest_bias(&self, view: &View, receiver: &Receiver) -> f32 {
        let Values { biased, slope, scaled, offset, .. } = &self.values;
        // How much nearer along the axis an offset along the normal brings it.
        let nearer =
            |along: f64| receiver.offset(view, along).map_or(f64::INFINITY, |moved| moved.eye.z - receiver.eye.z);
        let own = match self.values.depth {
            DepthName::Constant | DepthName::Plane => 0.0,
            DepthName::Cone => slope * (self.reach(view, receiver) * receiver.texel_world).length(),
            DepthName::SlopeScaled => scaled.world(view, receiver),
            DepthName::NormalOffset => nearer(offset.world(view, receiver)) as f32,
            DepthName::Engine(bias) => self.values.of_engine(bias).nearer(view, receiver, nearer) as f32,
        };
        let drawn = receiver.in_world(view, biased.low).max(receiver.in_world(view, biased.high));
        // An infinite bias of either sign has no bound, and neither has their difference.
        let sum = drawn + own;
        if sum.is_nan() { f32::INFINITY } else { sum.max(0.0) }
    }

    /// Whether what is compared follows the receiver's tangent plane over its region, in one of its comparisons at least.
    #[must_use]
    pub fn follows_plane(&self) -> bool {
        self.values.depth == DepthName::Plane || matches!(self.preset, PresetName::Auto | PresetName::WangMolnar94)
    }

    /// Half-extents of the box about a receiver's place in the map, texels, within which lies everything that the filter reads for it,
    /// the samples of the texels included. A soft filter looks as far as its search goes, however narrow the blur that it then chooses.
    ///
    /// At least half a texel; at most a quarter of the map, as every filter's regions are, and half a texel.
    #[must_use]
    pub fn reach(&self, view: &View, receiver: &Receiver) -> Vec2 {
        let about = receiver.texel.as_vec2();
        let most = view.size().as_vec2() * 0.25;
        let scaled = |factor: f32, least: f32| {
            let region = receiver.footprint.scaled(about, factor, least, most);
            region.half + (region.centre - about).abs()
        };
        let values = &self.values;
        let half = match self.preset {
            PresetName::Auto => scaled(1.0, 0.0),
            PresetName::Williams78 => {
                // The centres of the nearest four texels are within a texel.
                let interpolated = if values.lookup == Lookup::Nearest { 0.0 } else { TO_SAMPLE };
                Vec2::splat(interpolated + 0.5 * values.dither.amplitude)
            }
            PresetName::Ordinary => scaled(values.res_factor, 0.0),
            PresetName::Burley | PresetName::Fernando => {
                scaled(1.0, 0.0).max(widest(values.softness(), view, receiver)).min(most)
            }
            preset if preset.is_prefiltered() => {
                // The coarser of two levels has texels up to twice the footprint's width, of which the next but one still counts.
                scaled(4.0, values.moments.reach(preset))
            }
            PresetName::HdrpPcss => values.hdrp.widest(view, receiver).min(most),
            _ => scaled(values.res_factor, values.min_size),
        };
        half + self.shift(view, receiver) + TO_SAMPLE
    }

    /// How far a receiver is looked up from its own place, texels.
    fn shift(&self, view: &View, receiver: &Receiver) -> Vec2 {
        let along = match self.values.depth {
            DepthName::NormalOffset => self.values.offset.world(view, receiver),
            DepthName::Engine(bias) => self.values.of_engine(bias).of(view, receiver).normal,
            DepthName::Constant | DepthName::Plane | DepthName::Cone | DepthName::SlopeScaled => 0.0,
        };
        if along == 0.0 { Vec2::ZERO } else { Moved::by(view, receiver, along, 0.0).shift.abs() }
    }
}

/// The largest radius of a soft filter's search, texels.
fn widest(softness: Softness, view: &View, receiver: &Receiver) -> Vec2 {
    match softness {
        Softness::Between { min, max } => texels(min, view, receiver).max(texels(max, view, receiver)),
        Softness::Light { radius, nearest } => {
            let zeta = -receiver.eye.z as f32;
            let near = view.near() as f32;
            let (nearest, scale) =
                if view.is_perspective() { (nearest.max(near), 1.0 / nearest.max(near)) } else { (near, 1.0) };
            Vec2::splat(radius * (zeta - nearest).max(0.0) * scale) / receiver.texel_world
        }
    }
}

fn texels(radius: MapRadius, view: &View, receiver: &Receiver) -> Vec2 {
    match radius {
        MapRadius::Texels(radius) => Vec2::splat(radius),
        MapRadius::Fraction(share) => view.size().as_vec2() * share,
        MapRadius::World(radius) => Vec2::splat(radius) / receiver.texel_world,
    }
}
