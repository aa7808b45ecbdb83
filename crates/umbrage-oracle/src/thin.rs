use crate::predict::{acne_free_bias, slack};
use crate::{Body, Diagnostic, Face, Geometry, Plan};
use glam::{DVec2, DVec3, Vec3};
use std::collections::BTreeMap;
use umbrage_depth::Stored;
use umbrage_plane::View;
use umbrage_scene::{Light, Mesh, Object, Scene};

/// Asks each triangle in the light, no steeper than the plan says, how far behind its middle the object ends; tells of
/// the one whose depth step is worst for its thickness (WM94-17).
///
/// The first surface has no guard but the bias, and sheets have no thickness: neither is asked. Nor are smooth pieces that
/// are narrower than a texel: what happens there cannot be told from the silhouette beside it.
pub(crate) fn too_thin(scene: &Scene, object: &Object, light: &Light, plan: &Plan) -> Option<Diagnostic> {
    let guarded = plan.slope > 0.0 && plan.stored != Stored::First;
    if !(guarded && object.casts && object.solid) {
        return None;
    }
    // All of it about the scene's origin.
    let view = &scene.about_origin(&light.view);
    let mesh = object.shape.mesh_for(view);
    let faces = (0..mesh.triangles.len()).map(|triangle| Face { corners: mesh.corners(triangle), object: 0 });
    let body = Geometry::from_faces(faces.collect(), vec![Body::default()]);
    let widths = widths(&mesh, view);
    let mut worst: Option<(f64, f64, f64)> = None;
    for (triangle, surface) in mesh.surfaces.iter().enumerate().take(mesh.triangles.len()) {
        let (corners, normal, toward) = lit(&mesh, triangle, view);
        let middle = corners.iter().sum::<DVec3>() / 3.0;
        let facing = normal.dot(toward);
        let zeta = -view.world_to_eye().transform_point3(middle).z;
        // Axial depth per unit across the axis, over the map's x and y: D-15's slope, true in perspective as well.
        let axial = toward.dot(view.ahead()).abs();
        let slope = view.world_to_eye().transform_vector3(normal).truncate().abs() * (axial / facing);
        let wide = widths.get(surface).is_some_and(|width| *width >= 1.0);
        if !(wide && facing > 0.0 && slope.length() <= plan.slope && zeta > 0.0) {
            continue;
        }
        let Some(back) = body.next_hit(middle, -toward) else { continue };
        let steps = view.texel_world(zeta) * slope;
        let step = acne_free_bias(steps.x, steps.y, plan.filter_half);
        let thickness = back.t * axial;
        let excess = step / (thickness - slack(plan.stored, thickness));
        if excess > worst.map_or(1.0, |worst| worst.0) {
            worst = Some((excess, thickness, step));
        }
    }
    let (excess, thickness, step) = worst?;
    let side_needed = (f64::from(view.size().max_element()) * excess).ceil() as u32;
    Some(Diagnostic::TooThin { light: light.name.clone(), object: object.name.clone(), thickness, step, side_needed })
}

/// Corners of a triangle, its unit normal, and the unit vector from its middle to the light.
fn lit(mesh: &Mesh, triangle: usize, view: &View) -> ([DVec3; 3], DVec3, DVec3) {
    let corners = mesh.corners(triangle).map(Vec3::as_dvec3);
    let [a, b, c] = corners;
    (corners, (b - a).cross(c - a).normalize_or_zero(), view.toward_eye((a + b + c) / 3.0))
}

/// How wide the lit part of each smooth piece is in the map, texels: its area over the diagonal of its box.
fn widths(mesh: &Mesh, view: &View) -> BTreeMap<u32, f64> {
    let mut pieces: BTreeMap<u32, (f64, DVec2, DVec2)> = BTreeMap::new();
    for (triangle, surface) in mesh.surfaces.iter().enumerate().take(mesh.triangles.len()) {
        let (corners, normal, toward) = lit(mesh, triangle, view);
        let eye = corners.map(|corner| view.world_to_eye().transform_point3(corner));
        if normal.dot(toward) <= 0.0 || (view.is_perspective() && eye.iter().any(|at| at.z >= 0.0)) {
            continue;
        }
        let [a, b, c] = eye.map(|at| view.eye_to_texel(at));
        let piece = pieces.entry(*surface).or_insert((0.0, DVec2::INFINITY, DVec2::NEG_INFINITY));
        piece.0 += 0.5 * (b - a).perp_dot(c - a).abs();
        piece.1 = piece.1.min(a).min(b).min(c);
        piece.2 = piece.2.max(a).max(b).max(c);
    }
    pieces.into_iter().map(|(surface, (area, low, high))| (surface, area / low.distance(high))).collect()
}
