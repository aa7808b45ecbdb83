//! Reeves, Salesin & Cook 1987, Figures 11 to 14: coloured lights, the desk lamps, the bicycle shop.

use crate::figure::{Context, Figure, Paper};
use crate::stage::lights::Stage;
use crate::stage::masks::{of, value};
use crate::stage::panels::{colour_panel, error_panel};
use glam::{DVec2, UVec2, Vec3};
use umbrage_bake::bake;
use umbrage_depth::{DepthMap, First, Raw};
use umbrage_oracle::metrics;
use umbrage_plane::View;
use umbrage_raster::Cull;
use umbrage_render::{Frame, Picture, Soup};
use umbrage_report::{Made, Measure, Panel, Role};
use umbrage_scene::gallery;

pub const F11: Figure = Figure {
    id: "R87-F11",
    paper: Paper::Reeves87,
    title: "Three coloured lights",
    claim: "Where shadows overlap, each removes its own light's colour.",
    look: "the overlaps of the shadows, where the colours of several lights are missing.",
    make: coloured,
};

/// Fractions of the picture's pixels in the eight classes of blocked lights (V22): bit i set where light i is blocked.
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
    let stage = Stage::new(gallery::three_lights(), cx.pick(1024, 256), cx.pick(1, 2))?;
    let recipe = "reeves87,bias=0.3..0.4";
    let picture = stage.shoot(cx, recipe, &Frame::default())?;
    let truth = stage.truth(cx, &Frame::default());
    let found = classes(&picture);
    let mut swapped = stage.clone();
    let colours = [swapped.scene.lights[0].colour, swapped.scene.lights[1].colour];
    (swapped.scene.lights[0].colour, swapped.scene.lights[1].colour) = (colours[1], colours[0]);
    let other = swapped.shoot(cx, recipe, &Frame::default())?;
    // Swapping the colours of two lights swaps two channels of the picture.
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
            colour_panel("swapped", "Red and green swapped", other.size, &other.colour),
            colour_panel("truth", "Ray-traced truth", truth.size, &truth.colour).role(Role::Truth),
            error_panel("error", "Mean shadow minus truth", picture.size, &grey(&picture), &grey(&truth)),
        ],
        measures,
        note: stage.warnings(),
        ..Made::default()
    })
}

/// For scenes whose bias is not the subject: Reeves' filter against the tangent plane.
const RECIPE: &str = "reeves87-recommended,depth=plane,bias=0.25";

/// Mean shadow of the casting lights, for error panels.
fn mean_shadow(stage: &Stage, picture: &Picture) -> Vec<f32> {
    let casting: Vec<usize> = (0..stage.maps.len()).filter(|&light| stage.maps[light].is_some()).collect();
    let sum = |i: usize| casting.iter().map(|&light| picture.shadow[light][i]).sum::<f32>();
    (0..picture.object.len()).map(|i| sum(i) / casting.len() as f32).collect()
}

/// Rms error of all casting lights' shadows over whole pixels.
fn error(stage: &Stage, picture: &Picture, truth: &Picture) -> f64 {
    let (ours, exact) = (mean_shadow(stage, picture), mean_shadow(stage, truth));
    value(metrics::rms(&ours, &exact, &of(truth, |_| true)))
}

/// Sizes of the casting lights' maps, largest first.
fn sides(stage: &Stage) -> Vec<u32> {
    let mut sides: Vec<u32> = stage.maps.iter().flatten().map(|map| map.view().size().x).collect();
    sides.sort_unstable_by(|a, b| b.cmp(a));
    sides
}

pub const F12: Figure = Figure {
    id: "R87-F12",
    paper: Paper::Reeves87,
    title: "Two desk lamps",
    claim: "Each of three casting lights has a map of its own size, and the floor, which is in no map, still receives shadows.",
    look: "the floor, which receives every shadow although it is in none of the maps.",
    make: desk_lamps,
};

