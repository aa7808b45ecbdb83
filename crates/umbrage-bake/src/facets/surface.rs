//! Which facets are one surface.

use glam::DVec2;
use umbrage_depth::NO_FACET;
use umbrage_plane::{Affine, View};

/// Planes over texels, and which of them are one surface.
pub(super) struct Surface<'a> {
    pub view: &'a View,
    pub planes: &'a [Affine],
    pub tolerance: f64,
}

impl Surface<'_> {
    /// The plane of a facet; +∞ everywhere for none.
    #[inline(always)]
    pub fn plane(&self, facet: u32) -> Affine {
        const NOTHING: Affine = Affine::constant(f64::INFINITY);
        self.planes.get(facet as usize).copied().unwrap_or(NOTHING)
    }

    /// Whether a sample lies on its texel's own plane, to the tolerance; `width` is that of the texel, as a key, once it is known.
    pub fn agree(&self, texel: u32, sample: u32, at: DVec2, width: &mut Option<f64>) -> bool {
        if texel == sample {
            return true;
        }
        if texel == NO_FACET || sample == NO_FACET {
            return false;
        }
        let (own, found) = (self.plane(texel).at(at), self.plane(sample).at(at));
        let width = *width.get_or_insert_with(|| self.view.key_width(own.min(found)));
        (own - found).abs() <= self.tolerance * width
    }

    /// Whether two planes meet between two places: they are equal at both, up to rounding.
    #[inline(always)]
    pub fn meet(&self, a: u32, b: u32, places: [DVec2; 2]) -> bool {
        let (a, b) = (self.plane(a), self.plane(b));
        let one = |at: DVec2| {
            let (a, b) = (a.at(at), b.at(at));
            (a - b).abs() <= 4.0 * f64::EPSILON.sqrt() * self.view.key_width(a.min(b))
        };
        one(places[0]) && one(places[1])
    }
}
