//! From bytes to a scene.

use crate::budget::Budget;
use crate::file::File;
use crate::lights::Lamp;
use crate::nodes::Nodes;
use crate::note::Level;
use crate::sight::Things;
use crate::{GltfError, Note, ReadOptions, animation, camera, container, lights, objects, uri};
use glam::Vec3;
use std::path::Path;
use umbrage_scene::Scene;

/// A scene, with what a scene does not hold.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Import {
    /// Objects, lights and camera. Ambient light and background are Umbrage's own: glTF has none.
    pub scene: Scene,
    /// One for each light of the scene, in the same order.
    pub lamps: Vec<Lamp>,
    /// What was ignored, skipped or guessed, the more important first.
    pub notes: Vec<Note>,
}

/// Reads a file: `.glb`, or `.gltf` with the files that it names beside it or below its folder.
///
/// # Errors
/// [`GltfError::In`], which names the file.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Import, GltfError> {
    let folder = path.parent().map(|folder| if folder.as_os_str().is_empty() { Path::new(".") } else { folder });
    let name = path.file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy().into_owned());
    let budget = Budget::new(options.max_bytes);
    let bytes = uri::regular("file", path, u64::MAX, &budget);
    let import = bytes.and_then(|bytes| decoded(&bytes, folder, &name, options, budget));
    import.map_err(|fault| {
        let file =
            path.to_string_lossy().chars().map(|letter| if letter.is_control() { '?' } else { letter }).collect();
        GltfError::In { file, fault: Box::new(fault) }
    })
}

/// Reads the bytes of a file. `folder` is where the files lie that it names; without one only what it holds itself is read. `name` becomes
/// the scene's.
///
/// # Errors
/// [`GltfError`], the first fault that was found.
pub fn decode(bytes: &[u8], folder: Option<&Path>, name: &str, options: &ReadOptions) -> Result<Import, GltfError> {
    decoded(bytes, folder, name, options, Budget::new(options.max_bytes))
}

fn decoded(
    bytes: &[u8],
    folder: Option<&Path>,
    name: &str,
    options: &ReadOptions,
    budget: Budget,
) -> Result<Import, GltfError> {
    let (document, bin) = container::split(bytes, &budget)?;
    let file = File::open(&document, bin, folder, budget)?;
    let poses = animation::poses(&file, options)?;
    let nodes = Nodes::open(&file, &poses)?;
    let (origin, objects) = objects::objects(&file, &nodes, &poses)?;
    if objects.is_empty() {
        file.note(Level::Always, "the scene has no triangles");
    }
    let things = Things::new(&objects, origin);
    let camera = camera::camera(&file, &nodes, &things, options)?;
    let (lights, lamps) = lights::lights(&file, &nodes, &things, options.map_size)?;
    let scene = Scene {
        name: name.to_owned(),
        origin,
        objects,
        lights,
        ambient: Vec3::splat(0.1),
        background: Vec3::splat(0.05),
        camera,
    };
    drop(nodes);
    let notes = file.finish();
    Ok(Import { scene, lamps, notes })
}
