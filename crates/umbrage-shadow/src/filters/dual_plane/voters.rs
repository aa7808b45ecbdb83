//! The votes of samples on a receiver, several at a time.

use fearless_simd::f64x4;
use fearless_simd::prelude::*;
use glam::DVec2;
use umbrage_depth::FacetSample;
use umbrage_plane::Affine;

/// The number of samples that are processed together.
pub(super) const LANES: usize = 4;

/// The vote of a sample that does not judge all places of the region alike. Those of a cell are put in one byte, each a bit further up.
pub(super) const OPEN: u8 = 1 << 4;

/// A bit for each sample.
const ALL: u8 = (1 << LANES) - 1;

/// One number of each sample.
type Lanes = [f64; LANES];

/// The properties of a receiver with which every sample is compared.
pub(super) struct Compared {
    /// Its tangent plane, and how fast that plane's key changes, over both axes together.
    pub plane: Affine,
    pub steep: f64,
    /// The middle and the half-axes, texels, of the part of the region that holds the surface.
    pub part: (DVec2, [DVec2; 2]),
    /// The margin by which a sample of one texel's width must be passed: for its width, as a key, and for each unit of slope.
    pub width: f64,
    pub slope: f64,
    /// The least width of a sample, texels.
    pub least: f64,
    /// The rounding of what is compared.
    pub rounding: f64,
}

/// The votes of samples before a place is given.
#[derive(Clone, Copy, Debug)]
pub(super) struct Voters {
    /// How far the receiver's plane lies behind each sample's, as a key over texels, minus the margin: [`Affine`], number by number.
    behind: [Lanes; 3],
    /// The same where the sample was taken.
    there: Lanes,
    /// The margin by which the receiver's plane must lie behind.
    passed: Lanes,
    /// A bit for each that calls all places of the region dark, or all of them lit. Neither is set where it calls some dark and some lit, and where
    /// a number is NaN; both never are.
    dark: u8,
    lit: u8,
}

/// Each list of numbers as a vector.
#[inline(always)]
fn lanes<S: Simd, const N: usize>(simd: S, numbers: [Lanes; N]) -> [f64x4<S>; N] {
    let mut lanes = [f64x4::splat(simd, 0.0); N];
    for i in 0..N {
        lanes[i] = f64x4::from_slice(simd, &numbers[i]);
    }
    lanes
}

/// Each number in all lanes.
#[inline(always)]
fn splat<S: Simd, const N: usize>(simd: S, numbers: [f64; N]) -> [f64x4<S>; N] {
    let mut lanes = [f64x4::splat(simd, 0.0); N];
    for i in 0..N {
        lanes[i] = f64x4::splat(simd, numbers[i]);
    }
    lanes
}

/// [`Affine::at`], its terms in the same order.
#[inline(always)]
fn at<S: Simd>([c, dx, dy]: [f64x4<S>; 3], [x, y]: [f64x4<S>; 2]) -> f64x4<S> {
    (c + dy * y) + dx * x
}

/// How much planes change along an axis.
#[inline(always)]
fn along<S: Simd>([_, dx, dy]: [f64x4<S>; 3], [x, y]: [f64x4<S>; 2]) -> f64x4<S> {
    (dx * x + dy * y).abs()
}

