//! Sides seen by interpolated normals.

use crate::pass1::{triangles, views};
use crate::shapes::ball;
use glam::Vec3;
use umbrage_bake::{Caster, bake, bake_by_normals};
use umbrage_depth::{BackFace, DepthMap};
use umbrage_plane::TexelRect;
use umbrage_raster::Cull;

#[test]
fn triangles_without_normals_are_seen_by_their_own_facing() {
    for view in views() {
        let by_facing = bake(&view, triangles(), &BackFace, Cull::None);
        assert_eq!(bake_by_normals(&view, triangles(), &BackFace).map, by_facing.map);
    }
}

#[test]
fn wm94_1_smooth_normals_move_the_border_of_what_faces_away_and_leave_the_rest() {
    // The largest of the square views.
    let view = views()[24];
    let round = ball(Vec3::new(0.0, 0.0, -20.0), 5.0, 8, 0);
    let flat = bake(&view, round.iter().map(|(triangle, _)| *triangle), &BackFace, Cull::None).map;
    let casters = round.iter().map(|(triangle, normals)| Caster::from(*triangle).with_normals(*normals));
    let smooth = bake_by_normals(&view, casters, &BackFace).map;
    let apart =
        TexelRect::of_size(view.size()).texels().filter(|texel| flat.depth(*texel) != smooth.depth(*texel)).count();
    let seen = TexelRect::of_size(view.size()).texels().filter(|texel| flat.depth(*texel).is_finite()).count();
    assert!(apart > 0 && apart < seen / 5, "{apart} of {seen}");
    // Normals all turned round turn the sides round too.
    let inside_out = round.iter().map(|(triangle, normals)| Caster::from(*triangle).with_normals(normals.map(|n| -n)));
    let fronts = bake_by_normals(&view, inside_out, &BackFace).map;
    let first = bake(&view, round.iter().map(|(triangle, _)| *triangle), &umbrage_depth::First, Cull::None).map;
    let same =
        TexelRect::of_size(view.size()).texels().filter(|texel| fronts.depth(*texel) == first.depth(*texel)).count();
    assert!(same > 64 * 64 - seen / 5, "{same}");
}
