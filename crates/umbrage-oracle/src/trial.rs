//! How biases fare on what a camera sees of anybody's scene (Wang & Molnar 1994).

use crate::metrics::{Grid, dark_mask, lit_mask};
use crate::{BiasSearch, BiasWindow};
use glam::{DVec3, IVec2, Vec3};
use rayon::prelude::*;
use std::fmt;
use umbrage_depth::DepthMap;
use umbrage_plane::{Bias, Receiver, SurfacePoint, Verdict, View};

/// What a bias does to a receiver before it is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BiasKind {
    /// It is moved toward the light by as much everywhere: world units.
    Constant,
    /// By more where its surface is steeper to the light: texels, times what its depth changes by from one texel to the next.
    Slope,
    /// Along its normal, so that it is also looked up elsewhere: world units.
    Normal,
}

impl BiasKind {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Constant, Self::Slope, Self::Normal];

    /// The unit of an amount.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Constant | Self::Normal => "world units",
            Self::Slope => "texels",
        }
    }
}

impl fmt::Display for BiasKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Constant => "constant",
            Self::Slope => "slope-scaled",
            Self::Normal => "normal offset",
        })
    }
}

/// A bias of all kinds together, as one receiver gets it.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct TriedBias {
    /// World units toward the light.
    pub constant: f64,
    /// Texels, times what the surface's depth changes by from one to the next.
    pub slope: f64,
    /// World units along the normal, toward the side that the light is on.
    pub normal: f64,
}

impl TriedBias {
    /// An amount of one kind.
    pub fn of(kind: BiasKind, amount: f64) -> Self {
        let mut bias = Self::default();
        *match kind {
            BiasKind::Constant => &mut bias.constant,
            BiasKind::Slope => &mut bias.slope,
            BiasKind::Normal => &mut bias.normal,
        } = amount;
        bias
    }

    /// A point moved by it along its normal, as a view sees it, and the depth that is compared there; `None` for a point without a place in the view.
    pub fn compared(&self, view: &View, point: &SurfacePoint) -> Option<(Receiver, f32)> {
        let facing = point.normal.as_dvec3().dot(view.toward_eye(point.position));
        let outward = point.normal.as_dvec3() * self.normal.copysign(facing * self.normal);
        let receiver = view.receiver(&SurfacePoint { position: point.position + outward, ..*point }).ok()?;
        let steps = f64::from(receiver.texel_world.max_element() * receiver.slope);
        // Edge-on no finite step exists; none at all is still none.
        let slope = if self.slope == 0.0 { 0.0 } else { self.slope * steps };
        Some((receiver, receiver.nearer(view, Bias::World((self.constant + slope) as f32))))
    }
}

/// What a bias leaves wrong; fractions from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct BiasShares {
    /// Mean shadow on the pixels that truth has lit.
    pub false_shadow: f64,
    /// Mean light on the pixels that truth has in shadow.
    pub false_light: f64,
}

/// The pixels of a picture on which biases are tried, over a map of nearest surfaces.
///
/// A pixel counts where it sees one surface that faces the light (N·L of .02 or more), and where the map and not a rule answers. Of those that truth
/// has lit the ones count whose surroundings are lit for as far as the filter reaches. All that truth has in shadow count: shadows are lost where they
/// begin, at their casters, and what a filter takes off their edges it takes without a bias, too.
#[derive(Clone, Debug)]
pub struct BiasTrial<'a, M> {
    map: &'a M,
    /// Half-extent of the filter, texels; every texel in it counts alike.
    radius: f64,
    lit: Vec<SurfacePoint>,
    dark: Vec<SurfacePoint>,
}

/// A pixel of truth.
#[derive(Clone, Copy, Debug)]
pub struct TruePixel {
    /// What it sees, world space; NaN where it sees nothing.
    pub position: DVec3,
    /// Its surface's geometric normal.
    pub normal: Vec3,
    /// Cosine between that and the direction to the light.
    pub facing: f32,
    /// Whether all of it sees one surface.
    pub one_surface: bool,
    /// Truth's fraction in shadow.
    pub dark: f32,
}

