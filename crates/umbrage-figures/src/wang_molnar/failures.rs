//! Wang & Molnar 1994, Figures 7 and 9 and §3.3: thin solids, steep tangent planes, sheets.

use super::table::{RAYS, SECOND, SHADED};
use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{acne, lit, of, value};
use crate::stage::panels::{error_panel, framed, shadow_panel, zoomed_colour, zoomed_error};
use crate::stage::set::Set;
use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use std::sync::Arc;
use umbrage_depth::DepthMap;
use umbrage_oracle::metrics;
use umbrage_plane::SurfacePoint;
use umbrage_render::{Frame, Picture};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Panel, Role};
use umbrage_scene::{Light, Mesh, Scene, Shape, gallery};

pub const F7: Figure = Figure {
    id: "WM94-F7",
    paper: Paper::WangMolnar94,
    title: "A solid thinner than a texel's depth step",
    claim: "Second depths alone mistake a thin slab's first surface for its second; virtual samples distinguish them.",
    look: "the lit side of the slab, which is dark in spots under plain comparison.",
    make: thin,
};

fn thin(cx: &Context) -> anyhow::Result<Made> {
    const SLAB: u32 = 0;
    let mut made = Made::default();
    let mut curves = [Vec::new(), Vec::new()];
    for texels in [64, 128, 256] {
        let set = Set::new(gallery::thin_slab(), cx.pick(512, 256), texels);
        let seen = set.truth_points(cx, &Frame::CENTRES);
        // About two texels: the reach of the nearest four, and one more.
        let border = (cx.pick(1600.0, 800.0) / f64::from(texels)).ceil() as usize;
        let methods =
            [("never", "Plain comparison", "wang-molnar94,virtual=never"), ("mixed", "Virtual samples", SECOND)];
        for ((name, caption, recipe), curve) in methods.into_iter().zip(&mut curves) {
            let picture = set.by(cx, recipe, &Frame::CENTRES)?;
            let found = acne(&picture, &seen, border, |id| id == SLAB);
            curve.push((f64::from(texels), found));
            let measure = format!("{texels}² map, {}: false shadow on the slab (M2)", caption.to_lowercase());
            made.measures.push(if name == "never" {
                Measure::at_least(&measure, found, "share", 0.02)
            } else {
                Measure::exactly(&measure, found, "share", 0.0)
            });
            let panel = shadow_panel(&format!("{name}-{texels}"), &format!("{caption}, {texels}² map"), &picture);
            made.panels.push(panel.with("thickness", gallery::THIN).with("bias", "none").against("truth"));
            if texels == 128 {
                let truth = set.truth_points(cx, &RAYS);
                let (shadow, exact) = (&picture.shadow[0], &truth.shadow[0]);
                let caption = format!("{caption} at 128², minus truth");
                made.panels.push(error_panel(&format!("{name}-error"), &caption, truth.size, shadow, exact));
                if name == "mixed" {
                    made.panels.push(shadow_panel("truth", "Ray-traced truth", &truth).role(Role::Truth));
                }
            }
        }
    }
    let [never, mixed] = curves;
    let plot = Plot::new(
        "A slab 0.4 thick under 45°",
        Axis::linear("texels per side"),
        Axis::linear("false shadow on it, fraction"),
    )
    .add(Series::line("plain comparison", never))
    .add(Series::line("virtual samples", mixed));
    made.plots.push(("false-shadow".into(), plot.svg()));
    Ok(made)
}

pub const F9: Figure = Figure {
    id: "WM94-F9",
    paper: Paper::WangMolnar94,
    title: "A tangent plane that climbs past its occluder",
    claim: "Where a curved surface is nearly edge-on to the light, virtual samples are wrong and plain comparison is right: they are used \
            only where the nearby texels disagree.",
    look: "the band where the curved surface is nearly edge-on to the light.",
    make: steep,
};

/// The ball.
const BALL: u32 = 0;
/// Its radius.
const RADIUS: f64 = 20.0;

