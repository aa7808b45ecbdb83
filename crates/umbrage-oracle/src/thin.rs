use crate::predict::{acne_free_bias, slack};
use crate::{Body, Diagnostic, Face, Geometry, Plan};
use glam::{DVec2, DVec3, Vec3};
use std::collections::BTreeMap;
use umbrage_depth::{SameSurface, Stored};
use umbrage_plane::View;
use umbrage_scene::{Light, Mesh, Object, Scene};

/// Examines each triangle in the light, no steeper than the plan says, how far behind its middle the object ends; reports
/// the one whose depth step is worst for its thickness (Wang & Molnar 1994).
///
/// The first surface has no guard but the bias, and sheets have no thickness: neither is examined. Nor are smooth pieces that
/// are narrower than a texel: what happens there cannot be told from the silhouette beside it.
pub(crate) fn too_thin(scene: &Scene, object: &Object, light: &Light, plan: &Plan) -> Option<Diagnostic> {
    let guarded = plan.slope > 0.0 && plan.stored != Stored::First;
    if !(guarded && object.casts && object.is_solid()) {
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
        let Stand { middle, toward, facing, zeta, axial, slope, .. } = Stand::of(mesh.corners(triangle), view);
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

/// The nearest pair of a caster and what lies behind it along the light, for each caster, where what is stored between them
/// shadows the caster. Only midpoints are stored there: a second surface is the caster's own or the other's, and what lies on it
/// is lit. What the plan's rule takes for one surface with the caster is not behind it.
pub(crate) fn stacked(scene: &Scene, light: &Light, plan: &Plan) -> Vec<Diagnostic> {
    if !(plan.slope > 0.0 && plan.stored == Stored::Midpoint) {
        return Vec::new();
    }
    let view = &scene.about_origin(&light.view);
    let all = Geometry::about_origin(scene, view, |object| object.casts);
    let mut worst: BTreeMap<u32, (f64, Diagnostic)> = BTreeMap::new();
    for (index, face) in all.faces().iter().enumerate() {
        let Stand { corners, middle, toward, facing, zeta, axial, slope } = Stand::of(face.corners, view);
        let solid = scene.objects[face.object as usize].is_solid();
        // The back of a solid is dark anyway.
        if facing == 0.0 || (solid && facing < 0.0) || slope.length() > plan.slope || zeta <= 0.0 {
            continue;
        }
        // From a little above, so that what coincides with the face is met too.
        let above = corners[0].distance(corners[1]).max(corners[0].distance(corners[2])) * 1e-6;
        let hits = all.hits(middle + toward * above, -toward);
        let Some(own) = hits.iter().find(|hit| hit.face as usize == index).map(|hit| hit.t) else { continue };
        let steps = view.texel_world(zeta) * slope;
        let step = acne_free_bias(steps.x, steps.y, plan.filter_half);
        let behind = |hit: &&crate::Hit| {
            // Neighbours of the same piece, and a solid's own back, are for others to judge.
            let other = hit.object != face.object || (!solid && hit.face as usize != index);
            // Sides of two solids that touch face opposite ways: they are one where they touch, and two at the seam.
            let alike = (hit.normal.dot(toward) > 0.0) == (facing > 0.0);
            let coincide = (hit.t - own) * axial <= f64::from(plan.midpoint.merge) * zeta;
            let one = alike
                && match plan.midpoint.same {
                    SameSurface::Depth => coincide,
                    SameSurface::Object => coincide && hit.object == face.object,
                    SameSurface::Surface => hit.object == face.object,
                };
            other && !one && hit.t >= own - 2.0 * above
        };
        let Some(next) = hits.iter().filter(behind).min_by(|a, b| a.t.total_cmp(&b.t)) else { continue };
        let gap = ((next.t - own) * axial).max(0.0);
        let excess = step - (gap - slack(plan.stored, gap));
        if excess > 0.0 && worst.get(&face.object).is_none_or(|(known, _)| excess > *known) {
            let name = |object: u32| scene.objects[object as usize].name.clone();
            let (object, other) = (name(face.object), name(next.object));
            worst.insert(
                face.object,
                (excess, Diagnostic::Stacked { light: light.name.clone(), object, other, gap, step }),
            );
        }
    }
    worst.into_values().map(|(_, found)| found).collect()
}

/// Sheets that fold over themselves, where the plan's rule takes all that faces the light for one surface: what lies behind the first fold
/// is lit (Woo 1992). A solid's own back, or another object, ends the surface before its next fold.
pub(crate) fn folded(scene: &Scene, light: &Light, plan: &Plan) -> Vec<Diagnostic> {
    let one_at_any_depth = plan.stored == Stored::Midpoint && plan.midpoint.same == SameSurface::Surface;
    let sheet = |object: &Object| object.casts && object.receives && !object.is_solid();
    if !one_at_any_depth || !scene.objects.iter().any(sheet) {
        return Vec::new();
    }
    let view = &scene.about_origin(&light.view);
    let all = Geometry::about_origin(scene, view, |object| object.casts);
    let mut found: BTreeMap<u32, f64> = BTreeMap::new();
    for (index, face) in all.faces().iter().enumerate().filter(|(_, face)| sheet(&scene.objects[face.object as usize]))
    {
        let Stand { middle, toward, facing, zeta, axial, .. } = Stand::of(face.corners, view);
        if facing == 0.0 || zeta <= 0.0 || !all.is_there(index as u32, middle) {
            continue;
        }
        let apart = f64::from(plan.midpoint.merge) * zeta;
        let behind = all.hits(middle, -toward).into_iter().filter(|hit| hit.face as usize != index && hit.t > apart);
        let next = behind.min_by(|a, b| a.t.total_cmp(&b.t));
        if let Some(fold) =
            next.filter(|hit| hit.object == face.object && (hit.normal.dot(toward) > 0.0) == (facing > 0.0))
        {
            let gap = found.entry(face.object).or_insert(0.0);
            *gap = gap.max(fold.t * axial);
        }
    }
    let lost = |(object, gap): (u32, f64)| {
        let object = scene.objects[object as usize].name.clone();
        Diagnostic::LostFold { light: light.name.clone(), object, gap }
    };
    found.into_iter().map(lost).collect()
}

/// How a triangle stands to the light.
struct Stand {
    corners: [DVec3; 3],
    middle: DVec3,
    /// Unit vector from the middle to the light.
    toward: DVec3,
    /// Cosine between the normal and that; below 0 for a back.
    facing: f64,
    /// Axial distance of the middle.
    zeta: f64,
    /// Axial distance per unit along the light's ray.
    axial: f64,
    /// Axial depth per unit across the axis, over the map's x and y: the slope as the light's rays see it, true in perspective as well.
    slope: DVec2,
}

impl Stand {
    fn of(corners: [Vec3; 3], view: &View) -> Self {
        let corners = corners.map(Vec3::as_dvec3);
        let [a, b, c] = corners;
        let middle = (a + b + c) / 3.0;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let toward = view.toward_eye(middle);
        let facing = normal.dot(toward);
        let axial = toward.dot(view.ahead()).abs();
        let slope = view.world_to_eye().transform_vector3(normal).truncate().abs() * (axial / facing.abs());
        let zeta = -view.world_to_eye().transform_point3(middle).z;
        Self { corners, middle, toward, facing, zeta, axial, slope }
    }
}

/// How wide the lit part of each smooth piece is in the map, texels: its area over the diagonal of its box.
fn widths(mesh: &Mesh, view: &View) -> BTreeMap<u32, f64> {
    let mut pieces: BTreeMap<u32, (f64, DVec2, DVec2)> = BTreeMap::new();
    for (triangle, surface) in mesh.surfaces.iter().enumerate().take(mesh.triangles.len()) {
        let Stand { corners, facing, .. } = Stand::of(mesh.corners(triangle), view);
        let eye = corners.map(|corner| view.world_to_eye().transform_point3(corner));
        if facing <= 0.0 || (view.is_perspective() && eye.iter().any(|at| at.z >= 0.0)) {
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
