//! Wang & Molnar 1994, Figure 10: the listing as printed beside the listing as it must be.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::acne;
use crate::stage::panels::{error_panel, shadow_panel, truth_panel};
use crate::stage::set::Set;
use glam::{DVec2, DVec3, IVec2, UVec2, Vec2, Vec3};
use umbrage_bake::bake;
use umbrage_depth::{BackFace, DepthMap, Raw, Tiled};
use umbrage_plane::{Bias, Kind, Receiver, Rules, SurfacePoint, TexelRect, View};
use umbrage_raster::Cull;
use umbrage_render::{Frame, Soup};
use umbrage_report::text::short;
use umbrage_report::{Made, Measure, Table};
use umbrage_sample::Key;
use umbrage_scene::gallery;
use umbrage_shadow::as_printed::{Division, percent_illumination};
use umbrage_shadow::{Conditional, Shadow, ShadowMap, presets};

pub const F10: Figure = Figure {
    id: "WM94-F10",
    paper: Paper::WangMolnar94,
    title: "The listing, printed and corrected",
    claim: "percent_illumination as printed has errors, and each is shown beside the corrected listing.",
    look: "the flat sheets, which shadow themselves under the listing as printed.",
    make: listing,
};

/// Parallel light along −y, a texel of its 16² map a world unit wide.
fn sun() -> anyhow::Result<View> {
    Ok(View::orthographic(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, 8.0, 0.0, 50.0, UVec2::splat(16))?)
}

fn map(view: &View, depth: impl Fn(IVec2) -> f32) -> anyhow::Result<Raw> {
    Ok(Raw::new(*view, TexelRect::of_size(view.size()).texels().map(depth).collect())?)
}

/// A receiver at a texel position whose plane's depth grows by `gradient` from texel to texel.
fn tilted(view: &View, at: [f64; 2], depth: f64, gradient: [f64; 2]) -> anyhow::Result<Receiver> {
    let world = view.world_at(DVec2::from(at), view.key(depth));
    let seen = view.receiver(&SurfacePoint::at(world.as_vec3(), Vec3::Y));
    let seen = seen.map_err(|place| anyhow::anyhow!("the receiver is {place:?}"))?;
    let normal = DVec3::new(gradient[0], -gradient[1], 1.0);
    let eye = view.world_to_eye().transform_point3(world);
    Ok(Receiver { normal, eye, depth: depth as f32, facing: normal.normalize().z as f32, ..seen })
}

/// The corrected rule's illumination: a shadow's complement.
fn corrected(filter: Conditional, map: &Raw, seen: &Receiver) -> f32 {
    1.0 - ShadowMap { filter, map: map.clone() }.fraction_of(seen, Key::new(0, 0, 0))
}

/// The nearest four texels of a receiver.
fn nearest_four(centre: Vec2) -> [IVec2; 4] {
    let first = (centre - 0.5).floor().as_ivec2();
    [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE].map(|step| first + step)
}

/// The printed listing over a map of second surfaces, its counter begun at 0, in fractions: faithful mode (E-M11).
struct Printed<'a>(&'a Tiled);

impl Printed<'_> {
    fn of(&self, seen: &Receiver) -> f32 {
        let view = self.0.view();
        let texels = nearest_four(seen.footprint.centre);
        let plane = seen.plane(view);
        let second = texels.map(|texel| self.0.depth(texel));
        let samples = texels.map(|texel| plane.at(view.sampling().position(texel)));
        1.0 - percent_illumination(seen.depth, &second, &samples, Division::Float)
    }
}

impl Shadow for Printed<'_> {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        for (point, fraction) in at.iter().zip(out) {
            *fraction = self.0.view().receiver(point).map_or(0.0, |seen| self.of(&seen));
        }
    }
}

const SECOND: [f32; 4] = [5.0, 5.0, 9.0, 9.0];
const VIRTUAL: [f32; 4] = [4.9, 5.0, 8.9, 9.0];

/// V55's map and receiver under the corrected rule.
fn v55() -> anyhow::Result<(Raw, Receiver)> {
    let view = sun()?;
    let seen = tilted(&view, [8.0, 7.7625], 6.0, [0.1, 4.0])?;
    Ok((map(&view, |texel| if texel.y < 8 { 5.0 } else { 9.0 })?, seen))
}

