//! Tiles as 32-bit words; [`FacetMap::to_words`](super::FacetMap::to_words) says what they are.

use super::packed::Packed;
use super::tile::{AREA, Blocks, Cells, FacetTile, Planes, range};
use super::words::{FacetWordsError, Words, double, words_of};
use crate::{TILE, no_surface};
use glam::{IVec2, UVec2};
use half::f16;
use umbrage_plane::Affine;

/// How a tile is kept.
const NOTHING: u32 = 0;
const EXACT: u32 = 1;
const NEAR: u32 = 2;
const DEPTHS: u32 = 3;
const OWN: u32 = 4;

/// Most planes of a tile: what indices can tell apart.
const MOST_PLANES: u32 = 1 << 16;

impl FacetTile {
    /// Appends the tile.
    pub(super) fn write(&self, words: &mut Vec<u32>) {
        match &self.cells {
            Cells::Table { planes, texels } => {
                planes.write(words);
                texels.write(words);
                match &self.blocks {
                    Some(blocks) => blocks.write(words),
                    None => words.push(0),
                }
            }
            Cells::Depths(depths) => {
                words.push(DEPTHS);
                words.extend(depths.iter().map(|depth| depth.to_bits()));
            }
            Cells::Own { base, keys, slopes } => {
                words.push(OWN);
                words.extend(words_of(*base));
                words.extend(keys.iter().map(|key| key.to_bits()));
                let both = |[dx, dy]: &[f16; 2]| u32::from(dx.to_bits()) | u32::from(dy.to_bits()) << 16;
                words.extend(slopes.iter().map(both));
            }
        }
    }

    /// Takes a tile; `None` where no surface is. `origin`, `valid` and `depth` as in [`FacetTile::new`].
    pub(super) fn read(
        words: &mut Words<'_>,
        fine: u32,
        slots: u32,
        origin: IVec2,
        valid: UVec2,
        depth: impl Fn(IVec2, &Affine) -> f32,
    ) -> Result<Option<Self>, FacetWordsError> {
        let form = words.one("form")?;
        let (cells, blocks) = match (form, fine) {
            (NOTHING, _) => return Ok(None),
            (EXACT, 1) | (NEAR, 2..) => {
                let planes = if form == EXACT { Planes::read_exact(words)? } else { Planes::read_near(words)? };
                let texels = Packed::read(words, "texels", AREA, planes.count() - 1)?;
                let blocks = Blocks::read(words, fine, slots, planes.count())?;
                (Cells::Table { planes, texels }, blocks)
            }
            (DEPTHS, 1) => (Cells::Depths(depths(words)?), None),
            (OWN, 2..) => (own(words)?, None),
            (EXACT..=OWN, _) => {
                return Err(FacetWordsError::new("form", form, format!("not a form of maps of fine = {fine}")));
            }
            _ => return Err(FacetWordsError::new("form", form, "not within 0..=4")),
        };
        let mut tile = Self { cells, blocks: blocks.map(Box::new), range: range(std::iter::empty()) };
        if fine == 1 {
            // It is computed rather than kept, so that no file can claim a range that the depths do not have.
            let reader = tile.reader(origin.as_dvec2() + 0.5 * f64::from(TILE));
            tile.range = range(valid_texels(valid).map(|at| match reader.texel(at) {
                super::tile::Stored::Depth(depth) => depth,
                super::tile::Stored::Plane(plane) => depth(origin + at.as_ivec2(), &plane),
            }));
        }
        Ok(Some(tile))
    }
}

/// The texels of a tile that are on the map, row by row.
fn valid_texels(valid: UVec2) -> impl Iterator<Item = UVec2> {
    (0..valid.y).flat_map(move |y| (0..valid.x).map(move |x| UVec2::new(x, y)))
}

fn depths(words: &mut Words<'_>) -> Result<Box<[f32]>, FacetWordsError> {
    let depths: Box<[f32]> = words.take("depths", AREA)?.iter().copied().map(f32::from_bits).collect();
    match depths.iter().find(|depth| no_surface::kept(**depth) != **depth) {
        Some(depth) => Err(FacetWordsError::new("depths", depth, "not a depth that a map keeps")),
        None => Ok(depths),
    }
}

fn own(words: &mut Words<'_>) -> Result<Cells, FacetWordsError> {
    let base = words.finite("base")?;
    let keys: Box<[f32]> = words.take("keys", AREA)?.iter().copied().map(f32::from_bits).collect();
    let slopes = words.take("slopes", AREA)?.iter();
    let slopes: Box<[[f16; 2]]> =
        slopes.map(|both| [f16::from_bits(*both as u16), f16::from_bits((*both >> 16) as u16)]).collect();
    for (key, [dx, dy]) in keys.iter().zip(&slopes) {
        check_plane((*key).into(), (*dx).into(), (*dy).into())?;
    }
    Ok(Cells::Own { base, keys, slopes })
}

