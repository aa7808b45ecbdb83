use super::SLAB_THICKNESS;
use super::sculpt::skin;
use crate::{Light, Material, Mesh, Object, Patch, Scene, Shape};
use glam::{DVec3, UVec2, Vec3};
use std::f32::consts::{PI, TAU};
use umbrage_plane::View;

/// Half the mouth's width, world units.
const HALF_WIDTH: f32 = 25.0;
/// How far before the wall the mouth hangs.
const BEFORE_WALL: f32 = 34.0;
/// How high its middle hangs.
const HEIGHT: f32 = 15.0;

/// A smile and its shadow, after Williams 1978, Figure 7: lips (object 0) and two rows of teeth (objects 1, 2), all open
/// bicubic patches, hang before a flat wall (object 3) and a round column (object 4).
///
/// The sun (light 0, casting) shines from the left, so that the shadow lies beside the mouth: its left part on the wall, its right on the column. A
/// dim fill (light 1) casts none. The wall's front is z = 0 and y is up; map and picture are 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn smile() -> Scene {
    let size = UVec2::splat(1024);
    let enamel = Material { diffuse: Vec3::new(0.80, 0.77, 0.68), specular: Vec3::splat(0.18), shininess: 40.0 };
    let lip = Material { diffuse: Vec3::new(0.62, 0.06, 0.08), specular: Vec3::splat(0.30), shininess: 35.0 };
    let plaster = Material::matt(Vec3::new(0.46, 0.54, 0.58));
    let stone = Material::matt(Vec3::new(0.66, 0.57, 0.44));
    let wall = Mesh::cuboid(Vec3::new(-140.0, -120.0, -SLAB_THICKNESS), Vec3::new(180.0, 120.0, 0.0));
    let column = Mesh::cylinder(Vec3::new(29.0, -110.0, 0.0), Vec3::new(29.0, 110.0, 0.0), 14.0, Mesh::FINE);
    let sun =
        Light::directional("sun", DVec3::new(-0.45, 0.80, 0.80), DVec3::new(8.0, 0.0, 12.0), 55.0, 20.0, 360.0, size)
            .expect("a constant view is valid");
    let fill = Light::directional("fill", DVec3::new(0.7, 0.3, 1.0), DVec3::ZERO, 60.0, 20.0, 420.0, size)
        .expect("a constant view is valid");
    let camera = View::perspective(
        DVec3::new(26.0, 4.0, 165.0),
        DVec3::new(6.0, -2.0, 10.0),
        DVec3::Y,
        30f64.to_radians(),
        20.0,
        500.0,
        size,
    )
    .expect("a constant view is valid");
    Scene {
        name: "smile".into(),
        origin: DVec3::ZERO,
        objects: vec![
            Object::two_sided("lips", Shape::Patches(lips()), lip),
            Object::two_sided("upper teeth", Shape::Patches(teeth(&UPPER)), enamel),
            Object::two_sided("lower teeth", Shape::Patches(teeth(&LOWER)), enamel),
            Object::solid("wall", wall, plaster),
            Object::solid("column", column, stone),
        ],
        lights: vec![
            sun.coloured(Vec3::new(0.92, 0.87, 0.78)),
            Light { casts: false, ..fill.coloured(Vec3::new(0.10, 0.11, 0.14)) },
        ],
        ambient: Vec3::new(0.13, 0.14, 0.18),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera,
    }
}

/// The mouth's own place: a smile's line, bent upward and round the face, at a distance `x` from its middle.
fn line(x: f32) -> Vec3 {
    Vec3::new(x, HEIGHT + 0.0115 * x * x, BEFORE_WALL - 0.014 * x * x)
}

/// A band of patches around the mouth: from the skin's edge over the fullness of the lip and back in to the teeth.
fn lips() -> Vec<Patch> {
    const AROUND: u32 = 32;
    const ACROSS: u32 = 6;
    let row = |step: u32| {
        (0..AROUND).map(move |column| lip(TAU * column as f32 / AROUND as f32, step as f32 / ACROSS as f32))
    };
    let grid: Vec<Vec<Vec3>> = (0..=ACROSS).map(|step| row(step).collect()).collect();
    skin(&grid, true)
}

/// A point of the lips: `angle` around the mouth from its left corner (the viewer's right) over the upper lip, `across`
/// from the outer edge (0) to the inner one (1).
fn lip(angle: f32, across: f32) -> Vec3 {
    let (sin, cos) = angle.sin_cos();
    let open = sin.abs();
    let x = HALF_WIDTH * cos;
    let bow = 1.0 - 0.28 * (-(x / 3.4).powi(2)).exp() + 0.10 * (-((x.abs() - 6.0) / 4.0).powi(2)).exp();
    let (outer, inner, full) = if sin >= 0.0 {
        (5.8 * open.powf(0.85) * bow, 1.5 * open, 3.0)
    } else {
        (-11.4 * open.powf(0.9), -5.6 * open, 4.4)
    };
    let along = HALF_WIDTH * cos * (1.0 - 0.10 * across);
    let bulge = (PI * (0.08 + 0.92 * across)).sin() * full * (0.35 + 0.65 * open);
    let back = Vec3::new(0.0, outer + (inner - outer) * across, bulge - 2.6 * across * across);
    line(along) + back
}

/// A row of teeth, mirrored about the middle: widths from there on, and heights of their two ends on the smile's line.
struct Row {
    widths: [f32; 6],
    root: f32,
    edge: f32,
    /// How far behind the lips' line.
    behind: f32,
}

const UPPER: Row = Row { widths: [5.0, 4.2, 4.1, 3.5, 3.1, 2.6], root: 1.7, edge: -2.9, behind: 2.6 };
const LOWER: Row = Row { widths: [3.5, 3.6, 3.8, 3.6, 3.3, 2.8], root: -7.6, edge: -4.3, behind: 3.6 };

fn teeth(row: &Row) -> Vec<Patch> {
    let mut patches = Vec::new();
    let mut from = 0.0;
    for width in row.widths {
        for side in [1.0, -1.0] {
            let middle = side * (from + 0.5 * width);
            let at = |u: u8, v: u8| tooth(row, middle, width, f32::from(u) / 4.0, f32::from(v) / 4.0);
            let grid: Vec<Vec<Vec3>> = (0..=4).map(|v| (0..=4).map(|u| at(u, v)).collect()).collect();
            patches.extend(skin(&grid, false));
        }
        from += width;
    }
    patches
}

/// A point of a tooth: u across it, v from root to edge.
fn tooth(row: &Row, middle: f32, width: f32, u: f32, v: f32) -> Vec3 {
    let side = 2.0 * u - 1.0;
    // A little wider than its place, so that no light passes between neighbours.
    let x = middle + 0.51 * width * side;
    // The row closes toward the corners as the lips do.
    let open = (1.0 - (x / HALF_WIDTH).powi(2)).max(0.0).sqrt();
    let rounding = (row.root - row.edge).signum() * 0.4 * v * side.powi(4);
    let height = (row.root + (row.edge - row.root) * v + rounding) * open;
    let depth = 0.8 * (1.0 - side.powi(2)) * (1.0 - 0.5 * v * v) - row.behind;
    line(x) + Vec3::new(0.0, height, depth)
}
