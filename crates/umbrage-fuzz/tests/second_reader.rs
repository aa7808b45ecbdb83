//! What we write, as a second reader finds it that shares no code with ours.

use glam::{DMat4, DVec3, IVec2, UVec2};
use miniz_oxide::inflate::decompress_to_vec_zlib;
use umbrage_depth::{DeepMap, DepthMap, Map, Raw};
use umbrage_fuzz::{Chunk, Dice, ExrFile, Part, cut_into_rows, cut_into_tiles, deep, facets, flat, map, view};
use umbrage_io::{decode_deep_map, decode_map, decode_shadow_map, encode_shadow_map};

/// A file of ours, taken apart; put together again in the order of its offset table it is the same file, so that chunks lie in order.
fn parsed(bytes: &[u8]) -> ExrFile {
    let file = ExrFile::parse(bytes).expect("a file as the layout wants it");
    let most = file.parts.iter().map(|part| part.chunks.len()).max().unwrap_or(0);
    let order: Vec<usize> = (0..most).collect();
    assert!(file.to_bytes(&order) == bytes, "chunks out of order");
    file
}

/// Bytes that ZIP or ZIPS packed. What packing would not shorten is as it was.
fn unpacked(packed: &[u8], expected: usize) -> Vec<u8> {
    if packed.len() == expected {
        return packed.to_vec();
    }
    assert!(packed.len() < expected);
    let mut bytes = decompress_to_vec_zlib(packed).expect("zlib");
    assert_eq!(bytes.len(), expected);
    // Differences of neighbours, first those of all even bytes and then those of all odd ones.
    for at in 1..expected {
        bytes[at] = bytes[at].wrapping_add(bytes[at - 1]).wrapping_sub(128);
    }
    let (even, odd) = bytes.split_at(expected.div_ceil(2));
    (0..expected).map(|at| if at % 2 == 0 { even[at / 2] } else { odd[at / 2] }).collect()
}

fn words(bytes: &[u8]) -> Vec<u32> {
    let (words, rest) = bytes.as_chunks::<4>();
    assert!(rest.is_empty());
    words.iter().map(|word| u32::from_le_bytes(*word)).collect()
}

fn floats(part: &Part, name: &str, kind: &str) -> Vec<f32> {
    words(part.get(name, kind).expect(name)).into_iter().map(f32::from_bits).collect()
}

fn text(part: &Part, name: &str) -> String {
    String::from_utf8(part.get(name, "string").expect(name).to_vec()).expect("text")
}

/// The bytes of a list of channels of one type, each with a sample for each texel.
fn channels(names: &[&str], kind: u8) -> Vec<u8> {
    let channel = |name: &&str| {
        let numbers = [u32::from(kind), 0, 1, 1].map(u32::to_le_bytes).concat();
        [name.as_bytes(), &[0], numbers.as_slice()].concat()
    };
    [names.iter().flat_map(channel).collect(), vec![0]].concat()
}

/// What every map's file says of its view, and of the window that it stores.
fn check_view(part: &Part, map: &impl DepthMap, window: [i32; 4]) {
    let (view, size) = (map.view(), map.view().size().as_ivec2());
    assert_eq!(part.numbers("displayWindow", "box2i"), Ok([0, 0, size.x - 1, size.y - 1]));
    assert_eq!(part.numbers("dataWindow", "box2i"), Ok(window));
    assert_eq!(floats(part, "near", "float"), [view.near() as f32]);
    assert_eq!(floats(part, "far", "float"), [view.far() as f32]);
    assert_eq!(floats(part, "pixelAspectRatio", "float"), [1.0]);
    assert_eq!(text(part, "textureformat"), "Shadow");
    assert_eq!(text(part, "software"), "umbrage");
    let comments = text(part, "comments");
    assert!(comments.starts_with("umbrage view 1\nworld_to_eye=") && comments.contains("\ndigest="), "{comments}");
    // Row vectors, eyes that look along +z, and corners of the picture at (0, 0) and (1, 1).
    let to_camera = DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0)) * view.world_to_eye();
    assert_eq!(floats(part, "worldToCamera", "m44f"), to_camera.to_cols_array().map(|number| number as f32));
    let to_picture = floats(part, "worldToNDC", "m44f");
    let to_picture = DMat4::from_cols_array(&std::array::from_fn(|at| f64::from(to_picture[at])));
    let ahead = to_picture.project_point3(view.light().truncate() + 5.0 * view.ahead());
    assert!((ahead.truncate() - 0.5).abs().max_element() < 1e-5, "{ahead}");
}

