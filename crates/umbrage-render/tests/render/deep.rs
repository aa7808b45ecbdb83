//! Deep maps and exposures: what light is left behind leaves and glass and behind what moves.

use glam::{DVec3, IVec2, UVec2, Vec3};
use umbrage_bake::{Deep, bake};
use umbrage_depth::{DepthMap, First, Map, Raw, Storage};
use umbrage_plane::{SurfacePoint, TexelRect, View};
use umbrage_raster::Cull;
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, Soup, expose, expose_deep, exposed_map, light_map, picture};
use umbrage_sample::Key;
use umbrage_scene::{Light, Material, Mesh, Object, Scene, Shape, gallery};
use umbrage_shadow::Shadow;

/// A light at (0, 0, 100) looking down −z at 32 × 32 world units, half a unit per texel.
fn light() -> Light {
    Light::directional("sun", DVec3::Z, DVec3::ZERO, 16.0, 1.0, 200.0, UVec2::splat(64)).unwrap()
}

/// A square sheet at a height that lets `passes` through, from x = `left` to 16.
fn sheet(height: f32, left: f32, passes: Vec3) -> Object {
    let corners = [(left, -16.0), (16.0, -16.0), (16.0, 16.0), (left, 16.0)].map(|(x, y)| Vec3::new(x, y, height));
    let mesh = Shape::Mesh(Mesh::sheet(corners, 1));
    Object { passes, ..Object::two_sided("sheet", mesh, Material::matt(Vec3::ONE)) }
}

fn scene(objects: Vec<Object>) -> Scene {
    Scene { objects, lights: vec![light()], ..gallery::sphere_plane() }
}

fn lossless(axis: u32) -> Deep {
    Deep::new(0.0, axis).unwrap()
}

#[test]
fn a_deep_map_of_opaque_things_is_the_first_depth() {
    let scene = gallery::sphere_plane();
    let view = scene.lights[0].view.with_size(UVec2::new(96, 96)).unwrap();
    let first = bake(&view, Soup::casters(&scene, &view).triangles(), &First, Cull::None).map;
    let deep = expose_deep(&view, &[&scene], &lossless(1));
    for texel in TexelRect::of_size(view.size()).texels() {
        assert_eq!(deep.depth(texel), first.depth(texel), "{texel}");
        assert!(deep.steps(texel).iter().all(|step| step.passes == Vec3::ZERO), "{texel}");
    }
    // So every filter answers the same over both.
    let recipes = ["reeves87", "woo92,stored=first", "burley", "wang-molnar94,stored=first", "ordinary"];
    for text in recipes {
        let recipe: Recipe = text.parse().unwrap();
        let (flat, several) =
            (recipe.bind(&first, Storage::Tiled).unwrap(), recipe.bind(deep.clone(), Storage::Tiled).unwrap());
        let shot = |shadow: &dyn Shadow| {
            let small = Scene { camera: scene.camera.with_size(UVec2::splat(48)).unwrap(), ..scene.clone() };
            picture(&small, &[shadow], &Frame::CENTRES).shadow
        };
        let (a, b) = (shot(&*flat), shot(&*several));
        let most = a[0].iter().zip(&b[0]).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(most < 1e-6, "{text}: {most}");
    }
}

#[test]
fn ext_2_moments_share_the_light_between_them() {
    let moments: Vec<Scene> = (0..4).map(|i| scene(vec![sheet(10.0, f32::from(i as u8) * 4.0, Vec3::ZERO)])).collect();
    let moments: Vec<&Scene> = moments.iter().collect();
    let map = expose_deep(&light().view, &moments, &lossless(1));
    let light_behind = |world: f32| map.transmittance(IVec2::new(((world + 16.0) * 2.0) as i32, 9), 1e9).x;
    assert_eq!([-1.0, 1.0, 5.0, 9.0, 13.0].map(light_behind), [1.0, 0.75, 0.5, 0.25, 0.0]);
    // With a single depth per texel, each moment is seen in its own fraction of the texels.
    let view = light().view;
    let first = |scene: &Scene| bake(&view, Soup::casters(scene, &view).triangles(), &First, Cull::None).map;
    let drawn = expose(&view, &moments, 3, first);
    let dark = |from: i32, to: i32| {
        let all: Vec<IVec2> = TexelRect::new(IVec2::new(from, 0), IVec2::new(to, 64)).texels().collect();
        all.iter().filter(|texel| drawn.depth(**texel).is_finite()).count() as f64 / all.len() as f64
    };
    for (from, to, share) in [(0, 32, 0.0), (32, 40, 0.25), (40, 48, 0.5), (48, 56, 0.75), (56, 64, 1.0)] {
        assert!((dark(from, to) - share).abs() < 0.08, "columns {from} to {to}: {}", dark(from, to));
    }
    assert_eq!(Raw::from(&drawn), Raw::from(&expose(&view, &moments, 3, first)), "the same again");
    assert_eq!(expose(&view, &[], 3, first).tile_count(), 0);
    // A recipe of one surface does the same, whatever its rule.
    let normals: Recipe = "wang-molnar94,stored=normals".parse().unwrap();
    let Map::Tiled(tiles) = exposed_map(&normals, &moments, &view).0 else { panic!("one surface") };
    let alone = |scene: &Scene| match light_map(&normals, scene, &view) {
        Map::Tiled(tiles) => tiles,
        _ => panic!("one surface"),
    };
    assert_eq!(*tiles, expose(&view, &moments, 0, alone));
}

