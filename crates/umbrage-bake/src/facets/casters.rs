//! What may be seen in a tile.

use crate::masks::Masks;
use glam::DVec2;
use umbrage_plane::{Facet, TexelRect};
use umbrage_raster::{Gathered, Shown};

/// The facets that may reach a tile, and where they have holes.
pub(super) struct Casters<'a> {
    pub gathered: Gathered<'a>,
    pub masks: &'a Masks<'a>,
}

impl Casters<'_> {
    /// Those among the facets that may be seen in a region (in 1/256 texel). A facet that may have holes hides nothing.
    pub fn shown(&self, region: TexelRect, among: impl IntoIterator<Item = u32>, shown: &mut Vec<Shown>) {
        self.gathered.shown(region, among, |facet| self.masks.of(facet).is_none(), shown);
    }

    /// The only facet that is shown, where it covers the whole region.
    pub fn one(&self, shown: &[Shown]) -> Option<u32> {
        match *shown {
            [Shown { number, covers: true }] if self.masks.of(&self.gathered.facet(number)).is_none() => Some(number),
            _ => None,
        }
    }

    /// Whether a facet has no hole at a place of the map, in texels.
    #[cold]
    pub fn is_there(&self, facet: &Facet, at: DVec2) -> bool {
        self.masks.of(facet).is_none_or(|masked| self.masks.is_there(masked, facet, at))
    }
}
