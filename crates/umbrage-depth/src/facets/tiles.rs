use super::FacetTile;
use std::collections::BTreeMap;

/// Tiles of more bytes are not compared with others: two are hardly ever the same.
const MOST_SHARED: usize = 64;

/// The tiles of a map, equal ones once: of a plane square to the light all tiles are one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tiles {
    /// For each tile, row by row, which of those that are kept it is; past the last of them for a tile without a surface.
    index: Box<[u32]>,
    kept: Box<[FacetTile]>,
}

impl Tiles {
    pub fn new(tiles: Vec<Option<FacetTile>>) -> Self {
        let (mut kept, mut known): (Vec<FacetTile>, BTreeMap<Vec<u32>, u32>) = (Vec::new(), BTreeMap::new());
        let mut keep = |tile: FacetTile| {
            kept.push(tile);
            kept.len() as u32 - 1
        };
        let mut one = |tile: FacetTile| {
            if tile.bytes() > MOST_SHARED {
                return keep(tile);
            }
            let mut words = vec![tile.range.min.to_bits(), tile.range.max.to_bits()];
            tile.write(&mut words);
            *known.entry(words).or_insert_with(|| keep(tile))
        };
        let index = tiles.into_iter().map(|tile| tile.map_or(u32::MAX, &mut one)).collect();
        Self { index, kept: kept.into() }
    }

    /// A tile by its place, row by row; `None` where it has no surface.
    #[inline(always)]
    pub fn get(&self, index: usize) -> Option<&FacetTile> {
        self.kept.get(self.index[index] as usize)
    }

    /// All tiles, row by row.
    pub fn iter(&self) -> impl Iterator<Item = Option<&FacetTile>> {
        (0..self.index.len()).map(|index| self.get(index))
    }

    /// Bytes of what the kept tiles hold.
    pub fn bytes(&self) -> usize {
        self.kept.iter().map(FacetTile::bytes).sum()
    }

    /// Bytes of the directory and of the tiles themselves.
    pub fn directory(&self) -> usize {
        size_of_val(self.index.as_ref()) + size_of_val(self.kept.as_ref())
    }
}
