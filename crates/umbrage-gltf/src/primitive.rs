//! Primitives: the triangles of a mesh as the file has them, before they are posed and placed.

use crate::GltfError;
use crate::accessor::{Accessor, Component, Wanted};
use crate::budget::{TRIANGLE, VERTEX};
use crate::colours::colours;
use crate::file::File;
use crate::json::At;
use crate::material::{Surface, surface};
use crate::note::Level;
use glam::{DVec3, Vec2, Vec3};
use std::sync::Arc;
use umbrage_scene::Cover;

/// Triangles of one material, with the vertices that they name and no others.
#[derive(Clone, Debug)]
pub(crate) struct Primitive<'a> {
    pub path: String,
    /// The place of each vertex in the accessors, ascending.
    pub ids: Vec<u32>,
    pub positions: Vec<DVec3>,
    /// Where each vertex lies in the texture; empty without one.
    pub uvs: Vec<Vec2>,
    /// What multiplies each vertex's colour, linear RGB; empty without COLOR_0.
    pub colours: Vec<Vec3>,
    /// Normals by place in the accessor; without them triangles are flat.
    pub normals: Option<Accessor<'a>>,
    pub triangles: Vec<[u32; 3]>,
    pub targets: Vec<Target<'a>>,
    /// Joints and weights, in sets of four.
    pub joints: Vec<[Accessor<'a>; 2]>,
    pub surface: Surface,
}

/// A morph target: what it adds to positions and normals.
#[derive(Clone, Debug)]
pub(crate) struct Target<'a> {
    pub positions: Option<Accessor<'a>>,
    pub normals: Option<Accessor<'a>>,
}

const INTEGERS: &[Component] = &[Component::I8, Component::U8, Component::I16, Component::U16];
const FLOAT: &[Component] = &[Component::F32];
const POSITIONS: Wanted = Wanted { kind: "VEC3", lanes: 3, of: FLOAT, quantised: INTEGERS };
const NORMALS: Wanted = Wanted { quantised: &[Component::I8, Component::I16], ..POSITIONS };
const INDICES: Wanted =
    Wanted { kind: "SCALAR", lanes: 1, of: &[Component::U8, Component::U16, Component::U32], quantised: &[] };
const JOINTS: Wanted = Wanted { kind: "VEC4", lanes: 4, of: &[Component::U8, Component::U16], quantised: &[] };
const WEIGHTS: Wanted = Wanted { of: &[Component::F32, Component::U8, Component::U16], ..JOINTS };

impl<'a> Primitive<'a> {
    /// Reads a primitive; `None` for one that has no triangles to show.
    pub fn open(file: &'a File, at: &At) -> Result<Option<Self>, GltfError> {
        let skipped = |why: &str| {
            file.note(Level::Always, format!("{} is skipped: {why}", at.path));
            Ok(None)
        };
        let order = match at.whole("mode")?.unwrap_or(4) {
            0 => return skipped("it has points, not triangles"),
            1..=3 => return skipped("it has lines, not triangles"),
            4 => Order::List,
            5 => Order::Strip,
            6 => Order::Fan,
            _ => return Err(at.wrong("mode", "a number from 0 to 6")),
        };
        let attributes = at.get("attributes").ok_or_else(|| at.wrong("attributes", "an object"))?;
        let Some(found) = Accessor::of(file, &attributes, "POSITION", &POSITIONS)? else {
            return skipped("it has no POSITION");
        };
        if let Some(compressed) = at.extension("KHR_draco_mesh_compression").filter(|_| found.is_empty()) {
            return Err(GltfError::field(compressed.path, "no positions but compressed ones", "positions in a buffer"));
        }
        let surface = surface(file, at)?;
        if surface.absent {
            file.note(Level::Verbose, format!("{} is left out: its alpha is 0, or below its cutoff", at.path));
            return Ok(None);
        }
        let Vertices { ids, positions, triangles } = vertices(file, at, &found, order)?;
        if triangles.is_empty() {
            return skipped("no triangle of it can be shown");
        }
        let same = |accessor: Accessor<'a>, path: &str| accessor.counting(found.count, path, "one per position");
        let attribute = |holder: &At, name: &str, wanted: &Wanted| {
            let accessor = Accessor::of(file, holder, name, wanted)?;
            accessor.map(|accessor| same(accessor, &holder.path_of(name))).transpose()
        };
        let mut targets = Vec::new();
        for target in at.items("targets")? {
            file.budget.charge(&target.path, 1, 512)?;
            let positions = attribute(&target, "POSITION", &POSITIONS)?;
            targets.push(Target { positions, normals: attribute(&target, "NORMAL", &NORMALS)? });
        }
        let mut joints = Vec::new();
        for set in 0_u32.. {
            let Some(of) = attribute(&attributes, &format!("JOINTS_{set}"), &JOINTS)? else { break };
            let weights = format!("WEIGHTS_{set}");
            let by = attribute(&attributes, &weights, &WEIGHTS)?;
            joints.push([of, by.ok_or_else(|| attributes.wrong(&weights, "the number of an accessor"))?]);
        }
        let normals = attribute(&attributes, "NORMAL", &NORMALS)?;
        let uvs = surface.laid.as_ref().map(|laid| laid.places(file, &attributes, &ids, found.count)).transpose()?;
        let uvs = uvs.unwrap_or_default();
        let colours = colours(file, &attributes, &ids, found.count, surface.has_alpha)?;
        let path = at.path.clone();
        Ok(Some(Self { path, ids, positions, uvs, colours, normals, triangles, targets, joints, surface }))
    }