fn desk_lamps(cx: &Context) -> anyhow::Result<Made> {
    let stage = Stage::new(gallery::desk_lamps(), cx.pick(768, 256), cx.pick(1, 4))?;
    let frame = Frame::default();
    let jittered = stage.shoot(cx, RECIPE, &frame)?;
    let uniform = stage.shoot(cx, &format!("{RECIPE},pattern=uniform"), &frame)?;
    let limit = stage.shoot(cx, &format!("{RECIPE},samples=512"), &frame)?;
    let truth = stage.truth(cx, &frame);
    let excluded = of(&truth, |id| !stage.scene.objects[id as usize].casts);
    let ground = value(metrics::mean(&mean_shadow(&stage, &jittered), &excluded));
    let noise = |picture: &Picture| error(&stage, picture, &limit);
    let sides = sides(&stage);
    let coarser = cx.pick(1, 4);
    let expected = [2048, 1024, 1024].map(|side| side / coarser);
    Ok(Made {
        panels: vec![
            colour_panel("c-jittered", "Samples placed by method (c)", jittered.size, &jittered.colour)
                .with("maps", format!("{sides:?}"))
                .against("truth"),
            colour_panel("a-uniform", "By method (a), as used for the film", uniform.size, &uniform.colour)
                .against("truth"),
            colour_panel("truth", "Ray-traced truth", truth.size, &truth.colour).role(Role::Truth),
            error_panel(
                "error",
                "(c): mean shadow minus truth",
                truth.size,
                &mean_shadow(&stage, &jittered),
                &mean_shadow(&stage, &truth),
            ),
        ],
        measures: vec![
            Measure::exactly("casting lights", sides.len() as f64, "lights", 3.0),
            Measure::yes("maps of 2048², 1024², 1024²", sides == expected),
            Measure::at_least("shadow on what is in no map", ground, "mean over lights", 0.02),
            Measure::at_most("error of (c)", error(&stage, &jittered, &truth), "rms share", 0.12),
            Measure::at_most("noise of (c) over (a)", noise(&jittered) / noise(&uniform), "ratio", 1.0),
        ],
        note: stage.warnings(),
        ..Made::default()
    })
}

pub const F13: Figure = Figure {
    id: "R87-F13",
    paper: Paper::Reeves87,
    title: "The lamps' depth maps",
    claim: "A map shows what its light sees, nearer surfaces darker; the ground is not in it.",
    look: "what is missing from the maps: the ground, which casts no shadow.",
    make: lamp_maps,
};

fn lamp_maps(cx: &Context) -> anyhow::Result<Made> {
    let stage = Stage::new(gallery::desk_lamps(), 64, cx.pick(1, 4))?;
    let mut grounded = stage.scene.clone();
    // The ground is what receives shadows and casts none.
    for object in &mut grounded.objects {
        object.casts |= object.receives;
    }
    let mut made = Made::default();
    let (mut there, mut wrong, mut unordered) = (0u64, 0u64, 0u64);
    for (light, map) in stage.scene.lights.iter().zip(&stage.maps) {
        let Some(map) = map else { continue };
        let raw = Raw::copy_of(map);
        let grey = umbrage_io::depth_view(&raw);
        let with =
            Raw::copy_of(&bake(&light.view, Soup::casters(&grounded, &light.view).triangles(), &First, Cull::None).map);
        // Where the ground is what the light would see first, there must be nothing, or what lies behind it.
        for (ours, theirs) in raw.depths().iter().zip(with.depths()) {
            there += u64::from(theirs < ours);
            wrong += u64::from(theirs < ours && ours.is_finite());
        }
        let mut order: Vec<usize> = (0..grey.len()).collect();
        order.sort_by(|&a, &b| raw.depths()[a].total_cmp(&raw.depths()[b]));
        unordered += order.windows(2).filter(|pair| grey[pair[0]] > grey[pair[1]]).count() as u64;
        let (name, size) = (&light.name, light.view.size());
        let stored = raw.depths().iter().filter(|depth| depth.is_finite()).count() as f64 / grey.len() as f64;
        let panel = Panel::rgb(name, &format!("{name}: the whole map"), size, tinted(raw.depths(), &grey));
        let panel = panel
            .with("map", format!("{}²", size.x))
            .with("texels that hold a depth", format!("{:.0} %", 100.0 * stored));
        made.panels.push(panel.role(Role::Map));
        let (size, depths) = casters_of(&light.view, raw.depths());
        let caption = format!("{name}: what it lights, enlarged, with the greys spread over its depths");
        let close = Panel::rgb(&format!("{name}-close"), &caption, size, tinted(&depths, &spread(&depths)));
        made.panels.push(close.role(Role::Map));
    }
    made.note = "Nearer is darker, as in the paper; texels that hold no depth are blue. The ground is in no map, and since most of what these \
                 lights see is ground, most of each map is empty. The dark frame of a lamp's map is the inside of its own shade. In the enlargements the greys \
                 are spread over the depths that are there, so that each grey occurs equally often; they keep the order of depths, not their distances."
        .into();
    made.measures = vec![
        Measure::at_least("texels that would show the ground", there as f64, "texels", 1000.0),
        Measure::at_most("of these with a surface behind it", wrong as f64 / there as f64, "share", 0.01),
        Measure::exactly("greys that fall as depth grows", unordered as f64, "pairs", 0.0),
    ];
    Ok(made)
}

