//! From a triangle of the world to the record that tiles are filled from.

use crate::clip::{Clipper, GUARD_TEXELS, NEAR_LIMIT};
use crate::piece::{Block, Owner, Patch, Piece, SEVERAL};
use crate::{BIN, Cull, Triangle};
use glam::{DVec3, IVec2, UVec2};
use umbrage_plane::{Affine, Sampling, TexelRect, View};

/// One snap step is 1/256 texel.
pub(crate) const SUBTEXELS: i32 = 256;

/// Which polygons are of use to a texel.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Reach {
    /// Those that may cover its sample.
    Samples(Sampling),
    /// Those that may cover any place in it, or in the texels beside it, below it and beside that one: what a finer grid of a tile is compared
    /// with then stands in the tile's own list.
    Around,
}

impl Reach {
    /// The texels that a polygon may be of use to, by the least and the greatest coordinates of its corners: inclusive at the low side,
    /// exclusive at the high.
    #[inline(always)]
    pub fn texels(self, (low, high): (IVec2, IVec2)) -> TexelRect {
        match self {
            // The samples are at 256·i + 128; ⌈(v − 128) / 256⌉ is the first that is not before v.
            Self::Samples(Sampling::Centre) => TexelRect::new((low + 127) >> 8, (high + 127) >> 8),
            Self::Samples(Sampling::Jittered { .. }) => TexelRect::new(low >> 8, (high + 255) >> 8),
            Self::Around => TexelRect::new((low - self.beyond()) >> 8, (high + 255) >> 8),
        }
    }

    /// How far beyond a texel's right and lower side a polygon may be and still be of use to it, in 1/256 texel.
    #[inline(always)]
    pub fn beyond(self) -> i32 {
        match self {
            Self::Samples(_) => 0,
            Self::Around => SUBTEXELS,
        }
    }
}

/// Why a triangle is not kept.
enum Skip {
    NotFinite,
    ZeroArea,
    Culled,
    Outside,
    Missed,
}

/// How a view's triangles are set up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setup {
    pub view: View,
    pub window: TexelRect,
    pub cull: Cull,
    pub reach: Reach,
}

impl Setup {
    /// Makes a block anew of so many consecutive triangles, which `add` adds, the index of the first of which is `first`.
    pub fn fill(&self, block: &mut Block, first: u32, count: usize, add: impl FnOnce(&mut Making<'_>)) {
        let mut making = Making { setup: self, first, clipper: Clipper::default(), block: block.emptied() };
        making.block.pieces.reserve(count);
        making.block.homes.reserve(count);
        add(&mut making);
        *block = making.block;
        if block.pieces.len() < count / 2 {
            block.pieces.shrink_to_fit();
        }
    }

    /// Number of tiles across and down.
    #[inline(always)]
    pub fn tiles(&self) -> UVec2 {
        self.view.size().map(|side| side.div_ceil(BIN))
    }

    /// Whether the outside of a polygon is seen, by twice its area; or why it is not drawn.
    #[inline(always)]
    fn front(&self, area: i64, sides: usize, sheet: bool) -> Result<bool, Skip> {
        // A cut polygon that snapping twisted may have no net area and still cover a sample.
        if area == 0 && sides == 3 {
            return Err(Skip::ZeroArea);
        }
        // Rows go down: counter-clockwise to the viewer is negative.
        let front = area < 0;
        if !sheet && ((self.cull == Cull::Front && front) || (self.cull == Cull::Back && !front)) {
            return Err(Skip::Culled);
        }
        Ok(front)
    }

    /// Whether the outside of a polygon is seen, and its home; or why it is not drawn.
    #[inline(always)]
    fn place(&self, bounds: (IVec2, IVec2), area: i64, sides: usize, sheet: bool) -> Result<(bool, u32), Skip> {
        let (low, high) = bounds;
        let touched = TexelRect::new(low >> 8, (high >> 8) + 1);
        if self.window.intersect(touched).is_empty() {
            return Err(Skip::Outside);
        }
        let front = self.front(area, sides, sheet)?;
        let texels = self.window.intersect(self.reach.texels(bounds));
        if texels.is_empty() {
            return Err(Skip::Missed);
        }
        let (first, last) = (texels.min.as_uvec2() / BIN, (texels.max - 1).as_uvec2() / BIN);
        let home = first.y * self.tiles().x + first.x;
        Ok((front, if first == last { home } else { SEVERAL }))
    }
}

/// What is known of a triangle that is not cut.
pub(crate) struct Whole {
    /// Snapped.
    pub corners: [IVec2; 3],
    /// Twice the area.
    pub area: i64,
    pub plane: Affine,
    pub before_near: bool,
}

/// A block that is being made.
pub(crate) struct Making<'a> {
    pub setup: &'a Setup,
    first: u32,
    clipper: Clipper,
    block: Block,
}

