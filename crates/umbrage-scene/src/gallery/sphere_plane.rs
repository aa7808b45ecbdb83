use crate::{Light, Material, Mesh, Object, Scene};
use glam::{DVec3, UVec2, Vec3};
use umbrage_plane::View;

/// How thick the slabs are that stand for planes, world units: enough that no texel sees both sides as one.
pub const SLAB_THICKNESS: f32 = 4.0;

const GREEN: Vec3 = Vec3::new(0.16, 0.55, 0.20);
const RED: Vec3 = Vec3::new(0.75, 0.10, 0.08);

/// A red sphere (object 0) before an upright green plane (object 1) with a light off to the left (light 0), after
/// Reeves, Salesin & Cook 1987, Figures 5 to 10 and 1.
///
/// The plane is the face z = 0 of a closed slab 120 × 120, which casts too, so that it can shadow itself. Map
/// and picture are 1024 × 1024; y is up in the picture.
///
/// # Panics
/// Never: the views are constants.
pub fn sphere_plane() -> Scene {
    let sphere = Mesh::sphere(Vec3::new(0.0, 0.0, 25.0), 12.0, Mesh::FINE);
    let light = DVec3::new(-70.0, 25.0, 70.0);
    before_plane(
        "sphere-plane",
        Object::solid("sphere", sphere, Material::plastic(RED)),
        vec![light_on("lamp", light, DVec3::new(0.0, 0.0, 12.0), 50.0)],
        &look_down(DVec3::new(0.0, 0.0, 120.0), DVec3::new(0.0, 0.0, 10.0), 40.0),
    )
}

/// A box (object 0) above the same slab (object 1); its shadow ends in a straight edge along y, near x = 8.4. Light 0
/// above; its map holds that edge and what throws it, not the whole box. Map and picture are 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn box_plane() -> Scene {
    let board = Mesh::cuboid(Vec3::new(-60.0, -30.0, 20.0), Vec3::new(0.0, 30.0, 24.0));
    before_plane(
        "box-plane",
        Object::solid("box", board, Material::plastic(RED)),
        vec![light_on("lamp", DVec3::new(-30.0, 5.0, 110.0), DVec3::ZERO, 60.0)],
        &look_down(DVec3::new(10.0, 0.0, 120.0), DVec3::new(10.0, 0.0, 0.0), 30.0),
    )
}

/// The sphere and the plane in white under a red, a green and a blue light (lights 0, 1, 2), after Reeves 1987, Figure 11: sphere
/// is object 0, slab object 1. Where shadows overlap colours are left out one by one.
///
/// # Panics
/// Never: the views are constants.
pub fn three_lights() -> Scene {
    let places = [
        ("red", DVec3::new(-70.0, 38.0, 70.0), Vec3::X),
        ("green", DVec3::new(-76.0, 18.0, 62.0), Vec3::Y),
        ("blue", DVec3::new(-66.0, 6.0, 78.0), Vec3::Z),
    ];
    let lights = places
        .into_iter()
        .map(|(name, at, colour)| light_on(name, at, DVec3::new(0.0, 0.0, 12.0), 50.0).coloured(colour))
        .collect();
    let mut scene = Scene { name: "three-lights".into(), lights, ..sphere_plane() };
    scene.objects[0].material = Material::plastic(Vec3::splat(0.75));
    scene.objects[1].material = Material::matt(Vec3::splat(0.75));
    scene
}

fn before_plane(name: &str, thing: Object, lights: Vec<Light>, camera: &View) -> Scene {
    let slab = Mesh::cuboid(Vec3::new(-60.0, -60.0, -SLAB_THICKNESS), Vec3::new(60.0, 60.0, 0.0));
    Scene {
        name: name.into(),
        origin: DVec3::ZERO,
        objects: vec![thing, Object::solid("slab", slab, Material::matt(GREEN))],
        lights,
        ambient: Vec3::splat(0.15),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera: *camera,
    }
}

fn light_on(name: &str, at: DVec3, target: DVec3, fov_deg: f64) -> Light {
    Light::point(name, at, target, fov_deg, 20.0, 220.0, UVec2::splat(1024)).expect("a constant view is valid")
}

fn look_down(eye: DVec3, target: DVec3, fov_deg: f64) -> View {
    View::perspective(eye, target, DVec3::Y, fov_deg.to_radians(), 20.0, 220.0, UVec2::splat(1024))
        .expect("a constant view is valid")
}
