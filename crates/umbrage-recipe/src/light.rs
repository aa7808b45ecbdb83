//! A light's shadow by a recipe: the views that it needs maps of, the maps, and the algorithm over them.

use crate::values::{Values, Window};
use crate::{PresetName, Recipe, RecipeError};
use std::cell::Cell;
use std::fmt;
use umbrage_bake::Casting;
use umbrage_depth::{DepthMap, Map, Storage};
use umbrage_plane::View;
use umbrage_plane::glam::{DVec3, Vec3};
use umbrage_raster::{IndexedMesh, Stats};
use umbrage_shadow::{Bounded, Mean, Shadow, Through};

/// Cosine of the half-angle beyond which a spot light gets several views: 70°.
const WIDE: f64 = 0.342_020_143_325_668_7;

/// Fewest and most points of an area light, where their number is not given.
const FEWEST_POINTS: u32 = 16;
const MOST_POINTS: u32 = 64;

/// What a light's maps are made for, besides its view.
#[derive(Clone, Copy, Debug, Default)]
pub struct LightUse<'a> {
    /// How maps of one depth per texel are kept.
    pub storage: Storage,
    /// Points of the world that will be shaded: what the camera sees. `window=fitted` fits the maps to them. `None` where they are
    /// not known.
    pub receivers: Option<&'a [DVec3]>,
    /// Evenly spread times at which casters are wanted; 0 counts as 1.
    pub moments: u32,
}

/// A light's shadow, and what it took.
pub struct LightShadow {
    /// The shadow.
    pub shadow: Box<dyn Shadow>,
    /// Its maps, in the order in which they were made.
    pub maps: Vec<LightMap>,
    /// What became of the triangles, all maps together.
    pub stats: Stats,
}

/// One map of a light's shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightMap {
    /// Its view.
    pub view: View,
    /// What it stores.
    pub keeps: Keeps,
    /// All that it holds, bytes.
    pub bytes: usize,
}

/// What a map stores of its texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keeps {
    /// One depth, perhaps with moments of the depths around it.
    Depths,
    /// The facet that is seen.
    Facets,
    /// All surfaces, and what passes them.
    Deep,
}

impl fmt::Display for LightShadow {
    /// One line for people: how many maps of what, and their bytes.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kinds = [
            (Keeps::Depths, "of depths"),
            (Keeps::Facets, "of facets"),
            (Keeps::Deep, "of all surfaces, for casters that let light pass"),
        ];
        for (keeps, name) in kinds {
            let count = self.maps.iter().filter(|map| map.keeps == keeps).count();
            if count > 0 {
                write!(f, "{count} map{} {name}, ", if count == 1 { "" } else { "s" })?;
            }
        }
        write!(f, "{} bytes", self.maps.iter().map(|map| map.bytes).sum::<usize>())
    }
}

impl fmt::Debug for LightShadow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LightShadow").field("maps", &self.maps).field("stats", &self.stats).finish_non_exhaustive()
    }
}

impl Recipe {
    /// Most points of a light at which [`shadow_of`](Self::shadow_of) makes maps: one, unless the default is given the size of the light.
    #[must_use]
    pub fn most_points(&self) -> u32 {
        match (self.preset, self.values.light) {
            (PresetName::Auto, Some(_)) => self.values.maps.unwrap_or(MOST_POINTS),
            _ => 1,
        }
    }

