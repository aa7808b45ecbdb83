use glam::{Vec2, Vec3};
use std::collections::HashMap;

/// Triangles with shading normals. Vertices on a crease are doubled with equal positions.
///
/// Constructors: [`Mesh::sphere`], [`Mesh::cuboid`], [`Mesh::cylinder`], [`Mesh::torus`], [`Mesh::knot`],
/// [`Mesh::lathe`] and [`Mesh::tube`] are closed, [`Mesh::sheet`] is open.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// World-space positions.
    pub positions: Vec<Vec3>,
    /// Unit shading normals, one a position.
    pub normals: Vec<Vec3>,
    /// Indices into the above, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// One a triangle: the smooth piece of surface it belongs to (a box has six, a sphere one).
    pub surfaces: Vec<u32>,
    /// Where each position lies in a [`Texture`](crate::Texture), one a position: (0, 0) is the image's upper left corner, (1, 1)
    /// its lower right one. May be empty: then every position lies at (0, 0).
    pub uvs: Vec<Vec2>,
    /// What multiplies the diffuse colour at each position, linear RGB, one a position. May be empty: then all are white.
    pub colours: Vec<Vec3>,
}

/// Why a mesh cannot be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// Not one normal a position.
    #[error("mesh has {positions} positions but {normals} normals")]
    Normals {
        /// Number of positions.
        positions: usize,
        /// Number of normals.
        normals: usize,
    },
    /// Not one surface a triangle.
    #[error("mesh has {triangles} triangles but {surfaces} surface ids")]
    Surfaces {
        /// Number of triangles.
        triangles: usize,
        /// Number of surface ids.
        surfaces: usize,
    },
    /// Texture coordinates, but not one a position.
    #[error("mesh has {positions} positions but {uvs} texture coordinates")]
    Uvs {
        /// Number of positions.
        positions: usize,
        /// Number of texture coordinates.
        uvs: usize,
    },
    /// Colours, but not one a position.
    #[error("mesh has {positions} positions but {colours} colours")]
    Colours {
        /// Number of positions.
        positions: usize,
        /// Number of colours.
        colours: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("mesh triangle {triangle} names vertex {vertex} of {vertices}")]
    Index {
        /// The triangle.
        triangle: usize,
        /// What it names.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A coordinate of a position or a normal, or in the texture, or a channel of a colour, is NaN or infinite.
    #[error("mesh vertex {vertex} has a coordinate or a colour that is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
}

