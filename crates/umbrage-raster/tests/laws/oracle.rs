//! The slow, plain versions: coverage texel by texel in `i128`, rays in `f64`, and helpers to read [`Bins`] back.

use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use std::collections::BTreeMap;
use umbrage_plane::{Facet, Sampling, TexelRect, View};
use umbrage_raster::{BIN, Bins, Cull, Triangle};

/// A view along −z in which one world unit is one texel and world (0, 0) is the map's middle.
pub fn texel_view(size: UVec2, sampling: Sampling) -> View {
    let half_height = 0.5 * f64::from(size.y);
    View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, half_height, 1.0, 100.0, size)
        .unwrap()
        .with_sampling(sampling)
}

/// A solid triangle of object 0.
pub fn solid(corners: [Vec3; 3]) -> Triangle {
    Triangle::new(corners, 0, false)
}

/// Bins over the whole view, nothing culled.
pub fn bins(view: &View, triangles: impl IntoIterator<Item = Triangle>) -> Bins {
    Bins::new(view, TexelRect::of_size(view.size()), Cull::None, triangles)
}

/// The facets over each covered texel, keyed by (y, x); checks what [`umbrage_raster::Coverage`] promises on the way.
pub fn fragments(bins: &Bins) -> BTreeMap<(i32, i32), Vec<Facet>> {
    let mut found = BTreeMap::<_, Vec<Facet>>::new();
    let tiles = bins.tiles();
    for tile in (0..tiles.y).flat_map(|y| (0..tiles.x).map(move |x| UVec2::new(x, y))) {
        each_in_tile(bins, tile, |texel, facet| found.entry((texel.y, texel.x)).or_default().push(*facet));
    }
    found
}

/// Calls `each` with every covered texel of a tile.
pub fn each_in_tile(bins: &Bins, tile: UVec2, mut each: impl FnMut(IVec2, &Facet)) {
    let origin = (tile * BIN).as_ivec2();
    let mut before = None;
    bins.tile(tile, |facet, coverage| {
        assert!(before < Some(facet.triangle), "facets come in the order of their triangles, each once");
        before = Some(facet.triangle);
        let (first, end) = (usize::from(coverage.first), usize::from(coverage.end));
        assert!(first < end && coverage.rows[first] != 0 && coverage.rows[end - 1] != 0, "{coverage:?}");
        for (row, bits) in coverage.rows.iter().enumerate() {
            assert!(*bits == 0 || (first..end).contains(&row), "{coverage:?}");
            for column in (0..32).filter(|column| bits >> column & 1 == 1) {
                each(origin + IVec2::new(column, row as i32), facet);
            }
        }
    });
}

/// A point in 1/256 texel.
pub type Point = [i128; 2];

/// Where a corner given in [`texel_view`] coordinates that are multiples of 1/256 lands.
pub fn snapped(size: UVec2, corner: Vec3) -> Point {
    let exact = |v: f32| {
        let scaled = f64::from(v) * 256.0;
        assert_eq!(scaled, scaled.trunc(), "the oracle wants corners on the snapping grid");
        scaled as i128
    };
    [128 * i128::from(size.x) + exact(corner.x), 128 * i128::from(size.y) - exact(corner.y)]
}

/// A texel's sample.
pub fn sample(sampling: Sampling, texel: IVec2) -> Point {
    let offset = sampling.offset_256(texel);
    [i128::from(texel.x) * 256 + i128::from(offset.x), i128::from(texel.y) * 256 + i128::from(offset.y)]
}

fn cross(a: Point, b: Point, p: Point) -> i128 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// The top-left rule by edge functions: inside, or on an edge that is the triangle's top or left one.
pub fn covers([a, b, c]: [Point; 3], p: Point) -> bool {
    let area = cross(a, b, c);
    if area == 0 {
        return false;
    }
    // Clockwise on the map, rows going down: a top edge runs to the right, a left edge runs up.
    let clockwise = if area > 0 { [a, b, c] } else { [a, c, b] };
    (0..3).all(|side| {
        let (from, to) = (clockwise[side], clockwise[(side + 1) % 3]);
        let edge = cross(from, to, p);
        let top_or_left = to[1] < from[1] || (to[1] == from[1] && to[0] > from[0]);
        edge > 0 || (edge == 0 && top_or_left)
    })
}

/// Distance of `p` from the nearest of the three edges' lines, in 1/256 texel.
pub fn clearance(corners: [Point; 3], p: Point) -> f64 {
    (0..3)
        .map(|side| {
            let (a, b) = (corners[side], corners[(side + 1) % 3]);
            let length = ((b[0] - a[0]) as f64).hypot((b[1] - a[1]) as f64);
            (cross(a, b, p) as f64 / length).abs()
        })
        .fold(f64::INFINITY, f64::min)
}

/// A camera that knows its own frame, to cast rays without asking the view.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    pub eye: DVec3,
    pub forward: DVec3,
    pub right: DVec3,
    pub up: DVec3,
    /// Half height of the view: at distance 1 (perspective), or everywhere.
    pub half: f64,
    pub perspective: bool,
    pub size: UVec2,
}

impl Camera {
    pub fn new(eye: DVec3, target: DVec3, half: f64, perspective: bool, size: UVec2) -> Self {
        let forward = (target - eye).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        Self { eye, forward, right, up: right.cross(forward), half, perspective, size }
    }

    pub fn view(&self, near: f64, far: f64) -> View {
        let target = self.eye + self.forward;
        if self.perspective {
            View::perspective(self.eye, target, DVec3::Y, 2.0 * self.half.atan(), near, far, self.size)
        } else {
            View::orthographic(self.eye, target, DVec3::Y, self.half, near, far, self.size)
        }
        .unwrap()
    }

    /// Origin and direction of the ray through a texel position; a step of 1 along it is 1 along the view's axis.
    pub fn ray(&self, texel: DVec2) -> (DVec3, DVec3) {
        let size = self.size.as_dvec2();
        let across = (2.0 * texel.x / size.x - 1.0) * self.half * size.x / size.y;
        let upward = (1.0 - 2.0 * texel.y / size.y) * self.half;
        let offset = self.right * across + self.up * upward;
        if self.perspective { (self.eye, self.forward + offset) } else { (self.eye + offset, self.forward) }
    }

    /// The point that a texel position shows at a distance along the axis.
    pub fn point(&self, texel: DVec2, zeta: f64) -> DVec3 {
        let (origin, direction) = self.ray(texel);
        origin + direction * zeta
    }
}

/// Distance along a ray at which it meets the plane of a triangle, and the point's barycentric coordinates there.
pub fn meet((origin, direction): (DVec3, DVec3), corners: [Vec3; 3]) -> (f64, [f64; 3]) {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let normal = (b - a).cross(c - a);
    let distance = normal.dot(a - origin) / normal.dot(direction);
    let at = origin + direction * distance;
    let part = |p: DVec3, q: DVec3| (p - at).cross(q - at).dot(normal) / normal.length_squared();
    (distance, [part(b, c), part(c, a), part(a, b)])
}
