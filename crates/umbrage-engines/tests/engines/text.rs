use crate::{spot, sun};
use umbrage_engines::{Conditions, DepthFormat, Engine, WorldBias};

fn lines(engine: Engine, wanted: &WorldBias, conditions: &Conditions) -> (Vec<String>, Vec<String>) {
    let found = engine.settings(wanted, conditions).unwrap();
    (found.settings.iter().map(ToString::to_string).collect(), found.unmet.iter().map(ToString::to_string).collect())
}

#[test]
fn whole_settings_are_written_away_from_nothing() {
    let sixteen = sun().with_format(DepthFormat::Unorm16);
    let wanted = WorldBias { constant: 0.01, slope: 1.5, normal: 0.0 };
    // 0.0001 of depth are 6.5535 units.
    let (settings, unmet) = lines(Engine::D3d, &wanted, &sixteen);
    assert_eq!(settings, ["DepthBias = 7", "SlopeScaledDepthBias = 1.5", "DepthBiasClamp = 0"]);
    assert!(unmet.is_empty());
    let (settings, _) = lines(Engine::D3d, &wanted, &sixteen.with_reversed(true));
    assert_eq!(settings, ["DepthBias = -7", "SlopeScaledDepthBias = -1.5", "DepthBiasClamp = 0"]);
    // A unit of 2^-25 to 2^-23 at depth 0.3.
    let (settings, _) = lines(Engine::WebGpu, &wanted, &sun());
    assert_eq!(settings[0], "depthBias = 839..3356");
}

#[test]
fn ranges_and_six_digits_are_written() {
    let (settings, _) = lines(Engine::Vulkan, &WorldBias::constant(0.01), &sun().with_format(DepthFormat::Unorm16));
    assert_eq!(settings[0], "depthBiasConstantFactor = 3.2768..6.5536");
    let (settings, _) = lines(Engine::Three, &WorldBias::constant(1.0 / 3.0), &sun());
    assert_eq!(settings[0], "bias = -0.00333333");
}

#[test]
fn a_part_that_cannot_be_had_is_reported_with_its_reason() {
    let wanted = WorldBias { constant: 0.0, slope: 1.0, normal: 0.5 };
    let (settings, unmet) = lines(Engine::Three, &wanted, &sun());
    assert_eq!(settings, ["bias = 0", "normalBias = 0.5"]);
    assert_eq!(unmet, ["slope 1 is not met but 0: no setting grows with the slope"]);
    let (_, unmet) = lines(Engine::D3d, &wanted, &sun());
    assert_eq!(unmet, ["normal 0.5 is not met but 0: casters and receivers are not moved along their normals"]);
    let (_, unmet) = lines(Engine::Babylon, &WorldBias::normal(0.5), &sun().with_light_at(1.0));
    assert_eq!(unmet, ["normal 0.5 is not met but 0: the offset is nothing where the surface faces the light"]);
    let (settings, unmet) = lines(Engine::Filament, &WorldBias::constant(3.0), &spot());
    assert_eq!(settings[0], "constantBias = 2");
    assert_eq!(unmet, ["constant 3 is not met but 2: constantBias is clamped to 0 to 2"]);
    let (_, unmet) = lines(Engine::Urp, &WorldBias::constant(0.1), &sun());
    assert_eq!(unmet, ["slope 0 is not met but 2.5: a slope of 2.5 texels is always added, and cannot be set"]);
}

#[test]
fn what_an_engine_adds_by_itself_is_reported_as_a_range() {
    let (settings, unmet) = lines(Engine::Hdrp, &WorldBias::slope(2.5), &sun().with_format(DepthFormat::Unorm16));
    assert_eq!(settings, ["normalBias = 0", "slopeBias = 0.5"]);
    assert_eq!(
        unmet,
        [
            "constant 0 is not met but 0.00305176..0.00457764: the constant part is fixed: 1/65536 of depth, and one unit of the \
          depth format"
        ]
    );
}
