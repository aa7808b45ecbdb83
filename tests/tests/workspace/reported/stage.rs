//! Scenes, points and verdicts of which the situations are made.

use glam::{DVec3, UVec2, Vec3};
use umbrage_depth::Storage;
use umbrage_oracle::{Geometry, RayCast, diagnose_recipe};
use umbrage_plane::{SurfacePoint, View};
use umbrage_recipe::Recipe;
use umbrage_render::light_map;
use umbrage_sample::Key;
use umbrage_scene::{Light, Material, Mesh, Object, Scene, gallery};
use umbrage_shadow::Shadow;

pub(super) fn recipe(text: &str) -> Recipe {
    text.parse().unwrap_or_else(|error| panic!("{text}: {error}"))
}

pub(super) fn matt(name: &str, mesh: Mesh, solid: bool) -> Object {
    let object = Object::solid(name, mesh, Material::matt(Vec3::ONE));
    if solid { object } else { Object::two_sided(name, object.shape, object.material) }
}

/// A sheet y = `height`, `half` to each side of the axis.
pub(super) fn sheet(name: &str, half: f32, height: f32) -> Object {
    let corners = [(-half, half), (half, half), (half, -half), (-half, -half)];
    matt(name, Mesh::sheet(corners.map(|(x, z)| Vec3::new(x, height, z)), 1), false)
}

pub(super) fn cuboid(name: &str, low: [f32; 3], high: [f32; 3]) -> Object {
    matt(name, Mesh::cuboid(Vec3::from(low), Vec3::from(high)), true)
}

pub(super) fn scene(objects: Vec<Object>, view: &View) -> Scene {
    let mut scene = gallery::sphere_plane();
    (scene.objects, scene.origin) = (objects, DVec3::ZERO);
    scene.lights.truncate(1);
    scene.lights[0] = Light { view: *view, tree: None, ..scene.lights[0].clone() };
    scene
}

pub(super) fn sun(toward: DVec3, half: f64, side: u32) -> View {
    let eye = toward.normalize() * 40.0;
    let up = if toward.x == 0.0 && toward.z == 0.0 { DVec3::X } else { DVec3::Y };
    View::orthographic(eye, DVec3::ZERO, up, half, 1.0, 100.0, UVec2::splat(side)).expect("a sun")
}

/// Points of the plane y = `height`, off every seam and texel border.
pub(super) fn ground(half: f64, height: f64) -> Vec<SurfacePoint> {
    let at = |index: u32, axis: u32| f64::from(Key::new(7, 0, 0).signed(index, axis)) * half;
    let point = |index: u32| SurfacePoint {
        region: index,
        ..SurfacePoint::at(DVec3::new(at(index, 0), height, at(index, 1)), Vec3::Y)
    };
    (0..6400).map(point).collect()
}

pub(super) fn asked(shadow: &dyn Shadow, points: &[SurfacePoint]) -> Vec<f32> {
    let mut fractions = vec![0.0; points.len()];
    shadow.fractions(points, Key::new(3, 0, 0), &mut fractions);
    fractions
}

pub(super) fn mapped(scene: &Scene, text: &str) -> Box<dyn Shadow> {
    let recipe = recipe(text);
    recipe.bind(light_map(&recipe, scene, &scene.lights[0].view), Storage::Tiled).expect("its own map")
}

/// False shadow and false light of a recipe, in % of the points whose surroundings, `margin` to each side, truth finds all lit or all dark.
pub(super) fn faults(scene: &Scene, text: &str, points: &[SurfacePoint], margin: f64) -> (f64, f64) {
    let light = &scene.lights[0].view;
    let geometry = Geometry::new(scene, light);
    let truth = RayCast::new(&geometry, light);
    let found = asked(&*mapped(scene, text), points);
    let (mut judged, mut shadow, mut lit) = (0, 0, 0);
    for (point, found) in points.iter().zip(found) {
        let right = truth.at(point);
        let around = [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z].map(|way| {
            truth.at(&SurfacePoint {
                region: point.region,
                ..SurfacePoint::at(point.position + way * margin, point.normal)
            })
        });
        if around.iter().any(|other| *other != right) {
            continue;
        }
        judged += 1;
        shadow += usize::from(right < 0.05 && found > 0.5);
        lit += usize::from(right > 0.95 && found < 0.5);
    }
    let percent = |count: usize| (1000.0 * count as f64 / f64::from(judged.max(1))).round() / 10.0;
    (percent(shadow), percent(lit))
}

pub(super) fn warnings(scene: &Scene, text: &str) -> Vec<String> {
    let found = diagnose_recipe(scene, &scene.lights[0], &recipe(text));
    let mut names: Vec<_> =
        found.iter().map(|found| format!("{found:?}").split(' ').next().unwrap_or_default().to_string()).collect();
    names.dedup();
    names
}

pub(super) fn warned(scene: &Scene, text: &str, name: &str) -> String {
    let all = warnings(scene, text);
    if all.iter().any(|found| found == name) { name.into() } else { format!("{all:?}") }
}

pub(super) const NONE: &str = "0 and 0 % false";

pub(super) fn percent((shadow, lit): (f64, f64)) -> String {
    format!("{shadow} and {lit} % false")
}
