//! The facets that may reach a region, found once for several questions.

use crate::piece::Piece;
use crate::setup::{SUBTEXELS, bounds};
use crate::{BIN, Bins};
use glam::{DVec2, IVec2};
use umbrage_plane::{Affine, Facet, TexelRect};

/// The facets that may reach a region, in the order of their triangles: found once, for several questions about parts of it. Their numbers are 0-based,
/// in that order.
#[derive(Clone, Debug)]
pub struct Gathered<'a> {
    pub(crate) bins: &'a Bins,
    pub(crate) outlines: Vec<Outline<'a>>,
}

/// Where a piece may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outline<'a> {
    piece: &'a Piece,
    pub corners: &'a [IVec2],
    /// The least and the greatest coordinates of its corners, in 1/256 texel.
    pub low: IVec2,
    pub high: IVec2,
}

impl Outline<'_> {
    #[inline(always)]
    fn touches(&self, region: TexelRect) -> bool {
        self.low.cmplt(region.max).all() && self.high.cmpge(region.min).all()
    }

    #[inline(always)]
    fn is_inside(&self, region: TexelRect) -> bool {
        self.low.cmpge(region.min).all() && self.high.cmple(region.max).all()
    }
}

/// A facet that may be seen in a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shown {
    /// Its number among those that were gathered.
    pub number: u32,
    /// Whether it covers all of the region.
    pub covers: bool,
}

impl Bins {
    /// What may reach a region of 1/256 texels, for questions about it and about parts of it.
    pub fn gathered(&self, region: TexelRect) -> Gathered<'_> {
        let side = BIN as i32 * SUBTEXELS;
        let (from, to) = (region.min.max(IVec2::ZERO) / side, (region.max - 1).div_euclid(IVec2::splat(side)));
        let outline = |number: u32| {
            let (piece, corners) = self.piece(number);
            let (low, high) = bounds(corners);
            let outline = Outline { piece, corners, low, high };
            outline.touches(region).then_some(outline)
        };
        let mut outlines = Vec::new();
        if region.max.cmple((from + 1) * side + self.beyond()).all() {
            outlines.reserve(self.reaching(from.as_uvec2()));
            for list in self.lists(from.as_uvec2()) {
                outlines.extend(list.iter().filter_map(|number| outline(*number)));
            }
        } else {
            // Of a tile that lies in the region almost all reaches it; of one beside it almost nothing.
            let is_whole =
                |tile: IVec2| (tile * side).cmpge(region.min).all() && ((tile + 1) * side).cmple(region.max).all();
            let mut numbers: Vec<u32> = Vec::new();
            for tile in TexelRect::new(from, to + 1).texels() {
                for list in self.lists(tile.as_uvec2()) {
                    if is_whole(tile) {
                        numbers.extend_from_slice(list);
                    } else {
                        numbers.extend(list.iter().filter(|number| outline(**number).is_some()));
                    }
                }
            }
            outlines.reserve(numbers.len());
            outlines.extend(merge(numbers).into_iter().filter_map(outline));
        }
        Gathered { bins: self, outlines }
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

    /// A facet by its number.
    ///
    /// # Panics
    /// When there is none of that number.
    #[inline(always)]
    pub fn facet(&self, number: u32) -> Facet {
        self.outlines[number as usize].piece.facet()
    }

    /// The least and the greatest coordinates of a facet's corners, in 1/256 texel.
    ///
    /// # Panics
    /// When there is none of that number.
    #[inline(always)]
    pub fn bounds(&self, number: u32) -> (IVec2, IVec2) {
        let outline = &self.outlines[number as usize];
        (outline.low, outline.high)
    }

    /// No more than any key that a facet has at those of its points that lie in a region (in 1/256 texel), however it is computed.
    ///
    /// # Panics
    /// When there is none of that number.
    #[inline(always)]
    pub fn least_key(&self, number: u32, region: TexelRect) -> f64 {
        let Outline { piece, low, high, .. } = &self.outlines[number as usize];
        let plane = piece.plane;
        let low = low.max(region.min).as_dvec2() / f64::from(SUBTEXELS);
        let high = high.min(region.max).as_dvec2() / f64::from(SUBTEXELS);
        let (across, down) = ((plane.dx * low.x).min(plane.dx * high.x), (plane.dy * low.y).min(plane.dy * high.y));
        plane.c + across + down - rounding(&plane, region.max.as_dvec2() / f64::from(SUBTEXELS))
    }