/// The gallery's large ball with a bar along its limb, as near before it as it can lie, and a light that sees much around them: the part of the
/// ball whose N·L is below ¼ is then less than a texel wide, and the ball's plane climbs far from one to the next.
fn occluded_ball() -> anyhow::Result<Scene> {
    const BAR: f64 = 5.0;
    let mut scene = gallery::occluder_sphere();
    scene.objects.truncate(2);
    // It covers the limb with seven tenths of its radius.
    let out = RADIUS + 0.3 * BAR;
    let toward_light = ((RADIUS + 1.01 * BAR).powi(2) - out * out).sqrt();
    let path: Vec<Vec3> = (-8..=8)
        .map(|step| {
            let (sin, cos) = (f64::from(step) * 0.06).sin_cos();
            DVec3::new(-toward_light, out * sin, out * cos).as_vec3()
        })
        .collect();
    scene.objects[1].shape = Shape::Mesh(Mesh::tube(&path, BAR as f32, 64));
    let size = UVec2::splat(256);
    scene.lights = vec![Light::directional("sun", DVec3::NEG_X, DVec3::ZERO, 120.0, 60.0, 300.0, size)?];
    scene.name = "occluded ball".into();
    Ok(scene)
}

/// A scene with its pictures by virtual samples everywhere and by the paper's rule, and how much each leaks on the ball in umbra where N·L
/// is below ¼.
struct Steep {
    set: Set,
    seen: Arc<Picture>,
    pictures: [Picture; 2],
    leaks: [f64; 2],
}

impl Steep {
    fn new(cx: &Context, scene: Scene, texels: u32) -> anyhow::Result<Self> {
        let set = Set::new(scene, cx.pick(512, 256), texels);
        let seen = set.truth_points(cx, &Frame::CENTRES);
        let grazing = |i: usize| seen.shadow[0][i] == 1.0 && seen.facing[0][i] > 0.0 && seen.facing[0][i] < 0.25;
        let umbra: Vec<bool> =
            of(&seen, |id| id == BALL).into_iter().enumerate().map(|(i, on)| on && grazing(i)).collect();
        let always = set.by(cx, "wang-molnar94,virtual=always,backs=dark", &Frame::CENTRES)?;
        let pictures = [always, set.by(cx, SHADED, &Frame::CENTRES)?];
        let leaks = [0, 1].map(|method: usize| value(metrics::leak(&pictures[method].shadow[0], &umbra)));
        Ok(Self { set, seen, pictures, leaks })
    }

    /// Leak of virtual samples everywhere over that of the rule.
    fn ratio(&self) -> f64 {
        self.leaks[0] / self.leaks[1].max(1e-6)
    }
}

fn steep(cx: &Context) -> anyhow::Result<Made> {
    let mut made = Made::default();
    for texels in [128, 256, 512] {
        let steep = Steep::new(cx, occluded_ball()?, texels)?;
        let balls = Steep::new(cx, gallery::occluder_sphere(), texels)?;
        let name = |what: &str| format!("{texels}² map: {what}");
        let [always, rule] = steep.leaks;
        made.measures.extend([
            Measure::at_least(&name("leak, virtual samples everywhere over the rule"), steep.ratio(), "ratio", 3.0),
            Measure::info(&name("leak, virtual samples everywhere (M8)"), always, "share"),
            Measure::info(&name("leak, the paper's rule"), rule, "share"),
            Measure::at_least(&name("the same ratio under two small balls"), balls.ratio(), "ratio", 3.0)
                .full_size(cx.quick),
        ]);
        if texels == 256 {
            let truth = steep.set.truth_points(cx, &RAYS);
            for (picture, (name, caption)) in
                steep.pictures.iter().zip([("always", "Virtual samples everywhere"), ("mixed", "The paper's rule")])
            {
                made.panels.extend(about_umbra(&steep.set, name, caption, picture, &truth));
            }
            let errors = plane_errors(&steep.set, &steep.seen);
            let growing = errors.windows(2).filter(|pair| pair[1].1 > pair[0].1).count();
            let name = "halvings of N·L, of four, at which the plane's largest error grows";
            made.measures.push(Measure::exactly(name, growing as f64, "", 4.0));
            made.measures.push(Measure::info("largest error of the plane, N·L below 1/16", errors[4].1, "world units"));
            let title = "The ball's tangent plane, nearest four texels";
            let plot = Plot::new(title, Axis::log("N·L, at most"), Axis::log("largest depth error, world units"))
                .add(Series::line("|virtual depth − true depth|", errors));
            made.plots.push(("plane-error".into(), plot.svg()));
        }
    }
    made.caveat = Some(
        "Under the gallery's two small balls, four and a half units in front of the surface, the ratio stays below 3: texels are fine there compared \
         with the gap, so that the plane does not climb past the balls, and most of either leak is at the umbra's edges, which both rules share. Proposed: a \
         ratio of 3 where the occluder is \
         nearer than a texel's width over N·L, as over the bar."
            .into(),
    );
    made.note = "The pictures show the ball's shadow under the red bar in flat colours, without the cosine that hides it: bright parts of the ball are lit, \
                 dark ones are in shadow, and black ones face away from the light. What is bright within the bar's shadow is the leak. Leaks are counted on the \
                 \
                 \
                 \
                 \
                 \
                 \
                 ball in umbra where N·L is below ¼. The failure needs an occluder nearer than the plane climbs from texel to \
                 texel, a texel's width over N·L, and wider than a few texels: the scene is made for it. The plane's \
                 error is reported by halvings of N·L; in finer steps it does not grow at each one, as texels past the limb have no ball to compare with."
        .into();
    Ok(made)
}

