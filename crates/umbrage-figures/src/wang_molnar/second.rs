//! Wang & Molnar 1994, Figures 5 and 6: where second surfaces lie, and what lies between them and the first.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{lit, of, shadow_grid, value};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel};
use crate::stage::set::Set;
use crate::stage::slices::{self, Slice, cut, disc, rectangle, stored, turned};
use glam::{DVec2, DVec3, UVec2, Vec3};
use std::sync::Arc;
use umbrage_bake::bake;
use umbrage_depth::{BackFace, DepthMap, DepthRule, First, ROW, Raw, Reduction, Second, Stored, Tiled};
use umbrage_oracle::metrics;
use umbrage_plane::{Decode, Facet, SurfacePoint};
use umbrage_raster::Cull;
use umbrage_recipe::bind;
use umbrage_render::{Frame, NOTHING, Picture, Soup};
use umbrage_report::diagram::{Diagram, Ink, Mark};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Panel, Role, Table};
use umbrage_scene::{Light, Material, Mesh, Object, Scene, gallery};
use umbrage_shadow::presets;

pub const F5: Figure = Figure {
    id: "WM94-F5",
    paper: Paper::WangMolnar94,
    title: "Where the second surface lies",
    claim: "Second surfaces face away from the light, and solids that overlap cast the shadow of their union.",
    look: "the last picture, white where the two ways to find the second surface differ.",
    make: second,
};

/// Solids, some of which overlap, with the sun to the upper left and a camera to the upper right.
fn muddle() -> anyhow::Result<Slice> {
    Slice::new(
        "muddle",
        vec![
            rectangle([-60.0, -6.0], [60.0, 0.0]),
            rectangle([-34.0, 0.0], [-20.0, 15.0]),
            disc([-20.0, 13.0], 7.5),
            turned(&rectangle([-8.0, 25.0], [14.0, 30.0]), -12.0),
            disc([10.0, 9.0], 9.0),
            rectangle([12.0, 0.0], [30.0, 6.5]),
            disc([42.0, 4.5], 4.5),
        ],
        &slices::sun(DVec2::new(-0.55, 1.0), DVec2::new(0.0, 8.0), 60.0, 1200)?,
        &slices::eye([74.0, 58.0], [-2.0, 6.0], 62.0, 1600)?,
    )
}

/// The slice with one builder's second surfaces in grey and what the camera sees in shadow in black.
fn slice_diagram(cx: &Context, title: &str, slice: &Slice, map: &Arc<Tiled>) -> Diagram {
    let by_map = slice.seen(cx, &*bind(presets::wang_molnar94().filter, map, cx.storage));
    let dark = (0..by_map.object.len()).filter(|&i| by_map.object[i] != NOTHING && by_map.shadow[0][i] >= 0.5);
    let dark: Vec<DVec2> = dark.map(|i| by_map.position[i].truncate()).collect();
    slice
        .outlined(Diagram::new(title, DVec2::new(-52.0, -8.0), DVec2::new(58.0, 38.0)))
        .named(Mark::Line(4.5), Ink::Faint, &cut(&stored(map), 0.9), "second surface from the light")
        .named(Mark::Line(2.6), Ink::Plain, &cut(&dark, 0.9), "seen by the camera, in shadow")
        .arrow(Ink::Series(1), DVec2::new(-40.0, 36.0), DVec2::new(-35.6, 28.0))
        .text_from(Ink::Plain, DVec2::new(-36.5, 33.0), "light")
        .text_to(Ink::Plain, DVec2::new(57.0, 36.0), "camera, farther this way")
}