impl Voters {
    /// Each of the samples as if it were alone. An empty sample, a plane infinitely far away, calls everything lit.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, compared: &Compared, samples: &[FacetSample; LANES]) -> Self {
        let [mut c, mut dx, mut dy, mut x, mut y, mut side] = [[0.0; LANES]; 6];
        for i in 0..LANES {
            let FacetSample { plane, at, side: own } = &samples[i];
            (c[i], dx[i], dy[i], x[i], y[i], side[i]) = (plane.c, plane.dx, plane.dy, at.x, at.y, *own);
        }
        let [c, dx, dy, x, y, side] = lanes(simd, [c, dx, dy, x, y, side]);
        let [steep, width, slope, least, rounding, slack, zero, more] = splat(
            simd,
            // A millionth, because planes of refined maps are three floats about the middle of a tile; and a little more than 1, so that no rounding
            // decides for a place at the rim of the region.
            [compared.steep, compared.width, compared.slope, compared.least, compared.rounding, 1e-6, 0.0, 1.0 + 1e-9],
        );
        let gentle = steep.min_precise(dx.abs() + dy.abs());
        let rounding = rounding + slack * gentle.min_precise(width);
        let passed = rounding + (width + slope * gentle) * side.max_precise(least);
        let plane = splat(simd, [compared.plane.c, compared.plane.dx, compared.plane.dy]);
        let behind = [plane[0] - c - passed, plane[1] - dx, plane[2] - dy];
        let there = at(behind, [x, y]);
        let (centre, [u, v]) = compared.part;
        let middle = at(behind, splat(simd, centre.to_array()));
        let spread = (along(behind, splat(simd, u.to_array())) + along(behind, splat(simd, v.to_array()))) * more;
        let dark = there.simd_gt(zero) & (middle - spread).simd_gt(zero);
        let lit = there.simd_le(zero) | (middle + spread).simd_le(zero);
        let [dark, lit] = [dark.to_bitmask() as u8, lit.to_bitmask() as u8];
        let [c, dx, dy] = behind;
        Self { behind: [c.into(), dx.into(), dy.into()], there: there.into(), passed: passed.into(), dark, lit }
    }

    /// The votes of all samples on a place, a bit for each.
    #[inline(always)]
    pub fn on<S: Simd>(&self, simd: S, place: DVec2) -> u8 {
        let [there, c, dx, dy] = lanes(simd, [self.there, self.behind[0], self.behind[1], self.behind[2]]);
        let zero = f64x4::splat(simd, 0.0);
        let dark = there.simd_gt(zero) & at([c, dx, dy], splat(simd, place.to_array())).simd_gt(zero);
        // What is settled for all of the region is settled with a little more room.
        dark.to_bitmask() as u8 & !self.lit | self.dark
    }

    /// A sample's vote for all places of the region: 0 lit, 1 dark, or [`OPEN`].
    #[inline(always)]
    pub fn says(&self, lane: usize) -> u8 {
        let (dark, lit) = (self.dark >> lane & 1, self.lit >> lane & 1);
        if dark == lit { OPEN } else { dark }
    }

    /// Whether a sample calls a place of the region dark.
    #[inline(always)]
    pub fn dark(&self, lane: usize, at: DVec2) -> bool {
        match self.says(lane) {
            OPEN => self.there[lane] > 0.0 && self.behind(lane).at(at) > 0.0,
            says => says == 1,
        }
    }

    /// How far the receiver's plane lies behind a sample's, as a key over texels, minus the margin.
    #[inline(always)]
    pub fn behind(&self, lane: usize) -> Affine {
        let [c, dx, dy] = &self.behind;
        Affine { c: c[lane], dx: dx[lane], dy: dy[lane] }
    }

    /// The same where the sample was taken, and the margin; −∞ where there is no surface.
    #[inline(always)]
    pub fn there(&self, lane: usize) -> (f64, f64) {
        (self.there[lane], self.passed[lane])
    }
}

/// The votes of samples on a whole region.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Said {
    lit: u8,
    dark: u8,
    /// Some of them call some places dark and some lit.
    mixed: u8,
}

impl Said {
    /// Adds the votes of some samples.
    #[inline(always)]
    pub fn add(&mut self, voters: &Voters) {
        let (dark, lit) = (voters.dark, voters.lit);
        self.dark |= dark & !lit;
        self.lit |= lit & !dark;
        self.mixed |= !(dark ^ lit) & ALL;
    }

    /// Whether no two disagree so far.
    #[inline(always)]
    pub fn can_agree(self) -> bool {
        self.mixed == 0 && (self.dark == 0 || self.lit == 0)
    }

    /// The common vote of all, where they agree.
    #[inline(always)]
    pub fn agreed(self) -> Option<bool> {
        (self.can_agree() && self.dark | self.lit != 0).then_some(self.dark != 0)
    }
}
