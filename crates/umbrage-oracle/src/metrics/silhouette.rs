use super::contour::{Segment, to_segment};
use glam::{DVec2, DVec3, Vec3};
use rayon::slice::ParallelSliceMut;
use umbrage_plane::View;
use umbrage_scene::{Mesh, Scene};

/// How far each world position ([`Vec3`] or [`DVec3`]) lies from the nearest silhouette that the light's view sees of any object, in texels of
/// its map, 0..=`most`: what is farther away counts as `most`.
///
/// A silhouette is an edge between a triangle that faces the light and one that does not, or an edge that is not shared
/// by two triangles; creases between triangles that face alike are none. Hidden ones count too, and so do those of objects
/// that do not cast.
///
/// In texel space the silhouettes hold all edges of a point light's true shadows: shadow edge, silhouette and light lie
/// in one plane, and a surface grows dark by itself only where it turns away, which is a silhouette as well. Only where
/// two bodies cut into each other can a shadow begin without one.
///
/// Patches are diced as for the map. NaN where the map does not hold the position (outside its rectangle, not in front
/// of the light), or it or `most` is not finite: no comparison with it holds.
///
/// # Panics
/// When the scene's origin is not finite.
pub fn silhouette_distance(view: &View, scene: &Scene, positions: &[impl Copy + Into<DVec3>], most: f32) -> Vec<f32> {
    if !most.is_finite() {
        return vec![f32::NAN; positions.len()];
    }
    let most = f64::from(most.max(0.0));
    let mut squares = Squares::new(view, most);
    let local = &scene.about_origin(view);
    for object in &scene.objects {
        for edge in silhouettes(local, &object.shape.mesh_for(local)) {
            if let Some(segment) = in_texels(local, edge) {
                squares.insert(segment);
            }
        }
    }
    let distance = |at: DVec3| {
        let eye = view.world_to_eye().transform_point3(at);
        if !at.is_finite() || (view.is_perspective() && eye.z >= 0.0) {
            return f32::NAN;
        }
        squares.distance(view.eye_to_texel(eye)).map_or(f32::NAN, |distance| distance as f32)
    };
    positions.iter().map(|&at| distance(at.into())).collect()
}

/// The silhouette edges of a mesh that a view sees, both in one space.
fn silhouettes(view: &View, mesh: &Mesh) -> Vec<[DVec3; 2]> {
    let light = view.light();
    let mut edges = Vec::with_capacity(3 * mesh.triangles.len());
    for triangle in 0..mesh.triangles.len() {
        let corners = mesh.corners(triangle);
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a);
        // Without area there is no side; its neighbours share the rest of its edges.
        if normal == DVec3::ZERO {
            continue;
        }
        let facing = normal.dot(light.truncate() - a * light.w) > 0.0;
        for side in 0..3 {
            let [from, to] = [corners[side], corners[(side + 1) % 3]].map(place);
            // Two neighbours run along their edge in opposite directions, unless one is wound the other way.
            let (edge, ahead) = if from <= to { ([from, to], facing) } else { ([to, from], !facing) };
            edges.push((edge, ahead));
        }
    }
    edges.par_sort_unstable();
    let crease = |edge: &[([[u32; 3]; 2], bool)]| matches!(edge, [a, b] if a.1 != b.1);
    let met = edges.chunk_by(|a, b| a.0 == b.0).filter(|edge| !crease(edge));
    met.map(|edge| edge[0].0.map(|bits| Vec3::from_array(bits.map(f32::from_bits)).as_dvec3())).collect()
}

/// Bits by which two positions are the same place: −0 is 0.
fn place(position: Vec3) -> [u32; 3] {
    (position + Vec3::ZERO).to_array().map(f32::to_bits)
}

/// An edge in texel space: the part in front of the light. `None` when there is none.
fn in_texels(view: &View, edge: [DVec3; 2]) -> Option<Segment> {
    let [mut a, mut b] = edge.map(|at| view.world_to_eye().transform_point3(at));
    if view.is_perspective() {
        // Surfaces before the near plane throw shadows too.
        let nearest = -1e-6 * view.near();
        if a.z > b.z {
            std::mem::swap(&mut a, &mut b);
        }
        if a.z > nearest {
            return None;
        }
        if b.z > nearest {
            b = a.lerp(b, (nearest - a.z) / (b.z - a.z));
        }
    }
    let segment = [a, b].map(|eye| view.eye_to_texel(eye));
    segment.iter().all(|at| at.is_finite()).then_some(segment)
}

/// A map cut into squares, each with the segments that come near it.
struct Squares {
    /// Texels: no farther segments are listed.
    most: f64,
    size: DVec2,
    columns: usize,
    rows: usize,
    near: Vec<Vec<Segment>>,
}

const SQUARE: f64 = 8.0;

impl Squares {
    fn new(view: &View, most: f64) -> Self {
        let size = view.size().as_dvec2();
        let [columns, rows] = size.to_array().map(|side| (side / SQUARE).ceil() as usize);
        Self { most, size, columns, rows, near: vec![Vec::new(); columns * rows] }
    }

    /// Lists a segment in every square it comes within `most` of, row by row: long ones are not in all of their box.
    fn insert(&mut self, segment: Segment) {
        let [a, b] = if segment[0].y <= segment[1].y { segment } else { [segment[1], segment[0]] };
        for row in range(a.y - self.most, b.y + self.most, self.rows) {
            let (top, bottom) = (row as f64 * SQUARE - self.most, (row + 1) as f64 * SQUARE + self.most);
            let at = |y: f64| ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0);
            let (from, to) = if b.y > a.y { (at(top), at(bottom)) } else { (0.0, 1.0) };
            let (x0, x1) = (a.x + (b.x - a.x) * from, a.x + (b.x - a.x) * to);
            for column in range(x0.min(x1) - self.most, x0.max(x1) + self.most, self.columns) {
                self.near[row * self.columns + column].push([a, b]);
            }
        }
    }

    /// `None` outside the map.
    fn distance(&self, at: DVec2) -> Option<f64> {
        if !(at.cmpge(DVec2::ZERO).all() && at.cmplt(self.size).all()) {
            return None;
        }
        let square = (at.y / SQUARE) as usize * self.columns + (at.x / SQUARE) as usize;
        Some(self.near[square].iter().map(|segment| to_segment(at, segment)).fold(self.most, f64::min))
    }
}

/// The squares that low..=high meets, of `count`.
fn range(low: f64, high: f64, count: usize) -> std::ops::Range<usize> {
    // A rounding wider: what is listed once too often costs nothing.
    let (low, high) = ((low - 1e-6).max(0.0) / SQUARE, (high + 1e-6) / SQUARE);
    if high < 0.0 { 0..0 } else { (low as usize).min(count)..(high as usize).saturating_add(1).min(count) }
}
