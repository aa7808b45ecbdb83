//! What the figures share: baking a light, drawing a scene with a filter, the truth beside it, and masks.

use crate::figure::{Context, Made, Panel, Role};
use glam::{DVec2, UVec2, Vec3};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock};
use umbrage_bake::bake;
use umbrage_depth::{First, Raw, Tiled, quantise};
use umbrage_oracle::metrics::{self, Grid};
use umbrage_oracle::{AreaLight, Diagnostic, Geometry, Plan, RayCast, Truth, diagnose, heat};
use umbrage_plane::{Kind, Sampling, SurfacePoint, View};
use umbrage_raster::Cull;
use umbrage_render::{Frame, Map, NOTHING, Picture, Recipe, Soup, bind, bind_lights, light_maps, picture};
use umbrage_scene::{Light, Scene};
use umbrage_shadow::{Filter, Shadow, Unshadowed};

/// A scene set up for one figure: camera and map sizes chosen, light 0 baked.
pub struct Set {
    pub scene: Scene,
    pub map: Tiled,
}

impl Set {
    /// `pixels` across the camera's picture, `texels` across light 0's map, depth of its view's own kind.
    pub fn new(scene: Scene, pixels: u32, texels: u32) -> Self {
        Self::sampled(scene, pixels, texels, Sampling::Centre)
    }

    /// The same with the map sampled elsewhere in its texels.
    pub fn sampled(mut scene: Scene, pixels: u32, texels: u32, sampling: Sampling) -> Self {
        scene.camera = sized(&scene.camera, pixels);
        scene.lights[0].view = sized(&scene.lights[0].view, texels).with_sampling(sampling);
        let light = scene.lights[0].view;
        let map = bake(&light, Soup::casters(&scene, &light).triangles(), &First, Cull::None).map;
        Self { scene, map }
    }

    /// The map with depths rounded to integers of `bits` (W78-6); the light's view must be of screen depth.
    pub fn quantised(&self, bits: u32) -> Tiled {
        Tiled::from(&quantise(&Raw::from(&self.map), bits, false))
    }

    /// The picture with light 0's shadow by `filter` over this set's map.
    pub fn shoot(&self, cx: &Context, filter: impl Filter + 'static, frame: &Frame) -> Picture {
        self.shoot_map(cx, filter, &self.map, frame)
    }

    /// The same over another map of the same light.
    pub fn shoot_map(&self, cx: &Context, filter: impl Filter + 'static, map: &Tiled, frame: &Frame) -> Picture {
        let shadow = bind(filter, map, cx.storage);
        self.draw(cx, &*shadow, frame)
    }

    /// The picture with light 0's shadow by a recipe, over the map that the recipe wants.
    pub fn by(&self, cx: &Context, recipe: &str, frame: &Frame) -> anyhow::Result<Picture> {
        Ok(self.draw(cx, &*self.shadow(cx, recipe)?, frame))
    }

    /// Light 0's shadow by a recipe, over the map that the recipe wants.
    pub fn shadow(&self, cx: &Context, recipe: &str) -> anyhow::Result<Box<dyn Shadow>> {
        let recipe: Recipe = recipe.parse()?;
        let map = recipe.bake(&self.scene, &self.scene.lights[0].view);
        Ok(recipe.bind(map, cx.storage))
    }

    /// The picture without any shadow.
    pub fn plain(&self, cx: &Context, frame: &Frame) -> Picture {
        self.draw(cx, &Unshadowed, frame)
    }

    /// The picture with any shadow.
    pub fn draw(&self, cx: &Context, shadow: &dyn Shadow, frame: &Frame) -> Picture {
        picture(&self.scene, &[shadow], &Frame { seed: cx.seed, ..*frame })
    }

    /// Rays at the very points that a method is asked at: one hard answer per region.
    pub fn truth_points(&self, cx: &Context, frame: &Frame) -> Arc<Picture> {
        self.ray_cast(cx, frame, "points")
    }

