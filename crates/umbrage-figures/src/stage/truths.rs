//! Truths that a run has made already: rays are expensive, and several figures show one scene beside its truth.

use super::many::Many;
use super::memo::Memo;
use umbrage_depth::Map;
use umbrage_plane::View;
use umbrage_recipe::Recipe;
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
    /// Light 0, its map one texel across, of axial depth sampled at centres.
    pub light: View,
    /// The camera that sees it.
    pub camera: View,
    /// How it is sampled, with the run's own seed.
    pub frame: Frame,
    /// The shape that the light is taken for.
    pub rays: Rays,
}

/// All that a map of light 0 depends on.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Baked {
    /// Stands for the objects, as in [`Seen`].
    pub scene: String,
    /// Light 0.
    pub light: View,
    /// The camera, to which the map may be fitted.
    pub camera: View,
    /// What is baked.
    pub recipe: Recipe,
}

/// The truths of one run, and what else takes long to make and has a part in several figures. Clones share what they hold.
#[derive(Clone, Debug, Default)]
pub struct Truths {
    /// One look-up per region, and whether it is shaded.
    pub(crate) pictures: Memo<(Seen, bool), Picture>,
    /// Many rays per pixel, each with what is judged by them.
    pub(crate) many: Memo<Seen, Many>,
    /// Maps of facets.
    pub(crate) maps: Memo<Baked, Map>,
}