/// Closed solids on a slab that overlap, in three dimensions.
fn union_scene() -> anyhow::Result<Scene> {
    let red = Material::plastic(Vec3::new(0.70, 0.14, 0.08));
    let grey = Material::matt(Vec3::new(0.54, 0.52, 0.48));
    let blue = Material::plastic(Vec3::new(0.12, 0.26, 0.66));
    let things = [
        ("floor", Mesh::cuboid(Vec3::new(-60.0, -10.0, -64.0), Vec3::new(60.0, 0.0, 64.0)), grey),
        ("box", Mesh::cuboid(Vec3::new(-30.0, -3.0, -12.0), Vec3::new(-8.0, 18.0, 10.0)), red),
        ("ball in the box", Mesh::sphere(Vec3::new(-9.0, 17.0, 8.0), 10.0, 96), blue),
        ("post through the box", Mesh::cylinder(Vec3::new(-38.0, 9.0, -2.0), Vec3::new(4.0, 13.0, -6.0), 3.5, 64), red),
        ("ball in the floor", Mesh::sphere(Vec3::new(24.0, 4.0, 16.0), 11.0, 96), red),
        ("slab through the ball", Mesh::cuboid(Vec3::new(14.0, -2.0, 12.0), Vec3::new(40.0, 7.0, 19.0)), blue),
    ];
    let objects = things.into_iter().map(|(name, mesh, material)| Object::solid(name, mesh, material)).collect();
    let lamp =
        Light::point("lamp", DVec3::new(-80.0, 95.0, 60.0), DVec3::new(0.0, 4.0, 0.0), 54.0, 40.0, 280.0, UVec2::ONE)?;
    let camera = umbrage_plane::View::perspective(
        DVec3::new(30.0, 62.0, 112.0),
        DVec3::new(0.0, 5.0, 4.0),
        DVec3::Y,
        44f64.to_radians(),
        10.0,
        400.0,
        UVec2::splat(512),
    )?;
    let (ambient, background) = (Vec3::splat(0.15), Vec3::new(0.02, 0.02, 0.03));
    Ok(Scene { name: "union".into(), origin: DVec3::ZERO, objects, lights: vec![lamp], ambient, background, camera })
}

/// Pixels within three of one that shows another object: where solids meet, too, a texel keeps what its neighbour does not.
fn meetings(picture: &Picture) -> Vec<bool> {
    let width = picture.size.x as usize;
    let other = |i: usize, j: usize| picture.object.get(j).is_some_and(|&object| object != picture.object[i]);
    let borders: Vec<bool> = (0..picture.object.len()).map(|i| other(i, i + 1) || other(i, i + width)).collect();
    metrics::grown(&borders, width, 3)
}

fn second(cx: &Context) -> anyhow::Result<Made> {
    let slice = muddle()?;
    let (two, back) = (slice.bake(&Second), slice.bake(&BackFace));
    let plots = vec![
        ("two-buffers".into(), slice_diagram(cx, "Second surfaces by two buffers", &slice, &two).svg()),
        ("back-faces".into(), slice_diagram(cx, "Second surfaces by back faces", &slice, &back).svg()),
    ];
    let set = Set::new(union_scene()?, cx.pick(512, 192), cx.pick(512, 192)).in_colour();
    let light = set.scene.lights[0].view;
    let soup = Soup::casters(&set.scene, &light);
    let maps = [
        bake(&light, soup.triangles(), &Second, Cull::None).map,
        bake(&light, soup.triangles(), &BackFace, Cull::Front).map,
    ];
    let raw = maps.each_ref().map(Raw::copy_of);
    let differ: Vec<f32> =
        raw[0].depths().iter().zip(raw[1].depths()).map(|(a, b)| f32::from(u8::from(a != b))).collect();
    let by = maps.each_ref().map(|map| {
        let shadow = bind(presets::wang_molnar94().filter.with_dark_backs(true), map, cx.storage);
        set.draw(cx, &*shadow, &Frame::CENTRES)
    });
    let points = set.truth_points(cx, &Frame::CENTRES);
    let far = metrics::silhouette_distance(&light, &set.scene, &points.position, 8.0);
    let unlike =
        |mask: &[bool]| (0..mask.len()).filter(|&i| mask[i] && by[0].shadow[0][i] != by[1].shadow[0][i]).count();
    let facing: Vec<bool> = points.facing[0].iter().map(|&facing| facing > 0.0).collect();
    let away: Vec<bool> = far.iter().zip(&facing).map(|(&texels, &facing)| facing && texels > 2.0).collect();
    let meet = meetings(&points);
    let away: Vec<bool> = away.iter().zip(&meet).map(|(&away, &meet)| away && !meet).collect();
    let count = |mask: &[bool]| mask.iter().filter(|inside| **inside).count() as f64;
    let panels = vec![
        Panel::rgb("full", "Solids that overlap", by[0].size, by[0].colour.clone()),
        shadow_panel("two-buffers", "Two buffers", &by[0]).with("map", set.map().view().size().x).against("truth"),
        shadow_panel("back-faces", "Back faces", &by[1]).with("map", set.map().view().size().x).against("truth"),
        truth_panel(&points),
        error_panel("error", "Two buffers minus truth", points.size, &by[0].shadow[0], &points.shadow[0]),
        error_panel("apart", "Two buffers minus back faces", points.size, &by[0].shadow[0], &by[1].shadow[0]),
        Panel::grey("maps", "White: texels in which the two maps differ", light.size(), differ.clone()).role(Role::Map),
    ];
    Ok(Made {
        panels,
        plots,
        measures: vec![
            Measure::at_least("texels in which the two maps differ", f64::from(differ.iter().sum::<f32>()), "texels", 100.0)
                .full_size(cx.quick),
            Measure::exactly("points of the union's boundary answered differently", unlike(&away) as f64, "points", 0.0),
            Measure::at_least("points asked", count(&away), "points", 1e4).full_size(cx.quick),
            Measure::info("answered differently, beside silhouettes and meetings too", unlike(&facing) as f64, "points"),
            Measure::info("of points that face the light", count(&facing), "points"),
        ],
        note: "Surfaces that face away from the light are left out: their own shading darkens them, whatever the map holds. Points lie more than two texels of \
            the map from any silhouette that the light sees, and three pixels from where solids meet: there a neighbouring texel stores a surface inside the \
            union, and two buffers store a different one from back faces."
            .into(),
        ..Made::default()
    })
}

