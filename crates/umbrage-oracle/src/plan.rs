use umbrage_depth::{Midpoint, Stored};
use umbrage_plane::{Bias, Kind, View};
use umbrage_recipe::Recipe;

/// What a light's map is going to be used for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Bits of integer depth; `None` for floats, which have 24.
    pub depth_bits: Option<u32>,
    /// The bias, world units.
    pub bias_world: f64,
    /// What the map keeps.
    pub stored: Stored,
    /// How midpoints are found, where these are what it keeps.
    pub midpoint: Midpoint,
    /// Tangent of the steepest angle between a caster's surface and the map's plane that must be free of error, ≥ 0 (Wang & Molnar 1994).
    /// With 0 it is not examined.
    pub slope: f64,
    /// Half-extent of the filter, texels.
    pub filter_half: f64,
}

impl Default for Plan {
    /// Float depth of the first surface with Reeves' smaller bias.
    fn default() -> Self {
        Self {
            depth_bits: None,
            bias_world: 0.3,
            stored: Stored::First,
            midpoint: Midpoint::default(),
            slope: 0.0,
            filter_half: 0.0,
        }
    }
}

impl Plan {
    /// What a recipe is going to do with a map of floats, judged at an axial distance. Surfaces must be free of error up to a slope
    /// of 2, which is 63° and as far as Burley's cone goes.
    pub fn of(recipe: &Recipe, light: &View, zeta: f64) -> Self {
        const SLOPE: f64 = 2.0;
        let texel = light.texel_world(zeta).max_element();
        let bias_world = match recipe.bias() {
            Bias::World(bias) => f64::from(bias),
            Bias::Texels(texels) => f64::from(texels) * texel,
            Bias::Steps(steps) => f64::from(steps) * texel * SLOPE,
            Bias::Map(amount) => {
                let screen = light.with_kind(Kind::Screen);
                zeta - screen.decode().zeta((screen.key(zeta) - f64::from(amount)) as f32)
            }
        };
        let bias_world = bias_world + recipe.lift(light, zeta, SLOPE);
        let filter_half = f64::from(recipe.least_half());
        Self {
            depth_bits: None,
            bias_world,
            stored: recipe.stored(),
            midpoint: recipe.midpoint(),
            slope: SLOPE,
            filter_half,
        }
    }
}
