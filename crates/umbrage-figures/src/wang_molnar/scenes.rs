//! Wang & Molnar 1994, Figures 13 to 15: pipes, a hall, a bowling alley.

use super::table::{SECOND, SHADED};
use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{acne, leak, of, shadow_grid};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel, zoomed, zoomed_error};
use crate::stage::set::Set;
use glam::DVec2;
use std::sync::Arc;
use umbrage_oracle::metrics;
use umbrage_render::{Frame, Picture};
use umbrage_report::{Made, Measure, Panel, Role, Table};
use umbrage_scene::gallery;

/// Four samples per pixel at fixed places, shaded once per surface.
const FRAME: Frame = Frame { axis: 2, ..Frame::CENTRES };

/// A scene by the paper's algorithm, solids' backs dark as their shading makes them; a sheet may be seen from either side.
fn second(cx: &Context, set: &Set) -> anyhow::Result<Picture> {
    let mut picture = set.by(cx, SHADED, &FRAME)?;
    let sheet = |id: u32| set.scene.objects.get(id as usize).is_some_and(|object| !object.solid);
    if set.scene.objects.iter().any(|object| !object.solid) {
        let plain = set.by(cx, SECOND, &FRAME)?;
        for i in (0..picture.object.len()).filter(|&i| sheet(picture.object[i])) {
            (picture.shadow[0][i], picture.colour[i]) = (plain.shadow[0][i], plain.colour[i]);
        }
    }
    Ok(picture)
}

/// A scene by the paper's algorithm without a bias, and truth at the same points.
struct Still {
    picture: Picture,
    truth: Arc<Picture>,
    border: usize,
}

impl Still {
    /// `border` is what belongs to truth's edges, pixels: the nearest four texels and one more.
    fn new(cx: &Context, set: &Set, border: usize) -> anyhow::Result<Self> {
        let picture = second(cx, set)?;
        Ok(Self { picture, truth: set.truth_points(cx, &FRAME), border })
    }

    /// False shadow on what `keep` accepts (M2).
    fn acne(&self, keep: impl Fn(u32) -> bool) -> f64 {
        acne(&self.picture, &self.truth, self.border, keep)
    }

    fn leak(&self) -> f64 {
        leak(&self.picture, &self.truth, self.border)
    }

    /// Pixels that are wrong by more than ½.
    fn wrong(&self) -> Vec<bool> {
        self.picture.shadow[0]
            .iter()
            .zip(&self.truth.shadow[0])
            .map(|(ours, exact)| (ours - exact).abs() > 0.5)
            .collect()
    }

    /// Whole picture, shadow, truth and error; `tag` goes before their names.
    fn panels(&self, tag: &str, caption: &str) -> Vec<Panel> {
        let Self { picture, truth, .. } = self;
        let size = picture.size;
        let name = |what: &str| format!("{tag}{what}");
        vec![
            Panel::rgb(&name("full"), caption, size, picture.colour.clone()).with("bias", "none"),
            shadow_panel(&name("shadow"), &format!("{caption}: shadow alone"), picture).against(&name("truth")),
            Panel { name: name("truth"), ..truth_panel(truth) },
            error_panel(&name("error"), &format!("{caption}, minus truth"), size, &picture.shadow[0], &truth.shadow[0]),
        ]
    }

    /// Two windows side by side: what the method makes of a part of the picture, and its error there.
    fn window(&self, name: &str, caption: &str, centre: DVec2) -> [Panel; 3] {
        let (error, truth) = (format!("{caption}, minus truth"), format!("{name}-truth"));
        [
            zoomed(name, caption, &self.picture, centre, 6).against(&truth),
            zoomed(&truth, &format!("{caption}, ray-traced"), &self.truth, centre, 6).role(Role::Truth),
            zoomed_error(&format!("{name}-error"), &error, &self.picture, &self.truth, centre, 6),
        ]
    }
}

