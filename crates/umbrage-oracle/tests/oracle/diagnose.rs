//! Warnings before a map is made (W78-8, W78-9, W92-9, WM94-14, WM94-17).

use glam::{DVec3, Mat3, UVec2, Vec3};
use std::f32::consts::FRAC_PI_4;
use umbrage_depth::{Midpoint, SameSurface, Stored};
use umbrage_oracle::{Diagnostic, Plan, diagnose, diagnose_recipe};
use umbrage_plane::{Kind, View};
use umbrage_scene::{Light, Material, Mesh, Object, Scene, Shape, gallery};

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
    let close = View::perspective(eye, DVec3::new(0.0, 0.0, 25.0), DVec3::Y, 0.5, 0.05, 300.0, light.size());
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

#[test]
fn floats_that_are_too_coarse_are_named_with_the_kind_that_is_not() {
    // A scene of size 10 seen from ten million units away through a range of twenty.
    let mut scene = plate(2.0, true);
    let away = |kind| {
        let view =
            View::perspective(DVec3::Y * 1e7, DVec3::ZERO, DVec3::X, 2e-5, 1e7 - 100.0, 1e7 + 100.0, UVec2::splat(64));
        view.unwrap().with_kind(kind)
    };
    for (kind, better) in [(Kind::Axial, Some(Kind::Screen)), (Kind::Radial, Some(Kind::Screen)), (Kind::Screen, None)]
    {
        scene.lights[0].view = away(kind);
        let found = named(&scene, &Plan { bias_world: 0.3, ..Plan::default() });
        let coarse = found.iter().find_map(|found| match found {
            Diagnostic::CoarseDepth { kind, step, better, .. } => Some((*kind, *step, *better)),
            _ => None,
        });
        match better {
            Some(_) => assert_eq!(coarse, Some((kind, 1.0, better)), "{found:?}"),
            None => assert_eq!(coarse, None, "{found:?}"),
        }
    }
    // A tiny near plane before a far scene: there screen depth is the coarse one.
    let near = View::perspective(DVec3::Y * 80.0, DVec3::ZERO, DVec3::X, 1.2, 1e-4, 1e4, UVec2::splat(64)).unwrap();
    for (kind, coarse) in [(Kind::Screen, true), (Kind::Axial, false), (Kind::Radial, false)] {
        scene.lights[0].view = near.with_kind(kind);
        let found = named(&scene, &Plan::default());
        let any = found
            .iter()
            .any(|found| matches!(found, Diagnostic::CoarseDepth { better: Some(Kind::Axial | Kind::Radial), .. }));
        assert_eq!(any, coarse, "{kind:?}: {found:?}");
    }
    // Every line stands on its own.
    assert!(named(&scene, &Plan::default()).iter().all(|found| !found.to_string().contains('\n')));
}

#[test]
fn casters_below_a_texel_are_named_with_the_map_that_holds_them() {
    let mut scene = excluded_plane();
    // The sphere is 40 across at most; the light is far less than 300 away.
    let of_width = |degrees: f64| {
        let light = gallery::sphere_plane().lights[0].view;
        let eye = light.light().truncate();
        View::perspective(
            eye,
            DVec3::new(0.0, 0.0, 25.0),
            DVec3::Y,
            degrees.to_radians(),
            1.0,
            400.0,
            UVec2::splat(1024),
        )
    };
    scene.lights[0].view = of_width(179.9).unwrap();
    let found = named(&scene, &Plan::default());
    let side = found.iter().find_map(|found| match found {
        Diagnostic::CoarseTexels { casters: 1, of: 1, size, texel, side_needed, .. } => {
            assert!(texel > size && *size > 10.0, "{found:?}");
            Some(*side_needed)
        }
        _ => None,
    });
    scene.lights[0].view = of_width(179.9).unwrap().with_size(UVec2::splat(side.expect("a warning"))).unwrap();
    assert!(!named(&scene, &Plan::default()).iter().any(|found| matches!(found, Diagnostic::CoarseTexels { .. })));
}

#[test]
fn a_bias_as_large_as_the_scene_is_named() {
    let scene = excluded_plane();
    let small = scene.clone().scaled(1e-4).unwrap();
    let large = |scene: &Scene, bias_world: f64| {
        let found = named(scene, &Plan { bias_world, ..Plan::default() });
        found.iter().any(|found| matches!(found, Diagnostic::LargeBias { casters: 1, of: 1, .. }))
    };
    assert_eq!((large(&scene, 0.3), large(&small, 0.3), large(&small, 0.3e-4)), (false, true, false));
}

