use crate::bake::moment;
use crate::values::{Values, Window};
use crate::{PresetName, RecipeError, kind};
use umbrage_bake::Casting;
use umbrage_depth::{DepthMap, Map, Midpoint, Storage, Stored};
use umbrage_plane::{Bias, View};
use umbrage_raster::Stats;
use umbrage_shadow::Shadow;

/// A shadow algorithm by name, as people write it: a preset and what differs from it, such as
/// `reeves87,samples=16,res-factor=3,bias=0.3..0.4`. Which surface is stored, where the map is looked up and which depth is compared can be chosen
/// independently:
/// `burley,stored=midpoint` and `woo92,depth=cone,pattern=disc` are recipes too.
///
/// | preset | stored | filter |
/// |---|---|---|
/// | `auto` | facets | two planes, no bias: the default |
/// | `williams78` | first | point by point |
/// | `reeves87`, `reeves87-recommended` | first | percentage closer, biases of a range |
/// | `woo92` | midpoint | percentage closer, no bias |
/// | `wang-molnar94` | back-face | nearest four texels, tangent plane where they disagree |
/// | `burley` | first | soft, bias cone |
/// | `fernando` | first | soft, plain mean, constant bias |
/// | `ordinary` | first | depths filtered first: the control |
/// | `vsm`, `esm`, `evsm2`, `evsm4`, `msm` | first, filtered beforehand | inequalities for moments of the depths |
///
/// The defaults of engines, as far as their sources show: percentage closer in a few texels about the receiver, whatever its footprint, with the
/// engine's own default bias. That depends on the light's projection, on its map and on each receiver ([`umbrage_engines`]), so that no number of `bias` is the
/// same; `depth=godot` gives it to any other filter, and the engine's settings are fields then: `godot-pcf,shadow_bias=0.2`. One unit of the scene is one of the engine's, and the light's near and far planes are taken for the
/// engine's own.
///
/// | preset | stored | kernel | bias | sources read |
/// |---|---|---|---|---|
/// | `three-pcf` | back-face | [`Vogel`](umbrage_sample::Vogel), 5 samples, radius 1 | `three` | three.js r187, `shadowmap_pars_fragment.glsl.js` |
/// | `three-vsm` | first, filtered beforehand | mean and deviation of a box of 3 × 3 texels, 8 samples a side; light up to 0.3 is none, from 0.95 all | `three` | three.js r187, `vsm.glsl.js`, `WebGLShadowMap.js` and the same |
/// | `babylon-none` | first | nearest texel | `babylon` | Babylon.js 9.35, `shadowsFragmentFunctions.js` |
/// | `babylon-pcf` | first | [`Castano`](umbrage_sample::Castano), 5 × 5 | `babylon-pcf` | the same |
/// | `filament-pcf` | first | [`Tent`](umbrage_sample::Tent) of 2 texels, which is Castaño's 3 × 3 | `filament` | Filament, `surface_shadowing.fs` |
/// | `bevy-gaussian` | first | [`Castano`](umbrage_sample::Castano), 5 × 5 | `bevy` | Bevy 0.20.1, `shadow_sampling.wesl` |
/// | `godot-pcf` | first | [`Vogel`](umbrage_sample::Vogel), 4 samples, radius 2 | `godot` | Godot 4, `scene_forward_lights_inc.glsl` |
/// | `urp-hard` | first | [`Tent`](umbrage_sample::Tent) of 1 texel, one bilinear comparison | `urp` | Unity URP, `Shadows.hlsl` |
/// | `urp-soft` | first | [`AreaTent`](umbrage_sample::AreaTent), 5 × 5 | `urp-soft` | the same and `ShadowSamplingTent.hlsl` |
/// | `hdrp-pcf5`, `hdrp-pcf7` | first | [`AreaTent`](umbrage_sample::AreaTent), 5 × 5 for spot lights, 7 × 7 for directional ones | `hdrp` | Unity HDRP, `HDShadowAlgorithms.hlsl`, and the same |
/// | `hdrp-pcss` | first | [`HdrpPcss`](umbrage_shadow::HdrpPcss), 24 samples that search and 16 bilinear comparisons; a sun of 0.5°, a lamp of 0.025 units | `hdrp-pcss` | Unity HDRP, `HDShadowSampling.hlsl`, `HDPCSS.hlsl` |
///
/// Where a unit of the depth format is left open, the least is taken. Normals are geometric, where engines may take shading normals. Cascades, borders of
/// atlases and
/// fades at a map's end are not in them.
///
/// Units: `t` texels, `w` world units, `s` depth steps, `m` fractions of the range from near to far as screen depth has it, `%` of the map's sides.
///
#[doc = include_str!("fields.md")]
///
/// ```
/// use umbrage_recipe::Recipe;
///
/// let recipe: Recipe = "reeves87, samples=32, bias=0.3..0.4".parse()?;
/// // The bias is the preset's own.
/// assert_eq!(recipe.to_string(), "reeves87,samples=32");
/// let error = "reeves87,jitter=1.5".parse::<Recipe>().unwrap_err();
/// assert_eq!(error.to_string(), "jitter = \"1.5\": expected a number from 0 to 1");
/// # Ok::<(), umbrage_recipe::RecipeError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recipe {
    pub(crate) preset: PresetName,
    pub(crate) values: Values,
    /// Whether `stored` was written, even if it is the preset's own.
    pub(crate) names_stored: bool,
}

