//! What samples say of a receiver, several at a time.

use glam::DVec2;
use umbrage_depth::FacetSample;
use umbrage_plane::Affine;

/// Samples that are worked on together.
pub(super) const LANES: usize = 4;

/// A number of each.
type Lanes = [f64; LANES];

/// What of a receiver every sample is compared with.
pub(super) struct Compared {
    /// Its tangent plane, and how fast that plane's key changes, over both axes together.
    pub plane: Affine,
    pub steep: f64,
    /// The middle and the half-axes, texels, of the part of the region that holds the surface.
    pub part: (DVec2, [DVec2; 2]),
    /// What a sample of one texel's width must be passed by for its width, as a key, and for each unit of slope.
    pub width: f64,
    pub slope: f64,
    /// The least width of a sample, texels.
    pub least: f64,
    /// Roundings of what is compared.
    pub rounding: f64,
}

/// What [`LANES`] samples say before a place is named: arrays in place of numbers, of which a compiler makes vector instructions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Voters {
    /// How far the receiver's plane lies behind each sample's, as a key over texels, less what it must pass by: [`Affine`], number by number.
    behind: [Lanes; 3],
    /// The same where the sample was taken.
    there: Lanes,
    /// What it must pass by.
    passed: Lanes,
    /// Whether it calls all places of the region dark, or all of them lit. Neither is true where it calls some dark and some lit, and where
    /// a number is NaN; both never are.
    all_dark: [bool; LANES],
    all_lit: [bool; LANES],
}

impl Voters {
    /// Each of one to [`LANES`] samples as if it were alone; the last fills what lanes are left. Nothing, a plane infinitely far, calls
    /// everything lit.
    #[inline(always)]
    pub fn of(compared: &Compared, samples: &[FacetSample]) -> Self {
        let (mut c, mut dx, mut dy) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let (mut x, mut y, mut side) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            let sample = &samples[i.min(samples.len() - 1)];
            (c[i], dx[i], dy[i]) = (sample.plane.c, sample.plane.dx, sample.plane.dy);
            (x[i], y[i], side[i]) = (sample.at.x, sample.at.y, sample.side);
        }
        let (mut there, mut passed) = ([0.0; LANES], [0.0; LANES]);
        let (mut all_dark, mut all_lit) = ([false; LANES], [false; LANES]);
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
            all_dark[i] = there[i] > 0.0 && middle - spread > 0.0;
            all_lit[i] = there[i] <= 0.0 || middle + spread <= 0.0;
        }
        Self { behind: [c, dx, dy], there, passed, all_dark, all_lit }
    }

    /// Whether a sample calls a place of the region dark.
    #[inline(always)]
    pub fn dark(&self, lane: usize, at: DVec2) -> bool {
        let (dark, lit) = (self.all_dark[lane], self.all_lit[lane]);
        if dark == lit { self.there[lane] > 0.0 && self.behind(lane).at(at) > 0.0 } else { dark }
    }

    /// How far the receiver's plane lies behind a sample's, as a key over texels, less what it must pass by.
    #[inline(always)]
    pub fn behind(&self, lane: usize) -> Affine {
        let [c, dx, dy] = &self.behind;
        Affine { c: c[lane], dx: dx[lane], dy: dy[lane] }
    }

    /// The same where the sample was taken, and what it must pass by; −∞ where there is nothing.
    #[inline(always)]
    pub fn there(&self, lane: usize) -> (f64, f64) {
        (self.there[lane], self.passed[lane])
    }
}

/// What samples say of a whole region.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Said {
    lit: bool,
    dark: bool,
    /// One of them calls some places dark and some lit.
    mixed: bool,
}

impl Said {
    /// Takes what some of them say.
    #[inline(always)]
    pub fn add(&mut self, voters: &Voters) {
        for (dark, lit) in voters.all_dark.iter().zip(&voters.all_lit) {
            self.dark |= *dark && !lit;
            self.lit |= *lit && !dark;
            self.mixed |= dark == lit;
        }
    }

    /// Whether no two disagree so far.
    #[inline(always)]
    pub fn can_agree(self) -> bool {
        !(self.mixed || self.dark && self.lit)
    }

    /// The answer of all, where there is one.
    #[inline(always)]
    pub fn agreed(self) -> Option<bool> {
        (self.can_agree() && (self.dark || self.lit)).then_some(self.dark)
    }
}