    /// Its texture, with the holes that it makes and what its alpha lets pass.
    pub fn cover(&self) -> Cover {
        let texture = self.surface.laid.as_ref().map(|laid| Arc::clone(&laid.texture));
        Cover { texture, cutoff: self.surface.cutoff, blends: self.surface.blends }
    }

    /// The corners of the box around all vertices.
    pub fn bounds(&self) -> [DVec3; 2] {
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        self.positions.iter().fold(empty, |[low, high], at| [low.min(*at), high.max(*at)])
    }
}

/// How corners follow one another.
#[derive(Clone, Copy, Debug)]
enum Order {
    List,
    Strip,
    Fan,
}

impl Order {
    fn triangles(self, corners: usize) -> usize {
        match self {
            Self::List => corners / 3,
            Self::Strip | Self::Fan => corners.saturating_sub(2),
        }
    }

    /// The corners of a triangle. Every second triangle of a strip runs the other way.
    fn corners(self, triangle: usize) -> [usize; 3] {
        match self {
            Self::List => [3 * triangle, 3 * triangle + 1, 3 * triangle + 2],
            Self::Strip if triangle.is_multiple_of(2) => [triangle, triangle + 1, triangle + 2],
            Self::Strip => [triangle, triangle + 2, triangle + 1],
            Self::Fan => [triangle + 1, triangle + 2, 0],
        }
    }
}

struct Vertices {
    ids: Vec<u32>,
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

fn vertices(file: &File, at: &At, found: &Accessor, order: Order) -> Result<Vertices, GltfError> {
    let indices = Accessor::of(file, at, "indices", &INDICES)?;
    let corners = indices.as_ref().map_or(found.count, |indices| indices.count);
    let count = order.triangles(corners);
    if matches!(order, Order::List) && corners % 3 != 0 {
        file.note(
            Level::Always,
            format!("{} has {corners} corners: the last {} make no triangle", at.path, corners % 3),
        );
    }
    file.budget.charge(&at.path, count as u64, TRIANGLE)?;
    let mut triangles = Vec::with_capacity(count);
    for triangle in 0..count {
        let mut vertices = [0; 3];
        for (vertex, corner) in vertices.iter_mut().zip(order.corners(triangle)) {
            let named = indices.as_ref().map_or(corner, |indices| indices.lane(corner, 0) as usize);
            if named >= found.count {
                let place = format!("{named} at place {corner} of {}", indices.as_ref().map_or("", |all| &all.path));
                let expected = format!("a vertex below {}, the count of {}", found.count, found.path);
                return Err(GltfError::field(at.path_of("indices"), place, expected));
            }
            *vertex = named as u32;
        }
        triangles.push(vertices);
    }
    let mut ids = renumber(&mut triangles, found.count);
    file.budget.charge(&at.path, ids.len() as u64, VERTEX)?;
    let mut positions: Vec<DVec3> = ids.iter().map(|&id| DVec3::from_array(found.get(id as usize))).collect();
    let before = triangles.len();
    let place = |vertex: u32| positions[vertex as usize];
    triangles.retain(|corners| corners.iter().all(|&vertex| place(vertex).is_finite()));
    let broken = before - triangles.len();
    if broken > 0 {
        let text = format!("triangles of {} are skipped: a position is not a finite number", at.path);
        file.note_times(Level::Always, text, broken as u64);
    }
    let finite = triangles.len();
    // They cover nothing, and would hide that a mesh is closed; strips are full of them.
    triangles.retain(|&[a, b, c]| place(a) != place(b) && place(b) != place(c) && place(c) != place(a));
    let flat = finite - triangles.len();
    if flat > 0 {
        let text = "triangles are skipped that cover nothing: two of their corners are one place";
        file.note_times(Level::Verbose, text, flat as u64);
    }
    if broken + flat > 0 {
        let kept = renumber(&mut triangles, positions.len());
        positions = kept.iter().map(|&vertex| positions[vertex as usize]).collect();
        ids = kept.iter().map(|&vertex| ids[vertex as usize]).collect();
    }
    Ok(Vertices { ids, positions, triangles })
}

/// Numbers vertices, all below `count`, anew so that none is left out; gives the old number of each new one, ascending.
fn renumber(triangles: &mut [[u32; 3]], count: usize) -> Vec<u32> {
    let named = triangles.len().saturating_mul(3);
    if count / 4 <= named {
        let mut new = vec![0_u32; count];
        triangles.iter().flatten().for_each(|&vertex| new[vertex as usize] = 1);
        let used: Vec<u32> = (0..count as u32).filter(|&vertex| new[vertex as usize] == 1).collect();
        (0_u32..).zip(&used).for_each(|(number, &vertex)| new[vertex as usize] = number);
        triangles.iter_mut().flatten().for_each(|vertex| *vertex = new[*vertex as usize]);
        return used;
    }
    // Few triangles of a large accessor, which many primitives may share: no work for what they do not name.
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let number = |vertex: u32| used.binary_search(&vertex).map_or(0, |number| number as u32);
    triangles.iter_mut().flatten().for_each(|vertex| *vertex = number(*vertex));
    used
}
