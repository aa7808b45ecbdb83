//! Lines of finer grids: covered by whom a plain test of each point says, and as the texels' own samples are.

use glam::{DVec3, IVec2, UVec2};
use std::collections::BTreeMap;
use std::ops::Range;
use umbrage_plane::{Facet, TexelRect, View, vectorized};
use umbrage_raster::{BIN, Bins, Cull, Lines, Runs, Shown, Triangle};

/// Moves a corner that lies one texel from the middle of the view to 65,536 texels from it, twice the width of the largest map.
const FAR: DVec3 = DVec3::new(65536.0, 65536.0, 1.0);

/// Random triangles in front of a small perspective view: ordinary ones, slivers, some that are cut by the near limit, and some with corners that are far outside.
fn soup(seed: u32) -> (View, Vec<Triangle>) {
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.2, 1.0, 90.0, UVec2::new(70, 45)).unwrap();
    let mut state = u64::from(seed) * 2 + 1;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    let triangles = (0..40).map(|object| {
        let mut corner =
            || DVec3::new(next() * 20.0, next() * 14.0, -10.0 + next() * if object % 7 == 0 { 24.0 } else { 8.0 });
        let (a, b) = (corner(), corner());
        let (a, b) = if object % 11 == 10 { (a * FAR, b * FAR) } else { (a, b) };
        let c = if object % 3 == 0 { (a + b) * 0.5 + DVec3::new(0.0, 0.04, 0.0) } else { corner() };
        Triangle { corners: [a, b, c], object, sheet: true }
    });
    (view, triangles.collect())
}

/// Facets over the points of a grid by their spans.
fn covered(bins: &Bins, region: TexelRect, lines: Lines, step: i32) -> BTreeMap<(i32, i32), Vec<u32>> {
    let mut found: BTreeMap<(i32, i32), Vec<u32>> = BTreeMap::new();
    bins.spans(region, lines, step, |facet, line, along| {
        for at in along.filter(|at| at.rem_euclid(step) == step / 2) {
            let point = if lines == Lines::Rows { (at, line) } else { (line, at) };
            found.entry(point).or_default().push(facet.triangle);
        }
    });
    found
}

#[test]
fn spans_cover_the_texels_that_tiles_say() {
    for seed in 0..20 {
        let (view, triangles) = soup(seed);
        let bins = Bins::new(&view, TexelRect::of_size(view.size()), Cull::None, triangles);
        let whole = TexelRect::new(IVec2::ZERO, view.size().as_ivec2() * 256);
        let found = covered(&bins, whole, Lines::Rows, 256);
        let mut wanted: BTreeMap<(i32, i32), Vec<u32>> = BTreeMap::new();
        for index in 0..bins.tiles().element_product() {
            let tile = UVec2::new(index % bins.tiles().x, index / bins.tiles().x);
            bins.tile(tile, |facet, coverage| {
                for (y, row) in coverage.rows.iter().enumerate() {
                    for x in (0..BIN).filter(|x| row >> x & 1 == 1) {
                        let texel = (tile * BIN + UVec2::new(x, y as u32)).as_ivec2() * 256 + 128;
                        wanted.entry((texel.x, texel.y)).or_default().push(facet.triangle);
                    }
                }
            });
        }
        assert!(!wanted.is_empty());
        assert_eq!(found, wanted, "seed {seed}");
    }
}

/// Whether a point is inside a triangle of integers by its edges; `None` on an edge.
fn inside(corners: [IVec2; 3], at: IVec2) -> Option<bool> {
    let side = |a: IVec2, b: IVec2| (b - a).as_i64vec2().perp_dot((at - a).as_i64vec2()).signum();
    let [a, b, c] = corners;
    let sides = [side(a, b), side(b, c), side(c, a)];
    if sides.contains(&1) && sides.contains(&-1) {
        return Some(false);
    }
    if sides.contains(&0) { None } else { Some(true) }
}

