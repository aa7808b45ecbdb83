//! Reeves, Salesin & Cook 1987, Figure 11: three coloured lights.

use super::studio::{Stage, colour_panel, error_panel, of};
use crate::figure::{Context, Figure, Made, Measure, Paper, Role};
use umbrage_render::{Frame, Picture};
use umbrage_scene::gallery;

pub const F11: Figure = Figure {
    id: "R87-F11",
    paper: Paper::Reeves87,
    title: "Three coloured lights",
    claim: "Where shadows overlap, colours are left out one by one.",
    make: coloured,
};

/// Shares of the picture's pixels in the eight classes of blocked lights (V22): bit i set where light i is blocked.
fn classes(picture: &Picture) -> [f64; 8] {
    let mut counts = [0u32; 8];
    let whole = of(picture, |_| true);
    for i in (0..whole.len()).filter(|&i| whole[i]) {
        let class = (0..3).map(|light| usize::from(picture.shadow[light][i] > 0.5) << light).sum::<usize>();
        counts[class] += 1;
    }
    counts.map(|count| f64::from(count) / whole.len() as f64)
}

fn coloured(cx: &Context) -> anyhow::Result<Made> {
    let stage = Stage::new(gallery::three_lights(), cx.pick(1024, 256), cx.pick(1, 2));
    let recipe = "reeves87,bias=0.3..0.4";
    let picture = stage.shoot(cx, recipe, &Frame::default())?;
    let truth = stage.truth(cx, &Frame::default());
    let found = classes(&picture);
    let mut swapped = Stage { scene: stage.scene.clone(), maps: stage.maps.clone() };
    let colours = [swapped.scene.lights[0].colour, swapped.scene.lights[1].colour];
    (swapped.scene.lights[0].colour, swapped.scene.lights[1].colour) = (colours[1], colours[0]);
    let other = swapped.shoot(cx, recipe, &Frame::default())?;
    // Exchanging the colours of two lights exchanges two channels of the picture.
    let exchanged = |i: usize| {
        let (a, b) = (picture.colour[i], other.colour[i]);
        (a.x - b.y).abs().max((a.y - b.x).abs()).max((a.z - b.z).abs())
    };
    let worst = (0..picture.colour.len()).map(exchanged).fold(0.0f32, f32::max);
    let names = ["none", "red", "green", "red, green", "blue", "red, blue", "green, blue", "all"];
    let mut measures = vec![
        Measure::at_least(
            "classes of blocked lights on more than .1 % of the pixels (M12)",
            found.iter().filter(|share| **share > 0.001).count() as f64,
            "classes",
            6.0,
        ),
        Measure::at_most("swapping two colours: channels that are not swapped", f64::from(worst), "", 1e-5),
    ];
    for (name, share) in names.into_iter().zip(found) {
        measures.push(Measure::info(&format!("blocked: {name}"), share, "share of pixels"));
    }
    let grey = |picture: &Picture| -> Vec<f32> {
        (0..picture.shadow[0].len()).map(|i| (0..3).map(|l| picture.shadow[l][i]).sum::<f32>() / 3.0).collect()
    };
    Ok(Made {
        panels: vec![
            colour_panel("shaded", "Red, green and blue light", picture.size, &picture.colour)
                .with("maps", format!("3 × {}²", cx.pick(1024, 512)))
                .with("bias", "0.3–0.4")
                .against("truth"),
            colour_panel("swapped", "Red and green exchanged", other.size, &other.colour),
            colour_panel("truth", "Ray-traced truth", truth.size, &truth.colour).role(Role::Truth),
            error_panel("error", "Mean shadow less truth", picture.size, &grey(&picture), &grey(&truth)),
        ],
        measures,
        ..Made::default()
    })
}
