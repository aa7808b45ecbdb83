//! Wang & Molnar 1994, Figure 4: the table on whose legs no bias works, and second depths, which need none.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{lit, points_of, value};
use crate::stage::panels::{error_panel, shadow_panel};
use crate::stage::set::Set;
use glam::{DVec3, UVec2, Vec3};
use umbrage_oracle::{BiasCase, BiasSearch, gap_on_surface, metrics, predict};
use umbrage_plane::{SurfacePoint, View};
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, NOTHING, Picture, light_map};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Panel, Role};
use umbrage_sample::Key;
use umbrage_scene::{Scene, gallery};
use umbrage_shadow::Shadow;

/// The paper's algorithm.
pub const SECOND: &str = "wang-molnar94";
/// The same with what turns away from the light counted as dark, which its shading makes it anyway (WM94-4).
pub const SHADED: &str = "wang-molnar94,backs=dark";
/// 16 samples per pixel, each with its ray.
pub const RAYS: Frame = Frame { axis: 4, stochastic: true, every_sample: true, ..Frame::CENTRES };

/// Side of a leg, and its thickness along the light.
const LEG: f64 = 8.0;
/// Middles of the feet on the side of their shadows: of the leg farthest from the light, and of the leg nearest to it.
const FAR_FOOT: DVec3 = DVec3::new(280.0, 0.0, 176.0);
const NEAR_FOOT: DVec3 = DVec3::new(-272.0, 0.0, 176.0);
/// Half-extent of the first-depth filter, texels.
const RADIUS: f64 = 2.0;

/// First depths as the figure has them: percentage closer, 4 × 4 samples over at least two texels to either side.
fn first(bias: f64) -> String {
    format!("reeves87,samples=16,min-samples=4,res-factor=3,min-size=2,bias={bias}")
}

/// The same picture with surfaces that turn away from the light dark, as their own shading makes them whatever the map says. For scenes of solids.
fn shaded_backs(mut picture: Picture) -> Picture {
    for i in 0..picture.object.len() {
        if picture.object[i] != NOTHING && picture.facing[0][i] <= 0.0 {
            picture.shadow[0][i] = 1.0;
        }
    }
    picture
}

/// The table with the camera close on the foot of the leg that stands farthest from the light and nearest to the viewer.
fn far_leg() -> anyhow::Result<Scene> {
    let (eye, target) = (FAR_FOOT + DVec3::new(47.0, 95.0, 134.0), FAR_FOOT + DVec3::new(32.0, 6.0, 2.0));
    let camera = View::perspective(eye, target, DVec3::Y, 32f64.to_radians(), 60.0, 4000.0, UVec2::splat(512))?;
    Ok(Scene { name: "table, far leg".into(), camera, ..gallery::table() })
}

/// The foot of a leg, and the floor's lit points away from all silhouettes.
pub struct Foot {
    set: Set,
    at: DVec3,
    lit: Vec<SurfacePoint>,
}

/// How a method does there.
#[derive(Clone, Copy)]
pub struct Found {
    /// False shadow on the floor (M2), as a fraction.
    pub acne: f64,
    /// From the leg to its shadow (M7), world units.
    pub gap: f64,
}

impl Foot {
    /// Of the leg farthest from the light.
    pub fn far(cx: &Context, texels: u32) -> anyhow::Result<Self> {
        Ok(Self::new(cx, far_leg()?, FAR_FOOT, texels))
    }

    fn new(cx: &Context, scene: Scene, at: DVec3, texels: u32) -> Self {
        const FLOOR: u32 = 0;
        let set = Set::new(scene, cx.pick(512, 256), texels);
        let seen = set.truth_points(cx, &Frame::CENTRES);
        // The filter's reach and a texel about it.
        let apart = RADIUS as f32 + 1.0;
        let distance = metrics::silhouette_distance(&set.scene.lights[0].view, &set.scene, &seen.position, apart + 1.0);
        let kept = lit(&seen, 0, |id| id == FLOOR);
        let pixel = |point: &SurfacePoint| point.region as usize;
        let keep = |point: &SurfacePoint| {
            kept[pixel(point)] && distance[pixel(point)] > apart && pixel(point) % cx.pick(7, 11) == 0
        };
        let lit = points_of(&seen).into_iter().filter(keep).collect();
        Self { set, at, lit }
    }

    fn judge(&self, cx: &Context, shadow: &dyn Shadow) -> Found {
        let key = Key::new(cx.seed, 0, 0);
        let mut dark = vec![0.0; self.lit.len()];
        shadow.fractions(&self.lit, key, &mut dark);
        let acne = dark.iter().map(|&dark| f64::from(dark)).sum::<f64>() / dark.len() as f64;
        // Lines along the shadow from the middle half of the leg's far side.
        let (lines, limit) = (16u32, 60.0);
        let gaps = (0..lines).map(|line| {
            let across = (f64::from(line) + 0.5) / f64::from(lines) - 0.5;
            let foot = self.at + DVec3::new(1e-3, 0.0, across * 0.5 * LEG);
            let foot = SurfacePoint::at(foot.as_vec3(), Vec3::Y);
            let gap = gap_on_surface(shadow, &foot, Vec3::X, 0.25, limit, key.region(line * 4096));
            f64::from(gap.unwrap_or(limit))
        });
        Found { acne, gap: gaps.sum::<f64>() / f64::from(lines) }
    }