impl Mesh {
    /// Nothing wrong with lengths, indices and numbers. Normals are not required to be of unit length here.
    ///
    /// # Errors
    /// The first fault found; see [`MeshError`].
    pub fn check(&self) -> Result<(), MeshError> {
        let vertices = self.positions.len();
        if self.normals.len() != vertices {
            return Err(MeshError::Normals { positions: vertices, normals: self.normals.len() });
        }
        if self.surfaces.len() != self.triangles.len() {
            return Err(MeshError::Surfaces { triangles: self.triangles.len(), surfaces: self.surfaces.len() });
        }
        if !self.uvs.is_empty() && self.uvs.len() != vertices {
            return Err(MeshError::Uvs { positions: vertices, uvs: self.uvs.len() });
        }
        if !self.colours.is_empty() && self.colours.len() != vertices {
            return Err(MeshError::Colours { positions: vertices, colours: self.colours.len() });
        }
        for (triangle, corners) in self.triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&vertex| vertex as usize >= vertices) {
                return Err(MeshError::Index { triangle, vertex, vertices });
            }
        }
        let finite = |vertex: &usize| {
            let in_texture = self.uvs.get(*vertex).is_none_or(|uv| uv.is_finite());
            let coloured = self.colours.get(*vertex).is_none_or(|colour| colour.is_finite());
            self.positions[*vertex].is_finite() && self.normals[*vertex].is_finite() && in_texture && coloured
        };
        match (0..vertices).find(|vertex| !finite(vertex)) {
            Some(vertex) => Err(MeshError::NotFinite { vertex }),
            None => Ok(()),
        }
    }

    /// Least and greatest corner of the box around all positions, both inclusive; `None` without a position.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let first = *self.positions.first()?;
        Some(self.positions.iter().fold((first, first), |(low, high), at| (low.min(*at), high.max(*at))))
    }

    /// The three corners of a triangle, in world space.
    ///
    /// # Panics
    /// When the triangle, or a vertex that it names, does not exist.
    pub fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|vertex| self.positions[vertex as usize])
    }

    /// Where the three corners of a triangle lie in a texture: all at (0, 0) without [`Mesh::uvs`].
    ///
    /// # Panics
    /// When the triangle does not exist, or a vertex that it names has no place in the texture while others have.
    pub fn corner_uvs(&self, triangle: usize) -> [Vec2; 3] {
        let uv = |vertex: u32| if self.uvs.is_empty() { Vec2::ZERO } else { self.uvs[vertex as usize] };
        self.triangles[triangle].map(uv)
    }

    /// The colours of the three corners of a triangle: all white without [`Mesh::colours`].
    ///
    /// # Panics
    /// When the triangle does not exist, or a vertex that it names has no colour while others have.
    pub fn corner_colours(&self, triangle: usize) -> [Vec3; 3] {
        let colour = |vertex: u32| if self.colours.is_empty() { Vec3::ONE } else { self.colours[vertex as usize] };
        self.triangles[triangle].map(colour)
    }

    /// True when the triangles bound a solid: every edge, named by its two positions, belongs to exactly two triangles
    /// that run along it in opposite directions. A mesh without triangles is closed.
    ///
    /// # Panics
    /// When a triangle names a vertex that does not exist ([`Mesh::check`]).
    pub fn is_closed(&self) -> bool {
        self.open_edges() == 0
    }

    /// How many edges, named by position, do not belong to exactly two triangles that run along them in opposite
    /// directions.
    ///
    /// # Panics
    /// As [`Mesh::is_closed`].
    pub fn open_edges(&self) -> usize {
        let mut numbers = HashMap::with_capacity(self.positions.len());
        let mut number = |at: &Vec3| {
            let next = numbers.len() as u32;
            *numbers.entry(position_bits(*at)).or_insert(next)
        };
        let places: Vec<u32> = self.positions.iter().map(&mut number).collect();
        // Each edge as its lower place, and its higher one with the direction of the triangle. Of large meshes there are very many, so that small numbers
        // save time.
        let edges = || {
            self.triangles.iter().flat_map(|corners| {
                let [a, b, c] = corners.map(|vertex| places[vertex as usize]);
                [[a, b], [b, c], [c, a]].map(|[from, to]| {
                    if from <= to { (from as usize, (to, false)) } else { (to as usize, (from, true)) }
                })
            })
        };
        // All edges of a place stand together: sorting them by place alone needs no comparison.
        let mut begins = vec![0; numbers.len() + 1];
        edges().for_each(|(low, _)| begins[low + 1] += 1);
        (1..begins.len()).for_each(|place| begins[place] += begins[place - 1]);
        let (mut free, mut ends) = (begins.clone(), vec![(0, false); 3 * self.triangles.len()]);
        for (low, end) in edges() {
            ends[free[low]] = end;
            free[low] += 1;
        }
        let open = |of: &[usize]| {
            let around = &mut ends[of[0]..of[1]];
            around.sort_unstable();
            around.chunk_by(|a, b| a.0 == b.0).filter(|edge| !matches!(edge, [(_, false), (_, true)])).count()
        };
        begins.windows(2).map(open).sum()
    }

    /// Adds another mesh's triangles. Its surfaces are numbered after this mesh's. Where only one of the two has [`Mesh::uvs`],
    /// the other's vertices keep the place in the texture that they have without: (0, 0). So it is with [`Mesh::colours`], and white.
    ///
    /// # Panics
    /// When vertices or surfaces would pass 2³².
    pub fn append(&mut self, other: &Self) {
        let vertices = u32::try_from(self.positions.len()).expect("at most 2^32 vertices");
        let surfaces = self.surfaces.iter().max().map_or(0, |last| last + 1);
        if !(self.uvs.is_empty() && other.uvs.is_empty()) {
            self.uvs.resize(self.positions.len(), Vec2::ZERO);
            self.uvs.extend_from_slice(&other.uvs);
            self.uvs.resize(self.positions.len() + other.positions.len(), Vec2::ZERO);
        }
        if !(self.colours.is_empty() && other.colours.is_empty()) {
            self.colours.resize(self.positions.len(), Vec3::ONE);
            self.colours.extend_from_slice(&other.colours);
            self.colours.resize(self.positions.len() + other.positions.len(), Vec3::ONE);
        }
        self.positions.extend_from_slice(&other.positions);
        self.normals.extend_from_slice(&other.normals);
        self.triangles.extend(other.triangles.iter().map(|corners| corners.map(|vertex| vertex + vertices)));
        self.surfaces.extend(other.surfaces.iter().map(|surface| surface + surfaces));
    }
}

/// Bits by which two positions are the same place: −0 is 0.
pub(crate) fn position_bits(position: Vec3) -> [u32; 3] {
    (position + Vec3::ZERO).to_array().map(f32::to_bits)
}
