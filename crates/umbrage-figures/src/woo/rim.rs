//! Woo 1992, the rule of the cone: what lies outside a spot's cone is dark.

use super::room::middle_map;
use crate::figure::{Context, Figure, Paper};
use crate::stage::panels::{colour_panel, shadow_panel, zoomed_colour};
use crate::stage::set::Set;
use glam::{DVec2, DVec3, UVec2, Vec3};
use std::f64::consts::PI;
use umbrage_plane::{Rules, SurfacePoint, View};
use umbrage_recipe::bind;
use umbrage_render::Frame;
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure};
use umbrage_sample::{Jittered, Key};
use umbrage_scene::tree::{Cone, Tree};
use umbrage_scene::{Light, Material, Mesh, Object, Scene};
use umbrage_shadow::{Shadow, presets};

pub const RIM: Figure = Figure {
    id: "W92-rim",
    paper: Paper::Woo92,
    title: "Shadow that reaches the rim of a spot's cone",
    claim: "Samples outside the cone must count as shadow; counted as lit, they draw a bright line along the rim.",
    look: "the bright line along the edge of the light's cone, and its absence where outside counts as shadow.",
    make: rim,
};

/// A floor under a spot that looks straight down, half of its cone covered by a board, which is the last object. The
/// camera looks down too, from above the spot.
fn covered_spot(rules: Rules) -> anyhow::Result<Scene> {
    let light = Light::spot("spot", DVec3::new(0.0, 60.0, 0.0), DVec3::ZERO, 60.0, 5.0, 120.0, UVec2::splat(256))?;
    let view = light.view.with_rules(rules);
    let grey = Material::matt(Vec3::splat(0.7));
    Ok(Scene {
        name: format!("covered-spot {rules:?}"),
        origin: DVec3::ZERO,
        objects: vec![
            Object::solid("floor", Mesh::cuboid(Vec3::new(-60.0, -4.0, -60.0), Vec3::new(60.0, 0.0, 60.0)), grey),
            Object::solid("board", Mesh::cuboid(Vec3::new(2.0, 20.0, -40.0), Vec3::new(40.0, 22.0, 40.0)), grey),
        ],
        lights: vec![Light { view, ..light }],
        ambient: Vec3::splat(0.06),
        background: Vec3::ZERO,
        camera: View::perspective(
            DVec3::new(0.0, 100.0, 0.0),
            DVec3::ZERO,
            DVec3::Z,
            46f64.to_radians(),
            1.0,
            200.0,
            UVec2::splat(512),
        )?,
    })
}