    pub fn first(&self, cx: &Context, bias: f64) -> anyhow::Result<Found> {
        let recipe: Recipe = first(bias).parse()?;
        Ok(self.judge(cx, &*recipe.bind(self.set.map(), cx.storage)?))
    }

    pub fn second(&self, cx: &Context) -> anyhow::Result<Found> {
        let recipe: Recipe = SECOND.parse()?;
        let map = light_map(&recipe, &self.set.scene, &self.set.scene.lights[0].view);
        Ok(self.judge(cx, &*recipe.bind(map, cx.storage)?))
    }

    /// What theory needs to know of it.
    fn case(&self) -> BiasCase {
        let light = &self.set.scene.lights[0].view;
        let way = light.light().truncate() - self.at;
        let elevation = way.y.atan2(way.with_y(0.0).length());
        let depth = -light.world_to_eye().transform_point3(self.at).z;
        let texel_world = light.texel_world(depth).max_element();
        let slope = 1.0 / elevation.tan();
        BiasCase { texel_world, radius: RADIUS, slope, thickness: LEG, elevation, stored: umbrage_depth::Stored::First }
    }

    /// Pixels of the picture that a world unit of the floor takes at the foot, along the shadow.
    fn pixels(&self) -> f64 {
        let camera = &self.set.scene.camera;
        let pixel = |at: DVec3| camera.eye_to_texel(camera.world_to_eye().transform_point3(at));
        pixel(self.at).distance(pixel(self.at + DVec3::X))
    }

    /// Tries biases up to 40: every trial, and whether one has neither fault.
    fn sweep(&self, cx: &Context) -> anyhow::Result<Sweep> {
        let mut tried = Vec::new();
        let mut failed = None;
        let search = BiasSearch { halvings: cx.pick(5, 0), ..BiasSearch::default() };
        let window = search.run(|bias| match self.first(cx, bias) {
            Ok(found) => {
                tried.push((bias, found));
                (found.acne, found.gap)
            }
            Err(error) => {
                failed = Some(error);
                (f64::NAN, f64::NAN)
            }
        });
        if let Some(error) = failed {
            return Err(error);
        }
        tried.sort_by(|a, b| a.0.total_cmp(&b.0));
        let good = tried.iter().filter(|(_, found)| found.acne < 0.02 && found.gap < 1.0).count();
        let [acne_free, contact] = [window.acne_free, window.keeps_contact].map(value);
        Ok(Sweep { tried, good, acne_free, contact })
    }
}

struct Sweep {
    tried: Vec<(f64, Found)>,
    /// Biases with neither fault.
    good: usize,
    /// The smallest bias whose false shadow is at most .02, and the largest whose gap is at most 1.
    acne_free: f64,
    contact: f64,
}

pub const F4: Figure = Figure {
    id: "WM94-F4",
    paper: Paper::WangMolnar94,
    title: "A table on whose legs no bias works",
    claim: "At 512² every bias either leaves false shadow on the floor or detaches shadows from the legs; second depths do neither, without a bias.",
    look: "the floor and the foot of the far leg: one of them is wrong for every bias, and neither is for second depths.",
    make: table,
};

