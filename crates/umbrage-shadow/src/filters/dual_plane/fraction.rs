//! The fraction of a region that is in shadow, by the cheapest test that settles it.

use super::asked::{Asked, FAR};
use super::edges::Edges;
use super::grid::Grid;
use super::voters::{LANES, Said, Voters};
use arrayvec::ArrayVec;
use fearless_simd::Simd;
use glam::{DVec2, IVec2};
use umbrage_depth::{FacetSample, FacetSource};
use umbrage_plane::{TexelRect, integers};

/// Samples along each side of the region that are held; larger regions read the map for each place.
const AT_HAND: usize = 16;

/// Regions of more texels along a side are not tested for whether all of their samples agree.
const MOST_AGREED: f64 = 16.0;

impl<F: FacetSource + ?Sized> Asked<'_, F> {
    /// The fraction in shadow, and how many samples were read.
    #[inline(always)]
    pub fn fraction<S: Simd>(&self, simd: S) -> (f32, u32) {
        let (centre, axes) = self.compared.part;
        let reach = axes[0].abs() + axes[1].abs();
        let fine = f64::from(self.map.fine());
        let corner = |at: DVec2| (at * fine - 0.5).floor();
        let (low, high) = (corner(centre - reach), corner(centre + reach) + 2.0);
        if !(low.abs().max_element() < FAR && high.abs().max_element() < FAR) {
            return (self.share(false, |_| false), 0);
        }
        let rect = TexelRect { min: integers(low.to_array()).into(), max: integers(high.to_array()).into() };
        // Places of the region are half a sample or more within the samples around them, which no rounding bridges.
        let samples = TexelRect::of_size(self.view.size() * self.map.fine());
        let inside =
            samples.encloses(rect) && self.view.cone().is_none() || self.view.holds(centre.as_vec2(), reach.as_vec2());
        if inside && let Some(dark) = self.of_one_plane(simd, rect, reach) {
            return (f32::from(u8::from(dark)), 1);
        }
        let wide = (high - low).max_element();
        let looked = rect.area().min(4 * (self.across * self.across) as usize) as u32;
        if wide <= AT_HAND as f64 {
            let mut grid = Grid::<F, { AT_HAND * AT_HAND }, { AT_HAND * AT_HAND / LANES }>::empty(self, rect);
            let agreed = grid.fill(simd);
            if inside && let Some(dark) = agreed {
                return (f32::from(u8::from(dark)), grid.samples);
            }
            return (grid.fraction(simd, inside), looked);
        }
        if inside && wide <= MOST_AGREED * fine {
            let (agreed, looked) = self.agreed(simd, rect);
            if let Some(dark) = agreed {
                return (f32::from(u8::from(dark)), looked);
            }
        }
        (self.one_by_one(simd, inside), looked)
    }

    /// The common vote where all samples of a rectangle see one facet, which judges each of them and all places of the region alike.
    #[inline(always)]
    fn of_one_plane<S: Simd>(&self, simd: S, rect: TexelRect, reach: DVec2) -> Option<bool> {
        let sample = self.map.one_facet(rect)?;
        let behind = Voters::of(simd, &self.compared, &[sample; LANES]).behind(0);
        // Wherever the samples of these places were taken, and the region.
        let side = 1.0 / f64::from(self.map.fine());
        let low = (rect.min.as_dvec2() * side - 1.0).min(self.compared.part.0 - reach);
        let high = (rect.max.as_dvec2() * side + 1.0).max(self.compared.part.0 + reach);
        let middle = behind.at(0.5 * (low + high));
        let half = 0.5 * (high - low);
        let spread = (behind.dx.abs() * half.x + behind.dy.abs() * half.y) * (1.0 + 1e-9);
        let (dark, lit) = (middle - spread > 0.0, middle + spread <= 0.0);
        (dark != lit).then_some(dark)
    }

    /// The common vote of all samples of a rectangle for all places of the region, where they agree, and how many were read.
    #[inline(never)]
    fn agreed<S: Simd>(&self, simd: S, rect: TexelRect) -> (Option<bool>, u32) {
        let mut samples = ArrayVec::<FacetSample, LANES>::new_const();
        let (mut said, mut looked) = (Said::default(), 0);
        let votes = |samples: &[_; LANES]| {
            simd.vectorize(
                #[inline(always)]
                || Voters::of(simd, &self.compared, samples),
            )
        };
        self.map.each_sample(rect, &mut |_, sample| {
            samples.push(*sample);
            looked += 1;
            if let Ok(four) = samples.as_slice().try_into() {
                said.add(&votes(four));
                samples.clear();
            }
            said.can_agree()
        });
        if let Some(last) = samples.last() {
            let mut four = [*last; LANES];
            four[..samples.len()].copy_from_slice(&samples);
            said.add(&votes(&four));
        }
        (said.agreed(), looked)
    }

    /// A large region: the map is read anew for each place.
    #[inline(never)]
    fn one_by_one<S: Simd>(&self, simd: S, inside: bool) -> f32 {
        self.share(inside, |at| {
            simd.vectorize(
                #[inline(always)]
                || {
                    let corner = (at * f64::from(self.map.fine()) - 0.5).floor();
                    let corner = IVec2::from(integers(corner.to_array()));
                    let mut samples = [FacetSample::nothing(DVec2::ZERO); LANES];
                    for (k, sample) in samples.iter_mut().enumerate() {
                        *sample = self.map.sample(corner + IVec2::new(k as i32 & 1, k as i32 >> 1));
                    }
                    match Voters::of(simd, &self.compared, &samples).on(simd, at) {
                        0 => false,
                        0b1111 => true,
                        _ => self.edge(simd, corner, at),
                    }
                },
            )
        })
    }

    /// Whether a place is dark whose samples disagree.
    #[inline(never)]
    fn edge<S: Simd>(&self, simd: S, corner: IVec2, at: DVec2) -> bool {
        simd.vectorize(
            #[inline(always)]
            || {
                let mut grid = Grid::<F, 4, 1>::empty(self, TexelRect::new(corner, corner + 2));
                grid.fill(simd);
                Edges::of(&grid).dark(at)
            },
        )
    }
}
