//! Solids that reach into each other: what second surfaces they have, and that shadows do not show it.

use glam::{DVec3, UVec2, Vec3};
use std::sync::Arc;
use umbrage_bake::bake;
use umbrage_depth::{BackFace, DepthMap, Second, Storage, Tiled};
use umbrage_oracle::metrics;
use umbrage_plane::TexelRect;
use umbrage_raster::Cull;
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, Soup, picture};
use umbrage_scene::{Material, Mesh, Object, Scene, gallery};

const GREY: Material = Material::matt(Vec3::splat(0.7));

#[test]
fn wm94_2_in_each_other_builders_differ_inside_and_shadows_agree_on_the_union() {
    // Two boxes that reach into each other along the light, above a slab.
    let block = |low: [f32; 3], high: [f32; 3]| Object::solid("block", Mesh::cuboid(low.into(), high.into()), GREY);
    let scene = Scene {
        name: "union".into(),
        origin: DVec3::ZERO,
        objects: vec![
            block([-20.0, -10.0, 12.0], [0.0, 10.0, 26.0]),
            block([-12.0, -6.0, 18.0], [10.0, 14.0, 34.0]),
            block([-60.0, -60.0, -6.0], [60.0, 60.0, 0.0]),
        ],
        ..gallery::sphere_plane()
    };
    let view = scene.lights[0].view.with_size(UVec2::splat(512)).unwrap();
    let soup = Soup::casters(&scene, &view);
    let second = bake(&view, soup.triangles(), &Second, Cull::None).map;
    let back = bake(&view, soup.triangles(), &BackFace, Cull::Front).map;
    let texels = TexelRect::of_size(view.size()).texels();
    let apart = texels.filter(|texel| second.depth(*texel) != back.depth(*texel)).count();
    assert!(apart > 500, "hidden fronts are second surfaces too: {apart}");
    let recipe: Recipe = "wang-molnar94".parse().unwrap();
    let shot = |map: &Arc<Tiled>| {
        let shadow = recipe.bind(map, Storage::Tiled).unwrap();
        let camera = scene.camera.with_size(UVec2::splat(160)).unwrap();
        picture(&Scene { camera, ..scene.clone() }, &[&*shadow], &Frame::CENTRES)
    };
    let (a, b) = (shot(&second), shot(&back));
    let far = metrics::silhouette_distance(&view, &scene, &a.position, 4.0);
    let (mut differing, mut asked) = (0, [0; 3]);
    for i in 0..a.shadow[0].len() {
        if a.facing[0][i] > 0.05 && a.share[i] == 1.0 && far[i] > 2.0 {
            asked[a.object[i] as usize] += 1;
            differing += usize::from(a.shadow[0][i] != b.shadow[0][i]);
        }
    }
    assert!(asked.iter().all(|&pixels| pixels > 300), "{asked:?}");
    assert_eq!(differing, 0, "of {asked:?}");
}
