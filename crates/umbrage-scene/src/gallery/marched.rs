//! Closed meshes of implicit surfaces by marching tetrahedra: uneven triangles without any order, as scanners give them.

use crate::Mesh;
use glam::{UVec3, Vec3};
use std::collections::BTreeMap;

/// The box that is searched for a surface, which lies well inside it.
pub(super) struct Grid {
    pub(super) low: Vec3,
    pub(super) high: Vec3,
    pub(super) cells: UVec3,
    /// By which fraction cells are higher than the mean at the bottom and lower at the top, 0..1.
    pub(super) finer_above: f32,
}

impl Grid {
    fn corner(&self, at: UVec3) -> Vec3 {
        let part = at.as_vec3() / self.cells.as_vec3();
        let up = part.y + self.finer_above * part.y * (1.0 - part.y);
        self.low + (self.high - self.low) * part.with_y(up)
    }

    fn index(&self, at: UVec3) -> u32 {
        at.x + (self.cells.x + 1) * (at.y + (self.cells.y + 1) * at.z)
    }
}

/// The six tetrahedra of a cell: from corner 0 to corner 7 along its sides in every order. Corners are bits of x, y and z;
/// all are turned the same way.
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 2, 6, 7], [0, 4, 5, 7], [0, 3, 2, 7], [0, 6, 4, 7], [0, 5, 1, 7]];

/// The surface where `distance`, which is negative inside, changes its sign.
pub(super) fn marched(grid: &Grid, distance: impl Fn(Vec3) -> f32) -> Mesh {
    let mut mesh = Mesh::default();
    let mut places = BTreeMap::new();
    let UVec3 { x: columns, y: rows, z: layers } = grid.cells + 1;
    let every = (0..layers).flat_map(|z| (0..rows).flat_map(move |y| (0..columns).map(move |x| UVec3::new(x, y, z))));
    let values: Vec<f32> = every.clone().map(|at| distance(grid.corner(at))).collect();
    for cell in every.filter(|at| at.cmplt(grid.cells).all()) {
        let corners: [UVec3; 8] =
            std::array::from_fn(|i| cell + UVec3::new(i as u32 & 1, i as u32 >> 1 & 1, i as u32 >> 2));
        let inside = corners.map(|at| values[grid.index(at) as usize] < 0.0);
        if inside.iter().all(|one| *one) || inside.iter().all(|one| !one) {
            continue;
        }
        // The vertex between two corners, the same for every tetrahedron that has both.
        let mut between = |mesh: &mut Mesh, a: usize, b: usize| {
            let ends = [corners[a], corners[b]].map(|at| (grid.index(at), at));
            let [(first, low), (last, high)] = if ends[0].0 < ends[1].0 { ends } else { [ends[1], ends[0]] };
            *places.entry((first, last)).or_insert_with(|| {
                let (start, end) = (values[first as usize], values[last as usize]);
                // Never at a corner, where vertices of several sides would be one place.
                let part = (start / (start - end)).clamp(0.02, 0.98);
                let at = grid.corner(low).lerp(grid.corner(high), part);
                mesh.vertex(at, outward(&distance, at));
                mesh.positions.len() as u32 - 1
            })
        };
        for corners in TETRAHEDRA {
            match corners.map(|corner| inside[corner]).iter().filter(|one| **one).count() {
                count @ (1 | 3) => {
                    // All permutations here are even: they keep which way the tetrahedron is turned.
                    let alone = |[apex, ..]: &[usize; 4]| inside[corners[*apex]] == (count == 1);
                    let turns = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 0, 1, 3], [3, 0, 2, 1]];
                    let turn = turns.into_iter().find(alone).expect("one of four").map(|at| corners[at]);
                    let [a, b, c] = [1, 2, 3].map(|other| between(&mut mesh, turn[0], turn[other]));
                    mesh.triangle(if count == 1 { [a, b, c] } else { [a, c, b] }, 0);
                }
                2 => {
                    let pairs = [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [1, 2, 0, 3], [1, 3, 2, 0], [2, 3, 0, 1]];
                    let both = |[a, b, ..]: &[usize; 4]| inside[corners[*a]] && inside[corners[*b]];
                    let turn = pairs.into_iter().find(both).expect("one of six").map(|at| corners[at]);
                    let sides = [(0, 2), (0, 3), (1, 3), (1, 2)];
                    let ring = sides.map(|(from, to)| between(&mut mesh, turn[from], turn[to]));
                    mesh.quad(ring, 0);
                }
                _ => {}
            }
        }
    }
    mesh
}

/// The direction in which the distance grows the most, by differences at the corners of a small tetrahedron.
fn outward(distance: &impl Fn(Vec3) -> f32, at: Vec3) -> Vec3 {
    const STEP: f32 = 0.02;
    let ends = [Vec3::ONE, Vec3::new(1.0, -1.0, -1.0), Vec3::new(-1.0, 1.0, -1.0), Vec3::new(-1.0, -1.0, 1.0)];
    ends.into_iter().map(|end| end * distance(at + end * STEP)).sum::<Vec3>().normalize_or_zero()
}
