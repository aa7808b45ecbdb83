//! A primitive, posed and placed: the mesh of an object.

use crate::GltfError;
use crate::accessor::Accessor;
use crate::budget::{OBJECT, TRIANGLE, VERTEX};
use crate::file::File;
use crate::primitive::Primitive;
use glam::{DAffine3, DMat3, DVec3, Vec3};
use umbrage_scene::Mesh;

/// What carries the vertices of a mesh into the world.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Carrier<'a> {
    /// One transform for all.
    Rigid(DAffine3),
    /// The joints of a skin, each vertex by its weights.
    Joints(&'a [DAffine3]),
}

/// A primitive in the world, about `origin`. `weights` are those of its morph targets; missing ones are 0.
pub(crate) fn placed(
    file: &File,
    primitive: &Primitive,
    weights: &[f64],
    carrier: Carrier,
    origin: DVec3,
) -> Result<Mesh, GltfError> {
    let active: Vec<_> = primitive.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0).collect();
    charge(file, primitive, active.len())?;
    let vertices = primitive.positions.len();
    let mut positions = Vec::with_capacity(vertices);
    let mut normals = Vec::with_capacity(if primitive.normals.is_some() { vertices } else { 0 });
    // Whether the space about each vertex is turned inside out.
    let mut mirrored = Vec::with_capacity(vertices);
    for (vertex, (&id, &position)) in primitive.ids.iter().zip(&primitive.positions).enumerate() {
        let added = |of: &dyn Fn(usize) -> Option<DVec3>| {
            (0..active.len())
                .fold(DVec3::ZERO, |sum, target| sum + of(target).unwrap_or(DVec3::ZERO) * active[target].1)
        };
        let id = id as usize;
        let read = |accessor: &Accessor| DVec3::from_array(accessor.get(id));
        let position = position + added(&|target| active[target].0.positions.as_ref().map(read));
        let carry = match carrier {
            Carrier::Rigid(carry) => carry,
            Carrier::Joints(joints) => blended(primitive, joints, id)?,
        };
        let world = carry.transform_point3(position) - origin;
        if !(world.as_vec3().is_finite() && carry.matrix3.is_finite()) {
            let value = format!("vertex {vertex} stands at {:?}", world.to_array());
            return Err(GltfError::field(&primitive.path, value, "a place within the range of floats"));
        }
        positions.push(world);
        mirrored.push(carry.matrix3.determinant() < 0.0);
        if let Some(own) = &primitive.normals {
            let normal = read(own) + added(&|target| active[target].0.normals.as_ref().map(read));
            normals.push(covector(&carry.matrix3, normal));
        }
    }
    let mut triangles = primitive.triangles.clone();
    for corners in &mut triangles {
        if corners.iter().filter(|&&vertex| mirrored[vertex as usize]).count() > 1 {
            corners.swap(1, 2);
        }
    }
    let (uvs, colours) = (&primitive.uvs, &primitive.colours);
    Ok(if primitive.normals.is_some() {
        Mesh { uvs: uvs.clone(), colours: colours.clone(), ..smooth(&positions, normals, triangles) }
    } else {
        let corner = |vertex: &u32| *vertex as usize;
        let uvs = triangles.iter().flatten().filter_map(|vertex| uvs.get(corner(vertex)).copied()).collect();
        let colours = triangles.iter().flatten().filter_map(|vertex| colours.get(corner(vertex)).copied()).collect();
        Mesh { uvs, colours, ..flat(&positions, &triangles) }
    })
}

fn charge(file: &File, primitive: &Primitive, targets: usize) -> Result<(), GltfError> {
    let [vertices, triangles] = [primitive.positions.len(), primitive.triangles.len()].map(|count| count as u64);
    let corners = if primitive.normals.is_some() { vertices } else { vertices + 3 * triangles };
    let each = [(1, OBJECT), (corners, VERTEX), (triangles, TRIANGLE), (vertices, 24 * targets as u64)];
    let sum = each.iter().fold(0_u64, |sum, (count, bytes)| sum.saturating_add(count.saturating_mul(*bytes)));
    file.budget.charge(&primitive.path, sum, 1)
}