    /// All of pass 1 of a light, and the algorithm over it: a map for each view that the recipe needs. `views` are the light's own view, or several that stand
    /// at one place and see each another part ([`umbrage_plane::cube_views`]), across whose borders filters go on. `casters` gives the triangles for a view at
    /// one of the moments; it
    /// is called for each map, and again where some of them let light pass.
    ///
    /// `auto` adapts to the light:
    /// * a spot of a half-angle above 70° has [several maps](View::faces_ahead) instead of one;
    /// * with `light=`, the mean of maps at points of the light: [of a disc](View::over_disc) where it has one view, [of a
    ///   sphere](View::over_sphere) where it has several;
    /// * over several moments, the mean of maps of each;
    /// * casters that let light pass are kept in a deep map, the others in a map of facets, and light passes [through both](Through).
    ///
    /// Other recipes make one map for each view, in which moments are mixed ([`Recipe::bake_moments`]).
    ///
    /// ```
    /// use glam::{DVec3, UVec2, Vec3};
    /// use umbrage_plane::{SpotView, SurfacePoint, View};
    /// use umbrage_raster::Triangle;
    /// use umbrage_recipe::{LightUse, Recipe};
    /// use umbrage_sample::Key;
    ///
    /// // A lamp ten units above a floor, and a square board halfway.
    /// let eye = DVec3::Y * 10.0;
    /// let lamp = View::spot(SpotView { eye, size: UVec2::splat(128), target: DVec3::ZERO, ..SpotView::default() })?;
    /// let corner = |x: f64, z: f64| DVec3::new(x, 5.0, z);
    /// let board = [(corner(1.0, -1.0), 0), (corner(-1.0, 1.0), 0)];
    /// let board = board.map(|(third, object)| Triangle { corners: [corner(-1.0, -1.0), corner(1.0, 1.0), third], object, sheet: true });
    /// let light = Recipe::default().shadow_of(&[lamp], &LightUse::default(), |_, _| board)?;
    /// assert_eq!(light.shadow.fraction(&SurfacePoint::at(Vec3::new(1.9, 0.0, 0.0), Vec3::Y), Key::new(0, 0, 0)), 1.0);
    /// assert_eq!(light.maps.len(), 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// When no view is given; when `window=fitted` knows no receivers; when no view can stand at a point of the light;
    /// and when views around one light do not belong together.
    pub fn shadow_of<'a, I>(
        &self,
        views: &[View],
        with: &LightUse<'_>,
        mut casters: impl FnMut(&View, u32) -> I,
    ) -> Result<LightShadow, RecipeError>
    where
        I: IntoIterator<Item: Into<Casting<'a>>>,
    {
        let Values { window, light, .. } = self.values;
        let auto = self.preset == PresetName::Auto;
        let light = light.filter(|_| auto);
        let [first, others @ ..] = views else {
            return Err(RecipeError::value("views", "none", "the view of a light"));
        };
        if window == Window::Fitted && with.receivers.is_none() {
            return Err(RecipeError::value(
                "window",
                "fitted",
                "given, where it is not known which points will be looked up",
            ));
        }
        let fitted = |view: View| match with.receivers {
            Some(points) if window == Window::Fitted => {
                view.fitted(points.iter().copied()).map_err(|error| of_view("window", "fitted", &error))
            }
            _ => Ok(view),
        };
        let moments = with.moments.max(1);
        let mut made = Made { recipe: self, storage: with.storage, maps: Vec::new(), stats: Stats::default() };
        if !auto {
            let mut maps = Vec::new();
            for view in views {
                let view = fitted(*view)?;
                let (map, stats) = self.bake_counted(&view, (0..moments).map(|moment| casters(&view, moment)));
                made.stats += stats;
                maps.push(made.kept(self.values.moments.over(self.preset, map)));
            }
            return Ok(made.finish(self.values.bind(self.preset, maps)?));
        }
        let wide = |view: &View| view.is_perspective() && view.cone().is_some_and(|cos_half| cos_half < WIDE);
        let split = others.is_empty() && wide(first);
        let several = |view: View| -> Result<Vec<View>, RecipeError> {
            if split {
                view.faces_ahead().map(Vec::from).map_err(|error| of_view("light", "wide", &error))
            } else {
                Ok(vec![view])
            }
        };
        // The views of each point of the light.
        let points = match light {
            None if others.is_empty() => vec![several(*first)?],
            None => vec![views.to_vec()],
            Some(radius) => {
                let mut count = self.values.maps.unwrap_or_default();
                if self.values.maps.is_none() {
                    for view in views {
                        let view = fitted(*view)?;
                        let casters = casters(&view, 0).into_iter().map(Into::into);
                        count = count.max(points_of(&view, radius, casters, with.receivers));
                    }
                }
                let of_light = |error| of_view("light", &radius.to_string(), &error);
                let radius = f64::from(radius);
                if others.is_empty() {
                    let disc = first.over_disc(radius, count).map_err(of_light)?;
                    disc.into_iter().map(several).collect::<Result<_, _>>()?
                } else {
                    let spheres = views.iter().map(|view| view.over_sphere(radius, count));
                    let spheres = spheres.collect::<Result<Vec<_>, _>>().map_err(of_light)?;
                    (0..count as usize).map(|point| spheres.iter().map(|views| views[point]).collect()).collect()
                }
            }
        };
        let mut all = Vec::new();
        for faces in points {
            let faces = faces.into_iter().map(fitted).collect::<Result<Vec<_>, _>>()?;
            for moment in 0..moments {
                all.push(made.over(&faces, |view| casters(view, moment))?);
            }
        }
        let one = if all.len() == 1 { all.pop() } else { None };
        let shadow = one.unwrap_or_else(|| Box::new(Mean(all)));
        if split || (light.is_some() && others.is_empty()) {
            return Ok(made.finish(Box::new(Bounded { view: *first, by_cone: split, shadow })));
        }
        Ok(made.finish(shadow))
    }
}

