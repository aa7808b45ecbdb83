//! One example for each engine that can be followed by hand.

use crate::{near, spot, sun};
use std::f64::consts::SQRT_2;
use umbrage_engines::{Conditions, DepthFormat, Engine, WorldBias, WorldRange};

fn given(engine: Engine, settings: &[(&str, f64)], conditions: &Conditions) -> WorldRange {
    engine.world(settings, conditions).unwrap()
}

#[track_caller]
fn is(range: WorldRange, constant: f64, slope: f64, normal: f64) {
    assert_eq!(range.least, range.most);
    let bias = range.least;
    assert!(near(bias.constant, constant) && near(bias.slope, slope) && near(bias.normal, normal), "{bias:?}");
}

/// The sine of 60 degrees, by which both lights' surfaces are tilted.
fn sine() -> f64 {
    0.75f64.sqrt()
}

#[test]
fn rsl_biases_are_world_units_and_the_ends_of_a_ramp() {
    is(given(Engine::Rsl, &[("bias0", 0.25), ("bias1", 0.25)], &spot()), 0.25, 0.0, 0.0);
    let ramp = given(Engine::Rsl, &[("bias0", 0.1), ("bias1", 0.4)], &spot());
    assert_eq!(ramp, WorldRange { least: WorldBias::constant(0.1), most: WorldBias::constant(0.4) });
}

#[test]
fn three_bias_is_a_step_of_depth_toward_the_light_where_it_is_negative() {
    // 100 units of range: a thousandth is a tenth.
    is(given(Engine::Three, &[("bias", -0.001), ("normalBias", 0.02)], &sun()), 0.1, 0.0, 0.02);
    // z(ζ) = 50(ζ − 0.5)/(49.5 ζ): z(10) = 475/495, z(9) = 425/445.5. The step from 10 to 9 is −2.5/445.5.
    is(given(Engine::Three, &[("bias", -2.5 / 445.5)], &spot()), 1.0, 0.0, 0.0);
}

#[test]
fn babylon_bias_is_a_fraction_of_the_range_or_half_a_depth() {
    // 0.00005 of 100, and 0.02 times the sine.
    is(given(Engine::Babylon, &[("normalBias", 0.02)], &sun()), 0.005, 0.0, 0.02 * sine());
    // Linear for the spot light as well: 0.01 of 49.5.
    is(given(Engine::Babylon, &[("bias", 0.01)], &spot()), 0.495, 0.0, 0.0);
    // A depth texture: half of it is depth, a hundredth of 100 for the sun and the step from 10 to 9 for the spot.
    is(given(Engine::Babylon, &[("bias", 0.02)], &sun().with_depth_texture(true)), 1.0, 0.0, 0.0);
    is(given(Engine::Babylon, &[("bias", 5.0 / 445.5)], &spot().with_depth_texture(true)), 1.0, 0.0, 0.0);
}

#[test]
fn filament_biases_are_world_units_texels_and_a_polygon_offset() {
    // Texels of 20/1024: a normal bias of 1 is half of one times the sine for the sun. Nothing is left of polygonOffsetConstant.
    let plain = [("constantBias", 0.01), ("polygonOffsetConstant", 0.0)];
    is(given(Engine::Filament, &plain, &sun()), 0.01, 2.0, 0.5 * 20.0 / 1024.0 * sine());
    // A whole texel of 20/1000 for the spot.
    is(given(Engine::Filament, &plain, &spot()), 0.01, 2.0, 0.02 * sine());
    // Half a unit of 16 bits, r from 2^-16 to 2^-15, of 100: 0.000763 to 0.001526 more.
    let offset = given(Engine::Filament, &[("constantBias", 0.0)], &sun().with_format(DepthFormat::Unorm16));
    assert!(near(offset.least.constant, 50.0 / 65_536.0) && near(offset.most.constant, 50.0 / 32_768.0));
    // Clamped to 2 and 3.
    let clamped = [("constantBias", 5.0), ("normalBias", 9.0), ("polygonOffsetConstant", 0.0)];
    is(given(Engine::Filament, &clamped, &spot()), 2.0, 2.0, 3.0 * 0.02 * sine());
}

#[test]
fn bevy_biases_are_world_units_along_the_ray_and_texels_of_the_square_root_of_two() {
    // The defaults, 0.02 and 1.8.
    is(given(Engine::Bevy, &[], &sun()), 0.02, 0.0, 1.8 * SQRT_2 * 20.0 / 1024.0);
    // A receiver off the axis: along the ray, so less along the axis.
    is(given(Engine::Bevy, &[], &spot().with_ray(0.8)), 0.016, 0.0, 1.8 * SQRT_2 * 0.02);
}

#[test]
fn godot_biases_are_hundredths_of_the_range_and_texels() {
    // 0.1 hundredths of 100, twice for the filter's radius, is 0.2. Two texels of 20/1024, without their part along the light: N·L is ½.
    let texels = 2.0 * 20.0 / 1024.0;
    is(given(Engine::Godot, &[], &sun()), 0.2 - 0.5 * texels, 0.0, texels);
    is(given(Engine::Godot, &[("shadow_normal_bias", 0.0)], &sun().with_filter_radius(Some(1.0))), 0.1, 0.0, 0.0);
    // A spot light at 10 of 50: 0.1/100 · 50/10/10 = 0.0005 of depth; the slope of depth at 10 is 0.5 · 50/(49.5 · 100), so 0.0990 to first
    // order, and 0.0990/(1 + 0.0099) after all. The offset is 2 · 10/1000 · 10 · (1 − ½).
    let linear = 0.0005 / (25.0 / 4950.0);
    is(given(Engine::Godot, &[], &spot()), linear / (1.0 + linear / 10.0), 0.0, 0.1);
}

