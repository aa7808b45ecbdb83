//! Warnings before a map is made (W78-8, W78-9, W92-9, WM94-14).

use umbrage_oracle::{Diagnostic, Plan, diagnose};
use umbrage_scene::{Scene, Shape, gallery};

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
    let close = umbrage_plane::View::perspective(
        eye,
        glam::DVec3::new(0.0, 0.0, 25.0),
        glam::DVec3::Y,
        0.5,
        0.05,
        300.0,
        light.size(),
    );
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
    let plan = Plan { midpoint: true, ..Plan::default() };
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