pub const F13: Figure = Figure {
    id: "WM94-F13",
    paper: Paper::WangMolnar94,
    title: "Pipes",
    claim: "Densely packed curved solids cast right shadows on one another, with no bias to set.",
    look: "the pipes' own shadows on one another, without a stripe.",
    make: pipes,
};

fn pipes(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::pipes(), cx.pick(1024, 384), 512).in_colour();
    let still = Still::new(cx, &set, cx.pick(6, 3))?;
    let mut panels = still.panels("", "Pipes, 512² map");
    panels.extend(still.window("middle", "Among the pipes", DVec2::new(0.5, 0.55)));
    let at_edges = acne(&still.picture, &still.truth, 0, |_| true);
    Ok(Made {
        panels,
        measures: vec![
            Measure::at_least("straight pieces of pipe", gallery::pipe_segments() as f64, "pieces", 200.0),
            Measure::at_most("false shadow (M2)", still.acne(|_| true), "share", 0.02),
            Measure::info("the same up to truth's edges", at_edges, "share"),
            Measure::info("leak (M8)", still.leak(), "share"),
        ],
        ..Made::default()
    })
}

pub const F14: Figure = Figure {
    id: "WM94-F14",
    paper: Paper::WangMolnar94,
    title: "A walk through a building",
    claim: "One routine without a bias serves large and thin polygons, solids and sheets together.",
    look: "the mullions, the paper screen and the leaves: thick, thin and flat casters, all handled by one routine.",
    make: hall,
};

fn hall(cx: &Context) -> anyhow::Result<Made> {
    let texels = cx.pick(2048, 1024);
    let set = Set::new(gallery::walkthrough(), cx.pick(1024, 384), texels).in_colour();
    // A pixel is about a texel here, and the filter two.
    let still = Still::new(cx, &set, 2)?;
    let objects = &set.scene.objects;
    let wrong = still.wrong();
    let edges = metrics::edge_mask(shadow_grid(&still.truth), still.border);
    let count = |mask: &[bool]| mask.iter().filter(|&&inside| inside).count();
    let away = wrong.iter().zip(&edges).filter(|(wrong, edge)| **wrong && !**edge).count();
    let row = |id: usize| {
        let on = of(&still.truth, |seen| seen as usize == id);
        let (all, bad) = (count(&on), metrics::both(&wrong, &on));
        let at_edges = count(&metrics::both(&bad, &edges));
        let kind = if objects[id].solid { "solid" } else { "sheet" };
        let numbers = [all, at_edges, count(&bad) - at_edges].map(|n| n.to_string());
        [objects[id].name.clone(), kind.to_string()].into_iter().chain(numbers).collect()
    };
    let head = ["object", "kind", "pixels", "wrong by over ½ near truth's edges", "elsewhere"];
    let mut panels = still.panels("", &format!("The hall, {texels}² map"));
    panels.extend(still.window("floor", "Sun through the mullions", DVec2::new(0.28, 0.76)));
    panels.extend(still.window("leaves", "Paper screen and leaves", DVec2::new(0.22, 0.55)));
    let on_sheets = acne(&still.picture, &still.truth, 1, |id| !objects[id as usize].solid);
    Ok(Made {
        panels,
        measures: vec![
            Measure::at_most("false shadow (M2)", still.acne(|_| true), "share", 0.02),
            Measure::info("false shadow on sheets, up to a pixel from truth's edges", on_sheets, "share"),
            Measure::info(
                "the same on solids",
                acne(&still.picture, &still.truth, 1, |id| objects[id as usize].solid),
                "share",
            ),
            Measure::info("leak (M8)", still.leak(), "share"),
            Measure::info("pixels wrong by more than ½", count(&wrong) as f64, "px"),
            Measure::info("those of them that are not near truth's edges", away as f64, "px"),
        ],
        tables: vec![Table {
            name: "by-object".into(),
            head: head.map(String::from).to_vec(),
            rows: (0..objects.len()).map(row).collect(),
        }],
        note: "What is left is stair-steps along the edges of shadows, false shadow on the leaves, which are curved sheets, and broken lines of \
               light one texel wide where beams meet the ceiling, whose underside is the second surface there and touches them."
            .into(),
        ..Made::default()
    })
}