impl<'a, M: DepthMap> BiasTrial<'a, M> {
    /// Of a picture's pixels, in rows of `width` from the top. `radius` is the half-extent of the filter in texels, 0 for one texel.
    pub fn new(map: &'a M, pixels: &[TruePixel], width: usize, radius: f64) -> Self {
        let (mut lit, mut dark) = (Vec::new(), Vec::new());
        let truth: Vec<f32> = pixels.iter().map(|pixel| pixel.dark).collect();
        let facing: Vec<f32> = pixels.iter().map(|pixel| if pixel.one_surface { pixel.facing } else { 0.0 }).collect();
        let border = border(map.view(), pixels, width, radius);
        let grid = Grid::new(&truth, width);
        let masks = [lit_mask(grid, &facing, border, LEAST_FACING), dark_mask(grid, &facing, 0, LEAST_FACING)];
        for (index, pixel) in pixels.iter().enumerate() {
            let point = SurfacePoint::at(pixel.position, pixel.normal);
            let compared = map.view().receiver(&point).is_ok_and(|receiver| {
                let place = map.view().locate(receiver.texel.as_vec2());
                map.view().rules().verdict(place) == Verdict::Compare
            });
            match (masks[0][index], masks[1][index]) {
                (true, _) if compared => lit.push(point),
                (_, true) if compared => dark.push(point),
                _ => {}
            }
        }
        Self { map, radius, lit, dark }
    }

    /// The points that truth has lit, and those that it has in shadow.
    pub fn points(&self) -> (&[SurfacePoint], &[SurfacePoint]) {
        (&self.lit, &self.dark)
    }

    /// The false shadow and the false light that remain with an amount of one kind of bias; each is 0 if no pixel is judged for it.
    pub fn shares(&self, kind: BiasKind, amount: f64) -> BiasShares {
        self.shares_by(|_| TriedBias::of(kind, amount))
    }

    /// The same with a bias that may differ from receiver to receiver.
    pub fn shares_by(&self, bias: impl Fn(&Receiver) -> TriedBias + Sync) -> BiasShares {
        let mean = |points: &[SurfacePoint], of: fn([i32; 2]) -> i32| {
            // Whole numbers: a sum that no order of the threads can change.
            let sum = |point: &SurfacePoint| {
                let texels = texels(self.map, point, self.radius, &bias);
                (i64::from(of(texels)) << SHIFT) / i64::from(texels[0] + texels[1])
            };
            let sum: i64 = points.par_iter().map(sum).sum();
            sum as f64 / (1u64 << SHIFT) as f64 / points.len().max(1) as f64
        };
        BiasShares { false_shadow: mean(&self.lit, |[_, dark]| dark), false_light: mean(&self.dark, |[lit, _]| lit) }
    }

    /// The smallest amount with at most `tolerance` of false shadow, and the largest that adds at most `tolerance` of false light to what there is
    /// without a bias. Amounts from 0 to `most` are tried; an answer equal to `most` may hold for larger amounts, too.
    pub fn window(&self, kind: BiasKind, tolerance: f64, most: f64) -> BiasWindow {
        let before = self.shares(kind, 0.0).false_light;
        let search =
            BiasSearch { range: (0.0, most), sweep: 33, halvings: 10, most_acne: tolerance, most_gap: tolerance };
        search.run(|amount| {
            let shares = self.shares(kind, amount);
            (shares.false_shadow, shares.false_light - before)
        })
    }

    /// An amount that leaves no more false shadow than `tolerance`, the first of a doubling series from a sixteenth of a texel; or the last of the
    /// series where none does.
    pub fn reach(&self, kind: BiasKind, tolerance: f64) -> f64 {
        let start = match kind {
            BiasKind::Slope => 1.0 / 16.0,
            BiasKind::Constant | BiasKind::Normal => self.texel() / 16.0,
        };
        let amounts = (1..DOUBLINGS).map(|doubling| start * f64::from(1u32 << doubling));
        let fine = |amount: &f64| self.shares(kind, *amount).false_shadow <= tolerance;
        let last = start * f64::from(1u32 << DOUBLINGS);
        amounts.into_iter().find(fine).unwrap_or(last)
    }