fn listing(cx: &Context) -> anyhow::Result<Made> {
    let (stored, seen) = v55()?;
    let ours = |depth: f32| corrected(presets::wang_molnar94().filter, &stored, &Receiver { depth, ..seen });
    let theirs = |depth: f32, division| percent_illumination(depth, &SECOND, &VIRTUAL, division);
    let plain = SECOND.iter().filter(|&&second| 6.0 <= second).count();
    let mut rows = Vec::new();
    for (case, depth) in [("mixed", 6.0), ("all lit", 5.0), ("none lit", 9.1)] {
        rows.push(vec![
            case.into(),
            short(f64::from(depth), 3),
            theirs(depth, Division::Float).to_string(),
            theirs(depth, Division::Integer).to_string(),
            ours(depth).to_string(),
        ]);
    }
    let head = ["nearby depths 5, 5, 9, 9", "z camera", "as printed", "as printed, whole numbers", "corrected"];
    let v55 = Table { name: "V55".into(), head: head.map(String::from).to_vec(), rows };
    let set = sheets(cx)?;
    let printed = set.draw(cx, &Printed(set.map()), &Frame::CENTRES);
    let right = set.by(cx, "wang-molnar94", &Frame::CENTRES)?;
    let (points, truth) = (set.truth_points(cx, &Frame::CENTRES), set.truth(cx));
    let border = cx.pick(6, 3);
    let measures = vec![
        Measure::exactly("V55: depths that the first test calls lit", plain as f64, "of 4", 2.0),
        Measure::exactly("V55, as printed", f64::from(theirs(6.0, Division::Float)), "lit share", 0.5),
        Measure::exactly(
            "V55, as printed in whole numbers",
            f64::from(theirs(6.0, Division::Integer)),
            "lit share",
            0.0,
        ),
        Measure::exactly("V55, corrected", f64::from(ours(6.0)), "lit share", 1.0),
        Measure::exactly("all lit, as printed", f64::from(theirs(5.0, Division::Float)), "lit share", 1.0),
        Measure::exactly("all lit, corrected", f64::from(ours(5.0)), "lit share", 1.0),
        Measure::exactly("none lit, as printed", f64::from(theirs(9.1, Division::Float)), "lit share", 0.0),
        Measure::exactly("none lit, corrected", f64::from(ours(9.1)), "lit share", 0.0),
        Measure::at_least(
            "planar sheets, as printed: false shadow",
            acne(&printed, &points, border, |_| true),
            "share",
            0.05,
        ),
        Measure::at_most(
            "planar sheets, corrected: false shadow",
            acne(&right, &points, border, |_| true),
            "share",
            0.002,
        ),
    ];
    Ok(Made {
        panels: vec![
            shadow_panel("printed", "As printed: flat sheets shadow themselves", &printed).against("truth"),
            shadow_panel("corrected", "Corrected", &right).against("truth"),
            truth_panel(&truth),
            error_panel("error-printed", "As printed, minus truth", truth.size, &printed.shadow[0], &truth.shadow[0]),
            error_panel("error-corrected", "Corrected, minus truth", truth.size, &right.shadow[0], &truth.shadow[0]),
        ],
        tables: vec![v55, errata()?],
        measures,
        note: "The listing returns illumination: 1 is lit. Its two comparisons contradict the text in opposite ways, and both must be ≤."
            .into(),
        ..Made::default()
    })
}

/// The scene of planar sheets, its map of second surfaces.
fn sheets(cx: &Context) -> anyhow::Result<Set> {
    let set = Set::new(gallery::sheets(false), cx.pick(512, 256), cx.pick(512, 256));
    let light = set.scene.lights[0].view;
    let map = bake(&light, Soup::casters(&set.scene, &light).triangles(), &BackFace, Cull::Front).map;
    Ok(set.with_map(map))
}