pub const F6: Figure = Figure {
    id: "WM94-F6",
    paper: Paper::WangMolnar94,
    title: "The point of decision: first surface or second",
    claim: "At the first surface lit points lie on both sides of the decision; at the second nothing visible lies near it.",
    look: "the plots: at the first surface values crowd around zero, at the second none is near it.",
    make: decision,
};

/// The third surface of a texel, for these histograms only.
struct Third;

impl Reduction for Third {
    type Cell = [f32; 3];
    type Row = [[f32; 3]; ROW];
    const EMPTY: [f32; 3] = [f32::INFINITY; 3];
    fn add(&self, _pass: u32, cell: &mut [f32; 3], key: f32, _front: bool, _facet: &Facet) {
        let mut key = key;
        for kept in cell {
            if key < *kept {
                std::mem::swap(kept, &mut key);
            }
        }
    }
}

impl DepthRule for Third {
    fn stored(&self) -> Stored {
        Stored::Other
    }
    fn resolve(&self, cell: [f32; 3], decode: &Decode, at: DVec2) -> f32 {
        decode.depth(cell[2], at)
    }
}

/// Which surface a pixel shows, as the light counts them.
const CLASSES: [&str; 3] = ["lit: on the first surface", "turned away: on the second", "in shadow: on a later one"];

/// Pixels of each class, away from shadow edges.
fn classes(picture: &Picture, truth: &Picture, border: usize) -> [Vec<bool>; 3] {
    let whole = of(truth, |_| true);
    let dark = metrics::dark_mask(shadow_grid(truth), &truth.facing[0], border, 0.05);
    let back: Vec<bool> = picture.facing[0].iter().map(|&facing| facing < -0.05).collect();
    [lit(truth, border, |_| true), metrics::both(&back, &whole), metrics::both(&dark, &whole)]
}

/// z of the pixels in a mask less their texel's, world units; texels without a surface are left out.
fn differences(picture: &Picture, mask: &[bool], map: &Arc<Tiled>) -> Vec<f64> {
    let view = map.view();
    let inside = (0..mask.len()).filter(|&i| mask[i]);
    inside
        .filter_map(|i| {
            let seen = view.receiver(&SurfacePoint::at(picture.position[i], picture.normal[i])).ok()?;
            let stored = map.depth(seen.footprint.centre.floor().as_ivec2());
            stored.is_finite().then(|| f64::from(seen.depth - stored))
        })
        .collect()
}

const HALF: f64 = 24.0;
const BINS: usize = 96;

fn histogram(values: &[f64]) -> Vec<(f64, f64)> {
    let mut counts = vec![0u32; BINS];
    for value in values.iter().filter(|value| value.abs() < HALF) {
        counts[((value + HALF) / (2.0 * HALF) * BINS as f64) as usize] += 1;
    }
    let middle = |bin: usize| (bin as f64 + 0.5) * 2.0 * HALF / BINS as f64 - HALF;
    let share = |count: &u32| 100.0 * f64::from(*count) / values.len().max(1) as f64;
    counts.iter().enumerate().map(|(bin, count)| (middle(bin), share(count).max(0.005))).collect()
}

/// The value below which a share of them lies.
fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let index = (share * (sorted.len().max(1) - 1) as f64).round() as usize;
    sorted.get(index).copied().unwrap_or(f64::NAN)
}

