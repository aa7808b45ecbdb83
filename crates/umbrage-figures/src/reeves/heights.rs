//! A limit of Reeves, Salesin & Cook 1987, shown on purpose: the width of a filtered edge does not depend on the
//! height of its caster.

use crate::figure::{Context, Figure, Paper};
use crate::stage::panels::{shadow_and_error, truth_panel};
use crate::stage::penumbra::{Edge, axial, burley_max};
use crate::stage::set::Set;
use glam::{DVec3, Vec3};
use umbrage_oracle::{metrics::Profile, predict};
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, light_map};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure};
use umbrage_scene::gallery;

pub const NOPEN: Figure = Figure {
    id: "R87-nopen",
    paper: Paper::Reeves87,
    title: "Width of an edge and height of its caster",
    claim: "Percentage-closer filtering makes all edges equally wide; an area light and Burley's filter do not.",
    look: "the edges under the low and the high caster: the filter makes them equally wide, the area light does not.",
    make: widths,
};

/// Radius of the disc-shaped light, world units.
const LIGHT: f64 = 18.0;
/// The upper edges of the two boards, which cast the shadow's edges, and the z at which each is measured.
const BOARDS: [(&str, f64, f32); 2] = [("board at height 10", 11.0, 26.0), ("board at height 40", 41.0, -26.0)];

/// The edge that a board casts on the floor; the board ends at x = 5.
fn edge(height: f64, z: f32) -> Edge {
    let x = 5.0 * 400.0 / (400.0 - height);
    Edge {
        middle: Vec3::new(x as f32, 0.0, z),
        normal: Vec3::Y,
        into_shadow: Vec3::NEG_X,
        half_width: 7.0,
        half_length: 8.0,
    }
}

fn widths(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::two_heights(), cx.pick(320, 128), 1024);
    let view = set.scene.lights[0].view;
    let floor = axial(&view, DVec3::ZERO);
    let texel = view.texel_world(floor).x;
    let max = burley_max(&view, LIGHT, floor - 26.0);
    let recipes = [
        ("pcf", "Percentage closer", "reeves87,samples=64,res-factor=0,min-size=8,bias=0.5".to_string()),
        ("burley", "Burley", format!("burley,max={max:.3}t,search=64,blur=64")),
        ("light", "Burley, radius by the light's size", format!("burley,light={LIGHT},nearest=340,search=64,blur=64")),
    ];
    let truth = set.truth_disc(cx, &Frame::CENTRES, LIGHT);
    let mut made = Made::default();
    let mut plot = Plot::new(
        "Shadow across the two edges",
        Axis::linear("distance into the shadow, texels"),
        Axis::linear("shadow"),
    );
    let mut ramps = Vec::new();
    for (name, caption, recipe) in &recipes {
        let parsed: Recipe = recipe.parse()?;
        let shadow = parsed.bind(light_map(&parsed, &set.scene, &view), cx.storage)?;
        let found = BOARDS.map(|(board, height, z)| {
            let profile = edge(height, z).profile(cx, &*shadow);
            (board, in_texels(&profile, texel), profile.width().unwrap_or(f64::NAN) / texel)
        });
        for (board, points, _) in &found {
            if *name != "light" {
                plot = plot.add(Series::line(&format!("{caption}, {board}"), points.clone()));
            }
        }
        ramps.push(found.map(|board| board.2));
        let picture = set.draw(cx, &*shadow, &Frame::CENTRES);
        shadow_and_error(&mut made, (name, caption), ("recipe", recipe), &picture, &truth);
    }
    made.panels.push(truth_panel(&truth).with("light's radius", LIGHT));
    let exact = BOARDS.map(|board| {
        predict::DISC_EDGE_10_90 * predict::expected_penumbra_width(2.0 * LIGHT, floor - board.1, floor) / texel
    });
    let [pcf, burley, light] = [0, 1, 2].map(|i: usize| ramps[i]);
    let ratio = |ramp: [f64; 2]| ramp[1] / ramp[0];
    made.measures = vec![
        Measure::within(
            "percentage closer: width at height 40 over that at 10, on the map",
            ratio(pcf),
            "ratio",
            0.9,
            1.1,
        ),
        Measure::at_least("Burley: the same", ratio(burley), "ratio", 2.5),
        Measure::at_least("Burley by the light's size: the same", ratio(light), "ratio", 2.5),
        Measure::info("area light: the same (D-16)", ratio(exact), "ratio"),
        Measure::info("percentage closer: 10–90 % width at height 10", pcf[0], "texels"),
        Measure::info(
            "percentage closer: width of its box by D-13",
            predict::ramp_width_10_90(8.0, 8.0, 0.0),
            "texels",
        ),
        Measure::info("Burley: 10–90 % width at height 10", burley[0], "texels"),
        Measure::info("Burley: 10–90 % width at height 40", burley[1], "texels"),
        Measure::info("area light: 10–90 % width at height 10 (D-16)", exact[0], "texels"),
        Measure::info("area light: 10–90 % width at height 40 (D-16)", exact[1], "texels"),
    ];
    made.plots.push(("ramps".into(), plot.svg()));
    made.note = "The paper says that its soft edges are not penumbrae, and this figure shows what that means: floor, \
        map and filter are the same for both heights."
        .into();
    Ok(made)
}

fn in_texels(profile: &Profile, texel: f64) -> Vec<(f64, f64)> {
    profile.points.iter().map(|point| (point.0 / texel, point.1)).collect()
}
