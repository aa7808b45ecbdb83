use crate::mesh::position_bits;
use crate::patch::{Cut, on_curve};
use crate::{Mesh, Patch};
use glam::{DVec2, DVec3, Vec3};
use std::collections::BTreeMap;
use umbrage_plane::{Projection, View};

/// Most pieces along one side of a patch. Beyond it, on patches more than a thousand texels long, pieces grow larger than a texel.
pub const MOST_PIECES: u32 = 1024;
/// Pieces along a side of a patch that is seen and reaches behind the eye, where no size can be known.
const BEHIND_PIECES: u32 = 256;

/// Cuts Bézier patches into pieces whose sides are no longer than a texel of `view` (Williams 1978), at most
/// [`MOST_PIECES`] along a side of a patch. Patches that reach behind a perspective view's eye get 256; those wholly outside the
/// view are not cut for their own sake.
///
/// A piece is a four-sided cell of the patch's u, v grid, drawn as two triangles; cells at a pole are one. Sides that
/// face each other across a patch and borders that two patches share are cut alike, and points on a border depend on
/// nothing but the border, so that neighbours meet bit for bit. A patch is a surface of its own, numbered by its index.
pub fn dice(patches: &[Patch], view: &View) -> Mesh {
    let rates = rates(patches, view);
    let mut mesh = Mesh::default();
    for (surface, (patch, rate)) in patches.iter().zip(rates).enumerate() {
        add(&mut mesh, patch, rate, surface as u32);
    }
    mesh
}

/// Pieces along u and along v.
type Rate = [u32; 2];

/// A border by its control points, the same for both directions.
type Border = [[u32; 3]; 4];

fn rates(patches: &[Patch], view: &View) -> Vec<Rate> {
    let mut ids: BTreeMap<Border, usize> = BTreeMap::new();
    let sides: Vec<[usize; 4]> = patches
        .iter()
        .map(|patch| {
            borders(patch).map(|border| {
                let next = ids.len();
                *ids.entry(canonical(border).0.map(position_bits)).or_insert(next)
            })
        })
        .collect();
    let mut leaders: Vec<usize> = (0..ids.len()).collect();
    for [low_v, high_v, low_u, high_u] in sides.iter().copied() {
        join(&mut leaders, low_v, high_v);
        join(&mut leaders, low_u, high_u);
    }
    let mut counts = vec![1; leaders.len()];
    for (patch, side) in patches.iter().zip(&sides) {
        for (border, pieces) in [(side[0], along_u(patch, view)), (side[2], along_u(&transposed(patch), view))] {
            let leader = lead(&leaders, border);
            counts[leader] = pieces.max(counts[leader]);
        }
    }
    sides.iter().map(|side| [counts[lead(&leaders, side[0])], counts[lead(&leaders, side[2])]]).collect()
}

/// The borders at v = 0, v = 1, u = 0, u = 1.
fn borders(patch: &Patch) -> [[Vec3; 4]; 4] {
    let turned = transposed(patch);
    [patch.control[0], patch.control[3], turned.control[0], turned.control[3]]
}

fn transposed(patch: &Patch) -> Patch {
    Patch { control: std::array::from_fn(|u| std::array::from_fn(|v| patch.control[v][u])) }
}

/// A border in the one of its two directions that both its patches choose, and whether that turned it round.
fn canonical(border: [Vec3; 4]) -> ([Vec3; 4], bool) {
    let [a, b, c, d] = border;
    let turned = [d, c, b, a];
    let is_turned = turned.map(position_bits) < border.map(position_bits);
    (if is_turned { turned } else { border }, is_turned)
}

/// How many pieces keep every curve of constant v within a texel a piece.
fn along_u(patch: &Patch, view: &View) -> u32 {
    if is_unseen(patch, view) {
        return 1;
    }
    let legs = patch.control.iter().flat_map(|row| row.windows(2));
    let longest = legs.fold(0f64, |most, leg| most.max((leg[1] - leg[0]).as_dvec3().length()));
    // A cubic's speed is at most three times its longest leg.
    let pieces = (3.0 * longest * texels_per_world(patch, view)).ceil();
    if pieces.is_infinite() {
        BEHIND_PIECES
    } else if pieces < f64::from(MOST_PIECES) {
        (pieces as u32).max(1)
    } else {
        MOST_PIECES
    }
}

