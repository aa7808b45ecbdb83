//! From a triangle of the world to the record that tiles are filled from.

use crate::clip::{Clipper, GUARD_TEXELS, NEAR_LIMIT};
use crate::{Cull, Stats, Triangle};
use glam::{DMat4, DVec3, IVec2};
use umbrage_plane::{Affine, Facet, Facing, Sampling, TexelRect, View};

/// One snap step is 1/256 texel.
pub(crate) const SUBTEXELS: i32 = 256;

/// What is kept of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    plane: Affine,
    /// Index of its first corner among all corners.
    first: u32,
    triangle: u32,
    object: u32,
    sides: u8,
    front: bool,
    sheet: bool,
}

impl Piece {
    pub fn facet(&self) -> Facet {
        Facet {
            plane: self.plane,
            facing: if self.front { Facing::Front } else { Facing::Back },
            triangle: self.triangle,
            object: self.object,
            sheet: self.sheet,
        }
    }

    pub fn triangle(&self) -> u32 {
        self.triangle
    }

    /// Its snapped corners among all.
    pub fn corners<'a>(&self, all: &'a [IVec2]) -> &'a [IVec2] {
        &all[self.first as usize..][..usize::from(self.sides)]
    }
}

/// Which polygons are of use to a texel.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Reach {
    /// Those that may cover its sample.
    Samples(Sampling),
    /// Those that may cover any place in it.
    Anywhere,
}

