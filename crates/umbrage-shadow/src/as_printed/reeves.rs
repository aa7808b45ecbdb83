//! Reeves, Salesin & Cook 1987, Fig. 4. Where the listing divides by zero, guards give a result.
//!
//! Matters of language alone are as in Rust here: garbled declarations, `floor` and `ceil` declared without their type,
//! a bitwise `|` between truth values, the order of the array's indices. The cull's inclusive rectangle with
//! floor and ceiling is kept as printed, like the square map.

use glam::IVec2;
use umbrage_depth::DepthMap;

/// The range of the listing's `Rand()`, which serves for both the jitter and the bias.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RandRange {
    /// \[0, 1): jitter reaches only the upper half of each cell.
    Unit,
    /// \[−1, 1): the bias spans \[2·Bias0 − Bias1, Bias1\].
    Signed,
}

/// What the caller passes as `sres`, `tres`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FootprintConvention {
    /// Half-extents, as the listing uses them: the value passes through unchanged.
    HalfExtent,
    /// Full sizes, as in the paper's text: halved first.
    FullSize,
}

/// The listing's parameters and its open questions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Listing {
    /// `NumSamples`.
    pub num_samples: u32,
    /// `MinSamples`, per axis.
    pub min_samples: u32,
    /// `ResFactor`.
    pub res_factor: f32,
    /// `MinSize`, in texels.
    pub min_size: f32,
    /// `Bias0`, world units.
    pub bias0: f32,
    /// `Bias1`, world units.
    pub bias1: f32,
    /// Range of `Rand()`.
    pub rand: RandRange,
    /// Reads the minimum of t as the printed subtraction, which does nothing.
    pub e_r4_noop: bool,
    /// Meaning of `sres`, `tres`.
    pub footprint: FootprintConvention,
    /// Woo's archived version of 1992: what lies outside the rectangle is in shadow, and z < 0 is not tested. Right for the rectangle
    /// of a spot light's cone, wrong for that of the finite depths.
    pub gg_bbox_rule: bool,
}

impl Default for Listing {
    /// The printed initial values, `Rand()` in \[0, 1).
    fn default() -> Self {
        Self {
            num_samples: 16,
            min_samples: 1,
            res_factor: 3.0,
            min_size: 0.0,
            bias0: 0.3,
            bias1: 0.4,
            rand: RandRange::Unit,
            e_r4_noop: false,
            footprint: FootprintConvention::HalfExtent,
            gg_bbox_rule: false,
        }
    }
}

/// The listing's `TextureRect`: inclusive bounds of the finite depths, in texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextureRect {
    /// First column.
    pub umin: i32,
    /// Last column.
    pub umax: i32,
    /// First row.
    pub vmin: i32,
    /// Last row.
    pub vmax: i32,
}

/// Sample counts as the listing computes them, and how often a guard was needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// Samples along s.
    pub ns: u32,
    /// Samples along t.
    pub nt: u32,
    /// Divisions by zero avoided: 0 or 1.
    pub guarded: u32,
}

/// The listing's sample counts for half-extents in texels: in its second branch `ns` comes from an unclamped `nt`, and only `nt` is clamped.
///
/// `num_samples` of 0 counts as 1, and `min_samples` is moved into 1..=`num_samples`.
pub fn counts(sres: f32, tres: f32, num_samples: u32, min_samples: u32) -> Counts {
    let num_samples = num_samples.max(1);
    let min_samples = min_samples.clamp(1, num_samples);
    let n = num_samples as f32;
    let clamp = |value: f32| (value as u32).clamp(min_samples, num_samples);
    if sres * tres * 4.0 < n {
        return Counts { ns: clamp(sres * 2.0 + 0.5), nt: clamp(tres * 2.0 + 0.5), guarded: 0 };
    }
    let nt = ((tres * n / sres).sqrt() + 0.5) as u32;
    if nt == 0 {
        return Counts { ns: num_samples, nt: min_samples, guarded: 1 };
    }
    let ns = (n / nt as f32 + 0.5) as u32;
    Counts { ns: ns.max(1), nt: nt.clamp(min_samples, num_samples), guarded: u32::from(ns == 0) }
}

/// `SampleShadow` as printed: the fraction in shadow of a region at (s, t) (0..1 of the map's width), depth `z`, size `sres` × `tres` (same unit).
///
/// `map` is square; `rand` gives numbers in \[0, 1), drawn in the listing's order: s, t, bias.
pub fn sample_shadow<M: DepthMap>(
    listing: &Listing,
    map: &M,
    bbox: TextureRect,
    [s, t]: [f32; 2],
    z: f32,
    [sres, tres]: [f32; 2],
    mut rand: impl FnMut() -> f32,
) -> f32 {
    let outside = f32::from(u8::from(listing.gg_bbox_rule));
    if z < 0.0 && !listing.gg_bbox_rule {
        return 0.0;
    }
    let mapres = map.view().size().x as f32;
    let size = if listing.footprint == FootprintConvention::FullSize { 0.5 } else { 1.0 };
    let sres = (mapres * sres * size * listing.res_factor).max(listing.min_size);
    let mut tres = mapres * tres * size * listing.res_factor;
    if tres < listing.min_size && !listing.e_r4_noop {
        tres = listing.min_size;
    }
    let (s, t) = (s * mapres, t * mapres);
    let (lu, hu) = ((s - sres).floor() as i32, (s + sres).ceil() as i32);
    let (lv, hv) = ((t - tres).floor() as i32, (t + tres).ceil() as i32);
    if lu > bbox.umax || hu < bbox.umin || lv > bbox.vmax || hv < bbox.vmin {
        return outside;
    }
    let Counts { ns, nt, .. } = counts(sres, tres, listing.num_samples, listing.min_samples);
    let (ds, dt) = (2.0 * sres / ns as f32, 2.0 * tres / nt as f32);
    let (js, jt) = (ds * 0.5, dt * 0.5);
    let mut random = || if listing.rand == RandRange::Unit { rand() } else { rand() * 2.0 - 1.0 };
    let mut inshadow = 0u32;
    let mut at_s = s - sres + js;
    for _ in 0..ns {
        let mut at_t = t - tres + jt;
        for _ in 0..nt {
            let iu = (at_s + random() * js) as i32;
            let iv = (at_t + random() * jt) as i32;
            let bias = random() * (listing.bias1 - listing.bias0) + listing.bias0;
            let stored = iu >= bbox.umin && iu <= bbox.umax && iv >= bbox.vmin && iv <= bbox.vmax;
            let dark = if stored { z > map.depth(IVec2::new(iu, iv)) + bias } else { listing.gg_bbox_rule };
            inshadow += u32::from(dark);
            at_t += dt;
        }
        at_s += ds;
    }
    inshadow as f32 / (ns * nt) as f32
}
