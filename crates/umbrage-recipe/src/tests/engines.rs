//! The presets of engines: their biases, filters and settings.

use super::{of_engine, read, refused};
use crate::engine::EngineBias;
use crate::values::{DepthName, Rule, Values};
use crate::{PresetName, Recipe};
use umbrage_engines::{Conditions, Part, WorldBias};
use umbrage_plane::glam::{DVec3, UVec2};
use umbrage_plane::{Bias, Receiver, SurfacePoint, TexelRect, View};
use umbrage_shadow::{Biased, Compared, ReceiverDepth};

/// A light over a floor, parallel or not, and a receiver in it that is tilted.
fn lit(spot: bool) -> (View, Receiver) {
    let (eye, size) = (DVec3::Y * 12.0, UVec2::splat(512));
    let view = if spot {
        View::perspective(eye, DVec3::ZERO, DVec3::NEG_Z, 0.9, 0.5, 40.0, size)
    } else {
        View::orthographic(eye, DVec3::ZERO, DVec3::NEG_Z, 10.0, 0.5, 40.0, size)
    };
    let view = view.unwrap();
    let at = SurfacePoint::at(DVec3::new(1.5, 0.5, -1.0), DVec3::new(0.4, 0.8, 0.3).normalize().as_vec3());
    let receiver = view.receiver(&at).unwrap();
    (view, receiver)
}

/// What is compared is the receiver moved by what the engine's own formulas give, and the place with it.
#[test]
fn engines_presets_have_their_engines_default_bias() {
    for (spot, preset) in [true, false].into_iter().flat_map(|spot| PresetName::ENGINES.map(|preset| (spot, preset))) {
        let (view, seen) = lit(spot);
        let conditions = Conditions::of(&view, &seen).unwrap();
        let conditions = under(preset, conditions);
        let engine = preset.engine().unwrap();
        assert!(preset.name().starts_with(engine.name()), "{preset:?}");
        let given = engine.world(&[], &conditions).unwrap().least;
        let depth = Values::of(preset).compared();
        let prepared = depth.prepared(&view, &seen);
        let rect = TexelRect::of_size(view.size());
        let found = prepared.bounds(rect);
        // Along the normal, then toward the light.
        let moved = seen.eye + seen.normal * given.normal;
        let steps = given.slope * conditions.texel * conditions.slope;
        let wanted = -moved.z - given.constant - steps;
        assert_eq!(found.min, found.max);
        assert!((f64::from(found.min) - wanted).abs() < 1e-5, "{preset:?}: {found:?} instead of {wanted}");
        let place = prepared.region(&seen.footprint).centre.as_dvec2();
        assert!(place.abs_diff_eq(view.eye_to_texel(moved), 1e-3), "{preset:?}: {place}");
        // How far before the receiver's own plane that is.
        let recipe = Recipe::from(preset);
        let zeta = -seen.eye.z;
        let on_axis = Conditions::on_axis(&view, zeta).unwrap().with_light_at(0.6);
        let lift = recipe.lift(&view, zeta, 0.8 / 0.6);
        if !matches!(preset, PresetName::BabylonPcf | PresetName::UrpSoft) {
            let wanted = engine.world(&[], &on_axis).unwrap().least.along_axis(&on_axis).unwrap();
            assert!((lift - wanted).abs() < 1e-9, "{preset:?}: {lift} instead of {wanted}");
        }
        let reach = recipe.reach(&view, &seen) - recipe.unbiased().unwrap().reach(&view, &seen);
        let away = (view.eye_to_texel(moved) - seen.texel).abs().as_vec2();
        assert!(reach.abs_diff_eq(away, 1e-3), "{preset:?}: {reach} instead of {away}");
    }
    // Not all of them are nothing, and none is of a receiver that faces away.
    let (view, seen) = lit(false);
    assert!(of_engine(EngineBias::Bevy).of(&view, &seen).normal > 0.0);
    assert_eq!(of_engine(EngineBias::Bevy).of(&view, &Receiver { normal: -seen.normal, ..seen }), WorldBias::ZERO);
}

/// The defaults of three.js r187 (`LightShadow.js`, `shadowmap_pars_fragment.glsl.js`) and of HDRP's lights (`HDAdditionalLightData.cs`).
#[test]
fn engines_filters_have_the_engines_numbers() {
    let three = read("three-vsm");
    let filter = three.moments.filter;
    assert_eq!((three.moments.prefilter, three.moments.samples, three.rule), (1.0, 8, Rule::First));
    assert_eq!((filter.bleeding, filter.lit_from, filter.least_variance), (0.3, 0.95, 1e-7));
    let other = read("three-vsm,prefilter=4,blur-samples=25,lit-from=1").moments;
    assert_eq!((other.prefilter, other.samples, other.filter.lit_from), (4.0, 25, 1.0));
    let hdrp = read("hdrp-pcss").hdrp;
    assert_eq!((hdrp.diameter, hdrp.radius, hdrp.search, hdrp.blur, hdrp.rotate), (0.5, 0.025, 24, 16, true));
    let other = read("hdrp-pcss,angular-diameter=2,shape-radius=0.5,search=8,blur=64,rotate=off").hdrp;
    assert_eq!((other.diameter, other.radius, other.search, other.blur, other.rotate), (2.0, 0.5, 8, 64, false));
    // A large lamp has a larger slope bias under HDRP's soft shadows, and under its other filters not.
    let (view, seen) = lit(true);
    let slope = |text: &str| {
        let values = read(text);
        let DepthName::Engine(bias) = values.depth else { panic!("{text}") };
        values.of_engine(bias).of(&view, &seen).slope
    };
    assert_eq!([slope("hdrp-pcf5"), slope("hdrp-pcss"), slope("hdrp-pcss,slopeBias=1")], [2.5, 2.5, 5.0]);
    assert!((slope("hdrp-pcss,shape-radius=2") - 2.5 * 3.6).abs() < 1e-6, "18 in place of 5");
}

