//! What may be seen in a tile.

use crate::masks::Masks;
use umbrage_plane::TexelRect;
use umbrage_raster::{Gathered, Seen};

/// The facets that may reach a tile, and where they have holes.
pub(super) struct Casters<'a> {
    pub gathered: Gathered<'a>,
    pub masks: &'a Masks<'a>,
}

impl Casters<'_> {
    /// What is nearest all over a region (in 1/256 texel), where its corners decide that. What may have holes never does.
    pub fn seen(&self, region: TexelRect) -> Seen {
        self.gathered.seen(region, |facet| self.masks.of(facet).is_none())
    }
}
