//! Maps of facets as words and back.

use fearless_simd::{f32x16, prelude::*};
use glam::{DVec2, DVec3, IVec2, UVec2};
use umbrage_depth::{
    DepthMap, FacetBlock, FacetCells, FacetDepths, FacetMap, FacetSource, FacetTile, NO_FACET, Stored, TILE,
};
use umbrage_plane::{Affine, Kind, Sampling, TexelRect, View, vectorized};

const AREA: usize = (TILE * TILE) as usize;

/// Random numbers from a seed.
struct Random(u64);

impl Random {
    fn below(&mut self, end: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % u64::from(end)) as u32
    }

    /// Within −½..½.
    fn number(&mut self) -> f64 {
        f64::from(self.below(1 << 30)) / f64::from(1 << 30) - 0.5
    }
}

fn spot(size: UVec2) -> View {
    View::perspective(DVec3::new(1.0, 9.0, 2.0), DVec3::ZERO, DVec3::X, 0.9, 2.0, 60.0, size).unwrap()
}

fn sun(size: UVec2) -> View {
    View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::X, 5.0, 0.0, 9.0, size).unwrap()
}

/// A tile of each kind after the other: nothing, one facet, a few with holes, many, as many as texels; the last three with blocks where
/// the map is refined, though what has as many planes as texels keeps none.
fn map(view: &View, fine: u32, slots: u32, seed: u64) -> FacetMap {
    let depths = FacetDepths::of(view);
    let grid = view.size().map(|side| side.div_ceil(TILE));
    let mut random = Random(seed);
    let tile = |index: u32| {
        let origin = (UVec2::new(index % grid.x, index / grid.x) * TILE).as_ivec2();
        let count = [0, 1, 3, 300, 1500][(u64::from(index) + seed) as usize % 5];
        let plane = |random: &mut Random| {
            let key = view.key(view.near() + (0.5 + random.number()) * (view.far() - view.near()));
            let (dx, dy) = (key * random.number() * 1e-3, key * random.number() * 1e-3);
            let at = origin.as_dvec2() + 16.0;
            Affine { c: key - dx * at.x - dy * at.y, dx, dy }
        };
        let planes: Vec<Affine> = (0..count).map(|_| plane(&mut random)).collect();
        let mut facet = |holes: u32| {
            if count == 0 || (count > 1 && random.below(9) < holes) { NO_FACET } else { random.below(count) }
        };
        let texels: Vec<u32> = (0..AREA).map(|_| facet(3)).collect();
        let mut blocks = Vec::new();
        if fine > 1 && (count == 3 || count == 300) {
            for texel in (0..AREA as u16).step_by(7) {
                let samples = (0..fine * fine).map(|_| facet(1)).collect();
                let link = |link: u16| (facet(2) % 2 == 0).then(|| (link, (facet(0) % slots) as u8));
                blocks.push(FacetBlock {
                    texel,
                    samples,
                    links: (0..2 * (fine * fine) as u16).filter_map(link).collect(),
                });
            }
        }
        let valid = (view.size() - origin.as_uvec2()).min(UVec2::splat(TILE));
        let cells = FacetCells { planes: &planes, texels: &texels, blocks: &blocks };
        FacetTile::new(&cells, origin, valid, fine, |texel, plane| depths.depth(texel, plane))
    };
    let tiles = (0..grid.element_product()).map(tile).collect();
    FacetMap::from_tiles(*view, Stored::Second, fine, slots, tiles)
}

/// Everything that can be looked up of a map, as bits.
fn looked_up(map: &FacetMap) -> Vec<u64> {
    let size = map.view().size().as_ivec2();
    let around = TexelRect::new(IVec2::splat(-2), size + 2);
    let mut all: Vec<u64> = around.texels().map(|texel| u64::from(map.depth(texel).to_bits())).collect();
    let range = map.range(around);
    all.extend([range.min, range.max].map(|depth| u64::from(depth.to_bits())));
    let fine = map.fine() as i32;
    for at in TexelRect::new(IVec2::splat(-fine), (size + 1) * fine).texels() {
        let sample = map.sample(at);
        let DVec2 { x, y } = sample.at;
        all.extend([sample.plane.c, sample.plane.dx, sample.plane.dy, x, y, sample.side].map(f64::to_bits));
        all.extend([false, true].map(|down| map.link(at, down).map_or(u64::MAX, f64::to_bits)));
    }
    all
}

