//! Lights: the views of their maps, what they send where, and how bright they are together.

use crate::GltfError;
use crate::file::File;
use crate::nodes::Nodes;
use crate::note::Level;
use crate::sight::{Sight, Things};
use crate::source::{Shines, Source, sources};
use crate::window::Window;
use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_plane::{Projection, Rules, Verdict, View, ViewError, cube_views};
use umbrage_scene::Light;
use umbrage_scene::tree::{Cone, Falloff, Tree};

/// Cosine of the half-angle beyond which a spot has several maps: 70°.
const WIDE: f64 = 0.342_020_143_325_668_7;
/// Half the widest field of a single view, radians: 87.5°.
const WIDEST: f64 = 1.527_163_095_495_038_5;
/// What is added around that which a map must hold, as a fraction.
const MARGIN: f64 = 1.0 / 1024.0;

/// What a light's map is made of, and how large the light is.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// The views of its maps: the light's own for a sun or a spot, [six](umbrage_plane::cube_views) around a point light,
    /// [five](View::faces_ahead) for a spot whose outer cone is above 70°.
    pub views: Vec<View>,
    /// The radius of its body: `extras.radius`, world units, of a disc square to a spot's axis or of a ball about a point light; `extras.angle`,
    /// radians, of a sun. 0 where the file gives none.
    pub radius: f64,
}

/// The lights of the scene, a lamp for each, or a sun where there are none.
pub(crate) fn lights(
    file: &File,
    nodes: &Nodes,
    things: &Things,
    map_size: u32,
) -> Result<(Vec<Light>, Vec<Lamp>), GltfError> {
    let mut sources = sources(file, nodes)?;
    if sources.is_empty() {
        file.note(Level::Always, "the scene has no light: a sun from above and the left was added");
        sources.push(sun(things)?);
    }
    let exposure = exposure(&sources, things);
    if exposure.is_none() {
        file.note(Level::Always, "all lights have an intensity or a colour of 0");
    }
    let mut found = (Vec::new(), Vec::new());
    for (index, source) in sources.iter().enumerate() {
        let view_fault = |fault| GltfError::View { path: source.path.clone(), fault };
        let (view, views) = views(source, things, map_size).map_err(view_fault)?;
        let name = source.name.clone().unwrap_or_else(|| format!("light{index}"));
        let strength = irradiance(source, things) * exposure.unwrap_or(0.0);
        let light = Light { name, view, colour: strength.as_vec3(), casts: source.casts, tree: tree(source, things) };
        found.0.push(light);
        found.1.push(Lamp { views, radius: source.size });
    }
    Ok(found)
}

fn sun(things: &Things) -> Result<Source, GltfError> {
    let toward = DVec3::new(-0.6, 1.0, 0.5).normalize();
    let sight = Sight::looking(things.middle(), toward, DVec3::Y);
    Ok(Source {
        name: Some("sun".into()),
        path: "lights".into(),
        sight: sight.ok_or_else(|| GltfError::field("lights", "nothing", "a scene of finite extent"))?,
        shines: Shines::Sun,
        intensity: DVec3::ONE,
        range: None,
        window: None,
        size: 0.0,
        casts: true,
    })
}

/// The distance at which a lamp is measured: that of the middle of the scene's box, but no nearer than half the box's radius, so that
/// a lamp in the middle does not leave all else black.
fn measured_at(source: &Source, things: &Things) -> f64 {
    things.middle().distance(source.sight.eye).max(0.5 * things.radius())
}

/// What arrives there on a surface that faces the light, linear RGB in lux; cones and ranges do not count.
fn irradiance(source: &Source, things: &Things) -> DVec3 {
    match source.shines {
        Shines::Sun => source.intensity,
        Shines::Spot { .. } | Shines::Point => source.intensity / measured_at(source, things).powi(2),
    }
}

/// The factor for all lights after which the brightest channel of what arrives from all of them together is 1; `None` where nothing arrives.
fn exposure(sources: &[Source], things: &Things) -> Option<f64> {
    let sum: DVec3 = sources.iter().map(|source| irradiance(source, things)).sum();
    let factor = 1.0 / sum.max_element();
    factor.is_finite().then_some(factor)
}

