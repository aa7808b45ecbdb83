//! Two planes instead of a bias: the caster's own and the receiver's, compared at both ends.

mod asked;
mod edges;
mod explained;
mod fraction;
mod grid;
mod parameters;
mod voters;

pub use parameters::DualPlane;

use crate::{Filter, OnPlane, Probe, Query};
use asked::Asked;
use explained::explain;
use fearless_simd::Simd;
use glam::Vec2;
use umbrage_depth::{DepthMap, FacetSource, Facets};
use umbrage_plane::Bias;
use umbrage_sample::EveryTexel;

impl Filter for DualPlane {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32 {
        if query.receiver().axes == [Vec2::ZERO; 2]
            && let Some(dark) = query.placed(query.receiver().texel.as_vec2())
        {
            return dark;
        }
        let (fraction, looked) = match query.map().facets() {
            Some(Facets::Map(map)) => {
                let asked = Asked::new(self, map, query);
                if P::EXPLAINS {
                    explain(query.simd(), &asked, query.probe());
                }
                asked.fraction(query.simd())
            }
            Some(Facets::Several(maps)) => self.over_several(maps, query),
            None => {
                let region = query.region(1.0, 1.0);
                // A deep map's texel is the mean of samples up to 7/16 of a texel away along both axes: on a slope along its diagonal, 7/16 · √2 steps.
                let bias = if query.map().translucent().is_some() { Bias::Steps(0.625) } else { Bias::ZERO };
                return query.share(&region, &EveryTexel, &OnPlane::biased(bias));
            }
        };
        query.count(looked);
        fraction
    }

    /// Planes of facets are compared without; other maps by [`OnPlane`].
    #[inline(always)]
    fn asks_tilt<M: DepthMap>(&self, map: &M) -> bool {
        map.facets().is_none()
    }
}

impl DualPlane {
    /// Maps around a light, whose samples beyond a seam are taken from the neighbour.
    #[inline(never)]
    fn over_several<'a, S: Simd, M: DepthMap, P: Probe>(
        &self,
        maps: &'a dyn FacetSource,
        query: &mut Query<'a, S, M, P>,
    ) -> (f32, u32) {
        let asked = Asked::new(self, maps, query);
        if P::EXPLAINS {
            explain(query.simd(), &asked, query.probe());
        }
        asked.fraction(query.simd())
    }
}