/// Keys are finite, or +∞ where no surface is; slopes are finite.
fn check_plane(key: f64, dx: f64, dy: f64) -> Result<(), FacetWordsError> {
    if !(key.is_finite() || key == f64::INFINITY) {
        return Err(FacetWordsError::new("key of a plane", key, "neither finite nor +inf"));
    }
    match [dx, dy].into_iter().find(|slope| !slope.is_finite()) {
        Some(slope) => Err(FacetWordsError::new("slope of a plane", slope, "not finite")),
        None => Ok(()),
    }
}

impl Planes {
    fn write(&self, words: &mut Vec<u32>) {
        match self {
            Self::Exact(planes) => {
                words.extend([EXACT, planes.len() as u32]);
                words.extend(planes.iter().flat_map(|plane| [plane.c, plane.dx, plane.dy]).flat_map(words_of));
            }
            Self::Near { base, planes } => {
                words.push(NEAR);
                words.extend(words_of(*base));
                words.push(planes.len() as u32);
                words.extend(planes.iter().flatten().map(|number| number.to_bits()));
            }
        }
    }

    fn read_exact(words: &mut Words<'_>) -> Result<Self, FacetWordsError> {
        let count = Self::read_count(words)?;
        let numbers = words.take("planes", 6 * count)?.as_chunks::<6>().0.iter();
        let plane = |&[c0, c1, x0, x1, y0, y1]: &[u32; 6]| {
            let (c, dx, dy) = (double([c0, c1]), double([x0, x1]), double([y0, y1]));
            check_plane(c, dx, dy).map(|()| Affine { c, dx, dy })
        };
        Ok(Self::Exact(numbers.map(plane).collect::<Result<_, _>>()?))
    }

    fn read_near(words: &mut Words<'_>) -> Result<Self, FacetWordsError> {
        let base = words.finite("base")?;
        let count = Self::read_count(words)?;
        let numbers = words.take("planes", 3 * count)?.as_chunks::<3>().0.iter();
        let plane = |numbers: &[u32; 3]| {
            let [key, dx, dy] = numbers.map(f32::from_bits);
            check_plane(key.into(), dx.into(), dy.into()).map(|()| [key, dx, dy])
        };
        Ok(Self::Near { base, planes: numbers.map(plane).collect::<Result<_, _>>()? })
    }

    fn read_count(words: &mut Words<'_>) -> Result<usize, FacetWordsError> {
        match words.one("number of planes")? {
            count @ 1..=MOST_PLANES => Ok(count as usize),
            count => Err(FacetWordsError::new("number of planes", count, format!("not within 1..={MOST_PLANES}"))),
        }
    }

    /// One at least.
    fn count(&self) -> u32 {
        match self {
            Self::Exact(planes) => planes.len() as u32,
            Self::Near { planes, .. } => planes.len() as u32,
        }
    }
}

impl Blocks {
    fn write(&self, words: &mut Vec<u32>) {
        words.push(self.first.len() as u32);
        words.extend(self.refined);
        self.samples.write(words);
        words.extend(&self.kept);
        self.places.write(words);
    }

    /// `planes` are in the tile's table.
    fn read(words: &mut Words<'_>, fine: u32, slots: u32, planes: u32) -> Result<Option<Self>, FacetWordsError> {
        let count = words.one("number of blocks")? as usize;
        if count == 0 {
            return Ok(None);
        }
        let mut refined = [0; TILE as usize];
        refined.copy_from_slice(words.take("refined texels", TILE as usize)?);
        let found: u32 = refined.iter().map(|row| row.count_ones()).sum();
        if found as usize != count {
            return Err(FacetWordsError::new("number of blocks", count, format!("{found} texels are refined")));
        }
        let per_block = (fine * fine) as usize;
        let samples = Packed::read(words, "samples", count * per_block, planes - 1)?;
        let per_block = Self::link_words(fine);
        let kept: Box<[u32]> = words.take("links", count * per_block)?.into();
        let last = 2 * fine * fine - 32 * (per_block as u32 - 1);
        let mut first = Vec::with_capacity(count);
        let mut links = 0;
        for block in kept.chunks_exact(per_block) {
            let end = block[per_block - 1];
            if last < 32 && end >> last != 0 {
                return Err(FacetWordsError::new(
                    "links",
                    format!("{end:#x}"),
                    format!("{} links are all", 2 * fine * fine),
                ));
            }
            first.push(links);
            links += block.iter().map(|word| word.count_ones()).sum::<u32>();
        }
        let places = Packed::read(words, "places of links", links as usize, slots)?;
        let before = Self::before(&refined);
        Ok(Some(Self { refined, before, samples, kept, first: first.into(), places }))
    }
}