    /// Those `among` the facets that may be seen in a part of the region (in 1/256 texel), in the same order: their outlines reach it, and they do
    /// not lie behind another one all over it, one that covers the part and `fills` what it covers. `shown` is emptied first.
    ///
    /// # Panics
    /// When there is none of one of the numbers.
    pub fn shown(
        &self,
        part: TexelRect,
        among: impl IntoIterator<Item = u32>,
        fills: impl Fn(&Facet) -> bool,
        shown: &mut Vec<Shown>,
    ) {
        let corners = [part.min, IVec2::new(part.max.x, part.min.y), part.max, IVec2::new(part.min.x, part.max.y)]
            .map(|corner| corner.as_dvec2() / f64::from(SUBTEXELS));
        let mut nearest: Option<(u32, [f64; 4])> = None;
        shown.clear();
        for number in among {
            let outline = &self.outlines[number as usize];
            if !outline.touches(part) {
                continue;
            }
            // One that lies wholly in the part reaches it, and cannot cover it.
            let Some(covers) = (if outline.is_inside(part) { Some(false) } else { reaches(outline.corners, part) })
            else {
                continue;
            };
            if covers {
                let facet = outline.piece.facet();
                let keys = corners.map(|corner| facet.plane.at(corner));
                if nearest.is_none_or(|(_, nearest)| keys[0].total_cmp(&nearest[0]).is_lt()) && fills(&facet) {
                    nearest = Some((number, keys));
                }
            }
            shown.push(Shown { number, covers });
        }
        if let Some((one, nearest)) = nearest {
            let of_one = rounding(&self.facet(one).plane, corners[2]);
            shown.retain(|shown| {
                let plane = self.facet(shown.number).plane;
                let least = of_one + rounding(&plane, corners[2]);
                let behind = || nearest.iter().zip(corners).all(|(nearest, corner)| nearest + least < plane.at(corner));
                shown.number == one || !behind()
            });
        }
    }
}

/// Sorts a few sorted lists that follow one another, and leaves out what stands in several.
fn merge(mut numbers: Vec<u32>) -> Vec<u32> {
    #[expect(clippy::stable_sort_primitive, reason = "a stable sort merges what is sorted")]
    numbers.sort();
    numbers.dedup();
    numbers
}

/// More than what a plane's keys may be off by roundings, however they are computed, at places from the map's upper left corner to `most`, in texels:
/// also as multiples of the difference of two keys, up to 64 times it.
#[inline(always)]
fn rounding(plane: &Affine, most: DVec2) -> f64 {
    512.0 * f64::EPSILON * (plane.c.abs() + plane.dx.abs() * most.x + plane.dy.abs() * most.y)
}

/// `None` where an outline surely has no point in a rectangle, otherwise whether the rectangle surely lies inside of it; of an outline of more
/// than three corners neither is known.
#[inline(always)]
fn reaches(outline: &[IVec2], rect: TexelRect) -> Option<bool> {
    let [a, b, c] = *outline else { return Some(false) };
    let inward = (b - a).as_i64vec2().perp_dot((c - a).as_i64vec2()).signum();
    let size = (rect.max - rect.min).as_i64vec2();
    let mut covers = true;
    for (a, b) in [(a, b), (b, c), (c, a)] {
        // Twice the area between the side and a point: what it is at the rectangle's first corner, and how it changes from there.
        let along = (b - a).as_i64vec2() * inward;
        let first = along.perp_dot((rect.min - a).as_i64vec2());
        let (across, down) = (-along.y * size.x, along.x * size.y);
        if first + across.max(0) + down.max(0) < 0 {
            return None;
        }
        covers &= first + across.min(0) + down.min(0) > 0;
    }
    Some(covers)
}
