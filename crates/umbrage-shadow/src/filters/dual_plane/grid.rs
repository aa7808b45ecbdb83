//! The samples under a region.

use super::asked::Asked;
use super::voters::{LANES, Said, Voters};
use arrayvec::ArrayVec;
use fearless_simd::Simd;
use glam::IVec2;
use umbrage_depth::FacetSource;
use umbrage_plane::TexelRect;

/// The samples at up to `N` places of the finer grid, as many as lie under a region or at the corners of a cell.
pub(super) struct Grid<'a, 'b, F: ?Sized, const N: usize, const CHUNKS: usize> {
    pub asked: &'b Asked<'a, F>,
    pub rect: TexelRect,
    /// The samples' votes, each once.
    pub voters: ArrayVec<Voters, CHUNKS>,
    /// The number of samples.
    pub samples: u32,
    /// For each place, row by row, its sample, where that is of this place alone.
    pub of: [u8; N],
    /// Samples of several places.
    pub parts: ArrayVec<Part, N>,
}

/// A part of a grid that has one sample.
pub(super) struct Part {
    pub sample: u8,
    /// Its first place, row by row from the grid's first.
    pub first: u8,
    pub columns: u8,
    pub rows: u8,
}

impl<'a, 'b, F: FacetSource + ?Sized, const N: usize, const CHUNKS: usize> Grid<'a, 'b, F, N, CHUNKS> {
    /// Without samples. They are [filled](Self::fill) in where the grid stands: it is large, and moving it would cost as much as an easy region.
    #[inline(always)]
    pub fn empty(asked: &'b Asked<'a, F>, rect: TexelRect) -> Self {
        Self { asked, rect, voters: ArrayVec::new_const(), samples: 0, of: [0; N], parts: ArrayVec::new_const() }
    }

    /// Takes the samples of its rectangle, and returns their common vote for all places of the region, where they agree.
    #[inline(always)]
    pub fn fill<S: Simd>(&mut self, simd: S) -> Option<bool> {
        let mut samples = ArrayVec::<_, N>::new_const();
        let Self { of, parts, .. } = self;
        let (min, columns) = (self.rect.min, self.rect.max.x - self.rect.min.x);
        self.asked.map.each_sample(self.rect, &mut |part, sample| {
            let (from, size) = (part.min - min, part.max - part.min);
            let (first, own) = ((from.y * columns + from.x) as u8, samples.len() as u8);
            if size == IVec2::ONE {
                of[usize::from(first)] = own;
            } else {
                parts.push(Part { sample: own, first, columns: size.x as u8, rows: size.y as u8 });
            }
            samples.push(*sample);
            true
        });
        let mut said = Said::default();
        self.samples = samples.len() as u32;
        while let Some(last) = samples.last().copied().filter(|_| samples.len() % LANES != 0) {
            samples.push(last);
        }
        for samples in samples.as_chunks().0 {
            let voters = Voters::of(simd, &self.asked.compared, samples);
            said.add(&voters);
            self.voters.push(voters);
        }
        said.agreed()
    }
}