    /// The median receiver: that of the points in the middle by their distance. `None` where no pixel is judged.
    pub fn median(&self) -> Option<Receiver> {
        let view = self.map.view();
        let receivers = self.lit.iter().chain(&self.dark).filter_map(|point| view.receiver(point).ok());
        let mut receivers: Vec<Receiver> = receivers.collect();
        receivers.sort_by(|a, b| a.eye.z.total_cmp(&b.eye.z));
        receivers.get(receivers.len() / 2).copied()
    }

    /// Width of a texel at the [median](Self::median) receiver, world units; 1 where there is none.
    fn texel(&self) -> f64 {
        self.median().map_or(1.0, |receiver| f64::from(receiver.texel_world.max_element()))
    }
}

/// The fraction of a point that is in shadow by the nearest texels, all that lie within `radius` texels of it, with a bias: what [`BiasTrial`]
/// judges.
pub fn biased_fraction(
    map: &impl DepthMap,
    point: &SurfacePoint,
    radius: f64,
    bias: impl Fn(&Receiver) -> TriedBias,
) -> f32 {
    let [lit, dark] = texels(map, point, radius, bias);
    dark as f32 / (lit + dark) as f32
}

/// How many texels around a point leave it lit, and how many are nearer than it.
fn texels(map: &impl DepthMap, point: &SurfacePoint, radius: f64, bias: impl Fn(&Receiver) -> TriedBias) -> [i32; 2] {
    let view = map.view();
    let bias = view.receiver(point).ok().map(|receiver| bias(&receiver));
    // An offset may lead behind the light.
    let Some((receiver, compared)) = bias.and_then(|bias| bias.compared(view, point)) else { return [1, 0] };
    let (first, last) = around(receiver.texel, radius);
    let mut texels = [0; 2];
    for y in first.y..=last.y {
        for x in first.x..=last.x {
            texels[usize::from(map.depth(IVec2::new(x, y)) < compared)] += 1;
        }
    }
    texels
}

/// Bits behind the point of a pixel's fraction.
const SHIFT: u32 = 32;
/// The least N·L of a pixel that is judged.
const LEAST_FACING: f32 = 0.02;
/// How often the first amount is doubled at most: from a sixteenth of a texel to 4096.
const DOUBLINGS: u32 = 16;

/// The first and the last texel whose centres lie within a filter's half-extent of a place; that of the place itself at least.
fn around(texel: glam::DVec2, radius: f64) -> (IVec2, IVec2) {
    let own = texel.floor().as_ivec2();
    let (first, last) = ((texel - radius - 0.5).ceil().as_ivec2(), (texel + radius - 0.5).floor().as_ivec2());
    (first.min(own), last.max(own))
}

/// The filter's width in pixels: that of the median of all pixels whose neighbours lie on their plane.
fn border(view: &View, pixels: &[TruePixel], width: usize, radius: f64) -> usize {
    let mut widths: Vec<f64> = pixels
        .windows(2)
        .enumerate()
        .filter(|(index, pair)| (index + 1) % width.max(1) != 0 && pair[0].normal == pair[1].normal)
        .filter_map(|(_, pair)| {
            let receiver = view.receiver(&SurfacePoint::at(pair[0].position, pair[0].normal)).ok()?;
            let pixel = pair[0].position.distance(pair[1].position);
            Some((radius + 1.0) * f64::from(receiver.texel_world.max_element()) / pixel)
        })
        .filter(|width| width.is_finite())
        .collect();
    widths.sort_by(f64::total_cmp);
    widths.get(widths.len() / 2).map_or(1, |width| width.ceil().clamp(1.0, 64.0) as usize)
}
