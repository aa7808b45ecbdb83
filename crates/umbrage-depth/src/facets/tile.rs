use super::packed::{Numbers, Packed};
use crate::TILE;
use glam::{DVec2, IVec2, UVec2};
use half::f16;
use std::collections::HashMap;
use umbrage_plane::{Affine, DepthRange};

/// Texels of a tile.
pub(super) const AREA: usize = (TILE * TILE) as usize;

/// Where no facet is: no index of a plane.
pub const NO_FACET: u32 = u32::MAX;

/// The plane of nothing: infinitely far.
pub(super) const NOTHING: Affine = Affine::constant(f64::INFINITY);

/// A texel that is kept as several samples.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FacetBlock {
    /// Index of the texel in its tile: row · [`TILE`] + column.
    pub texel: u16,
    /// The plane of each sample, row by row, as in [`FacetCells::texels`].
    pub samples: Vec<u32>,
    /// Links that are kept, in order: 2 · sample for the one to the right, one more for the one downward; and how many of the link's
    /// slots, counted from the sample, see its surface before another one is seen.
    pub links: Vec<(u16, u8)>,
}

/// What pass 1 found in a tile.
#[derive(Clone, Copy, Debug)]
pub struct FacetCells<'a> {
    /// Planes over texels of the map; those that nothing refers to are left out.
    pub planes: &'a [Affine],
    /// The plane of each texel's facet, row by row; [`NO_FACET`] where there is none and beyond the map.
    pub texels: &'a [u32],
    /// Texels that are kept as several samples, in order.
    pub blocks: &'a [FacetBlock],
}

/// Planes of a tile, with or without all bits.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Planes {
    /// Over the map's texels, unrounded.
    Exact(Box<[Affine]>),
    /// About the tile's middle: key less `base`, and change per texel, rounded to f32.
    Near { base: f64, planes: Box<[[f32; 3]]> },
}

/// Texels of a tile.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cells {
    /// By an index into a table.
    Table { planes: Planes, texels: Packed },
    /// Depths as any other map keeps them: facets are no larger than texels here.
    Depths(Box<[f32]>),
    /// Each texel with a plane of its own: its key less `base` at the centre, and change per texel.
    Own { base: f64, keys: Box<[f32]>, slopes: Box<[[f16; 2]]> },
}

/// Samples of refined texels, block after block.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Blocks {
    /// Refined texels: bit x of row y.
    pub(super) refined: [u32; TILE as usize],
    /// Blocks before each row.
    pub(super) before: [u16; TILE as usize],
    pub(super) samples: Packed,
    /// Links that are kept: a bit for each in the order of [`FacetBlock::links`], words of 32 for each block.
    pub(super) kept: Box<[u32]>,
    /// Links before each block.
    pub(super) first: Box<[u32]>,
    pub(super) places: Packed,
}

/// A tile of a [`FacetMap`](crate::FacetMap) that holds a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct FacetTile {
    pub(super) cells: Cells,
    pub(super) blocks: Option<Box<Blocks>>,
    pub(super) range: DepthRange,
}