impl Default for Recipe {
    /// `auto`.
    fn default() -> Self {
        PresetName::Auto.into()
    }
}

impl From<PresetName> for Recipe {
    fn from(preset: PresetName) -> Self {
        Self { preset, values: Values::of(preset), names_stored: false }
    }
}

impl Recipe {
    /// The preset that it began with.
    #[must_use]
    pub fn preset(&self) -> PresetName {
        self.preset
    }

    /// Which surface the maps record that it bakes.
    #[must_use]
    pub fn stored(&self) -> Stored {
        self.values.rule.stored()
    }

    /// How midpoints are found, where its maps record these.
    #[must_use]
    pub fn midpoint(&self) -> Midpoint {
        self.values.midpoint
    }

    /// The surfaces over which it may be [bound](Self::bind): the one that `stored` names, or those that the preset expects.
    #[must_use]
    pub fn expects(&self) -> Vec<Stored> {
        if self.names_stored { vec![self.stored()] } else { self.preset.expects().to_vec() }
    }

    /// The bias that every receiver is given at least: the smaller end of a range, the base of a cone.
    #[must_use]
    pub fn bias(&self) -> Bias {
        self.values.biased.low
    }

    /// Whether its maps are fitted to the points that will be shaded ([`LightUse::receivers`](crate::LightUse::receivers)).
    #[must_use]
    pub fn is_fitted(&self) -> bool {
        self.values.window == Window::Fitted
    }

    /// Half-extent of the smallest region that the filter looks up, texels; 0 for one texel.
    #[must_use]
    pub fn least_half(&self) -> f32 {
        match self.preset {
            PresetName::Auto | PresetName::Williams78 | PresetName::Ordinary => 0.0,
            PresetName::Burley | PresetName::Fernando => 0.5,
            preset if preset.is_prefiltered() => self.values.moments.reach(preset),
            _ => self.values.min_size,
        }
    }

    /// What the maps that it [bakes](Self::bake) depend on: a recipe of the same maps, in which everything else is as in `auto`. Where this is equal, so are the maps
    /// of a view, and one will do for several recipes.
    ///
    /// ```
    /// use umbrage_recipe::Recipe;
    ///
    /// let pass_1 = |recipe: &str| recipe.parse::<Recipe>().map(|recipe| recipe.pass_1());
    /// assert_eq!(pass_1("burley,max=4t")?, pass_1("reeves87,samples=9")?);
    /// assert_ne!(pass_1("burley,stored=midpoint")?, pass_1("burley")?);
    /// # Ok::<(), umbrage_recipe::RecipeError>(())
    /// ```
    #[must_use]
    pub fn pass_1(&self) -> Self {
        Self { preset: PresetName::Auto, values: self.values.pass_1(), names_stored: false }
    }

