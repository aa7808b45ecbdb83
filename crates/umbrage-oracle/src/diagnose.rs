//! What is wrong with a scene before a map of it is made: values to act on, each with its line for people.

use crate::predict::{float_step, severe_perspective};
use crate::ray::Ray;
use crate::thin::{folded, stacked, too_thin};
use crate::triangle::Triangle;
use crate::{Diagnostic, Plan};
use glam::DVec3;
use umbrage_depth::Stored;
use umbrage_plane::{Kind, View};
use umbrage_recipe::Recipe;
use umbrage_scene::{Ball, Light, Object, Scene, Shape};

/// Everything that is known to go wrong with a light of a scene under a recipe, in a fixed order: [`diagnose`] with what the
/// recipe plans ([`Plan::of`]) at the farthest receiver in the light's range.
///
/// # Panics
/// When the scene's origin is not finite.
pub fn diagnose_recipe(scene: &Scene, light: &Light, recipe: &Recipe) -> Vec<Diagnostic> {
    let view = &light.view;
    let zeta = farthest_receiver(scene, view).unwrap_or_else(|| view.far());
    diagnose(scene, light, &Plan::of(recipe, view, zeta))
}

/// Everything that is known to go wrong with a light of a scene, in a fixed order. Lights that do not cast have nothing wrong.
///
/// # Panics
/// When the scene's origin is not finite.
pub fn diagnose(scene: &Scene, light: &Light, plan: &Plan) -> Vec<Diagnostic> {
    if !light.casts {
        return Vec::new();
    }
    let name = |id: u32| scene.objects[id as usize].name.clone();
    let outside = scene.casters_outside(&light.view).into_iter();
    let mut found: Vec<Diagnostic> =
        outside.map(|id| Diagnostic::CasterOutside { light: light.name.clone(), object: name(id) }).collect();
    let farthest = farthest_receiver(scene, &light.view);
    if let (Some(bits), Some(farthest)) = (plan.depth_bits, farthest)
        && let Some(step) = severe_perspective(&light.view, bits, farthest, plan.bias_world)
    {
        let (light, bias) = (light.name.clone(), plan.bias_world);
        found.push(Diagnostic::SeverePerspective { light, bits, farthest, step, bias });
    }
    if plan.depth_bits.is_none() {
        found.extend(farthest.and_then(|farthest| coarse_depth(light, plan.bias_world, farthest)));
    }
    found.extend(scene.objects.iter().filter_map(|object| enclosed(scene, object, light)));
    found.extend(sizes(scene, light, plan.bias_world));
    if plan.stored == Stored::Midpoint
        && let Some(receiver) = scene.objects.iter().find(|object| object.receives && !object.casts)
    {
        for object in scene.objects.iter().filter(|object| object.casts && !object.is_solid()) {
            let (light, object, receiver) = (light.name.clone(), object.name.clone(), receiver.name.clone());
            found.push(Diagnostic::VanishedShadow { light, object, receiver });
        }
    }
    for object in scene.objects.iter().filter(|object| object.casts && object.is_solid()) {
        let closed = match &object.shape {
            Shape::Mesh(mesh) => mesh.is_closed(),
            // Cut alike for any view, and closed or not for all.
            patches @ Shape::Patches(_) => patches.mesh_for(&light.view).is_closed(),
        };
        if !closed {
            found.push(Diagnostic::OpenSolid { object: object.name.clone() });
        }
    }
    found.extend(scene.objects.iter().filter_map(|object| too_thin(scene, object, light, plan)));
    found.extend(stacked(scene, light, plan));
    found.extend(folded(scene, light, plan));
    found
}

