use crate::masks::Masks;
use crate::pass1::{Pass, stored, without_cells};
use crate::rays::{places, ray};
use crate::{Baked, Caster, Casting};
use glam::{DMat3, DVec2, DVec3};
use umbrage_depth::DepthRule;
use umbrage_plane::{Facet, Facing, TexelRect, View};
use umbrage_raster::{Bins, Cull};

/// [`bake`](crate::bake) for curved surfaces: which side of a surface is seen is decided by its *interpolated* normals at each sample, the test of
/// N·L < 0 (Wang & Molnar 1994). With [`BackFace`](umbrage_depth::BackFace) only what faces away by that test is stored.
///
/// N·L is interpolated as a camera would, in proportion over the triangle, not over the map. Where a triangle is edge-on to the light its own
/// facing decides, and so it does for triangles without [normals](Caster::normals).
pub fn bake_by_normals<'a, R: DepthRule>(
    view: &View,
    casters: impl IntoIterator<Item: Into<Casting<'a>>>,
    rule: &R,
) -> Baked {
    let mut all: Vec<Caster<'a>> = Vec::new();
    casters.into_iter().for_each(|casting| all.extend(casting.into().casters()));
    let sides: Vec<Option<DVec3>> = all.iter().map(|caster| side(view, caster)).collect();
    let front = |facet: &Facet, at: DVec2| match sides.get(facet.triangle as usize) {
        Some(Some(side)) => side.dot(ray(view, at)) > 0.0,
        _ => facet.facing == Facing::Front,
    };
    let mut masks = Masks::new(view);
    let triangles = all.iter().map(|caster| masks.note(*caster));
    let bins = Bins::new(view, TexelRect::of_size(view.size()), Cull::None, triangles);
    let pass = Pass { view, fine: view, rule, masks: &masks, front: Some(front) };
    let (tiles, fragments) = pass.finish(&bins, without_cells(view));
    Baked::of(view, tiles, stored(rule, Cull::None), bins.stats(), fragments)
}

/// A vector whose product with [`ray`] has the sign of N·L at each place of a triangle; `None` for one that is edge-on or
/// has no normals.
///
/// N·L times the distance is linear over the triangle. In perspective a linear function of eye space divided by ζ is one of the ray; in an
/// orthographic view it is one of the place itself.
fn side(view: &View, caster: &Caster<'_>) -> Option<DVec3> {
    let (corners, normals) = (caster.triangle.corners, caster.normals?);
    let to_eye = view.world_to_eye();
    let eye = corners.map(|corner| to_eye.transform_point3(corner));
    let toward = |at: DVec3| if view.is_perspective() { -at } else { DVec3::Z };
    let normals = normals.map(|normal| to_eye.transform_vector3(normal.as_dvec3()));
    let facing = DVec3::from_array(std::array::from_fn(|i| normals[i].dot(toward(eye[i]))));
    let places = places(view, eye);
    let rows = DMat3::from_cols(places[0], places[1], places[2]).transpose();
    let edges = (eye[1] - eye[0]).length() * (eye[2] - eye[0]).length();
    let away = if view.is_perspective() { eye[0].length() } else { 1.0 };
    (rows.determinant().abs() > 1e-9 * edges * away).then(|| rows.inverse() * facing)
}
