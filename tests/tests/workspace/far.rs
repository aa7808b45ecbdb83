//! Far from the world's origin, and in worlds of another scale, shadows are what they are at home.

use glam::{DVec3, UVec2, Vec3};
use umbrage_bake::bake;
use umbrage_depth::{DepthMap, Storage};
use umbrage_io::{DEFAULT_BUDGET, decode_shadow_map, encode_shadow_map};
use umbrage_oracle::{Geometry, RayCast};
use umbrage_plane::{Kind, cube_views};
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, Ground, Picture, Planar, Soup, light_map, picture, post};
use umbrage_sample::Key;
use umbrage_scene::{Scene, gallery};
use umbrage_shadow::{Around, LatLong, Shadow, ShadowMap, presets};

/// How far a scene is moved, off the grid of f32 and of all powers of two.
const OFFSETS: [DVec3; 2] = [DVec3::new(1000.1, -299.7, 700.3), DVec3::new(1_000_000.1, -299_999.7, 700_000.3)];

/// Every preset and some mixtures, as `scene` needs them where lengths of the world are `scale` times as long.
fn recipes(scene: &Scene, scale: f32) -> Vec<String> {
    // Texels of the table's map are thirty times as wide in the world as Reeves' own.
    let unit = if scene.name == "table" { 30.0 * scale } else { scale };
    let bias = format!("bias={}..{}", 0.3 * unit, 0.4 * unit);
    let mut all = presets(unit, &bias);
    all.push(format!("reeves87,stored=deep,{bias}"));
    all
}

fn presets(unit: f32, bias: &str) -> Vec<String> {
    vec![
        "auto".into(),
        "williams78".into(),
        format!("reeves87,{bias}"),
        format!("reeves87-recommended,{bias}"),
        "woo92".into(),
        "wang-molnar94".into(),
        "burley".into(),
        format!("burley,light={},nearest={}", 2.0 * unit, 20.0 * unit),
        "fernando".into(),
        format!("ordinary,bias={}", 0.3 * unit),
        format!("reeves87,depth=plane,bias={}", 0.1 * unit),
        format!("reeves87,depth=cone,pattern=disc,bias={}", 0.1 * unit),
    ]
}

fn small(mut scene: Scene, pixels: u32, texels: u32) -> Scene {
    scene.camera = scene.camera.with_size(UVec2::splat(pixels)).unwrap();
    for light in &mut scene.lights {
        light.view = light.view.with_size(UVec2::splat(texels)).unwrap();
    }
    scene
}

/// Williams' bias is one of screen depth.
fn as_meant(mut scene: Scene, recipe: &str) -> Scene {
    if recipe.starts_with("williams78") {
        scene.lights[0].view = scene.lights[0].view.with_kind(Kind::Screen);
    }
    scene
}

fn shot(scene: &Scene, recipe: &str) -> Picture {
    let parsed: Recipe = recipe.parse().unwrap();
    let shadow = parsed.bind(light_map(&parsed, scene, &scene.lights[0].view), Storage::Tiled).unwrap();
    picture(scene, &[&*shadow], &Frame::CENTRES)
}

/// At most one receiver in ten thousand may change by more than a thousandth, the mean by no more than 10⁻⁵. What differs by
/// more, as a line.
fn unlike(found: &[f32], expected: &[f32], what: &str) -> Option<String> {
    assert_eq!(found.len(), expected.len());
    let changed = found.iter().zip(expected).filter(|(a, b)| (**a - **b).abs() > 1e-3).count();
    let mean = |values: &[f32]| values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64;
    let moved = mean(found) - mean(expected);
    // A picture without a shadow would pass.
    assert!((0.02..0.9).contains(&mean(expected)), "{what}: nothing to see");
    let line = format!("{what}: {changed} of {} receivers changed, the mean by {moved:e}", found.len());
    (changed * 10_000 > found.len() || moved.abs() > 1e-5).then_some(line)
}

fn assert_alike(found: &[f32], expected: &[f32], what: &str) {
    assert_eq!(unlike(found, expected, what), None);
}

fn scenes() -> Vec<Scene> {
    vec![small(gallery::sphere_plane(), 200, 256), small(gallery::table(), 200, 512)]
}