fn rim(cx: &Context) -> anyhow::Result<Made> {
    let mut made = Made::default();
    let listing = Rules { outside: Rules::OPEN.outside, beyond_cone: Rules::OPEN.beyond_cone, ..Rules::SPOT };
    let mut across = Plot::new(
        "Light along a radius without shadow, outside dark",
        Axis::linear("texels outward from the rim"),
        Axis::linear("light arriving, fraction"),
    );
    let mut plot = Plot::new(
        "Light along a radius, in the board's shadow",
        Axis::linear("texels outward from the rim"),
        Axis::linear("light arriving, fraction"),
    );
    let (mut panels, mut alone, mut ridges) = (Vec::new(), Vec::new(), Vec::new());
    for (name, caption, rules) in
        [("listing", "Outside is lit (Reeves)", listing), ("woo", "Outside is dark (Woo)", Rules::SPOT)]
    {
        let set = Set::new(covered_spot(rules)?, cx.pick(512, 256), 256);
        let method = set.shadow(cx, "woo92,res-factor=3,min-size=3,samples=256")?;
        // The board is in the map and not in the picture, which shows what lies under it.
        let mut scene = set.scene.clone();
        scene.objects.pop();
        let floor = Set::of(scene).in_colour();
        let picture = floor.draw(cx, &*method, &Frame::CENTRES);
        panels.push(colour_panel(name, caption, picture.size, &picture.colour).with("board", "cut away"));
        let enlarged = format!("{caption}, the rim in the board's shadow");
        let rim = DVec2::new(0.09, 0.5);
        panels.push(zoomed_colour(&format!("{name}-zoom"), &enlarged, picture.size, &picture.colour, rim, 8));
        alone.push(shadow_panel(&format!("{name}-shadow"), &format!("{caption}: shadow alone"), &picture));
        let light = &set.scene.lights[0];
        let pattern = Jittered::default().with_num_samples(256);
        let shadow =
            bind(presets::woo92().filter.with_pattern(pattern).with_min_size(3.0), middle_map(&set), cx.storage);
        let profile = radial(cx, light, &*shadow, 0.0);
        let peak = profile.iter().map(|p| p.1).fold(0.0, f64::max);
        let ends = profile[0].1.max(profile[profile.len() - 1].1);
        ridges.push(peak - ends);
        if name == "woo" {
            let rises = |profile: &[(f64, f64)]| profile.windows(2).filter(|pair| pair[1].1 > pair[0].1 + 1e-3).count();
            // On the other side nothing stands in the light: across a hard rim, and across a soft one.
            let soft = Cone { inner_deg: 22.0, outer_deg: 30.0 };
            let tree = Tree::Product(vec![Tree::Cone(soft), Tree::Shadow { recipe: String::new() }]);
            let sides = [
                ("in shadow", profile.clone()),
                ("hard rim", radial(cx, light, &*shadow, PI)),
                ("soft rim", radial(cx, &light.clone().with_tree(tree), &*shadow, PI)),
            ];
            for (side, profile) in sides {
                let place = if side == "in shadow" { side.to_string() } else { format!("in light, {side}") };
                let name = format!("Woo, {place}: steps at which light rises outward");
                made.measures.push(Measure::exactly(&name, rises(&profile) as f64, "", 0.0));
                if side != "in shadow" {
                    across = across.add(Series::line(side, profile));
                }
            }
        }
        plot = plot.add(Series::line(caption, profile));
    }
    made.measures.insert(0, Measure::at_least("ridge where outside is lit", ridges[0], "share of the light", 0.05));
    made.measures.insert(1, Measure::at_most("ridge where outside is dark", ridges[1], "share of the light", 1e-9));
    made.panels = panels.into_iter().chain(alone).collect();
    made.plots.push(("rim".into(), plot.svg()));
    made.plots.push(("rim-in-light".into(), across.svg()));
    made.note = "The scene is seen from above: the left half of the spot's circle lies under a board that is cut away in the picture. Reeves' listing counts \
                 samples outside the cone as lit, so that regions that straddle the rim receive some of a light that does \
                 not reach them: the thin bright arc. The shadow alone does not show it, because beyond the rim \
                 no light is left to be shadowed. The rim is the cone's circle, not the map's square around it, and never the box around the finite depths: \
                 with midpoints most \
                 of a lit map is empty."
        .into();
    Ok(made)
}

/// Light on the floor along a radius about the direction `angle`, from within the rim outward: texels from the rim and light, averaged over a
/// fan of directions.
fn radial(cx: &Context, light: &Light, shadow: &dyn Shadow, angle: f64) -> Vec<(f64, f64)> {
    let radius = 60.0 * 30f64.to_radians().tan();
    let texel = light.view.texel_world(60.0).x;
    let key = Key::new(cx.seed, 0, 0);
    let at_step = |step: i32| {
        // Half a step off: on the rim itself a rounding decides whether light arrives.
        let from_rim = f64::from(step) * 0.5 + 0.25;
        let fan = -40..=40;
        let count = f64::from(fan.clone().count() as u32);
        let sum: f64 = fan
            .map(|spoke| {
                let way = DVec2::from_angle(angle + f64::from(spoke) * 0.01);
                let at = way * (radius + from_rim * texel);
                let place = DVec3::new(at.x, 0.0, at.y);
                let region = (step + 100) as u32 * 100 + (spoke + 50) as u32;
                let point = SurfacePoint { region, ..SurfacePoint::at(place.as_vec3(), Vec3::Y) };
                let passes = 1.0 - shadow.fraction(&point, key);
                f64::from(light.arriving(place, Vec3::splat(passes)).1.x)
            })
            .sum();
        (from_rim, sum / count)
    };
    (-24..=16).map(at_step).collect()
}
