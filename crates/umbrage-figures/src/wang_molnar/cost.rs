//! Wang & Molnar 1994, Figure 12 and §4.2: what small maps cost in faults and in virtual samples, and what pass 1 costs in time.

use super::table::{Foot, RAYS, SECOND, SHADED};
use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{acne, leak, points_of};
use crate::stage::panels::{error_panel, shadow_panel};
use crate::stage::set::Set;
use std::time::Instant;
use umbrage_bake::bake;
use umbrage_depth::{BackFace, DepthRule, First};
use umbrage_raster::Cull;
use umbrage_render::{Frame, Picture, Soup, light_map};
use umbrage_report::{Made, Measure, Panel, Role, Table};
use umbrage_sample::Key;
use umbrage_scene::gallery;
use umbrage_shadow::{Counters, ShadowMap, presets};

/// Fraction of a picture's points that second depths compare on their tangent planes (M9).
fn virtual_share(cx: &Context, set: &Set, seen: &Picture, dark_backs: bool) -> anyhow::Result<f64> {
    let map = light_map(&SECOND.parse()?, &set.scene, &set.scene.lights[0].view);
    let points = points_of(seen);
    let mut counters = Counters::default();
    let shadow = ShadowMap { filter: presets::wang_molnar94().filter.with_dark_backs(dark_backs), map };
    shadow.fractions_probed(&points, Key::new(cx.seed, 0, 0), &mut vec![0.0; points.len()], &mut counters);
    Ok(counters.virtual_sampled as f64 / points.len() as f64)
}

pub const F12: Figure = Figure {
    id: "WM94-F12",
    paper: Paper::WangMolnar94,
    title: "Smaller and smaller maps, no bias",
    claim: "As the map shrinks, the picture degrades slowly: shadows leak more, and more pixels need virtual samples.",
    look: "the small shadows, which leak first as the map shrinks.",
    make: degrade,
};

fn degrade(cx: &Context) -> anyhow::Result<Made> {
    let mut made = Made::default();
    let (mut leaks, mut shares, mut with_backs, mut rows) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for texels in [512, 256, 128] {
        let set = Set::new(gallery::table(), cx.pick(512, 256), texels).in_colour();
        let seen = set.truth_points(cx, &Frame::CENTRES);
        let by_centres = set.by(cx, SHADED, &Frame::CENTRES)?;
        let false_shadow = acne(&by_centres, &seen, cx.pick(2, 1), |_| true);
        let (light, m9) = (leak(&by_centres, &seen, 0), virtual_share(cx, &set, &seen, true)?);
        let all = virtual_share(cx, &set, &seen, false)?;
        leaks.push(light);
        shares.push(m9);
        with_backs.push(all);
        rows.push(
            [texels.to_string()].into_iter().chain([false_shadow, light, m9, all].map(|v| format!("{v:.4}"))).collect(),
        );
        let (picture, truth) = (set.by(cx, SHADED, &Frame::default())?, set.truth_points(cx, &RAYS));
        let map = format!("{texels}² map");
        made.panels.push(
            Panel::rgb(&format!("full-{texels}"), &map, picture.size, picture.colour.clone()).with("bias", "none"),
        );
        made.panels.push(
            shadow_panel(&format!("shadow-{texels}"), &format!("{map}: shadow alone"), &picture).against("truth"),
        );
        let caption = format!("{map}, minus truth");
        made.panels.push(error_panel(
            &format!("error-{texels}"),
            &caption,
            truth.size,
            &picture.shadow[0],
            &truth.shadow[0],
        ));
        if texels == 512 {
            made.panels.push(shadow_panel("truth", "Ray-traced truth", &truth).role(Role::Truth));
            made.measures.push(Measure::at_most("512²: false shadow (M2)", false_shadow, "share", 0.03));
        }
    }
    let foot = Foot::far(cx, 512)?;
    for (index, step) in ["512² to 256²", "256² to 128²"].into_iter().enumerate() {
        let leak = leaks[index + 1] / leaks[index];
        made.measures
            .push(Measure::within(&format!("{step}: leak (M8) grows"), leak, "times", 1.0, 3.0).full_size(cx.quick));
        let share = shares[index + 1] / shares[index];
        let name = format!("{step}: virtual samples (M9) on what faces the light grow");
        made.measures.push(Measure::within(&name, share, "times", 1.4, 2.2).full_size(cx.quick));
        let all = with_backs[index + 1] / with_backs[index];
        made.measures.push(Measure::info(
            &format!("{step}: virtual samples with backs counted too grow"),
            all,
            "times",
        ));
    }
    made.measures.push(Measure::at_most(
        "512²: from the leg to its shadow (M7)",
        foot.second(cx)?.gap,
        "world units",
        1.0,
    ));
    made.measures.push(Measure::at_least(
        "512²: the same with first depths and a bias of 15",
        foot.first(cx, 15.0)?.gap,
        "world units",
        3.0,
    ));
    let head = [
        "texels per side",
        "false shadow (M2)",
        "leak (M8)",
        "virtual samples (M9), backs left out",
        "virtual samples, backs too",
    ];
    made.tables.push(Table { name: "sizes".into(), head: head.map(String::from).to_vec(), rows });
    made.note = "Virtual samples are counted where the surface faces the light. On back faces, which shading darkens anyway, the nearby texels disagree \
                 at every size alike, over about .8 % of the picture: with those counted, the growth of the first step is below the 1.4 that is required."
        .into();
    Ok(made)
}

