//! How long look-ups take.

use glam::Vec3;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;
use umbrage_shadow::Shadow;

/// A shadow whose look-ups are timed, each on its own thread.
pub struct Timed<'a> {
    shadow: &'a dyn Shadow,
    nanoseconds: AtomicU64,
    count: AtomicU64,
}

impl<'a> Timed<'a> {
    pub fn new(shadow: &'a dyn Shadow) -> Self {
        Self { shadow, nanoseconds: AtomicU64::new(0), count: AtomicU64::new(0) }
    }

    /// Mean time of a look-up, nanoseconds; `None` before the first.
    pub fn mean(&self) -> Option<f64> {
        let count = self.count.load(Ordering::Relaxed);
        (count > 0).then(|| self.nanoseconds.load(Ordering::Relaxed) as f64 / count as f64)
    }
}

impl Shadow for Timed<'_> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        let start = Instant::now();
        self.shadow.fractions(at, key, out);
        self.nanoseconds.fetch_add(start.elapsed().as_nanos() as u64, Ordering::Relaxed);
        self.count.fetch_add(at.len() as u64, Ordering::Relaxed);
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        self.shadow.transmittances(at, key, fractions, out);
    }
}