impl FacetTile {
    /// Packs a tile whose upper left texel is `origin`. `depth` gives the depth of a plane at a texel, as the map's look-up does; texels from
    /// `valid` on are beyond the map. `fine` is the number of samples along a refined texel's side; with 1, planes keep all their bits and
    /// the tile gives the same depths as the one it is made of, otherwise they are rounded to twelve bytes.
    ///
    /// `None` when no texel and no sample has a facet.
    pub fn new(
        cells: &FacetCells<'_>,
        origin: IVec2,
        valid: UVec2,
        fine: u32,
        depth: impl Fn(IVec2, &Affine) -> f32,
    ) -> Option<Self> {
        let mut all = cells.texels.iter().chain(cells.blocks.iter().flat_map(|block| &block.samples));
        if all.all(|plane| *plane == NO_FACET) {
            return None;
        }
        let middle = origin.as_dvec2() + 0.5 * f64::from(TILE);
        let texel_of = |index: usize| IVec2::new((index % TILE as usize) as i32, (index / TILE as usize) as i32);
        let plane_of = |plane: u32| cells.planes.get(plane as usize).copied().unwrap_or(NOTHING);
        let exact = fine == 1;
        let (mut depths, mut range) = (Vec::new(), range(std::iter::empty()));
        if exact {
            depths.resize(AREA, f32::INFINITY);
            let inside = |index: &usize| texel_of(*index).cmplt(valid.as_ivec2()).all();
            for index in (0..AREA).filter(inside) {
                depths[index] = depth(origin + texel_of(index), &plane_of(cells.texels[index]));
            }
            range = self::range((0..AREA).filter(inside).map(|index| depths[index]));
        }
        // A key that is seen in the tile, for differences from it to be small.
        let base = cells
            .texels
            .iter()
            .position(|plane| *plane != NO_FACET)
            .map_or(0.0, |index| plane_of(cells.texels[index]).at((origin + texel_of(index)).as_dvec2() + 0.5));
        // Where all texels are alike, one says it all.
        let first = cells.texels.first().copied().unwrap_or(NO_FACET);
        let alike = cells.texels.iter().fold(0, |differs, plane| differs | (plane ^ first)) == 0;
        let texels = if alike { &cells.texels[..cells.texels.len().min(1)] } else { cells.texels };
        let table =
            Table::new(&FacetCells { texels, ..*cells }, |plane| Self::near(&plane_of(plane), base, middle), exact);
        let blocks = (!cells.blocks.is_empty()).then(|| Box::new(Blocks::new(cells, &table, fine)));
        let texels = Packed::new(&texels.iter().map(|plane| table.index(*plane)).collect::<Vec<_>>());
        let (small, bytes) = (table.kept.len() <= 1 << 16, table.bytes(exact) + texels.bytes());
        let own = AREA * if exact { size_of::<f32>() } else { size_of::<f32>() + size_of::<[f16; 2]>() };
        let blocks = blocks.filter(|_| small);
        if small && (blocks.is_some() || bytes < own) {
            let planes = table.planes(cells, exact, base);
            return Some(Self { cells: Cells::Table { planes, texels }, blocks, range });
        }
        if exact {
            return Some(Self { cells: Cells::Depths(depths.into()), blocks: None, range });
        }
        let one = |(index, plane): (usize, &u32)| {
            let plane = plane_of(*plane);
            let key = plane.at((origin + texel_of(index)).as_dvec2() + 0.5) - base;
            // Steeper ones would be infinite, and the key at the texel's centre not a number.
            let steepest = f64::from(f16::MAX);
            (key as f32, [plane.dx, plane.dy].map(|slope| f16::from_f64(slope.clamp(-steepest, steepest))))
        };
        let (keys, slopes): (Vec<f32>, Vec<[f16; 2]>) = cells.texels.iter().enumerate().map(one).unzip();
        Some(Self { cells: Cells::Own { base, keys: keys.into(), slopes: slopes.into() }, blocks: None, range })
    }

    /// A plane about the tile's middle, in three floats.
    fn near(plane: &Affine, base: f64, middle: DVec2) -> [f32; 3] {
        [(plane.at(middle) - base) as f32, plane.dx as f32, plane.dy as f32]
    }

    /// What reads the tile, whose middle is given in texels.
    #[inline(always)]
    pub(super) fn reader(&self, middle: DVec2) -> Reader<'_> {
        let (planes, texels) = match &self.cells {
            Cells::Table { planes, texels } => (Some(planes.about(middle)), texels.numbers()),
            _ => (None, Numbers::ZERO),
        };
        let blocks = self.blocks.as_deref();
        let samples = blocks.map_or(Numbers::ZERO, |blocks| blocks.samples.numbers());
        Reader { cells: &self.cells, middle, planes, texels, blocks, samples }
    }

    /// The slots that see their sample's surface, of the link from a place of a refined texel to the right or downward; `None` where it is not kept.
    #[inline(always)]
    pub(super) fn link(&self, at: UVec2, place: IVec2, fine: u32, down: bool) -> Option<u32> {
        let blocks = self.blocks.as_deref()?;
        if blocks.refined[at.y as usize] >> at.x & 1 == 0 {
            return None;
        }
        blocks.link(
            blocks.index(at),
            2 * (place.y as usize * fine as usize + place.x as usize) + usize::from(down),
            fine,
        )
    }

    /// Whether all texels of a rectangle, its last among them, have one plane of the table and none is refined.
    #[inline(always)]
    pub(super) fn is_one_facet(&self, first: UVec2, last: UVec2) -> bool {
        let Cells::Table { texels, .. } = &self.cells else { return false };
        let columns = (u32::MAX >> (TILE - 1 - last.x)) & (u32::MAX << first.x);
        // Loops rather than closures of iterators, which are not always compiled into their caller.
        if let Some(blocks) = &self.blocks {
            for y in first.y..=last.y {
                if blocks.refined[y as usize] & columns != 0 {
                    return false;
                }
            }
        }
        if texels.is_one() {
            return true;
        }
        let own = texels.get((first.y * TILE + first.x) as usize);
        for y in first.y..=last.y {
            for x in first.x..=last.x {
                if texels.get((y * TILE + x) as usize) != own {
                    return false;
                }
            }
        }
        true
    }

    /// Number of refined texels.
    #[must_use]
    pub fn refined(&self) -> usize {
        self.blocks.as_ref().map_or(0, |blocks| blocks.first.len())
    }

    /// Bytes of tables, indices, blocks and links.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let cells = match &self.cells {
            Cells::Table { planes: Planes::Exact(planes), texels } => size_of_val(planes.as_ref()) + texels.bytes(),
            Cells::Table { planes: Planes::Near { planes, .. }, texels } => {
                size_of_val(planes.as_ref()) + texels.bytes()
            }
            Cells::Depths(depths) => size_of_val(depths.as_ref()),
            Cells::Own { keys, slopes, .. } => size_of_val(keys.as_ref()) + size_of_val(slopes.as_ref()),
        };
        cells + self.blocks.as_ref().map_or(0, |blocks| blocks.bytes())
    }
}