/// Maps as they are made.
struct Made<'a> {
    recipe: &'a Recipe,
    storage: Storage,
    maps: Vec<LightMap>,
    stats: Stats,
}

impl Made<'_> {
    fn finish(self, shadow: Box<dyn Shadow>) -> LightShadow {
        LightShadow { shadow, maps: self.maps, stats: self.stats }
    }

    /// Takes a map into the list.
    fn kept(&mut self, map: Map) -> Map {
        let map = map.kept(self.storage);
        let keeps = match &map {
            Map::Facets(_) => Keeps::Facets,
            Map::Deep(_) => Keeps::Deep,
            _ => Keeps::Depths,
        };
        self.maps.push(LightMap { view: *map.view(), keeps, bytes: map.allocated() });
        map
    }

    /// The default over the maps of several views of one moment.
    fn over<'a, I>(
        &mut self,
        views: &[View],
        mut casters: impl FnMut(&View) -> I,
    ) -> Result<Box<dyn Shadow>, RecipeError>
    where
        I: IntoIterator<Item: Into<Casting<'a>>>,
    {
        let passing = Cell::new(false);
        let mut pass = |made: &mut Self, recipe: &Recipe, transparent: bool| {
            let mut maps = Vec::new();
            for view in views {
                let left_out = Cell::new(0);
                // What is left out stays as triangles of no area, so that masks are evaluated for the triangles that they belong to.
                let wanted = |casting: Casting<'a>| {
                    let passes = casting.is_transparent();
                    passing.set(passing.get() || passes);
                    if passes == transparent {
                        return casting;
                    }
                    left_out.set(left_out.get() + casting.count() as u64);
                    let nothing = vec![[0; 3]; casting.count()];
                    IndexedMesh::new(DVec3::ZERO, vec![Vec3::ZERO], nothing, 0, false).into()
                };
                let casters = casters(view).into_iter().map(Into::into).map(wanted);
                let (map, stats) = recipe.bake_counted(view, [casters]);
                let left_out = left_out.get();
                made.stats += Stats { given: stats.given - left_out, zero_area: stats.zero_area - left_out, ..stats };
                maps.push(made.kept(map));
            }
            recipe.values.bind(PresetName::Auto, maps)
        };
        let opaque = pass(self, self.recipe, false)?;
        if !passing.get() {
            return Ok(opaque);
        }
        let deep = Recipe { values: self.recipe.values.deep(), ..*self.recipe };
        let transparent = pass(self, &deep, true)?;
        Ok(Box::new(Through(vec![opaque, transparent])))
    }
}

/// The number of points that stand for an area light: one for every texel of its widest penumbra, which is that of the nearest caster on the farthest
/// receiver.
fn points_of<'a>(
    view: &View,
    radius: f32,
    casters: impl Iterator<Item = Casting<'a>>,
    receivers: Option<&[DVec3]>,
) -> u32 {
    let zeta = |at: &DVec3| -view.world_to_eye().transform_point3(*at).z;
    let (mut nearest, mut farthest) = (f64::INFINITY, f64::NEG_INFINITY);
    for casting in casters {
        // What is beside or behind the light blocks none of what goes ahead.
        let corners = casting.triangles().flat_map(|triangle| triangle.corners);
        for zeta in corners.map(|corner| zeta(&corner)).filter(|zeta| *zeta > 0.0) {
            (nearest, farthest) = (nearest.min(zeta), farthest.max(zeta));
        }
    }
    if let Some(receivers) = receivers.filter(|receivers| !receivers.is_empty()) {
        farthest = receivers.iter().map(zeta).fold(f64::NEG_INFINITY, f64::max);
    }
    let nearest = nearest.max(view.near());
    let spread = if view.is_perspective() { (farthest - nearest) / nearest } else { farthest - nearest };
    let texels = 2.0 * f64::from(radius) * spread / view.texel_world(farthest).min_element();
    // NaN and nothing at all are the fewest.
    ((texels.max(0.0) as u32).min(MOST_POINTS)).next_power_of_two().clamp(FEWEST_POINTS, MOST_POINTS)
}

fn of_view(field: &str, value: &str, error: &dyn fmt::Display) -> RecipeError {
    RecipeError::value(field, value, format!("a light that has such views: {error}"))
}
