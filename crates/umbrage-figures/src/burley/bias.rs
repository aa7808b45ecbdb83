//! Burley 2006, Image 75: a disc of samples needs a large bias on a slope, a cone needs none.

use crate::figure::{Context, Figure, Paper};
use crate::stage::panels::{shadow_and_error, truth_panel};
use crate::stage::penumbra::{depth_step, mean_shadow};
use crate::stage::set::Set;
use crate::stage::tilted_plane::{on_plane, tilted};
use glam::{DVec2, DVec3, IVec2, Vec3};
use std::f64::consts::PI;
use std::sync::Arc;
use umbrage_depth::{DepthMap, Raw, Tiled};
use umbrage_oracle::predict;
use umbrage_plane::{SurfacePoint, View};
use umbrage_recipe::Recipe;
use umbrage_render::Frame;
use umbrage_report::diagram::{Diagram, Ink, Mark};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure};
use umbrage_sample::Key;
use umbrage_scene::gallery;

/// The filter's radius everywhere here, texels.
const RADIUS: f64 = 8.0;
const DISC: &str = "reeves87,pattern=disc,samples=64,res-factor=0,min-size=8";

pub const I75: Figure = Figure {
    id: "B06-I75",
    paper: Paper::Burley06,
    title: "A disc and a cone of samples",
    claim: "Even under a large constant bias a disc of samples pierces the surface; a cone needs no bias up to the tilt of its side.",
    look: "the side of the disc that reaches into the surface, and the cone that leans away from it.",
    make: cone,
};

/// A plane tilted along one axis of its light's map.
struct Slope {
    view: View,
    map: Arc<Tiled>,
    points: Vec<SurfacePoint>,
    /// The change of depth from texel to texel.
    step: f64,
    texel: f64,
}

impl Slope {
    fn new(cx: &Context, degrees: f64) -> anyhow::Result<Self> {
        let tan = degrees.to_radians().tan();
        let normal = DVec3::new(-tan, 0.0, 1.0).normalize();
        let (view, map) = tilted(normal)?;
        let key = Key::new(cx.seed, 75, 0);
        let place = |i: u32| {
            let (x, y) = (f64::from(key.signed(i, 0)) * 7.0, f64::from(key.signed(i, 1)) * 7.0);
            SurfacePoint { region: i, ..SurfacePoint::at(on_plane(normal, x, y), normal.as_vec3()) }
        };
        let points = (0..cx.pick(8000, 1500)).map(place).collect();
        let texel = view.texel_world(200.0).x;
        Ok(Self { view, map, points, step: texel * tan, texel })
    }

    fn dark(&self, cx: &Context, depth: &str) -> anyhow::Result<f64> {
        shaded(cx, &self.map, &self.points, depth)
    }

    /// The least constant bias with less than .001 in false shadow, world units.
    fn needed(&self, cx: &Context) -> anyhow::Result<f64> {
        let (mut low, mut high) = (0.0, 2.0 * self.predicted() + 1e-3);
        for _ in 0..11 {
            let middle = f64::midpoint(low, high);
            *(if self.dark(cx, &format!("bias={middle}"))? < 1e-3 { &mut high } else { &mut low }) = middle;
        }
        Ok(high)
    }

    fn predicted(&self) -> f64 {
        predict::acne_free_bias(self.step, 0.0, RADIUS)
    }
}

fn shaded(cx: &Context, map: &Arc<Tiled>, points: &[SurfacePoint], depth: &str) -> anyhow::Result<f64> {
    let recipe: Recipe = format!("{DISC},{depth}").parse()?;
    Ok(mean_shadow(cx, &*recipe.bind(map, cx.storage)?, points))
}

/// Names of the cones and constant biases in the sweep, and their recipes at a slope.
const SWEPT: [&str; 5] = [
    "disc with a bias of one texel",
    "cone of slope 1 to texel centres",
    "cone of slope 2 to texel centres",
    "cone of slope 2 to the taps themselves",
    "the same with a base of τ·tanθ/√2",
];

fn recipes(slope: &Slope) -> [String; 5] {
    let base = slope.step / 2f64.sqrt();
    [
        format!("bias={}", slope.texel),
        "depth=cone,slope=1,bias=0".into(),
        "depth=cone,slope=2,bias=0".into(),
        "depth=cone,slope=2,radius=nominal,bias=0".into(),
        format!("depth=cone,slope=2,radius=nominal,bias={base}"),
    ]
}

