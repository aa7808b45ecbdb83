//! Skins: where the joints of a skeleton carry what is bound to them.

use crate::GltfError;
use crate::accessor::{Accessor, Component, Wanted};
use crate::file::File;
use crate::json::At;
use crate::nodes::Nodes;
use glam::{DAffine3, DMat4};

const MATRICES: Wanted = Wanted { kind: "MAT4", lanes: 16, of: &[Component::F32], quantised: &[] };

/// For each joint of a node's skin, the transform from where a mesh is bound to the world; `None` for a node without a skin.
pub(crate) fn joints(file: &File, nodes: &Nodes, node: &At) -> Result<Option<Vec<DAffine3>>, GltfError> {
    let Some(number) = node.index("skin", file.count("skins")?, "skins")? else { return Ok(None) };
    let skin = file.member("skins", number)?;
    let joints = skin.indices("joints", nodes.all.len(), "nodes")?;
    file.budget.charge(&skin.path, joints.len() as u64, 256)?;
    let bound = Accessor::of(file, &skin, "inverseBindMatrices", &MATRICES)?;
    if let Some(few) = bound.as_ref().filter(|bound| bound.count < joints.len()) {
        let value = format!("{} has {} elements", few.path, few.count);
        return Err(GltfError::field(
            skin.path_of("inverseBindMatrices"),
            value,
            format!("one for each of {} joints", joints.len()),
        ));
    }
    let carry = |(at, joint): (usize, usize)| {
        let bind = bound
            .as_ref()
            .map_or(DAffine3::IDENTITY, |bound| DAffine3::from_mat4(DMat4::from_cols_array(&bound.get(at))));
        nodes.all[joint].world * bind
    };
    Ok(Some(joints.into_iter().enumerate().map(carry).collect()))
}