/// The depths of a flat part of tiles, by texel of the window.
fn depths(part: &Part) -> Vec<((i32, i32), f32)> {
    let ([left, top, right, bottom], block) = (part.numbers("dataWindow", "box2i").unwrap(), part.block().unwrap());
    let [width, height] = block.map(|side| side as i32);
    let tile = |chunk: &Chunk| {
        let (x, y) = (left + chunk.place[0] * width, top + chunk.place[1] * height);
        let (end_x, end_y) = ((x + width).min(right + 1), (y + height).min(bottom + 1));
        let bytes = unpacked(&chunk.packed, 4 * ((end_x - x) * (end_y - y)) as usize);
        let texels = (y..end_y).flat_map(move |y| (x..end_x).map(move |x| (x, y)));
        texels.zip(words(&bytes).into_iter().map(f32::from_bits)).collect::<Vec<_>>()
    };
    part.chunks.iter().flat_map(tile).collect()
}

/// Holds the file of a map's depths to the map. How many of its tiles are stored without packing.
fn check_flat(part: &Part, map: &impl DepthMap, window: [i32; 4]) -> usize {
    check_view(part, map, window);
    assert_eq!(part.get("channels", "chlist"), Some(channels(&["Z"], 2).as_slice()));
    assert_eq!(part.get("compression", "compression"), Some([3].as_slice()), "ZIP");
    assert_eq!(part.get("lineOrder", "lineOrder"), Some([0].as_slice()), "from the top");
    assert_eq!(part.get("tiles", "tiledesc").map(|tiles| (words(&tiles[..8]), tiles[8])), Some((vec![64, 64], 0)));
    let columns = (window[2] - window[0]) / 64 + 1;
    for (chunk, index) in part.chunks.iter().zip(0..) {
        assert_eq!(chunk.place, [index % columns, index / columns, 0, 0]);
    }
    let found = depths(part);
    let area = (window[2] - window[0] + 1) * (window[3] - window[1] + 1);
    assert_eq!(found.len() as i32, area);
    for ((x, y), depth) in found {
        assert_eq!(depth.to_bits(), map.depth(IVec2::new(x, y)).to_bits(), "{x}, {y}");
    }
    let [width, height] = part.sides().unwrap();
    let raw = |chunk: &&Chunk| {
        let side = |place: i32, side: usize| (side - 64 * place as usize).min(64);
        chunk.packed.len() == 4 * side(chunk.place[0], width) * side(chunk.place[1], height)
    };
    part.chunks.iter().filter(raw).count()
}

#[test]
fn flat_maps() {
    let small = map(&view(UVec2::splat(8)));
    let file = parsed(&flat());
    assert_eq!((file.version, file.parts.len()), (2 | 1 << 9, 1));
    assert_eq!(check_flat(&file.parts[0], &small, [0, 0, 7, 7]), 1, "too few to pack");
    // Surfaces in a box across four tiles.
    let size = UVec2::new(150, 140);
    let depth = |index: u32| match (index % size.x, index / size.x) {
        (x @ 10..130, y @ 20..120) => 7.5 + (x * y) as f32 / 1e4,
        _ => f32::INFINITY,
    };
    let cropped = Raw::new(view(size), (0..size.element_product()).map(depth).collect()).expect("depths");
    let file = parsed(&encode_shadow_map(&cropped).expect("written"));
    assert_eq!(check_flat(&file.parts[0], &cropped, [10, 20, 129, 119]), 0);
    // Any bits that are a depth: nothing can be packed.
    let mut dice = Dice(7);
    let bits = std::iter::repeat_with(|| f32::from_bits(dice.below(1 << 32) as u32));
    let noise = bits.filter(|depth| depth.is_finite() && *depth < 1e30).take(64 * 64).collect();
    let noise = Raw::new(view(UVec2::splat(64)), noise).expect("depths");
    let file = parsed(&encode_shadow_map(&noise).expect("written"));
    assert_eq!(check_flat(&file.parts[0], &noise, [0, 0, 63, 63]), 1);
}

/// What is not packed, in tiles of another size or in rows, which lie in another order, is the same map to our reader.
#[test]
fn blocks_that_are_not_packed_and_out_of_order() {
    let map = map(&view(UVec2::new(13, 11)));
    assert_eq!(decode_shadow_map(&cut_into_rows(&map), 1000).as_ref(), Ok(&map));
    for seed in 0..20u8 {
        let bytes = cut_into_tiles(&map, 1 + seed % 5, Dice(u32::from(seed)));
        assert_eq!(decode_shadow_map(&bytes, 1000).as_ref(), Ok(&map));
        let file = ExrFile::parse(&bytes).expect("sound");
        assert!(depths(&file.parts[0]).iter().all(|((x, y), depth)| *depth == map.depth(IVec2::new(*x, *y))));
        assert!(file.parts[0].chunks.len() > 8 && !file.parts[0].chunks.is_sorted_by_key(|chunk| chunk.offset));
    }
}

