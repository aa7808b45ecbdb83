//! Small scenes for what second depths find hard: thin things, sheets, curved receivers, low light.

use super::SLAB_THICKNESS;
use super::curved::curved;
use super::views::{camera, sun, toward};
use crate::{Material, Mesh, Object, Scene, Shape};
use glam::{DVec3, UVec2, Vec3};
use umbrage_plane::View;

/// How thick [`thin_slab`]'s slab is, world units.
pub const THIN: f32 = 0.4;

const GREY: Material = Material::matt(Vec3::new(0.62, 0.60, 0.56));
const RED: Material = Material::plastic(Vec3::new(0.70, 0.14, 0.08));
const BLUE: Material = Material::plastic(Vec3::new(0.12, 0.26, 0.66));
const OCHRE: Material = Material::plastic(Vec3::new(0.72, 0.50, 0.14));

/// A slab [`THIN`] thick (object 0) above a floor (object 1), under a light at infinity 45° above the horizon in
/// direction −x, after Wang & Molnar 1994, Figure 7.
///
/// The map is 160 world units across: on the slab the depth changes by 160/n units from one texel of an n² map to the
/// next, which is more than the 0.57 that lie between its two surfaces along the light, for n up to 256. Light 0 has
/// 256 × 256 texels; the floor's top is y = 0 and the picture 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn thin_slab() -> Scene {
    let slab = Mesh::cuboid(Vec3::new(-38.0, 18.0, -30.0), Vec3::new(22.0, 18.0 + THIN, 30.0));
    Scene {
        lights: vec![sun(toward(45.0, 180.0), DVec3::new(0.0, 5.0, 0.0), 80.0, 256)],
        ..small(
            "thin-slab",
            vec![Object::solid("slab", slab, RED), floor(52.0)],
            &camera([54.0, 78.0, 118.0], [2.0, 6.0, 0.0], 42.0, [20.0, 400.0], UVec2::splat(1024)),
        )
    }
}

/// Nothing but two-sided sheets: a ground (object 0), a card that hangs above it (1) and a screen that leans over it
/// (2), after Wang & Molnar 1994, §3.3.
///
/// `bent` makes waves of the ground, an arch of the card and a cylinder's wall of the screen; else all three are
/// plane. Light 0 is at infinity, 50° above the horizon, with a map of 512 × 512; the picture is 1024 × 1024. All
/// casts and receives, nothing is solid.
///
/// # Panics
/// Never: the views are constants.
pub fn sheets(bent: bool) -> Scene {
    use std::f64::consts::{PI, TAU};
    let bend = f64::from(u8::from(bent));
    let pieces = if bent { 64 } else { 1 };
    // v runs from far to near on the ground, so that fronts look up.
    let ground = curved(pieces, pieces, |u, v| {
        let (x, z) = (96.0 * (u - 0.5), 96.0 * (0.5 - v));
        DVec3::new(x, bend * 2.5 * (1.0 - (TAU * x / 32.0).cos()), z)
    });
    let card =
        curved(pieces, pieces, |u, v| DVec3::new(30.0 * u - 36.0, 26.0 + bend * 7.0 * (PI * u).sin(), 22.0 - 34.0 * v));
    let screen = curved(pieces, pieces, |u, v| {
        let push = 6.0 * v + bend * 6.0 * (PI * u).sin();
        let lean = DVec3::new(push, 9.0 + 26.0 * v, -push);
        DVec3::new(6.0 + 26.0 * u, 0.0, 26.0 * u - 16.0) + lean
    });
    let sheet = |name, mesh, material| Object::two_sided(name, Shape::Mesh(mesh), material);
    Scene {
        lights: vec![sun(toward(50.0, 160.0), DVec3::new(0.0, 8.0, 0.0), 76.0, 512)],
        ..small(
            if bent { "sheets-curved" } else { "sheets-planar" },
            vec![sheet("ground", ground, GREY), sheet("card", card, RED), sheet("screen", screen, BLUE)],
            &camera([34.0, 74.0, 128.0], [0.0, 9.0, 0.0], 42.0, [20.0, 400.0], UVec2::splat(1024)),
        )
    }
}