fn views() -> Vec<View> {
    [UVec2::new(1, 1), UVec2::new(1, 37), UVec2::new(163, 40)]
        .into_iter()
        .flat_map(|size| {
            [
                spot(size),
                spot(size).with_kind(Kind::Radial).with_sampling(Sampling::Jittered { seed: 3 }),
                spot(size).with_kind(Kind::Screen),
                sun(size),
            ]
        })
        .collect()
}

/// In one tile, over two by two of them, over more, and beyond the map.
#[test]
fn sixteen_texels_are_what_each_of_them_is() {
    let mut random = Random(5);
    let (mut one, mut several) = (0, 0);
    for view in views() {
        let size = view.size().as_ivec2();
        for (fine, slots, seed) in [(1, 1, 0), (1, 1, 1), (1, 1, 2), (1, 1, 3), (1, 1, 4), (4, 16, 1)] {
            let map = map(&view, fine, slots, seed);
            for side in [1, 2, 9, 30, 64].repeat(20) {
                let mut below = |end: i32| random.below(end as u32) as i32;
                let min = IVec2::new(below(size.x + 4), below(size.y + 4)) - 2;
                let within = TexelRect::new(min, min + side);
                let texels: [IVec2; 16] = std::array::from_fn(|_| min + IVec2::new(below(side), below(side)));
                let [x, y] = [texels.map(|texel| texel.x as f32 + 0.7), texels.map(|texel| texel.y as f32 + 0.2)];
                let found: [f32; 16] = vectorized!(simd => {
                    map.look(simd, within, f32x16::load_array(simd, x), f32x16::load_array(simd, y)).into()
                });
                assert_eq!(
                    found.map(f32::to_bits),
                    texels.map(|texel| map.depth(texel).to_bits()),
                    "{within:?}, {view:?}"
                );
                if TexelRect::of_size(view.size()).encloses(within) {
                    let tiles = (within.max - 1) / TILE as i32 - min / TILE as i32;
                    one += u32::from(tiles == IVec2::ZERO);
                    several += u32::from(tiles == IVec2::ONE);
                }
            }
        }
    }
    assert!(one > 500 && several > 50, "{one} in one tile, {several} over two by two");
}

fn again(map: &FacetMap, words: &[u32]) -> Result<FacetMap, String> {
    let read = FacetMap::from_words(*map.view(), map.stored(), map.fine(), map.slots(), words);
    read.map_err(|error| error.to_string())
}

#[test]
fn a_map_read_again_is_the_map() {
    for view in views() {
        for (fine, slots) in [(1, 1), (2, 32), (4, 16), (8, 8), (3, 5)] {
            for seed in 0..5 {
                let map = map(&view, fine, slots, seed);
                let words = map.to_words();
                let read = again(&map, &words).expect("as it was written");
                assert!(read == map, "{:?}, fine {fine}, seed {seed}", view.size());
                assert_eq!(looked_up(&read), looked_up(&map));
                assert_eq!(read.to_words(), words);
                assert_eq!((read.bytes(), read.refined()), (map.bytes(), map.refined()));
            }
        }
    }
}