#[test]
fn urp_biases_are_texels_and_what_it_adds_by_itself() {
    // 16 bits: one unit from 2^-16 to 2^-15 of 100 is 0.001526 to 0.003052, besides one texel of 20/1024; N·L is ½.
    let texel = 20.0 / 1024.0;
    let found = given(Engine::Urp, &[], &sun().with_format(DepthFormat::Unorm16));
    assert!(near(found.least.constant, texel + 100.0 / 65_536.0), "{found:?}");
    assert!(near(found.most.constant, texel + 100.0 / 32_768.0), "{found:?}");
    assert_eq!(found.least.slope, 2.5);
    assert!(near(found.least.normal, 0.5 * texel));
    // Soft shadows of medium quality: 2.5 times that.
    let soft = given(Engine::Urp, &[], &sun().with_filter_radius(Some(2.5)));
    assert!(near(soft.least.normal, 1.25 * texel));
    // A spot's texel is half of one at 50, 0.05, though they are 0.02 at 10.
    assert!(near(given(Engine::Urp, &[], &spot()).least.normal, 0.025));
}

#[test]
fn hdrp_biases_are_texels_of_the_square_root_of_two_and_five_texels_of_slope() {
    // 1/65536 of 100 and one unit of 24 bits, from 2^-24 to 2^-23.
    let found = given(Engine::Hdrp, &[], &sun().with_format(DepthFormat::Unorm24));
    assert!(near(found.least.constant, 100.0 / 65_536.0 + 100.0 / 16_777_216.0), "{found:?}");
    assert!(near(found.most.constant, 100.0 / 65_536.0 + 100.0 / 8_388_608.0), "{found:?}");
    assert_eq!(found.least.slope, 2.5);
    assert!(near(found.least.normal, 0.75 * SQRT_2 * 20.0 / 1024.0));
    // A spot's texel is taken at the distance from the light, 10/0.8.
    assert!(near(given(Engine::Hdrp, &[], &spot().with_ray(0.8)).least.normal, 0.75 * SQRT_2 * 0.025));
}

#[test]
fn unreal_gives_no_number() {
    let refused = Engine::Unreal.world(&[], &sun()).unwrap_err().to_string();
    assert!(refused.starts_with("unreal: the engine's documentation gives its bias settings no formula"), "{refused}");
    assert_eq!(Engine::Unreal.settings(&WorldBias::ZERO, &sun()).unwrap_err().to_string(), refused);
}

#[test]
fn direct3d_biases_are_units_and_texels() {
    // 655.35 units of 1/65535 are a hundredth of depth, one of 100.
    let sixteen = sun().with_format(DepthFormat::Unorm16);
    is(given(Engine::D3d, &[("DepthBias", 655.35), ("SlopeScaledDepthBias", 1.5)], &sixteen), 1.0, 1.5, 0.0);
    // Reversed depth wants negative ones.
    let turned = sixteen.with_reversed(true);
    is(given(Engine::D3d, &[("DepthBias", -655.35), ("SlopeScaledDepthBias", -1.5)], &turned), 1.0, 1.5, 0.0);
}

#[test]
fn a_clamp_is_the_bias_where_it_limits_the_sum() {
    // On the sun's surface, tan 60° times 20/1024 of 100 is 0.000338 of depth from texel to texel. With a clamp of 0.002 that holds twice
    // over, and three times with 655.35 units, a hundredth, does not.
    let sixteen = sun().with_format(DepthFormat::Unorm16);
    let set = |units: f64, clamp: f64| [("DepthBias", units), ("SlopeScaledDepthBias", 2.0), ("DepthBiasClamp", clamp)];
    is(given(Engine::D3d, &set(0.0, 0.002), &sixteen), 0.0, 2.0, 0.0);
    is(given(Engine::D3d, &set(655.35, 0.002), &sixteen), 0.2, 0.0, 0.0);
}

#[test]
fn vulkan_biases_are_units_within_its_bound_and_texels() {
    // 1000 units from 2^-16 to 2^-15 of 100.
    let sixteen = sun().with_format(DepthFormat::Unorm16);
    let found = given(Engine::Vulkan, &[("depthBiasConstantFactor", 1000.0), ("depthBiasSlopeFactor", 1.75)], &sixteen);
    assert!(near(found.least.constant, 100_000.0 / 65_536.0) && near(found.most.constant, 100_000.0 / 32_768.0));
    assert_eq!((found.least.slope, found.most.slope), (1.75, 1.75));
}

#[test]
fn webgpu_biases_are_units_of_the_primitives_exponent() {
    // At depth 0.3 a unit is 2^-25 to 2^-23: 2^20 of them are 1/32 to 1/8 of 100.
    let found = given(Engine::WebGpu, &[("depthBias", 1_048_576.0), ("depthBiasSlopeScale", 3.0)], &sun());
    assert_eq!((found.least.constant, found.most.constant), (3.125, 12.5));
    assert_eq!(found.least.slope, 3.0);
}