impl Making<'_> {
    /// Takes one more triangle; its index is the number of those before it.
    #[inline(never)]
    pub fn add(&mut self, triangle: &Triangle) {
        let made = self.piece(triangle);
        self.count(&made);
    }

    /// Counts one triangle more, and why it was skipped where it was.
    #[inline(always)]
    fn count(&mut self, made: &Result<(), Skip>) {
        let stats = &mut self.block.stats;
        stats.given += 1;
        match made {
            Ok(()) => {}
            Err(Skip::NotFinite) => stats.not_finite += 1,
            Err(Skip::ZeroArea) => stats.zero_area += 1,
            Err(Skip::Culled) => stats.culled += 1,
            Err(Skip::Outside) => stats.outside += 1,
            Err(Skip::Missed) => stats.missed += 1,
        }
    }

    /// Takes one more triangle that is not cut.
    #[inline(always)]
    pub fn add_whole(&mut self, owner: Owner, whole: &Whole) {
        let [a, b, c] = whole.corners;
        let bounds = (a.min(b).min(c), a.max(b).max(c));
        let placed = self.setup.place(bounds, whole.area, 3, owner.sheet);
        self.keep_whole(owner, whole, Patch::NONE, placed);
    }

    /// [`Making::add_whole`] of a small triangle.
    #[inline(always)]
    pub fn add_small(&mut self, owner: Owner, whole: &Whole, patch: Patch, home: u32) {
        let placed = self.setup.front(whole.area, 3, owner.sheet).map(|front| (front, home));
        self.keep_whole(owner, whole, patch, placed);
    }

    #[inline(always)]
    fn keep_whole(&mut self, owner: Owner, whole: &Whole, patch: Patch, placed: Result<(bool, u32), Skip>) {
        let made = match placed {
            Ok((front, home)) => {
                self.block.stats.before_near += u64::from(whole.before_near);
                self.keep(owner, whole.plane, whole.corners, (patch.0, 3), front, home);
                Ok(())
            }
            Err(skip) => Err(skip),
        };
        self.count(&made);
    }

    #[inline(always)]
    fn keep(
        &mut self,
        owner: Owner,
        plane: Affine,
        corners: [IVec2; 3],
        (extra, sides): (u32, u8),
        front: bool,
        home: u32,
    ) {
        let Owner { object, sheet } = owner;
        let index = self.first + self.block.stats.given as u32;
        self.block.pieces.push(Piece { plane, corners, extra, triangle: index, object, sides, front, sheet });
        self.block.homes.push(home);
    }

    fn piece(&mut self, triangle: &Triangle) -> Result<(), Skip> {
        let view = &self.setup.view;
        let world = triangle.corners;
        if !world.iter().all(|corner| corner.abs().cmplt(DVec3::splat(FARTHEST)).all()) {
            return Err(Skip::NotFinite);
        }
        // Differences of f32 numbers are exact in f64 unless one is 2²⁹ times the other, and those of numbers about an f64 origin
        // have one rounding; those of eye space have several.
        let edges = [world[1] - world[0], world[2] - world[0]];
        if edges[0].cross(edges[1]) == DVec3::ZERO {
            return Err(Skip::ZeroArea);
        }
        let to_eye = view.world_to_eye();
        let edges = [to_eye.transform_vector3(edges[0]), to_eye.transform_vector3(edges[1])];
        // Corner by corner: what is mapped over an array is not always inlined.
        let eye =
            [to_eye.transform_point3(world[0]), to_eye.transform_point3(world[1]), to_eye.transform_point3(world[2])];
        if !eye.iter().all(|corner| corner.is_finite()) {
            return Err(Skip::NotFinite);
        }
        let limit = view.near() * NEAR_LIMIT;
        let too_near = |corner: &DVec3| -corner.z > 0.0 && -corner.z < limit;
        self.block.stats.too_near += u64::from(view.is_perspective() && eye.iter().any(too_near));
        let projected = self.clipper.project(view, eye);
        let sides = projected.corners.len();
        if sides < 3 {
            return Err(Skip::Outside);
        }
        let first = self.block.corners.len();
        self.block.corners.extend(projected.corners.iter().map(|corner| snap(*corner)));
        let snapped = &self.block.corners[first..];
        let placed = self.setup.place(bounds(snapped), twice_area(snapped), sides, triangle.sheet);
        let corners = [snapped[0], snapped[1], snapped[2]];
        if placed.is_err() || sides == 3 {
            self.block.corners.truncate(first);
        }
        let (front, home) = placed?;
        let plane = plane(view, eye, edges[0].cross(edges[1]), projected.corners);
        self.block.stats.clipped += u64::from(projected.clipped);
        self.block.stats.before_near += u64::from(eye.iter().any(|corner| -corner.z < view.near()));
        let extra = if sides == 3 { Patch::NONE.0 } else { first as u32 };
        self.keep(triangle.owner(), plane, corners, (extra, sides as u8), front, home);
        Ok(())
    }
}