#[test]
fn a_rectangle_has_the_samples_of_its_places() {
    let mut alike = 0;
    for (fine, seed) in [(1, 0), (2, 1), (3, 2), (4, 3), (8, 4)] {
        let map = map(&spot(UVec2::new(70, 40)), fine, 8, seed);
        let mut random = Random(seed);
        for _ in 0..400 {
            let low = IVec2::new(78, 48).map(|most| random.below(most as u32 * fine) as i32) - 4 * fine as i32;
            let rect = TexelRect::new(low, low + IVec2::ONE.map(|side| side + random.below(12) as i32));
            let mut met: Vec<IVec2> = Vec::new();
            map.each_sample(rect, &mut |part, sample| {
                assert!(part.texels().all(|at| map.sample(at) == *sample), "fine {fine}: {part:?} of {rect:?}");
                met.extend(part.texels());
                true
            });
            met.sort_by_key(|at| (at.y, at.x));
            assert!(met.iter().copied().eq(rect.texels()), "fine {fine}: {rect:?}");
            if let Some(one) = map.one_facet(rect) {
                let like = |at| map.sample(at).plane == one.plane && map.sample(at).side == one.side;
                assert!(rect.texels().all(like), "fine {fine}: {rect:?}");
                alike += 1;
            }
        }
    }
    assert!(alike > 100, "{alike} rectangles of one facet");
}

/// Each of the forms, blocks and packed widths that there are must have been written above.
#[test]
fn every_form_occurs() {
    let bytes = |fine, seed| map(&spot(UVec2::splat(32)), fine, 4, seed).bytes();
    assert_eq!([0, 1, 4].map(|seed| bytes(1, seed)), [0, 24, 4 * AREA]);
    assert_eq!([0, 1, 4].map(|seed| bytes(4, seed)), [0, 12, 8 * AREA]);
    assert!(
        map(&spot(UVec2::splat(32)), 4, 4, 2).refined() == 147 && map(&spot(UVec2::splat(32)), 1, 4, 2).refined() == 0
    );
}

#[test]
fn every_cut_is_an_error() {
    for fine in [1, 4] {
        let map = map(&spot(UVec2::new(160, 20)), fine, 4, 0);
        let mut words = map.to_words();
        for length in 0..words.len() {
            let message = again(&map, &words[..length]).expect_err("cut");
            assert!(message.starts_with("tile ") && message.contains("words are left"), "{message}");
        }
        words.push(0);
        assert_eq!(again(&map, &words).expect_err("longer"), "words is 1: left behind the last tile");
    }
}

/// No digest stands before the words here: whatever they say is refused or can be looked up.
#[test]
fn every_word_may_be_anything() {
    for fine in [1, 2, 8] {
        let map = map(&spot(UVec2::new(160, 9)), fine, 4, 0);
        let words = map.to_words();
        let (mut refused, mut taken) = (0, 0);
        for at in 0..words.len() {
            let lies = [0, 1, u32::MAX, 1 << 31, words[at] ^ 1, words[at] ^ 1 << (at % 32), f32::NAN.to_bits()];
            // All of them for what is counted, which stands early in a tile; planes are many and alike.
            for &lie in &lies[if at < 400 { 0 } else { at % 7 }..][..if at < 400 { 7 } else { 1 }] {
                let mut damaged = words.clone();
                damaged[at] = lie;
                match again(&map, &damaged) {
                    Err(message) => {
                        assert!(!message.contains('\n'), "{message}");
                        refused += 1;
                    }
                    Ok(read) => {
                        taken += 1;
                        let depths = TexelRect::of_size(read.view().size()).texels().map(|texel| read.depth(texel));
                        assert!(depths.into_iter().all(|depth| depth > f32::NEG_INFINITY));
                        if taken % 50 == 0 {
                            looked_up(&read);
                        }
                    }
                }
            }
        }
        assert!(refused > 500 && taken > 500, "fine {fine}: {refused} refused, {taken} taken");
    }
}

