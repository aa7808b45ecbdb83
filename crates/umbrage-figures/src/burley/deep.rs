//! Burley 2006 on deep maps (after Lokovic & Veach 2000): casters that let light through, and casters that move,
//! under one filter.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{of, value};
use crate::stage::panels::{colour_panel, error_panel, shadow_panel};
use crate::stage::penumbra::depth_step;
use crate::stage::set::Set;
use glam::{DVec3, IVec2, UVec2, Vec3};
use rayon::prelude::*;
use std::sync::Arc;
use umbrage_bake::Deep;
use umbrage_depth::{DeepMap, DepthMap, Map, Step, compress_steps};
use umbrage_oracle::{Geometry, RayCast, metrics};
use umbrage_plane::{TexelRect, View};
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, Picture, expose_deep, exposed_map, picture};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Panel, Role};
use umbrage_scene::{Scene, gallery};
use umbrage_shadow::{Mean, Shadow, Unshadowed};

pub const DEEP: Figure = Figure {
    id: "B06-deep",
    paper: Paper::Burley06,
    title: "Deep maps under the same filter",
    claim: "Casters that transmit light or that move cast partial, coloured and blurred shadows.",
    look: "the coloured shadow of the glass, the grey one of the leaves and the blurred one of the moving ball.",
    make: deep,
};

/// The bound that the figure's maps keep, and those of the curve.
const EPSILON: f32 = 0.01;
const EPSILONS: [f32; 5] = [0.001, 0.003, 0.01, 0.03, 0.1];

/// A scene to be rendered, and the moments of its casters.
struct Case {
    name: &'static str,
    set: Set,
    moments: Vec<Scene>,
    /// The same for the oracle, at other times and more of them.
    exact: Vec<Scene>,
    /// Object whose pixels are measured.
    floor: u32,
    frame: Frame,
    /// Samples along a texel's side.
    axis: u32,
    /// What flies by and is left out of the picture: the colour that it adds to each pixel over the moments, and the time that it covers it.
    flying: Option<(Vec<Vec3>, Vec<f32>)>,
}

impl Case {
    fn still(cx: &Context, name: &'static str, scene: Scene, texels: u32, axis: u32) -> Self {
        let set = Set::new(scene, cx.pick(360, 128), texels).in_colour();
        let moments = vec![set.scene.clone()];
        let frame = Frame { axis: cx.pick(4, 2), every_sample: true, ..Frame::default() };
        Self { name, exact: moments.clone(), moments, set, floor: 0, frame, axis, flying: None }
    }

    /// The flying ball itself is left out of the picture that is measured, which is of its shadow, and drawn over it.
    fn moving(cx: &Context) -> Self {
        // The ball goes last, so that what is left of the scene keeps its ids.
        let at = |time: f32| {
            let mut scene = gallery::moving_ball(time);
            scene.objects.rotate_left(1);
            scene
        };
        let over =
            |count: u8| -> Vec<Scene> { (0..count).map(|i| at((f32::from(i) + 0.5) / f32::from(count))).collect() };
        let mut seen = at(0.5);
        seen.objects.pop();
        let set = Set::new(seen, cx.pick(360, 96), cx.pick(384, 128)).in_colour();
        let frame = Frame { axis: 2, every_sample: true, ..Frame::default() };
        let flying = Some(streak(cx, &set, &over(cx.pick(96, 12))));
        Self {
            flying,
            name: "moving ball",
            set,
            moments: over(cx.pick(16, 6)),
            exact: over(cx.pick(24, 6)),
            floor: 1,
            frame,
            axis: 2,
        }
    }

    fn view(&self) -> &View {
        &self.set.scene.lights[0].view
    }

    /// A texel is a small surface here, whose own tilt no tap may see: hence a base of one step of the floor's depth.
    fn recipe(&self) -> String {
        let step = depth_step(self.view(), DVec3::ZERO, DVec3::Y);
        format!("burley,stored=deep,epsilon={EPSILON},sub-samples={},min=0.5t,max=1t,bias={step:.3}", self.axis)
    }

    fn bake(&self) -> anyhow::Result<(Recipe, Arc<DeepMap>)> {
        let recipe: Recipe = self.recipe().parse()?;
        match exposed_map(&recipe, &self.moments.iter().collect::<Vec<_>>(), self.view()).0 {
            Map::Deep(map) => Ok((recipe, map)),
            _ => anyhow::bail!("a deep recipe bakes a deep map"),
        }
    }

