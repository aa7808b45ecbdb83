//! Cells of a region are what a grid of them says.

use glam::DVec2;
use proptest::prelude::*;
use umbrage_plane::Cells;

/// The same as a list of the cells of 8 × 8 that are covered.
fn listed(cells: &[(u32, u32)], across: u32) -> Vec<(u32, u32)> {
    let side = 8 / across;
    let inside = |x: u32, y: u32| cells.contains(&(x / side, y / side));
    (0..64).map(|i| (i % 8, i / 8)).filter(|(x, y)| inside(*x, *y)).collect()
}

proptest! {
    #[test]
    fn centroid_bounds_and_shares_are_those_of_the_cells(power in 0u32..4, picked in prop::collection::vec(any::<bool>(), 64)) {
        let across = 1 << power;
        let chosen: Vec<(u32, u32)> =
            (0..across * across).filter(|i| picked[*i as usize]).map(|i| (i % across, i / across)).collect();
        let cells = chosen.iter().fold(Cells::NONE, |cells, (x, y)| cells.with(*x, *y, across));
        let all = listed(&chosen, across);
        prop_assert_eq!(cells.is_whole(), all.is_empty() || all.len() == 64);
        if !cells.is_whole() {
            let place = |(x, y): &(u32, u32)| (DVec2::new(f64::from(*x), f64::from(*y)) + 0.5) / 4.0 - 1.0;
            let mean = all.iter().map(place).sum::<DVec2>() / all.len() as f64;
            prop_assert!(cells.centroid().abs_diff_eq(mean, 1e-12));
            let (middle, half) = cells.bounds();
            let low = all.iter().map(place).fold(DVec2::ONE, DVec2::min) - 0.125;
            let high = all.iter().map(place).fold(-DVec2::ONE, DVec2::max) + 0.125;
            prop_assert!(middle.abs_diff_eq((low + high) * 0.5, 1e-12) && half.abs_diff_eq((high - low) * 0.5, 1e-12));
            for asked in [1, 2, 4, 8u32] {
                for (x, y) in (0..asked * asked).map(|i| (i % asked, i / asked)) {
                    let side = 8 / asked;
                    let inside = all.iter().filter(|cell| (cell.0 / side, cell.1 / side) == (x, y)).count();
                    prop_assert_eq!(cells.share(x, y, asked), inside as f32 / (side * side) as f32);
                }
            }
            // Of other grids, the cell at the middle.
            for (x, y) in (0..256).map(|i| (i % 16, i / 16)) {
                prop_assert_eq!(cells.share(x, y, 16) == 1.0, all.contains(&(x / 2, y / 2)));
            }
        }
    }
}

#[test]
fn whole_regions_are_about_their_middle() {
    for cells in [Cells::ALL, Cells::NONE, Cells::NONE.with(0, 0, 1)] {
        assert!(cells.is_whole());
        assert_eq!((cells.centroid(), cells.bounds()), (DVec2::ZERO, (DVec2::ZERO, DVec2::ONE)));
        assert_eq!(cells.share(2, 1, 3), 1.0);
    }
}
