use crate::{near, near_bias, ways};
use proptest::prelude::*;
use umbrage_engines::{Conditions, Engine, Part, WorldBias};

/// A light and a receiver in it, anywhere that is usual.
fn anywhere() -> impl Strategy<Value = Conditions> {
    let light = (any::<bool>(), 0.01..10.0f64, 1.5..1000.0f64, 0.02..0.98f64, 16u32..8192, 0.05..1.4f64);
    let surface = (0.05..0.999f64, 0.5..1.0f64, 0.5..4.0f64, any::<bool>());
    (light, surface).prop_map(|((perspective, near, times, at, size, wide), (facing, ray, radius, texture))| {
        let far = near * times;
        let distance = near + at * (far - near);
        let light = if perspective {
            Conditions::perspective(wide, size, near, far, distance).unwrap().with_ray(ray)
        } else {
            Conditions::orthographic(wide * 50.0, size, near, far, distance).unwrap()
        };
        light.with_light_at(facing).with_filter_radius(Some(radius)).with_depth_texture(texture)
    })
}

/// A value of each setting of an engine that it takes, made from three numbers from 0 to 1.
fn values(engine: Engine, share: [f64; 3], conditions: &Conditions) -> Vec<(&'static str, f64)> {
    let [a, b, c] = share;
    let sign = if conditions.reversed { -1.0 } else { 1.0 };
    match engine {
        Engine::Rsl => vec![("bias0", a), ("bias1", a)],
        Engine::Three => vec![("bias", -0.01 * a), ("normalBias", b)],
        Engine::Babylon => vec![("bias", 0.01 * a), ("normalBias", b)],
        Engine::Filament => vec![
            ("constantBias", 2.0 * a),
            ("normalBias", 3.0 * b),
            ("polygonOffsetConstant", 0.0),
            ("polygonOffsetSlope", 4.0 * c),
        ],
        Engine::Bevy => vec![("shadow_depth_bias", a), ("shadow_normal_bias", 4.0 * b)],
        Engine::Godot => vec![("shadow_bias", a), ("shadow_normal_bias", 5.0 * b)],
        Engine::Urp => vec![("depth bias", 0.1 + 9.8 * a), ("normal bias", 10.0 * b)],
        Engine::Hdrp => vec![("normalBias", 4.0 * a), ("slopeBias", b)],
        Engine::Unreal => vec![],
        Engine::D3d => {
            vec![("DepthBias", sign * 1000.0 * a), ("SlopeScaledDepthBias", sign * 4.0 * b), ("DepthBiasClamp", 0.0)]
        }
        Engine::Vulkan => vec![
            ("depthBiasConstantFactor", sign * 1000.0 * a),
            ("depthBiasSlopeFactor", sign * 4.0 * b),
            ("depthBiasClamp", 0.0),
        ],
        Engine::WebGpu => {
            vec![("depthBias", sign * 1000.0 * a), ("depthBiasSlopeScale", sign * 4.0 * b), ("depthBiasClamp", 0.0)]
        }
        other => panic!("{other} is new"),
    }
}