    /// Rays from 64 samples a pixel: what an area-sampled picture should be. 16 in a quick run.
    pub fn truth(&self, cx: &Context) -> Arc<Picture> {
        let axis = if cx.quick { 4 } else { 8 };
        self.ray_cast(cx, &Frame { axis, stochastic: true, every_sample: true, ..Frame::default() }, "area")
    }

    /// Rays to all of a disc in light 0's place, as the figures of soft shadows see it: one soft answer per region.
    pub fn truth_disc(&self, cx: &Context, frame: &Frame, radius: f64) -> Arc<Picture> {
        self.traced(cx, frame, &format!("disc {radius}"), |geometry| Box::new(self.disc_light(cx, geometry, radius)))
    }

    /// Rays to a disc in light 0's place; `radius` in world units, or the tangent of its angle when the light is
    /// directional. 256 a point, 64 in a quick run.
    pub fn disc_light<'a>(&self, cx: &Context, geometry: &'a Geometry, radius: f64) -> AreaLight<'a> {
        AreaLight::new(RayCast::new(geometry, &self.scene.lights[0].view), radius).with_samples(cx.pick(256, 64))
    }

    fn ray_cast(&self, cx: &Context, frame: &Frame, what: &str) -> Arc<Picture> {
        self.traced(cx, frame, what, |geometry| Box::new(RayCast::new(geometry, &self.scene.lights[0].view)))
    }

    /// Truth depends on scene, camera, frame and the kind of light alone: it is made once per run.
    fn traced(
        &self,
        cx: &Context,
        frame: &Frame,
        what: &str,
        rays: impl for<'a> Fn(&'a Geometry) -> Box<dyn Shadow + 'a>,
    ) -> Arc<Picture> {
        static MADE: OnceLock<Mutex<HashMap<String, Arc<Picture>>>> = OnceLock::new();
        let frame = Frame { seed: cx.seed, ..*frame };
        let Scene { name, lights, camera, .. } = &self.scene;
        // Where the light stands counts, not how finely its map is cut.
        let light = sized(&lights[0].view, 1);
        let name = format!("{name} {what} {light:?} {camera:?} {frame:?}");
        let made = MADE.get_or_init(Mutex::default);
        if let Some(known) = made.lock().ok().and_then(|made| made.get(&name).cloned()) {
            return known;
        }
        let geometry = Geometry::new(&self.scene, &self.scene.camera);
        let truth = Arc::new(picture(&self.scene, &[&*rays(&geometry)], &frame));
        if let Ok(mut made) = made.lock() {
            made.insert(name, truth.clone());
        }
        truth
    }
}

/// A scene of several lights: each has its map, and its shadow by the recipe of its own tree or by the figure's.
pub struct Stage {
    pub scene: Scene,
    pub maps: Vec<Option<Map>>,
}

impl Stage {
    /// `pixels` across the camera's picture; the lights' maps keep their sizes, divided by `coarser`.
    pub fn new(mut scene: Scene, pixels: u32, coarser: u32) -> anyhow::Result<Self> {
        scene.camera = sized(&scene.camera, pixels);
        for light in &mut scene.lights {
            light.view = sized(&light.view, (light.view.size().x / coarser).max(1));
        }
        let maps = light_maps(&scene, &"reeves87".parse()?)?;
        Ok(Self { scene, maps })
    }

    /// The picture with every light's shadow.
    pub fn shoot(&self, cx: &Context, recipe: &str, frame: &Frame) -> anyhow::Result<Picture> {
        let shadows = bind_lights(&self.scene, &self.maps, &recipe.parse()?, cx.storage)?;
        Ok(self.draw(cx, &shadows, frame))
    }

    /// What is known to go wrong with the casting lights, for the reader of the figure (W78-8, W78-9, WM94-14).
    pub fn warnings(&self) -> String {
        let mut lines = Vec::new();
        for light in &self.scene.lights {
            let mut outside = Vec::new();
            for found in diagnose(&self.scene, light, &Plan::default()) {
                match found {
                    Diagnostic::CasterOutside { object, .. } => outside.push(object),
                    other => lines.push(format!("Warning: {other}.")),
                }
            }
            if let [first, rest @ ..] = outside.as_slice() {
                let others = if rest.is_empty() { String::new() } else { format!(" and {} more", rest.len()) };
                lines.push(format!(
                    "Warning: light {:?} does not see all of {first:?}{others}: shadows end where its view does.",
                    light.name
                ));
            }
        }
        lines.join(" ")
    }