#[test]
fn words_that_lie_are_named() {
    let one_tile = |fine| map(&spot(UVec2::splat(32)), fine, 4, 2);
    let refused = |map: &FacetMap, at: usize, word: u32, expected: &str| {
        let mut words = map.to_words();
        words[at] = word;
        let message = again(map, &words).expect_err(expected);
        assert!(message.starts_with("tile 0, 0: ") && message.contains(expected), "{message}");
    };
    let exact = one_tile(1);
    let planes = exact.to_words()[1];
    refused(&exact, 0, 5, "form is 5: not within 0..=4");
    refused(&exact, 0, 2, "form is 2: not a form of maps of fine = 1");
    refused(&exact, 1, 0, "number of planes is 0: not within 1..=65536");
    refused(&exact, 1, 65_537, "number of planes is 65537");
    refused(&exact, 1, 65_536, "planes is 393216 words: only");
    refused(&exact, 3, 0xFFF8_0000, "key of a plane is NaN: neither finite nor +inf");
    refused(&exact, 5, 0x7FF0_0000, "slope of a plane is inf: not finite");
    let texels = 2 + 6 * planes as usize;
    refused(&exact, texels, 3, "texels is 3: not a width of 0, 1, 2, 4, 8 or 16 bits");
    let refined = one_tile(4);
    let texels = 4 + 3 * refined.to_words()[3] as usize;
    let blocks = texels + 1 + AREA / 16;
    refused(&refined, 2, 0xFFF8_0000, "base is NaN: not finite");
    refused(&refined, blocks, 146, "number of blocks is 146: 147 texels are refined");
    refused(&refined, blocks + 1, 0, "texels are refined");
    let links = blocks + 33 + 1 + 147;
    refused(&refined, links + 147, 32, "places of links is 32: not a width");
    let many = map(&spot(UVec2::splat(32)), 4, 4, 3);
    let planes = many.to_words()[3];
    let texels = 4 + 3 * planes as usize;
    let expected = |field: &str| format!("{field} is 65535: not within 0..={}", planes - 1);
    refused(&many, texels + 1, u32::MAX, &expected("texels"));
    refused(&many, texels + 1 + AREA / 2 + 33 + 1, u32::MAX, &expected("samples"));
    // Eight bits each: above the slots.
    refused(&refined, links + 147, 8, "places of links");
    // Six links of a block with fine 3 do not exist: 18 of the word's bits do.
    let odd = map(&spot(UVec2::splat(32)), 3, 4, 2);
    let words = odd.to_words();
    let texels = 4 + 3 * words[3] as usize;
    let links = texels + 1 + AREA / 16 + 33 + 1 + (147_usize * 9).div_ceil(16);
    refused(&odd, links, words[links] | 1 << 18, "18 links are all");
    for (fine, slots, expected) in
        [(0, 1, "fine is 0"), (9, 1, "fine is 9"), (4, 0, "slots is 0"), (4, 257, "slots is 257")]
    {
        let error = FacetMap::from_words(*odd.view(), Stored::First, fine, slots, &words).expect_err(expected);
        assert!(error.to_string().starts_with(expected), "{error}");
    }
}

/// Slopes that sixteen bits do not hold are as steep as those can be: the depth at the texel's centre stays what it is.
#[test]
fn facets_that_are_nearly_edge_on_keep_their_depth() {
    let view = sun(UVec2::splat(TILE));
    let depths = FacetDepths::of(&view);
    let plane = |texel: u32| {
        let dx = f64::from(texel % 3) * 1e5;
        Affine { c: 4.0 + f64::from(texel) * 1e-3 - dx * (f64::from(texel % TILE) + 0.5), dx, dy: 0.0 }
    };
    let planes: Vec<Affine> = (0..AREA as u32).map(plane).collect();
    let texels: Vec<u32> = (0..AREA as u32).collect();
    let cells = FacetCells { planes: &planes, texels: &texels, blocks: &[] };
    let depth = |texel: IVec2, plane: &Affine| depths.depth(texel, plane);
    let tile = FacetTile::new(&cells, IVec2::ZERO, view.size(), 4, depth);
    let map = FacetMap::from_tiles(view, Stored::First, 4, 16, vec![tile]);
    for (texel, index) in TexelRect::of_size(view.size()).texels().zip(0..) {
        let expected = 4.0 + index as f32 * 1e-3;
        assert!((map.depth(texel) - expected).abs() < 1e-5, "{texel}: {} instead of {expected}", map.depth(texel));
    }
    assert!(again(&map, &map.to_words()).expect("finite") == map);
}
