//! Lights: their views, what they send where, and how bright they are.

use crate::build::{Build, near, notes};
use glam::{DVec2, DVec3, Vec3};
use serde_json::{Value, json};
use umbrage_gltf::{Import, ReadOptions};
use umbrage_plane::{Projection, Rules, View, cube_views};

const PUNCTUAL: &str = "KHR_lights_punctual";

/// A floor of 4 × 4 at y = 0, with a light in a node.
fn lit(light: Value, node: Value) -> Build {
    let mut build = Build::new();
    let positions = build.floats(&[[-2.0, 0.0, 2.0], [2.0, 0.0, 2.0], [-2.0, 0.0, -2.0], [2.0, 0.0, -2.0]]);
    let mesh = build.mesh(json!({"attributes": {"POSITION": positions}, "mode": 5}));
    build.node(json!({"mesh": mesh}));
    build.document["extensions"][PUNCTUAL]["lights"] = vec![light].into();
    let mut node = node;
    node["extensions"] = json!({PUNCTUAL: {"light": 0}});
    build.node(node);
    build
}

/// Straight down from y = 10.
fn above() -> Value {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    json!({"translation": [0, 10, 0], "rotation": [-half, 0, 0, half]})
}

fn spot(outer_deg: f64) -> Value {
    let outer = outer_deg.to_radians();
    json!({"type": "spot", "name": "lamp", "spot": {"innerConeAngle": outer * 0.5, "outerConeAngle": outer}})
}

fn with_shadow(light: Value, shadow: Value) -> Build {
    let mut node = above();
    node["extras"]["shadow"] = shadow;
    lit(light, node)
}

fn holds_all(import: &Import, view: &View) {
    for at in import.scene.objects.iter().flat_map(|object| import.scene.hull(object)) {
        let eye = view.world_to_eye().transform_point3(at);
        assert!(
            -eye.z >= view.near() && -eye.z <= view.far(),
            "{eye} is not within {} and {}",
            view.near(),
            view.far()
        );
    }
}

#[test]
fn a_spot_is_the_square_of_twice_its_outer_angle() {
    let shadow = json!({"type": "perspective", "near": 2, "far": 30});
    let import = with_shadow(spot(30.0), shadow).read_with(&ReadOptions::default().with_map_size(64)).unwrap();
    let light = &import.scene.lights[0];
    let view = light.view;
    assert_eq!((view.near(), view.far(), view.size().to_array(), *view.rules()), (2.0, 30.0, [64; 2], Rules::SPOT));
    let Projection::Perspective { k, shift } = view.projection() else { panic!("a spot is in perspective") };
    near(&[k.x, k.y, shift.x, shift.y], &[3.0_f64.sqrt(), 3.0_f64.sqrt(), 0.0, 0.0]);
    near(&[view.cone().unwrap()], &[30.0_f64.to_radians().cos()]);
    near(&view.ahead().to_array(), &[0.0, -1.0, 0.0]);
    assert_eq!(import.lamps[0].views, [view]);
    assert_eq!((light.name.as_str(), light.casts, light.tree.as_ref().unwrap().recipe()), ("lamp", true, Some("")));
    // Full light up to 15°, none beyond 30°.
    let arrives = |degrees: f64| light.incident(DVec3::new(10.0 * degrees.to_radians().tan(), 0.0, 0.0)).1.x;
    assert!(arrives(0.0) > arrives(14.0) && arrives(14.0) > 2.0 * arrives(24.0) && arrives(24.0) > 0.0);
    assert_eq!(arrives(31.0), 0.0);
}

#[test]
fn a_spot_without_a_window_holds_every_caster() {
    let import = lit(spot(30.0), above()).read().unwrap();
    let view = import.scene.lights[0].view;
    holds_all(&import, &view);
    assert!(view.near() > 8.0, "{}", view.near());
}

#[test]
fn a_wide_spot_has_five_views() {
    let import = lit(spot(80.0), above()).read().unwrap();
    assert_eq!(import.lamps[0].views, import.scene.lights[0].view.faces_ahead().unwrap());
    near(&[import.scene.lights[0].view.cone().unwrap()], &[80.0_f64.to_radians().cos()]);
    let shadow = json!({"type": "perspective", "near": 2, "far": 30});
    let import = with_shadow(spot(90.0), shadow).read().unwrap();
    assert_eq!(import.lamps[0].views.len(), 5);
    assert!(import.lamps[0].views.iter().all(|view| (view.near(), view.far()) == (2.0, 30.0)));
    assert_eq!(lit(spot(70.0), above()).read().unwrap().lamps[0].views.len(), 1);
}