pub const F15: Figure = Figure {
    id: "WM94-F15",
    paper: Paper::WangMolnar94,
    title: "Bowling",
    claim: "In a sequence without a bias, nothing flickers that does not move.",
    look: "what stays at rest from frame to frame: its shadows do not change.",
    make: bowling,
};

/// A frame of the alley.
fn alley(cx: &Context, number: u32) -> Set {
    let mut scene = gallery::bowling(number);
    scene.name = format!("bowling, frame {number}");
    Set::new(scene, cx.pick(640, 320), 512).in_colour()
}

/// Pixels at which, and within `border` pixels of which, neither the surface nor its true shadow changes from one frame to the other, all on
/// objects that stay where they are.
fn steady(a: &Picture, b: &Picture, border: usize) -> Vec<bool> {
    /// Objects from here on move.
    const MOVING: u32 = 4;
    let same = |i: usize| {
        let rests = |picture: &Picture| picture.object[i] < MOVING && picture.share[i] == 1.0;
        rests(a) && rests(b) && a.position[i] == b.position[i] && a.shadow[0][i] == b.shadow[0][i]
    };
    let changed: Vec<bool> = (0..a.object.len()).map(|i| !same(i)).collect();
    metrics::grown(&changed, a.size.x as usize, border).into_iter().map(|changed| !changed).collect()
}

/// Largest change of shadow between two pictures over a mask.
fn flicker(a: &Picture, b: &Picture, mask: &[bool]) -> f64 {
    let changes = a.shadow[0].iter().zip(&b.shadow[0]).zip(mask).filter(|(_, inside)| **inside);
    changes.map(|((a, b), _)| f64::from((a - b).abs())).fold(0.0, f64::max)
}

fn bowling(cx: &Context) -> anyhow::Result<Made> {
    let numbers: &[u32] = cx.pick(&[0, 8, 9, 12, 13, 16, 24], &[8, 12, 13]);
    let border = cx.pick(8, 4);
    let mut made = Made::default();
    let mut stills: Vec<(u32, Still)> = Vec::new();
    for &number in numbers {
        let still = Still::new(cx, &alley(cx, number), border)?;
        if ![9, 13].contains(&number) {
            made.panels.extend(still.panels(&format!("{number:02}-"), &format!("Frame {number}")));
        }
        stills.push((number, still));
    }
    for pair in stills.windows(2) {
        let [(before, a), (after, b)] = pair else { continue };
        let mask = steady(&a.truth, &b.truth, border);
        let share = mask.iter().filter(|&&inside| inside).count() as f64 / mask.len() as f64;
        let frames = format!("frames {before} and {after}");
        let found = flicker(&a.picture, &b.picture, &mask);
        made.measures.push(Measure::exactly(&format!("{frames}: flicker on static parts"), found, "shadow", 0.0));
        made.measures.push(Measure::at_least(&format!("{frames}: static parts of the picture"), share, "share", 0.2));
    }
    let most = stills.iter().map(|(_, still)| still.acne(|_| true)).fold(0.0, f64::max);
    made.measures.push(Measure::info("largest false shadow of a frame (M2)", most, "share"));
    // The control: random samples that are others in each frame.
    let jittered = |number: u32| alley(cx, number).by(cx, "reeves87", &Frame { number, ..FRAME });
    let at = |number: u32| stills.iter().find(|(known, _)| *known == number).map(|(_, still)| &*still.truth);
    if let (Some(a), Some(b)) = (at(12), at(13)) {
        let found = flicker(&jittered(12)?, &jittered(13)?, &steady(a, b, border));
        made.measures.push(Measure::info(
            "control, frames 12 and 13 by Reeves with other random numbers in each",
            found,
            "shadow",
        ));
    }
    made.note = format!(
        "Static parts are the pixels wholly on the lane, the gutters, the walls or the curtain whose surface and true shadow are the \
         same in both frames, as are those of all pixels within {border}."
    );
    Ok(made)
}
