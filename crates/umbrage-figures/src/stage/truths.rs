//! Truths that a run has made already: rays are expensive, and several figures show one scene beside its truth.

use std::sync::{Arc, Mutex};
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

type Known = (Seen, Arc<Picture>);

/// The truths of one run. Clones share what they hold.
#[derive(Clone, Debug, Default)]
pub struct Truths {
    made: Arc<Mutex<Vec<Known>>>,
}

impl Truths {
    /// The picture for `seen`, made only the first time.
    pub(crate) fn once(&self, seen: Seen, make: impl FnOnce() -> Picture) -> Arc<Picture> {
        if let Some(known) = self.known(&seen) {
            return known;
        }
        // Nothing is locked meanwhile: a picture takes all threads, and two callers at once make the same bits.
        let picture = Arc::new(make());
        if let Ok(mut made) = self.made.lock() {
            made.push((seen, picture.clone()));
        }
        picture
    }

    fn known(&self, seen: &Seen) -> Option<Arc<Picture>> {
        let made = self.made.lock().ok()?;
        made.iter().find(|(other, _)| other == seen).map(|(_, picture)| picture.clone())
    }
}
