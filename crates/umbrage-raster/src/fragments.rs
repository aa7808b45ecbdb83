use crate::{BIN, Coverage};
use glam::{DVec2, IVec2};
use umbrage_plane::{Facet, Sampling, View};

/// Texels of a row that [`each_run`] works on together.
pub const RUN: usize = 8;

/// Calls `each` with every covered texel of a tile, row by row: its index in the tile (row × [`BIN`] + column), the place of its sample in
/// texels of the map, and the facet's key there, rounded once.
///
/// `origin` is the tile's upper left texel; `facet` and `coverage` are what [`Bins::tile`](crate::Bins::tile) gives of it, and `view` is the one
/// that its [`Bins`](crate::Bins) were made for.
#[inline(always)]
pub fn each_fragment(
    view: &View,
    origin: IVec2,
    facet: &Facet,
    coverage: &Coverage,
    mut each: impl FnMut(usize, DVec2, f32),
) {
    for row in coverage.first..coverage.end {
        let mut bits = coverage.rows[usize::from(row)];
        while bits != 0 {
            let column = bits.trailing_zeros();
            bits &= bits - 1;
            let texel = origin + IVec2::new(column as i32, i32::from(row));
            let at = view.sampling().position(texel);
            each(usize::from(row) * BIN as usize + column as usize, at, facet.plane.at(at) as f32);
        }
    }
}

/// [`each_fragment`] in runs of [`RUN`] texels of a row, which begin at a multiple of [`RUN`]: calls `each` with every run that holds a
/// covered texel, in no order that matters. It is given the index of the run's first texel and the keys of all, NaN for those that are not covered.
///
/// The keys are the same bits. Compiled for [vector instructions](umbrage_plane::vectorized), a run takes little more time than one fragment.
#[inline(always)]
pub fn each_run(
    view: &View,
    origin: IVec2,
    facet: &Facet,
    coverage: &Coverage,
    mut each: impl FnMut(usize, &[f32; RUN]),
) {
    match view.sampling() {
        // Named once more, so that nothing in its loops depends on which it is.
        Sampling::Centre => runs(Sampling::Centre, origin, facet, coverage, &mut each),
        jittered @ Sampling::Jittered { .. } => runs(jittered, origin, facet, coverage, &mut each),
    }
}

#[inline(always)]
fn runs(
    sampling: Sampling,
    origin: IVec2,
    facet: &Facet,
    coverage: &Coverage,
    each: &mut impl FnMut(usize, &[f32; RUN]),
) {
    // A copy, which nothing that `each` writes can change: it is not read again for each run.
    let plane = facet.plane;
    let rows = &coverage.rows[usize::from(coverage.first)..usize::from(coverage.end)];
    let mut touched = rows.iter().fold(0, |all, row| all | row);
    while touched != 0 {
        let run = touched.trailing_zeros() as usize / RUN;
        touched &= !(0xff << (run * RUN));
        // Down the rows, so that what depends on the column alone is worked out once. They are searched and not gone through: for AVX-512 a compiler
        // would take sixteen of them at a time, by gathering and scattering, in twice the time.
        let mut of_run = (usize::from(coverage.first)..).zip(rows.iter().map(|bits| bits >> (run * RUN) & 0xff));
        while let Some((row, covered)) = of_run.find(|(_, covered)| *covered != 0) {
            let mut keys = [0.0; RUN];
            for (lane, key) in (0..).zip(&mut keys) {
                let texel = origin + IVec2::new((run * RUN) as i32 + lane, row as i32);
                *key = plane.at(sampling.position(texel)) as f32;
            }
            for (lane, key) in keys.iter_mut().enumerate() {
                *key = if covered & (1 << lane) == 0 { f32::NAN } else { *key };
            }
            each(row * BIN as usize + run * RUN, &keys);
        }
    }
}