#[test]
fn a_point_light_has_six_views_and_shines_by_the_inverse_square() {
    let import = lit(json!({"type": "point", "intensity": 40}), above()).read().unwrap();
    let light = &import.scene.lights[0];
    let views = &import.lamps[0].views;
    assert_eq!(*views, cube_views(DVec3::Y * 10.0, views[0].near(), views[0].far(), 512).unwrap());
    assert!(views[0].near() > 5.0 && views[0].near() < 10.0 / 3.0_f64.sqrt());
    assert!(views[0].far() > 108.0_f64.sqrt());
    assert_eq!(light.name, "light0");
    let arrives = |distance: f64| light.incident(DVec3::new(0.0, 10.0 - distance, 0.0)).1.x;
    // Exposed so that the middle gets 1.
    near(&[arrives(10.0).into(), arrives(5.0).into(), arrives(20.0).into()], &[1.0, 4.0, 0.25]);
    near(&[light.incident(DVec3::new(0.0, 15.0, 0.0)).1.x.into()], &[4.0]);
}

#[test]
fn a_range_ends_light_smoothly() {
    let import = lit(json!({"type": "point", "range": 20}), above()).read().unwrap();
    let arrives = |distance: f64| f64::from(import.scene.lights[0].incident(DVec3::new(distance, 10.0, 0.0)).1.x);
    near(&[arrives(10.0), arrives(20.0), arrives(40.0)], &[1.0 - 0.0625, 0.0, 0.0]);
}

#[test]
fn suns_cover_the_scene_or_have_the_window_they_were_given() {
    let sun = json!({"type": "directional", "color": [1, 0.5, 0], "intensity": 7});
    let import = lit(sun.clone(), above()).read().unwrap();
    let view = import.scene.lights[0].view;
    assert!(!view.is_perspective() && import.scene.lights[0].tree.is_none());
    holds_all(&import, &view);
    let Projection::Orthographic { half, .. } = view.projection() else { panic!("a sun is orthographic") };
    assert!(half.cmpgt(DVec2::splat(2.0)).all() && half.cmplt(DVec2::splat(2.1)).all(), "{half}");
    assert!(import.scene.lights[0].colour.abs_diff_eq(Vec3::new(1.0, 0.5, 0.0), 1e-6));
    let shadow = json!({"type": "orthographic", "half": 5, "near": -3, "far": 40});
    let import = with_shadow(sun, shadow).read().unwrap();
    let view = import.scene.lights[0].view;
    assert_eq!((view.near(), view.far(), *view.rules()), (-3.0, 40.0, Rules::OPEN));
    assert_eq!(view.projection(), Projection::orthographic(DVec2::splat(5.0)));
    near(&view.eye_to_world().w_axis.to_array(), &[0.0, 10.0, 0.0, 1.0]);
}

#[test]
fn exposure_is_one_for_all_lights_together() {
    let mut build = lit(json!({"type": "directional", "intensity": 3}), above());
    build.document["extensions"][PUNCTUAL]["lights"]
        .as_array_mut()
        .unwrap()
        .push(json!({"type": "point", "intensity": 100}));
    build.node(json!({"translation": [0, 10, 0], "extensions": {PUNCTUAL: {"light": 1}}}));
    let import = build.read().unwrap();
    let arrives = |light: usize| f64::from(import.scene.lights[light].incident(DVec3::ZERO).1.x);
    near(&[arrives(0), arrives(1)], &[0.75, 0.25]);
}

#[test]
fn a_type_of_window_that_does_not_fit_is_refused_by_name() {
    let perspective = json!({"type": "perspective", "near": 1, "far": 2});
    let orthographic = json!({"type": "orthographic", "half": 1, "near": 1, "far": 2});
    assert_eq!(
        with_shadow(spot(30.0), orthographic.clone()).refused(),
        r#"nodes[1].extras.shadow.type: "orthographic", expected "perspective", since the light is a spot"#
    );
    assert_eq!(
        with_shadow(json!({"type": "directional"}), perspective).refused(),
        r#"nodes[1].extras.shadow.type: "perspective", expected "orthographic", since the light is a sun"#
    );
    let faults = [
        (json!({"type": "perspective", "near": 0, "far": 2}), "near: 0, expected world units above 0"),
        (json!({"type": "perspective", "near": 3, "far": 2}), "far: 2, expected world units above near"),
        (json!({"type": "perspective", "near": 3}), "far: nothing, expected world units above near"),
    ];
    for (shadow, line) in faults {
        assert_eq!(with_shadow(spot(30.0), shadow).refused(), format!("nodes[1].extras.shadow.{line}"));
    }
}

