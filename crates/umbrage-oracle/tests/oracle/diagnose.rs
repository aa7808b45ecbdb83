//! Warnings before a map is made (W78-8, W78-9, W92-9, WM94-14, WM94-17).

use glam::{DVec3, Mat3, UVec2, Vec3};
use std::f32::consts::FRAC_PI_4;
use umbrage_depth::Stored;
use umbrage_oracle::{Diagnostic, Plan, diagnose};
use umbrage_scene::{Light, Mesh, Scene, Shape, gallery};

fn named(scene: &Scene, plan: &Plan) -> Vec<Diagnostic> {
    diagnose(scene, &scene.lights[0], plan)
}

fn excluded_plane() -> Scene {
    let mut scene = gallery::sphere_plane();
    scene.objects[1].casts = false;
    scene
}

#[test]
fn a_sound_scene_has_nothing_wrong() {
    assert_eq!(named(&excluded_plane(), &Plan::default()), []);
}

#[test]
fn w78_8_casters_outside_the_light_s_view_are_named() {
    let scene = gallery::sphere_plane();
    let found = named(&scene, &Plan::default());
    assert_eq!(found, [Diagnostic::CasterOutside { light: "lamp".into(), object: "slab".into() }]);
    assert!(found[0].to_string().starts_with("light \"lamp\": object \"slab\" casts"));
    let mut dark = scene;
    dark.lights[0].casts = false;
    assert_eq!(named(&dark, &Plan::default()), []);
}

#[test]
fn w78_9_severe_perspective_is_told_with_its_step() {
    let mut scene = excluded_plane();
    let plan = Plan { depth_bits: Some(16), ..Plan::default() };
    assert_eq!(named(&scene, &plan), []);
    let light = scene.lights[0].view;
    let eye = light.light().truncate();
    let close =
        umbrage_plane::View::perspective(eye, DVec3::new(0.0, 0.0, 25.0), DVec3::Y, 0.5, 0.05, 300.0, light.size());
    scene.lights[0].view = close.unwrap();
    let found = named(&scene, &plan);
    assert!(matches!(found[..], [Diagnostic::SeverePerspective { step, .. }] if step > 0.15), "{found:?}");
    assert!(!found[0].to_string().contains('\n'));
    assert_eq!(named(&scene, &Plan { depth_bits: Some(24), ..plan }), []);
    assert_eq!(named(&scene, &Plan::default()), []);
}

#[test]
fn w92_9_t_1_sheets_over_excluded_receivers_vanish_under_the_midpoint_rule() {
    let mut scene = excluded_plane();
    let plan = Plan { stored: Stored::Midpoint, ..Plan::default() };
    assert_eq!(named(&scene, &plan), [], "solids are fine");
    scene.objects[0].solid = false;
    let lost = Diagnostic::VanishedShadow { light: "lamp".into(), object: "sphere".into(), receiver: "slab".into() };
    assert_eq!(named(&scene, &plan), [lost]);
    assert_eq!(named(&scene, &Plan::default()), []);
}

#[test]
fn wm94_14_open_meshes_flagged_solid_are_told() {
    let mut scene = excluded_plane();
    if let Shape::Mesh(mesh) = &mut scene.objects[0].shape {
        mesh.triangles.pop();
        mesh.surfaces.pop();
    }
    assert_eq!(named(&scene, &Plan::default()), [Diagnostic::OpenSolid { object: "sphere".into() }]);
}

/// A plate 100 texels wide and `thickness` thick, tilted 45° to the light above it; texels of 1 world unit.
fn plate(thickness: f32, solid: bool) -> Scene {
    let mut scene = gallery::sphere_plane();
    let mut mesh = Mesh::cuboid(Vec3::new(-50.0, -0.5 * thickness, -50.0), Vec3::new(50.0, 0.5 * thickness, 50.0));
    let turn = Mat3::from_rotation_z(FRAC_PI_4);
    for vector in mesh.positions.iter_mut().chain(&mut mesh.normals) {
        *vector = turn * *vector;
    }
    scene.objects.truncate(1);
    scene.objects[0].shape = Shape::Mesh(mesh);
    scene.objects[0].solid = solid;
    let size = UVec2::splat(200);
    scene.lights = vec![Light::directional("sun", DVec3::Y, DVec3::ZERO, 100.0, 1.0, 300.0, size).unwrap()];
    scene
}

#[test]
fn wm94_17_d_10_casters_thinner_than_the_depth_step_are_named_with_the_map_that_does() {
    // Slope 1: point look-ups may be off by half a texel, .5; the thickness along the light is √2 · .2.
    let plan = Plan { stored: Stored::Second, slope: 2.0, ..Plan::default() };
    let thin = plate(0.2, true);
    let found = named(&thin, &plan);
    let [Diagnostic::TooThin { object, thickness, step, side_needed, .. }] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(object, "sphere");
    assert!((thickness - 0.282_842_7).abs() < 1e-4 && (step - 0.5).abs() < 1e-4, "{found:?}");
    // 200 · .5 / .2828 = 353.55.
    assert_eq!(*side_needed, 354);
    assert!(!found[0].to_string().contains('\n'));
    let mut larger = thin.clone();
    larger.lights[0].view = thin.lights[0].view.with_size(UVec2::splat(*side_needed)).unwrap();
    assert_eq!(named(&larger, &plan), []);
    // The midpoint guards half as much; a filter sees more of the slope.
    let middle = plate(0.5, true);
    assert_eq!(named(&middle, &plan), []);
    assert_eq!(named(&middle, &Plan { stored: Stored::Midpoint, ..plan }).len(), 1);
    assert_eq!(named(&middle, &Plan { filter_half: 1.0, ..plan }).len(), 1);
    // Not asked: steeper than the plan cares for, sheets, the first surface.
    assert_eq!(named(&thin, &Plan { slope: 0.5, ..plan }), []);
    assert_eq!(named(&plate(0.2, false), &plan), []);
    assert_eq!(named(&thin, &Plan { stored: Stored::First, ..plan }), []);
}

#[test]
fn wm94_17_thickness_is_measured_in_the_object_itself() {
    // Another body inside the plate, or below it, does not end it.
    let plan = Plan { stored: Stored::Second, slope: 2.0, ..Plan::default() };
    let mut scene = plate(2.0, true);
    scene.objects.push(plate(1.9, true).objects.remove(0));
    assert_eq!(named(&scene, &plan), []);
}

#[test]
fn t_9_v53_an_open_sheet_that_claims_to_be_solid_is_told() {
    let mut scene = excluded_plane();
    let corners = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)].map(|(x, z)| Vec3::new(x, 30.0, z));
    scene.objects[0].shape = Shape::Mesh(Mesh::sheet(corners, 1));
    assert_eq!(named(&scene, &Plan::default()), [Diagnostic::OpenSolid { object: "sphere".into() }]);
    scene.objects[0].solid = false;
    assert_eq!(named(&scene, &Plan::default()), []);
}
