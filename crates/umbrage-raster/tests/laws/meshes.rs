//! Meshes: nothing twice, nothing missed.

use crate::oracle::{Camera, bins, fragments, solid, texel_view};
use crate::scenes::{ball, cuboid, places, samplings, turns};
use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_plane::{Facing, Sampling, TexelRect, View};
use umbrage_raster::Triangle;

/// Corners of a grid of cells in 1/256 texel, and which diagonal splits each cell.
#[derive(Clone, Debug)]
struct Sheet {
    cells: IVec2,
    corners: Vec<IVec2>,
    diagonals: u64,
    min: IVec2,
    max: IVec2,
}

impl Sheet {
    fn corner(&self, x: i32, y: i32) -> IVec2 {
        self.corners[(y * (self.cells.x + 1) + x) as usize]
    }

    /// The triangles, each from a corner and in an order of its own.
    fn triangles(&self) -> Vec<[IVec2; 3]> {
        let mut made = Vec::new();
        for y in 0..self.cells.y {
            for x in 0..self.cells.x {
                let quad = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| self.corner(x + i, y + j));
                let turn = (self.diagonals >> ((y * self.cells.x + x) % 64) & 1) as usize;
                let at = |index: usize| quad[(index + turn) % 4];
                made.push([at(1), at(2), at(0)]);
                made.push([at(3), at(2), at(0)]);
            }
        }
        made
    }
}

/// A rectangle cut into cells whose inner corners are moved by up to a fifth of a cell: on quarter texels, where samples lie on corners
/// and edges, or on any snapping step.
fn sheets() -> impl Strategy<Value = Sheet> {
    let grid = prop_oneof![Just(64_i32), Just(128), Just(1)];
    let plan = (1_i32..6, 1_i32..6, grid, 330_i32..1300, 330_i32..1300, -600_i32..200, -600_i32..200);
    (plan, any::<u64>(), proptest::collection::vec(-1.0_f64..1.0, 72)).prop_map(
        |((across, down, grid, width, height, x, y), diagonals, moves)| {
            let cells = IVec2::new(across, down);
            let on_grid = |v: i32| v / grid * grid;
            let cell = IVec2::new(on_grid(width), on_grid(height));
            let min = IVec2::new(on_grid(x), on_grid(y));
            let mut corners = Vec::new();
            for (j, i) in (0..=down).flat_map(|j| (0..=across).map(move |i| (j, i))) {
                let index = corners.len() * 2;
                let inner = i > 0 && i < across && j > 0 && j < down;
                let shift = |axis: usize, cell: i32| {
                    if inner { on_grid((moves[(index + axis) % 72] * 0.2 * f64::from(cell)) as i32) } else { 0 }
                };
                corners.push(min + IVec2::new(i, j) * cell + IVec2::new(shift(0, cell.x), shift(1, cell.y)));
            }
            Sheet { cells, corners, diagonals, min, max: min + cells * cell }
        },
    )
}

/// A rectangle's corners joined to one point inside it.
fn fans() -> impl Strategy<Value = Sheet> {
    let side = || prop_oneof![(2_i32..90).prop_map(|quarters| quarters * 64), 256_i32..6000];
    (side(), side(), -500_i32..500, -500_i32..500, 0.01_f64..0.99, 0.01_f64..0.99).prop_map(
        |(width, height, x, y, s, t)| {
            let (min, max) = (IVec2::new(x, y), IVec2::new(x + width, y + height));
            let grid = if width % 64 == 0 && width > 640 { 64 } else { 1 };
            let inside = |size: i32, share: f64| ((f64::from(size) * share) as i32 / grid * grid).clamp(1, size - 1);
            let centre = min + IVec2::new(inside(width, s), inside(height, t));
            let corners = vec![min, IVec2::new(max.x, min.y), max, IVec2::new(min.x, max.y), centre];
            Sheet { cells: IVec2::ZERO, corners, diagonals: 0, min, max }
        },
    )
}

