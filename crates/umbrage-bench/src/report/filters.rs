//! Rows of look-ups: every filter beside the listing, beside plain percentage closer, or beside itself over another storage.

use super::rows::{Goal, Row, Settings};
use crate::look_ups::{all, depths, mean};
use crate::peers::listing;
use crate::raster::{facets, first};
use crate::scene::{HALF, Scene, Segments, bias};
use crate::timing::{medians, processor_seconds};
use std::cell::RefCell;
use std::hint::black_box;
use umbrage_depth::Raw;
use umbrage_plane::Place;

/// How far the mean fraction of any filter may lie from the listing's: they look at regions of several sizes, and are wrong in ways
/// of their own where the tube curves away.
const FAR: f64 = 0.03;

/// The same for what does as the listing does, with other random numbers.
const SAME: f64 = 0.002;

/// What a look-up is measured from.
const FROM: [&str; 2] = ["", ", without transform"];

/// Points that look-ups bring into the light's space together.
const TOGETHER: usize = 16;

/// All look-ups in maps of one size.
pub fn look_ups(settings: Settings, side: u32) -> Vec<Row> {
    let segments = if settings.quick { Segments::SMALL } else { Segments::MEDIUM };
    let scene = Scene::new(segments, settings.picture());
    let (points, view) = (&scene.points, Scene::view(side));
    let receivers = scene.receivers(&view);
    let places = listing::places(&receivers, side);
    let mesh = &scene.mesh;
    let (tiled, of_facets) = (first(&view, mesh).map, facets(&view, mesh).map);
    let map = Raw::copy_of(&tiled);
    let look_ups = all(&scene, &view);

    let mut theirs = vec![0.0; points.len()];
    listing::fractions(&map, &places, HALF, bias(&view), &mut theirs);
    listing::assert_as_printed(&map, &places, HALF, bias(&view), &theirs);
    let dark = mean(&theirs);
    assert!((0.05..0.5).contains(&dark), "the listing finds {dark} in shadow");
    let (mut of_points, mut of_receivers) = (theirs.clone(), theirs.clone());
    for look_up in &look_ups {
        look_up.of_points(points, &mut of_points);
        look_up.of_receivers(&receivers, &mut of_receivers);
        assert_eq!(of_points, of_receivers, "{look_up:?}: the transform is that of the receivers");
        let found = mean(&of_points);
        let far = if matches!(look_up.filter, "pcf-bias" | "pcf-table") { SAME } else { FAR };
        assert!((found - dark).abs() < far, "{look_up:?} finds {found} in shadow, the listing {dark}");
    }

    depths(&map, &receivers, &mut of_points);
    depths(&tiled, &receivers, &mut of_receivers);
    assert_eq!(of_points, of_receivers, "the depths of tiles are those of an array");
    depths(&of_facets, &receivers, &mut of_receivers);
    assert_eq!(of_points, of_receivers, "the depths of facets are those of an array");

    let mut seen = [Err(Place::Behind); TOGETHER];
    let out = RefCell::new(of_points);
    let mut listed = || listing::fractions(&map, black_box(&places), HALF, bias(&view), &mut out.borrow_mut());
    // As a plain bias wants them.
    let mut transform = || {
        for points in points.chunks(TOGETHER) {
            view.receivers_for(black_box(points), false, &mut seen[..points.len()]);
            black_box(&seen);
        }
    };
    let mut ours: Vec<Box<dyn FnMut() + '_>> = Vec::new();
    for look_up in &look_ups {
        ours.push(Box::new(|| look_up.of_points(black_box(points), &mut out.borrow_mut())));
        ours.push(Box::new(|| look_up.of_receivers(black_box(&receivers), &mut out.borrow_mut())));
    }
    let mut raw_alone = || depths(&map, black_box(&receivers), &mut out.borrow_mut());
    let mut tiled_alone = || depths(&tiled, black_box(&receivers), &mut out.borrow_mut());
    let mut facets_alone = || depths(&of_facets, black_box(&receivers), &mut out.borrow_mut());
    let mut ways: Vec<&mut dyn FnMut()> = vec![&mut listed, &mut transform];
    ways.extend(ours.iter_mut().map(|way| &mut **way as &mut dyn FnMut()));
    ways.extend([&mut raw_alone as &mut dyn FnMut(), &mut tiled_alone, &mut facets_alone]);
    let taken = medians(settings.rounds(), processor_seconds, &mut ways);

    let each = |seconds: f64| seconds * 1e9 / points.len() as f64;
    let (listing, closer) = (taken[0], [taken[2], taken[3]]);
    let row = |what: String, ours: f64, peer: String, theirs: f64, goal| Row {
        group: "look-ups",
        what: format!("{what} at {side}²"),
        unit: "ns",
        ours: each(ours),
        peer,
        theirs: each(theirs),
        goal,
    };
    let mut rows = vec![row("transform alone".into(), taken[1], "listing".into(), listing, Goal::Free)];
    for (storage, alone) in ["raw", "tiled", "facets"].into_iter().zip(&taken[taken.len() - 3..]) {
        let what = format!("sixteen depths alone, {storage}");
        rows.push(row(what, *alone, "pcf-bias raw, without transform".into(), closer[1], Goal::Free));
    }
    for (index, look_up) in look_ups.iter().enumerate() {
        for (from, name) in FROM.into_iter().enumerate() {
            let ours = taken[2 + 2 * index + from];
            let what = format!("{} {}{name}", look_up.filter, look_up.storage);
            let with = |goal| if from == 0 { settings.always(goal) } else { Goal::Free };
            let (peer, theirs, goal) = match (look_up.filter, look_up.storage) {
                ("pcf-bias", "raw") if from == 0 => ("listing", listing, settings.always(Goal::Faster(5.0))),
                ("pcf-bias", "raw") => {
                    let least = if side == 4096 { 5.0 } else { 8.0 };
                    ("listing", listing, settings.always(Goal::Faster(least)))
                }
                (_, "tiled") => ("raw", taken[2 + 2 * (index - 1) + from], settings.always(Goal::Within(1.15))),
                ("pcf-bias", "facets") => {
                    ("tiled", taken[2 + 2 * (index - 1) + from], settings.always(Goal::Within(1.3)))
                }
                ("pcf-plane" | "pcf-cone" | "wang-molnar94", _) => {
                    ("pcf-bias raw", closer[from], with(Goal::Within(1.5)))
                }
                ("woo92", _) => ("pcf-bias raw", closer[from], with(Goal::Within(1.1))),
                ("auto", _) => ("pcf-bias raw", closer[from], with(Goal::Within(2.0))),
                ("burley", _) => ("listing", listing, with(Goal::Within(1.5))),
                _ => ("pcf-bias raw", closer[from], Goal::Free),
            };
            rows.push(row(what, ours, peer.into(), theirs, goal));
        }
    }
    rows
}