fn table(cx: &Context) -> anyhow::Result<Made> {
    let (foot, large) = (Foot::far(cx, 512)?, Foot::far(cx, 2048)?);
    let near = Foot::new(cx, gallery::table_close_up(), NEAR_FOOT, 512);
    let (near_sweep, near_fifteen) = (near.sweep(cx)?, near.first(cx, 15.0)?);
    let (sweep, sweep_large, second) = (foot.sweep(cx)?, large.sweep(cx)?, foot.second(cx)?);
    let [five, fifteen, wide] = [foot.first(cx, 5.0)?, foot.first(cx, 15.0)?, foot.first(cx, 25.0)?];
    let b = large.first(cx, 5.0)?;
    let window = foot.case().window();
    let agrees = |foot: &Foot, sweep: &Sweep| {
        let case = foot.case();
        let none = predict::no_bias_works(case.texel_world, RADIUS, LEG, case.elevation);
        f64::from(u8::from(none == (sweep.good == 0)))
    };
    Ok(Made {
        panels: panels(cx, &foot, &large)?,
        plots: plots(&foot.case(), &sweep, second),
        measures: vec![
            Measure::at_least("(a) 512², bias 15: false shadow on the floor (M2)", fifteen.acne, "share", 0.05),
            Measure::at_least("(a) from the leg to its shadow (M7)", fifteen.gap, "world units", 3.0),
            Measure::info("(a) the same", fifteen.gap * foot.pixels(), "px"),
            Measure::at_least("512², bias 5: false shadow", five.acne, "share", 0.3),
            Measure::at_most("512², bias 5: from the leg to its shadow", five.gap, "world units", 0.1),
            Measure::at_most("512², bias 25: false shadow beyond that of bias 15", wide.acne - fifteen.acne, "share", 0.0),
            Measure::at_least("512², bias 25: from the leg to its shadow", wide.gap, "world units", 12.0),
            Measure::at_most("(b) 2048², bias 5: false shadow", b.acne, "share", 0.06),
            Measure::at_most("(b) from the leg to its shadow", b.gap, "world units", 1.0),
            Measure::exactly("512²: biases of 0 to 40 with M2 < .02 and M7 < 1", sweep.good as f64, "", 0.0),
            Measure::info("512²: biases tried", sweep.tried.len() as f64, ""),
            Measure::info("512²: false shadow falls to .02 at a bias of", sweep.acne_free, "world units"),
            Measure::info("512²: the bias without any by D-10", value(window.acne_free), "world units"),
            Measure::info("512²: gaps stay below 1 up to a bias of", sweep.contact, "world units"),
            Measure::info("512²: the largest bias without a gap by D-10", value(window.keeps_contact), "world units"),
            Measure::exactly("512²: D-10 says whether a bias works (1: as measured)", agrees(&foot, &sweep), "", 1.0).yes_no(),
            Measure::exactly("2048²: D-10 says so too", agrees(&large, &sweep_large), "", 1.0).yes_no(),
            Measure::info("2048²: biases that work, of those tried", sweep_large.good as f64, ""),
            Measure::exactly("leg nearest the light, 512²: biases with M2 < .02 and M7 < 1", near_sweep.good as f64, "", 0.0),
            Measure::info("leg nearest the light, bias 15: false shadow", near_fifteen.acne, "share"),
            Measure::info("leg nearest the light, bias 15: from it to its shadow", near_fifteen.gap, "world units"),
            Measure::at_most("second depths, 512², no bias: false shadow", second.acne, "share", 0.0),
            Measure::at_most("second depths: from the leg to its shadow", second.gap, "world units", 1.0),
        ],
        note: "Faults are measured at the leg that stands farthest from the light, on floor more than three texels away from silhouettes; gaps are the mean of \
               16 lines along the shadow. The choice of leg matters for (a): at the one nearest to the light, where the light falls more steeply \
               and texels are smaller, a bias of 15 leaves less than the .05 of false shadow that (a) requires, though no bias works there either."
            .into(),
        ..Made::default()
    })
}

fn plots(case: &BiasCase, sweep: &Sweep, second: Found) -> Vec<(String, String)> {
    let of = |measure: fn(&Found) -> f64| sweep.tried.iter().map(|(bias, found)| (*bias, measure(found))).collect();
    let gap = |bias: f64| predict::expected_contact_gap(bias, case.thickness, case.elevation, case.stored);
    let acne = Plot::new("False shadow on the floor, 512²", Axis::linear("bias, world units"), Axis::linear("share"))
        .add(Series::line("first depths", of(|found| found.acne)))
        .add(Series::dots("second depths, no bias", vec![(0.0, second.acne)]));
    let gaps =
        Plot::new("From the leg to its shadow, 512²", Axis::linear("bias, world units"), Axis::linear("world units"))
            .add(Series::dots("first depths, measured", of(|found| found.gap)))
            .add(Series::line(
                "first depths, predicted",
                (0..=40).map(|bias| (f64::from(bias), gap(f64::from(bias)))).collect(),
            ))
            .add(Series::dots("second depths, no bias", vec![(0.0, second.gap)]));
    vec![("false-shadow".into(), acne.svg()), ("gap".into(), gaps.svg())]
}

fn panels(cx: &Context, foot: &Foot, large: &Foot) -> anyhow::Result<Vec<Panel>> {
    let mut panels = Vec::new();
    let whole = |texels| Set::new(gallery::table(), cx.pick(512, 256), texels).in_colour().with_coloured_truths();
    let (whole, whole_large) = (whole(512), whole(2048));
    let truth = foot.set.truth_points(cx, &RAYS);
    let named = [
        ("a", "(a) 512², bias 15", &foot.set, &whole, first(15.0)),
        ("b", "(b) 2048², bias 5", &large.set, &whole_large, first(5.0)),
        ("second", "Second depths, 512², no bias", &foot.set, &whole, SHADED.into()),
    ];
    for (name, caption, near, far, recipe) in &named {
        let picture = far.by(cx, recipe, &Frame::default())?;
        panels.push(Panel::rgb(&format!("{name}-table"), caption, picture.size, picture.colour).against("table-truth"));
        let picture = shaded_backs(near.by(cx, recipe, &Frame::default())?);
        let close = format!("{caption}: the far leg's foot");
        panels.push(shadow_panel(name, &close, &picture).against("truth"));
        let error = format!("{caption}, minus truth");
        let panel = error_panel(&format!("{name}-error"), &error, truth.size, &picture.shadow[0], &truth.shadow[0]);
        panels.push(panel);
    }
    let picture = whole.truth_points(cx, &RAYS);
    let panel = Panel::rgb("table-truth", "Ray-traced truth", picture.size, picture.colour.clone());
    panels.push(panel.role(Role::Truth));
    panels.push(shadow_panel("truth", "Ray-traced truth: the far leg's foot", &truth).role(Role::Truth));
    Ok(panels)
}