/// The whole picture and the part about the umbra, as [`painted`] shows them, and the part's error; the truth's with the paper's rule.
fn about_umbra(set: &Set, name: &str, caption: &str, picture: &Picture, truth: &Picture) -> Vec<Panel> {
    const PART: u32 = 2;
    let camera = &set.scene.camera;
    let at = camera.eye_to_texel(camera.world_to_eye().transform_point3(DVec3::new(-3.0, 0.0, RADIUS)));
    let middle: DVec2 = at / camera.size().as_dvec2();
    let size = picture.size;
    let whole = |name: &str, caption: &str, picture: &Picture| {
        framed(&format!("{name}-whole"), caption, size, &painted(set, picture), middle, PART)
    };
    let close = |name: &str, caption: &str, picture: &Picture| {
        zoomed_colour(name, &format!("{caption}, the framed part enlarged"), size, &painted(set, picture), middle, PART)
    };
    let error = format!("{caption}, minus truth");
    let mut panels = vec![
        whole(name, caption, picture).with("map", "256²").against("truth-whole"),
        close(name, caption, picture).with("map", "256²").against("truth"),
        zoomed_error(&format!("{name}-error"), &error, picture, truth, middle, PART),
    ];
    if name == "mixed" {
        panels.push(whole("truth", "Ray-traced truth", truth).role(Role::Truth));
        panels.push(close("truth", "Ray-traced truth", truth).role(Role::Truth));
    }
    panels
}

/// The scene in flat colours, dark where it is in shadow and darkest where it faces away from the light: a leak near the terminator, where shading
/// leaves next to nothing to be seen, is as bright as one anywhere.
fn painted(set: &Set, picture: &Picture) -> Vec<Vec3> {
    let paint = |i: usize| {
        let Some(object) = set.scene.objects.get(picture.object[i] as usize) else { return set.scene.background };
        let lit = if picture.facing[0][i] > 0.0 { 0.1 + 0.9 * (1.0 - picture.shadow[0][i]) } else { 0.04 };
        object.material.diffuse * lit
    };
    (0..picture.object.len()).map(paint).collect()
}

/// Largest distance, along the light, between the ball's tangent planes and the ball itself at the nearest four texels, by halvings of N·L
/// toward 0: the greatest N·L of each, and world units.
fn plane_errors(set: &Set, seen: &Picture) -> Vec<(f64, f64)> {
    const HALVINGS: usize = 5;
    let mut alone: Scene = set.scene.clone();
    alone.objects.truncate(1);
    let ball = Set::new(alone, 16, set.map().view().size().x).map().clone();
    let view = ball.view();
    let mut largest = [0.0f64; HALVINGS];
    for i in (0..seen.object.len()).filter(|&i| seen.object[i] == BALL && seen.facing[0][i] > 0.0) {
        let Ok(receiver) = view.receiver(&SurfacePoint::at(seen.position[i], seen.normal[i])) else { continue };
        let halving = (-seen.facing[0][i].log2()) as usize;
        let bin = &mut largest[halving.min(HALVINGS - 1)];
        let corner = (receiver.footprint.centre - 0.5).floor().as_ivec2();
        let plane = receiver.plane(view);
        for texel in [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE].map(|step| corner + step) {
            // Past the limb there is no ball to compare with.
            let stored = ball.depth(texel);
            if stored.is_finite() {
                *bin = bin.max(f64::from(plane.at(view.sampling().position(texel)) - stored).abs());
            }
        }
    }
    (0..).zip(largest).map(|(halving, error)| (0.5f64.powi(halving), error)).collect()
}