    /// The picture without any shadow.
    pub fn plain(&self, cx: &Context, frame: &Frame) -> Picture {
        picture(&self.scene, &[], &Frame { seed: cx.seed, ..*frame })
    }

    /// Rays instead of maps, for the lights that cast; what is left out of the maps blocks no light.
    pub fn truth(&self, cx: &Context, frame: &Frame) -> Picture {
        let geometry = Geometry::new(&self.scene, &self.scene.camera);
        // Regions are asked at their middles, which lie a little beside finely cut surfaces.
        let truth = Truth { casters_only: true, own_slack: 0.1, ..Truth::default() };
        let ray = |light: &Light| -> Box<dyn Shadow + '_> {
            if light.casts { Box::new(RayCast::new(&geometry, &light.view).with(truth)) } else { Box::new(Unshadowed) }
        };
        let shadows: Vec<Box<dyn Shadow + '_>> = self.scene.lights.iter().map(ray).collect();
        let shadows: Vec<&dyn Shadow> = shadows.iter().map(AsRef::as_ref).collect();
        picture(&self.scene, &shadows, &Frame { seed: cx.seed, ..*frame })
    }

    fn draw(&self, cx: &Context, shadows: &[Box<dyn Shadow>], frame: &Frame) -> Picture {
        let shadows: Vec<&dyn Shadow> = shadows.iter().map(AsRef::as_ref).collect();
        picture(&self.scene, &shadows, &Frame { seed: cx.seed, ..*frame })
    }
}

fn sized(view: &View, across: u32) -> View {
    let size = view.size();
    let height = (u64::from(across) * u64::from(size.y) / u64::from(size.x.max(1))).max(1) as u32;
    view.with_size(UVec2::new(across, height)).unwrap_or(*view)
}

/// The same scene with its light in another kind of depth.
pub fn with_kind(mut scene: Scene, kind: Kind) -> Scene {
    scene.lights[0].view = scene.lights[0].view.with_kind(kind);
    scene
}

/// Pixels of one surface where metric M2 looks: wholly lit in truth, `border` pixels away from any shadow, facing the
/// light by more than .05, and of an object that `keep` accepts.
pub fn lit(truth: &Picture, border: usize, keep: impl Fn(u32) -> bool) -> Vec<bool> {
    let lit = metrics::lit_mask(shadow_grid(truth), &truth.facing[0], border, 0.05);
    metrics::both(&lit, &of(truth, keep))
}

/// False shadow over what `keep` accepts (M2), `border` pixels away from truth's shadows.
pub fn acne(picture: &Picture, truth: &Picture, border: usize, keep: impl Fn(u32) -> bool) -> f64 {
    value(metrics::false_shadow(&picture.shadow[0], &lit(truth, border, keep)))
}

/// Light where truth says shadowed, on surfaces that face the light by more than .05 (M8), `border` pixels away from truth's light.
pub fn leak(picture: &Picture, truth: &Picture, border: usize) -> f64 {
    let dark = metrics::dark_mask(shadow_grid(truth), &truth.facing[0], border, 0.05);
    value(metrics::leak(&picture.shadow[0], &metrics::both(&dark, &of(truth, |_| true))))
}

/// What a picture's pixels see, as points; a pixel that sees nothing is left out.
pub fn points_of(picture: &Picture) -> Vec<SurfacePoint> {
    let seen = (0..picture.object.len()).filter(|&i| picture.object[i] != NOTHING);
    seen.map(|i| {
        let point = SurfacePoint::at(picture.position[i], picture.normal[i]);
        SurfacePoint { region: i as u32, object: picture.object[i], ..point }
    })
    .collect()
}

/// Pixels wholly covered by an object that `keep` accepts.
pub fn of(picture: &Picture, keep: impl Fn(u32) -> bool) -> Vec<bool> {
    picture.object.iter().zip(&picture.share).map(|(&object, &share)| share == 1.0 && keep(object)).collect()
}