    fn truth(&self, cx: &Context) -> Picture {
        let geometries: Vec<Geometry> = self.exact.iter().map(|scene| Geometry::new(scene, &scene.camera)).collect();
        let rays =
            geometries.iter().map(|geometry| -> Box<dyn Shadow + '_> { Box::new(RayCast::new(geometry, self.view())) });
        self.set.draw(cx, &Mean(rays.collect()), &self.frame)
    }
}

/// The last object of the scenes, unshadowed, as an open shutter sees it: the colour that it adds to each pixel, and the fraction of the time for
/// which it covers that pixel.
fn streak(cx: &Context, set: &Set, moments: &[Scene]) -> (Vec<Vec3>, Vec<f32>) {
    let pixels = (set.scene.camera.size().x * set.scene.camera.size().y) as usize;
    let (mut colour, mut covered) = (vec![Vec3::ZERO; pixels], vec![0.0; pixels]);
    let each = 1.0 / moments.len() as f32;
    for moment in moments {
        let scene = Scene { camera: set.scene.camera, ..moment.clone() };
        let ball = scene.objects.len() as u32 - 1;
        let seen = picture(&scene, &[&Unshadowed], &Frame { seed: cx.seed, ..Frame::CENTRES });
        for i in (0..pixels).filter(|&i| seen.object[i] == ball) {
            colour[i] += seen.colour[i] * each;
            covered[i] += each;
        }
    }
    (colour, covered)
}

fn deep(cx: &Context) -> anyhow::Result<Made> {
    let mut made = Made { measures: v56()?, ..Made::default() };
    let cases = [
        Case::still(cx, "glass", gallery::glass_pane(), cx.pick(512, 256), 4),
        Case::still(cx, "plant", gallery::plant(), cx.pick(1024, 256), 2),
        Case::moving(cx),
    ];
    let mut curve = Plot::new("Size of deep maps", Axis::log("error bound ε"), Axis::linear("bytes per texel"));
    for case in &cases {
        let name = case.name;
        let (recipe, map) = case.bake()?;
        let picture = case.set.draw(cx, &*recipe.bind(map.clone(), cx.storage)?, &Frame::default());
        let truth = case.truth(cx);
        let floor = of(&truth, |id| id == case.floor);
        let rms = value(metrics::rms(&picture.shadow[0], &truth.shadow[0], &floor));
        made.measures.push(
            Measure::at_most(&format!("{name}: rms error of the shadow on the floor"), rms, "share", 0.03)
                .full_size(cx.quick),
        );
        let colours = colour_rms(&picture, &truth, &floor);
        made.measures.push(
            Measure::at_most(
                &format!("{name}: rms error of the picture on the floor, worst channel"),
                colours,
                "linear light",
                0.03,
            )
            .full_size(cx.quick),
        );
        let sizes = stored(cx, case, &map, &mut made)?;
        curve = curve.add(Series::line(name, sizes));
        panels(&mut made, case, &picture, &truth);
        if name == "glass" {
            made.measures.push(Measure::at_least(
                "glass: hues on the white floor, of six",
                hues(&picture, &floor),
                "hues",
                5.0,
            ));
        }
    }
    made.plots.push(("bytes".into(), curve.svg()));
    made.note = "Each texel holds the mean of 16 samples for the glass and of 4 for the others, and for the \
    ball also the mean over its moments; the oracle traces rays of its own, at other moments. Shadows are those of a point light: what is soft here is glass, \
    leaves and motion. The ball is drawn over the picture as an open shutter sees it; what is measured is the streak of shadow under it, not \
    the ball."
        .into();
    Ok(made)
}

/// V56: a veil at 2 and an opaque surface at 5.
fn v56() -> anyhow::Result<Vec<Measure>> {
    let view = View::orthographic(DVec3::Z, DVec3::ZERO, DVec3::Y, 1.0, 0.0, 10.0, UVec2::ONE)?;
    let step = |depth, passes| Step { depth, passes: Vec3::splat(passes) };
    let map = DeepMap::new(view, 0.0, [vec![step(2.0, 0.6), step(5.0, 0.0)]])?;
    let wanted = [(1.0, 1.0), (2.0, 1.0), (2.0f32.next_up(), 0.6), (5.0, 0.6), (5.0f32.next_up(), 0.0), (9.0, 0.0)];
    let wrong = wanted.iter().filter(|(depth, passes)| map.transmittance(IVec2::ZERO, *depth).x != *passes).count();
    Ok(vec![
        Measure::exactly("V56: depths with another transmittance than 1, .6 and 0", wrong as f64, "depths", 0.0),
        Measure::exactly("V56: the depth that searches see", f64::from(map.depth(IVec2::ZERO)), "world units", 2.0),
    ])
}

/// Checks every texel of the map, and of maps with the curve's other bounds, against a lossless map; returns the curve.
fn stored(cx: &Context, case: &Case, map: &DeepMap, made: &mut Made) -> anyhow::Result<Vec<(f64, f64)>> {
    let whole = expose_deep(case.view(), &case.moments.iter().collect::<Vec<_>>(), &Deep::new(0.0, case.axis)?);
    let texels: Vec<IVec2> = TexelRect::of_size(case.view().size()).texels().collect();
    let per_texel = |bytes: usize| bytes as f64 / texels.len() as f64;
    let off = |texel: &IVec2| apart(whole.steps(*texel), map.steps(*texel));
    let mut worst = texels.par_iter().map(off).reduce(|| 0.0, f64::max) / f64::from(EPSILON);
    let sizes = EPSILONS.iter().filter(|epsilon| !cx.quick || **epsilon >= 0.01).map(|&epsilon| {
        let one = |texel: &IVec2| {
            let steps = whole.steps(*texel);
            let kept = compress_steps(steps, epsilon);
            (apart(steps, &kept) / f64::from(epsilon), kept.len())
        };
        let (error, kept) = texels.par_iter().map(one).reduce(|| (0.0, 0), |a, b| (a.0.max(b.0), a.1 + b.1));
        worst = worst.max(error);
        (f64::from(epsilon), per_texel(kept * size_of::<Step>()))
    });
    let sizes: Vec<(f64, f64)> = sizes.collect();
    made.measures.extend([
        Measure::at_most(
            &format!("{}: largest stored error over ε, all texels and bounds", case.name),
            worst,
            "ratio",
            1.0,
        ),
        Measure::info(&format!("{}: map without loss", case.name), per_texel(whole.bytes()), "bytes per texel"),
        Measure::info(&format!("{}: map at ε = .01", case.name), per_texel(map.bytes()), "bytes per texel"),
    ]);
    Ok(sizes)
}

/// How far two texels' transmittances are apart anywhere, in any channel.
fn apart(a: &[Step], b: &[Step]) -> f64 {
    let passes = |steps: &[Step], depth: f32| {
        let nearer = steps.partition_point(|step| step.depth <= depth);
        if nearer == 0 { Vec3::ONE } else { steps[nearer - 1].passes }
    };
    let at = |step: &Step| (passes(a, step.depth).as_dvec3() - passes(b, step.depth).as_dvec3()).abs().max_element();
    a.iter().chain(b).map(at).fold(0.0, f64::max)
}

fn colour_rms(picture: &Picture, truth: &Picture, mask: &[bool]) -> f64 {
    let channel = |i: usize| {
        let of = |picture: &Picture| picture.colour.iter().map(|colour| colour[i]).collect::<Vec<f32>>();
        value(metrics::rms(&of(picture), &of(truth), mask))
    };
    channel(0).max(channel(1)).max(channel(2))
}

/// How many of six hues cover more than .1 % of the picture.
fn hues(picture: &Picture, mask: &[bool]) -> f64 {
    let mut counts = [0u32; 6];
    for (colour, _) in picture.colour.iter().zip(mask).filter(|(_, inside)| **inside) {
        let (high, low) = (colour.max_element(), colour.min_element());
        if high - low > 0.25 * high {
            let part = (*colour - low) / (high - low);
            // Full channels are those above a half: red 1, yellow 3, green 2, cyan 6, blue 4, magenta 5.
            let full = (0..3).filter(|&i| part[i] > 0.5).fold(0, |full, i| full | 1 << i);
            counts[full - 1] += 1;
        }
    }
    counts.iter().filter(|&&count| f64::from(count) > 0.001 * mask.len() as f64).count() as f64
}

fn panels(made: &mut Made, case: &Case, picture: &Picture, truth: &Picture) {
    let stem = case.name.split(' ').next().unwrap_or(case.name);
    let exact = format!("{stem}-truth");
    let title = |what: &str| format!("{}, {what}", case.name);
    let of_truth = |panel: Panel| panel.role(Role::Truth).with("times", case.exact.len());
    let drawn = |picture: &Picture| -> Vec<Vec3> {
        let Some((colour, covered)) = &case.flying else { return picture.colour.clone() };
        let over = |i: usize| picture.colour[i] * (1.0 - covered[i]) + colour[i];
        (0..picture.colour.len()).map(over).collect()
    };
    let mut panel = colour_panel(stem, &title("deep map"), picture.size, &drawn(picture)).with("recipe", case.recipe());
    if case.moments.len() > 1 {
        panel = panel.with("moments", case.moments.len());
    }
    made.panels.push(panel.against(&exact));
    made.panels.push(of_truth(colour_panel(&exact, &title("rays"), truth.size, &drawn(truth))));
    if case.flying.is_some() {
        let bare = format!("{stem}-shadow-truth");
        let panel = shadow_panel(&format!("{stem}-shadow"), &title("deep map, shadow only"), picture);
        made.panels.push(panel.against(&bare));
        made.panels.push(of_truth(shadow_panel(&bare, &title("rays, shadow only"), truth)));
    }
    made.panels.push(error_panel(
        &format!("{stem}-error"),
        &title("shadow minus truth"),
        picture.size,
        &picture.shadow[0],
        &truth.shadow[0],
    ));
}
