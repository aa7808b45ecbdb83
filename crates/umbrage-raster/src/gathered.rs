//! The facets that may reach a region, found once for several questions.

use crate::setup::{SUBTEXELS, bounds};
use crate::{BIN, Bins};
use glam::IVec2;
use umbrage_plane::{Facet, TexelRect};

/// Regions that more pieces may reach are not asked what is nearest.
const MOST_ASKED: usize = 32;

/// What is nearest all over a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seen {
    /// Nothing reaches it.
    Nothing,
    /// One facet covers it, and lies before whatever else reaches it.
    One(Facet),
    /// It may be several, or one with gaps.
    Several,
}

/// The facets that may reach a region, in the order of their triangles: found once, for several questions about parts of it.
#[derive(Clone, Debug)]
pub struct Gathered<'a> {
    pub(crate) bins: &'a Bins,
    pub(crate) outlines: Vec<Outline>,
}

/// Where a piece may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outline {
    pub piece: u32,
    /// The least and the greatest coordinates of its corners, in 1/256 texel.
    pub low: IVec2,
    pub high: IVec2,
}

impl Outline {
    #[inline(always)]
    pub fn touches(&self, region: TexelRect) -> bool {
        self.low.cmplt(region.max).all() && self.high.cmpge(region.min).all()
    }

    #[inline(always)]
    pub fn bounds(&self) -> TexelRect {
        TexelRect::new(self.low, self.high + 1)
    }
}

impl Bins {
    /// What may reach a region of 1/256 texels, for questions about it and about parts of it.
    pub fn gathered(&self, region: TexelRect) -> Gathered<'_> {
        let side = BIN as i32 * SUBTEXELS;
        let (from, to) = (region.min.max(IVec2::ZERO) / side, (region.max - 1).div_euclid(IVec2::splat(side)));
        let mut outlines = Vec::new();
        for tile in TexelRect::new(from, to + 1).texels() {
            outlines.extend(self.list(tile.as_uvec2()).iter().filter_map(|&piece| {
                let (low, high) = bounds(self.piece(piece).1);
                let outline = Outline { piece, low, high };
                outline.touches(region).then_some(outline)
            }));
        }
        // The lists are sorted, and a stable sort merges what is.
        outlines.sort_by_key(|outline| outline.piece);
        outlines.dedup_by_key(|outline| outline.piece);
        Gathered { bins: self, outlines }
    }

    /// What is nearest all over a region (in 1/256 texel), where its corners decide that: then no sample in it needs to be asked.
    pub fn seen(&self, region: TexelRect) -> Seen {
        self.gathered(region).seen(region, |_| true)
    }
}

impl Gathered<'_> {
    /// How many facets they are.
    pub fn len(&self) -> usize {
        self.outlines.len()
    }

    /// Whether nothing reaches the region.
    pub fn is_empty(&self) -> bool {
        self.outlines.is_empty()
    }

    /// [`Bins::seen`] of a part of what was gathered, where a facet that covers the part counts as doing so only if it `fills` what it covers.
    pub fn seen(&self, region: TexelRect, fills: impl Fn(&Facet) -> bool) -> Seen {
        let mut asked = Vec::with_capacity(MOST_ASKED);
        for outline in self.outlines.iter().filter(|outline| outline.touches(region)) {
            if asked.len() == MOST_ASKED {
                return Seen::Several;
            }
            asked.push(outline);
        }
        if asked.is_empty() {
            return Seen::Nothing;
        }
        let corners =
            [region.min, IVec2::new(region.max.x, region.min.y), region.max, IVec2::new(region.min.x, region.max.y)];
        let keys = |facet: &Facet| corners.map(|corner| facet.plane.at(corner.as_dvec2() / f64::from(SUBTEXELS)));
        let mut nearest: Option<(Facet, [f64; 4])> = None;
        for outline in &asked {
            // Strictly inside is inside the bounding box.
            if !(outline.low.cmplt(region.min).all() && outline.high.cmpgt(region.max).all()) {
                continue;
            }
            let (piece, corner) = self.bins.piece(outline.piece);
            let facet = piece.facet();
            if corners.iter().all(|at| holds(corner, *at)) && fills(&facet) {
                let own = keys(&facet);
                if nearest.is_none_or(|(_, keys)| own[0].total_cmp(&keys[0]).is_lt()) {
                    nearest = Some((facet, own));
                }
            }
        }
        let Some((one, nearest)) = nearest else { return Seen::Several };
        let behind = |outline: &&Outline| {
            let other = self.bins.piece(outline.piece).0.facet();
            other.triangle == one.triangle || nearest.iter().zip(keys(&other)).all(|(a, b)| *a < b)
        };
        if asked.iter().all(behind) { Seen::One(one) } else { Seen::Several }
    }
}

/// Whether a triangle surely has a point strictly inside; never for an outline of more corners.
fn holds(outline: &[IVec2], at: IVec2) -> bool {
    let side = |a: IVec2, b: IVec2| (b - a).as_i64vec2().perp_dot((at - a).as_i64vec2()).signum();
    let [a, b, c] = *outline else { return false };
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides == [1; 3] || sides == [-1; 3]
}