/// The range of a tile with these depths; of none where filters ask samples, as they do of refined maps.
pub(super) fn range(depths: impl Iterator<Item = f32>) -> DepthRange {
    depths.map(|depth| DepthRange { min: depth, max: depth }).reduce(DepthRange::union).unwrap_or(DepthRange::UNKNOWN)
}

/// A tile with everything at hand that reading many of its texels and samples takes.
pub(super) struct Reader<'a> {
    cells: &'a Cells,
    middle: DVec2,
    planes: Option<PlanesAbout<'a>>,
    texels: Numbers<'a>,
    blocks: Option<&'a Blocks>,
    samples: Numbers<'a>,
}

impl Reader<'_> {
    /// The refined texels of a row: bit x of each.
    #[inline(always)]
    pub fn refined(&self, row: u32) -> u32 {
        self.blocks.map_or(0, |blocks| blocks.refined[row as usize])
    }

    /// The number of a refined texel's first sample.
    #[inline(always)]
    pub fn block(&self, at: UVec2, fine: u32) -> usize {
        self.blocks.map_or(0, |blocks| blocks.index(at) * (fine * fine) as usize)
    }

    /// The plane of a sample by its number: of a refined texel's, counted row by row from its first.
    #[inline(always)]
    pub fn sample(&self, number: usize) -> Affine {
        self.planes.map_or(NOTHING, |planes| planes.get(self.samples.get(number)))
    }

    /// The plane of a texel that is not refined, over the map's texels, or its depth where only that is kept.
    #[inline(always)]
    pub fn texel(&self, at: UVec2) -> Stored {
        let index = (at.y * TILE + at.x) as usize;
        if let Some(planes) = self.planes {
            return Stored::Plane(planes.get(self.texels.get(index)));
        }
        match self.cells {
            Cells::Table { .. } => Stored::Plane(NOTHING),
            Cells::Depths(depths) => Stored::Depth(depths[index]),
            Cells::Own { base, keys, slopes } => {
                let [dx, dy] = slopes[index].map(f64::from);
                let key = *base + f64::from(keys[index]);
                if key == f64::INFINITY {
                    return Stored::Plane(NOTHING);
                }
                let centre = self.middle - 0.5 * f64::from(TILE) + at.as_dvec2() + 0.5;
                Stored::Plane(Affine { c: key - dx * centre.x - dy * centre.y, dx, dy })
            }
        }
    }
}

/// What a texel stores.
pub(super) enum Stored {
    Plane(Affine),
    Depth(f32),
}

/// [`Planes`] of a tile whose middle is known, with everything at hand that reading one of them takes.
#[derive(Clone, Copy)]
enum PlanesAbout<'a> {
    Exact(&'a [Affine]),
    Near { base: f64, planes: &'a [[f32; 3]], middle: DVec2 },
}

impl Planes {
    #[inline(always)]
    fn about(&self, middle: DVec2) -> PlanesAbout<'_> {
        match self {
            Self::Exact(planes) => PlanesAbout::Exact(planes),
            Self::Near { base, planes } => PlanesAbout::Near { base: *base, planes, middle },
        }
    }
}

impl PlanesAbout<'_> {
    #[inline(always)]
    fn get(self, index: u32) -> Affine {
        match self {
            Self::Exact(planes) => planes[index as usize],
            Self::Near { base, planes, middle } => {
                // Of the plane of nothing, the slopes are finite and the key stays infinite.
                let [key, dx, dy] = planes[index as usize].map(f64::from);
                Affine { c: base + key - dx * middle.x - dy * middle.y, dx, dy }
            }
        }
    }
}

/// The planes that a tile refers to, each once.
struct Table {
    /// From the caller's index to the table's, the last for no facet; [`NO_FACET`] where nothing refers to it.
    index: Vec<u32>,
    /// The first of the caller's indices for each entry.
    kept: Vec<u32>,
    near: Vec<[f32; 3]>,
}

