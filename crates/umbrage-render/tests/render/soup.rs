//! The triangles of a scene.

use glam::{UVec2, Vec3};
use umbrage_bake::{Caster, Casting, bake};
use umbrage_depth::{DepthMap, First};
use umbrage_plane::SurfacePoint;
use umbrage_raster::{Cull, Triangle};
use umbrage_render::{Soup, alpha_test};
use umbrage_scene::{Cover, Object, Scene, Shape, gallery};

#[test]
fn r87_5_only_casters_are_drawn_and_ids_and_sheets_reach_the_facets() {
    let mut scene: Scene = gallery::sphere_plane();
    scene.objects[0] = Object { solid: false, ..scene.objects[0].clone() };
    scene.objects[1].casts = false;
    let view = scene.lights[0].view;
    let drawn: Vec<Triangle> = Soup::casters(&scene, &view).triangles().collect();
    assert!(!drawn.is_empty() && drawn.iter().all(|triangle| triangle.object == 0 && triangle.sheet));
    assert!(Soup::all(&scene, &view).triangles().any(|triangle| triangle.object == 1 && !triangle.sheet));
}

#[test]
fn r87_21_a_map_of_16384_keeps_only_the_tiles_that_something_touched() {
    let scene = gallery::sphere_plane();
    let view = scene.lights[0].view.with_size(UVec2::splat(16_384)).unwrap();
    let mut sphere = scene;
    sphere.objects[1].casts = false;
    let map = bake(&view, Soup::casters(&sphere, &view).triangles(), &First, Cull::None).map;
    let share = map.bytes() as f64 / (16_384.0 * 16_384.0 * 4.0);
    assert!(share > 0.01 && share < 0.1, "{share}");
    let middle = view.receiver(&SurfacePoint::at(Vec3::new(0.0, 0.0, 25.0), Vec3::Z)).unwrap();
    assert!(map.depth(middle.footprint.centre.as_ivec2()) < middle.depth);
}

/// The casters one by one.
fn casters<'a>(casting: impl Iterator<Item: Into<Casting<'a>>>) -> Vec<Caster<'a>> {
    casting.flat_map(|casting| casting.into().casters().collect::<Vec<_>>()).collect()
}

#[test]
fn triangles_come_with_what_passes_their_object_and_the_normals_of_their_mesh() {
    let mut scene: Scene = gallery::sphere_plane();
    scene.objects[0].passes = Vec3::new(0.5, 0.25, 0.0);
    let view = scene.lights[0].view;
    let soup = Soup::casters(&scene, &view);
    let bare: Vec<Triangle> = soup.triangles().collect();
    let casting = casters(soup.casting());
    assert_eq!(casting.iter().map(|caster| caster.triangle).collect::<Vec<_>>(), bare);
    for caster in &casting {
        assert_eq!(caster.passes, scene.objects[caster.triangle.object as usize].passes);
        assert!(caster.normals.is_some_and(|normals| normals.iter().all(|normal| normal.is_normalized())));
    }
    assert!(casting.iter().all(|caster| caster.mask.is_none() && caster.film.is_none()), "nothing has holes or blends");
    assert_eq!(casters(Soup::casters(&scene, &view).into_casting(&|_| true, &|_| Vec3::ZERO)), casting);
}

#[test]
fn what_has_holes_comes_with_its_places_in_the_texture_and_a_mask() {
    let mut scene: Scene = gallery::sphere_plane();
    scene.objects[0].cover = Cover { cutoff: Some(2.0), ..Cover::default() };
    let Shape::Mesh(mesh) = &mut scene.objects[0].shape else { panic!("a mesh") };
    mesh.uvs = mesh.positions.iter().map(|at| at.truncate()).collect();
    let uvs = mesh.corner_uvs(17);
    let view = scene.lights[0].view;
    let soup = Soup::casters(&scene, &view);
    for caster in casters(soup.casting()) {
        assert_eq!(caster.mask.is_some(), caster.triangle.object == 0);
    }
    assert_eq!(casters(soup.casting())[17].uvs, uvs);
    // Nothing of the ball is there; the wall is all that is left.
    let test = alpha_test(&scene);
    let [whole, moved] = [
        bake(&view, soup.casting(), &First, Cull::None),
        bake(&view, Soup::casters(&scene, &view).into_casting(&test, &|_| Vec3::ZERO), &First, Cull::None),
    ];
    let wall = bake(&view, soup.triangles().filter(|triangle| triangle.object == 1), &First, Cull::None);
    assert!(whole.map == wall.map && moved.map == wall.map);
    assert_eq!(whole.fragments, wall.fragments);
}