/// The inverse square of the distance, 1 where the light is measured; the range's window and the cone; and the shadow.
fn tree(source: &Source, things: &Things) -> Option<Tree> {
    if source.shines == Shines::Sun {
        return None;
    }
    let reference = measured_at(source, things) as f32;
    let mut factors = vec![Tree::Falloff(Falloff { exponent: 2.0, reference, most: 1e6 })];
    if let Some(range) = source.range {
        // 1 − (distance / range)⁴, and 0 beyond the range.
        let lost = Falloff { exponent: -4.0, reference: range as f32, most: 1.0 };
        let lost = Tree::Product(vec![Tree::colour(Vec3::NEG_ONE), Tree::Falloff(lost)]);
        factors.push(Tree::Sum(vec![Tree::colour(Vec3::ONE), lost]));
    }
    if let (Shines::Spot { inner, outer }, None) = (source.shines, open(source)) {
        let [inner_deg, outer_deg] = [inner, outer].map(|angle| angle.to_degrees() as f32);
        if inner_deg < outer_deg {
            factors.push(Tree::Cone(Cone { inner_deg, outer_deg }));
        }
    }
    if source.casts {
        factors.push(Tree::Shadow { recipe: String::new() });
    }
    Some(Tree::Product(factors))
}

/// What lies outside of the map of a light without a cone.
fn open(source: &Source) -> Option<Verdict> {
    match source.window {
        Some(Window::Perspective { outside, .. }) => outside,
        _ => None,
    }
}

/// The light's own view, and those of its maps.
fn views(source: &Source, things: &Things, map_size: u32) -> Result<(View, Vec<View>), ViewError> {
    let size = UVec2::splat(map_size);
    let placed =
        |sight: &Sight, projection, [near, far]: [f64; 2]| View::new(sight.world_to_eye(), projection, near, far, size);
    let sight = &source.sight;
    match source.shines {
        Shines::Sun => {
            let view = match source.window {
                Some(Window::Orthographic { half, near, far }) => {
                    placed(sight, Projection::orthographic(DVec2::splat(half)), [near, far])?
                }
                _ => around_all(sight, things, size)?,
            };
            Ok((view, vec![view]))
        }
        Shines::Point => {
            let range = range(source, things, 1.0 / 3.0_f64.sqrt());
            let toward = (sight.eye - things.middle()).try_normalize().unwrap_or(sight.axes.z_axis);
            let toward = Sight::looking(sight.eye, toward, umbrage_plane::up_for(toward)).unwrap_or(*sight);
            let view = placed(&toward, Projection::perspective(DVec2::ONE), range)?;
            let [near, far] = range;
            Ok((view, cube_views(sight.eye, near, far, map_size)?.to_vec()))
        }
        Shines::Spot { outer, .. } => {
            let cosine = outer.cos().max(0.0);
            let outside = open(source);
            let wide = cosine < WIDE && outside.is_none();
            let least = if wide { 1.0 / 3.0_f64.sqrt() } else { cosine };
            let k = 1.0 / outer.min(WIDEST).tan();
            let view = placed(sight, Projection::perspective(DVec2::splat(k)), range(source, things, least))?;
            let view = match outside {
                None => view.with_rules(Rules::SPOT).with_cone(Some(cosine))?,
                Some(Verdict::Shadowed) => view.with_rules(Rules::SPOT),
                Some(_) => view.with_rules(Rules::OPEN),
            };
            Ok((view, if wide { view.faces_ahead()?.to_vec() } else { vec![view] }))
        }
    }
}

/// Near and far plane of a lamp: those of its window, else such that they hold every caster. `least` is the least cosine between an axis of
/// its views and a direction in which it shines there.
fn range(source: &Source, things: &Things, least: f64) -> [f64; 2] {
    if let Some(Window::Perspective { near, far, .. }) = source.window {
        return [near, far];
    }
    let [near, far] = things.reach(source.sight.eye);
    let far = far.max(things.radius() * 1e-3) * (1.0 + MARGIN);
    let near = if near.is_finite() { near * least * (1.0 - MARGIN) } else { far * 0.5 };
    // A lamp within its own shade or on a wall: what is so near to it may be nearer than the near plane.
    [near.max(far * 1e-5), far]
}

/// A view along a sun's rays of all that stands in the scene.
fn around_all(sight: &Sight, things: &Things, size: UVec2) -> Result<View, ViewError> {
    let [low, high] = things.in_sight(sight);
    let margin = (high - low).length() * MARGIN;
    let (middle, half) = ((low + high) * 0.5, (high - low) * 0.5 + margin);
    let eye = sight.eye + sight.axes * middle.truncate().extend(high.z + 2.0 * margin);
    let sight = Sight { eye, ..*sight };
    let projection = Projection::orthographic(half.truncate());
    View::new(sight.world_to_eye(), projection, margin, 2.0 * half.z + margin, size)
}