#[test]
fn a_nodes_extras_come_before_the_lights() {
    let mut light = spot(30.0);
    light["extras"] = json!({"shadow": {"type": "perspective", "near": 1, "far": 50}, "radius": 0.5});
    let import = lit(light.clone(), above()).read().unwrap();
    assert_eq!((import.scene.lights[0].view.near(), import.lamps[0].radius), (1.0, 0.5));
    let mut build = with_shadow(light, json!({"type": "perspective", "near": 2, "far": 50}));
    build.document["nodes"][1]["name"] = "bulb".into();
    let import = build.read().unwrap();
    assert_eq!((import.scene.lights[0].view.near(), import.lamps[0].radius), (2.0, 0.5));
    assert_eq!(import.scene.lights[0].name, "bulb");
}

#[test]
fn suns_have_an_angle_and_lamps_a_radius() {
    let mut sun = json!({"type": "directional", "extras": {"angle": 0.01}});
    assert_eq!(lit(sun.clone(), above()).read().unwrap().lamps[0].radius, 0.01);
    sun["extras"] = json!({"radius": 2});
    assert_eq!(
        lit(sun, above()).refused(),
        "extensions.KHR_lights_punctual.lights[0].extras.radius: 2, \
         expected no radius: a sun has extras.angle, in radians"
    );
    let mut lamp = spot(30.0);
    lamp["extras"] = json!({"radius": -1});
    assert!(lit(lamp, above()).refused().ends_with("extras.radius: -1, expected world units from 0"));
}

#[test]
fn a_scene_without_a_light_has_a_sun() {
    let mut build = lit(spot(30.0), above());
    build.document["nodes"].as_array_mut().unwrap().pop();
    let import = build.read().unwrap();
    let light = &import.scene.lights[0];
    assert!(light.view.ahead().y < -0.5 && light.colour == Vec3::ONE && light.casts);
    holds_all(&import, &light.view);
    assert!(notes(&import).iter().any(|note| note.starts_with("the scene has no light")));
    assert_eq!(import.lamps.len(), 1);
}

#[test]
fn lights_do_not_care_for_mirrors_and_scale() {
    let mut node = above();
    node["scale"] = json!([-3, 2, 5]);
    node["extras"] = json!({"shadow": {"type": "perspective", "near": 2, "far": 30}});
    let view = lit(spot(30.0), node).read().unwrap().scene.lights[0].view;
    near(&view.ahead().to_array(), &[0.0, -1.0, 0.0]);
    assert_eq!(view.near(), 2.0);
}

#[test]
fn faults_of_lights_are_named() {
    let list = "extensions.KHR_lights_punctual.lights[0]";
    let faults = [
        (json!({"type": "area"}), "type: \"area\", expected spot, point or directional"),
        (json!({"type": "point", "intensity": -1}), "intensity: -1, expected a number from 0 to 1e30"),
        (json!({"type": "point", "color": [1, 1]}), "color: an array of 2, expected 3 numbers"),
        (json!({"type": "point", "range": 0}), "range: 0, expected world units above 0"),
        (
            json!({"type": "spot", "spot": {"outerConeAngle": 2}}),
            "spot.outerConeAngle: 2, expected radians above 0, up to pi/2",
        ),
        (
            json!({"type": "spot", "spot": {"innerConeAngle": 1}}),
            "spot.innerConeAngle: 1, expected radians from 0, up to outerConeAngle",
        ),
    ];
    for (light, line) in faults {
        assert_eq!(lit(light, above()).refused(), format!("{list}.{line}"));
    }
    let mut build = lit(spot(30.0), above());
    build.document["nodes"][1]["extensions"][PUNCTUAL]["light"] = 1.into();
    assert_eq!(
        build.refused(),
        "nodes[1].extensions.KHR_lights_punctual.light: 1, expected the number of one of 1 lights"
    );
}