/// Greys, and blue where no depth is stored.
fn tinted(depths: &[f32], grey: &[f32]) -> Vec<Vec3> {
    const EMPTY: Vec3 = Vec3::new(0.10, 0.19, 0.34);
    depths.iter().zip(grey).map(|(depth, grey)| if depth.is_finite() { Vec3::splat(*grey) } else { EMPTY }).collect()
}

/// Greys by rank, nearer darker: equally many texels of each.
fn spread(depths: &[f32]) -> Vec<f32> {
    const LIGHTEST: f32 = 0.8;
    let mut sorted: Vec<f32> = depths.iter().copied().filter(|depth| depth.is_finite()).collect();
    sorted.sort_unstable_by(f32::total_cmp);
    let rank = |depth: f32| sorted.partition_point(|other| *other < depth) as f32 / sorted.len().max(1) as f32;
    depths.iter().map(|&depth| if depth.is_finite() { LIGHTEST * rank(depth) } else { 1.0 }).collect()
}

/// The square of a map around what is stored well within the cone, thinned to at most 512 texels per side.
fn casters_of(view: &View, depths: &[f32]) -> (UVec2, Vec<f32>) {
    const SIDE: u32 = 512;
    let size = view.size();
    // A lamp's shade begins at the circle that its cone cuts out of the map.
    let within = |at: DVec2| (at / size.as_dvec2() * 2.0 - 1.0).length() < 0.94;
    let texel = |i: usize| UVec2::new(i as u32 % size.x, i as u32 / size.x);
    let stored = (0..depths.len()).filter(|&i| depths[i].is_finite()).map(texel).filter(|at| within(at.as_dvec2()));
    let (low, high) = stored.fold((size, UVec2::ZERO), |(low, high), at| (low.min(at), high.max(at + 1)));
    let side = (high.saturating_sub(low).max_element() * 9 / 8).clamp(1, size.min_element());
    let from = ((low + high) / 2).saturating_sub(UVec2::splat(side / 2)).min(size - side);
    let across = side.min(SIDE);
    let at = |i: u32| from + UVec2::new(i % across, i / across) * side / across;
    let thinned = (0..across * across).map(at).map(|at| depths[(at.y * size.x + at.x) as usize]).collect();
    (UVec2::splat(across), thinned)
}

pub const F14: Figure = Figure {
    id: "R87-F14",
    paper: Paper::Reeves87,
    title: "The bicycle shop",
    claim: "Two of seven lights cast shadows: subtle ones, in a complex scene.",
    look: "the spokes, and their shadows on wall and floor.",
    make: shop,
};

fn shop(cx: &Context) -> anyhow::Result<Made> {
    let stage = Stage::new(gallery::bicycle_shop(), cx.pick(1024, 256), cx.pick(1, 2))?;
    let frame = Frame::default();
    let picture = stage.shoot(cx, RECIPE, &frame)?;
    let plain = stage.plain(cx, &frame);
    let truth = stage.truth(cx, &frame);
    let triangles = Soup::all(&stage.scene, &stage.scene.camera).len();
    let brightest = plain.colour.iter().map(|c| c.max_element()).fold(0.0f32, f32::max);
    let differs = |i: usize| (picture.colour[i] - plain.colour[i]).abs().max_element() > 0.02 * brightest;
    let changed = (0..plain.colour.len()).filter(|&i| differs(i)).count() as f64 / plain.colour.len() as f64;
    Ok(Made {
        panels: vec![
            colour_panel("shop", "Seven lights", picture.size, &picture.colour)
                .with("maps", format!("{:?}", sides(&stage)))
                .with("triangles", triangles)
                .against("truth"),
            colour_panel("plain", "Without any shadow", plain.size, &plain.colour).against("truth"),
            colour_panel("truth", "Ray-traced truth", truth.size, &truth.colour).role(Role::Truth),
            error_panel(
                "error",
                "Mean shadow minus truth",
                truth.size,
                &mean_shadow(&stage, &picture),
                &mean_shadow(&stage, &truth),
            ),
        ],
        measures: vec![
            Measure::at_least("lights", stage.scene.lights.len() as f64, "lights", 7.0),
            Measure::exactly("of these casting", sides(&stage).len() as f64, "lights", 2.0),
            Measure::at_least("triangles", triangles as f64, "triangles", 200_000.0),
            Measure::at_least(
                "pixels that the shadows change by more than a fiftieth of the brightest",
                changed,
                "share",
                0.01,
            ),
            Measure::at_most("error of the shadow", error(&stage, &picture, &truth), "rms share", 0.15),
        ],
        note: stage.warnings(),
        ..Made::default()
    })
}