/// The mean of the joints that carry a vertex, by its weights; nothing moves a vertex that has none.
fn blended(primitive: &Primitive, joints: &[DAffine3], id: usize) -> Result<DAffine3, GltfError> {
    let (mut matrix, mut translation, mut sum) = (DMat3::ZERO, DVec3::ZERO, 0.0);
    for (set, [of, by]) in primitive.joints.iter().enumerate() {
        let (of, by) = (of.get::<4>(id), by.get::<4>(id));
        for (joint, weight) in of.into_iter().zip(by).filter(|(_, weight)| *weight != 0.0) {
            let Some(carry) = joints.get(joint as usize) else {
                let path = format!("{}.attributes.JOINTS_{set}", primitive.path);
                return Err(GltfError::field(path, joint, format!("a joint below {}", joints.len())));
            };
            matrix += carry.matrix3 * weight;
            translation += carry.translation * weight;
            sum += weight;
        }
    }
    if sum == 0.0 {
        return Ok(DAffine3::IDENTITY);
    }
    Ok(DAffine3 { matrix3: matrix * (1.0 / sum), translation: translation / sum })
}

/// A normal where a space was transformed: square to what its plane became, and still outward where that was mirrored.
/// Zero where no direction is left.
fn covector(matrix: &DMat3, normal: DVec3) -> Vec3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let turned = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * normal;
    let side = if x.dot(y.cross(z)) < 0.0 { -1.0 } else { 1.0 };
    // Cofactors are squares of the scale: lengths may leave what squares of f64 hold.
    let most = turned.abs().max_element();
    let unit = (turned * (side / most)).normalize_or_zero().as_vec3();
    if unit.is_finite() { unit } else { Vec3::ZERO }
}

/// The normal of a triangle; some direction for one without an area.
fn facet(positions: &[DVec3], corners: [u32; 3]) -> Vec3 {
    let [a, b, c] = corners.map(|vertex| positions[vertex as usize]);
    let (along, across) = (b - a, c - a);
    let most = along.abs().max(across.abs()).max_element();
    let normal = (along / most).cross(across / most).normalize_or_zero().as_vec3();
    if normal.is_finite() && normal != Vec3::ZERO { normal } else { Vec3::Y }
}

fn smooth(positions: &[DVec3], mut normals: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    for corners in &triangles {
        for &vertex in corners {
            if normals[vertex as usize] == Vec3::ZERO {
                normals[vertex as usize] = facet(positions, *corners);
            }
        }
    }
    let surfaces = surfaces(positions.len(), &triangles);
    let positions = positions.iter().map(|at| at.as_vec3()).collect();
    Mesh { positions, normals, triangles, surfaces, ..Mesh::default() }
}

/// Every triangle a surface of its own.
fn flat(positions: &[DVec3], triangles: &[[u32; 3]]) -> Mesh {
    let corners = triangles.iter().flatten();
    let normals = triangles.iter().flat_map(|&corners| [facet(positions, corners); 3]);
    let count = triangles.len() as u32;
    Mesh {
        positions: corners.map(|&vertex| positions[vertex as usize].as_vec3()).collect(),
        normals: normals.collect(),
        triangles: (0..count).map(|triangle| [0, 1, 2].map(|corner| triangle * 3 + corner)).collect(),
        surfaces: (0..count).collect(),
        ..Mesh::default()
    }
}

/// The surface of each triangle: triangles that share a vertex, and so a normal there, are on one.
fn surfaces(vertices: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..vertices as u32).collect();
    for &[a, b, c] in triangles {
        let first = root(&mut parent, a);
        for other in [b, c] {
            let other = root(&mut parent, other);
            // The least number of a surface stands for it.
            let (low, high) = (root(&mut parent, first).min(other), root(&mut parent, first).max(other));
            parent[high as usize] = low;
        }
    }
    let mut number = vec![u32::MAX; vertices];
    let mut next = 0;
    let of = triangles.iter().map(|corners| {
        let own = root(&mut parent, corners[0]) as usize;
        if number[own] == u32::MAX {
            (number[own], next) = (next, next + 1);
        }
        number[own]
    });
    of.collect()
}

/// The vertex that stands for a vertex's surface; ways to it are halved as they are gone.
fn root(parent: &mut [u32], mut vertex: u32) -> u32 {
    while parent[vertex as usize] != vertex {
        let above = parent[parent[vertex as usize] as usize];
        parent[vertex as usize] = above;
        vertex = above;
    }
    vertex
}
