//! What gives way where a refined map would take too many bytes.

use super::refined::Parts;
use rayon::prelude::*;
use umbrage_depth::FacetTile;

/// Most bytes of a refined map for each of its texels.
const MOST_BYTES: usize = 10;

/// Bytes that any map may take, however small: those of 256 × 256 texels. Finely cut things need as much in fewer texels.
const LEAST: usize = 256 * 256 * MOST_BYTES;

/// How exactly a tile is kept.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    /// How much farther than the refinement says a sample may lie off its texel's plane.
    pub tolerance: f64,
    /// Samples may share a plane that is nearly their own.
    pub merged: bool,
    /// Whether texels are refined at all.
    pub parts: Parts,
}

impl Level {
    /// Everything as the refinement says.
    pub const ALL: Self = Self { tolerance: 1.0, merged: false, parts: Parts::All };

    /// What is tried in turn: planes that are shared; only edges that are worth more and more texels; no samples.
    const LESS: [Self; 5] = [
        Self { tolerance: 1.0, merged: true, parts: Parts::All },
        Self { tolerance: 2.0, merged: true, parts: Parts::All },
        Self { tolerance: 4.0, merged: true, parts: Parts::All },
        Self { tolerance: 16.0, merged: true, parts: Parts::All },
        Self { tolerance: 1.0, merged: false, parts: Parts::Texels },
    ];
}

/// The tiles of a map of so many texels, within its bytes: those that take most are made anew with less, as few as will do. `again` makes one by its
/// index.
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
            // As many as would be enough if each saved half of its bytes.
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