/// Whether a light in perspective stands inside a closed caster: a ray that leaves it crosses the wall an odd number of times.
fn enclosed(scene: &Scene, object: &Object, light: &Light) -> Option<Diagnostic> {
    let view = &scene.about_origin(&light.view);
    if !(object.casts && object.is_solid() && view.is_perspective()) {
        return None;
    }
    let mesh = object.shape.mesh_for(view);
    let eye = view.light().truncate();
    // Off every axis, so that no ray runs along an edge of a box; three, so that one that meets an edge is outvoted.
    let ways = [DVec3::new(0.31, 0.59, 0.74), DVec3::new(-0.83, 0.17, 0.53), DVec3::new(0.23, -0.71, -0.67)];
    let rays = ways.map(|way| Ray::new(eye, way.normalize()));
    let mut crossed = [0; 3];
    // So few rays are not worth a tree.
    for corners in (0..mesh.triangles.len()).map(|triangle| mesh.corners(triangle)) {
        let face = corners.iter().all(|at| at.is_finite()).then(|| Triangle::new(corners));
        for (crossed, ray) in crossed.iter_mut().zip(&rays) {
            *crossed += u32::from(face.is_some_and(|face| ray.meets(&face).is_some()));
        }
    }
    let odd = crossed.iter().filter(|crossed| *crossed % 2 == 1).count();
    if odd < 2 {
        return None;
    }
    let distances = mesh.positions.iter().map(|at| -view.world_to_eye().transform_point3(at.as_dvec3()).z);
    let nearest = distances.filter(|zeta| *zeta > 0.0).fold(f64::INFINITY, f64::min);
    let cut = nearest < view.near() / 1024.0;
    Some(Diagnostic::Enclosed { light: light.name.clone(), object: object.name.clone(), nearest, cut })
}

/// Whether floats are fine enough at the farthest receiver, in the map's kind of depth or in another: for half the bias, or, where there
/// is none, for the side of a texel, by which shadows are detached then.
fn coarse_depth(light: &Light, bias: f64, farthest: f64) -> Option<Diagnostic> {
    let kind = light.view.kind();
    let step = float_step(&light.view, farthest);
    let allowed = if bias > 0.0 { 0.5 * bias } else { light.view.texel_world(farthest).max_element() };
    if step <= allowed {
        return None;
    }
    let others =
        [Kind::Axial, Kind::Screen, Kind::Radial].map(|kind| (kind, float_step(&light.view.with_kind(kind), farthest)));
    let finest = others.into_iter().filter(|(_, step)| *step <= allowed).min_by(|a, b| a.1.total_cmp(&b.1));
    let better = finest.map(|(kind, _)| kind);
    Some(Diagnostic::CoarseDepth { light: light.name.clone(), kind, farthest, step, allowed, better })
}

/// Casters that are smaller than a texel, and casters that are no larger than twice the bias.
fn sizes(scene: &Scene, light: &Light, bias: f64) -> Vec<Diagnostic> {
    struct Seen {
        object: usize,
        size: f64,
        texel: f64,
    }
    let view = &light.view;
    let casters = scene.objects.iter().enumerate().filter(|(_, object)| object.casts);
    let seen: Vec<Seen> = casters
        .filter_map(|(object, thing)| {
            let points: Vec<_> = scene.hull(thing).collect();
            let ball = Ball::around(&points)?;
            let zeta = -view.world_to_eye().transform_point3(ball.centre).z;
            let in_front = !view.is_perspective() || zeta > 0.0;
            let texel = view.texel_world(zeta).max_element();
            in_front.then_some(Seen { object, size: 2.0 * ball.radius, texel })
        })
        .collect();
    let (of, name) = (seen.len(), |seen: &Seen| scene.objects[seen.object].name.clone());
    let mut found = Vec::new();
    let below: Vec<&Seen> = seen.iter().filter(|seen| seen.size < seen.texel).collect();
    if let Some(worst) = below.iter().max_by(|a, b| (a.texel / a.size).total_cmp(&(b.texel / b.size))) {
        found.push(Diagnostic::CoarseTexels {
            light: light.name.clone(),
            casters: below.len(),
            of,
            object: name(worst),
            size: worst.size,
            texel: worst.texel,
            side_needed: (f64::from(view.size().max_element()) * worst.texel / worst.size).ceil() as u32,
        });
    }
    let lost: Vec<&Seen> = seen.iter().filter(|seen| seen.size < 2.0 * bias).collect();
    if let Some(worst) = lost.iter().min_by(|a, b| a.size.total_cmp(&b.size)) {
        let (light, object) = (light.name.clone(), name(worst));
        found.push(Diagnostic::LargeBias { light, bias, casters: lost.len(), of, object, size: worst.size });
    }
    found
}

/// The largest axial distance of anything that receives, inside the light's range.
fn farthest_receiver(scene: &Scene, light: &View) -> Option<f64> {
    let hulls = scene.objects.iter().filter(|object| object.receives).flat_map(|object| scene.hull(object));
    let distances = hulls.map(|at| -light.world_to_eye().transform_point3(at).z);
    distances.filter(|zeta| *zeta > light.near()).map(|zeta| zeta.min(light.far())).reduce(f64::max)
}