/// The opacities of a texel's steps, to the mean of the channels and to each, as compositing has them.
fn check_deep(coloured: bool) {
    let bytes = deep(coloured);
    let map: DeepMap = decode_deep_map(&bytes, 1000).expect("read");
    let file = parsed(&bytes);
    assert_eq!((file.version, file.parts.len()), (2 | 1 << 11, 1));
    let part = &file.parts[0];
    let window = part.numbers("dataWindow", "box2i").unwrap();
    check_view(part, &map, window);
    let names: &[&str] = if coloured {
        &["A", "AB", "AG", "AR", "Z", "passes.B", "passes.G", "passes.R"]
    } else {
        &["A", "Z", "passes.Y"]
    };
    assert_eq!(part.get("channels", "chlist"), Some(channels(names, 2).as_slice()));
    assert_eq!(text(part, "type"), "deepscanline");
    assert_eq!(part.get("compression", "compression"), Some([2].as_slice()), "ZIPS");
    assert_eq!(floats(part, "epsilon", "float"), [0.0]);
    let mut all = 0;
    for (chunk, y) in part.chunks.iter().zip(window[1]..) {
        assert_eq!(chunk.place, [y]);
        let (table, length) = chunk.deep.as_ref().expect("deep");
        let ends = words(&unpacked(table, 4 * part.sides().unwrap()[0]));
        let samples = words(&unpacked(&chunk.packed, *length as usize));
        let count = samples.len() / names.len();
        assert_eq!(ends.last(), Some(&(count as u32)));
        let value = |name: &str, sample: usize| {
            let at = names.iter().position(|known| *known == name).expect(name);
            f32::from_bits(samples[at * count + sample])
        };
        let starts = std::iter::once(0).chain(ends.iter().copied());
        for ((start, end), x) in starts.zip(&ends).zip(window[0]..) {
            let steps = map.steps(IVec2::new(x, y));
            assert_eq!(steps.len() as u32, end - start);
            let mut left = 1.0;
            for (step, sample) in steps.iter().zip(start as usize..) {
                let passes = if coloured { ["passes.R", "passes.G", "passes.B"] } else { ["passes.Y"; 3] };
                assert_eq!(value("Z", sample), step.depth);
                assert_eq!(passes.map(|name| value(name, sample)), step.passes.to_array());
                left *= 1.0 - f64::from(value("A", sample));
                assert!((left - step.passes.as_dvec3().element_sum() / 3.0).abs() < 1e-6);
                all += 1;
            }
        }
    }
    let (texels, size) = (window[2] - window[0], map.view().size());
    assert!(all > 20 && texels > 2 && size == UVec2::new(6, 5));
}

#[test]
fn deep_maps() {
    check_deep(false);
    check_deep(true);
}

#[test]
fn maps_of_facets() {
    let bytes = facets();
    let Ok(Map::Facets(map)) = decode_map(&bytes, 1000) else { panic!("a map of facets") };
    let file = parsed(&bytes);
    assert_eq!((file.version, file.parts.len()), (2 | 1 << 12, 2));
    let [depths, words_part] = file.parts.as_slice() else { panic!("two parts") };
    assert_eq!((text(depths, "name"), text(words_part, "name")), ("shadow".into(), "facets".into()));
    let window = depths.numbers("dataWindow", "box2i").unwrap();
    check_flat(depths, &*map, window);
    assert_eq!(text(words_part, "type"), "scanlineimage");
    assert_eq!(words_part.get("channels", "chlist"), Some(channels(&["facets"], 0).as_slice()));
    let [columns, rows] = words_part.sides().unwrap();
    let stream: Vec<u32> = words_part
        .chunks
        .iter()
        .flat_map(|chunk| words(&unpacked(&chunk.packed, 4 * columns * (rows - chunk.place[0] as usize).min(16))))
        .collect();
    let written = umbrage_depth::FacetMap::to_words(&map);
    assert_eq!(stream[..written.len()], written);
    assert!(stream[written.len()..].iter().all(|word| *word == 0), "zeros fill the last row");
    let said = text(words_part, "comments");
    assert!(said.starts_with("umbrage facets 1\n") && said.contains(&format!("\nwords={}\n", written.len())), "{said}");
}

/// Programs in `fuzz/` are compiled by nobody but cargo-fuzz: each target must have its own there.
#[test]
fn every_target_has_its_program() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz");
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect(name);
    let manifest = read("Cargo.toml");
    for target in umbrage_fuzz::TARGETS {
        let program = format!("fuzz_targets/{}.rs", target.name);
        assert!(manifest.contains(&format!("name = \"{}\"\npath = \"{program}\"", target.name)), "{program}");
        assert!(read(&program).contains(&format!("umbrage_fuzz::{}(data);", target.name)), "{program}");
    }
    assert_eq!(manifest.matches("[[bin]]").count(), umbrage_fuzz::TARGETS.len());
}
