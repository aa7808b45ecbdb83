//! The regions of a pixel whose shadow is looked up.

use anyhow::anyhow;
use glam::{DVec4, Vec3};
use std::sync::Mutex;
use umbrage_oracle::Geometry;
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;
use umbrage_shadow::Shadow;

/// One region, the key of its look-up, and the result.
#[derive(Clone, Copy, Debug)]
pub struct Asked {
    pub point: SurfacePoint,
    pub key: Key,
    pub fraction: f32,
}

impl Asked {
    /// Whether it is a region of the pixel with an index.
    pub fn is_of(&self, index: u32) -> bool {
        // As pictures number them: each pixel's from 64 times its index.
        self.point.region.wrapping_sub(index.wrapping_mul(64)) < 64
    }
}

/// A shadow that records its look-ups.
pub struct Recorder<'a> {
    shadow: &'a dyn Shadow,
    asked: Mutex<Vec<Asked>>,
}

impl<'a> Recorder<'a> {
    pub fn new(shadow: &'a dyn Shadow) -> Self {
        Self { shadow, asked: Mutex::new(Vec::new()) }
    }

    /// The look-ups, in the order of the surfaces.
    pub fn asked(self) -> anyhow::Result<Vec<Asked>> {
        self.asked.into_inner().map_err(|_| anyhow!("a worker stopped"))
    }
}

impl Shadow for Recorder<'_> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        self.shadow.fractions(at, key, out);
        if let Ok(mut asked) = self.asked.lock() {
            asked.extend(at.iter().zip(out).map(|(point, fraction)| Asked { point: *point, key, fraction: *fraction }));
        }
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        self.shadow.transmittances(at, key, fractions, out);
    }
}

/// What a ray from a point to a light meets, nearest to the point first: objects and distances, world units. What the point itself lies on is left
/// out.
pub fn blockers(geometry: &Geometry, point: &SurfacePoint, light: DVec4) -> Vec<(u32, f64)> {
    let (way, reach) = if light.w == 0.0 {
        (light.truncate(), f64::INFINITY)
    } else {
        let way = light.truncate() / light.w - point.position;
        (way, way.length())
    };
    // Two surfaces closer than this are one.
    let least = 1e-6 * point.position.distance(geometry.origin()).max(1e-3);
    let hits = geometry.hits(point.position, way).into_iter();
    hits.filter(|hit| hit.t > least && hit.t < reach).map(|hit| (hit.object, hit.t)).collect()
}
