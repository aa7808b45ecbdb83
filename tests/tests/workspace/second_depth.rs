//! Wang & Molnar's promise: scenes of closed solids need no bias.

use glam::{DVec3, UVec2};
use std::fmt::Write;
use umbrage_depth::Storage;
use umbrage_oracle::{Geometry, RayCast, metrics};
use umbrage_plane::View;
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, NOTHING, Picture, light_map, picture};
use umbrage_scene::{Scene, gallery};

/// Pixels nearer than this to a silhouette that the light sees are not judged, texels.
const APART: f32 = 2.0;

fn sized(mut scene: Scene, texels: u32) -> Scene {
    scene.camera = scene.camera.with_size(UVec2::splat(384)).unwrap();
    scene.lights[0].view = scene.lights[0].view.with_size(UVec2::splat(texels)).unwrap();
    scene
}

/// How far a position lies within the light's cone, texels; +∞ without a cone. Beyond it all is dark: its rim is an edge of true shadow that
/// no silhouette throws.
fn within_cone(light: &View, at: DVec3) -> f64 {
    let eye = light.world_to_eye().transform_point3(at);
    let reach = light.cone().map_or(f64::INFINITY, |cos| -eye.z * cos.acos().tan());
    (reach - eye.truncate().length()) / light.texel_world(-eye.z).max_element()
}

/// Lit pixels away from edges of true shadow and silhouettes, by the index of the pixel.
fn judged(scene: &Scene, truth: &Picture) -> Vec<usize> {
    let light = &scene.lights[0].view;
    let distance = metrics::silhouette_distance(light, scene, &truth.position, APART + 1.0);
    (0..truth.object.len())
        .filter(|&i| truth.object[i] != NOTHING && truth.share[i] == 1.0)
        .filter(|&i| truth.shadow[0][i] == 0.0 && truth.facing[0][i] > 0.05 && distance[i] > APART)
        .filter(|&i| within_cone(light, truth.position[i]) > f64::from(APART))
        .collect()
}

#[test]
fn wm94_1_wm94_13_closed_solids_never_shadow_themselves_without_a_bias() {
    let recipe: Recipe = "wang-molnar94".parse().unwrap();
    let mut faults = String::new();
    for (name, scene) in [
        ("sphere-plane", gallery::sphere_plane()),
        ("box-plane", gallery::box_plane()),
        ("spot-room", gallery::spot_room()),
        ("table", gallery::table()),
        ("table-close-up", gallery::table_close_up()),
        ("pipes", gallery::pipes()),
        ("contact-box", gallery::contact_box()),
        ("overlapping-boxes", gallery::overlapping_boxes()),
    ] {
        let mut truth = None;
        for texels in [128, 256, 512] {
            let scene = sized(scene.clone(), texels);
            let light = scene.lights[0].view;
            // Where the light stands does not depend on how finely its map is cut.
            let truth = truth.get_or_insert_with(|| {
                let geometry = Geometry::new(&scene, &scene.camera);
                picture(&scene, &[&RayCast::new(&geometry, &light)], &Frame::CENTRES)
            });
            let found = picture(
                &scene,
                &[&*recipe.bind(light_map(&recipe, &scene, &light), Storage::Tiled).unwrap()],
                &Frame::CENTRES,
            );
            let judged = judged(&scene, truth);
            assert!(judged.len() > 1000, "{name}, {texels}²: only {} pixels to judge", judged.len());
            let dark: Vec<usize> = judged.iter().copied().filter(|&i| found.shadow[0][i] > 0.0).collect();
            if let Some(&first) = dark.first() {
                let (at, object) = (found.position[first], &scene.objects[found.object[first] as usize].name);
                let (count, all) = (dark.len(), judged.len());
                let _ = writeln!(faults, "{name}, {texels}²: {count} of {all}, the first on {object} at {at}");
            }
        }
    }
    assert!(faults.is_empty(), "pixels in false shadow:\n{faults}");
}
