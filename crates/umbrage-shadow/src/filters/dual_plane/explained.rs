//! Why a receiver is lit or dark: every place of its region, what the samples around it say, and where the edge runs between them.

use super::asked::{Asked, FAR, Grid, Voter};
use crate::{Crossing, PlaceJudged, Probe, Vote};
use glam::{DVec2, IVec2, UVec2};
use umbrage_depth::{FacetSample, FacetSource};
use umbrage_plane::TexelRect;

/// The corners of a cell's sides: upper, lower, left, right.
const SIDES: [(usize, usize); 4] = [(0, 1), (2, 3), (0, 2), (1, 3)];

/// Tells a probe of each place that is asked about. Every one is looked at by itself, which gives what all together do.
#[inline(never)]
pub(super) fn explain<F: FacetSource + ?Sized>(asked: &Asked<'_, F>, probe: &mut impl Probe) {
    asked.share(true, |at| {
        if at.abs().max_element() < FAR {
            let place = judged(asked, at);
            probe.judged(&place);
            return place.dark;
        }
        asked.ruled(at).is_some_and(|dark| dark > 0.0)
    });
}

fn judged<F: FacetSource + ?Sized>(asked: &Asked<'_, F>, at: DVec2) -> PlaceJudged {
    let corner = (at * f64::from(asked.map.fine()) - 0.5).floor().as_ivec2();
    let grid = Grid::<F, 4>::new(asked, TexelRect::new(corner, corner + 2));
    let votes = [0, 1, 2, 3].map(|k| {
        let sample = asked.map.sample(corner + IVec2::new(k & 1, k >> 1));
        vote(asked, &sample, at)
    });
    let crossed = |(from, to): (usize, usize)| -> Option<Crossing> {
        (votes[from].dark != votes[to].dark).then(|| grid.crossing(UVec2::ZERO, from, to))
    };
    let ruled = asked.ruled(at).map(|dark| dark > 0.0);
    PlaceJudged { at, ruled, votes, crossings: SIDES.map(crossed), dark: ruled.unwrap_or_else(|| grid.dark(at)) }
}

fn vote<F: FacetSource + ?Sized>(asked: &Asked<'_, F>, sample: &FacetSample, at: DVec2) -> Vote {
    let voter: Voter = asked.voter(sample);
    let world = |key: f64| if sample.plane.c == f64::INFINITY { f64::NEG_INFINITY } else { key / asked.per_world };
    Vote {
        sample: *sample,
        at_sample: world(voter.there + voter.passed),
        at_place: world(voter.behind.at(at) + voter.passed),
        passed: voter.passed / asked.per_world,
        dark: voter.dark(at),
    }
}