fn decision(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::spot_room(), cx.pick(512, 256), 256);
    let light = *set.map().view();
    let soup = Soup::casters(&set.scene, &light);
    let maps = [
        ("first", bake(&light, soup.triangles(), &First, Cull::None).map),
        ("second", bake(&light, soup.triangles(), &BackFace, Cull::Front).map),
        ("third", bake(&light, soup.triangles(), &Third, Cull::None).map),
    ];
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let inside_cone = |i: usize| {
        let seen = light.receiver(&SurfacePoint::at(truth.position[i], truth.normal[i]));
        truth.object[i] != NOTHING && seen.is_ok_and(|seen| light.holds(seen.footprint.centre, glam::Vec2::ONE))
    };
    let inside: Vec<bool> = (0..truth.object.len()).map(inside_cone).collect();
    let classes = classes(&truth, &truth, cx.pick(6, 3)).map(|mask| metrics::both(&mask, &inside));
    let (mut plots, mut rows, mut edges) = (Vec::new(), Vec::new(), Vec::new());
    let mut near_zero = Vec::new();
    for (name, map) in &maps {
        let found = classes.each_ref().map(|mask| differences(&truth, mask, map));
        let mut plot = Plot::new(
            &format!("Decision at the {name} surface"),
            Axis::linear("depth of the point less the map's, world units"),
            Axis::log("share of the class, %"),
        );
        for (class, values) in CLASSES.iter().zip(&found) {
            plot = plot.add(Series::line(class, histogram(values)));
            let text = |share| format!("{:.3}", quantile(values, share));
            rows.push(vec![
                (*name).into(),
                (*class).into(),
                values.len().to_string(),
                text(0.001),
                text(0.01),
                text(0.5),
                text(0.99),
                text(0.999),
            ]);
        }
        plots.push((format!("at-{name}"), plot.svg()));
        edges.push([quantile(&found[0], 0.01), quantile(&found[0], 0.99), quantile(&found[2], 0.01)]);
        near_zero.push(close(&truth, &classes[0], map));
    }
    let by = |recipe: &str| set.by(cx, recipe, &Frame::CENTRES);
    let (by_first, by_second) =
        (by("reeves87,res-factor=0,min-size=0,samples=1,bias=0")?, by("wang-molnar94,virtual=never,backs=dark")?);
    let false_shadow = |picture: &Picture| value(metrics::false_shadow(&picture.shadow[0], &classes[0]));
    let measures = vec![
        Measure::at_most("first: 1 % of the lit lie below", edges[0][0], "world units", -1e-3),
        Measure::at_least("first: 1 % of the lit lie above, no gap", edges[0][1], "world units", 1e-3),
        Measure::at_most("second: the gap about 0 begins (99 % of the lit)", edges[1][1], "world units", -0.1),
        Measure::at_least("second: and ends (1 % of the shadowed)", edges[1][2], "world units", 0.1),
        Measure::at_least("lit within a depth step of the first surface", near_zero[0], "share", 0.9),
        Measure::at_most("lit within a depth step of the second", near_zero[1], "share", 0.02),
        Measure::info("false shadow without bias, decided at the first", false_shadow(&by_first), "share"),
        Measure::at_most("the same, decided at the second", false_shadow(&by_second), "share", 0.01),
    ];
    let head = ["map", "points", "number", "0.1 %", "1 %", "50 %", "99 %", "99.9 %"].map(String::from).to_vec();
    Ok(Made {
        panels: vec![
            shadow_panel("first", "Decided at the first surface, no bias", &by_first).with("map", "256²").against("truth"),
            shadow_panel("second", "Decided at the second surface, no bias", &by_second)
                .with("map", "256²")
                .against("truth"),
            truth_panel(&truth),
            error_panel("error-first", "First minus truth", truth.size, &by_first.shadow[0], &truth.shadow[0]),
            error_panel("error-second", "Second minus truth", truth.size, &by_second.shadow[0], &truth.shadow[0]),
        ],
        tables: vec![Table { name: "quantiles".into(), head, rows }],
        plots,
        measures,
        note: "Points that face away lie on the second surface itself, where the comparison can go either way; this does no harm, as their own shading is dark. \
            \
            \
            \
            \
            \
            \
            All points lie away from shadow edges and inside the cone."
            .into(),
        ..Made::default()
    })
}

/// The fraction of a mask's pixels whose depth is within their surface's own depth step of their texel's.
fn close(picture: &Picture, mask: &[bool], map: &Arc<Tiled>) -> f64 {
    let view = map.view();
    let (mut close, mut all) = (0u32, 0u32);
    for i in (0..mask.len()).filter(|&i| mask[i]) {
        let Ok(seen) = view.receiver(&SurfacePoint::at(picture.position[i], picture.normal[i])) else { continue };
        let stored = map.depth(seen.footprint.centre.floor().as_ivec2());
        all += 1;
        close += u32::from((seen.depth - stored).abs() <= seen.texel_world.max_element() * seen.slope);
    }
    f64::from(close) / f64::from(all.max(1))
}
