use crate::{Jittered, Key, Pattern, Taps, grid::Area};
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::{DVec2, Vec2};
use umbrage_plane::Footprint;

/// Inside the region's own boundary, by rejection: [`Jittered`] over the bounding box, without the taps that fall outside
/// the quadrilateral (Reeves 1987, Fig. 3d).
///
/// The number of taps varies with the fraction of its box that the quadrilateral covers. When none falls inside, one tap is taken at the
/// centroid. Quadrilaterals that are not convex, cross themselves or have no area are sampled as
/// their bounding box.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InsideQuadReject(
    /// The grid over the bounding box.
    pub Jittered,
);

/// Inside the region's own boundary, by warping: a jittered unit square mapped bilinearly onto the quadrilateral, each tap
/// weighted by the mapping's local area, relative to its mean (Reeves 1987, Fig. 3d).
///
/// The grid's counts are those of a box with the quadrilateral's mean side lengths; columns run from the first corner toward the
/// second, rows toward the fourth. Quadrilaterals that are not convex, cross themselves or have no area are
/// sampled as their bounding box, with weight 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InsideQuadWarp(
    /// The grid over the unit square.
    pub Jittered,
);

impl Pattern for InsideQuadReject {
    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let (area, grid) = (Area::of(region), self.0.grid(region.half));
        let cell = area.cell(grid);
        let edges = convex_side(region.corners).map(|side| Edges::of(region.corners, side));
        let mut batches = grid.batches();
        let (mut any, mut next) = (false, 0);
        loop {
            let taps = if let Some(batch) = batches.next() {
                let (x, y) = self.0.places(simd, grid, key, batch.0);
                let taps = area.taps(simd, key, batch, (x * cell.x + area.low.x, y * cell.y + area.low.y));
                let mask = taps.mask & edges.map_or(0xFFFF, |edges| edges.mask(simd, taps.x, taps.y));
                any |= mask != 0;
                next = batch.0 + 16;
                Taps { mask, ..taps }
            } else if any {
                return;
            } else {
                any = true;
                let middle = centroid(region.corners);
                area.taps(simd, key, (next, 1), (f32x16::splat(simd, middle.x), f32x16::splat(simd, middle.y)))
            };
            each(&taps);
        }
    }
}

impl Pattern for InsideQuadWarp {
    #[inline(always)]
    fn weighted(&self) -> bool {
        true
    }

    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let area = Area::of(region);
        let warp = convex_side(region.corners).map(|_| Warp::of(region.corners));
        let grid = self.0.grid(warp.map_or(region.half, |warp| warp.half));
        let unit = 1.0 / Vec2::new(grid.columns as f32, grid.rows as f32);
        let cell = area.cell(grid);
        for batch in grid.batches() {
            let (i, j) = self.0.places(simd, grid, key, batch.0);
            let taps = if let Some(warp) = warp {
                let (s, t) = (i * unit.x, j * unit.y);
                Taps { weight: warp.weight(simd, s, t), ..area.taps(simd, key, batch, warp.at(s, t)) }
            } else {
                area.taps(simd, key, batch, (i * cell.x + area.low.x, j * cell.y + area.low.y))
            };
            each(&taps);
        }
    }
}

/// The bilinear mapping p = corner + s·across + t·down + s·t·twist of the unit square onto a quadrilateral.
#[derive(Clone, Copy)]
struct Warp {
    corner: Vec2,
    across: Vec2,
    down: Vec2,
    twist: Vec2,
    /// Half of the mean lengths of opposite sides.
    half: Vec2,
    /// The Jacobian relative to its mean: affine, because a bilinear mapping has no s·t in it. Constant, along s, along t.
    jacobian: [f32; 3],
}

impl Warp {
    #[inline(always)]
    fn of([a, b, c, d]: [Vec2; 4]) -> Self {
        let (across, down, twist) = (b - a, d - a, a - b + c - d);
        let half = 0.5 * Vec2::new((across + 0.5 * twist).length(), (down + 0.5 * twist).length());
        let jacobian = [across.perp_dot(down), across.perp_dot(twist), twist.perp_dot(down)];
        let mean = jacobian[0] + 0.5 * (jacobian[1] + jacobian[2]);
        Self { corner: a, across, down, twist, half, jacobian: jacobian.map(|term| term / mean) }
    }

    #[inline(always)]
    fn at<S: Simd>(&self, s: f32x16<S>, t: f32x16<S>) -> (f32x16<S>, f32x16<S>) {
        let Self { corner, across, down, twist, .. } = *self;
        (s * (t * twist.x + across.x) + t * down.x + corner.x, s * (t * twist.y + across.y) + t * down.y + corner.y)
    }

    #[inline(always)]
    fn weight<S: Simd>(&self, simd: S, s: f32x16<S>, t: f32x16<S>) -> f32x16<S> {
        let [constant, along_s, along_t] = self.jacobian;
        (s * along_s + t * along_t + constant).max(f32x16::splat(simd, 0.0))
    }
}

/// The centre of a convex quadrilateral's area: of the two triangles at its diagonal, by their areas.
#[inline(always)]
fn centroid(corners: [Vec2; 4]) -> Vec2 {
    // The areas of slivers are small differences.
    let [a, b, c, d] = corners.map(DVec2::from);
    let (first, second) = ((b - a).perp_dot(c - a), (c - a).perp_dot(d - a));
    ((a + c + (b * first + d * second) / (first + second)) * (1.0 / 3.0)).as_vec2()
}

/// The sign of a convex quadrilateral's area; `None` when it is not convex, crosses itself or has no area.
#[inline(always)]
fn convex_side(corners: [Vec2; 4]) -> Option<f32> {
    let [a, b, c, d] = corners;
    let area = (c - a).perp_dot(d - b);
    let turns = [(b - a).perp_dot(c - b), (c - b).perp_dot(d - c), (d - c).perp_dot(a - d), (a - d).perp_dot(b - a)];
    let side = area.signum();
    (area.abs() > 0.0 && turns.iter().all(|turn| turn * side >= 0.0)).then_some(side)
}

/// The four lines through the sides of a convex quadrilateral: a point on each and the normal toward the inside.
#[derive(Clone, Copy)]
struct Edges([(Vec2, Vec2); 4]);

impl Edges {
    #[inline(always)]
    fn of(corners: [Vec2; 4], side: f32) -> Self {
        Self(std::array::from_fn(|k| (corners[k], (corners[(k + 1) % 4] - corners[k]).perp() * side)))
    }

    /// Bit i set where position i is inside or on the border.
    #[inline(always)]
    fn mask<S: Simd>(&self, simd: S, x: f32x16<S>, y: f32x16<S>) -> u32 {
        self.0.iter().fold(0xFFFF, |mask, (on, inward)| {
            let height = (x - on.x) * inward.x + (y - on.y) * inward.y;
            mask & height.simd_ge(f32x16::splat(simd, 0.0)).to_bitmask() as u32
        })
    }
}
