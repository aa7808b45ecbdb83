//! Planes that are nearly equal are merged, where facets are smaller than samples.

use glam::{DVec2, IVec2};
use umbrage_depth::{FacetBlock, FacetCells, NO_FACET, TILE};
use umbrage_plane::{Affine, View};

/// How far a shared plane may be from a sample's own there, in widths of the sample: half of the margin by which the sample must be passed.
const NEAR: f64 = 0.25;

/// The texels and blocks of a tile whose upper left texel is `origin`, with samples put on the plane of a neighbouring one where that is nearly their own.
pub(super) fn merged(view: &View, cells: &FacetCells<'_>, origin: IVec2, fine: u32) -> (Vec<u32>, Vec<FacetBlock>) {
    let planes = Near { view, planes: cells.planes };
    let columns = TILE as usize;
    let centre =
        |texel: usize| origin.as_dvec2() + DVec2::new((texel % columns) as f64, (texel / columns) as f64) + 0.5;
    let mut texels = cells.texels.to_vec();
    for texel in 0..texels.len() {
        let left = (texel % columns > 0).then(|| texels[texel - 1]);
        let above = texel.checked_sub(columns).map(|above| texels[above]);
        texels[texel] = planes.shared(texels[texel], centre(texel), 1.0, left.into_iter().chain(above));
    }
    let blocks = cells.blocks.iter().map(|block| {
        let texel = usize::from(block.texel);
        let (side, count) = (1.0 / f64::from(fine), fine as usize);
        let mut samples = block.samples.clone();
        for sample in 0..samples.len() {
            let place = DVec2::new((sample % count) as f64, (sample / count) as f64) + 0.5;
            let at = centre(texel) - 0.5 + place * side;
            let left = (sample % count > 0).then(|| samples[sample - 1]);
            let above = sample.checked_sub(count).map(|above| samples[above]);
            let known = [Some(texels[texel]), left, above, samples[..sample].first().copied()];
            samples[sample] = planes.shared(samples[sample], at, side, known.into_iter().flatten());
        }
        FacetBlock { samples, ..block.clone() }
    });
    let blocks = blocks.collect();
    (texels, blocks)
}

struct Near<'a> {
    view: &'a View,
    planes: &'a [Affine],
}

impl Near<'_> {
    /// The first of some planes that is nearly a sample's own, all over the sample; otherwise its own.
    fn shared(&self, own: u32, at: DVec2, side: f64, others: impl Iterator<Item = u32>) -> u32 {
        let Some(plane) = self.planes.get(own as usize) else { return own };
        let key = plane.at(at);
        let most = NEAR * side * self.view.key_width(key);
        let near = |other: &u32| {
            *other != NO_FACET
                && self.planes.get(*other as usize).is_some_and(|other| {
                    let apart = (other.at(at) - key).abs();
                    apart + ((other.dx - plane.dx).abs() + (other.dy - plane.dy).abs()) * side <= most
                })
        };
        others.into_iter().find(near).unwrap_or(own)
    }
}
