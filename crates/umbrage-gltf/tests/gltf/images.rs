//! Every way in which PNG and JPEG files keep colours.

use crate::textures::textured;
use glam::{DVec2, Vec3};
use png::{BitDepth, ColorType, Encoder};
use serde_json::json;

const JPEGS: [(&str, &[u8]); 3] = [
    ("colours", include_bytes!("images/colours.jpg")),
    ("progressive", include_bytes!("images/progressive.jpg")),
    ("grey", include_bytes!("images/grey.jpg")),
];

/// The quarters of the images: upper left, upper right, lower left, lower right, as they are coded.
const QUARTERS: [[u8; 3]; 4] = [[200, 30, 30], [30, 200, 30], [30, 30, 200], [220, 220, 220]];

/// What the middles of the quarters of an image show, linear, and how much of them is there.
fn seen(image: &[u8]) -> [(Vec3, bool); 4] {
    let base = json!({"baseColorTexture": {"index": 0}});
    let material = json!({"alphaMode": "MASK", "alphaCutoff": 0.5, "pbrMetallicRoughness": base});
    let import = textured(image, material).read().expect("a good image");
    let cover = &import.scene.objects[0].cover;
    [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)]
        .map(|(x, y)| DVec2::new(x, y))
        .map(|at| (cover.colour(at), cover.is_there(at)))
}

fn linear(coded: [u8; 3]) -> Vec3 {
    let channel = |coded: u8| {
        let coded = f32::from(coded) / 255.0;
        if coded <= 0.040_45 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
    };
    Vec3::from_array(coded.map(channel))
}

#[test]
fn jpegs_show_their_colours() {
    for (name, image) in JPEGS {
        for ((colour, there), coded) in seen(image).into_iter().zip(QUARTERS) {
            let [r, g, b] = coded.map(f32::from);
            // Luma of ITU-R BT.601, by which a picture becomes grey.
            let grey = (0.299 * r + 0.587 * g + 0.114 * b) as u8;
            let right = linear(if name == "grey" { [grey; 3] } else { coded });
            assert!(colour.abs_diff_eq(right, 0.03) && there, "{name}: {colour} instead of {right}");
        }
    }
}

#[test]
fn a_jpeg_of_inks_is_refused() {
    let base = json!({"baseColorTexture": {"index": 0}});
    let mask = json!({"alphaMode": "MASK", "pbrMetallicRoughness": base});
    let line = textured(include_bytes!("images/cmyk.jpg"), mask).refused();
    assert!(line.starts_with("images[0]: ") && line.contains("CMYK"), "{line}");
}

fn png(colour: ColorType, depth: BitDepth, palette: Option<&[u8]>, samples: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    if let Some(palette) = palette {
        encoder.set_palette(palette);
        encoder.set_trns(&[255u8, 255, 0][..]);
    }
    encoder.write_header().and_then(|mut writer| writer.write_image_data(samples)).expect("written");
    bytes
}

#[test]
fn pngs_of_every_colour_type_show_their_colours() {
    let all = [true; 4];
    let greys = [[0; 3], [255; 3], [80; 3], [160; 3]];
    let colours = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [80, 80, 80]];
    let rgb = colours.concat();
    let wide = |samples: &[u8]| -> Vec<u8> { samples.iter().flat_map(|sample| [*sample, *sample]).collect() };
    let with_alpha = |alpha: [u8; 4]| -> Vec<u8> {
        colours.iter().zip(alpha).flat_map(|(colour, alpha)| [colour[0], colour[1], colour[2], alpha]).collect()
    };
    let holes = [true, false, true, false];
    let alphas = [255, 0, 200, 20];
    let (grey, greys_with_alpha) = ([0, 255, 80, 160], [0, 255, 255, 0, 80, 200, 160, 20]);
    let palette = [255, 0, 0, 0, 255, 0, 0, 0, 255];
    let one_bit = [[255; 3], [0; 3], [0; 3], [255; 3]];
    for (image, shown, there) in [
        (png(ColorType::Grayscale, BitDepth::Eight, None, &grey), greys, all),
        (png(ColorType::Grayscale, BitDepth::Sixteen, None, &wide(&grey)), greys, all),
        (png(ColorType::Grayscale, BitDepth::One, None, &[0b1000_0000, 0b0100_0000]), one_bit, all),
        (png(ColorType::GrayscaleAlpha, BitDepth::Eight, None, &greys_with_alpha), greys, holes),
        (png(ColorType::Rgb, BitDepth::Eight, None, &rgb), colours, all),
        (png(ColorType::Rgb, BitDepth::Sixteen, None, &wide(&rgb)), colours, all),
        (png(ColorType::Rgba, BitDepth::Eight, None, &with_alpha(alphas)), colours, holes),
        (png(ColorType::Rgba, BitDepth::Sixteen, None, &wide(&with_alpha(alphas))), colours, holes),
        (
            png(ColorType::Indexed, BitDepth::Two, Some(&palette), &[0b0001_0000, 0b1001_0000]),
            [colours[0], colours[1], colours[2], colours[1]],
            [true, true, false, true],
        ),
    ] {
        for (((colour, found), coded), there) in seen(&image).into_iter().zip(shown).zip(there) {
            assert!(colour.abs_diff_eq(linear(coded), 1e-6), "{colour} instead of {coded:?}");
            assert_eq!(found, there, "{coded:?}");
        }
    }
}