/// Whether all control points, and so the whole patch, lie beyond one side of the view or behind its eye.
fn is_unseen(patch: &Patch, view: &View) -> bool {
    let eyes = patch.control.iter().flatten().map(|at| view.world_to_eye().transform_point3(at.as_dvec3()));
    // Distances beyond each side, in a scale of its own; for a perspective view only their signs mean anything.
    let beyond = eyes.map(|eye| match view.projection() {
        Projection::Orthographic { half, shift } => {
            let (low, high) = (half * (1.0 + shift), half * (1.0 - shift));
            [eye.x - high.x, -eye.x - low.x, eye.y - high.y, -eye.y - low.y, f64::NEG_INFINITY]
        }
        Projection::Perspective { k, shift } => {
            let at = k * eye.truncate() - shift * eye.z;
            [at.x + eye.z, eye.z - at.x, at.y + eye.z, eye.z - at.y, eye.z]
        }
    });
    let nearest = beyond.fold([f64::INFINITY; 5], |all, one| std::array::from_fn(|side| all[side].min(one[side])));
    nearest.iter().any(|distance| *distance > 0.0)
}

/// The longest image of a world unit at the patch, in texels; +∞ when it reaches behind the eye.
fn texels_per_world(patch: &Patch, view: &View) -> f64 {
    let half_size = view.size().as_dvec2() * 0.5;
    match view.projection() {
        Projection::Orthographic { half, .. } => (half_size / half).max_element(),
        Projection::Perspective { k, .. } => {
            let eyes = patch.control.iter().flatten().map(|at| view.world_to_eye().transform_point3(at.as_dvec3()));
            let (mut nearest, mut steepest) = (f64::INFINITY, 0f64);
            for eye in eyes {
                nearest = nearest.min(-eye.z);
                steepest = steepest.max((eye.truncate() / eye.z).length());
            }
            let scale: DVec2 = k * half_size;
            if nearest > 0.0 { scale.max_element() * steepest.hypot(1.0) / nearest } else { f64::INFINITY }
        }
    }
}

fn add(mesh: &mut Mesh, patch: &Patch, [columns, rows]: Rate, surface: u32) {
    let first = mesh.positions.len() as u32;
    let (borders, least) = (borders(patch).map(Curve::new), patch.least_normal());
    let along_u = |column: u32| f64::from(column) / f64::from(columns);
    let cuts: Vec<Cut> = (0..=columns).map(|column| patch.cut(along_u(column))).collect();
    for row in 0..=rows {
        let v = f64::from(row) / f64::from(rows);
        for (column, cut) in (0..=columns).zip(&cuts) {
            let at = place(&borders, [columns, rows], [column, row]).unwrap_or_else(|| cut.position(v));
            let normal = cut.normal(v, least).unwrap_or_else(|| patch.normal(along_u(column), v));
            mesh.vertex(at.as_vec3(), normal.as_vec3());
        }
    }
    let at = |column: u32, row: u32| first + row * (columns + 1) + column;
    for row in 0..rows {
        for column in 0..columns {
            mesh.quad([at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)], surface);
        }
    }
}

/// A border as both its patches see it.
struct Curve {
    control: [Vec3; 4],
    /// Whether this patch sees it the other way round.
    is_turned: bool,
    /// Whether it is the same from both ends.
    is_palindrome: bool,
}

impl Curve {
    fn new(border: [Vec3; 4]) -> Self {
        let (control, is_turned) = canonical(border);
        let bits = control.map(position_bits);
        Self { control, is_turned, is_palindrome: bits == [bits[3], bits[2], bits[1], bits[0]] }
    }

    fn at(&self, step: u32, steps: u32) -> DVec3 {
        let step = if self.is_palindrome {
            step.min(steps - step)
        } else if self.is_turned {
            steps - step
        } else {
            step
        };
        on_curve(&self.control, f64::from(step) / f64::from(steps))
    }
}

/// The point of a grid position on a border, from that border alone; `None` inside the patch.
fn place([low_v, high_v, low_u, high_u]: &[Curve; 4], [columns, rows]: Rate, [column, row]: [u32; 2]) -> Option<DVec3> {
    if row == 0 {
        Some(low_v.at(column, columns))
    } else if row == rows {
        Some(high_v.at(column, columns))
    } else if column == 0 {
        Some(low_u.at(row, rows))
    } else if column == columns {
        Some(high_u.at(row, rows))
    } else {
        None
    }
}

fn lead(leaders: &[usize], mut border: usize) -> usize {
    while leaders[border] != border {
        border = leaders[border];
    }
    border
}

fn join(leaders: &mut [usize], a: usize, b: usize) {
    let (a, b) = (lead(leaders, a), lead(leaders, b));
    leaders[a.max(b)] = a.min(b);
}
