//! A scene with one light, set up for a figure: its map, the picture with a method's shadow, and the truth beside it.

use super::memo::Memo;
use super::truths::{Baked, Rays, Seen};
use super::{sized, without_map};
use crate::figure::Context;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};
use umbrage_bake::bake;
use umbrage_depth::{DepthMap, First, Map, Raw, Storage, Tiled, quantise};
use umbrage_oracle::{AreaLight, Geometry, RayCast};
use umbrage_plane::{Kind, Sampling, View};
use umbrage_raster::Cull;
use umbrage_recipe::{LightShadow, PresetName, Recipe, bind};
use umbrage_render::{Frame, Picture, Sight, Soup, light_map, light_shadow, picture, rays_where, receivers};
use umbrage_scene::Scene;
use umbrage_shadow::{Filter, Shadow, Unshadowed};

/// A scene set up for one figure: camera and map sizes chosen.
///
/// What the camera sees, and light 0's maps, are made when they are first asked for, and kept. The camera may be changed afterwards; a scene of other objects or
/// another light is another set.
pub struct Set {
    pub scene: Scene,
    /// Whether its pictures are shaded; the colour of others is the background's all over.
    colours: bool,
    /// Whether its truths are.
    coloured_truths: bool,
    map: OnceLock<Arc<Tiled>>,
    /// By the camera; for every set of the scene.
    sights: Memo<(View, Frame), Sight>,
    /// By the camera that it is diced for.
    geometries: Memo<View, Geometry>,
    maps: Memo<Baked, Map>,
    lights: Memo<(View, Recipe, Storage), LightShadow>,
}

/// The most bytes that a light's maps may take to be kept: of an area light there are many.
const KEPT: usize = 32 << 20;
/// The most that a map of facets may take to be kept for the run.
const SMALL: usize = 1 << 20;

/// A light's shadow.
pub enum Lit {
    /// Over all that its recipe wants, which its set may keep.
    Whole(Arc<LightShadow>),
    /// Over one map, which its set keeps.
    Over(Box<dyn Shadow>),
}

impl Deref for Lit {
    type Target = dyn Shadow;

