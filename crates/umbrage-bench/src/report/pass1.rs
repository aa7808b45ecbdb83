//! Rows of pass 1: the rasteriser beside `euc` and the memory's limit, and depth rules beside one another.

use super::rows::{Goal, Row, Settings};
use crate::peers::memory::clear_and_min;
use crate::peers::software::Software;
use crate::raster::{Workload, facets, first, first_one_by_one, midpoint, refined, second};
use crate::scene::Segments;
use crate::timing::{medians, processor_seconds};
use std::hint::black_box;
use umbrage_depth::{DepthMap, Raw};

/// How two goals go with a workload: beside `euc`, and beside the limit.
struct Goals {
    software: Goal,
    limit: Goal,
}

/// Pass 1 of each mesh.
pub fn raster(settings: Settings, side: u32) -> Vec<Row> {
    let free = Goals { software: Goal::Free, limit: Goal::Free };
    let large = side == 4096;
    let of_layers = || Goals {
        software: settings.goal(Goal::Faster(10.0), Goal::Faster(3.0)),
        limit: if large { settings.always(Goal::Within(3.0)) } else { Goal::Free },
    };
    let of_hundred = Goals { software: settings.goal(Goal::Faster(8.0), Goal::Faster(3.0)), limit: Goal::Free };
    let of_tiny = Goals { software: settings.always(Goal::Faster(8.0)), limit: Goal::Free };
    let limit = if large { settings.always(Goal::Within(4.0)) } else { Goal::Free };
    let of_knot = Goals { software: Goal::Free, limit };
    let mut rows = Vec::new();
    let mut add = |workload: Workload, goals: Goals| rows.extend(beside(settings, &workload, &goals));
    add(Workload::back_to_front(side), of_layers());
    add(Workload::front_to_back(side), of_layers());
    if settings.quick {
        add(Workload::hundred(400, side), of_hundred);
        add(Workload::tiny(100, side), of_tiny);
        add(Workload::knot("knot-3k", Segments::SMALL, side), of_knot);
    } else {
        add(Workload::hundred(10_000, side), of_hundred);
        add(Workload::tiny(724, side), of_tiny);
        add(Workload::knot("knot-75k", Segments::MEDIUM, side), of_knot);
        add(Workload::knot("knot-1M", Segments::LARGE, side), free);
    }
    rows
}

/// One mesh beside both peers.
fn beside(settings: Settings, workload: &Workload, goals: &Goals) -> [Row; 4] {
    let baked = workload.checked();
    let (view, triangles) = (&workload.view, workload.mesh.one_by_one());
    assert!(first_one_by_one(view, &triangles).map == baked.map, "a mesh is its triangles");
    let layers = workload.limit_layers(&baked);
    let mut software = Software::new(&workload.view);
    software.draw(&workload.mesh);
    workload.assert_drawn(&baked, &software);
    let mut buffer = vec![0.0; workload.side as usize * workload.side as usize];
    let taken = medians(
        settings.rounds(),
        processor_seconds,
        &mut [
            &mut || drop(black_box(workload.first())),
            &mut || software.draw(black_box(&workload.mesh)),
            &mut || {
                clear_and_min(&mut buffer, layers);
            },
            &mut || drop(black_box(workload.binned())),
            &mut || drop(black_box(first_one_by_one(view, &triangles))),
        ],
    );
    let row = |part: &str, ours: f64, peer: String, theirs: f64, goal| Row {
        group: "pass 1",
        what: format!("{}{part} at {}²", workload.name, workload.side),
        unit: "ms",
        ours: ours * 1e3,
        peer,
        theirs: theirs * 1e3,
        goal,
    };
    [
        row("", taken[0], "euc".into(), taken[1], goals.software),
        row(
            "",
            taken[0],
            format!("memory, {layers} layer{}", if layers == 1 { "" } else { "s" }),
            taken[2],
            goals.limit,
        ),
        row(", set up and binned alone", taken[3], "all of it".into(), taken[0], Goal::Free),
        row("", taken[0], "its triangles one by one".into(), taken[4], Goal::Free),
    ]
}

/// Other surfaces than the nearest, and facets, of a knot.
pub fn rules(settings: Settings, side: u32) -> Vec<Row> {
    let segments = if settings.quick { Segments::SMALL } else { Segments::MEDIUM };
    let knot = Workload::knot("knot", segments, side);
    let (view, mesh) = (&knot.view, &knot.mesh);
    let kept = [facets(view, mesh).map.allocated(), refined(view, mesh).map.allocated()];
    let raw = Raw::copy_of(&first(view, mesh).map).allocated();
    let same = Raw::copy_of(&facets(view, mesh).map) == Raw::copy_of(&first(view, mesh).map);
    assert!(same, "a map of facets has the depths of the nearest surface");
    let taken = medians(
        settings.rounds(),
        processor_seconds,
        &mut [
            &mut || drop(black_box(first(view, mesh))),
            &mut || drop(black_box(second(view, mesh))),
            &mut || drop(black_box(midpoint(view, mesh))),
            &mut || drop(black_box(facets(view, mesh))),
            &mut || drop(black_box(refined(view, mesh))),
        ],
    );
    let row = |what: &str, ours: f64, peer: &str, theirs: f64, goal| Row {
        group: "pass 1",
        what: format!("{what}, knot at {side}²"),
        unit: "ms",
        ours: ours * 1e3,
        peer: peer.into(),
        theirs: theirs * 1e3,
        goal: settings.always(goal),
    };
    let size = |what: &str, bytes: usize| Row {
        group: "memory",
        what: format!("{what}, knot at {side}²"),
        unit: "KiB",
        ours: bytes as f64 / 1024.0,
        peer: "raw map".into(),
        theirs: raw as f64 / 1024.0,
        goal: Goal::Free,
    };
    vec![
        row("second depth", taken[1], "first depth", taken[0], Goal::Within(1.4)),
        row("midpoint", taken[2], "first depth", taken[0], Goal::Within(1.4)),
        row("facets", taken[3], "second depth", taken[1], Goal::Within(6.0)),
        row("refined facets", taken[4], "second depth", taken[1], Goal::Within(6.0)),
        size("facets", kept[0]),
        size("refined facets", kept[1]),
    ]
}