/// The conditions that a preset's own filter adds to those of a receiver.
fn under(preset: PresetName, conditions: Conditions) -> Conditions {
    match preset {
        PresetName::BabylonPcf => conditions.with_depth_texture(true),
        PresetName::UrpSoft => conditions.with_filter_radius(Some(2.5)),
        _ => conditions,
    }
}

/// What `umbrage bias --engine` prints is a recipe's end, and gives the bias that was wanted.
#[test]
fn settings_of_engines_are_fed_back_as_they_are_printed() {
    let all = PresetName::ENGINES.into_iter().flat_map(|preset| [(preset, true), (preset, false)]);
    for (preset, spot) in all {
        let (view, seen) = lit(spot);
        let conditions = under(preset, Conditions::of(&view, &seen).unwrap());
        let engine = preset.engine().unwrap();
        for wanted in [
            WorldBias::constant(0.3),
            WorldBias::slope(4.0),
            WorldBias::normal(0.05),
            WorldBias { constant: 0.2, slope: 3.0, normal: 0.02 },
        ] {
            let found = engine.settings(&wanted, &conditions).unwrap();
            let printed: Vec<String> = found.settings.iter().map(ToString::to_string).collect();
            let text = format!("{},{}", preset.name(), printed.join(", "));
            let recipe: Recipe = text.parse().unwrap();
            let DepthName::Engine(bias) = recipe.values.depth else { panic!("{preset:?}") };
            let given = recipe.values.of_engine(bias).of(&view, &seen);
            for part in Part::ALL {
                if found.unmet.iter().all(|unmet| unmet.part != part) {
                    let (given, wanted) = (given.part(part), wanted.part(part));
                    assert!(
                        (given - wanted).abs() < 2e-5 * wanted.abs().max(0.1),
                        "{text}: {part} {given}, not {wanted}"
                    );
                }
            }
            // The text that is written is as good, in TOML too.
            assert_eq!(recipe.to_string().parse(), Ok(recipe), "{text} as {recipe}");
            assert_eq!(Recipe::from_toml(&recipe.to_toml()), Ok(recipe), "{}", recipe.to_toml());
            assert_eq!(recipe.unbiased(), Recipe::from(preset).unbiased(), "{text}");
        }
    }
}

#[test]
fn settings_of_engines_have_the_engines_defaults_and_change_what_is_compared() {
    let (view, seen) = lit(true);
    for preset in PresetName::ENGINES {
        let alone = Recipe::from(preset);
        let compared = |recipe: &Recipe| {
            let depth = recipe.values.compared();
            let prepared = depth.prepared(&view, &seen);
            let bounds = prepared.bounds(TexelRect::of_size(view.size()));
            let place = prepared.region(&seen.footprint).centre;
            [bounds.min, bounds.max, place.x, place.y].map(f32::to_bits)
        };
        for info in preset.engine().unwrap().about().settings {
            let default = info.default.unwrap();
            let text = format!("{},{}={default}", preset.name(), info.name);
            let written: Recipe = text.parse().unwrap();
            assert_eq!((written, written.to_string()), (alone, preset.name().into()), "{text}");
            // A unit of a depth format is next to nothing, and a hundredth of all depth much.
            let changed = [0.01, 0.25, 64.0].into_iter().any(|by| {
                let other: Recipe = format!("{},{}={}", preset.name(), info.name, default + by).parse().unwrap();
                compared(&other) != compared(&alone)
            });
            assert!(changed, "{preset:?}, {}", info.name);
            // The engine's own arithmetic gives the same bits for a default that is given and for one that is not.
            let conditions = under(preset, Conditions::of(&view, &seen).unwrap());
            let engine = preset.engine().unwrap();
            let [given, none] =
                [&[(info.name, default)][..], &[]].map(|given| engine.world(given, &conditions).unwrap());
            assert_eq!(given, none, "{text}");
        }
    }
}

#[test]
fn settings_that_an_engine_does_not_have_are_refused_by_those_that_it_has() {
    assert_eq!(
        refused("godot-pcf,normalBias=1"),
        "setting = \"normalBias\": expected shadow_bias or shadow_normal_bias, the settings of godot"
    );
    assert_eq!(
        refused("woo92,normalBias=1"),
        "setting = \"normalBias\": expected none, unless depth is an engine's bias"
    );
    assert_eq!(
        refused("three-pcf,bias=1t"),
        "bias = \"1t\": expected a finite number (depth from 0 at the near plane to 1 at the far one)"
    );
    for text in ["three-pcf,normalBias=NaN", "urp-hard,depth bias=1..x", "bevy-gaussian,shadow_normal_bias="] {
        assert!(refused(text).contains(": expected a finite number ("), "{text}");
    }
    assert!(refused("three-pcf,depth=godot,normalBias=1").starts_with("setting = "));
    // With any filter, wherever the depth is named; and a bias of the recipe's own where the depth is not an engine's.
    let godot = read("woo92,shadow_bias=0.2,depth=godot");
    assert_eq!(godot, read("woo92,depth=godot, shadow_bias = 0.2"));
    assert_ne!(godot, read("woo92,depth=godot"));
    assert_eq!(read("three-pcf,bias=1t,depth=constant").biased, Biased::constant(Bias::Texels(1.0)));
    // Of a range, the end that gives what was wanted.
    assert_eq!(read("urp-hard,depth bias=0.5..2"), read("urp-hard,depth bias=2"));
}