/// World coordinates of this size or more are not finite ([`Triangle::corners`]).
pub(crate) const FARTHEST: f64 = 1e30;

/// Rounds a texel position to 1/256 texel, ties to even: a function of the position alone. NaN, which only absurd projections make of finite corners, snaps to the guard band.
fn snap(corner: DVec3) -> IVec2 {
    #[expect(clippy::manual_clamp, reason = "NaN must become a number")]
    let axis = |texel: f64| rounded(texel.max(-GUARD_TEXELS).min(GUARD_TEXELS));
    IVec2::new(axis(corner.x), axis(corner.y))
}

/// A coordinate inside the guard band, in texels, rounded to 1/256 texel.
#[inline(always)]
pub(crate) fn rounded(texel: f64) -> i32 {
    // At 1.5·2⁵² an f64's last bit is 1, so adding rounds, and the low half of the bits is the integer.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    (texel * f64::from(SUBTEXELS) + ROUND).to_bits() as i32
}

/// The least and the greatest coordinates.
#[inline(always)]
pub(crate) fn bounds(corners: &[IVec2]) -> (IVec2, IVec2) {
    // Nearly all have three, for which no loop is needed.
    if let [a, b, c] = *corners {
        return (a.min(b).min(c), a.max(b).max(c));
    }
    corners[1..].iter().fold((corners[0], corners[0]), |(low, high), corner| (low.min(*corner), high.max(*corner)))
}

/// Positive when clockwise as seen on the map, rows going down. Exact: differences fit in 30 bits.
fn twice_area(corners: &[IVec2]) -> i64 {
    let from = |corner: IVec2| (corner - corners[0]).as_i64vec2();
    corners[1..].windows(2).map(|pair| from(pair[0]).perp_dot(from(pair[1]))).sum()
}

/// The plane through a triangle, as a key over texels.
///
/// A covered sample may lie off the triangle by half a snapping step, as its corners do. Where a whole step leads out of the triangle's own range of
/// keys, it is so edge-on that its plane says nothing of use there: it gets its mean key everywhere. Otherwise a sample's key leaves the range by
/// half of it at most.
fn plane(view: &View, eye: [DVec3; 3], eye_normal: DVec3, corners: &[DVec3]) -> Affine {
    let keys = corners.iter().map(|corner| corner.z);
    let low = keys.clone().fold(f64::INFINITY, f64::min);
    let high = keys.clone().fold(f64::NEG_INFINITY, f64::max);
    let through = nearer(nearer(eye[0], eye[1]), eye[2]);
    view.affine(through, eye_normal)
        .filter(|plane| (plane.dx.abs() + plane.dy.abs()) * STEP <= high - low)
        .unwrap_or_else(|| {
            let mean = keys.sum::<f64>() / corners.len() as f64;
            // Cuts of finite corners overflow when the near distance is absurdly small.
            Affine::constant(if mean.is_finite() { mean } else { view.key(view.near()) })
        })
}

/// The corner nearer to the eye: it gives the plane's distance from the eye with less cancellation.
#[inline(always)]
pub(crate) fn nearer(a: DVec3, b: DVec3) -> DVec3 {
    if b.length_squared() < a.length_squared() { b } else { a }
}

/// One snap step, in texels.
pub(crate) const STEP: f64 = 1.0 / SUBTEXELS as f64;
