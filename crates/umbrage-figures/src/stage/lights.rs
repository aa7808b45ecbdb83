//! A scene of several lights: the map of each, the picture with all their shadows, and the truth beside it.

use super::memo::Memo;
use super::sized;
use crate::figure::Context;
use umbrage_depth::Map;
use umbrage_oracle::{Diagnostic, Geometry, Plan, RayCast, Truth, diagnose};
use umbrage_render::{Frame, Picture, Sight, bind_lights, light_maps, picture};
use umbrage_scene::{Light, Scene};
use umbrage_shadow::{Shadow, Unshadowed};

/// A scene of several lights: each has its map, and its shadow by the recipe of its own tree or by the figure's.
///
/// Its objects and its camera must not be changed.
#[derive(Clone)]
pub struct Stage {
    pub scene: Scene,
    pub maps: Vec<Option<Map>>,
    sights: Memo<Frame, Sight>,
}

impl Stage {
    /// `pixels` across the camera's picture; the lights' maps keep their sizes, divided by `coarser`.
    pub fn new(mut scene: Scene, pixels: u32, coarser: u32) -> anyhow::Result<Self> {
        scene.camera = sized(&scene.camera, pixels);
        for light in &mut scene.lights {
            light.view = sized(&light.view, (light.view.size().x / coarser).max(1));
        }
        let maps = light_maps(&scene, &"reeves87".parse()?)?;
        Ok(Self { scene, maps, sights: Memo::default() })
    }

    /// The picture with every light's shadow.
    pub fn shoot(&self, cx: &Context, recipe: &str, frame: &Frame) -> anyhow::Result<Picture> {
        let shadows = bind_lights(&self.scene, &self.maps, &recipe.parse()?, cx.storage)?;
        Ok(self.draw(cx, &shadows, frame))
    }

    /// Known faults of the casting lights, for the reader of the figure (W78-8, W78-9, WM94-14).
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
                    "Warning: light {:?} does not see all of {first:?}{others}: shadows end where its view ends.",
                    light.name
                ));
            }
        }
        lines.join(" ")
    }

    /// The picture without any shadow.
    pub fn plain(&self, cx: &Context, frame: &Frame) -> Picture {
        self.draw(cx, &[], frame)
    }

    /// Rays instead of maps, for the lights that cast; what is left out of the maps blocks no light.
    pub fn truth(&self, cx: &Context, frame: &Frame) -> Picture {
        let geometry = Geometry::new(&self.scene, &self.scene.camera);
        // Regions are looked up at their middles, which lie a little off finely tessellated surfaces.
        let truth = Truth { casters_only: true, own_slack: 0.1, ..Truth::default() };
        let ray = |light: &Light| -> Box<dyn Shadow + '_> {
            if light.casts { Box::new(RayCast::new(&geometry, &light.view).with(truth)) } else { Box::new(Unshadowed) }
        };
        let shadows: Vec<Box<dyn Shadow + '_>> = self.scene.lights.iter().map(ray).collect();
        self.draw(cx, &shadows, frame)
    }

    /// The picture with any shadows.
    pub fn draw(&self, cx: &Context, shadows: &[Box<dyn Shadow + '_>], frame: &Frame) -> Picture {
        let frame = Frame { seed: cx.seed, ..*frame };
        let shadows: Vec<&dyn Shadow> = shadows.iter().map(AsRef::as_ref).collect();
        if frame.every_sample {
            return picture(&self.scene, &shadows, &frame);
        }
        self.sights.once(frame, || Sight::new(&self.scene, &frame)).picture(&self.scene, &shadows)
    }
}
