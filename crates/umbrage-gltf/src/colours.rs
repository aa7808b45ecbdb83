//! Colours of vertices: what multiplies the base colour between them.

use crate::GltfError;
use crate::accessor::{Accessor, Component, Wanted};
use crate::file::File;
use crate::json::At;
use crate::note::Level;
use glam::Vec3;

const RGB: Wanted =
    Wanted { kind: "VEC3", lanes: 3, of: &[Component::F32, Component::U8, Component::U16], quantised: &[] };
const RGBA: Wanted = Wanted { kind: "VEC4", lanes: 4, ..RGB };

/// The colours of some vertices of a primitive, linear RGB within 0..=1; empty where it has none, and where they cannot be read, which is noted:
/// shadows are right without them. `of_alpha` says whether alpha would make a difference to the surface.
pub(crate) fn colours(
    file: &File,
    attributes: &At,
    ids: &[u32],
    count: usize,
    of_alpha: bool,
) -> Result<Vec<Vec3>, GltfError> {
    let path = attributes.path_of("COLOR_0");
    let read = || {
        let Some(number) = attributes.index("COLOR_0", file.count("accessors")?, "accessors")? else { return Ok(None) };
        let without_alpha = file.member("accessors", number)?.text("type")? == Some("VEC3");
        let wanted = if without_alpha { &RGB } else { &RGBA };
        let found = Accessor::of(file, attributes, "COLOR_0", wanted)?;
        found.map(|found| found.counting(count, &path, "one per position")).transpose()
    };
    let found = match read() {
        Ok(Some(found)) => found,
        Ok(None) => return Ok(Vec::new()),
        Err(fault @ GltfError::Budget { .. }) => return Err(fault),
        Err(fault) => {
            file.note(Level::Always, format!("{path} is not shown: {fault}"));
            return Ok(Vec::new());
        }
    };
    file.budget.charge(&path, ids.len() as u64, size_of::<Vec3>() as u64)?;
    if of_alpha && found.lanes() == 4 && ids.iter().any(|&id| found.lane(id as usize, 3) < 1.0) {
        file.note(Level::Always, format!("the alpha of {path} is not used"));
    }
    // `max` turns NaN into 0.
    let colour = |id: &u32| Vec3::from_array(found.get(*id as usize).map(|lane| lane.clamp(0.0, 1.0).max(0.0) as f32));
    Ok(ids.iter().map(colour).collect())
}
