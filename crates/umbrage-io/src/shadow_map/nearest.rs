use crate::error::Fault;
use std::fmt::Display;
use umbrage_plane::{Kind, View};

/// The nearest depth that a file may hold, and where nothing was seen. A file of another maker holds nothing before its near plane but what
/// no surface can have made, such as 0 for a background; our own depths were clamped to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    least: f32,
    near: f64,
    /// From here on no surface was seen: the far plane of a z-buffer, which is cleared to it.
    none: f32,
}

impl Nearest {
    /// Of a file that other makers wrote, unless it has a digest of ours. Their depths may be rounded by a thousandth.
    pub(crate) fn of(view: &View, digest: Option<u64>) -> Self {
        let (near, slack, none) = match view.kind() {
            Kind::Screen => (0.0, 1e-3, 1.0),
            _ if view.is_perspective() => (view.near(), 1e-3 * view.near(), f32::INFINITY),
            _ => (view.near(), 1e-3 * (view.far() - view.near()), f32::INFINITY),
        };
        if digest.is_some() {
            return Self { least: f32::NEG_INFINITY, near, none: f32::INFINITY };
        }
        Self { least: (near - slack) as f32, near, none }
    }

    /// The depth, +∞ where nothing was seen, unless it lies before the near plane; `name` is the value's.
    pub(crate) fn check(self, depth: f32, name: impl FnOnce() -> String) -> Result<f32, Fault> {
        if self.refuses(depth) {
            return Err(Fault::new(name(), depth, self));
        }
        Ok(self.seen(depth))
    }

    /// A depth that is not refused; +∞ where nothing was seen.
    pub(crate) fn seen(self, depth: f32) -> f32 {
        if depth >= self.none { f32::INFINITY } else { depth }
    }

    /// Whether a depth lies before the near plane.
    pub(crate) fn refuses(self, depth: f32) -> bool {
        depth < self.least
    }
}

impl Display for Nearest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "before the near plane at {}: no surface can be there, and a texel without one holds +inf", self.near)
    }
}