/// The shadow of light 0 as a metric's image.
pub fn shadow_grid(picture: &Picture) -> Grid<'_> {
    Grid::new(&picture.shadow[0], picture.size.x as usize)
}

/// A measure's value, NaN where there was nothing to measure: it meets no bound.
pub fn value(measured: Option<f64>) -> f64 {
    measured.unwrap_or(f64::NAN)
}

/// The shadow component as one looks at it: light where lit.
pub fn shadow_panel(name: &str, caption: &str, picture: &Picture) -> Panel {
    shadow_image_panel(name, caption, picture.size, &picture.shadow[0])
}

/// The same of a bare shadow image.
pub fn shadow_image_panel(name: &str, caption: &str, size: UVec2, shadow: &[f32]) -> Panel {
    Panel::grey(name, caption, size, shadow.iter().map(|s| 1.0 - s).collect())
}

/// The truth's panel of a figure.
pub fn truth_panel(truth: &Picture) -> Panel {
    shadow_panel("truth", "Ray-traced truth", truth).role(Role::Truth)
}

/// A method's shadow with one parameter under it, and its error beside it.
pub fn shadow_and_error(
    made: &mut Made,
    (name, caption): (&str, &str),
    (parameter, value): (&str, &str),
    picture: &Picture,
    truth: &Picture,
) {
    made.panels.push(shadow_panel(name, caption, picture).with(parameter, value).against("truth"));
    let (own, exact) = (&picture.shadow[0], &truth.shadow[0]);
    made.panels.push(error_panel(
        &format!("{name}-error"),
        &format!("{caption}: less truth"),
        picture.size,
        own,
        exact,
    ));
}

/// Result less truth as colours.
pub fn error_panel(name: &str, caption: &str, size: UVec2, result: &[f32], truth: &[f32]) -> Panel {
    let pixels = result.iter().zip(truth).map(|(r, t)| heat(r - t)).collect();
    Panel::rgb(name, caption, size, pixels).role(Role::Error)
}

/// A square window of a picture about a fraction of its size, enlarged.
pub fn zoomed(name: &str, caption: &str, picture: &Picture, centre: DVec2, part: u32) -> Panel {
    let (from, window, zoom) = window(picture, centre, part);
    let (size, shadow) = crop(picture.size, &picture.shadow[0], from, window);
    shadow_image_panel(name, caption, size, &shadow).zoom(zoom)
}

/// The same window of result less truth as colours.
pub fn zoomed_error(name: &str, caption: &str, picture: &Picture, truth: &Picture, centre: DVec2, part: u32) -> Panel {
    let (from, window, zoom) = window(picture, centre, part);
    let (size, ours) = crop(picture.size, &picture.shadow[0], from, window);
    let (_, exact) = crop(truth.size, &truth.shadow[0], from, window);
    error_panel(name, caption, size, &ours, &exact).zoom(zoom)
}

/// Corner and size of a square window about a fraction of a picture's size, and how often its pixels are repeated.
fn window(picture: &Picture, centre: DVec2, part: u32) -> (UVec2, UVec2, u32) {
    let side = picture.size.x / part;
    let from = (centre * picture.size.as_dvec2()).as_uvec2().saturating_sub(UVec2::splat(side / 2));
    (from, UVec2::splat(side), (384 / side.max(1)).max(1))
}

/// Cuts a window out of an image; what lies outside is left out.
fn crop<T: Copy>(size: UVec2, image: &[T], from: UVec2, window: UVec2) -> (UVec2, Vec<T>) {
    let window = window.min(size.saturating_sub(from));
    let rows = (from.y..from.y + window.y)
        .flat_map(|y| (from.x..from.x + window.x).map(move |x| image[(y * size.x + x) as usize]));
    (window, rows.collect())
}

/// Linear grey for a colour picture's panel.
pub fn colour_panel(name: &str, caption: &str, size: UVec2, pixels: &[Vec3]) -> Panel {
    Panel::rgb(name, caption, size, pixels.to_vec())
}