/// Corners on the grid of 1/256 texel, narrow triangles between the texels' samples among them: every point of a finer grid is tested.
#[test]
fn a_finer_grid_is_covered_where_a_plain_test_says() {
    let size = UVec2::new(40, 36);
    let view = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 18.0, 1.0, 9.0, size).unwrap();
    let mut found_narrow = 0;
    for seed in 0..30u32 {
        let mut state = u64::from(seed) * 2 + 1;
        let mut next = move |most: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (((state >> 33) as i64 * i64::from(most)) >> 31) as i32
        };
        let snapped: Vec<[IVec2; 3]> = (0..30)
            .map(|i| {
                let corner = IVec2::new(next(40 * 256), next(36 * 256));
                let most = if i % 2 == 0 { 200 } else { 4000 };
                [corner, corner + IVec2::new(next(most), next(9000)), corner + IVec2::new(next(most), next(60) - 30)]
            })
            .collect();
        // x = texel − 20, y = 18 − texel: exact.
        let world = |at: IVec2| DVec3::new(f64::from(at.x) / 256.0 - 20.0, 18.0 - f64::from(at.y) / 256.0, -5.0);
        let triangles = snapped.iter().zip(0..).map(|(corners, object)| Triangle {
            corners: corners.map(world),
            object,
            sheet: true,
        });
        let bins = Bins::for_spans(&view, TexelRect::of_size(size), Cull::None, triangles);
        let whole = TexelRect::new(IVec2::ZERO, size.as_ivec2() * 256);
        for (lines, step) in [(Lines::Rows, 64), (Lines::Columns, 64), (Lines::Rows, 32)] {
            let found = covered(&bins, whole, lines, step);
            for y in (step / 2..36 * 256).step_by(step as usize) {
                for x in (step / 2..40 * 256).step_by(step as usize) {
                    let facets = found.get(&(x, y));
                    for (corners, index) in snapped.iter().zip(0u32..) {
                        let said = facets.is_some_and(|facets| facets.contains(&index));
                        if let Some(right) = inside(*corners, IVec2::new(x, y)) {
                            assert_eq!(said, right, "{lines:?} {corners:?} at {x}, {y}");
                            found_narrow += u32::from(right && index % 2 == 0);
                        }
                    }
                }
            }
        }
    }
    assert!(found_narrow > 10_000, "{found_narrow}");
}

#[test]
fn a_region_is_a_part_of_the_whole() {
    let (view, triangles) = soup(5);
    let bins = Bins::new(&view, TexelRect::of_size(view.size()), Cull::None, triangles);
    let whole = TexelRect::new(IVec2::ZERO, view.size().as_ivec2() * 256);
    for lines in [Lines::Rows, Lines::Columns] {
        let all = covered(&bins, whole, lines, 64);
        for corner in [(0, 0), (31 * 256, 5 * 256), (20 * 256 + 64, 30 * 256 + 128)] {
            let region = TexelRect::new(corner.into(), IVec2::from(corner) + IVec2::new(33 * 256, 9 * 256));
            let part = covered(&bins, region, lines, 64);
            let inside: BTreeMap<_, _> = all
                .iter()
                .filter(|((x, y), _)| region.contains(IVec2::new(*x, *y)))
                .map(|(at, f)| (*at, f.clone()))
                .collect();
            assert_eq!(part, inside);
        }
    }
}

/// A tile's own list holds what reaches up to a texel beyond its right and its lower side, so that no other list is looked at.
#[test]
fn a_tile_and_what_lies_just_beyond_it_are_a_part_of_the_whole() {
    for seed in 0..20 {
        let (view, triangles) = soup(seed);
        let bins = Bins::for_spans(&view, TexelRect::of_size(view.size()), Cull::None, triangles);
        let whole = TexelRect::new(IVec2::ZERO, view.size().as_ivec2() * 256);
        let all = covered(&bins, whole, Lines::Rows, 64);
        for tile in TexelRect::of_size(bins.tiles()).texels() {
            let min = tile * (BIN as i32 * 256);
            let region = TexelRect::new(min, (min + BIN as i32 * 256 + 256).min(whole.max));
            let part = covered(&bins, region, Lines::Rows, 64);
            let inside = all.iter().filter(|((x, y), _)| region.contains(IVec2::new(*x, *y)));
            assert!(part.iter().eq(inside), "seed {seed}, tile {tile}");
        }
    }
}

