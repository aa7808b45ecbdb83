//! The things of a scene: meshes where nodes put them.

use crate::GltfError;
use crate::accessor::{Accessor, Component, Wanted};
use crate::animation::Pose;
use crate::file::File;
use crate::json::At;
use crate::nodes::Nodes;
use crate::note::Level;
use crate::placed::{Carrier, placed};
use crate::primitive::Primitive;
use crate::skin::joints;
use glam::{DAffine3, DQuat, DVec3};
use std::collections::BTreeMap;
use umbrage_scene::{Mesh, Object, Shape};

/// A mesh as the file has it.
struct Parts<'a> {
    primitives: Vec<Primitive<'a>>,
    weights: Vec<f64>,
    /// Whether its triangles, of all primitives, bound a solid.
    closed: bool,
}

/// A node that shows a mesh.
struct Stand<'a> {
    node: At<'a>,
    mesh: usize,
    weights: Option<Vec<f64>>,
    joints: Option<Vec<DAffine3>>,
    /// One for each copy; one for a mesh without copies.
    places: Vec<DAffine3>,
}

const FLOAT: &[Component] = &[Component::F32];
const VECTORS: Wanted = Wanted { kind: "VEC3", lanes: 3, of: FLOAT, quantised: &[] };
const ROTATIONS: Wanted =
    Wanted { kind: "VEC4", lanes: 4, of: &[Component::F32, Component::I8, Component::I16], quantised: &[] };

/// The objects that the scene shows, about an origin that is given too.
pub(crate) fn objects<'a>(
    file: &'a File<'a>,
    nodes: &Nodes<'a>,
    poses: &BTreeMap<usize, Pose>,
) -> Result<(DVec3, Vec<Object>), GltfError> {
    let mut meshes: BTreeMap<usize, Parts> = BTreeMap::new();
    let mut stands = Vec::new();
    let count = file.count("meshes")?;
    for &number in &nodes.shown {
        let node = &nodes.all[number];
        let Some(mesh) = node.at.index("mesh", count, "meshes")? else { continue };
        if let std::collections::btree_map::Entry::Vacant(vacant) = meshes.entry(mesh) {
            vacant.insert(parts(file, mesh)?);
        }
        let joints = joints(file, nodes, &node.at)?;
        let places = places(file, &node.at, node.world, joints.is_some())?;
        let weights = poses.get(&number).and_then(|pose| pose.weights.clone());
        let weights = match weights {
            Some(weights) => Some(weights),
            None => weights_of(file, &node.at)?,
        };
        stands.push(Stand { node: node.at.clone(), mesh, weights, joints, places });
    }
    let origin = origin(bounds(file, &meshes, &stands)?);
    let mut objects = Vec::new();
    for stand in &stands {
        if let Some(parts) = meshes.get(&stand.mesh) {
            add(file, stand, parts, origin, &mut objects)?;
        }
    }
    Ok((origin, objects))
}

fn parts<'a>(file: &'a File<'a>, number: usize) -> Result<Parts<'a>, GltfError> {
    let mesh = file.member("meshes", number)?;
    let mut primitives = Vec::new();
    for primitive in mesh.items("primitives")? {
        primitives.extend(Primitive::open(file, &primitive)?);
    }
    let mut all = Mesh::default();
    for primitive in &primitives {
        let first = all.positions.len() as u32;
        all.positions.extend(primitive.positions.iter().map(|at| at.as_vec3()));
        all.triangles.extend(primitive.triangles.iter().map(|corners| corners.map(|vertex| vertex + first)));
    }
    let closed = !all.triangles.is_empty() && all.is_closed();
    Ok(Parts { primitives, weights: weights_of(file, &mesh)?.unwrap_or_default(), closed })
}

fn weights_of(file: &File, at: &At) -> Result<Option<Vec<f64>>, GltfError> {
    if at.get("weights").is_none() {
        return Ok(None);
    }
    let weights = at.list("weights")?;
    file.budget.charge(&at.path, weights.len() as u64, 8)?;
    let numbers = weights.iter().map(|weight| weight.as_f64().ok_or_else(|| at.wrong("weights", "numbers")));
    numbers.collect::<Result<_, _>>().map(Some)
}