fn cone(cx: &Context) -> anyhow::Result<Made> {
    let mut made = Made::default();
    let every = cx.pick(25, 75);
    let tilts: Vec<f64> = (0..=750).step_by(every).map(|tenths| f64::from(tenths) * 0.1).collect();
    let (mut shares, mut needed, mut predicted) = (SWEPT.map(|_| Vec::new()), Vec::new(), Vec::new());
    for &tilt in &tilts {
        let slope = Slope::new(cx, tilt)?;
        for (line, recipe) in shares.iter_mut().zip(recipes(&slope)) {
            line.push((tilt, slope.dark(cx, &recipe)?));
        }
        needed.push((tilt, slope.needed(cx)? / slope.texel));
        predicted.push((tilt, slope.predicted() / slope.texel));
    }
    let ratios: Vec<f64> = (0..tilts.len()).filter(|&i| tilts[i] > 1.0).map(|i| needed[i].1 / predicted[i].1).collect();
    let largest = |line: usize, most: f64| {
        shares[line].iter().filter(|point| point.0 <= most).map(|point| point.1).fold(0.0, f64::max)
    };
    let floor = Slope::new(cx, 50.0)?;
    let [one_texel, slope_1, ..] = recipes(&floor);
    let limit = Slope::new(cx, 63.4)?;
    // The segment of a disc beyond the line at which the floor is a texel higher than the receiver.
    let line = floor.texel / (floor.step / floor.texel) / (RADIUS * floor.texel);
    let pierced = (line.acos() - line * (1.0 - line * line).sqrt()) / PI;
    made.measures = vec![
        Measure::exactly(
            "cone of slope 2, texel centre: largest false shadow up to 63.4°",
            largest(2, 63.4).max(limit.dark(cx, &recipes(&limit)[2])?),
            "share",
            0.0,
        ),
        Measure::exactly(
            "cone of slope 1, texel centre: largest false shadow up to 45°",
            largest(1, 45.0),
            "share",
            0.0,
        ),
        Measure::at_least(
            "cone of slope 1 on a floor tilted 50°: false shadow",
            floor.dark(cx, &slope_1)?,
            "share",
            0.05,
        ),
        Measure::within(
            "disc with a bias of one texel on that floor: false shadow over the share of the disc that pierces it",
            floor.dark(cx, &one_texel)? / pierced,
            "ratio",
            0.95,
            1.05,
        ),
        Measure::info("share of that disc that pierces the floor", pierced, "share"),
        Measure::info("cone of slope 2, nominal radius: largest false shadow up to 63.4°", largest(3, 63.4), "share"),
        Measure::exactly("the same with a base of τ·tanθ/√2", largest(4, 63.4), "share", 0.0),
        Measure::at_least(
            "constant bias that is needed over D-9's, least",
            ratios.iter().copied().fold(f64::INFINITY, f64::min),
            "ratio",
            0.85,
        ),
        Measure::at_most(
            "constant bias that is needed over D-9's, most",
            ratios.iter().copied().fold(0.0, f64::max),
            "ratio",
            1.15,
        ),
        Measure::info("constant bias that is needed at 75°", needed[needed.len() - 1].1, "texels"),
    ];
    let mut sweep =
        Plot::new("Radius 8 texels", Axis::linear("tilt, degrees"), Axis::linear("fraction in false shadow"));
    for (name, line) in SWEPT.iter().zip(shares) {
        sweep = sweep.add(Series::line(name, line));
    }
    let bias =
        Plot::new("Constant bias without false shadow", Axis::linear("tilt, degrees"), Axis::linear("bias, texels"))
            .add(Series::line("(R + ½)·g, predicted (D-9)", predicted))
            .add(Series::dots("(R + ½)·g, measured", needed));
    made.plots = vec![
        ("disc-and-cone".into(), schematic(&floor)),
        ("false-shadow".into(), sweep.svg()),
        ("bias".into(), bias.svg()),
    ];
    contacts(cx, &mut made)?;
    pictures(cx, &mut made)?;
    made.note = "The cone's price: an occluder counts only where it is nearer to the light than slope times the \
    tap's distance from the receiver. Of a surface that covers the whole disc at height h above the \
    receiver, only the fraction (h / (slope · radius))² counts: at large radii the outer taps miss what stands close by, \
    and contact shadows would fade. A radius that shrinks toward contacts (Image 76) avoids it. A constant bias that is \
    as safe misses everything closer than itself."
        .into();
    Ok(made)
}