/// Of what is gathered once for a region, those that are shown in a part of it cover what the bins say, and whoever is left out is hidden there.
#[test]
fn whoever_is_not_shown_is_nearest_nowhere() {
    let (view, triangles) = soup(3);
    let few = triangles.into_iter().take(9);
    let bins = Bins::for_spans(&view, TexelRect::of_size(view.size()), Cull::None, few);
    let region = TexelRect::new(IVec2::new(9 * 256, 3 * 256), IVec2::new(66 * 256, 41 * 256));
    let gathered = bins.gathered(region);
    assert!(!gathered.is_empty() && gathered.len() <= bins.facets().len());
    let (mut nothing, mut one, mut several, mut hidden) = (0, 0, 0, 0);
    for corner in TexelRect::of_size(UVec2::new(14, 9)).texels().map(|at| region.min + at * 1024) {
        let part = TexelRect::new(corner, corner + 1024 + 64);
        let all = 0..gathered.len() as u32;
        let (mut shown, mut with_holes) = (Vec::new(), Vec::new());
        gathered.shown(part, all.clone(), |_| true, &mut shown);
        gathered.shown(part, all, |_| false, &mut with_holes);
        assert!(shown.iter().all(|shown| with_holes.contains(shown)), "{part:?}");
        assert!(with_holes.is_sorted_by_key(|shown| shown.number));
        hidden += with_holes.len() - shown.len();
        match shown.as_slice() {
            [] => nothing += 1,
            [Shown { covers: true, .. }] => one += 1,
            _ => several += 1,
        }
        for lines in [Lines::Rows, Lines::Columns] {
            let band = gathered.band(part, lines, 64).expect("lines over the part");
            let first = 32 + if lines == Lines::Rows { corner.y } else { corner.x };
            let runs = |shown: &[Shown], wants: &dyn Fn(Range<usize>) -> bool| {
                let mut runs = Runs::default();
                for shown in shown {
                    vectorized!(simd => band.covered(simd, *shown, wants, &mut runs));
                }
                runs
            };
            let covered = |shown: &[Shown]| {
                let mut found = Vec::new();
                for (number, start, along) in runs(shown, &|_| true).iter() {
                    for (line, along) in (start..).zip(along).filter(|(_, along)| !along.is_empty()) {
                        found.push((gathered.facet(number), first + 64 * line as i32, along.clone()));
                    }
                }
                found
            };
            // A facet that crosses a wanted line is given with all of its lines.
            for shown in &with_holes {
                let all = runs(&[*shown], &|_| true);
                let some = runs(&[*shown], &|mut lines| lines.any(|line| line % 5 == 1));
                let reaches =
                    all.iter().any(|(_, start, along)| (start..start + along.len()).any(|line| line % 5 == 1));
                assert!(some.iter().eq(all.iter().filter(|_| reaches)), "{lines:?} of {part:?}");
            }
            let mut all = Vec::new();
            bins.spans(part, lines, 64, |facet, line, along| all.push((*facet, line, along)));
            assert_eq!(covered(&with_holes), all, "{lines:?} of {part:?}");
            let some = covered(&shown);
            for at in TexelRect::of_size(UVec2::splat(16)).texels().map(|at| corner + 64 * at + 32) {
                let (across, along) = if lines == Lines::Rows { (at.y, at.x) } else { (at.x, at.y) };
                let nearest = |spans: &[(Facet, i32, Range<i32>)]| {
                    let there = spans.iter().filter(|(_, line, span)| *line == across && span.contains(&along));
                    there.map(|(facet, ..)| facet.plane.at(at.as_dvec2() / 256.0)).fold(f64::INFINITY, f64::min)
                };
                assert_eq!(nearest(&some), nearest(&all), "{at} of {part:?}");
            }
        }
    }
    assert!(nothing > 0 && one > 0 && several > 0, "{nothing} of nothing, {one} of one, {several} of several");
    assert!(hidden > 10, "{hidden}");
}
