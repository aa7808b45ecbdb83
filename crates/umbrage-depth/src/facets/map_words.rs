//! Maps of facets as 32-bit words, for files.

use super::words::{FacetWordsError, Words};
use super::{FacetDepths, FacetMap, FacetTile};
use crate::{Stored, TILE};
use glam::UVec2;
use umbrage_plane::View;

/// Most samples along a refined texel's side: look-ups take time by its square.
const MOST_FINE: u32 = 8;

/// Most slots of a link: a place among them is kept in a byte.
const MOST_SLOTS: u32 = 256;

impl FacetMap {
    /// The tiles of the map as 32-bit words, row by row from the top: every bit of planes, indices, samples and links, and so all that the map
    /// keeps beside its view, its stored surface, [`fine`](super::FacetSource::fine) and [`FacetMap::slots`].
    ///
    /// A tile begins with its form; the tables below say what follows. A number of 64 bits takes two words, the low one first. The texels of a
    /// tile are 1024 for every tile, row by row, also where the tile reaches beyond the map.
    ///
    /// | form | tile | words |
    /// |---|---|---|
    /// | 0 | without a surface | none |
    /// | 1 | planes with all their bits (`fine` 1) | n, the number of planes; 3 n numbers of 64 bits: c, dx, dy of each; the indices of 1024 texels, *packed*; blocks |
    /// | 2 | rounded planes (`fine` > 1) | the base, 64 bits; n; 3 n floats: key, dx, dy of each; the indices of 1024 texels, *packed*; blocks |
    /// | 3 | depths (`fine` 1) | 1024 floats |
    /// | 4 | a plane for each texel (`fine` > 1) | the base, 64 bits; 1024 floats: keys; 1024 words of two 16-bit floats: dx in the low half, dy in the high one |
    ///
    /// The key of a plane at the position (x, y), in texels of the map, is c + dx·x + dy·y. Rounded planes are about the middle (mx, my) of
    /// their tile, 16 texels from its upper left corner both ways: base + key + dx·(x − mx) + dy·(y − my). The planes of form 4 are about the
    /// centre of their texel in the same way. A key of +∞ means that there is no surface.
    ///
    /// The blocks are the refined texels of the tile:
    ///
    /// | words | of the blocks |
    /// |---|---|
    /// | 1 | their number b; nothing follows when it is 0 |
    /// | 32 | which texels are refined: bit x of word y; blocks are in the order of their texels, row by row |
    /// | *packed* | b · `fine`² indices of planes: the samples of a block row by row, block after block |
    /// | b · ⌈`fine`²/16⌉ | which links are kept: for each block bit 2 s for the link of sample s to the right, bit 2 s + 1 for the one downward |
    /// | *packed* | for each link that is kept, how many of its slots see the surface of its sample |
    ///
    /// *Packed* numbers begin with a word that gives the width of each, which is 0, 1, 2, 4, 8 or 16 bits. As many words follow as they fill, the
    /// first number in the lowest bits; numbers of width 0 take no words and are all 0.
    #[must_use]
    pub fn to_words(&self) -> Vec<u32> {
        let mut words = Vec::new();
        for tile in self.tiles.iter() {
            match tile {
                Some(tile) => tile.write(&mut words),
                None => words.push(0),
            }
        }
        words
    }

    /// The map whose words [`FacetMap::to_words`] gave: it equals that map, and every look-up gives the same bits. `fine` and `slots` are
    /// those of [`FacetMap::from_tiles`].
    ///
    /// The words are not trusted: every index, count and number is checked, and the memory that is taken is bounded by their number and by the
    /// size of the map.
    ///
    /// # Errors
    /// [`FacetWordsError`] when the words do not hold such a map, `fine` is not within 1..=8 or `slots` not within 1..=256.
    pub fn from_words(
        view: View,
        stored: Stored,
        fine: u32,
        slots: u32,
        words: &[u32],
    ) -> Result<Self, FacetWordsError> {
        for (field, value, most) in [("fine", fine, MOST_FINE), ("slots", slots, MOST_SLOTS)] {
            if !(1..=most).contains(&value) {
                return Err(FacetWordsError::new(field, value, format!("not within 1..={most}")));
            }
        }
        let grid = view.size().map(|side| side.div_ceil(TILE));
        let depths = FacetDepths::of(&view);
        let mut words = Words::new(words);
        let mut tiles = Vec::new();
        for index in 0..grid.element_product() {
            let at = UVec2::new(index % grid.x, index / grid.x);
            let origin = (at * TILE).as_ivec2();
            let valid = (view.size() - at * TILE).min(UVec2::splat(TILE));
            let depth = |texel, plane: &_| depths.depth(texel, plane);
            let tile = FacetTile::read(&mut words, fine, slots, origin, valid, depth);
            tiles.push(tile.map_err(|error| error.in_tile(at))?);
        }
        if words.left() > 0 {
            return Err(FacetWordsError::new("words", words.left(), "left behind the last tile"));
        }
        Ok(Self::from_tiles(view, stored, fine, slots, tiles))
    }
}
