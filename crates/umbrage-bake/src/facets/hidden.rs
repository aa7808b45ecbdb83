//! Which facets lie behind all that is seen of a part.

use super::casters::Casters;
use umbrage_plane::TexelRect;
use umbrage_raster::Shown;

/// Of fewer facets it is not determined which are hidden: what that takes is not saved.
const FEW: usize = 8;

/// How much farther than the centres of texels other places of a part are supposed to see, over the difference of the centres' own keys.
const FARTHER: f64 = 0.25;

/// Facets that are left out of a part for as long as nothing is seen in it beyond them.
pub(super) struct Hidden {
    facets: Vec<Shown>,
    /// No facet that is left out has a lesser key in the part; +∞ when there is none.
    pub least: f64,
}

impl Default for Hidden {
    fn default() -> Self {
        Self { facets: Vec::new(), least: f64::INFINITY }
    }
}

impl Hidden {
    /// Takes those of the facets shown in a region (in 1/256 texel) that lie behind all that is probably seen there, by the least and the greatest key
    /// of some points of it. What is left out is to be put back where anything else is seen beyond [`least`](Self::least).
    #[inline(always)]
    pub fn take(&mut self, casters: &Casters<'_>, region: TexelRect, shown: &mut Vec<Shown>, [near, far]: [f64; 2]) {
        let Self { facets, least } = self;
        facets.clear();
        *least = f64::INFINITY;
        if shown.len() < FEW || far == f64::INFINITY {
            return;
        }
        let limit = far + FARTHER * (far - near);
        facets.extend(shown.extract_if(.., |shown| {
            let key = casters.gathered.least_key(shown.number, region);
            if key > limit {
                *least = least.min(key);
            }
            key > limit
        }));
    }

    /// Puts all facets back where they were taken from, and keeps none.
    #[cold]
    pub fn put_back(&mut self, shown: &mut Vec<Shown>) {
        shown.append(&mut self.facets);
        shown.sort_unstable_by_key(|shown| shown.number);
        self.least = f64::INFINITY;
    }
}