#[test]
fn rugs_duplicates_and_flush_boxes_are_named_where_something_is_stored_between_them() {
    let sheet = |height: f32, name: &str| {
        let corners = [(-6.0, 6.0), (6.0, 6.0), (6.0, -6.0), (-6.0, -6.0)].map(|(x, z)| Vec3::new(x, height, z));
        let mut object = Object::solid(name, Mesh::sheet(corners, 1), Material::matt(Vec3::ONE));
        object.solid = false;
        object
    };
    let tile = |x: f32, name: &str| {
        Object::solid(
            name,
            Mesh::cuboid(Vec3::new(x, -1.0, -6.0), Vec3::new(x + 6.0, 0.0, 6.0)),
            Material::matt(Vec3::ONE),
        )
    };
    let mut scene = gallery::sphere_plane();
    let size = UVec2::splat(512);
    scene.lights =
        vec![Light::directional("sun", DVec3::new(1.0, 1.0, 0.0), DVec3::ZERO, 6.0, 1.0, 100.0, size).unwrap()];
    let mut stacked = |objects: Vec<Object>, plan: Plan| -> Vec<(String, String)> {
        scene.objects = objects;
        let found = named(&scene, &plan).into_iter();
        found
            .filter_map(|found| match found {
                Diagnostic::Stacked { object, other, .. } => Some((object, other)),
                _ => None,
            })
            .collect()
    };
    let midpoint = Plan { stored: Stored::Midpoint, slope: 2.0, bias_world: 0.0, ..Plan::default() };
    let pair = |a: &str, b: &str| vec![(a.to_string(), b.to_string())];
    let rug = |height| vec![sheet(0.0, "floor"), sheet(height, "rug")];
    assert_eq!(stacked(rug(0.001), midpoint), pair("rug", "floor"));
    assert_eq!(stacked(rug(1.0), midpoint), [], "far enough apart");
    assert_eq!(stacked(rug(0.001), Plan { stored: Stored::First, ..midpoint }), [], "nothing is stored between them");
    // What is drawn twice lies at one depth and is one surface, unless objects keep apart.
    let twice = || vec![sheet(0.0, "floor"), sheet(0.0, "again")];
    assert_eq!(stacked(twice(), midpoint), []);
    let of = |same| Plan { midpoint: Midpoint::default().with_same(same), ..midpoint };
    let both = [pair("floor", "again"), pair("again", "floor")].concat();
    assert_eq!(stacked(twice(), of(SameSurface::Object)), both);
    assert_eq!(stacked(twice(), of(SameSurface::Surface)), both);
    // Along their seam the midpoint lies between the right one's top and the left one's side.
    assert_eq!(stacked(vec![tile(-6.0, "left"), tile(0.0, "right")], midpoint), pair("left", "right"));
    assert_eq!(stacked(vec![tile(-6.0, "left"), tile(4.0, "right")], midpoint), []);
    assert_eq!(
        stacked(rug(0.001), Plan { stored: Stored::Second, ..midpoint }),
        [],
        "a sheet is its own second surface"
    );
    assert_eq!(stacked(vec![tile(-6.0, "box"), tile(-6.0, "again")], midpoint), []);
    assert_eq!(stacked(vec![tile(-6.0, "box"), tile(-6.0, "again")], of(SameSurface::Object)).len(), 2);
}

#[test]
fn w92_3_a_sheet_that_lies_over_itself_loses_its_shadow_on_itself_where_one_surface_has_any_depth() {
    let sheet = |half: f32, height: f32| {
        let corners = [(-half, half), (half, half), (half, -half), (-half, -half)];
        Mesh::sheet(corners.map(|(x, z)| Vec3::new(x, height, z)), 1)
    };
    let mut scene = gallery::sphere_plane();
    let size = UVec2::splat(128);
    scene.lights =
        vec![Light::directional("sun", DVec3::new(1.0, 3.0, 0.0), DVec3::ZERO, 6.0, 1.0, 100.0, size).unwrap()];
    let surface = Plan {
        stored: Stored::Midpoint,
        midpoint: Midpoint::default().with_same(SameSurface::Surface),
        ..Plan::default()
    };
    let lost = |scene: &Scene, plan: &Plan| {
        let found = named(scene, plan).into_iter();
        found.filter(|found| matches!(found, Diagnostic::LostFold { .. })).count()
    };
    let mut both = sheet(5.0, 0.0);
    both.append(&sheet(2.0, 1.5));
    let mut one = Object::solid("paper", both, Material::matt(Vec3::ONE));
    one.solid = false;
    scene.objects = vec![one.clone()];
    assert_eq!(lost(&scene, &surface), 1);
    assert_eq!(lost(&scene, &Plan { midpoint: Midpoint::default(), ..surface }), 0);
    // Two objects, or a solid, keep it.
    scene.objects = vec![
        Object { shape: Shape::Mesh(sheet(5.0, 0.0)), ..one.clone() },
        Object { shape: Shape::Mesh(sheet(2.0, 1.5)), ..one },
    ];
    assert_eq!(lost(&scene, &surface), 0);
    let block = Mesh::cuboid(Vec3::new(-2.0, 1.0, -2.0), Vec3::new(2.0, 2.0, 2.0));
    let mut blocks = Mesh::cuboid(Vec3::new(-5.0, -1.0, -5.0), Vec3::new(5.0, 0.0, 5.0));
    blocks.append(&block);
    scene.objects = vec![Object::solid("blocks", blocks, Material::matt(Vec3::ONE))];
    assert_eq!(lost(&scene, &surface), 0);
}