#[test]
fn a_scene_moved_with_its_light_keeps_the_shadows_of_every_preset() {
    for scene in scenes() {
        for recipe in recipes(&scene, 1.0) {
            let home = as_meant(scene.clone(), &recipe);
            let expected = shot(&home, &recipe);
            for by in OFFSETS {
                let found = shot(&home.clone().moved(by).unwrap(), &recipe);
                let what = format!("{}, {recipe}, {by}", scene.name);
                assert_alike(&found.shadow[0], &expected.shadow[0], &what);
                let off = found.colour.iter().zip(&expected.colour).filter(|(a, b)| !a.abs_diff_eq(**b, 1e-3)).count();
                assert!(off * 10_000 <= found.colour.len(), "{what}: {off} colours");
            }
        }
    }
}

#[test]
fn patches_sheets_and_the_cones_of_spots_move_along() {
    let home = small(gallery::teapot(), 160, 160);
    for recipe in ["reeves87", "woo92"] {
        let expected = shot(&home, recipe);
        for by in OFFSETS {
            let found = shot(&home.clone().moved(by).unwrap(), recipe);
            assert_alike(&found.shadow[0], &expected.shadow[0], &format!("teapot, {recipe}, {by}"));
        }
    }
}

/// What is measured of a scene.
type Way<'a> = &'a dyn Fn(&Scene) -> Vec<f32>;

#[test]
fn truth_planar_shadows_and_the_post_process_move_along() {
    let home = small(gallery::sphere_plane(), 200, 256);
    let asked = |scene: &Scene, shadow: &dyn Shadow| picture(scene, &[shadow], &Frame::CENTRES);
    let truth = |scene: &Scene| {
        let geometry = Geometry::new(scene, &scene.camera);
        let seen = asked(scene, &RayCast::new(&geometry, &scene.lights[0].view));
        seen.shadow[0].clone()
    };
    let planar = |scene: &Scene| {
        let ground = Ground { centre: scene.origin, normal: DVec3::Z, half_side: 60.0 };
        let shadow = Planar::new(scene, &scene.lights[0].view, ground, 1, 512).unwrap();
        asked(scene, &shadow).shadow[0].clone()
    };
    let post_process = |scene: &Scene| {
        let view = scene.lights[0].view.with_kind(Kind::Screen);
        let map =
            bake(&view, Soup::casters(scene, &view).triangles(), &umbrage_depth::First, umbrage_raster::Cull::None);
        let light = ShadowMap { filter: presets::williams78().filter, map: map.map };
        let seen = asked(scene, &umbrage_shadow::Unshadowed);
        post::shadow_image(&seen.depth, &scene.camera, None, &light, Key::new(0, 0, 0)).shadow
    };
    let ways: [(&str, Way); 3] = [("truth", &truth), ("planar", &planar), ("post-process", &post_process)];
    for (name, way) in ways {
        let expected = way(&home);
        for by in OFFSETS {
            assert_alike(&way(&home.clone().moved(by).unwrap()), &expected, &format!("{name}, {by}"));
        }
    }
}

#[test]
fn maps_in_all_directions_move_along() {
    let home = small(gallery::sphere_plane(), 160, 256);
    let shadows = |scene: &Scene| -> [Vec<f32>; 2] {
        let eye = scene.lights[0].view.light().truncate();
        let maps = cube_views(eye, 1.0, 400.0, 256).unwrap().map(|view| {
            let soup = Soup::casters(scene, &view);
            bake(&view, soup.triangles(), &umbrage_depth::First, umbrage_raster::Cull::None).map
        });
        let flat = LatLong::from_maps(presets::reeves87().filter, &maps, UVec2::new(1024, 512)).unwrap();
        let cube = Around::new(presets::reeves87().filter, maps.to_vec()).unwrap();
        let all: [&dyn Shadow; 2] = [&cube, &flat];
        all.map(|shadow| picture(scene, &[shadow], &Frame::CENTRES).shadow[0].clone())
    };
    let expected = shadows(&home);
    for by in OFFSETS {
        let found = shadows(&home.clone().moved(by).unwrap());
        for (name, (found, expected)) in ["cube", "lat-long"].into_iter().zip(found.iter().zip(&expected)) {
            assert_alike(found, expected, &format!("{name}, {by}"));
        }
    }
}