fn fan_triangles(fan: &Sheet) -> Vec<[IVec2; 3]> {
    (0..4).map(|side| [fan.corners[side], fan.corners[4], fan.corners[(side + 1) % 4]]).collect()
}

fn check_partition(sheet: &Sheet, pieces: &[[IVec2; 3]], sampling: Sampling) -> Result<(), TestCaseError> {
    let size = UVec2::new(29, 23);
    let view = texel_view(size, sampling);
    let world = |corner: IVec2| {
        Vec3::new(corner.x as f32 / 256.0 - 14.5, 11.5 - corner.y as f32 / 256.0, -5.0 - (corner.x % 7) as f32)
    };
    let found = fragments(&bins(&view, pieces.iter().map(|corners| solid(corners.map(world)))));
    for texel in TexelRect::of_size(size).texels() {
        let at = texel * 256 + sampling.offset_256(texel).as_ivec2();
        let inside = at.cmpge(sheet.min).all() && at.cmplt(sheet.max).all();
        let times = found.get(&(texel.y, texel.x)).map_or(0, Vec::len);
        prop_assert_eq!(times, usize::from(inside), "texel {}", texel);
    }
    Ok(())
}

fn check_closed(view: &View, triangles: Vec<Triangle>) -> Result<usize, TestCaseError> {
    let found = fragments(&bins(view, triangles));
    for (texel, facets) in &found {
        let fronts = facets.iter().filter(|facet| facet.facing == Facing::Front).count();
        prop_assert_eq!(2 * fronts, facets.len(), "(y, x) = {:?}", texel);
    }
    Ok(found.len())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8_000))]

    #[test]
    fn x2_split_rectangles_are_covered_once(sheet in sheets(), sampling in samplings()) {
        check_partition(&sheet, &sheet.triangles(), sampling)?;
    }

    #[test]
    fn x2_fans_are_covered_once(fan in fans(), sampling in samplings()) {
        check_partition(&fan, &fan_triangles(&fan), sampling)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    /// A height field over the picture, seen in perspective, that reaches past every side of it.
    #[test]
    fn x2_terrain_in_perspective_is_covered_once(
        eye in places(50.0),
        target in places(50.0),
        cells in (1_i32..8, 1_i32..8),
        moves in proptest::collection::vec((-0.2_f64..0.2, -0.2_f64..0.2, 2.0_f64..60.0), 81),
        sampling in samplings(),
    ) {
        prop_assume!((target - eye).truncate().length() > 1.0 && (target - eye).cross(DVec3::Y).length() > 1.0);
        let size = UVec2::new(41, 37);
        let camera = Camera::new(eye, target, 0.7, true, size);
        let view = camera.view(1.0, 100.0).with_sampling(sampling);
        let corner = |x: i32, y: i32| {
            let (i, j, zeta) = moves[(y * 9 + x) as usize];
            let share = DVec2::new((f64::from(x) + i) / f64::from(cells.0), (f64::from(y) + j) / f64::from(cells.1));
            camera.point((share * 2.0 - 0.5) * size.as_dvec2(), zeta).as_vec3()
        };
        let mut triangles = Vec::new();
        for (x, y) in (0..cells.0).flat_map(|x| (0..cells.1).map(move |y| (x, y))) {
            let [a, b, c, d] = [corner(x, y), corner(x, y + 1), corner(x + 1, y + 1), corner(x + 1, y)];
            triangles.extend([solid([a, b, c]), solid([a, c, d])]);
        }
        let found = fragments(&bins(&view, triangles));
        for texel in TexelRect::of_size(size).texels() {
            let facets = found.get(&(texel.y, texel.x)).map_or(&[][..], Vec::as_slice);
            prop_assert_eq!(facets.len(), 1, "texel {}", texel);
            prop_assert_eq!(facets[0].facing, Facing::Front);
        }
    }

    #[test]
    fn x2_turned_boxes_have_as_many_fronts_as_backs(
        turn in turns(),
        half in (0.01_f32..4.0, 0.01_f32..4.0, 0.01_f32..4.0),
        eye in places(30.0),
        perspective in any::<bool>(),
        sampling in samplings(),
    ) {
        prop_assume!(eye.length() > 12.0 && eye.cross(DVec3::Y).length() > 1.0);
        let camera = Camera::new(eye, DVec3::ZERO, if perspective { 0.3 } else { 5.0 }, perspective, UVec2::new(37, 61));
        let view = camera.view(1.0, 100.0).with_sampling(sampling);
        check_closed(&view, cuboid(Vec3::ZERO, half.into(), turn))?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// From one facet over many texels to hundreds of facets in one: silhouettes are full of slivers that snapping turns over.
    #[test]
    fn x2_balls_have_as_many_fronts_as_backs(
        turn in turns(),
        radius in prop_oneof![Just(vec![2.0_f32]), proptest::collection::vec(0.5_f32..3.0, 97)],
        (rings, around) in (2_usize..70, 3_usize..70),
        eye in places(30.0),
        perspective in any::<bool>(),
        sampling in samplings(),
        side in 4_u32..70,
    ) {
        prop_assume!(eye.length() > 8.0 && eye.cross(DVec3::Y).length() > 1.0);
        let camera = Camera::new(eye, DVec3::ZERO, if perspective { 0.3 } else { 4.0 }, perspective, UVec2::splat(side));
        let view = camera.view(1.0, 100.0).with_sampling(sampling);
        let seen = check_closed(&view, ball(Vec3::ZERO, &radius, rings, around, turn))?;
        prop_assert!(seen > 0 || radius.len() > 1 || rings < 4 || around < 5 || side < 12);
    }
}

/// A fan around a point of the map whose rim lies far outside, past the guard band: every texel is covered exactly once although every
/// triangle is cut.
#[test]
fn fans_out_to_two_to_the_24_cover_every_texel_once() {
    let size = UVec2::new(48, 33);
    let mut cut = 0;
    for case in 0..2_500u32 {
        let key =
            |n: u32| f64::from(umbrage_plane::mix32(umbrage_plane::mix32(case).wrapping_add(n))) / 4_294_967_296.0;
        let sampling = if case % 2 == 0 { Sampling::Centre } else { Sampling::Jittered { seed: case } };
        let view = texel_view(size, sampling);
        // Hubs on a quarter grid, so that they meet samples and share rows with them.
        let hub = Vec3::new(
            ((key(0) - 0.5) * 160.0).round() as f32 * 0.25,
            ((key(1) - 0.5) * 120.0).round() as f32 * 0.25,
            -7.0,
        );
        let count = 3 + case % 5;
        let start = key(2);
        let rim: Vec<Vec3> = (0..count)
            .map(|i| {
                // Spread evenly enough that no two neighbours are half a turn apart.
                let turn = (start + (f64::from(i) + 0.3 * key(3 + i)) / f64::from(count)) * std::f64::consts::TAU;
                let far = 2f64.powf(10.0 + 14.0 * key(20 + i));
                Vec3::new((turn.cos() * far) as f32, (turn.sin() * far) as f32, -7.0)
            })
            .collect();
        // A rim point may lie so near that its edges cross the map: go out until none does.
        let rim: Vec<Vec3> = rim
            .iter()
            .map(|at| Vec3::new(at.x.clamp(-16_777_216.0, 16_777_216.0), at.y.clamp(-16_777_216.0, 16_777_216.0), -7.0))
            .collect();
        let fan = (0..count as usize).map(|i| solid([hub, rim[i], rim[(i + 1) % count as usize]]));
        let made = bins(&view, fan);
        cut += made.stats().clipped;
        let found = fragments(&made);
        for texel in TexelRect::of_size(size).texels() {
            let covering = found.get(&(texel.y, texel.x)).map_or(0, Vec::len);
            assert_eq!(covering, 1, "case {case}, {texel}");
        }
    }
    assert!(cut > 4_000, "{cut} triangles were cut");
}
