//! From scene to picture: what must not change a bit, and what lights and objects do to it.

use glam::{UVec2, Vec3};
use std::sync::Arc;
use umbrage_bake::{advised_map_sizes, bake};
use umbrage_depth::{First, Raw, Storage, Tiled};
use umbrage_plane::{Bias, Sampling, SurfacePoint, View, cube_views};
use umbrage_raster::Cull;
use umbrage_recipe::{Recipe, bind};
use umbrage_render::{Frame, Picture, Soup, picture};
use umbrage_sample::Key;
use umbrage_scene::{Scene, gallery};
use umbrage_shadow::{Around, LatLong, Shadow, Unshadowed, presets};

fn small(mut scene: Scene, pixels: u32, texels: u32) -> Scene {
    scene.camera = scene.camera.with_size(UVec2::splat(pixels)).unwrap();
    for light in &mut scene.lights {
        light.view = light.view.with_size(UVec2::splat(texels)).unwrap();
    }
    scene
}

fn map(scene: &Scene, view: &View) -> Arc<Tiled> {
    bake(view, Soup::casters(scene, view).triangles(), &First, Cull::None).map
}

/// All of a picture as bits, so that NaN is equal to itself.
fn bits(picture: &Picture) -> Vec<u32> {
    let colour = picture.colour.iter().flat_map(|c| <[f32; 3]>::from(*c));
    let shadow = picture.shadow.iter().flatten().copied();
    let place = picture.position.iter().flat_map(|p| <[f32; 3]>::from(p.as_vec3()));
    colour.chain(shadow).chain(place).chain(picture.depth.iter().copied()).map(f32::to_bits).collect()
}

fn shot(scene: &Scene, recipe: &str, storage: Storage, frame: &Frame) -> Picture {
    let recipe: Recipe = recipe.parse().unwrap();
    let shadows: Vec<Box<dyn Shadow>> =
        scene.lights.iter().map(|light| recipe.bind(map(scene, &light.view), storage).unwrap()).collect();
    let shadows: Vec<&dyn Shadow> = shadows.iter().map(AsRef::as_ref).collect();
    picture(scene, &shadows, frame)
}

#[test]
fn c9_threads_and_storages_change_no_bit() {
    let scene = small(gallery::sphere_plane(), 72, 200);
    let frame = Frame { axis: 2, seed: 3, ..Frame::default() };
    for recipe in [
        "reeves87",
        "reeves87,pattern=uniform,depth=plane,bias=0.3",
        "reeves87,pattern=warp",
        "williams78,dither=1",
        "ordinary",
    ] {
        let expected = bits(&shot(&scene, recipe, Storage::Raw, &frame));
        for storage in [Storage::Raw, Storage::Bbox, Storage::Tiled] {
            for threads in [1, 2, 5] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let found = bits(&pool.install(|| shot(&scene, recipe, storage, &frame)));
                assert!(found == expected, "{recipe}, {storage:?}, {threads} threads");
            }
        }
    }
}

/// Batches of thousands of points are split over the threads of a pool, where the renderer wants that: each answer is that of its point alone.
#[test]
fn c9_batches_of_any_length_are_the_bits_of_their_points() {
    let scene = small(gallery::sphere_plane(), 8, 128);
    let view = &scene.lights[0].view;
    let own = map(&scene, view);
    let faces = cube_views(view.light().truncate(), view.near(), view.far(), 64).unwrap();
    let faces: Vec<Arc<Tiled>> = faces.iter().map(|face| map(&scene, face)).collect();
    let cube = Around::new(presets::reeves87().filter, faces.clone()).unwrap();
    let flat = LatLong::from_maps(presets::reeves87().filter, &faces, UVec2::new(64, 32)).unwrap();
    let shadows: [(&str, Box<dyn Shadow>); 3] = [
        ("one map", Box::new(presets::reeves87().over(own).unwrap())),
        ("cube", Box::new(cube)),
        ("lat-long", Box::new(flat)),
    ];
    let points: Vec<SurfacePoint> = (0..9001)
        .map(|i| {
            let at = Vec3::new((i % 95) as f32 - 47.0, (i / 95) as f32 - 47.0, 0.0);
            let corner = |x: f32, y: f32| at + Vec3::new(x, y, 0.0);
            let corners = [corner(-0.5, 0.5), corner(0.5, 0.5), corner(0.5, -0.5), corner(-0.5, -0.5)];
            SurfacePoint { region: i, ..SurfacePoint::at(at, Vec3::Z).with_corners(corners) }
        })
        .collect();
    let key = Key::new(5, 0, 0);
    for (name, shadow) in shadows {
        let expected: Vec<u32> = points.iter().map(|point| shadow.fraction(point, key).to_bits()).collect();
        assert!(expected.iter().any(|bits| *bits != 0) && expected.contains(&0), "{name}: shadow and light");
        for threads in [1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            for length in [9001, 4096, 4095, 1] {
                let mut found = vec![f32::NAN; length];
                pool.install(|| shadow.fractions(&points[..length], key, &mut found));
                let found: Vec<u32> = found.iter().map(|fraction| fraction.to_bits()).collect();
                assert!(found == expected[..length], "{name}, {threads} threads, {length} points");
            }
        }
    }
}

