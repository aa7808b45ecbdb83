//! The votes of samples on a receiver, several at a time.

#![expect(clippy::needless_range_loop, reason = "one index names a lane in several arrays")]

use glam::DVec2;
use umbrage_depth::FacetSample;
use umbrage_plane::Affine;

/// The number of samples that are processed together.
pub(super) const LANES: usize = 4;

/// The vote of a sample that does not judge all places of the region alike.
pub(super) const OPEN: u8 = 1 << 7;

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

/// One to [`LANES`] samples, number by number: arrays, which a compiler turns into vector instructions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Samples {
    plane: [Lanes; 3],
    at: [Lanes; 2],
    side: Lanes,
    /// The number of samples.
    pub count: usize,
}

impl Samples {
    /// No samples yet.
    pub const NONE: Self = Self { plane: [[0.0; LANES]; 3], at: [[0.0; LANES]; 2], side: [0.0; LANES], count: 0 };

    /// Adds one more sample.
    ///
    /// # Panics
    /// When there are already [`LANES`] samples.
    #[inline(always)]
    pub fn push(&mut self, sample: &FacetSample) {
        let lane = self.count;
        (self.plane[0][lane], self.plane[1][lane], self.plane[2][lane]) =
            (sample.plane.c, sample.plane.dx, sample.plane.dy);
        (self.at[0][lane], self.at[1][lane], self.side[lane]) = (sample.at.x, sample.at.y, sample.side);
        self.count = lane + 1;
    }

    /// One sample alone.
    #[inline(always)]
    pub fn one(sample: &FacetSample) -> Self {
        let mut samples = Self::NONE;
        samples.push(sample);
        samples
    }
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
    /// A bit for each sample.
    all: u8,
}

/// A bit for each lane.
#[inline(always)]
fn bits(lanes: [bool; LANES]) -> u8 {
    let mut bits = 0;
    for i in 0..LANES {
        bits |= u8::from(lanes[i]) << i;
    }
    bits
}

impl Voters {
    /// Each of some samples as if it were alone. An empty sample, a plane infinitely far away, calls everything lit.
    #[inline(always)]
    #[expect(
        clippy::needless_bitwise_bool,
        reason = "a lane that skipped a comparison would keep the loop from being vectorised"
    )]
    pub fn of(compared: &Compared, samples: &Samples) -> Self {
        let ([mut c, mut dx, mut dy], [x, y], side) = (samples.plane, samples.at, samples.side);
        let (mut there, mut passed) = ([0.0; LANES], [0.0; LANES]);
        let (mut dark, mut lit) = ([false; LANES], [false; LANES]);
        for i in 0..LANES {
            let gentle = compared.steep.min(dx[i].abs() + dy[i].abs());
            // Planes of refined maps are three floats about the middle of a tile.
            let rounding = compared.rounding + 1e-6 * gentle.min(compared.width);
            passed[i] = rounding + (compared.width + compared.slope * gentle) * side[i].max(compared.least);
            (c[i], dx[i], dy[i]) =
                (compared.plane.c - c[i] - passed[i], compared.plane.dx - dx[i], compared.plane.dy - dy[i]);
            there[i] = Affine { c: c[i], dx: dx[i], dy: dy[i] }.at(DVec2::new(x[i], y[i]));
        }
        let (centre, axes) = compared.part;
        for i in 0..LANES {
            let middle = Affine { c: c[i], dx: dx[i], dy: dy[i] }.at(centre);
            let along = |axis: DVec2| (dx[i] * axis.x + dy[i] * axis.y).abs();
            // A little more than the region, so that no rounding decides.
            let spread = (along(axes[0]) + along(axes[1])) * (1.0 + 1e-9);
            dark[i] = (there[i] > 0.0) & (middle - spread > 0.0);
            lit[i] = (there[i] <= 0.0) | (middle + spread <= 0.0);
        }
        let all = (1 << samples.count) - 1;
        Self { behind: [c, dx, dy], there, passed, dark: bits(dark) & all, lit: bits(lit) & all, all }
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
        self.mixed |= !(dark ^ lit) & voters.all;
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
