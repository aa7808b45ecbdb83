//! What may be seen in a tile.

use crate::masks::Masks;
use glam::DVec2;
use umbrage_plane::TexelRect;
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

    /// Whether a facet may have holes.
    #[inline(always)]
    pub fn is_masked(&self, number: u32) -> bool {
        self.masks.of(&self.gathered.facet(number)).is_some()
    }

    /// The only facet that is shown, where it covers the whole region.
    pub fn one(&self, shown: &[Shown]) -> Option<u32> {
        match *shown {
            [Shown { number, covers: true }] if !self.is_masked(number) => Some(number),
            _ => None,
        }
    }

    /// Of some places, a bit for each, those where a facet has no hole; `place` gives them in texels of the map.
    #[cold]
    pub fn there(&self, number: u32, among: u64, place: impl Fn(usize) -> DVec2) -> u64 {
        let facet = self.gathered.facet(number);
        let Some(masked) = self.masks.of(&facet) else { return among };
        bits(among).filter(|bit| self.masks.is_there(masked, &facet, place(*bit))).map(|bit| 1 << bit).sum()
    }
}

/// The numbers of the bits that are set, ascending.
#[inline(always)]
pub(super) fn bits(mut set: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(
        #[inline(always)]
        move || {
            let next = (set != 0).then_some(set.trailing_zeros() as usize);
            set &= set.wrapping_sub(1);
            next
        },
    )
}
