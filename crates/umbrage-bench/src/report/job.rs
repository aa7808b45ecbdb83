//! Rows of the whole job: a map and a million look-ups beside rays, the tree's build included. Percentage-closer filtering does not model
//! an area light: the sixteen rays go to a disc, and both means must agree, but not every region. One ray is traced through either tree, and the
//! one that takes less time for the whole job counts.

use super::rows::{Goal, Row, Settings};
use crate::look_ups::{KEY, closer, mean};
use crate::peers::rays::Tree;
use crate::raster::{first, refined};
use crate::scene::{Scene, Segments};
use crate::timing::{medians, processor_seconds};
use std::hint::black_box;
use umbrage_shadow::{DualPlane, Shadow, ShadowMap};

/// Both sizes of the scene.
pub fn whole(settings: Settings) -> Vec<Row> {
    if settings.quick {
        return of(settings, "3k", Segments::SMALL, 256).into();
    }
    let [medium, large] =
        [("75k", Segments::MEDIUM), ("1M", Segments::LARGE)].map(|(name, size)| of(settings, name, size, 1024));
    medium.into_iter().chain(large).collect()
}

fn of(settings: Settings, name: &str, segments: Segments, side: u32) -> [Row; 6] {
    let scene = Scene::new(segments, settings.picture());
    let (mesh, points, view, light) = (&scene.mesh, &scene.points, Scene::view(side), Scene::disc());
    let mut outs = vec![vec![0.0; points.len()]; 5];
    let [closer_out, auto_out, two_out, eight_out, sixteen_out] = outs.as_mut_slice() else { unreachable!("five") };
    let filter = closer(&view);
    let taken = medians(
        settings.rounds(),
        processor_seconds,
        &mut [
            &mut || ShadowMap { filter, map: first(&view, mesh).map }.fractions(points, KEY, closer_out),
            &mut || {
                let map = refined(&view, mesh).map;
                ShadowMap { filter: DualPlane::default(), map }.fractions(points, KEY, auto_out);
            },
            &mut || Tree::of_two(mesh).one_ray(points, light, two_out),
            &mut || Tree::of_eight(mesh).one_ray(points, light, eight_out),
            &mut || Tree::of_eight(mesh).sixteen_rays(points, light, sixteen_out),
            &mut || drop(black_box(first(&view, mesh))),
            &mut || drop(black_box(refined(&view, mesh))),
        ],
    );
    assert_eq!(mean(&outs[2]), mean(&outs[3]), "both trees hold the same triangles");
    let means: Vec<f64> = outs.iter().map(|out| mean(out)).collect();
    let near = |a: f64, b: f64| (a - b).abs() < 0.02;
    assert!(
        means.iter().all(|found| near(*found, means[2])),
        "mean fractions of pcf, auto, 1 ray by each tree, 16 rays: {means:?}"
    );
    let one = taken[2].min(taken[3]);
    let row = |what: &str, ours: f64, peer: &str, theirs: f64, goal| Row {
        group: "whole job",
        what: format!("{what}, {name} triangles at {side}²"),
        unit: "ms",
        ours: ours * 1e3,
        peer: peer.into(),
        theirs: theirs * 1e3,
        goal: settings.always(goal),
    };
    [
        row("bake and pcf", taken[0], "obvhs, 1 ray", one, Goal::Faster(6.0)),
        row("bake and pcf", taken[0], "obvhs, 16 rays", taken[4], Goal::Faster(60.0)),
        row("bake and auto", taken[1], "obvhs, 1 ray", one, Goal::Free),
        row("bake and auto", taken[1], "obvhs, 16 rays", taken[4], Goal::Faster(20.0)),
        row("bake alone", taken[5], "bake and pcf", taken[0], Goal::Free),
        row("bake for auto alone", taken[6], "bake and auto", taken[1], Goal::Free),
    ]
}