/// One row of a real map under a slope of 50° about one receiver, depth toward the light upward.
fn schematic(slope: &Slope) -> String {
    let (view, radius, half) = (&slope.view, RADIUS * slope.texel, 0.5 * slope.texel);
    let row = view.size().y as i32 / 2;
    let middle = view.size().x as i32 / 2;
    let stored: Vec<DVec2> = (middle - 13..=middle + 13)
        .map(|x| {
            let at = view.world_at(
                DVec2::new(f64::from(x) + 0.5, f64::from(row) + 0.5),
                f64::from(slope.map.depth(IVec2::new(x, row))),
            );
            DVec2::new(at.x, at.z)
        })
        .collect();
    let tan = slope.step / slope.texel;
    let line = |height: f64| [DVec2::new(-radius, height), DVec2::new(radius, height)];
    let reach = 13.0 * slope.texel;
    let surface = [DVec2::new(-reach, -reach * tan), DVec2::new(reach, reach * tan)];
    let solid = [surface[0], surface[1], DVec2::new(reach, -2.0), DVec2::new(-reach, -2.0)];
    let (small, large) = (slope.texel, slope.predicted());
    let pierced: Vec<DVec2> = stored
        .iter()
        .copied()
        .filter(|at| at.x.abs() <= radius && at.y > small)
        .map(|at| DVec2::new(at.x, small))
        .collect();
    let cone = [DVec2::new(-radius, 2.0 * radius), DVec2::ZERO, DVec2::new(radius, 2.0 * radius)];
    Diagram::new(
        "One row of a map of a floor tilted 50°; the light is above",
        DVec2::new(-0.86, -0.55),
        DVec2::new(0.86, 1.16),
    )
    .draw(Mark::Area, Ink::Faint, &solid)
    .pieces(2.4, Ink::Plain, stored.iter().map(|at| [*at - DVec2::X * half, *at + DVec2::X * half]))
    .key(Mark::Line(2.4), Ink::Plain, "depths that the map stores")
    .named(Mark::Line(2.0), Ink::Series(1), &line(small), "disc with a bias of one texel")
    .named(Mark::Rings(4.0), Ink::Series(1), &pierced, "where it pierces the surface")
    .named(Mark::Line(2.0), Ink::Series(3), &line(large), "disc with the bias of D-9")
    .named(Mark::Line(2.0), Ink::Series(0), &cone, "cone of slope 2, no bias")
    .draw(Mark::Dots(4.5), Ink::Plain, &[DVec2::ZERO])
    .key(Mark::Dots(4.5), Ink::Plain, "the shaded point")
    .svg()
}

/// The expected fraction at a height.
type Law<'a> = &'a dyn Fn(f64) -> f64;

/// The fraction of an occluder close above a level receiver that counts at all.
fn contacts(cx: &Context, made: &mut Made) -> anyhow::Result<()> {
    let level = Slope::new(cx, 0.0)?;
    let radius = RADIUS * level.texel;
    let mut plot = Plot::new(
        "An occluder that covers the whole disc",
        Axis::linear("height above the receiver, radii of the disc"),
        Axis::linear("fraction of it that counts"),
    );
    let constant = predict::acne_free_bias(level.texel * 2.0, 0.0, RADIUS);
    let cone = |height: f64| (height / (2.0 * radius)).min(1.0).powi(2);
    let step = |height: f64| f64::from(u8::from(height > constant));
    let biased = format!("bias={constant}");
    let mut worst = 0.0f64;
    let cone = ("cone of slope 2", "depth=cone,slope=2,bias=0", &cone as Law);
    let constant = ("constant bias that is as safe at 63.4°", biased.as_str(), &step as Law);
    for (name, depth, expected) in [cone, constant] {
        let (mut measured, mut predicted) = (Vec::new(), Vec::new());
        for index in 1..=24 {
            let height = radius * (f64::from(index) + 0.5) / 8.0;
            let card = Raw::copy_of(&level.map).map_depths(|_, depth| depth - height as f32)?;
            let share = shaded(cx, &Arc::new(Tiled::from(&card)), &level.points, depth)?;
            worst = worst.max((share - expected(height)).abs());
            measured.push((height / radius, share));
            predicted.push((height / radius, expected(height)));
        }
        plot = plot
            .add(Series::line(&format!("{name}, predicted"), predicted))
            .add(Series::dots(&format!("{name}, measured"), measured));
    }
    made.plots.push(("contact".into(), plot.svg()));
    made.measures.push(Measure::at_most(
        "share of a covering occluder that counts: largest difference from prediction",
        worst,
        "share",
        0.03,
    ));
    Ok(())
}

/// A real floor, tilted 50° to its light, under the three.
fn pictures(cx: &Context, made: &mut Made) -> anyhow::Result<()> {
    let set = Set::new(gallery::contact_box(), cx.pick(384, 160), 1024);
    let view = &set.scene.lights[0].view;
    let lit = [Vec3::new(10.0, 0.0, 0.0), Vec3::new(240.0, 0.0, 110.0)];
    let step = lit.map(|at| depth_step(view, at.as_dvec3(), DVec3::Y)).into_iter().fold(0.0, f64::max);
    let constant = predict::acne_free_bias(step, 0.0, RADIUS);
    let truth = set.truth(cx);
    for (name, caption, depth) in [
        ("one-texel", "Disc, bias of one texel".to_string(), "bias=1t".to_string()),
        ("constant", format!("Disc, the bias that D-9 requires: {constant:.2}"), format!("bias={constant}")),
        ("cone", "Cone of slope 2, no bias".to_string(), "depth=cone,slope=2,bias=0".to_string()),
    ] {
        let picture = set.by(cx, &format!("{DISC},{depth}"), &Frame::default())?;
        shadow_and_error(made, (name, &caption), ("radius", "8 texels"), &picture, &truth);
    }
    made.panels.push(truth_panel(&truth));
    Ok(())
}
