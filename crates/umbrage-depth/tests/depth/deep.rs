//! Deep maps: what passes, what compression may change, what is refused.

use glam::{DVec3, IVec2, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_depth::{DeepMap, DepthMap, MapError, Step, TagMap, Translucent, compress_steps};
use umbrage_plane::{View, mix32};

/// Random numbers of one texel, by two indices.
#[derive(Clone, Copy)]
struct Key(u32);

impl Key {
    fn bits(self, sample: u32, dim: u32) -> u32 {
        mix32(mix32(self.0 ^ 0x5EED).wrapping_add(sample * 8 + dim))
    }

    fn unit(self, sample: u32, dim: u32) -> f32 {
        (self.bits(sample, dim) >> 8) as f32 / 16_777_216.0
    }
}

fn view(side: u32) -> View {
    View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::X, 1.0, 0.0, 100.0, UVec2::splat(side)).unwrap()
}

fn one(steps: Vec<Step>) -> Result<DeepMap, MapError> {
    DeepMap::new(view(1), 0.0, [steps])
}

fn grey(steps: &[(f32, f32)]) -> Vec<Step> {
    steps.iter().map(|&(depth, passes)| Step { depth, passes: Vec3::splat(passes) }).collect()
}

fn passes(steps: &[Step], depth: f32) -> Vec3 {
    steps.iter().rev().find(|step| step.depth < depth).map_or(Vec3::ONE, |step| step.passes)
}

/// The largest difference of two step functions in any channel: looked for at, just before and just behind every step of both.
fn apart(a: &[Step], b: &[Step]) -> f64 {
    let places = a.iter().chain(b).flat_map(|step| [step.depth.next_down(), step.depth, step.depth.next_up()]);
    let gap = |at: f32| (passes(a, at).as_dvec3() - passes(b, at).as_dvec3()).abs().max_element();
    places.chain([f32::INFINITY]).map(gap).fold(0.0, f64::max)
}

#[test]
fn v56_b06_11_a_surface_darkens_what_is_behind_it_and_the_nearest_stands_for_the_texel() {
    let map = one(grey(&[(2.0, 0.6), (5.0, 0.0)])).unwrap();
    for (depth, light) in [(1.0, 1.0), (2.0, 1.0), (2.1, 0.6), (5.0, 0.6), (5.1, 0.0), (1e9, 0.0), (f32::INFINITY, 0.0)]
    {
        assert_eq!(map.transmittance(IVec2::ZERO, depth), Vec3::splat(light), "at {depth}");
    }
    assert_eq!(map.depth(IVec2::ZERO), 2.0, "the nearest, not the first opaque (T-19)");
    let outside = (map.transmittance(IVec2::new(1, 0), 9.0), map.depth(IVec2::NEG_ONE));
    assert_eq!(outside, (Vec3::ONE, f32::INFINITY), "outside");
    assert!(map.translucent().is_some_and(Translucent::is_grey));
    assert_eq!(map.bytes(), 32);
}

#[test]
fn ext_3_colours_pass_by_channel() {
    let red = vec![Step { depth: 1.0, passes: Vec3::new(0.9, 0.3, 0.0) }];
    let map = one(red).unwrap();
    assert_eq!(map.transmittance(IVec2::ZERO, 2.0), Vec3::new(0.9, 0.3, 0.0));
    assert!(map.translucent().is_some_and(|translucent| !translucent.is_grey()));
}

#[test]
fn what_is_no_deep_map_is_named_by_texel() {
    let problem = |steps: &[(f32, f32)]| one(grey(steps)).unwrap_err().to_string();
    assert!(problem(&[(5.0, 0.5), (2.0, 0.4)]).contains("texel (0, 0) of a deep map holds depths that do not ascend"));
    assert!(problem(&[(1.0, 0.5), (2.0, 0.6)]).contains("a transmittance that grows"));
    assert!(problem(&[(1.0, f32::NAN)]).contains("transmittance"));
    assert!(problem(&[(1.0, 1.5)]).contains("transmittance"));
    assert!(problem(&[(f32::NAN, 0.5)]).contains("a depth that is none"));
    assert!(problem(&[(1e30, 0.5)]).contains("a depth that is none"));
    for found in [3, 5] {
        let refused = DeepMap::new(view(2), 0.0, vec![Vec::new(); found]);
        assert_eq!(refused, Err(MapError::Length { width: 2, height: 2, found }));
    }
    assert_eq!(DeepMap::new(view(1), 1.0, [Vec::new()]), Err(MapError::Epsilon(1.0)));
}

/// A texel of up to 40 surfaces, some opaque, some nearly clear, in clusters.
fn random_texel(key: Key, coloured: bool) -> Vec<Step> {
    let count = key.bits(0, 0) % 41;
    let (mut depth, mut light) = (1.0f32, Vec3::ONE);
    (1..=count)
        .map(|i| {
            depth += if key.unit(i, 0) < 0.3 { 1e-3 } else { key.unit(i, 1) * 3.0 + 1e-3 };
            let thin = key.unit(i, 2).powi(3);
            let tint = |dim| 1.0 - thin * if coloured { key.unit(i, dim) } else { key.unit(i, 3) };
            light *= Vec3::new(tint(3), tint(4), tint(5)) * if key.unit(i, 6) < 0.02 { 0.0 } else { 1.0 };
            if !coloured {
                light = Vec3::splat(light.x);
            }
            Step { depth, passes: light }
        })
        .collect()
}