impl Reach {
    /// The texels that a polygon may be of use to, by its bounding box: inclusive at the low side, exclusive at the high.
    pub fn texels(self, corners: &[IVec2]) -> TexelRect {
        match self {
            Self::Samples(sampling) => sampled(sampling, corners),
            Self::Anywhere => anywhere(corners),
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

/// Makes pieces.
pub(crate) struct Setup<'a> {
    view: &'a View,
    world_to_eye: DMat4,
    window: TexelRect,
    cull: Cull,
    reach: Reach,
    clipper: Clipper,
    /// In the order of their triangles.
    pub pieces: Vec<Piece>,
    /// Corners of all pieces, in 1/256 texel.
    pub corners: Vec<IVec2>,
    pub stats: Stats,
}

impl<'a> Setup<'a> {
    pub fn new(view: &'a View, window: TexelRect, cull: Cull, reach: Reach) -> Self {
        Self {
            view,
            world_to_eye: view.world_to_eye(),
            window,
            cull,
            reach,
            clipper: Clipper::default(),
            pieces: Vec::new(),
            corners: Vec::new(),
            stats: Stats::default(),
        }
    }

    /// Takes one more triangle; its index is the number of those before it.
    pub fn add(&mut self, triangle: &Triangle) {
        let first = self.corners.len();
        let skipped = self.piece(triangle).err();
        self.stats.given += 1;
        let count = match skipped {
            None => return,
            Some(Skip::NotFinite) => &mut self.stats.not_finite,
            Some(Skip::ZeroArea) => &mut self.stats.zero_area,
            Some(Skip::Culled) => &mut self.stats.culled,
            Some(Skip::Outside) => &mut self.stats.outside,
            Some(Skip::Missed) => &mut self.stats.missed,
        };
        *count += 1;
        self.corners.truncate(first);
    }

    fn piece(&mut self, triangle: &Triangle) -> Result<(), Skip> {
        let world = triangle.corners;
        if world.iter().any(|corner| !corner.abs().cmplt(DVec3::splat(1e30)).all()) {
            return Err(Skip::NotFinite);
        }
        // Differences of f32 numbers are exact in f64 unless one is 2²⁹ times the other, and those of numbers about an f64 origin
        // have one rounding; those of eye space have several.
        let edges = [world[1] - world[0], world[2] - world[0]];
        if edges[0].cross(edges[1]) == DVec3::ZERO {
            return Err(Skip::ZeroArea);
        }
        // Corner by corner: what is mapped over an array is not always inlined, and then costs a fifth of a plain bake.
        let to_eye = self.world_to_eye;
        let edges = [to_eye.transform_vector3(edges[0]), to_eye.transform_vector3(edges[1])];
        let eye =
            [to_eye.transform_point3(world[0]), to_eye.transform_point3(world[1]), to_eye.transform_point3(world[2])];
        if !eye.iter().all(|corner| corner.is_finite()) {
            return Err(Skip::NotFinite);
        }
        let limit = self.view.near() * NEAR_LIMIT;
        let too_near = |corner: &DVec3| -corner.z > 0.0 && -corner.z < limit;
        self.stats.too_near += u64::from(self.view.is_perspective() && eye.iter().any(too_near));
        let projected = self.clipper.project(self.view, eye);
        if projected.corners.len() < 3 {
            return Err(Skip::Outside);
        }
        let first = self.corners.len();
        self.corners.extend(projected.corners.iter().map(|corner| snap(*corner)));
        let snapped = &self.corners[first..];
        let cull = if triangle.sheet { Cull::None } else { self.cull };
        let front = side(snapped, self.reach, self.window, cull)?;
        let plane = plane(self.view, eye, edges[0].cross(edges[1]), projected.corners);
        self.stats.clipped += u64::from(projected.clipped);
        self.stats.before_near += u64::from(eye.iter().any(|corner| -corner.z < self.view.near()));
        self.pieces.push(Piece {
            plane,
            first: first as u32,
            triangle: self.stats.given as u32,
            object: triangle.object,
            sides: snapped.len() as u8,
            front,
            sheet: triangle.sheet,
        });
        Ok(())
    }
}

/// True when the outside of a polygon is seen; or why it is not drawn.
fn side(snapped: &[IVec2], reach: Reach, window: TexelRect, cull: Cull) -> Result<bool, Skip> {
    let (low, high) = bounds(snapped);
    let touched = TexelRect::new(low >> 8, (high >> 8) + 1);
    if window.intersect(touched).is_empty() {
        return Err(Skip::Outside);
    }
    let area = twice_area(snapped);
    // A cut polygon that snapping twisted may have no net area and still cover a sample.
    if area == 0 && snapped.len() == 3 {
        return Err(Skip::ZeroArea);
    }
    // Rows go down: counter-clockwise to the viewer is negative.
    let front = area < 0;
    if (cull == Cull::Front && front) || (cull == Cull::Back && !front) {
        return Err(Skip::Culled);
    }
    if window.intersect(reach.texels(snapped)).is_empty() {
        return Err(Skip::Missed);
    }
    Ok(front)
}

/// Rounds a texel position to 1/256 texel, ties to even: a function of the position alone. NaN, which only absurd projections make of finite corners, snaps to the guard band.
fn snap(corner: DVec3) -> IVec2 {
    // At 1.5·2⁵² an f64's last bit is 1, so adding rounds, and the low half of the bits is the integer.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let axis = |texel: f64| {
        #[expect(clippy::manual_clamp, reason = "NaN must become a number")]
        let inside = texel.max(-GUARD_TEXELS).min(GUARD_TEXELS);
        (inside * f64::from(SUBTEXELS) + ROUND).to_bits() as i32
    };
    IVec2::new(axis(corner.x), axis(corner.y))
}

/// The least and the greatest coordinates.
pub(crate) fn bounds(corners: &[IVec2]) -> (IVec2, IVec2) {
    corners[1..].iter().fold((corners[0], corners[0]), |(low, high), corner| (low.min(*corner), high.max(*corner)))
}

/// Positive when clockwise as seen on the map, rows going down. Exact: differences fit in 30 bits.
fn twice_area(corners: &[IVec2]) -> i64 {
    let from = |corner: IVec2| (corner - corners[0]).as_i64vec2();
    corners[1..].windows(2).map(|pair| from(pair[0]).perp_dot(from(pair[1]))).sum()
}

/// The texels whose sample may lie in the polygon, by its bounding box: inclusive at the low side, exclusive at the high.
pub(crate) fn sampled(sampling: Sampling, corners: &[IVec2]) -> TexelRect {
    let (low, high) = bounds(corners);
    match sampling {
        // The samples are at 256·i + 128; ⌈(v − 128) / 256⌉ is the first that is not before v.
        Sampling::Centre => TexelRect::new((low + 127) >> 8, (high + 127) >> 8),
        Sampling::Jittered { .. } => anywhere(corners),
    }
}

/// The texels that the polygon's bounding box touches.
fn anywhere(corners: &[IVec2]) -> TexelRect {
    let (low, high) = bounds(corners);
    TexelRect::new(low >> 8, (high + 255) >> 8)
}

/// The plane through a triangle, as a key over texels.
///
/// A covered sample may lie off the triangle by half a snapping step, as its corners do. Where a whole step leads out of the triangle's own range of
/// keys, it is so edge-on that its plane says nothing of use there: it gets its mean key everywhere. Otherwise a sample's key leaves the range by
/// half of it at most.
fn plane(view: &View, eye: [DVec3; 3], eye_normal: DVec3, corners: &[DVec3]) -> Affine {
    // The corner nearest to the eye gives the plane's distance from the eye with the least cancellation.
    let nearer = |a: DVec3, b: DVec3| if b.length_squared() < a.length_squared() { b } else { a };
    let through = nearer(nearer(eye[0], eye[1]), eye[2]);
    let keys = corners.iter().map(|corner| corner.z);
    let low = keys.clone().fold(f64::INFINITY, f64::min);
    let high = keys.clone().fold(f64::NEG_INFINITY, f64::max);
    view.affine(through, eye_normal)
        .filter(|plane| (plane.dx.abs() + plane.dy.abs()) * (1.0 / f64::from(SUBTEXELS)) <= high - low)
        .unwrap_or_else(|| {
            let mean = keys.sum::<f64>() / corners.len() as f64;
            // Cuts of finite corners overflow when the near distance is absurdly small.
            Affine::constant(if mean.is_finite() { mean } else { view.key(view.near()) })
        })
}
