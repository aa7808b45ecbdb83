//! Curved sheets.

use crate::Mesh;
use glam::DVec3;

/// An open two-sided sheet over `at(u, v)`, `u` and `v` in 0..=1, cut into `columns` × `rows` pieces (at least 1). One
/// surface, whose front is where u × v points. Normals are the surface's own, by differences; 0 where it has none.
///
/// Rows that are drawn together to a point lose their empty triangles.
pub(super) fn curved(columns: u32, rows: u32, at: impl Fn(f64, f64) -> DVec3) -> Mesh {
    const STEP: f64 = 1.0 / 1024.0;
    let (columns, rows) = (columns.max(1), rows.max(1));
    // Differences are taken a little inside, where a sheet that ends in a point still has width.
    let slope = |u: f64, v: f64| {
        let (u, v) = (u.clamp(STEP, 1.0 - STEP), v.clamp(STEP, 1.0 - STEP));
        let (along_u, along_v) = (at(u + STEP, v) - at(u - STEP, v), at(u, v + STEP) - at(u, v - STEP));
        along_u.cross(along_v).normalize_or_zero()
    };
    let mut mesh = Mesh::default();
    for row in 0..=rows {
        let v = f64::from(row) / f64::from(rows);
        for column in 0..=columns {
            let u = f64::from(column) / f64::from(columns);
            mesh.vertex(at(u, v).as_vec3(), slope(u, v).as_vec3());
        }
    }
    let index = |row: u32, column: u32| row * (columns + 1) + column;
    for row in 0..rows {
        for column in 0..columns {
            let (near, far) = (index(row, column), index(row + 1, column));
            mesh.quad([near, near + 1, far + 1, far], 0);
        }
    }
    mesh
}
