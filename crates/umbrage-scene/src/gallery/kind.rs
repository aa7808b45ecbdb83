//! What the scenes of kinds are made with: things on a floor, under a light of each of two variants.

use super::views::{camera, lamp, sun, toward};
use crate::{Light, Material, Mesh, Object, Scene, Shape};
use glam::{DMat4, DVec3, UVec2, Vec3};

const GREY: Material = Material::matt(Vec3::new(0.62, 0.60, 0.56));
const BLUE: Material = Material::plastic(Vec3::new(0.12, 0.26, 0.66));

/// Numbers in 0..1 that a scene is made of.
pub(super) struct Numbers(u32);

impl Numbers {
    pub(super) fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / 16_777_216.0
    }

    /// From `low` to `high`.
    pub(super) fn from(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.next()
    }
}

/// A scene of a kind while it is made. Each thing is an object of its own, the floor the last.
pub(super) struct Kind {
    name: &'static str,
    /// Elevation and bearing of the sun in degrees, for each variant; it is a lamp in that direction where the elevation is
    /// negative.
    lights: [(f64, f64); 2],
    pub(super) numbers: Numbers,
    /// 0 or 1.
    pub(super) variant: u32,
    /// What the next things are made of.
    pub(super) paint: Material,
    objects: Vec<Object>,
}

impl Kind {
    pub(super) fn new(names: [&'static str; 2], variant: u32, lights: [(f64, f64); 2]) -> Self {
        let numbers = Numbers(variant.wrapping_mul(77_777).wrapping_add(names[0].len() as u32 * 131));
        let name = names[variant.min(1) as usize];
        Self { name, lights, numbers, variant: variant.min(1), paint: BLUE, objects: Vec::new() }
    }

    /// One of two values, by variant.
    pub(super) fn either<T>(&self, first: T, second: T) -> T {
        if self.variant == 0 { first } else { second }
    }

    /// A closed mesh.
    pub(super) fn solid(&mut self, mesh: Mesh) {
        let name = format!("thing {}", self.objects.len());
        self.objects.push(Object::solid(&name, mesh, self.paint));
    }

    /// An open mesh, seen from both sides.
    pub(super) fn sheet(&mut self, mesh: Mesh) {
        let name = format!("thing {}", self.objects.len());
        self.objects.push(Object::two_sided(&name, Shape::Mesh(mesh), self.paint));
    }

    pub(super) fn cuboid(&mut self, low: Vec3, high: Vec3) {
        self.solid(Mesh::cuboid(low, high));
    }

    /// A box of half-extents `half` about `middle`, turned about an axis through it.
    pub(super) fn turned(&mut self, middle: Vec3, half: Vec3, axis: Vec3, degrees: f32) {
        self.solid(turned(Mesh::cuboid(-half, half), middle, axis, degrees));
    }

    pub(super) fn rod(&mut self, from: Vec3, to: Vec3, radius: f32) {
        self.solid(Mesh::cylinder(from, to, radius, 12));
    }

    fn light(&self) -> Light {
        let (elevation, bearing) = self.lights[self.variant as usize];
        if elevation < 0.0 {
            let to_lamp = toward(-elevation, bearing);
            return lamp(to_lamp * 70.0, DVec3::ZERO, 62.0, [20.0, 120.0], 512);
        }
        sun(toward(elevation, bearing), DVec3::ZERO, 36.0, 512)
    }

    pub(super) fn scene(mut self) -> Scene {
        let floor = Mesh::cuboid(Vec3::new(-24.0, -2.0, -24.0), Vec3::new(24.0, 0.0, 24.0));
        let light = self.light();
        self.objects.push(Object::solid("floor", floor, GREY));
        Scene {
            name: self.name.into(),
            origin: DVec3::ZERO,
            objects: self.objects,
            lights: vec![light],
            ambient: Vec3::splat(0.15),
            background: Vec3::new(0.02, 0.02, 0.03),
            camera: camera([26.0, 30.0, 44.0], [0.0, 4.0, 0.0], 42.0, [4.0, 200.0], UVec2::splat(512)),
        }
    }
}

/// A mesh turned about an axis through its own origin, then carried to `place`.
pub(super) fn turned(mesh: Mesh, place: Vec3, axis: Vec3, degrees: f32) -> Mesh {
    let turn = DMat4::from_axis_angle(axis.as_dvec3(), f64::from(degrees).to_radians());
    mesh.transformed(&(DMat4::from_translation(place.as_dvec3()) * turn))
}
