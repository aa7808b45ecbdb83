//! The hierarchy of nodes: who is whose parent, and where each stands in the world.

use crate::GltfError;
use crate::animation::Pose;
use crate::file::File;
use crate::json::At;
use crate::note::Level;
use glam::{DAffine3, DMat4, DQuat, DVec3};
use std::collections::BTreeMap;

/// A node of the scene or beside it.
#[derive(Clone, Debug)]
pub(crate) struct Node<'a> {
    /// What the file says of it.
    pub at: At<'a>,
    /// Its own space to the world.
    pub world: DAffine3,
}

/// All nodes, by number.
#[derive(Clone, Debug)]
pub(crate) struct Nodes<'a> {
    pub all: Vec<Node<'a>>,
    /// Those that the scene shows, parents before their children and siblings in the file's order.
    pub shown: Vec<usize>,
}

impl<'a> Nodes<'a> {
    /// Places every node, posed.
    pub fn open(file: &File<'a>, poses: &BTreeMap<usize, Pose>) -> Result<Self, GltfError> {
        let nodes = file.all("nodes")?;
        let children = nodes.iter().map(|node| node.indices("children", nodes.len(), "nodes"));
        let children = children.collect::<Result<Vec<_>, _>>()?;
        let mut has_parent = vec![false; nodes.len()];
        for (node, own) in nodes.iter().zip(&children) {
            for (at, &child) in own.iter().enumerate() {
                let Some(known) = has_parent.get_mut(child) else { continue };
                if std::mem::replace(known, true) {
                    let field = format!("{}[{at}]", node.path_of("children"));
                    return Err(GltfError::field(field, child, "a node without another parent"));
                }
            }
        }
        let mut world = vec![None; nodes.len()];
        let roots = (0..nodes.len()).filter(|&node| !has_parent[node]);
        let mut open: Vec<(usize, DAffine3)> = roots.map(|node| (node, DAffine3::IDENTITY)).collect();
        while let Some((node, parent)) = open.pop() {
            let own = parent * local(&nodes[node], poses.get(&node))?;
            world[node] = Some(own);
            open.extend(children[node].iter().map(|&child| (child, own)));
        }
        let mut all = Vec::with_capacity(nodes.len());
        for (at, world) in nodes.into_iter().zip(world) {
            // Each node has one parent at most: those that no root leads to stand in circles.
            let world = world.ok_or_else(|| GltfError::field(&at.path, "its own ancestor", "a tree of nodes"))?;
            all.push(Node { at, world });
        }
        let shown = shown(file, &all, &children, &has_parent)?;
        Ok(Self { all, shown })
    }
}

/// The nodes of the scene that the file shows: its default scene, else the first one, else all that it has.
fn shown(file: &File, nodes: &[Node], children: &[Vec<usize>], has_parent: &[bool]) -> Result<Vec<usize>, GltfError> {
    let scenes = file.count("scenes")?;
    let number = file.root.index("scene", scenes, "scenes")?.unwrap_or(0);
    let mut open = if scenes == 0 {
        (0..nodes.len()).filter(|&node| !has_parent[node]).collect()
    } else {
        if scenes > 1 {
            file.note(Level::Verbose, format!("of {scenes} scenes only scenes[{number}] is shown"));
        }
        file.member("scenes", number)?.indices("nodes", nodes.len(), "nodes")?
    };
    open.reverse();
    let mut seen = vec![false; nodes.len()];
    let mut shown = Vec::new();
    while let Some(node) = open.pop() {
        // A scene may name a node twice, or below another.
        if !std::mem::replace(&mut seen[node], true) {
            shown.push(node);
            open.extend(children[node].iter().rev());
        }
    }
    Ok(shown)
}

fn local(at: &At, pose: Option<&Pose>) -> Result<DAffine3, GltfError> {
    let posed = pose.filter(|pose| pose.translation.is_some() || pose.rotation.is_some() || pose.scale.is_some());
    let (mut scale, mut rotation, mut translation) = (DVec3::ONE, DQuat::IDENTITY, DVec3::ZERO);
    if let Some(numbers) = at.numbers::<16>("matrix")? {
        let matrix = DMat4::from_cols_array(&numbers);
        if !matrix.row(3).abs_diff_eq(glam::DVec4::W, 1e-6) {
            let value = format!("a fourth row of {:?}", matrix.row(3).to_array());
            return Err(GltfError::field(at.path_of("matrix"), value, "0, 0, 0, 1"));
        }
        let affine = DAffine3::from_mat4(matrix);
        if posed.is_none() {
            return Ok(affine);
        }
        (scale, rotation, translation) = affine.to_scale_rotation_translation();
    } else {
        if let Some(numbers) = at.numbers("scale")? {
            scale = DVec3::from_array(numbers);
        }
        if let Some(numbers) = at.numbers("translation")? {
            translation = DVec3::from_array(numbers);
        }
        if let Some(numbers) = at.numbers("rotation")? {
            rotation =
                turned(DQuat::from_array(numbers)).ok_or_else(|| at.wrong("rotation", "a quaternion that is not 0"))?;
        }
    }
    let pose = posed.cloned().unwrap_or_default();
    let rotation = pose.rotation.unwrap_or(rotation);
    let rotation = turned(rotation).ok_or_else(|| GltfError::field(&at.path, rotation, "a rotation"))?;
    Ok(DAffine3::from_scale_rotation_translation(
        pose.scale.unwrap_or(scale),
        rotation,
        pose.translation.unwrap_or(translation),
    ))
}

/// A quaternion of unit length, unless it has none.
fn turned(rotation: DQuat) -> Option<DQuat> {
    // Scaled first, so that squares of very large or small numbers do not leave the range.
    let most = rotation.to_array().into_iter().fold(0.0, |most: f64, lane| most.max(lane.abs()));
    let unit = (rotation * (1.0 / most)).normalize();
    unit.is_finite().then_some(unit)
}
