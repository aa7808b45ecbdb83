//! How a refined map that would take too many bytes is reduced.

use super::refined::Parts;
use rayon::prelude::*;
use umbrage_depth::FacetTile;

/// Most bytes of a refined map for each of its texels.
const MOST_BYTES: usize = 10;

/// Bytes that any map may take, however small: those of 256 × 256 texels. Finely cut things need as much in fewer texels.
const LEAST: usize = 256 * 256 * MOST_BYTES;

/// How exactly a tile is stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    /// The factor by which a sample may lie farther off its texel's plane than the refinement allows.
    pub tolerance: f64,
    /// Samples may share a plane that is nearly their own.
    pub merged: bool,
    /// Whether texels are refined at all.
    pub parts: Parts,
}

impl Level {
    /// Everything as the refinement requires.
    pub const ALL: Self = Self { tolerance: 1.0, merged: false, parts: Parts::All };

    /// The reductions that are tried in turn: shared planes; only edges that matter by more and more texels; no samples.
    const LESS: [Self; 5] = [
        Self { tolerance: 1.0, merged: true, parts: Parts::All },
        Self { tolerance: 2.0, merged: true, parts: Parts::All },
        Self { tolerance: 4.0, merged: true, parts: Parts::All },
        Self { tolerance: 16.0, merged: true, parts: Parts::All },
        Self { tolerance: 1.0, merged: false, parts: Parts::Texels },
    ];
}

/// The tiles of a map of this many texels, within its bytes: those that take most are made anew with less, and as few of them as suffice. `again`
/// makes one by its index.
pub(super) fn within(
    texels: usize,
    mut tiles: Vec<Option<FacetTile>>,
    again: impl Fn(usize, Level) -> Option<FacetTile> + Sync,
) -> Vec<Option<FacetTile>> {
    let bytes = |tile: &Option<FacetTile>| tile.as_ref().map_or(0, FacetTile::bytes);
    for level in Level::LESS {
        let all: usize = tiles.iter().map(bytes).sum();
        let Some(mut over) = all.checked_sub((texels * MOST_BYTES).max(LEAST) + 1) else { break };
        let mut left: Vec<usize> = (0..tiles.len()).collect();
        left.retain(|index| tiles[*index].as_ref().is_some_and(|tile| tile.refined() > 0));
        left.sort_by_key(|index| std::cmp::Reverse(bytes(&tiles[*index])));
        let mut left = left.as_slice();
        while !left.is_empty() {
            // As many as would suffice if each saved half of its bytes.
            let mut hoped = 0;
            let count = left.iter().take_while(|index| {
                let more = hoped <= over;
                hoped += bytes(&tiles[**index]) / 2;
                more
            });
            let (some, rest) = left.split_at(count.count());
            let made: Vec<_> = some.par_iter().map(|index| again(*index, level)).collect();
            let saved: usize =
                some.iter().zip(&made).map(|(index, new)| bytes(&tiles[*index]).saturating_sub(bytes(new))).sum();
            for (index, new) in some.iter().zip(made) {
                if bytes(&new) < bytes(&tiles[*index]) {
                    tiles[*index] = new;
                }
            }
            let Some(still) = over.checked_sub(saved) else { break };
            (over, left) = (still, rest);
        }
    }
    tiles
}
