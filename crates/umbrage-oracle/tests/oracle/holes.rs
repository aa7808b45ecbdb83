//! Rays through the holes of cut-outs.

use glam::{DVec3, DVec4, UVec2, Vec2, Vec3, Vec4};
use std::sync::Arc;
use umbrage_oracle::{Geometry, RayCast};
use umbrage_plane::{SurfacePoint, View};
use umbrage_scene::{Cover, Interpolation, Material, Mesh, Object, Scene, Shape, Texture, Wrap, gallery};

/// Square sheets two units wide, one above another from y = 1, of which `half` are there for x < 0 alone. The texture repeats, and the
/// sheets lie far out in it.
fn sheets(half: &[bool], passes: Vec3) -> Scene {
    let texels = vec![Vec4::ONE, Vec4::ZERO];
    let texture = Texture::linear(UVec2::new(2, 1), texels).unwrap().with_wrap([Wrap::Repeat; 2]);
    let cover = Cover::cut_out(Arc::new(texture.with_interpolation(Interpolation::Nearest)), 0.5);
    let sheet = |(&half, height): (&bool, f32)| {
        let corners = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
        let mesh = Mesh::sheet(corners.map(|(x, z)| Vec3::new(x, height, z)), 1);
        let uvs = [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE].map(|uv| uv + Vec2::new(7.0, -3.0)).to_vec();
        let sheet = Object::two_sided("sheet", Shape::Mesh(Mesh { uvs, ..mesh }), Material::matt(Vec3::ONE));
        Object { passes, cover: if half { cover.clone() } else { Cover::default() }, ..sheet }
    };
    let objects = half.iter().zip((1u8..).map(f32::from)).map(sheet).collect();
    Scene { objects, lights: Vec::new(), ..gallery::sphere_plane() }
}

fn view() -> View {
    gallery::sphere_plane().camera
}

#[test]
fn no_ray_meets_a_hole() {
    let geometry = Geometry::new(&sheets(&[true, false, true], Vec3::ZERO), &view());
    let met = |x: f64| -> Vec<(u32, f64)> {
        geometry.hits(DVec3::new(x, 0.0, 0.3), DVec3::Y).iter().map(|hit| (hit.object, hit.t)).collect()
    };
    assert_eq!(met(-0.4), [(0, 1.0), (1, 2.0), (2, 3.0)]);
    assert_eq!(met(0.4), [(1, 2.0)]);
    for (x, first, below) in [(-0.4, 0, true), (0.4, 1, false)] {
        let from = DVec3::new(x, 0.0, 0.3);
        assert_eq!(geometry.first_hit(from, DVec3::Y).map(|hit| hit.object), Some(first));
        assert_eq!(geometry.occluded(from, from.with_y(1.5)), below);
        assert_eq!(geometry.occluded_toward(from.with_y(2.5), DVec3::Y), below);
        assert!(geometry.occluded_toward(from, DVec3::Y), "the sheet in the middle is whole");
    }
}

#[test]
fn truth_is_lit_through_holes_and_light_that_passes_is_counted_where_something_is() {
    let at = |x: f32| SurfacePoint { object: 9, ..SurfacePoint::at(Vec3::new(x, 0.0, 0.3), Vec3::Y) };
    let geometry = Geometry::new(&sheets(&[true], Vec3::ZERO), &view());
    let truth = RayCast::everywhere(&geometry, DVec4::Y);
    assert_eq!([-0.4, 0.4, 1.4].map(|x| truth.at(&at(x))), [1.0, 0.0, 0.0]);
    let red = Vec3::new(0.5, 0.25, 0.0);
    let geometry = Geometry::new(&sheets(&[true, false, true], red), &view());
    let truth = RayCast::everywhere(&geometry, DVec4::Y);
    assert_eq!([-0.4, 0.4, 1.4].map(|x| truth.passes(&at(x))), [red * red * red, red, Vec3::ONE]);
}

#[test]
fn a_solid_with_holes_is_lit_from_within() {
    let cube = Object::solid("cube", Mesh::cuboid(Vec3::NEG_ONE, Vec3::ONE), Material::matt(Vec3::ONE));
    let lamp = DVec4::new(0.0, 0.0, 0.0, 1.0);
    let outside = SurfacePoint::at(Vec3::X * 3.0, Vec3::NEG_X);
    // Above its cutoff all is there, so that rays alone decide; below it nothing is.
    for (cutoff, dark, solid) in [(None, 1.0, true), (Some(0.5), 1.0, false), (Some(2.0), 0.0, false)] {
        let cover = Cover { cutoff, ..Cover::default() };
        let scene = Scene { objects: vec![cube.clone().with_cover(cover)], ..gallery::sphere_plane() };
        let geometry = Geometry::new(&scene, &view());
        assert_eq!(RayCast::everywhere(&geometry, lamp).at(&outside), dark, "{cutoff:?}");
        assert_eq!(geometry.body(0).solid, solid);
    }
}

#[test]
fn what_blends_lets_light_pass_by_its_alpha() {
    let mut scene = sheets(&[true, false], Vec3::ZERO);
    let texels = vec![Vec4::ONE, Vec4::new(1.0, 1.0, 1.0, 0.25)];
    let texture = Texture::linear(UVec2::new(2, 1), texels).unwrap().with_interpolation(Interpolation::Nearest);
    scene.objects[0].cover = Cover::blended(Arc::new(texture));
    scene.objects[1].passes = Vec3::new(0.5, 1.0, 0.0);
    let at = |x: f32| SurfacePoint { object: 9, ..SurfacePoint::at(Vec3::new(x, 0.0, 0.3), Vec3::Y) };
    let passes = |scene: &Scene| {
        let geometry = Geometry::new(scene, &view());
        assert!(!geometry.is_opaque());
        let truth = RayCast::everywhere(&geometry, DVec4::Y);
        [-0.4, 0.4, 1.4].map(|x| truth.passes(&at(x)))
    };
    assert_eq!(passes(&scene), [Vec3::ZERO, Vec3::new(0.375, 0.75, 0.0), Vec3::ONE]);
    scene.objects.pop();
    assert_eq!(passes(&scene), [Vec3::ZERO, Vec3::splat(0.75), Vec3::ONE]);
}
