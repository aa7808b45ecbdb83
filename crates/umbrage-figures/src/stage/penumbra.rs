//! What the figures of soft shadows share: widths across a straight edge in world units, radii by D-16, and biases by
//! D-9.

use crate::figure::Context;
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use umbrage_oracle::metrics::Profile;
use umbrage_plane::{SurfacePoint, View};
use umbrage_sample::Key;
use umbrage_shadow::Shadow;

/// A straight edge of a shadow on a plane.
pub struct Edge {
    /// A point of it, world space.
    pub middle: Vec3,
    /// The plane's unit normal.
    pub normal: Vec3,
    /// Unit vector in the plane, square to the edge.
    pub into_shadow: Vec3,
    /// The distance measured across the edge to either side, world units: beyond the whole penumbra.
    pub half_width: f32,
    /// The same along the edge.
    pub half_length: f32,
}

/// Places across an edge, and lines over which their shadows are averaged.
const PLACES: u32 = 161;
const LINES: u32 = 24;

impl Edge {
    /// The mean shadow against the distance across the edge, world units.
    pub fn profile(&self, cx: &Context, shadow: &dyn Shadow) -> Profile {
        let lines = cx.pick(LINES, LINES / 3);
        let along = self.into_shadow.cross(self.normal);
        let signed = |index: u32, count: u32| 2.0 * (index as f32 + 0.5) / count as f32 - 1.0;
        let points: Vec<SurfacePoint> = (0..PLACES * lines)
            .map(|index| {
                let (place, line) = (index / lines, index % lines);
                let across = self.into_shadow * (signed(place, PLACES) * self.half_width);
                let position = self.middle + across + along * (signed(line, lines) * self.half_length);
                SurfacePoint { region: index, ..SurfacePoint::at(position, self.normal) }
            })
            .collect();
        let dark = fractions(cx, shadow, &points);
        let mean = |place: u32| {
            let from = (place * lines) as usize;
            dark[from..from + lines as usize].iter().map(|&dark| f64::from(dark)).sum::<f64>() / f64::from(lines)
        };
        let distance = |place: u32| f64::from(signed(place, PLACES) * self.half_width);
        Profile { points: (0..PLACES).map(|place| (distance(place), mean(place))).collect() }
    }

    /// Its 10–90 % width (M1), world units; NaN without an edge.
    pub fn width(&self, cx: &Context, shadow: &dyn Shadow) -> f64 {
        self.profile(cx, shadow).width().unwrap_or(f64::NAN)
    }
}

/// The shadow of many points at once.
pub fn fractions(cx: &Context, shadow: &dyn Shadow, points: &[SurfacePoint]) -> Vec<f32> {
    const BATCH: usize = 256;
    let key = Key::new(cx.seed, 0, 0);
    let mut dark = vec![0.0; points.len()];
    let batches = points.par_chunks(BATCH).zip(dark.par_chunks_mut(BATCH));
    batches.for_each(|(points, dark)| shadow.fractions(points, key, dark));
    dark
}

/// Their mean.
pub fn mean_shadow(cx: &Context, shadow: &dyn Shadow, points: &[SurfacePoint]) -> f64 {
    fractions(cx, shadow, points).iter().map(|&dark| f64::from(dark)).sum::<f64>() / points.len().max(1) as f64
}

/// Distance of a place along a view's axis.
pub fn axial(view: &View, world: DVec3) -> f64 {
    -view.world_to_eye().transform_point3(world).z
}

/// Half the penumbra of a disc light as Burley's largest radius, texels: exact for occluders at the axial distance
/// `occluder` (D-16).
pub fn burley_max(view: &View, radius: f64, occluder: f64) -> f64 {
    if view.is_perspective() { radius / occluder / view.texel_world(1.0).x } else { f64::NAN }
}

/// World units that a plane's depth changes by over one texel, at a place of it: D-9's g₁ + g₂ when the slope is
/// along an axis. In perspective the slope is that of D-15.
pub fn depth_step(view: &View, world: DVec3, normal: DVec3) -> f64 {
    let eye = view.world_to_eye().transform_point3(world);
    let n = view.world_to_eye().transform_vector3(normal);
    let ray = if view.is_perspective() { eye / -eye.z } else { DVec3::NEG_Z };
    view.texel_world(-eye.z).x * n.truncate().length() / n.dot(ray).abs()
}