#[test]
fn a_fall_of_just_the_bound_is_not_rounded_into_it() {
    let epsilon = 0.02f32;
    for texel in 0..200_000 {
        let low = Key(texel).unit(0, 0) * 0.9;
        let steps = grey(&[(1.0, low + epsilon), (2.0, low)]);
        let found = apart(&steps, &compress_steps(&steps, epsilon));
        assert!(found <= f64::from(epsilon), "{low}: {found}");
    }
}

#[test]
fn what_is_looked_up_sixteen_at_a_time_is_the_nearest_surface() {
    use fearless_simd::{Level, dispatch, f32x16, prelude::*};
    let side = 9u32;
    let texels = (0..side * side).map(|i| random_texel(Key(i), true));
    let map = DeepMap::new(view(side), 0.0, texels).unwrap();
    let at = |i: usize| (Key(i as u32).unit(1, 0) * 11.0 - 1.0, Key(i as u32).unit(1, 1) * 11.0 - 1.0);
    let rect = umbrage_plane::TexelRect::new(IVec2::splat(-1), IVec2::splat(10));
    let found: [f32; 16] = dispatch!(Level::new(), simd => {
        let (x, y) = (std::array::from_fn(|i| at(i).0), std::array::from_fn(|i| at(i).1));
        map.look(simd, rect, f32x16::load_array(simd, x), f32x16::load_array(simd, y)).into()
    });
    for (i, found) in found.into_iter().enumerate() {
        let texel = IVec2::new(at(i).0.floor() as i32, at(i).1.floor() as i32);
        assert_eq!(found, map.depth(texel), "{texel}");
    }
}

#[test]
fn ext_3_compression_honours_its_bound_on_a_hundred_thousand_texels() {
    let mut steps = [0usize; 2];
    for texel in 0..100_000u32 {
        let key = Key(texel);
        let epsilon = [0.0, 0.002, 0.01, 0.05][(texel % 4) as usize];
        let full = random_texel(key, texel % 2 == 0 && texel % 8 < 4);
        let kept = compress_steps(&full, epsilon);
        let found = apart(&full, &kept);
        assert!(found <= f64::from(epsilon), "texel {texel}: {found} apart, {epsilon} allowed");
        assert_eq!(kept.first().map(|step| step.depth), full.first().map(|step| step.depth), "first surface");
        assert!(DeepMap::new(view(1), epsilon, [kept.clone()]).is_ok(), "texel {texel}");
        if epsilon > 0.0 {
            steps[0] += full.len();
            steps[1] += kept.len();
        }
    }
    assert!(steps[1] * 2 < steps[0], "{} of {} steps kept", steps[1], steps[0]);
}

/// The fewest levels that some partition of the steps into runs can have, by trying all of them.
fn fewest(levels: &[f32], epsilon: f64) -> usize {
    let mut best = vec![0usize; levels.len() + 1];
    for end in 1..=levels.len() {
        let run = |start: &usize| f64::from(levels[*start]) - f64::from(levels[end - 1]) <= 2.0 * epsilon;
        best[end] = (0..end).filter(run).map(|start| best[start] + 1).min().unwrap();
    }
    best[levels.len()]
}

proptest! {
    #[test]
    fn compression_keeps_as_few_steps_as_can_be(falls in prop::collection::vec(1u32..200, 1..14), bound in 1u32..100) {
        // Sixty-fourths of a thousandth are exact, so that no rounding decides.
        let (mut light, mut steps) = (8192u32, Vec::new());
        for (i, fall) in falls.iter().enumerate() {
            light = light.saturating_sub(*fall * 4);
            steps.push((i as f32 + 1.0, light as f32 / 8192.0));
        }
        let epsilon = bound as f32 / 8192.0;
        let kept = compress_steps(&grey(&steps), epsilon);
        let levels: Vec<f32> = steps.iter().map(|step| step.1).collect();
        prop_assert!(kept.len() <= fewest(&levels, f64::from(epsilon)));
        prop_assert!(apart(&grey(&steps), &kept) <= f64::from(epsilon));
    }

    #[test]
    fn a_bound_of_nothing_changes_nothing(seed in any::<u32>()) {
        let full = random_texel(Key(seed), true);
        prop_assert_eq!(apart(&full, &compress_steps(&full, 0.0)), 0.0);
    }
}

#[test]
fn wm94_16_a_map_of_ids_answers_inside_and_nothing_outside() {
    let map = TagMap::new(view(2), [Some(7), None, Some(0)]);
    let ids = [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE, IVec2::NEG_X].map(|texel| map.id(texel));
    assert_eq!(ids, [Some(7), None, Some(0), None, None]);
}