    /// Pass 1: the map that this recipe needs of a light's view, from triangles each with its opacity, colour, normals and holes.
    /// A caster's [mask](umbrage_bake::Caster::mask) is evaluated whatever the recipe stores.
    ///
    /// ```
    /// use glam::{DVec3, UVec2, Vec3};
    /// use umbrage_depth::Storage;
    /// use umbrage_plane::{SurfacePoint, View};
    /// use umbrage_raster::Triangle;
    /// use umbrage_recipe::Recipe;
    /// use umbrage_sample::Key;
    ///
    /// let lamp = View::perspective(DVec3::Z * 10.0, DVec3::ZERO, DVec3::Y, 1.0, 1.0, 20.0, UVec2::splat(64))?;
    /// let corners = [(-2.0, -2.0), (2.0, -2.0), (0.0, 2.0)].map(|(x, y)| DVec3::new(x, y, 6.0));
    /// let recipe: Recipe = "reeves87".parse()?;
    /// let map = recipe.bake(&lamp, [Triangle { corners, object: 0, sheet: true }]);
    /// let shadow = recipe.bind(map, Storage::Tiled)?;
    /// assert_eq!(shadow.fraction(&SurfacePoint::at(Vec3::ZERO, Vec3::Z), Key::new(0, 0, 0)), 1.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn bake<'m>(&self, view: &View, casters: impl IntoIterator<Item: Into<Casting<'m>>>) -> Map {
        self.bake_moments(view, [casters])
    }

    /// The same over an exposure, `moments` being the triangles at evenly spread times: deep maps hold the mean of them; of maps of one
    /// surface each texel sees one of them. An empty map of none.
    pub fn bake_moments<'m, M>(&self, view: &View, moments: impl IntoIterator<Item = M>) -> Map
    where
        M: IntoIterator<Item: Into<Casting<'m>>>,
    {
        self.bake_counted(view, moments).0
    }

    /// [`Recipe::bake_moments`], and what became of the triangles of all moments: how many were skipped, lay outside the view, or
    /// lost a part, and with it its shadow, for standing too near to the light. Its `Display` is one line for people.
    pub fn bake_counted<'m, M>(&self, view: &View, moments: impl IntoIterator<Item = M>) -> (Map, Stats)
    where
        M: IntoIterator<Item: Into<Casting<'m>>>,
    {
        // Whatever triangles come as, all rules over them are compiled once, here.
        let mut moments = moments.into_iter().map(|casters| moment(casters.into_iter().map(Into::into)));
        self.values.bake(view, &mut moments)
    }

    /// The algorithm over a map.
    ///
    /// # Errors
    /// When the map records another surface than the recipe [expects](Self::expects): the comparison would be wrong everywhere, without a warning.
    pub fn bind(&self, map: impl Into<Map>, storage: Storage) -> Result<Box<dyn Shadow>, RecipeError> {
        self.bind_around(vec![map.into()], storage)
    }

    /// The algorithm over maps that stand around one light and see each another part, such as those of [`umbrage_plane::cube_views`]. Each point
    /// is looked up in the map whose axis is nearest to its direction, and regions cross from one map to the next. A single map is as in [`bind`](Self::bind).
    ///
    /// # Errors
    /// As [`bind`](Self::bind) for any of the maps; also for none, and for views that do not stand around one light.
    pub fn bind_around(&self, maps: Vec<Map>, storage: Storage) -> Result<Box<dyn Shadow>, RecipeError> {
        maps.iter().try_for_each(|map| self.check(map))?;
        self.values.bind(self.preset, maps.into_iter().map(|map| map.kept(storage)).collect())
    }

    /// Whether a map records what the recipe expects.
    fn check(&self, map: &Map) -> Result<(), RecipeError> {
        if self.preset == PresetName::Auto && map.facets().is_none() {
            let expected = "a map of facets, as auto bakes it (bind_any takes any map)";
            return Err(RecipeError::value("map", map.stored().name(), expected));
        }
        if let (PresetName::Auto, Some(radius)) = (self.preset, self.values.light) {
            let expected = "none over one map: shadow_of makes one for each of its points";
            return Err(RecipeError::value("light", &radius.to_string(), expected));
        }
        let (expected, found) = (self.expects(), map.stored());
        if expected.contains(&found) {
            return Ok(());
        }
        let names = kind::either(&expected.iter().map(|stored| stored.name()).collect::<Vec<_>>());
        let by = if self.names_stored { "the recipe's stored=" } else { self.preset.name() };
        let expected = format!("{names}, as {by} needs it (bind_any takes any map, and so does another stored=)");
        Err(RecipeError::value("map", found.name(), expected))
    }

    /// The algorithm over a map, whatever the map records: for unpublished combinations.
    #[expect(clippy::missing_panics_doc, reason = "a single map always fits")]
    pub fn bind_any(&self, map: impl Into<Map>, storage: Storage) -> Box<dyn Shadow> {
        let alone = self.values.bind(self.preset, vec![map.into().kept(storage)]);
        alone.expect("a single map need not fit to others")
    }
}