pub const COST: Figure = Figure {
    id: "WM94-cost",
    paper: Paper::WangMolnar94,
    title: "What second depths cost",
    claim: "With culling, pass 1 costs what first depths cost, and few pixels need virtual samples.",
    look: "the table: fragments of second depths beside those of first depths, with culling and without.",
    make: cost,
};

/// Pass 1 of a scene: its fragments. `least` becomes the least seconds of all calls.
fn timed<R: DepthRule>(set: &Set, rule: &R, cull: Cull, least: &mut f64) -> u64 {
    let view = set.scene.lights[0].view;
    let soup = Soup::casters(&set.scene, &view);
    let start = Instant::now();
    let baked = bake(&view, soup.triangles(), rule, cull);
    *least = least.min(start.elapsed().as_secs_f64());
    baked.fragments
}

fn cost(cx: &Context) -> anyhow::Result<Made> {
    let mut made = Made::default();
    let mut rows = Vec::new();
    let mut seconds = [0.0; 2];
    let scenes = [("table", gallery::table()), ("spot room", gallery::spot_room()), ("pipes", gallery::pipes())];
    for (name, scene) in scenes {
        let set = Set::new(scene, cx.pick(512, 256), 512);
        let [mut all, mut fronts, mut backs] = [f64::INFINITY; 3];
        let mut fragments = [0; 3];
        for _ in 0..cx.pick(25, 1) {
            fragments = [
                timed(&set, &First, Cull::None, &mut all),
                timed(&set, &First, Cull::Back, &mut fronts),
                timed(&set, &BackFace, Cull::Front, &mut backs),
            ];
        }
        made.timings.extend([
            (format!("{name}: first depths, nothing culled"), all),
            (format!("{name}: first depths, backs culled"), fronts),
            (format!("{name}: second depths, fronts culled"), backs),
        ]);
        let share = virtual_share(cx, &set, &set.plain(cx, &Frame::CENTRES), false)?;
        let ratio = fragments[2] as f64 / fragments[1] as f64;
        made.measures.push(Measure::within(
            &format!("{name}: fragments of pass 1, second depths over first, each culled"),
            ratio,
            "ratio",
            0.7,
            1.3,
        ));
        seconds = [seconds[0] + fronts, seconds[1] + backs];
        let measure = format!("{name}: virtual samples (M9), 512²");
        made.measures.push(if name == "table" {
            Measure::at_most(&measure, share, "share", 0.1)
        } else {
            Measure::info(&measure, share, "share")
        });
        let counts = fragments.map(|count| count.to_string());
        rows.push([name.to_string()].into_iter().chain(counts).chain([format!("{share:.4}")]).collect());
    }
    if !cx.quick {
        let within = f64::from(u8::from((0.7..=1.3).contains(&(seconds[1] / seconds[0]))));
        let measure = "all three: time of pass 1, second depths over first, each culled, within .7 to 1.3";
        made.measures.push(Measure::exactly(measure, within, "", 1.0));
    }
    let head = [
        "scene",
        "fragments of first depths",
        "with backs culled",
        "of second depths, fronts culled",
        "virtual samples, fraction",
    ];
    made.tables.push(Table { name: "fragments".into(), head: head.map(String::from).to_vec(), rows });
    made.note = "A closed surface has as many back faces as front faces under every texel, so that culling leaves the same number of fragments \
                 to either rule. Both are timed with their culling and over all scenes together, as the table alone takes only a millisecond. First depths \
                 without culling \
                 have twice the fragments: against those, culled second depths may take less than .7 of the time. Times are in timings.json."
        .into();
    Ok(made)
}