#[test]
fn r87_25_frames_have_their_own_noise_and_static_ones_share_it() {
    let scene = small(gallery::sphere_plane(), 48, 128);
    let shot = |frame: &Frame| bits(&shot(&scene, "reeves87,res-factor=8", Storage::Tiled, frame));
    let still = Frame::CENTRES;
    assert_ne!(shot(&still), shot(&Frame { number: 1, ..still }));
    assert_ne!(shot(&still), shot(&Frame { seed: 1, ..still }));
}

#[test]
fn r87_5_an_excluded_plane_still_receives_and_does_not_shadow_itself() {
    let mut scene = small(gallery::sphere_plane(), 64, 256);
    scene.objects[1].casts = false;
    let map = map(&scene, &scene.lights[0].view);
    // Without bias the casting plane would be half in false shadow.
    let shadow = bind(presets::ordinary(Bias::ZERO).filter, &map, Storage::Tiled);
    let seen = picture(&scene, &[&*shadow], &Frame::CENTRES);
    let on_plane =
        |wanted: f32| (0..seen.object.len()).filter(|&i| seen.object[i] == 1 && seen.shadow[0][i] == wanted).count();
    assert!(on_plane(1.0) > 100 && on_plane(0.0) > 1000, "{} dark, {} lit", on_plane(1.0), on_plane(0.0));
    let with_plane = bind(
        presets::ordinary(Bias::ZERO).filter,
        self::map(&small(gallery::sphere_plane(), 64, 256), &scene.lights[0].view),
        Storage::Tiled,
    );
    let acne = picture(&scene, &[&*with_plane], &Frame::CENTRES);
    let dark = |picture: &Picture| picture.shadow[0].iter().filter(|s| **s == 1.0).count();
    assert!(dark(&acne) > dark(&seen) + 500);
}

#[test]
fn r87_7_w78_26_every_light_has_a_map_of_its_own_size_and_its_own_shadow_image() {
    let mut scene = small(gallery::three_lights(), 64, 128);
    for (light, texels) in scene.lights.iter_mut().zip([64, 128, 256]) {
        light.view = light.view.with_size(UVec2::splat(texels)).unwrap();
    }
    let all = shot(&scene, "reeves87", Storage::Tiled, &Frame::CENTRES);
    for light in 0..3 {
        let alone = Scene { lights: vec![scene.lights[light].clone()], ..scene.clone() };
        let alone = shot(&alone, "ordinary,bias=0.4", Storage::Tiled, &Frame::CENTRES);
        let differ =
            (0..alone.depth.len()).filter(|&i| (alone.shadow[0][i] - all.shadow[light][i]).abs() > 0.9).count();
        assert!(differ < alone.depth.len() / 20, "light {light}: {differ} pixels");
    }
    assert_ne!(all.shadow[0], all.shadow[1]);
}