impl Table {
    /// Planes that are the same three floats are one entry, unless all bits are to be kept.
    fn new(cells: &FacetCells<'_>, near: impl Fn(u32) -> [f32; 3], exact: bool) -> Self {
        let none = cells.planes.len();
        let mut table = Self { index: vec![NO_FACET; none + 1], kept: Vec::new(), near: Vec::new() };
        let mut same: HashMap<[u64; 3], u32> = HashMap::with_capacity(none);
        let mut last = None;
        for &plane in cells.texels.iter().chain(cells.blocks.iter().flat_map(|block| &block.samples)) {
            if last.replace(plane) == Some(plane) {
                continue;
            }
            let place = (plane as usize).min(none);
            if table.index[place] != NO_FACET {
                continue;
            }
            let rounded = near(plane);
            let bits = match cells.planes.get(plane as usize) {
                Some(Affine { c, dx, dy }) if exact => [c, dx, dy].map(|number| number.to_bits()),
                _ => rounded.map(|number| u64::from(number.to_bits())),
            };
            let entry = *same.entry(bits).or_insert_with(|| {
                table.kept.push(plane);
                table.near.push(rounded);
                table.kept.len() as u32 - 1
            });
            table.index[place] = entry;
        }
        table
    }

    /// The entry of a plane that something refers to.
    fn index(&self, plane: u32) -> u32 {
        self.index[(plane as usize).min(self.index.len() - 1)]
    }

    fn bytes(&self, exact: bool) -> usize {
        self.kept.len() * if exact { size_of::<Affine>() } else { size_of::<[f32; 3]>() }
    }

    fn planes(self, cells: &FacetCells<'_>, exact: bool, base: f64) -> Planes {
        if exact {
            let plane = |plane: &u32| cells.planes.get(*plane as usize).copied().unwrap_or(NOTHING);
            return Planes::Exact(self.kept.iter().map(plane).collect());
        }
        Planes::Near { base, planes: self.near.into() }
    }
}

impl Blocks {
    fn new(cells: &FacetCells<'_>, table: &Table, fine: u32) -> Self {
        let words = Self::link_words(fine);
        let mut blocks = Self {
            refined: [0; TILE as usize],
            before: [0; TILE as usize],
            samples: Packed::new(&[]),
            kept: vec![0; words * cells.blocks.len()].into(),
            first: Box::default(),
            places: Packed::new(&[]),
        };
        let (mut samples, mut first, mut places) = (Vec::new(), Vec::new(), Vec::new());
        for (block, kept) in cells.blocks.iter().zip(blocks.kept.chunks_exact_mut(words)) {
            blocks.refined[usize::from(block.texel) / TILE as usize] |= 1 << (u32::from(block.texel) % TILE);
            samples.extend(block.samples.iter().map(|plane| table.index(*plane)));
            first.push(places.len() as u32);
            for (link, place) in &block.links {
                kept[usize::from(*link) / 32] |= 1 << (link % 32);
                places.push(u32::from(*place));
            }
        }
        blocks.before = Self::before(&blocks.refined);
        (blocks.samples, blocks.first, blocks.places) = (Packed::new(&samples), first.into(), Packed::new(&places));
        blocks
    }

    /// The place of a refined texel's block among those of the tile.
    #[inline(always)]
    fn index(&self, at: UVec2) -> usize {
        let before = self.refined[at.y as usize] & ((1 << at.x) - 1);
        usize::from(self.before[at.y as usize]) + before.count_ones() as usize
    }

    /// The slots of a block's link, by its number as in [`FacetBlock::links`]; `None` where it is not kept.
    #[inline(always)]
    fn link(&self, block: usize, link: usize, fine: u32) -> Option<u32> {
        let words = Self::link_words(fine);
        let kept = &self.kept[block * words..][..words];
        let (word, bit) = (link / 32, link % 32);
        if kept[word] >> bit & 1 == 0 {
            return None;
        }
        let before: u32 = kept[..word].iter().map(|word| word.count_ones()).sum();
        let before = before + (kept[word] & ((1 << bit) - 1)).count_ones();
        Some(self.places.get((self.first[block] + before) as usize))
    }

    /// Words that say which links of a block are kept.
    #[inline(always)]
    pub(super) fn link_words(fine: u32) -> usize {
        (2 * fine * fine).div_ceil(32) as usize
    }

    /// Blocks before each row of texels.
    pub(super) fn before(refined: &[u32; TILE as usize]) -> [u16; TILE as usize] {
        let mut next = 0;
        refined.map(|row| {
            let before = next;
            next += row.count_ones() as u16;
            before
        })
    }

    fn bytes(&self) -> usize {
        let lists = size_of_val(self.kept.as_ref()) + size_of_val(self.first.as_ref());
        size_of::<Self>() + lists + self.samples.bytes() + self.places.bytes()
    }
}
