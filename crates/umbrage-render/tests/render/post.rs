//! Williams' post-process: points of a finished picture through one matrix, and the stages behind the comparison.

use glam::{DVec3, UVec2, Vec3};
use std::sync::Arc;
use umbrage_bake::bake;
use umbrage_depth::{First, Raw, Tiled};
use umbrage_plane::{Bias, Kind, Rules, View};
use umbrage_raster::Cull;
use umbrage_render::post::{darken, low_pass, shadow_image};
use umbrage_render::{Frame, Soup, picture};
use umbrage_sample::Key;
use umbrage_scene::{Scene, gallery};
use umbrage_shadow::{ShadowMap, Unshadowed, Williams};

const KEY: Key = Key::new(0, 0, 0);
fn plain() -> Williams {
    Williams::default().with_bias(Bias::World(0.35))
}

fn scene(pixels: u32) -> Scene {
    let mut scene = gallery::sphere_plane();
    scene.camera = scene.camera.with_size(UVec2::splat(pixels)).unwrap();
    scene.lights[0].view = scene.lights[0].view.with_size(UVec2::splat(300)).unwrap().with_kind(Kind::Screen);
    scene
}

fn light(scene: &Scene) -> ShadowMap<Williams, Arc<Tiled>> {
    let view = &scene.lights[0].view;
    ShadowMap { filter: plain(), map: bake(view, Soup::casters(scene, view).triangles(), &First, Cull::None).map }
}

#[test]
fn w78_5_post_process_agrees_with_point_by_point_but_for_its_own_rounding() {
    let scene = scene(128);
    let light = light(&scene);
    let seen = picture(&scene, &[&light], &Frame::CENTRES);
    let visible = seen.depth.iter().filter(|z| z.is_finite()).count() as u64;
    let float = shadow_image(&seen.depth, &scene.camera, None, &light, KEY);
    assert_eq!(float.transforms, visible, "one transform a visible pixel, none for the background");
    let differ = |image: &[f32]| (0..image.len()).filter(|&i| image[i] != seen.shadow[0][i]).count();
    assert!(differ(&float.shadow) <= 20, "{}", differ(&float.shadow));
    let whole = shadow_image(&seen.depth, &scene.camera, Some(16), &light, KEY);
    let coarse = shadow_image(&seen.depth, &scene.camera, Some(8), &light, KEY);
    assert!(differ(&whole.shadow) < differ(&coarse.shadow), "fewer bits, more error (W78-6)");
    for bits in [0, 7, 25, 64] {
        let image = shadow_image(&seen.depth, &scene.camera, Some(bits), &light, KEY);
        assert!(image.shadow.iter().all(|s| *s == 0.0 || *s == 1.0));
    }
}

#[test]
fn t_15_background_pixels_are_skipped_and_stay_lit() {
    let mut scene = scene(64);
    scene.objects.truncate(1);
    let light = light(&scene);
    let seen = picture(&scene, &[&Unshadowed], &Frame::CENTRES);
    let image = shadow_image(&seen.depth, &scene.camera, Some(16), &light, KEY);
    let background = seen.depth.iter().filter(|z| !z.is_finite()).count() as u64;
    assert!(background > 500 && image.transforms + background == 64 * 64);
    assert!((0..image.shadow.len()).all(|i| seen.depth[i].is_finite() || image.shadow[i] == 0.0));
}

#[test]
fn c_10_a_point_behind_the_light_answers_by_the_light_s_rules() {
    // The observer looks away from the light: what it sees is behind it.
    let eye = |target| View::perspective(DVec3::ZERO, target, DVec3::Y, 1.0, 1.0, 50.0, UVec2::splat(8)).unwrap();
    let observer = eye(DVec3::NEG_Z);
    let zeta = vec![10.0; 64];
    let share = |rules| {
        let view = eye(DVec3::Z).with_rules(rules);
        let map = Raw::new(view, vec![f32::INFINITY; 64]).unwrap();
        shadow_image(&zeta, &observer, None, &ShadowMap { filter: plain(), map }, KEY).shadow
    };
    assert_eq!((share(Rules::SPOT), share(Rules::OPEN)), (vec![1.0; 64], vec![0.0; 64]));
}

#[test]
fn w78_17_low_pass_keeps_the_mean_and_spreads_by_binomials() {
    let size = UVec2::new(9, 7);
    let mut dot = vec![0.0; 63];
    dot[3 * 9 + 4] = 1.0;
    let once = low_pass(size, &dot, 1);
    assert_eq!(once[3 * 9 + 3..3 * 9 + 6], [0.125, 0.25, 0.125]);
    assert_eq!((once[2 * 9 + 3], once.iter().sum::<f32>()), (0.0625, 1.0));
    assert_eq!(low_pass(size, &dot, 0), dot);
    assert_eq!(low_pass(size, &dot, 3).iter().sum::<f32>(), 1.0);
    assert_eq!(low_pass(size, &[0.5; 63], 8), [0.5; 63], "borders repeat outward");
}

#[test]
fn w78_19_w78_20_darkening_dims_what_it_falls_on() {
    let colour = [Vec3::new(1.0, 0.5, 0.0), Vec3::ONE, Vec3::splat(2.0)];
    let dimmed = darken(&colour, &[0.0, 1.0, 0.5], 0.7);
    assert!(dimmed[1].abs_diff_eq(Vec3::splat(0.3), 1e-6) && dimmed[2].abs_diff_eq(Vec3::splat(1.3), 1e-6));
    assert_eq!(dimmed[0], colour[0]);
    assert_eq!(darken(&colour, &[1.0; 3], 1.0), [Vec3::ZERO; 3], "density 1 is black");
}

#[test]
fn w78_7_a_renderer_that_snaps_points_to_pixels_adds_its_error() {
    let scene = scene(96);
    let light = light(&scene);
    let snapped = Frame { axis: 1, stochastic: true, every_sample: true, ..Frame::CENTRES };
    let false_shadow = |frame: &Frame| {
        let seen = picture(&scene, &[&Unshadowed], frame);
        let image = shadow_image(&seen.depth, &scene.camera, None, &light, KEY);
        let exact = picture(&scene, &[&light], frame);
        (0..image.shadow.len()).filter(|&i| image.shadow[i] != exact.shadow[0][i]).count()
    };
    assert!(false_shadow(&snapped) > 4 * false_shadow(&Frame::CENTRES).max(5));
}
