use crate::build::{Build, TRIANGLE, mesh, notes};
use glam::{DVec2, Vec2, Vec3};
use serde_json::{Value, json};

/// A red texel that is there, a green one that is half there, a blue one that is not, a white one.
const TEXELS: [[u8; 4]; 4] = [[255, 0, 0, 255], [0, 255, 0, 128], [0, 0, 255, 0], [255; 4]];

/// An image of two by two texels.
fn png() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().and_then(|mut writer| writer.write_image_data(&TEXELS.concat())).unwrap();
    bytes
}

const JPEG: &[u8] = include_bytes!("images/colours.jpg");

/// A triangle with texture coordinates and a material.
pub(crate) fn textured(image: &[u8], material: Value) -> Build {
    let mut build = Build::new();
    let positions = build.floats(&TRIANGLE);
    let places: [[f32; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let bytes: Vec<u8> = places.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
    let uvs = build.accessor(&bytes, 5126, "VEC2", 3);
    let attributes = json!({"POSITION": positions, "TEXCOORD_0": uvs, "TEXCOORD_3": uvs});
    build.mesh(json!({"attributes": attributes, "material": 0}));
    build.node(json!({"mesh": 0}));
    let view = build.view(image);
    build.push("images", json!({"bufferView": view, "mimeType": "image/png"}));
    build.push("textures", json!({"source": 0}));
    build.push("materials", material);
    build
}

fn masked(texture: &Value, alpha: f32) -> Value {
    let base = json!({"baseColorTexture": texture, "baseColorFactor": [0.5, 1.0, 1.0, alpha]});
    json!({"alphaMode": "MASK", "alphaCutoff": 0.25, "pbrMetallicRoughness": base})
}

#[test]
fn a_mask_cuts_holes_where_the_image_is_transparent() {
    for alpha in [1.0, 0.4] {
        let import = textured(&png(), masked(&json!({"index": 0}), alpha)).read().unwrap();
        let object = &import.scene.objects[0];
        assert_eq!(object.material.diffuse, Vec3::new(0.5, 1.0, 1.0));
        assert_eq!(mesh(&import, 0).uvs, [Vec2::ZERO, Vec2::X, Vec2::Y]);
        mesh(&import, 0).check().unwrap();
        let there = |x: f64, y: f64| object.cover.is_there(DVec2::new(x, y));
        // Half there is enough for a whole factor, and not for a small one.
        assert_eq!(
            [there(0.25, 0.25), there(0.75, 0.25), there(0.25, 0.75), there(0.75, 0.75)],
            [true, alpha == 1.0, false, true]
        );
        assert_eq!(object.cover.colour(DVec2::new(0.25, 0.25)), Vec3::X);
        assert!(notes(&import).iter().all(|note| !note.contains("baseColorTexture")));
    }
}

#[test]
fn colours_alone_cut_no_holes() {
    for (image, mode) in [(png(), "OPAQUE"), (JPEG.to_vec(), "BLEND"), (JPEG.to_vec(), "OPAQUE")] {
        let material = json!({"alphaMode": mode, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}});
        let import = textured(&image, material).read().unwrap();
        let cover = &import.scene.objects[0].cover;
        assert!(cover.texture.is_some() && cover.cutoff.is_none() && !cover.blends, "{mode}");
    }
}

#[test]
fn blended_textures_let_light_pass_by_their_alpha_and_the_factor_s() {
    let base = json!({"baseColorTexture": {"index": 0}, "baseColorFactor": [1.0, 1.0, 1.0, 0.5]});
    let material = json!({"alphaMode": "BLEND", "pbrMetallicRoughness": base});
    let mut build = textured(&png(), material);
    let import = build.read().unwrap();
    let object = &import.scene.objects[0];
    let passes = |x: f64, y: f64| object.cover.passes(object.passes, DVec2::new(x, y)).x;
    let texels = [passes(0.25, 0.25), passes(0.75, 0.25), passes(0.25, 0.75)];
    assert_eq!(texels, [0.5, 1.0 - 0.5 * 128.0 / 255.0, 1.0]);
    let there = [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75)].map(|(x, y)| object.cover.is_there(DVec2::new(x, y)));
    assert_eq!(there, [true, true, false], "what is quite clear is not there");
    build.document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][3] = 0.0.into();
    assert!(build.read().unwrap().scene.objects.is_empty());
    // Without its texture it is as its factor says.
    let mut build = textured(
        b"no image",
        json!({"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}),
    );
    let import = build.read().unwrap();
    assert_eq!((import.scene.objects[0].passes, import.scene.objects[0].cover.blends), (Vec3::ZERO, false));
    let said = "baseColorTexture is not shown, and its alpha counts as 1: images[0]";
    assert!(notes(&import).iter().any(|note| note.contains(said)), "{:?}", notes(&import));
    build.document["materials"][0]["alphaMode"] = "OPAQUE".into();
    assert!(notes(&build.read().unwrap()).iter().any(|note| note.contains("baseColorTexture is not shown: ")));
}

#[test]
fn textures_lie_as_their_transform_says() {
    let transform =
        json!({"offset": [0.5, 0.0], "rotation": std::f64::consts::FRAC_PI_2, "scale": [2.0, 3.0], "texCoord": 3});
    let texture = json!({"index": 0, "texCoord": 7, "extensions": {"KHR_texture_transform": transform}});
    let mut build = textured(&png(), masked(&texture, 1.0));
    build.document["extensionsRequired"] = json!(["KHR_texture_transform"]);
    let import = build.read().unwrap();
    let expected = [Vec2::new(0.5, 0.0), Vec2::new(0.5, -2.0), Vec2::new(3.5, 0.0)];
    for (found, expected) in mesh(&import, 0).uvs.iter().zip(expected) {
        assert!((*found - expected).length() < 1e-6, "{found} is not {expected}");
    }
}

#[test]
fn samplers_say_what_is_beyond_and_between() {
    let mut build = textured(&png(), masked(&json!({"index": 0}), 1.0));
    build.document["textures"][0]["sampler"] = json!(0);
    build.push("samplers", json!({"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}));
    let import = build.read().unwrap();
    let colour = |x: f64, y: f64| import.scene.objects[0].cover.colour(DVec2::new(x, y));
    assert_eq!([colour(-3.0, 0.49), colour(0.49, 0.49), colour(9.0, 0.01)], [Vec3::X, Vec3::X, Vec3::Y]);
    assert_eq!([colour(0.1, 1.2), colour(0.1, 1.8), colour(0.1, -0.2)], [Vec3::Z, Vec3::X, Vec3::X]);
    build.document["samplers"][0]["wrapS"] = json!(5);
    assert_eq!(build.refused(), "samplers[0].wrapS: 5, expected 10497, 33071 or 33648");
}

#[test]
fn an_image_that_cannot_be_read_is_noted_unless_it_cuts_holes() {
    let good = png();
    let opaque = json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}});
    for broken in [&good[..40], b"no image".as_slice(), &[]] {
        let import = textured(broken, opaque.clone()).read().unwrap();
        assert!(
            notes(&import)[0].starts_with("materials[0].pbrMetallicRoughness.baseColorTexture is not shown: images[0]")
        );
        let line = textured(broken, masked(&json!({"index": 0}), 1.0)).refused();
        assert!(line.starts_with("images[0]: ") && !line.contains('\n'), "{line}");
    }
    // A header that promises 65535 by 65535 texels gets no memory.
    let mut giant = good;
    giant[16..24].copy_from_slice(&[0, 0, 0xff, 0xff, 0, 0, 0xff, 0xff]);
    let line = textured(&giant, masked(&json!({"index": 0}), 1.0)).refused();
    assert!(line.starts_with("images[0]: "), "{line}");
    let mut build = textured(&giant, masked(&json!({"index": 0}), 1.0));
    build.document["images"][0] = json!({"uri": "../secret.png"});
    assert!(build.refused().starts_with("images[0].uri: "), "{}", build.refused());
}

#[test]
fn damaged_images_are_borne() {
    let good = png();
    let jpeg = JPEG.to_vec();
    let mut state = 7u64;
    let mut below = |end: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % end
    };
    for _ in 0..2000 {
        for image in [&good, &jpeg] {
            let mut damaged = image.clone();
            for _ in 0..=below(4) {
                let at = below(damaged.len());
                damaged[at] = below(256) as u8;
            }
            if let Err(fault) = textured(&damaged, masked(&json!({"index": 0}), 1.0)).read() {
                assert!(!fault.to_string().contains('\n'), "{fault}");
            }
        }
    }
}
