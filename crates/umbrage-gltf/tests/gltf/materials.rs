//! Materials.

use crate::build::{notes, triangle};
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