/// E-M1 to E-M11: what is wrong, and what the listing returns before and after correction where a number shows it.
fn errata() -> anyhow::Result<Table> {
    let view = sun()?;
    let (stored, seen) = v55()?;
    let rule = presets::wang_molnar94().filter;
    let lit = |value: f32| short(f64::from(value), 3);
    // An edge beside a level receiver, for neighbourhoods.
    let edge = map(&view, |texel| if texel.x < 8 { 5.0 } else { 9.0 })?;
    let level = tilted(&view, [8.2, 8.2], 6.0, [0.0, 0.0])?;
    let boxed = rule.with_res_factor(0.0).with_min_size(1.5);
    // Half of the nearest texels are outside.
    let rim = map(&view.with_rules(Rules::OPEN), |_| 5.0)?;
    let at_rim = tilted(&view, [16.0, 8.0], 6.0, [0.0, 0.0])?;
    // A curved sheet's point lies half a unit behind its own stored depth.
    let bent = map(&view, |_| 5.5)?;
    let biased = rule.with_plane(rule.plane.with_bias(Bias::World(0.6)));
    let equal = [6.0f32; 4];
    let prose = equal.iter().filter(|&&second| 6.0 < second).count() as f32 / 4.0;
    let (edge_on, edge_on_ours) = edge_on()?;
    let row = |id: &str, what: &str, printed: String, corrected: String| {
        vec![id.to_string(), what.to_string(), printed, corrected]
    };
    let rows = vec![
        row(
            "E-M1",
            "the lit counter is not initialised: here it begins at 0",
            "undefined".into(),
            lit(corrected(rule, &stored, &Receiver { depth: 5.0, ..seen })),
        ),
        row(
            "E-M2",
            "the last line divides whole numbers",
            lit(percent_illumination(6.0, &SECOND, &VIRTUAL, Division::Integer)),
            lit(corrected(rule, &stored, &seen)),
        ),
        row(
            "E-M3",
            "virtual samples are compared by <: flat sheets need ≤",
            lit(percent_illumination(6.0, &SECOND, &VIRTUAL, Division::Float)),
            lit(corrected(rule, &stored, &seen)),
        ),
        row(
            "E-M4",
            "equality in the first test: the text says shadow, the listing lit",
            format!("{} or {}", lit(prose), lit(percent_illumination(6.0, &equal, &equal, Division::Float))),
            lit(corrected(rule, &map(&view, |_| 6.0)?, &level)),
        ),
        row(
            "E-M5",
            "how many texels count as near: the nearest four, or a box of 3 × 3",
            "undefined".into(),
            format!("{} or {}", lit(corrected(rule, &edge, &level)), lit(corrected(boxed, &edge, &level))),
        ),
        row(
            "E-M6",
            "texels outside the map: by the light's rule, here lit",
            "undefined".into(),
            lit(corrected(rule, &rim, &at_rim)),
        ),
        row(
            "E-M7",
            "no bias, which curved sheets need: here 0.6",
            lit(percent_illumination(6.0, &[5.5; 4], &[6.0; 4], Division::Float)),
            lit(corrected(biased, &bent, &level)),
        ),
        row(
            "E-M8",
            "a plane that contains the light's ray: virtual depths are not numbers, and plain comparison decides",
            edge_on,
            lit(edge_on_ours),
        ),
        row(
            "E-M9",
            "the result for what is lit: the listing returns illumination, the corrected one shadow",
            lit(percent_illumination(4.0, &SECOND, &VIRTUAL, Division::Float)),
            lit(1.0 - corrected(rule, &stored, &Receiver { depth: 4.0, ..seen })),
        ),
        row("E-M10", "§4.4 names Figures 13, 14 and 15 by one number less", "12, 13, 14".into(), "13, 14, 15".into()),
        row(
            "E-M11",
            "as printed here: E-M1 as 0, E-M2 in fractions, E-M3 as it stands",
            lit(percent_illumination(6.0, &SECOND, &VIRTUAL, Division::Float)),
            String::new(),
        ),
    ];
    let head = ["erratum", "what", "as printed", "corrected"].map(String::from).to_vec();
    Ok(Table { name: "errata".into(), head, rows })
}

/// The plane x = 0 holds the light of V35: the listing's virtual depth there in f32, and the corrected rule's answer over a half-dark map.
fn edge_on() -> anyhow::Result<(String, f32)> {
    let fov = 90f64.to_radians();
    let view = View::perspective(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, fov, 1.0, 100.0, UVec2::splat(64))?;
    let point = SurfacePoint::at(Vec3::new(0.0, 1.0, -3.0), Vec3::X);
    let seen = view.receiver(&point).map_err(|place| anyhow::anyhow!("the receiver is {place:?}"))?;
    let to_light = view.with_kind(Kind::Screen).world_to_screen();
    let plane = (to_light.inverse().transpose() * DVec3::X.extend(0.0)).as_vec4();
    let depth = -(plane.x / plane.z) * 0.1 - (plane.y / plane.z) * 0.1 - plane.w / plane.z;
    let half = map(&view, |texel| if texel.x < 32 { 5.0 } else { f32::INFINITY })?;
    Ok((short(f64::from(depth), 3), corrected(presets::wang_molnar94().filter, &half, &seen)))
}
