//! Bicubic patches for sculpted things: surfaces of revolution, and skins over grids of points.

use crate::Patch;
use glam::{Mat4, Vec2, Vec3};

/// Handles of a quarter circle of radius 1, for the least error of a cubic.
pub(super) const ROUND: f32 = 0.552_285;

/// A profile of cubic Bézier curves in the (radius, height) plane: 3n + 1 points, walked from bottom to top.
pub(super) type Profile = Vec<Vec2>;

/// A solid standing on the axis with rounded rims: a drum from `low` to `high`, rims of radius `rim`; five curves.
pub(super) fn drum(radius: f32, low: f32, high: f32, rim: f32) -> Profile {
    let hold = rim * (1.0 - ROUND);
    let mut profile = vec![Vec2::new(0.0, low)];
    straight(&mut profile, Vec2::new(radius - rim, low));
    profile.extend([Vec2::new(radius - hold, low), Vec2::new(radius, low + hold), Vec2::new(radius, low + rim)]);
    straight(&mut profile, Vec2::new(radius, high - rim));
    profile.extend([Vec2::new(radius, high - hold), Vec2::new(radius - hold, high), Vec2::new(radius - rim, high)]);
    straight(&mut profile, Vec2::new(0.0, high));
    profile
}

/// A ball about the origin; two curves.
pub(super) fn ball(radius: f32) -> Profile {
    let [zero, hold, one] = [0.0, ROUND, 1.0].map(|part| part * radius);
    [(zero, -one), (hold, -one), (one, -hold), (one, zero), (one, hold), (hold, one), (zero, one)]
        .map(Vec2::from)
        .to_vec()
}

/// A ring about the origin in the plane square to the axis; four curves.
pub(super) fn ring(major: f32, minor: f32) -> Profile {
    let hold = ROUND;
    let around = [
        (-1.0, 0.0),
        (-1.0, -hold),
        (-hold, -1.0),
        (0.0, -1.0),
        (hold, -1.0),
        (1.0, -hold),
        (1.0, 0.0),
        (1.0, hold),
        (hold, 1.0),
        (0.0, 1.0),
        (-hold, 1.0),
        (-1.0, hold),
        (-1.0, 0.0),
    ];
    around.map(|(out, up)| Vec2::new(major + minor * out, minor * up)).to_vec()
}

fn straight(profile: &mut Profile, to: Vec2) {
    let from = profile[profile.len() - 1];
    profile.extend([from.lerp(to, 1.0 / 3.0), from.lerp(to, 2.0 / 3.0), to]);
}

/// Turns a profile about the y axis, four patches a curve, and places it. Handles of [`ROUND`] make round sections; longer
/// ones, up to 1, make them squarer. Closed when the profile begins and ends on the axis, or where it began.
pub(super) fn turned(profile: &[Vec2], handle: f32, place: &Mat4) -> Vec<Patch> {
    const SPOKES: [Vec3; 4] = [Vec3::X, Vec3::NEG_Z, Vec3::NEG_X, Vec3::Z];
    let mut patches = Vec::new();
    for curve in profile.windows(4).step_by(3) {
        for quarter in 0..4 {
            let (a, b) = (SPOKES[quarter], SPOKES[(quarter + 1) % 4]);
            let around = [a, a + b * handle, a * handle + b, b];
            let control = |v: usize, u: usize| place.transform_point3(around[u] * curve[v].x + Vec3::Y * curve[v].y);
            patches.push(Patch { control: std::array::from_fn(|v| std::array::from_fn(|u| control(v, u))) });
        }
    }
    patches
}

/// Patches through a grid of points, smooth everywhere inside (Catmull-Rom slopes, one-sided at borders): rows along v,
/// u along each row, which closes on itself if `around`. The outside is where S_u × S_v points.
///
/// Patches that share a border are given the same control points there, bit for bit.
pub(super) fn skin(grid: &[Vec<Vec3>], around: bool) -> Vec<Patch> {
    let (rows, columns) = (grid.len(), grid[0].len());
    let along_u = |row: usize, column: usize| {
        let (before, after) = if around {
            ((column + columns - 1) % columns, (column + 1) % columns)
        } else {
            (column.saturating_sub(1), (column + 1).min(columns - 1))
        };
        slope(grid[row][before], grid[row][after], around || after - before == 2)
    };
    let (before, after) = (|row: usize| row.saturating_sub(1), |row: usize| (row + 1).min(rows - 1));
    let inner = |row: usize| after(row) - before(row) == 2;
    let along_v = |row: usize, column: usize| slope(grid[before(row)][column], grid[after(row)][column], inner(row));
    let twist =
        |row: usize, column: usize| slope(along_u(before(row), column), along_u(after(row), column), inner(row));
    let mut patches = Vec::new();
    for row in 0..rows - 1 {
        for column in 0..if around { columns } else { columns - 1 } {
            let control = |v: usize, u: usize| {
                let (row, column) = (row + v / 2, (column + u / 2) % columns);
                // Handles point forward from the near corner, back from the far one.
                let (u, v) = ([0.0, 1.0, -1.0, 0.0][u], [0.0, 1.0, -1.0, 0.0][v]);
                grid[row][column] + along_u(row, column) * u + along_v(row, column) * v + twist(row, column) * (u * v)
            };
            patches.push(Patch { control: std::array::from_fn(|v| std::array::from_fn(|u| control(v, u))) });
        }
    }
    patches
}

/// A third of the slope between two neighbours, which lie two steps apart or one.
fn slope(before: Vec3, after: Vec3, two_steps: bool) -> Vec3 {
    (after - before) / if two_steps { 6.0 } else { 3.0 }
}
