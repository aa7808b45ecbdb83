//! Why a receiver is lit or dark: every place of its region, the votes of the samples around it, and where the edge runs between them.

use super::asked::{Asked, FAR};
use super::edges::Edges;
use super::grid::Grid;
use super::voters::{LANES, Voters};
use crate::{Crossing, PlaceJudged, Probe, Vote};
use fearless_simd::Simd;
use glam::{DVec2, IVec2, UVec2};
use umbrage_depth::{FacetSample, FacetSource};
use umbrage_plane::TexelRect;

/// The corners of a cell's sides: upper, lower, left, right.
const SIDES: [(usize, usize); 4] = [(0, 1), (2, 3), (0, 2), (1, 3)];

/// Reports each judged place to a probe. Every place is judged by itself, with the same result as all together.
#[inline(never)]
pub(super) fn explain<S: Simd, F: FacetSource + ?Sized>(simd: S, asked: &Asked<'_, F>, probe: &mut impl Probe) {
    asked.share(true, |at| {
        if at.abs().max_element() < FAR {
            let place = judged(simd, asked, at);
            probe.judged(&place);
            return place.dark;
        }
        asked.ruled(at).is_some_and(|dark| dark > 0.0)
    });
}

fn judged<S: Simd, F: FacetSource + ?Sized>(simd: S, asked: &Asked<'_, F>, at: DVec2) -> PlaceJudged {
    let corner = (at * f64::from(asked.map.fine()) - 0.5).floor().as_ivec2();
    let mut grid = Grid::<F, 4, 1>::empty(asked, TexelRect::new(corner, corner + 2));
    grid.fill(simd);
    let mut edges = Edges::of(&grid);
    let votes = [0, 1, 2, 3].map(|k| {
        let sample = asked.map.sample(corner + IVec2::new(k & 1, k >> 1));
        vote(simd, asked, &sample, at)
    });
    let crossed = |(from, to): (usize, usize)| -> Option<Crossing> {
        (votes[from].dark != votes[to].dark).then(|| edges.crossing(UVec2::ZERO, from, to))
    };
    let ruled = asked.ruled(at).map(|dark| dark > 0.0);
    PlaceJudged { at, ruled, votes, crossings: SIDES.map(crossed), dark: ruled.unwrap_or_else(|| edges.dark(at)) }
}

fn vote<S: Simd, F: FacetSource + ?Sized>(simd: S, asked: &Asked<'_, F>, sample: &FacetSample, at: DVec2) -> Vote {
    let (voters, nothing) = (Voters::of(simd, &asked.compared, &[*sample; LANES]), sample.plane.c == f64::INFINITY);
    let (there, passed) = voters.there(0);
    let world = |key: f64| if nothing { f64::NEG_INFINITY } else { key / asked.per_world };
    Vote {
        sample: *sample,
        at_sample: world(there + passed),
        at_place: world(voters.behind(0).at(at) + passed),
        passed: if nothing { 0.0 } else { passed / asked.per_world },
        dark: voters.dark(0, at),
    }
}
