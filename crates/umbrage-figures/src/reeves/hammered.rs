//! A floor of hammered metal that reaches to the horizon, with highlights computed before filtering and after.

use crate::figure::Context;
use crate::stage::panels::{error_panel, zoomed_colour};
use glam::{DVec2, UVec2, Vec2, Vec3};
use rayon::prelude::*;
use umbrage_plane::{Footprint, mix32};
use umbrage_report::{Panel, Role};
use umbrage_sample::{Jittered, Key, Pattern};
use umbrage_shadow::weighted_mean;

const EXPONENT: f32 = 10.0;

/// Blinn's highlight of a normal.
pub(super) fn highlight(normal: Vec3, half: Vec3) -> f32 {
    normal.dot(half).max(0.0).powf(EXPONENT)
}

/// Toward the light, low behind the floor, and half-way from there to an eye that is far away.
const LIGHT: Vec3 = Vec3::new(0.56, 0.75, 0.35);
const HALF: Vec3 = Vec3::new(0.42, 0.64, 0.643);
/// The metal: its diffuse and its specular colour.
const MATT: Vec3 = Vec3::new(0.22, 0.085, 0.035);
const SHINE: Vec3 = Vec3::new(1.6, 0.95, 0.6);

/// The unit normal of the floor at a place, z up: in every unit square one round dome or dent of its own size.
fn normal(at: Vec2) -> Vec3 {
    let cell = at.floor();
    let hash = mix32(mix32(cell.x as i32 as u32).wrapping_add(cell.y as i32 as u32));
    let random = |byte: u32| (hash >> (8 * byte) & 255) as f32 / 255.0;
    let radius = 0.34 + 0.14 * random(0);
    let room = 0.5 - radius;
    let middle = 0.5 + room * (2.0 * Vec2::new(random(1), random(2)) - 1.0);
    let out = (at - cell - middle) / radius;
    if out.length_squared() >= 1.0 {
        return Vec3::Z;
    }
    // A cap of a sphere whose rim is this steep; a dent is the same turned over.
    let steep = 0.93 * if random(3) < 0.35 { -out } else { out };
    steep.extend((1.0 - steep.length_squared()).sqrt())
}

/// The light that a normal sends to the eye.
fn shaded(normal: Vec3) -> Vec3 {
    MATT * (0.25 + normal.dot(LIGHT).max(0.0)) + SHINE * highlight(normal, HALF.normalize())
}

/// Each normal's own shading, then the mean.
fn first(pattern: &impl Pattern, region: &Footprint, key: Key) -> Vec3 {
    weighted_mean(pattern, region, key, |tap| shaded(normal(tap.at)))
}

/// The part of the floor that a pixel of the picture covers. Rows go from near the horizon down to the viewer's feet.
fn footprint(pixel: UVec2, size: UVec2) -> Footprint {
    let ground = |x: f32, y: f32| {
        let distance = 4.5 / (0.01 + y / size.y as f32);
        Vec2::new((x / size.x as f32 - 0.5) * distance * 1.6, distance * 3.0)
    };
    let at = pixel.as_vec2();
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| ground(at.x + x, at.y + y));
    Footprint::around(corners)
}

/// The picture by each order, the truth, and what is far away enlarged.
pub(super) fn panels(cx: &Context) -> Vec<Panel> {
    let size = UVec2::splat(cx.pick(384, 128));
    let draw = |f: &(dyn Fn(&Footprint, Key) -> Vec3 + Sync)| -> Vec<Vec3> {
        let one = |i: u32| f(&footprint(UVec2::new(i % size.x, i / size.x), size), Key::new(cx.seed, 0, 1).region(i));
        (0..size.x * size.y).into_par_iter().map(one).collect()
    };
    let few = Jittered::default();
    let many = few.with_num_samples(1024);
    let transformed = draw(&|region, key| first(&few, region, key));
    let truth = draw(&|region, key| first(&many, region, key));
    let filtered = draw(&|region, key| {
        let mean: Vec3 = weighted_mean(&few, region, key, |tap| normal(tap.at));
        shaded(mean.normalize_or(Vec3::Z))
    });
    let (far, part) = (DVec2::new(0.5, 0.13), 4);
    let grey = |pixels: &[Vec3]| -> Vec<f32> { pixels.iter().map(|pixel| pixel.element_sum() / 3.0).collect() };
    let panel = |name: &str, caption: &str, pixels: &[Vec3]| {
        Panel::rgb(name, caption, size, pixels.to_vec()).with("exponent", EXPONENT)
    };
    let enlarged = |name: &str, caption: &str, pixels: &[Vec3]| {
        zoomed_colour(&format!("{name}-far"), &format!("{caption}, far end"), size, pixels, far, part)
    };
    vec![
        panel("transformed-first", "Highlights, then filtered: 16 samples", &transformed).against("truth"),
        panel("filtered-first", "Normals filtered, then their highlight", &filtered).against("truth"),
        panel("truth", "1,024 samples", &truth).role(Role::Truth),
        enlarged("transformed-first", "Highlights, then filtered", &transformed),
        enlarged("filtered-first", "Normals filtered first", &filtered),
        enlarged("truth", "1,024 samples", &truth).role(Role::Truth),
        error_panel("error", "Normals filtered first, minus truth", size, &grey(&truth), &grey(&filtered)),
    ]
}