#[test]
fn v22_r87_23_each_shadow_takes_its_own_light_s_colour_away() {
    let mut scene = small(gallery::three_lights(), 200, 512);
    scene.ambient = Vec3::splat(0.05);
    let seen = shot(&scene, "ordinary,bias=0.6", Storage::Tiled, &Frame::CENTRES);
    let mut classes = [0u32; 8];
    for i in (0..seen.object.len()).filter(|&i| seen.object[i] == 1) {
        let dark = [0, 1, 2].map(|light| seen.shadow[light][i] == 1.0);
        let colour = seen.colour[i].to_array();
        for (channel, dark) in dark.into_iter().enumerate() {
            // Only ambient light is left in the channel of a blocked light.
            assert_eq!(dark, colour[channel] <= 0.05 * 0.75 + 1e-6, "pixel {i}, channel {channel}: {colour:?}");
        }
        classes[dark.iter().enumerate().map(|(bit, dark)| usize::from(*dark) << bit).sum::<usize>()] += 1;
    }
    assert!(classes.iter().filter(|count| **count > 40).count() >= 6, "{classes:?}");
}

#[test]
fn w78_4_w78_5_w78_22_transforms_grow_with_depth_complexity_point_by_point_and_not_afterwards() {
    let scene = small(gallery::sphere_plane(), 64, 64);
    let mut deeper = scene.clone();
    // A second slab behind the first adds fragments and shows nowhere.
    let mut behind = scene.objects[1].clone();
    if let umbrage_scene::Shape::Mesh(mesh) = &mut behind.shape {
        for position in &mut mesh.positions {
            position.z -= 20.0;
            position.x *= 0.9;
            position.y *= 0.9;
        }
    }
    deeper.objects.push(behind);
    let [one, two] = [&scene, &deeper].map(|scene| picture(scene, &[&Unshadowed], &Frame::CENTRES));
    assert_eq!(one.depth, two.depth);
    assert!(two.fragments > one.fragments + 1000, "{} {}", two.fragments, one.fragments);
    assert_eq!(two.passing, one.passing, "what lies behind fails the depth test");
    assert!(one.passing < one.fragments);
    let visible = one.depth.iter().filter(|z| z.is_finite()).count() as u64;
    assert!(one.passing >= visible && one.regions == visible);
}

#[test]
fn w78_1_w78_2_two_views_of_512_with_16_bit_depth_and_a_light_at_infinity() {
    let scene = gallery::four_spheres();
    let light = &scene.lights[0].view;
    assert_eq!((scene.camera.size(), light.size()), (UVec2::splat(512), UVec2::splat(512)));
    assert!(!light.is_perspective(), "the light is at infinity");
    let map = umbrage_depth::quantise(&Raw::copy_of(&map(&scene, light)), 16, false);
    let mut codes = 0;
    for depth in map.depths().iter().filter(|depth| depth.is_finite()) {
        let code = f64::from(*depth) * 65_535.0;
        assert!((code - code.round()).abs() < 0.01 && code < 65_535.0, "{code}");
        codes += 1;
    }
    assert!(codes > 10_000);
    assert_eq!(presets::williams78().filter.bias, Bias::Map(2.0 / 65_535.0));
}

#[test]
fn r87_3_stochastic_maps_are_the_same_each_time_and_differ_by_seed() {
    let scene = small(gallery::sphere_plane(), 32, 96);
    let sampled = |sampling| map(&scene, &scene.lights[0].view.with_sampling(sampling));
    let jittered = |seed| sampled(Sampling::Jittered { seed });
    assert_eq!(jittered(1), jittered(1));
    assert_ne!(jittered(1), jittered(2));
    assert_ne!(jittered(1), sampled(Sampling::Centre));
}

#[test]
fn r87_6_advice_for_the_map_s_size() {
    assert_eq!(advised_map_sizes(UVec2::new(640, 480)), (UVec2::new(640, 480), UVec2::new(1280, 960)));
}

#[test]
fn objects_that_do_not_receive_stay_lit() {
    let mut scene = small(gallery::sphere_plane(), 48, 128);
    scene.objects[1].receives = false;
    let seen = shot(&scene, "reeves87", Storage::Tiled, &Frame::CENTRES);
    assert!((0..seen.object.len()).filter(|&i| seen.object[i] == 1).all(|i| seen.shadow[0][i] == 0.0));
}
