//! Truths that a run has made already: rays are expensive, and several figures show one scene beside its truth.

use super::many::Many;
use super::memo::Memo;
use umbrage_plane::View;
use umbrage_render::{Frame, Picture};

/// What rays are sent to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rays {
    /// The light's centre: one hard result.
    Hard,
    /// A disc in the light's place.
    Disc {
        /// World units, or the tangent of its angle when the light is directional.
        radius: f64,
        /// Rays to each point.
        samples: u32,
    },
}

/// All that a truth depends on.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Seen {
    /// Stands for the objects: a scene that is changed must be renamed.
    pub scene: String,
    /// Light 0, its map one texel across.
    pub light: View,
    /// The camera that sees it.
    pub camera: View,
    /// How it is sampled, with the run's own seed.
    pub frame: Frame,
    /// The shape that the light is taken for.
    pub rays: Rays,
}

/// The truths of one run. Clones share what they hold.
#[derive(Clone, Debug, Default)]
pub struct Truths {
    /// One look-up per region, and whether it is shaded.
    pub(crate) pictures: Memo<(Seen, bool), Picture>,
    /// Many rays per pixel, each with what is judged by them.
    pub(crate) many: Memo<Seen, Many>,
}