/// All engines but the one without a formula.
fn engines() -> impl Iterator<Item = Engine> {
    Engine::ALL.into_iter().filter(|engine| *engine != Engine::Unreal)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    /// The value that was set is what gives the least of its range at most, and the most of it at least.
    #[test]
    fn settings_come_back_from_the_bias_that_they_give(
        conditions in anywhere(), share in [1e-3..1.0f64, 1e-3..1.0f64, 1e-3..1.0f64],
    ) {
        for engine in engines() {
            for conditions in ways(conditions) {
                let given = values(engine, share, &conditions);
                prop_assert_eq!(given.len(), engine.about().settings.len());
                let Ok(world) = engine.world(&given, &conditions) else { continue };
                // Next to the light itself a distance has no digits left.
                if world.most.constant > 0.999_999 * conditions.distance && conditions.perspective { continue }
                let least = engine.settings(&world.least, &conditions).unwrap();
                let most = engine.settings(&world.most, &conditions).unwrap();
                prop_assert!(least.unmet.is_empty() && most.unmet.is_empty(), "{} {:?} {:?}", engine, least, most);
                for ((name, value), (least, most)) in given.iter().zip(least.settings.iter().zip(&most.settings)) {
                    prop_assert_eq!(least.info.name, *name);
                    prop_assert!(near(least.most, *value), "{} {} {} {}", engine, name, value, least.most);
                    prop_assert!(near(most.least, *value), "{} {} {} {}", engine, name, value, most.least);
                }
            }
        }
    }

    /// What is not reported as unmet is met: by the most of every setting at least, by the least of it at most.
    #[test]
    fn a_wanted_bias_is_met_or_reported(
        conditions in anywhere(), parts in [-1.0..1.0f64, -4.0..4.0f64, -1.0..1.0f64],
    ) {
        let wanted = WorldBias { constant: 0.4 * parts[0] * conditions.distance, slope: parts[1], normal: parts[2] };
        for engine in engines() {
            for conditions in ways(conditions) {
                let Ok(found) = engine.settings(&wanted, &conditions) else { continue };
                let of = |most: bool| {
                    let values = found.settings.iter();
                    let values: Vec<(&str, f64)> =
                        values.map(|one| (one.info.name, if most { one.most } else { one.least })).collect();
                    engine.world(&values, &conditions).unwrap()
                };
                let (most, least) = (of(true), of(false));
                for part in Part::ALL {
                    let amount = wanted.part(part);
                    let (low, high) = (least.most.part(part), most.least.part(part));
                    let met = near(low, amount) && near(high, amount);
                    let within = least.least.part(part) <= amount && amount <= most.most.part(part);
                    let reported = found.unmet.iter().any(|unmet| unmet.part == part && unmet.wanted == amount);
                    // Parts that cancel leave the rounding of the larger one.
                    let slack = 1e-6 * (wanted.constant.abs() + wanted.normal.abs());
                    let close = (low - amount).abs() <= slack && (high - amount).abs() <= slack;
                    prop_assert!(met || within || close || reported, "{} {} {} {} {}", engine, part, amount, low, high);
                    prop_assert!(!reported || !met, "{} {} {} is met", engine, part, amount);
                }
            }
        }
    }

    /// A bias that an engine can give whole comes back whole.
    #[test]
    fn a_bias_comes_back_from_the_settings_that_give_it(
        conditions in anywhere(), share in [1e-3..1.0f64, 1e-3..1.0f64, 1e-3..1.0f64],
    ) {
        for engine in engines() {
            for conditions in ways(conditions) {
                let Ok(world) = engine.world(&values(engine, share, &conditions), &conditions) else { continue };
                if world.most.constant > 0.999_999 * conditions.distance && conditions.perspective { continue }
                for (wanted, lower) in [(world.least, true), (world.most, false)] {
                    let found = engine.settings(&wanted, &conditions).unwrap();
                    let of = |most: bool| {
                        let values = found.settings.iter();
                        let values: Vec<(&str, f64)> =
                            values.map(|one| (one.info.name, if most { one.most } else { one.least })).collect();
                        engine.world(&values, &conditions).unwrap()
                    };
                    let (least, most) = (of(false), of(true));
                    if engine == Engine::Hdrp {
                        // Its constant part is its own, whatever is set.
                        prop_assert!(near_bias(&least.least, &world.least) && near_bias(&most.most, &world.most));
                        continue;
                    }
                    // URP takes nothing below 0 and above 10, which the other end of the range may want.
                    let (low, high) = (near_bias(&least.most, &wanted), near_bias(&most.least, &wanted));
                    let met = if engine != Engine::Urp { low && high } else if lower { high } else { low };
                    prop_assert!(met, "{} {:?} {:?} {:?}", engine, wanted, least, most);
                }
            }
        }
    }
}