/// Where the copies of a node's mesh stand: one of its own, or those of EXT_mesh_gpu_instancing.
fn places(file: &File, node: &At, world: DAffine3, skinned: bool) -> Result<Vec<DAffine3>, GltfError> {
    let Some(copies) = node.extension("EXT_mesh_gpu_instancing") else { return Ok(vec![world]) };
    if skinned {
        file.note(Level::Always, format!("{} is ignored: the node's skin says where its mesh stands", copies.path));
        return Ok(vec![world]);
    }
    let attributes = copies.get("attributes").ok_or_else(|| copies.wrong("attributes", "an object"))?;
    let [translations, rotations, scales] = [("TRANSLATION", &VECTORS), ("ROTATION", &ROTATIONS), ("SCALE", &VECTORS)]
        .map(|(name, wanted)| {
            Accessor::of(file, &attributes, name, wanted).map(|found| found.map(|found| (name, found)))
        });
    let given: Vec<_> = [translations?, rotations?, scales?].into_iter().flatten().collect();
    let Some(count) = given.first().map(|(_, first)| first.count) else {
        return Err(GltfError::field(attributes.path, "nothing", "TRANSLATION, ROTATION or SCALE"));
    };
    file.budget.charge(&attributes.path, count as u64, 128)?;
    let mut found = Vec::with_capacity(given.len());
    for (name, accessor) in given {
        found.push((name, accessor.counting(count, &attributes.path_of(name), "one per copy")?));
    }
    let of = |name: &str| found.iter().find(|(known, _)| *known == name).map(|(_, accessor)| accessor);
    let place = |copy: usize| {
        let vector = |name: &str, default| of(name).map_or(default, |all| DVec3::from_array(all.get(copy)));
        let rotation = of("ROTATION").map_or(DQuat::IDENTITY, |all| DQuat::from_array(all.get(copy)).normalize());
        let (scale, translation) = (vector("SCALE", DVec3::ONE), vector("TRANSLATION", DVec3::ZERO));
        let own = DAffine3::from_scale_rotation_translation(scale, rotation, translation);
        if own.is_finite() {
            return Ok(world * own);
        }
        let [scale, translation] = [scale, translation].map(|vector| vector.to_array());
        let rotation = rotation.to_array();
        let value = format!("copy {copy} of scale {scale:?}, rotation {rotation:?} and translation {translation:?}");
        Err(GltfError::field(&attributes.path, value, "finite numbers, and a rotation that is not 0"))
    };
    (0..count).map(place).collect()
}

/// A box around all that stands in the scene, roughly: morph targets are left out, and joints carry whole boxes.
fn bounds(file: &File, meshes: &BTreeMap<usize, Parts>, stands: &[Stand]) -> Result<[DVec3; 2], GltfError> {
    let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let boxes: BTreeMap<usize, Vec<[DVec3; 2]>> = meshes
        .iter()
        .map(|(number, parts)| (*number, parts.primitives.iter().map(Primitive::bounds).collect()))
        .collect();
    for stand in stands {
        let own = boxes.get(&stand.mesh).map_or(&[][..], Vec::as_slice);
        let carriers = stand.joints.as_ref().unwrap_or(&stand.places);
        file.budget.charge(&stand.node.path, (own.len() as u64).saturating_mul(carriers.len() as u64), 64)?;
        for [low, high] in own {
            for carrier in carriers {
                for corner in 0..8 {
                    let side = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
                    let at = carrier.transform_point3(DVec3::new(side(0), side(1), side(2)));
                    bounds = [bounds[0].min(at), bounds[1].max(at)];
                }
            }
        }
    }
    Ok(bounds)
}

/// The place that positions are kept relative to: 0, unless the scene is far from it for its size. It is rounded, so that positions
/// of few digits keep few digits.
fn origin([low, high]: [DVec3; 2]) -> DVec3 {
    /// How many times its own diagonal a scene stands away before floats of its positions lose too much.
    const FAR: f64 = 16.0;
    let (middle, diagonal) = ((low + high) * 0.5, (high - low).length());
    let grid = diagonal.log2().floor().exp2();
    let origin = (middle / grid).round() * grid;
    let far = middle.abs().max_element() > FAR * diagonal;
    if far && diagonal > 0.0 && origin.is_finite() { origin } else { DVec3::ZERO }
}

fn add(file: &File, stand: &Stand, parts: &Parts, origin: DVec3, objects: &mut Vec<Object>) -> Result<(), GltfError> {
    let extras = stand.node.get("extras").filter(|extras| extras.value.is_object());
    let flag = |name: &str| extras.as_ref().map_or(Ok(true), |extras| extras.flag(name, true));
    let (casts, receives) = (flag("casts")?, flag("receives")?);
    let weights = stand.weights.as_ref().unwrap_or(&parts.weights);
    let name = stand.node.name().or_else(|| file.member("meshes", stand.mesh).ok()?.name());
    let name = name.map_or_else(|| format!("mesh{}", stand.mesh), str::to_owned);
    // A mesh with a name of its own may stand in a great many places.
    let name: String = name.chars().take(200).collect();
    let carriers = match &stand.joints {
        Some(joints) => vec![Carrier::Joints(joints)],
        None => stand.places.iter().copied().map(Carrier::Rigid).collect(),
    };
    let several = carriers.len() * parts.primitives.len() > 1;
    for carrier in carriers {
        // What is squeezed flat has no inside.
        let flat = matches!(carrier, Carrier::Rigid(place) if place.matrix3.determinant() == 0.0);
        for primitive in &parts.primitives {
            let mesh = placed(file, primitive, weights, carrier, origin)?;
            let name = if several { format!("{name}.{}", objects.len()) } else { name.clone() };
            objects.push(Object {
                name,
                shape: Shape::Mesh(mesh),
                material: primitive.surface.material,
                casts,
                receives,
                solid: parts.closed && !flat,
                passes: primitive.surface.passes,
                cover: primitive.cover(),
            });
        }
    }
    Ok(())
}
