//! Rows of two threads beside one, judged only where plain work shows that the machine has two to give.

use super::rows::{Goal, Row, Settings};
use crate::in_pool;
use crate::look_ups::{KEY, closer};
use crate::raster::first;
use crate::scene::{Scene, Segments};
use crate::timing::{medians, spin, wall_seconds};
use rayon::prelude::*;
use std::hint::black_box;
use umbrage_shadow::{Shadow, ShadowMap};

/// Points that a thread takes at once.
const CHUNK: usize = 4096;

/// How well two threads spin, and the rows.
pub fn two(settings: Settings) -> (f64, Vec<Row>) {
    let (segments, side) = if settings.quick { (Segments::SMALL, 256) } else { (Segments::MEDIUM, 4096) };
    let scene = Scene::new(segments, settings.picture());
    let (points, view, mesh) = (&scene.points, Scene::view(side), &scene.mesh);
    let shadow = ShadowMap { filter: closer(&view), map: first(&view, mesh).map };
    let bake = || drop(black_box(first(&view, mesh)));
    let look = || {
        let mut out = vec![0.0; points.len()];
        let chunks = points.par_chunks(CHUNK).zip(out.par_chunks_mut(CHUNK));
        chunks.for_each(|(points, out)| shadow.fractions(points, KEY, out));
        black_box(out);
    };
    let before = spin(settings.rounds(), if settings.quick { 1_000_000 } else { 50_000_000 });
    let taken = medians(
        settings.rounds(),
        wall_seconds,
        &mut [&mut || in_pool(1, bake), &mut || in_pool(2, bake), &mut || in_pool(1, look), &mut || in_pool(2, look)],
    );
    let after = spin(settings.rounds(), if settings.quick { 1_000_000 } else { 50_000_000 });
    let spin = before.min(after);
    let goal = if spin >= 1.9 { settings.always(Goal::Faster(1.7)) } else { Goal::Free };
    let row = |what: &str, two: f64, one: f64| Row {
        group: "threads",
        what: format!("{what}, two threads at {side}²"),
        unit: "ms",
        ours: two * 1e3,
        peer: "one thread".into(),
        theirs: one * 1e3,
        goal,
    };
    (spin, vec![row("bake the knot", taken[1], taken[0]), row("pcf-bias tiled", taken[3], taken[2])])
}
