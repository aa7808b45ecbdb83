use crate::{spot, sun};
use umbrage_engines::{Conditions, Engine, WorldBias};

#[track_caller]
fn refused(conditions: Conditions, line: &str) {
    for engine in Engine::ALL {
        let errors = [
            engine.settings(&WorldBias::ZERO, &conditions).unwrap_err(),
            engine.world(&[], &conditions).unwrap_err(),
            engine.unit(&conditions).unwrap_err(),
            WorldBias::ZERO.along_axis(&conditions).unwrap_err(),
        ];
        for error in errors {
            assert_eq!(error.to_string(), line);
        }
    }
}

#[test]
fn a_name_that_is_no_engine_lists_all_names_in_one_line() {
    let error = "unity".parse::<Engine>().unwrap_err().to_string();
    assert_eq!(
        error,
        "engine = \"unity\": expected rsl, three, babylon, filament, bevy, godot, urp, hdrp, unreal, d3d, vulkan or webgpu"
    );
    assert!("Three".parse::<Engine>().is_err() && "".parse::<Engine>().is_err());
}

#[test]
fn conditions_out_of_range_are_named_with_their_value() {
    for (bad, text) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf"), (0.0, "0"), (-1.0, "-1"), (1.5, "1.5")] {
        if bad <= 0.0 || !bad.is_finite() {
            let radius = sun().with_filter_radius(Some(bad));
            refused(radius, &format!("condition filter radius = {text} is not finite and above 0"));
        }
        refused(sun().with_facing(bad), &format!("condition facing = {text} is not above 0 and at most 1"));
        refused(sun().with_ray(bad), &format!("condition ray = {text} is not above 0 and at most 1"));
        if bad < 0.0 || !bad.is_finite() {
            refused(sun().with_slope(bad), &format!("condition slope = {text} is not finite and from 0"));
        }
    }
    let mut texel = sun();
    texel.texel = 0.0;
    refused(texel, "condition texel = 0 is not finite and above 0");
    let mut size = sun();
    size.map_size = 0;
    refused(size, "condition map size = 0 is not at least 1 texel");
    refused(sun().with_near(f64::NAN), "condition near = NaN is not finite");
    refused(spot().with_near(0.0), "condition near = 0 is not above 0, as it must be in perspective");
    refused(sun().with_far(f64::INFINITY), "condition far = inf is not finite and above near");
    refused(sun().with_far(0.0), "condition far = 0 is not finite and above near");
    refused(sun().with_near(50.0), "condition distance = 30 is not from near to far");
    refused(sun().with_light_at(f64::NAN), "condition facing = NaN is not above 0 and at most 1");
    refused(sun().with_light_at(0.0), "condition facing = 0 is not above 0 and at most 1");
}

#[test]
fn constructors_refuse_what_conditions_refuse() {
    let line = |made: Result<Conditions, umbrage_engines::EngineError>| made.unwrap_err().to_string();
    assert_eq!(line(Conditions::orthographic(0.0, 64, 0.0, 1.0, 0.5)), "condition texel = 0 is not finite and above 0");
    assert_eq!(line(Conditions::orthographic(1.0, 0, 0.0, 1.0, 0.5)), "condition map size = 0 is not at least 1 texel");
    assert_eq!(
        line(Conditions::orthographic(1.0, 64, 0.0, 1.0, f64::NAN)),
        "condition distance = NaN is not from near to far"
    );
    assert_eq!(
        line(Conditions::perspective(0.5, 64, 0.0, 1.0, 0.5)),
        "condition near = 0 is not above 0, as it must be in perspective"
    );
    for angle in [0.0, -1.0, f64::NAN, f64::INFINITY, 45.0] {
        let error = line(Conditions::perspective(angle, 64, 0.1, 1.0, 0.5));
        assert_eq!(error, format!("condition half angle = {angle} is not within (0, π/2) radians"));
    }
}

#[test]
fn wanted_biases_that_are_no_numbers_are_named() {
    for engine in Engine::ALL {
        for (wanted, line) in [
            (WorldBias::constant(f64::NAN), "bias constant = NaN is not finite"),
            (WorldBias::slope(f64::INFINITY), "bias slope = inf is not finite"),
            (WorldBias::normal(f64::NEG_INFINITY), "bias normal = -inf is not finite"),
        ] {
            assert_eq!(engine.settings(&wanted, &sun()).unwrap_err().to_string(), line);
        }
    }
}

#[test]
fn settings_that_are_not_known_or_no_numbers_are_named() {
    let line = |settings: &[(&str, f64)]| Engine::Three.world(settings, &sun()).unwrap_err().to_string();
    assert_eq!(line(&[("Bias", 1.0)]), "three has no setting \"Bias\": expected bias or normalBias");
    assert_eq!(line(&[("bias", f64::NAN)]), "setting bias = NaN is not finite");
    assert_eq!(line(&[("bias", 0.1), ("bias", 0.1)]), "setting bias is given twice");
}

#[test]
fn steps_that_lead_to_the_light_or_beyond_infinity_are_refused() {
    let step = Engine::Three.settings(&WorldBias::constant(10.0), &spot()).unwrap_err();
    assert_eq!(step.to_string(), "bias constant = 10 reaches the light, 10 away");
    let away = Engine::Three.world(&[("bias", 1.0)], &spot()).unwrap_err();
    assert_eq!(away.to_string(), "a step of depth of -1 leads beyond infinity from a receiver 10 away");
}
