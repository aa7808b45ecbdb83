use crate::error::Fault;
use std::fmt::Display;
use umbrage_plane::View;

/// The nearest depth that a file may hold. A file of another maker holds nothing before its near plane but what no surface can
/// have made, such as 0 for a background; our own depths were clamped to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    least: f32,
    near: f64,
}

impl Nearest {
    /// Of a file that other makers wrote, unless it has a digest of ours. Their depths may be rounded by a thousandth.
    pub(crate) fn of(view: &View, digest: Option<u64>) -> Self {
        let near = view.near();
        let slack = 1e-3 * if view.is_perspective() { near } else { view.far() - near };
        Self { least: if digest.is_some() { f32::NEG_INFINITY } else { (near - slack) as f32 }, near }
    }

    /// The depth, unless it lies before the near plane; `name` is the value's.
    pub(crate) fn check(self, depth: f32, name: impl FnOnce() -> String) -> Result<f32, Fault> {
        if depth < self.least { Err(Fault::new(name(), depth, self)) } else { Ok(depth) }
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