pub const SHEETS: Figure = Figure {
    id: "WM94-sheets",
    paper: Paper::WangMolnar94,
    title: "Nothing but sheets",
    claim: "Plane sheets need no bias and curved ones do; for a scene of sheets alone the method is the first-depth algorithm over again.",
    look: "the curved sheet, which needs a bias as first depths always do.",
    make: sheets,
};

fn sheets(cx: &Context) -> anyhow::Result<Made> {
    let mut made = Made::default();
    let mut curve = Vec::new();
    let mut differing = 0;
    for (name, word, bent) in [("plane", "Plane sheets", false), ("curved", "Curved sheets", true)] {
        let set = Set::new(gallery::sheets(bent), cx.pick(512, 256), 512);
        let (seen, truth) = (set.truth_points(cx, &Frame::CENTRES), set.truth_points(cx, &RAYS));
        let against = format!("{name}-truth");
        let biases: &[f64] = if bent { &[0.0, 0.025, 0.05, 0.1, 0.2, 0.4] } else { &[0.0] };
        for &bias in biases {
            let picture = set.by(cx, &format!("{SECOND},bias={bias}"), &Frame::CENTRES)?;
            let found = acne(&picture, &seen, cx.pick(6, 3), |_| true);
            if bent {
                curve.push((bias, found));
            } else {
                made.measures.push(Measure::at_most("plane sheets, bias 0: false shadow (M2)", found, "share", 0.002));
                let dark = found_any(&picture, &seen, cx);
                made.measures.push(Measure::info(
                    "plane sheets, bias 0: pixels with any, away from edges",
                    dark as f64,
                    "px",
                ));
            }
            if [0.0, 0.1].contains(&bias) {
                let caption = format!("{word}, bias {bias}");
                let panel = shadow_panel(&format!("{name}-{bias}"), &caption, &picture);
                made.panels.push(panel.with("map", "512²").against(&against));
                let (shadow, exact) = (&picture.shadow[0], &truth.shadow[0]);
                let error = format!("{caption}, minus truth");
                made.panels.push(error_panel(&format!("{name}-{bias}-error"), &error, truth.size, shadow, exact));
            }
        }
        made.panels.push(shadow_panel(&against, &format!("{word}, ray-traced truth"), &truth).role(Role::Truth));
        let ours = set.by(cx, "wang-molnar94,stored=second,virtual=never,nearby=box3,bias=0.1", &Frame::CENTRES)?;
        let reeves = set.by(cx, "reeves87,pattern=every,res-factor=0,min-size=1.5,bias=0.1", &Frame::CENTRES)?;
        differing += ours.shadow[0].iter().zip(&reeves.shadow[0]).filter(|(a, b)| a.to_bits() != b.to_bits()).count();
    }
    let rising = curve.windows(2).filter(|pair| pair[1].1 > pair[0].1).count();
    made.measures.extend([
        Measure::at_least("curved sheets, bias 0: false shadow (M2)", curve[0].1, "share", 0.02),
        Measure::exactly("curved sheets: steps to a larger bias that do not lessen it", rising as f64, "", 0.0),
        Measure::info("curved sheets, bias .1: false shadow", curve[3].1, "share"),
        Measure::exactly(
            "pixels that differ from percentage closer with the same bias and texels",
            differing as f64,
            "px",
            0.0,
        ),
    ]);
    let plot =
        Plot::new("Curved sheets, 512² map", Axis::linear("bias, world units"), Axis::linear("false shadow, fraction"))
            .add(Series::line("second depths", curve));
    made.plots.push(("false-shadow".into(), plot.svg()));
    made.note = "Second depths and percentage closer are compared bit for bit on both scenes, with boxes of 3 × 3 texels, a bias of .1 and no virtual \
        samples.".into();
    Ok(made)
}

/// Pixels with any false shadow where [`acne`] looks.
fn found_any(picture: &Picture, seen: &Picture, cx: &Context) -> usize {
    let lit = lit(seen, cx.pick(6, 3), |_| true);
    lit.iter().zip(&picture.shadow[0]).filter(|(lit, shadow)| **lit && **shadow > 0.0).count()
}
