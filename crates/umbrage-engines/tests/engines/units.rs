use crate::{spot, sun};
use umbrage_engines::{Conditions, DepthFormat, Engine};

fn unit(engine: Engine, conditions: Conditions) -> [f64; 2] {
    engine.unit(&conditions).unwrap().unwrap()
}

#[test]
fn direct3d_and_webgpu_count_in_the_smallest_depth_of_a_format_of_whole_numbers() {
    for engine in [Engine::D3d, Engine::WebGpu] {
        assert_eq!(unit(engine, sun().with_format(DepthFormat::Unorm16)), [1.0 / 65_535.0; 2]);
        assert_eq!(unit(engine, sun().with_format(DepthFormat::Unorm24)), [1.0 / 16_777_215.0; 2]);
    }
}

#[test]
fn vulkan_bounds_its_unit_for_whole_numbers() {
    let bound = |bits: i32| [2f64.powi(-bits), 2.0 * 2f64.powi(-bits)];
    assert_eq!(unit(Engine::Vulkan, sun().with_format(DepthFormat::Unorm16)), bound(16));
    assert_eq!(unit(Engine::Vulkan, sun().with_format(DepthFormat::Unorm24)), bound(24));
}

#[test]
fn floating_point_counts_in_steps_of_the_largest_depth_of_a_primitive() {
    for engine in [Engine::D3d, Engine::Vulkan, Engine::WebGpu] {
        // The sun's receiver has depth 0.3 = 1.2 · 2^-2, reversed 0.7 = 1.4 · 2^-1.
        assert_eq!(unit(engine, sun()), [2f64.powi(-25), 2f64.powi(-23)]);
        assert_eq!(unit(engine, sun().with_reversed(true)), [2f64.powi(-24), 2f64.powi(-23)]);
        // The spot's is at 50 · 9.5/(10 · 49.5) = 0.9596, reversed 0.5 · 40/(10 · 49.5) = 0.0404 = 1.29 · 2^-5.
        assert_eq!(unit(engine, spot()), [2f64.powi(-24), 2f64.powi(-23)]);
        assert_eq!(unit(engine, spot().with_reversed(true)), [2f64.powi(-28), 2f64.powi(-23)]);
    }
}

#[test]
fn a_depth_of_nothing_has_the_exponent_of_the_smallest_normal_number() {
    let nearest = Conditions::orthographic(20.0, 64, 0.0, 100.0, 0.0).unwrap();
    assert_eq!(unit(Engine::D3d, nearest), [2f64.powi(-126 - 23), 2f64.powi(-23)]);
    let farthest = Conditions::orthographic(20.0, 64, 0.0, 100.0, 100.0).unwrap();
    assert_eq!(unit(Engine::D3d, farthest), [2f64.powi(-23); 2]);
    assert_eq!(unit(Engine::D3d, farthest.with_reversed(true)), [2f64.powi(-149), 2f64.powi(-23)]);
}

#[test]
fn engines_have_no_such_unit() {
    for engine in Engine::ALL {
        let interface = [Engine::D3d, Engine::Vulkan, Engine::WebGpu].contains(&engine);
        assert_eq!(engine.unit(&sun()).unwrap().is_some(), interface, "{engine}");
    }
}

/// `depth_bias.spec.ts` of WebGPU's conformance tests: 8388608 units are a quarter for a primitive at a depth of a quarter.
#[test]
fn webgpu_agrees_with_its_conformance_tests() {
    let quarter = Conditions::orthographic(1.0, 1, 0.0, 1.0, 0.25).unwrap();
    let given = Engine::WebGpu.world(&[("depthBias", 8_388_608.0)], &quarter).unwrap();
    // The primitive lies at one depth, so that the least is what is drawn; one unit of depth is one of distance here.
    assert_eq!(given.least.constant, 0.25);
    let clamped = Engine::WebGpu.world(&[("depthBias", 8_388_608.0), ("depthBiasClamp", 0.125)], &quarter).unwrap();
    assert_eq!(clamped.least.constant, 0.125);
    let away = Engine::WebGpu.world(&[("depthBias", -8_388_608.0), ("depthBiasClamp", -0.125)], &quarter).unwrap();
    assert_eq!(away.most.constant, -0.125);
}