    fn deref(&self) -> &Self::Target {
        match self {
            Self::Whole(light) => &*light.shadow,
            Self::Over(shadow) => &**shadow,
        }
    }
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
        Self::of(scene)
    }

    /// A scene as it is.
    pub fn of(scene: Scene) -> Self {
        Self {
            scene,
            colours: false,
            coloured_truths: false,
            map: OnceLock::new(),
            sights: Memo::default(),
            geometries: Memo::default(),
            maps: Memo::default(),
            lights: Memo::default(),
        }
    }

    /// The same, whose pictures by maps are shaded. Most figures look at shadows alone.
    pub fn in_colour(self) -> Self {
        Self { colours: true, ..self }
    }

    /// The same, whose truths are shaded.
    pub fn with_coloured_truths(self) -> Self {
        Self { coloured_truths: true, ..self }
    }

    /// The same with another map of light 0.
    pub fn with_map(self, map: Arc<Tiled>) -> Self {
        Self { map: OnceLock::from(map), ..self }
    }

    /// The same scene seen by the same camera, of which another set may know something already, with `texels` across light 0's map.
    pub fn with_texels(&self, texels: u32) -> Self {
        let mut scene = self.scene.clone();
        scene.lights[0].view = sized(&scene.lights[0].view, texels);
        let (sights, geometries) = (self.sights.clone(), self.geometries.clone());
        Self { colours: self.colours, coloured_truths: self.coloured_truths, sights, geometries, ..Self::of(scene) }
    }

    /// Light 0's map of first depths.
    pub fn map(&self) -> &Arc<Tiled> {
        self.map.get_or_init(|| {
            let light = &self.scene.lights[0].view;
            bake(light, Soup::casters(&self.scene, light).triangles(), &First, Cull::None).map
        })
    }

    /// The map with depths rounded to integers of `bits` (W78-6); the light's view must be of screen depth.
    pub fn quantised(&self, bits: u32) -> Arc<Tiled> {
        Arc::new(Tiled::from(&quantise(&Raw::copy_of(self.map()), bits, false)))
    }

    /// The picture with light 0's shadow by `filter` over this set's map.
    pub fn shoot(&self, cx: &Context, filter: impl Filter + 'static, frame: &Frame) -> Picture {
        self.shoot_map(cx, filter, self.map(), frame)
    }

    /// The same over another map of the same light.
    pub fn shoot_map(&self, cx: &Context, filter: impl Filter + 'static, map: &Arc<Tiled>, frame: &Frame) -> Picture {
        let shadow = bind(filter, map, cx.storage);
        self.draw(cx, &*shadow, frame)
    }

    /// The picture with light 0's shadow by a recipe, over the map that the recipe wants.
    pub fn by(&self, cx: &Context, recipe: &str, frame: &Frame) -> anyhow::Result<Picture> {
        Ok(self.draw(cx, &*self.shadow(cx, recipe)?, frame))
    }

    /// Light 0's shadow by a recipe, over the map that the recipe wants.
    pub fn shadow(&self, cx: &Context, recipe: &str) -> anyhow::Result<Lit> {
        let recipe: Recipe = recipe.parse()?;
        if recipe.preset() == PresetName::Auto {
            return Ok(Lit::Whole(self.light(cx, &recipe)?));
        }
        // Many recipes look the same map up.
        let map = self.map_by(cx, &recipe.pass_1())?;
        Ok(Lit::Over(recipe.bind((*map).clone(), cx.storage)?))
    }

    /// Light 0's shadow by a recipe, and the maps that it took.
    pub fn light(&self, cx: &Context, recipe: &Recipe) -> anyhow::Result<Arc<LightShadow>> {
        let view = self.scene.lights[0].view;
        let asked = (view, *recipe, cx.storage);
        if let Some(known) = self.lights.known(&asked) {
            return Ok(known);
        }
        let light = Arc::new(light_shadow(recipe, &[&self.scene], &view, cx.storage)?);
        if light.maps.iter().map(|map| map.bytes).sum::<usize>() <= KEPT {
            self.lights.keep(asked, &light);
        }
        Ok(light)
    }

    /// The one map of light 0 by a recipe that wants no more, fitted to what the camera sees where the recipe says so.
    pub fn map_by(&self, cx: &Context, recipe: &Recipe) -> anyhow::Result<Arc<Map>> {
        let Scene { name, lights, camera, .. } = &self.scene;
        let view = lights[0].view;
        let baked = Baked { scene: name.clone(), light: view, camera: *camera, recipe: *recipe };
        if let Some(known) = self.maps.known(&baked).or_else(|| cx.truths.maps.known(&baked)) {
            return Ok(known);
        }
        let fitted = if recipe.is_fitted() { view.fitted(receivers(&self.scene, &view))? } else { view };
        let map = Arc::new(light_map(recipe, &self.scene, &fitted));
        self.maps.keep(baked.clone(), &map);
        // Refined maps are small, and take long to make.
        if map.facets().is_some() && map.allocated() <= SMALL {
            cx.truths.maps.keep(baked, &map);
        }
        Ok(map)
    }

    /// The picture without any shadow.
    pub fn plain(&self, cx: &Context, frame: &Frame) -> Picture {
        self.draw(cx, &Unshadowed, frame)
    }

    /// The picture with any shadow.
    pub fn draw(&self, cx: &Context, shadow: &dyn Shadow, frame: &Frame) -> Picture {
        let frame = Frame { seed: cx.seed, ..*frame };
        // There would be too much of every sample.
        if frame.every_sample {
            return picture(&self.scene, &[shadow], &frame);
        }
        let sight = self.sight(&frame);
        if self.colours { sight.picture(&self.scene, &[shadow]) } else { sight.shadows(&self.scene, &[shadow]) }
    }

    fn sight(&self, frame: &Frame) -> Arc<Sight> {
        self.sights.once((self.scene.camera, *frame), || Sight::new(&self.scene, frame))
    }

    /// The picture by rays, which look at no point's extent.
    pub fn draw_rays(&self, cx: &Context, rays: &dyn Shadow, frame: &Frame) -> Picture {
        let frame = Frame { seed: cx.seed, ..*frame };
        match (frame.every_sample, self.coloured_truths) {
            (true, true) => picture(&self.scene, &[rays], &frame),
            (true, false) => rays_where(&self.scene, &[rays], &frame, |_| true),
            (false, true) => self.sight(&frame).picture(&self.scene, &[rays]),
            (false, false) => self.sight(&frame).shadows(&self.scene, &[rays]),
        }
    }

    /// Rays at the very points at which a method is looked up: one hard result per region.
    pub fn truth_points(&self, cx: &Context, frame: &Frame) -> Arc<Picture> {
        self.ray_cast(cx, frame)
    }

    /// Rays from 64 samples per pixel: what an area-sampled picture should be. 16 in a quick run.
    pub fn truth(&self, cx: &Context) -> Arc<Picture> {
        let axis = cx.pick(8, 4);
        self.ray_cast(cx, &Frame { axis, stochastic: true, every_sample: true, ..Frame::default() })
    }

    /// Rays to all of a disc in light 0's place, as the figures of soft shadows see it: one soft result per region.
    pub fn truth_disc(&self, cx: &Context, frame: &Frame, radius: f64) -> Arc<Picture> {
        let rays = Rays::Disc { radius, samples: disc_samples(cx) };
        self.traced(cx, frame, rays, |geometry| Box::new(self.disc_light(cx, geometry, radius)))
    }

    /// Rays to a disc in light 0's place; `radius` in world units, or the tangent of its angle when the light is
    /// directional. 256 rays per point, 64 in a quick run.
    pub fn disc_light<'a>(&self, cx: &Context, geometry: &'a Geometry, radius: f64) -> AreaLight<'a> {
        AreaLight::new(RayCast::new(geometry, &self.scene.lights[0].view), radius).with_samples(disc_samples(cx))
    }

    fn ray_cast(&self, cx: &Context, frame: &Frame) -> Arc<Picture> {
        self.traced(cx, frame, Rays::Hard, |geometry| Box::new(RayCast::new(geometry, &self.scene.lights[0].view)))
    }

    /// The picture by rays, made once per run.
    fn traced(
        &self,
        cx: &Context,
        frame: &Frame,
        rays: Rays,
        shadow: impl for<'a> Fn(&'a Geometry) -> Box<dyn Shadow + 'a>,
    ) -> Arc<Picture> {
        let frame = Frame { seed: cx.seed, ..*frame };
        let seen = self.seen(frame, rays);
        // A shaded one has the shadows of the other.
        if let Some(known) = cx.truths.pictures.known(&(seen.clone(), true)) {
            return known;
        }
        cx.truths.pictures.once((seen, self.coloured_truths), || {
            let geometry = self.geometry();
            self.draw_rays(cx, &*shadow(&geometry), &frame)
        })
    }

    /// All that rays of its truths meet.
    pub fn geometry(&self) -> Arc<Geometry> {
        let camera = self.scene.camera;
        self.geometries.once(camera, || Geometry::new(&self.scene, &camera))
    }

    /// What a truth of it depends on.
    pub fn seen(&self, frame: Frame, rays: Rays) -> Seen {
        let Scene { name, lights, camera, .. } = &self.scene;
        // Nor does it matter in which kind of depth a map would be, or where its texels would be sampled.
        let light = without_map(&lights[0].view).with_kind(Kind::Axial).with_sampling(Sampling::Centre);
        Seen { scene: name.clone(), light, camera: *camera, frame, rays }
    }
}

/// Rays to each point's disc light.
fn disc_samples(cx: &Context) -> u32 {
    cx.pick(256, 64)
}

/// The same scene with its light in another kind of depth.
pub fn with_kind(mut scene: Scene, kind: Kind) -> Scene {
    scene.lights[0].view = scene.lights[0].view.with_kind(kind);
    scene
}
