//! Triangles for the rasteriser. Vertices are f32 numbers that triangles share, so that peers which know nothing else are given
//! the same ones.

use glam::{DVec3, UVec2, Vec2, Vec3};
use std::f32::consts::TAU;
use umbrage_plane::View;
use umbrage_raster::{IndexedMesh, Triangle};
use umbrage_sample::Key;

/// Half of the angle of [`straight`] views, as a tangent.
const HALF: f32 = 0.5;

/// Vertices and the triangles between them.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// World-space positions.
    pub vertices: Vec<Vec3>,
    /// Three indices into `vertices` for each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// So many of the first triangles bound a solid, object 1; the others are sheets of object 0.
    pub solid: usize,
}

impl Mesh {
    /// As the rasteriser takes them: the solid, then the sheets.
    pub fn indexed(&self) -> [IndexedMesh<'_>; 2] {
        let (solid, sheets) = self.triangles.split_at(self.solid);
        let mesh = |triangles, object, sheet| IndexedMesh::new(DVec3::ZERO, &self.vertices, triangles, object, sheet);
        [mesh(solid, 1, false), mesh(sheets, 0, true)]
    }

    /// The same triangles one by one.
    pub fn one_by_one(&self) -> Vec<Triangle> {
        self.indexed().iter().flat_map(IndexedMesh::triangles).collect()
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|corner| self.vertices[corner as usize])
    }

    /// Adds a sheet of two triangles; corners in order around it.
    fn add_quad(&mut self, corners: [Vec3; 4]) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(corners);
        self.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
}

/// A perspective view from the origin along −z, for triangles that are laid out by texels.
///
/// # Panics
/// When `side` is not a size of a map.
pub fn straight(side: u32) -> View {
    let angle = 2.0 * f64::from(HALF).atan();
    View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, angle, 1.0, 100.0, UVec2::splat(side)).expect("a valid view")
}

/// The place at a distance that [`straight`] sees at a position of its map, texels.
fn seen_at(side: u32, texel: Vec2, distance: f32) -> Vec3 {
    let unit = texel * (2.0 / side as f32) - 1.0;
    Vec3::new(unit.x * HALF * distance, -unit.y * HALF * distance, -distance)
}

/// Sheets that fill the map of [`straight`], each a little askew, the farthest first.
pub fn layers(count: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for layer in 0..count {
        let distance = 10.0 + (count - layer) as f32;
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        mesh.add_quad(corners.map(|(x, y)| {
            let half = distance * HALF * 1.25;
            Vec3::new(x * half, y * half, 0.02 * (x + 2.0 * y) - distance)
        }));
    }
    mesh
}

/// The same triangles in the opposite order.
pub fn reversed(mesh: &Mesh) -> Mesh {
    let mut mesh = mesh.clone();
    mesh.triangles.reverse();
    mesh
}

/// Single triangles of 100 texels' area, anywhere in the map of [`straight`], at distances of 5 to 50 and turned anyhow.
pub fn scattered(count: u32, side: u32) -> Mesh {
    // An equilateral triangle of area 100.
    let radius = (400.0 / (3.0 * 3f32.sqrt())).sqrt();
    let key = Key::new(3, 0, 0);
    let mut mesh = Mesh::default();
    for triangle in 0..count {
        let unit = |dimension| key.unit(triangle, dimension);
        let middle = radius + Vec2::new(unit(0), unit(1)) * (side as f32 - 2.0 * radius);
        let distance = 5.0 + 45.0 * unit(2);
        let first = mesh.vertices.len() as u32;
        for corner in 0..3 {
            let texel = middle + Vec2::from_angle(TAU * (unit(3) + corner as f32 / 3.0)) * radius;
            mesh.vertices.push(seen_at(side, texel, distance * (1.0 + 0.01 * key.signed(triangle, 4 + corner))));
        }
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh
}

/// A rough sheet of `2 · cells²` triangles in the middle of the map of [`straight`] that covers exactly `across`² texels.
pub fn grid(cells: u32, across: u32, side: u32) -> Mesh {
    let key = Key::new(4, 0, 0);
    let mut mesh = Mesh::default();
    // A quarter of a texel beyond the outermost samples' texels, where no sample is.
    let (low, extent) = ((side - across) as f32 / 2.0 - 0.25, across as f32 + 0.5);
    for row in 0..=cells {
        for column in 0..=cells {
            let texel = low + Vec2::new(column as f32, row as f32) * (extent / cells as f32);
            mesh.vertices.push(seen_at(side, texel, 20.0 + 0.01 * key.unit(row * (cells + 1) + column, 0)));
        }
    }
    for row in 0..cells {
        for column in 0..cells {
            let first = row * (cells + 1) + column;
            let below = first + cells + 1;
            mesh.triangles.extend([[first, below, below + 1], [first, below + 1, first + 1]]);
        }
    }
    mesh
}

/// A curved sheet over the whole map of [`straight`], in so many triangles, an even number: made one by one, so that nothing but the caller
/// holds them. It covers every texel of the map exactly once.
pub fn streaming_sheet(count: u32, side: u32) -> impl Iterator<Item = Triangle> {
    let cells = count / 2;
    let rows = (1..=cells.isqrt()).rev().find(|rows| cells.is_multiple_of(*rows)).unwrap_or(1);
    let columns = cells / rows;
    let corner = move |column: u32, row: u32| {
        let unit = Vec2::new(column as f32 / columns as f32, row as f32 / rows as f32);
        seen_at(side, unit * (side as f32 + 0.5) - 0.25, 20.0 + 5.0 * (unit.x * unit.x - unit.y)).as_dvec3()
    };
    (0..count).map(move |index| {
        let (column, row) = (index / 2 % columns, index / 2 / columns);
        let (here, across) = (corner(column, row), corner(column + 1, row + 1));
        let corners = match index % 2 {
            0 => [here, corner(column, row + 1), across],
            _ => [here, across, corner(column + 1, row)],
        };
        Triangle { corners, object: 0, sheet: true }
    })
}

/// A knotted tube, closed, over a square ground at y = 0: `2 · along · around` triangles and two.
pub fn knot_on_ground(along: u32, around: u32) -> Mesh {
    let knot = umbrage_scene::Mesh::knot(along, around);
    // Every figure of this crate was taken with these corners in this order.
    let triangles = knot.triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect();
    let mut mesh = Mesh { vertices: knot.positions, triangles, solid: 0 };
    mesh.solid = mesh.triangles.len();
    let corners = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
    mesh.add_quad(corners.map(|(x, z)| Vec3::new(x * 40.0, 0.0, z * 40.0)));
    mesh
}