#[test]
fn ext_3_epsilon_is_honoured_by_a_whole_map() {
    let plant = gallery::plant();
    let view = plant.lights[0].view.with_size(UVec2::splat(96)).unwrap();
    let full = expose_deep(&view, &[&plant], &lossless(4));
    let kept = expose_deep(&view, &[&plant], &Deep::new(0.02, 4).unwrap());
    assert_eq!(kept.epsilon(), 0.02);
    let mut seen = 0;
    for texel in TexelRect::of_size(view.size()).texels() {
        assert_eq!(kept.depth(texel), full.depth(texel), "{texel}");
        for step in full.steps(texel).iter().chain(kept.steps(texel)) {
            for depth in [step.depth, step.depth.next_up()] {
                let apart = (kept.transmittance(texel, depth) - full.transmittance(texel, depth)).abs().max_element();
                assert!(f64::from(apart) <= f64::from(0.02f32) + 1e-9, "{texel} at {depth}: {apart}");
                seen += 1;
            }
        }
    }
    assert!(seen > 10_000, "{seen} places");
    assert!(kept.bytes() * 4 < full.bytes() * 3, "{} of {}", kept.bytes(), full.bytes());
}

#[test]
fn coloured_light_reaches_the_shading_through_the_one_seam() {
    let red = Vec3::new(0.9, 0.1, 0.1);
    let mut objects = vec![sheet(10.0, 0.0, red)];
    let floor = Mesh::cuboid(Vec3::new(-15.0, -15.0, -4.0), Vec3::new(15.0, 15.0, 0.0));
    objects.push(Object::solid("floor", floor, Material::matt(Vec3::ONE)));
    let scene = scene(objects);
    let recipe: Recipe = "reeves87,stored=deep,epsilon=0,bias=0.1".parse().unwrap();
    let map = light_map(&recipe, &scene, &scene.lights[0].view);
    assert!(matches!(map, Map::Deep(_)));
    let shadow = recipe.bind(map, Storage::Tiled).unwrap();
    let at = [-8.0, 8.0].map(|x| SurfacePoint::at(Vec3::new(x, 0.0, 0.0), Vec3::Z));
    let (mut dark, mut light) = ([0.0; 2], [Vec3::ZERO; 2]);
    let key = Key::new(0, 0, 0);
    shadow.fractions(&at, key, &mut dark);
    shadow.transmittances(&at, key, &dark, &mut light);
    assert_eq!((dark[0], light[0]), (0.0, Vec3::ONE));
    assert!((light[1] - red).abs().max_element() < 1e-6, "{}", light[1]);
    assert!((1.0 - dark[1] - red.element_sum() / 3.0).abs() < 1e-6);
    let view = View::orthographic(DVec3::Z * 5.0, DVec3::ZERO, DVec3::Y, 12.0, 1.0, 20.0, UVec2::splat(24)).unwrap();
    let seen = picture(&Scene { camera: view, ambient: Vec3::ZERO, ..scene }, &[&*shadow], &Frame::CENTRES);
    let (left, right) = (seen.colour[12 * 24 + 4], seen.colour[12 * 24 + 20]);
    assert_eq!(left, Vec3::ONE);
    assert!((right - red).abs().max_element() < 1e-5, "{right}");
}