/// Whatever is said is one line, without holes.
#[test]
fn every_warning_is_one_line_of_text() {
    let (light, object, other) = ("lamp".to_string(), "a".to_string(), "b".to_string());
    let all = [
        Diagnostic::CoarseTexels {
            light: light.clone(),
            casters: 1,
            of: 2,
            object: object.clone(),
            size: 0.1,
            texel: 0.2,
            side_needed: 9,
        },
        Diagnostic::LargeBias { light: light.clone(), bias: 1.0, casters: 1, of: 2, object: object.clone(), size: 0.1 },
        Diagnostic::Stacked { light: light.clone(), object: object.clone(), other, gap: 0.1, step: 0.2 },
        Diagnostic::LostFold { light: light.clone(), object: object.clone(), gap: 0.1 },
        Diagnostic::Enclosed { light: light.clone(), object, nearest: 0.1, cut: true },
        Diagnostic::CoarseDepth { light, kind: Kind::Axial, farthest: 1.0, step: 1.0, allowed: 0.1, better: None },
    ];
    for found in all {
        let line = found.to_string();
        assert!(!line.contains('\n') && !line.contains("  "), "{line}");
    }
}

/// One call, one table: each scene and recipe with the warning it raises, and what changes it so that it does not.
#[test]
fn a_recipe_is_judged_on_a_scene_in_one_call() {
    let raised = |scene: &Scene, recipe: &str| -> Vec<String> {
        let found = diagnose_recipe(scene, &scene.lights[0], &recipe.parse().unwrap());
        // The name of the variant.
        found.iter().map(|found| format!("{found:?}").split(' ').next().unwrap_or_default().to_string()).collect()
    };
    let sound = excluded_plane();
    for recipe in ["reeves87", "williams78", "woo92", "wang-molnar94", "burley", "fernando", "ordinary"] {
        assert_eq!(raised(&sound, recipe), [] as [&str; 0], "{recipe}");
    }
    let tiny = sound.clone().scaled(1e-4).unwrap();
    assert_eq!(raised(&tiny, "reeves87"), ["LargeBias"]);
    assert_eq!(raised(&tiny, "reeves87,bias=3..4t"), [] as [&str; 0], "a bias in texels is the same at any scale");
    assert_eq!(raised(&tiny, "williams78"), [] as [&str; 0]);
    let mut wide = sound.clone();
    let eye = wide.lights[0].view.light().truncate();
    let spot = View::perspective(
        eye,
        DVec3::new(0.0, 0.0, 25.0),
        DVec3::Y,
        179.9f64.to_radians(),
        1.0,
        400.0,
        UVec2::splat(1024),
    );
    wide.lights[0].view = spot.unwrap();
    assert!(raised(&wide, "burley").contains(&"CoarseTexels".to_string()));
    let thin = plate(0.2, true);
    assert_eq!(raised(&thin, "wang-molnar94"), ["TooThin"]);
    assert_eq!(raised(&plate(4.0, true), "wang-molnar94"), [] as [&str; 0]);
    assert_eq!(raised(&thin, "reeves87,bias=0"), [] as [&str; 0], "the nearest surface needs no thickness");
    let mut open = sound;
    open.objects[0].solid = false;
    assert_eq!(raised(&open, "woo92"), ["VanishedShadow"]);
    assert_eq!(raised(&open, "wang-molnar94"), [] as [&str; 0]);
}

#[test]
fn a_light_inside_a_closed_caster_is_named_and_whether_the_near_plane_cuts_it() {
    let mut scene = excluded_plane();
    let eye = scene.lights[0].view.light().truncate();
    let shell = |half: f32| Mesh::cuboid(eye.as_vec3() - half, eye.as_vec3() + half);
    let enclosed = |scene: &Scene| {
        named(scene, &Plan::default()).into_iter().find_map(|found| match found {
            Diagnostic::Enclosed { object, cut, .. } => Some((object, cut)),
            _ => None,
        })
    };
    scene.objects.push(Object::solid("bulb", shell(2.0), Material::matt(Vec3::ONE)));
    assert_eq!(enclosed(&scene), Some(("bulb".into(), false)));
    scene.objects[2].shape = Shape::Mesh(shell(1e-4));
    assert_eq!(enclosed(&scene), Some(("bulb".into(), true)), "nearer than 1/1024 of the near plane");
    scene.objects[2].casts = false;
    assert_eq!(enclosed(&scene), None);
    scene.objects[2] =
        Object::solid("beside", Mesh::cuboid(eye.as_vec3() + 1.0, eye.as_vec3() + 3.0), Material::matt(Vec3::ONE));
    assert_eq!(enclosed(&scene), None);
    for (name, make) in gallery::ALL {
        let scene = make();
        let any = scene.lights.iter().flat_map(|light| diagnose(&scene, light, &Plan::default()));
        assert!(any.into_iter().all(|found| !matches!(found, Diagnostic::Enclosed { .. })), "{name}");
    }
}
