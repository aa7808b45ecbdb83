//! Pass 1 for what a recipe stores.

use crate::values::{Rule, Values};
use std::iter;
use std::sync::Arc;
use umbrage_bake::{
    Baked, Casting, bake, bake_by_normals, bake_deep, bake_facets, bake_multi, bake_refined, mix_moments,
};
use umbrage_depth::{BackFace, DepthRule, First, Map, Second, Tiled};
use umbrage_plane::View;
use umbrage_raster::{Cull, Stats};

/// The [casters of one moment](moment), whose masks live for `'m`.
pub(crate) type Moment<'a, 'm> = iter::Flatten<Box<dyn Iterator<Item = Vec<Casting<'m>>> + 'a>>;

/// Casters that are taken from behind a `dyn` at once.
const AT_ONCE: usize = 256;

/// The casters of one moment, of one type whatever gives them. They come many at a time: with a call through a table for each of them, bakes of a million
/// triangles took a fifth longer.
pub(crate) fn moment<'a, 'm: 'a>(casters: impl Iterator<Item = Casting<'m>> + 'a) -> Moment<'a, 'm> {
    let mut casters = casters.fuse();
    let chunks = iter::from_fn(move || {
        let mut chunk = Vec::with_capacity(AT_ONCE);
        // Not `extend`: an iterator of iterators is run through faster from within.
        casters.by_ref().take(AT_ONCE).for_each(|casting| chunk.push(casting));
        (!chunk.is_empty()).then_some(chunk)
    });
    let chunks: Box<dyn Iterator<Item = _> + 'a> = Box::new(chunks);
    chunks.flatten()
}

impl Values {
    /// `moments` are at evenly spread times: deep maps hold their mean, and of rules that keep one surface each texel sees one of them.
    pub fn bake(&self, view: &View, moments: &mut dyn Iterator<Item = Moment<'_, '_>>) -> (Map, Stats) {
        if self.rule == Rule::Facets {
            // Over an exposure, the first moment's: what moves is for a mean of maps.
            let casters = moments.next().into_iter().flatten();
            let refinement = self.refinement(view.size().max_element());
            let baked = match refinement.fine {
                1 => bake_facets(view, casters, &First, Cull::None),
                _ => bake_refined(view, casters, &refinement),
            };
            return (baked.map.into(), baked.stats);
        }
        if self.rule == Rule::Deep {
            let deep = self.sub_samples.map_or(self.deep, |axis| self.deep.with_axis(axis));
            let baked = bake_deep(view, moments, &deep);
            return (baked.map.into(), baked.stats);
        }
        let mut stats = Stats::default();
        let one = |moment| {
            let baked = self.flat(view, moment);
            stats += baked.stats;
            baked.map
        };
        let mut maps: Vec<Arc<Tiled>> = moments.map(one).collect();
        let map = match (maps.len(), maps.pop()) {
            (1, Some(map)) => map.into(),
            (_, last) => {
                maps.extend(last);
                mix_moments(view, &maps, 0).with_stored(self.rule.stored()).into()
            }
        };
        (map, stats)
    }

    /// One surface per texel.
    fn flat(&self, view: &View, casters: Moment<'_, '_>) -> Baked {
        if self.rule == Rule::Normals {
            return bake_by_normals(view, casters, &BackFace);
        }
        match self.rule {
            Rule::First | Rule::Deep | Rule::Normals | Rule::Facets => self.sampled(view, casters, &First, Cull::None),
            Rule::Second => self.sampled(view, casters, &Second, Cull::None),
            Rule::BackFace => self.sampled(view, casters, &BackFace, Cull::Front),
            Rule::Midpoint => self.sampled(view, casters, &self.midpoint, Cull::None),
        }
    }

    /// As many samples per texel as are wanted, or one where that many do not fit.
    fn sampled<R: DepthRule>(&self, view: &View, casters: Moment<'_, '_>, rule: &R, cull: Cull) -> Baked {
        let axis = self.sub_samples.unwrap_or(1);
        if axis > 1 && view.with_size(view.size().saturating_mul([axis; 2].into())).is_ok() {
            return bake_multi(view, casters, rule, cull, axis).expect("as many samples as fit");
        }
        bake(view, casters, rule, cull)
    }
}