/// Two small balls (objects 1 and 2) close above a large one (object 0), on the side of a light at infinity in
/// direction −x, where the large one turns away from it, after Wang & Molnar 1994, Figure 9.
///
/// The large ball has radius 20 about the origin. The small balls' umbra on it, in full view of the camera, is where
/// N·L lies between 0 and 0.25 for the greater part. Light 0 has 256 × 256 texels; the picture is 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn occluder_sphere() -> Scene {
    const RADIUS: f32 = 20.0;
    // Each stands 4.5 toward the light from a place where N·L is `facing`.
    let small_ball = |facing: f32, height: f32, radius: f32| {
        let across = (1.0 - facing * facing - height * height).sqrt();
        Mesh::sphere(Vec3::new(-facing, height, across) * RADIUS + Vec3::NEG_X * 4.5, radius, 64)
    };
    let balls = [
        ("ball", Mesh::sphere(Vec3::ZERO, RADIUS, 192), Material::matt(GREY.diffuse)),
        ("upper occluder", small_ball(0.14, 0.34, 1.1), RED),
        ("lower occluder", small_ball(0.12, -0.26, 1.5), BLUE),
    ];
    Scene {
        lights: vec![sun(DVec3::NEG_X, DVec3::ZERO, 26.0, 256)],
        ..small(
            "occluder-sphere",
            balls.into_iter().map(|(name, mesh, material)| Object::solid(name, mesh, material)).collect(),
            &camera([-14.0, 12.0, 90.0], [0.0, 0.0, 0.0], 30.0, [20.0, 200.0], UVec2::splat(1024)),
        )
    }
}

/// A row of solids on a floor under a sun 6° above the horizon: a box (object 0), a ball (1), a cylinder (2), a board
/// on edge (3) and the floor (4), a closed slab whose top is y = 0. Shadows are ten times as long as things are high;
/// bias must be large or depths exact.
///
/// Light 0 is at infinity in direction −x, turned a little to +z; its map is 1024 × 1024, and so is the picture.
///
/// # Panics
/// Never: the views are constants.
pub fn grazing() -> Scene {
    let things = [
        ("box", Mesh::cuboid(Vec3::new(-44.0, 0.0, -34.0), Vec3::new(-36.0, 7.0, -26.0)), RED),
        ("ball", Mesh::sphere(Vec3::new(-40.0, 4.0, -12.0), 4.0, 128), OCHRE),
        ("cylinder", Mesh::cylinder(Vec3::new(-40.0, 0.0, 8.0), Vec3::new(-40.0, 9.0, 8.0), 2.5, 96), BLUE),
        ("board", Mesh::cuboid(Vec3::new(-40.4, 0.0, 22.0), Vec3::new(-39.9, 6.0, 34.0)), GREY),
    ];
    let mut objects: Vec<Object> =
        things.into_iter().map(|(name, mesh, material)| Object::solid(name, mesh, material)).collect();
    objects.push(floor(60.0));
    Scene {
        lights: vec![sun(toward(6.0, 172.0), DVec3::ZERO, 90.0, 1024).coloured(Vec3::new(3.0, 2.6, 2.0))],
        ..small(
            "grazing",
            objects,
            &camera([30.0, 62.0, 112.0], [6.0, 0.0, 2.0], 52.0, [20.0, 400.0], UVec2::splat(1024)),
        )
    }
}

fn floor(half: f32) -> Object {
    let slab = Mesh::cuboid(Vec3::new(-half, -SLAB_THICKNESS, -half), Vec3::new(half, 0.0, half));
    Object::solid("floor", slab, GREY)
}

/// A scene without lights yet.
fn small(name: &str, objects: Vec<Object>, camera: &View) -> Scene {
    Scene {
        name: name.into(),
        origin: DVec3::ZERO,
        objects,
        lights: Vec::new(),
        ambient: Vec3::splat(0.15),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera: *camera,
    }
}
