//! Lights of a scene bound by their own recipes, and the planar projection that shadow maps are contrasted with.

use glam::{DVec3, UVec2, Vec3};
use umbrage_depth::Storage;
use umbrage_plane::Bias;
use umbrage_recipe::{Recipe, bind};
use umbrage_render::{Frame, Ground, Picture, Planar, bind_lights, light_maps, light_shadows, picture};
use umbrage_scene::tree::Tree;
use umbrage_scene::{Scene, gallery};
use umbrage_shadow::{Shadow, Unshadowed, presets};

fn small(mut scene: Scene, pixels: u32, texels: u32) -> Scene {
    scene.camera = scene.camera.with_size(UVec2::splat(pixels)).unwrap();
    for light in &mut scene.lights {
        light.view = light.view.with_size(UVec2::splat(texels)).unwrap();
    }
    scene
}

fn shot(scene: &Scene, shadows: &[Box<dyn Shadow>]) -> Picture {
    let shadows: Vec<&dyn Shadow> = shadows.iter().map(AsRef::as_ref).collect();
    picture(scene, &shadows, &Frame::CENTRES)
}

#[test]
fn r87_18_every_light_s_tree_chooses_its_own_shadow_or_none() {
    let mut scene = small(gallery::three_lights(), 64, 128);
    let shadow = |recipe: &str| Tree::Product(vec![Tree::colour(Vec3::ONE), Tree::Shadow { recipe: recipe.into() }]);
    scene.lights[0] = scene.lights[0].clone().with_tree(shadow("ordinary,bias=0.4"));
    scene.lights[1] = scene.lights[1].clone().with_tree(Tree::colour(Vec3::ONE));
    let default: Recipe = "reeves87,res-factor=8".parse().unwrap();
    let maps = light_maps(&scene, &default).unwrap();
    assert_eq!(maps.iter().map(Option::is_some).collect::<Vec<_>>(), [true, false, true]);
    let seen = shot(&scene, &bind_lights(&scene, &maps, &default, Storage::Tiled).unwrap());
    let levels = |light: usize| {
        let mut values: Vec<u32> = seen.shadow[light].iter().map(|s| s.to_bits()).collect();
        values.sort_unstable();
        values.dedup();
        values.len()
    };
    assert_eq!((levels(0), levels(1)), (2, 1), "hard, and none");
    assert!(levels(2) > 8, "soft by default");
    scene.lights[2] = scene.lights[2].clone().with_tree(shadow("reeves87,samples=0"));
    let error = bind_lights(&scene, &maps, &default, Storage::Tiled).err().unwrap().to_string();
    assert!(error.contains("light \"blue\", samples = \"0\""), "{error}");
}

#[test]
fn every_light_has_the_maps_that_its_own_recipe_wants() {
    let mut scene = small(gallery::three_lights(), 64, 128);
    let shadow = |recipe: &str| Tree::Product(vec![Tree::colour(Vec3::ONE), Tree::Shadow { recipe: recipe.into() }]);
    scene.lights[0] = scene.lights[0].clone().with_tree(shadow("auto,light=2,maps=5"));
    scene.lights[1] = scene.lights[1].clone().with_tree(Tree::colour(Vec3::ONE));
    let lights = light_shadows(&[&scene], &"woo92,window=fitted".parse().unwrap(), Storage::Tiled).unwrap();
    let maps: Vec<_> = lights.iter().map(|light| light.as_ref().map(|light| light.maps.len())).collect();
    assert_eq!(maps, [Some(5), None, Some(1)]);
    let fitted = lights[2].as_ref().unwrap().maps[0].view;
    assert!(fitted.texel_world(1.0).element_product() < 0.9 * scene.lights[2].view.texel_world(1.0).element_product());
    let shadows: Vec<Box<dyn Shadow>> = lights
        .into_iter()
        .map(|light| light.map_or(Box::new(Unshadowed) as Box<dyn Shadow>, |light| light.shadow))
        .collect();
    let seen = shot(&scene, &shadows);
    let dark = |light: usize| seen.shadow[light].iter().sum::<f32>();
    assert!(dark(0) > 20.0 && dark(1) == 0.0 && dark(2) > 20.0, "{} {} {}", dark(0), dark(1), dark(2));
    scene.lights[2] = scene.lights[2].clone().with_tree(shadow("auto,light=-1"));
    let error = light_shadows(&[&scene], &Recipe::default(), Storage::Tiled).unwrap_err().to_string();
    assert!(error.starts_with("light \"blue\", light = \"-1\""), "{error}");
    assert!(light_shadows(&[], &Recipe::default(), Storage::Tiled).unwrap().is_empty());
}

const PLANE: u32 = 1;

fn ground() -> Ground {
    Ground { centre: DVec3::ZERO, normal: DVec3::Z, half_side: 80.0 }
}

#[test]
fn w78_24_planar_projection_agrees_with_the_map_on_its_plane_and_shadows_nothing_else() {
    let scene = small(gallery::sphere_plane(), 160, 512);
    let light = scene.lights[0].view;
    let planar = Planar::new(&scene, &light, ground(), PLANE, 2048).unwrap();
    let flat = shot(&scene, &[Box::new(planar)]);
    let maps = light_maps(&scene, &"ordinary".parse().unwrap()).unwrap();
    let mapped =
        shot(&scene, &[bind(presets::ordinary(Bias::World(0.6)).filter, maps[0].as_ref().unwrap(), Storage::Raw)]);
    let dark = |picture: &Picture, object: u32| -> Vec<bool> {
        (0..picture.object.len()).map(|i| picture.object[i] == object && picture.shadow[0][i] > 0.5).collect()
    };
    let (ours, theirs) = (dark(&flat, PLANE), dark(&mapped, PLANE));
    let count = |f: &dyn Fn(bool, bool) -> bool| ours.iter().zip(&theirs).filter(|(a, b)| f(**a, **b)).count() as f64;
    assert!(count(&|a, b| a && b) / count(&|a, b| a || b) > 0.97);
    assert!(!dark(&flat, 0).contains(&true), "the sphere has no shadow of its own");
    assert!(dark(&mapped, 0).contains(&true));
}

#[test]
fn w78_24_what_is_below_the_plane_or_above_the_light_throws_nothing_on_it() {
    let scene = small(gallery::sphere_plane(), 96, 64);
    let light = scene.lights[0].view;
    for offset in [-60.0, 120.0] {
        let mut moved = scene.clone();
        if let umbrage_scene::Shape::Mesh(mesh) = &mut moved.objects[0].shape {
            for position in &mut mesh.positions {
                position.z += offset;
            }
        }
        let planar = Planar::new(&moved, &light, ground(), PLANE, 512).unwrap();
        let seen = shot(&moved, &[Box::new(planar)]);
        let dark = (0..seen.object.len()).filter(|&i| seen.object[i] == PLANE && seen.shadow[0][i] > 0.0).count();
        assert_eq!(dark, 0, "moved by {offset}");
    }
    // From below the plane there is no light on its upper side to take away.
    let below = Ground { normal: DVec3::NEG_Z, ..ground() };
    let planar = Planar::new(&scene, &light, below, PLANE, 64).unwrap();
    assert!(shot(&scene, &[Box::new(planar)]).shadow[0].iter().all(|s| *s == 0.0));
}
