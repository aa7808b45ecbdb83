//! Materials.

use crate::build::{Build, TRIANGLE, mesh, notes, triangle};
use glam::Vec3;
use serde_json::json;

#[test]
fn base_colour_and_alpha_become_reflectance_and_what_passes() {
    let mut build = triangle();
    build.document["meshes"][0]["primitives"][0]["material"] = 0.into();
    build.node(json!({"mesh": 0}));
    build.push("materials", json!({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 0.25]}}));
    let opaque = build.read().unwrap();
    assert_eq!(opaque.scene.objects[0].material.diffuse, Vec3::new(0.5, 0.25, 0.125));
    assert_eq!(opaque.scene.objects[0].passes, Vec3::ZERO);
    build.document["materials"][0]["alphaMode"] = "BLEND".into();
    assert_eq!(build.read().unwrap().scene.objects[0].passes, Vec3::splat(0.75));
    build.document["materials"][0]["alphaMode"] = "MASK".into();
    let absent = build.read().unwrap();
    assert!(absent.scene.objects.is_empty(), "alpha .25 is below .5");
    build.document["materials"][0]["alphaCutoff"] = 0.25.into();
    assert_eq!(build.read().unwrap().scene.objects.len(), 1, "at the cutoff it is there");
    build.document["materials"][0]["alphaMode"] = "GLASS".into();
    assert_eq!(build.refused(), "materials[0].alphaMode: \"GLASS\", expected OPAQUE, MASK or BLEND");
}

#[test]
fn extensions_are_refused_or_noted_by_name() {
    let mut build = triangle();
    build.node(json!({"mesh": 0}));
    for name in [
        "KHR_draco_mesh_compression",
        "EXT_meshopt_compression",
        "KHR_meshopt_compression",
        "KHR_texture_basisu",
        "EXT_texture_webp",
        "VENDOR_anything",
    ] {
        build.document["extensionsUsed"] = json!([name]);
        build.document["extensionsRequired"] = json!([name]);
        assert_eq!(build.refused(), format!("extensionsRequired: {name:?} is not supported"));
        build.document["extensionsRequired"] = json!([]);
        let note = format!("the extension {name:?} is not supported, and is ignored");
        assert!(notes(&build.read().unwrap()).contains(&note));
    }
}

/// A flat triangle with colours, or one with normals.
fn coloured(bytes: &[u8], code: u32, kind: &str, smooth: bool) -> Build {
    let mut build = Build::new();
    let colours = build.accessor(bytes, code, kind, 3);
    build.document["accessors"][colours]["normalized"] = (code != 5126).into();
    let positions = build.floats(&TRIANGLE);
    let mut attributes = json!({"POSITION": positions, "COLOR_0": colours});
    if smooth {
        attributes["NORMAL"] = build.floats(&[[0.0, 0.0, 1.0]; 3]).into();
    }
    build.mesh(json!({"attributes": attributes, "material": 0}));
    build.node(json!({"mesh": 0}));
    build.push("materials", json!({}));
    build
}

#[test]
fn colours_of_vertices_are_read_in_every_form() {
    let expected = [Vec3::X, Vec3::new(0.0, 1.0, 0.2), Vec3::ZERO];
    let floats: Vec<u8> =
        [1.5_f32, -1.0, 0.0, 0.0, 1.0, 0.2, f32::NAN, 0.0, 0.0].iter().flat_map(|lane| lane.to_le_bytes()).collect();
    let shorts: Vec<u8> = [65535_u16, 0, 0, 65535, 0, 65535, 13107, 65535, 0, 0, 0, 65535]
        .iter()
        .flat_map(|lane| lane.to_le_bytes())
        .collect();
    let bytes = [255, 0, 0, 255, 0, 255, 51, 255, 0, 0, 0, 128];
    for (bytes, code, kind) in [(&floats[..], 5126, "VEC3"), (&shorts, 5123, "VEC4"), (&bytes, 5121, "VEC4")] {
        for smooth in [false, true] {
            let import = coloured(bytes, code, kind, smooth).read().unwrap();
            let found = &mesh(&import, 0).colours;
            assert!(
                found.len() == 3 && found.iter().zip(expected).all(|(a, b)| a.abs_diff_eq(b, 1e-6)),
                "{kind} {found:?}"
            );
            assert!(notes(&import).iter().all(|note| !note.contains("COLOR_0")));
        }
    }
    // Alpha of colours would make a difference here, and is not used.
    let mut build = coloured(&bytes, 5121, "VEC4", true);
    build.document["materials"][0]["alphaMode"] = "BLEND".into();
    let said = "the alpha of meshes[0].primitives[0].attributes.COLOR_0 is not used".to_owned();
    assert!(notes(&build.read().unwrap()).contains(&said));
}

#[test]
fn colours_that_cannot_be_read_are_noted() {
    let mut build = coloured(&[0; 12], 5121, "VEC4", true);
    build.document["accessors"][0]["type"] = "VEC2".into();
    let import = build.read().unwrap();
    assert!(mesh(&import, 0).colours.is_empty());
    let said = "meshes[0].primitives[0].attributes.COLOR_0 is not shown: meshes[0].primitives[0].attributes.COLOR_0: \
        accessors[0] has \"VEC2\" of U8, expected VEC4 of [F32, U8, U16]";
    assert_eq!(notes(&import)[0], said);
}
