//! A scene with one light, set up for a figure: its map, the picture with a method's shadow, and the truth beside it.

use super::truths::{Rays, Seen};
use crate::figure::Context;
use glam::UVec2;
use std::sync::Arc;
use umbrage_bake::bake;
use umbrage_depth::{First, Raw, Tiled, quantise};
use umbrage_oracle::{AreaLight, Geometry, RayCast};
use umbrage_plane::{Kind, Sampling, View};
use umbrage_raster::Cull;
use umbrage_recipe::{LightShadow, Recipe, bind};
use umbrage_render::{Frame, Picture, Soup, light_shadow, picture};
use umbrage_scene::Scene;
use umbrage_shadow::{Filter, Shadow, Unshadowed};

/// A scene set up for one figure: camera and map sizes chosen, light 0 baked.
pub struct Set {
    pub scene: Scene,
    pub map: Arc<Tiled>,
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
    pub fn quantised(&self, bits: u32) -> Arc<Tiled> {
        Arc::new(Tiled::from(&quantise(&Raw::copy_of(&self.map), bits, false)))
    }

    /// The picture with light 0's shadow by `filter` over this set's map.
    pub fn shoot(&self, cx: &Context, filter: impl Filter + 'static, frame: &Frame) -> Picture {
        self.shoot_map(cx, filter, &self.map, frame)
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
    pub fn shadow(&self, cx: &Context, recipe: &str) -> anyhow::Result<Box<dyn Shadow>> {
        let recipe: Recipe = recipe.parse()?;
        Ok(self.light(cx, &recipe)?.shadow)
    }

    /// Light 0's shadow by a recipe, and the maps that it took.
    pub fn light(&self, cx: &Context, recipe: &Recipe) -> anyhow::Result<LightShadow> {
        Ok(light_shadow(recipe, &[&self.scene], &self.scene.lights[0].view, cx.storage)?)
    }

    /// The picture without any shadow.
    pub fn plain(&self, cx: &Context, frame: &Frame) -> Picture {
        self.draw(cx, &Unshadowed, frame)
    }

    /// The picture with any shadow.
    pub fn draw(&self, cx: &Context, shadow: &dyn Shadow, frame: &Frame) -> Picture {
        picture(&self.scene, &[shadow], &Frame { seed: cx.seed, ..*frame })
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
        let Scene { name, lights, camera, .. } = &self.scene;
        // The light's place matters, not its map's resolution.
        let light = sized(&lights[0].view, 1);
        let seen = Seen { scene: name.clone(), light, camera: *camera, frame, rays };
        cx.truths.once(seen, || {
            let geometry = Geometry::new(&self.scene, &self.scene.camera);
            picture(&self.scene, &[&*shadow(&geometry)], &frame)
        })
    }
}

/// Rays to each point's disc light.
fn disc_samples(cx: &Context) -> u32 {
    cx.pick(256, 64)
}

/// The same view with this number of columns, and rows in proportion.
pub(super) fn sized(view: &View, across: u32) -> View {
    let size = view.size();
    let height = (u64::from(across) * u64::from(size.y) / u64::from(size.x.max(1))).max(1) as u32;
    view.with_size(UVec2::new(across, height)).unwrap_or(*view)
}

/// The same scene with its light in another kind of depth.
pub fn with_kind(mut scene: Scene, kind: Kind) -> Scene {
    scene.lights[0].view = scene.lights[0].view.with_kind(kind);
    scene
}