#[test]
fn what_asks_a_scene_where_its_things_are_moves_along() {
    let home = gallery::table();
    let framed = |scene: &Scene| scene.framed(&scene.lights[0]).unwrap().view;
    let (view, relevant) = (framed(&home), home.relevant_casters(&home.lights[0].view));
    let outside = home.casters_outside(&home.lights[0].view);
    for by in OFFSETS {
        let far = home.clone().moved(by).unwrap();
        assert_eq!(far.relevant_casters(&far.lights[0].view), relevant, "{by}");
        assert_eq!(far.casters_outside(&far.lights[0].view), outside, "{by}");
        let found = framed(&far);
        let eye = found.light().truncate() - by;
        assert!(eye.distance(view.light().truncate()) < 1e-6 && (found.far() - view.far()).abs() < 1e-6, "{by}");
    }
}

#[test]
fn files_of_maps_far_away_are_the_maps() {
    let home = small(gallery::sphere_plane(), 160, 256);
    let recipe: Recipe = "reeves87".parse().unwrap();
    for by in OFFSETS {
        let far = home.clone().moved(by).unwrap();
        let map = light_map(&recipe, &far, &far.lights[0].view);
        let read = decode_shadow_map(&encode_shadow_map(&map).unwrap(), DEFAULT_BUDGET).unwrap();
        assert_eq!(read.view(), map.view(), "{by}");
        let shadow = recipe.bind(read, Storage::Raw).unwrap();
        let seen = picture(&far, &[&*shadow], &Frame::CENTRES);
        assert_eq!(seen.shadow, shot(&far, "reeves87").shadow, "{by}");
    }
}

/// All that a picture says of light and shadow, as bits.
fn bits(picture: &Picture) -> Vec<u32> {
    let colour = picture.colour.iter().flat_map(Vec3::to_array);
    let shadow = picture.shadow.iter().flatten().copied();
    colour.chain(shadow).map(f32::to_bits).collect()
}

#[test]
fn at_another_power_of_two_every_preset_gives_the_same_bits() {
    for scene in scenes() {
        for exponent in [13, -13] {
            let scale = 2f32.powi(exponent);
            let large = scene.clone().scaled(f64::from(scale)).unwrap();
            for (recipe, scaled) in recipes(&scene, 1.0).into_iter().zip(recipes(&scene, scale)) {
                let (home, large) = (as_meant(scene.clone(), &recipe), as_meant(large.clone(), &recipe));
                let (found, expected) = (shot(&large, &scaled), shot(&home, &recipe));
                assert!(bits(&found) == bits(&expected), "{}, {recipe}, 2^{exponent}", scene.name);
                let lengths = expected.depth.iter().map(|zeta| zeta * scale);
                assert!(found.depth.iter().copied().eq(lengths), "{}, {recipe}, 2^{exponent}", scene.name);
            }
        }
    }
}

#[test]
fn at_another_scale_every_preset_keeps_its_shadows() {
    // Positions and depths are rounded anew at each of these scales: of a few receivers that are as near as that, some fall
    // otherwise. Deep maps, which are no preset's, hold 16 samples per texel and so 16 times as many such places.
    let mut differ = Vec::new();
    for scene in [small(gallery::sphere_plane(), 400, 256), small(gallery::table(), 400, 512)] {
        for scale in [1e4, 1e-4] {
            let large = scene.clone().scaled(scale).unwrap();
            let both = recipes(&scene, 1.0).into_iter().zip(recipes(&scene, scale as f32));
            for (recipe, scaled) in both.filter(|(recipe, _)| !recipe.contains("deep")) {
                let (home, large) = (as_meant(scene.clone(), &recipe), as_meant(large.clone(), &recipe));
                let (found, expected) = (shot(&large, &scaled), shot(&home, &recipe));
                let what = format!("{}, {recipe}, {scale:e}", scene.name);
                differ.extend(unlike(&found.shadow[0], &expected.shadow[0], &what));
            }
        }
    }
    assert!(differ.is_empty(), "{}", differ.join("\n"));
}
