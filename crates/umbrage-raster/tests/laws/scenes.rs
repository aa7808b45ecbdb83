//! Strategies for meshes and places.

use crate::oracle::solid;
use glam::{DVec3, EulerRot, Quat, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_plane::Sampling;
use umbrage_raster::Triangle;

/// Both ways of sampling.
pub fn samplings() -> impl Strategy<Value = Sampling> {
    prop_oneof![Just(Sampling::Centre), any::<u32>().prop_map(|seed| Sampling::Jittered { seed })]
}

/// Small maps, prime and odd sizes among them, one texel wide too.
pub fn sizes() -> impl Strategy<Value = UVec2> {
    let side = || prop_oneof![Just(1_u32), Just(37), Just(61), Just(32), 2_u32..70];
    (side(), side()).prop_map(UVec2::from)
}

/// A direction and turn.
pub fn turns() -> impl Strategy<Value = Quat> {
    let angle = || -3.2_f32..3.2;
    (angle(), angle(), angle()).prop_map(|(x, y, z)| Quat::from_euler(EulerRot::XYZ, x, y, z))
}

/// A place in a cube about the origin.
pub fn places(half: f64) -> impl Strategy<Value = DVec3> {
    let axis = move || -half..half;
    (axis(), axis(), axis()).prop_map(DVec3::from)
}

/// The twelve triangles of a turned box, counter-clockwise from outside.
pub fn cuboid(centre: Vec3, half: Vec3, turn: Quat) -> Vec<Triangle> {
    let corner = |index: usize| {
        let sign = |bit: usize| if index >> bit & 1 == 1 { 1.0 } else { -1.0 };
        centre + turn * (half * Vec3::new(sign(0), sign(1), sign(2)))
    };
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(|face| solid(face.map(corner))).collect()
}

/// A ball of `rings` × `around` facets whose radius at each corner is drawn from `radius` in turn: round, or as bumpy as that is.
pub fn ball(centre: Vec3, radius: &[f32], rings: usize, around: usize, turn: Quat) -> Vec<Triangle> {
    let corner = |ring: usize, step: usize| {
        let step = if ring == 0 || ring == rings { 0 } else { step % around };
        let polar = std::f32::consts::PI * ring as f32 / rings as f32;
        let azimuth = std::f32::consts::TAU * step as f32 / around as f32;
        let (sin, cos) = if ring == rings { (0.0, -1.0) } else { polar.sin_cos() };
        let direction = Vec3::new(sin * azimuth.cos(), cos, -sin * azimuth.sin());
        centre + turn * direction * radius[(ring * around + step) % radius.len()]
    };
    let mut made = Vec::new();
    for (ring, step) in (0..rings).flat_map(|ring| (0..around).map(move |step| (ring, step))) {
        let [a, b] = [corner(ring, step), corner(ring, step + 1)];
        let [c, d] = [corner(ring + 1, step), corner(ring + 1, step + 1)];
        if ring > 0 {
            made.push(solid([a, d, b]));
        }
        if ring + 1 < rings {
            made.push(solid([a, c, d]));
        }
    }
    made
}
