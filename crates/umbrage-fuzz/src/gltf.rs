//! Scenes in glTF.

use crate::promises::{assert_line, most_bytes};
use umbrage_gltf::{ReadOptions, decode};
use umbrage_scene::Shape;

/// Takes bytes as a glTF scene without other files, some time into its animation. Whether they are one.
///
/// # Panics
/// When a refusal is not one line, or a scene has parts that do not belong together.
pub fn gltf(file: &[u8]) -> bool {
    let options = ReadOptions::default().with_max_bytes(most_bytes(file)).with_time(Some(0.4));
    match decode(file, None, "mutant", &options) {
        Err(error) => {
            assert_line(error);
            false
        }
        Ok(import) => {
            for object in &import.scene.objects {
                let Shape::Mesh(mesh) = &object.shape else { panic!("no patches are read") };
                mesh.check().expect("a mesh that holds together");
            }
            assert_eq!(import.lamps.len(), import.scene.lights.len());
            true
        }
    }
}
