//! A batch whose answers do not fit is refused by every [`Shadow`], not answered in part.

use glam::{DVec3, DVec4, UVec2, Vec3};
use std::panic::{AssertUnwindSafe, catch_unwind};
use umbrage_depth::{DeepMap, Raw, Step, TagMap};
use umbrage_oracle::{AreaLight, AreaRegion, Body, Face, Geometry, RayCast};
use umbrage_plane::{SurfacePoint, View, cube_views};
use umbrage_render::{Ground, Planar};
use umbrage_sample::Key;
use umbrage_scene::gallery;
use umbrage_shadow::{Around, LatLong, Mean, Pcf, Shadow, Tags, Unshadowed, presets};

/// One of every kind, by name.
fn every_shadow(geometry: &Geometry) -> Vec<(&'static str, Box<dyn Shadow + '_>)> {
    let view = View::perspective(DVec3::Y * 9.0, DVec3::ZERO, DVec3::Z, 1.0, 1.0, 99.0, UVec2::splat(8)).unwrap();
    let views = cube_views(DVec3::ZERO, 0.1, 99.0, 8).unwrap();
    let faces = views.map(|face| Raw::new(face, vec![5.0; 64]).unwrap());
    let lat_long = LatLong::from_maps(Pcf::default(), &faces, UVec2::new(16, 8)).unwrap();
    let scene = gallery::sphere_plane();
    let ground = Ground { centre: DVec3::ZERO, normal: DVec3::Z, half_side: 80.0 };
    let planar = Planar::new(&scene, &scene.lights[0].view, ground, 1, 16).unwrap();
    let ray = || RayCast::everywhere(geometry, DVec4::Y);
    // Red glass: what passes it is evaluated once for each colour.
    let red = vec![Step { depth: 5.0, passes: Vec3::new(0.9, 0.1, 0.1) }];
    let glass = |view: &View| DeepMap::new(*view, 0.0, vec![red.clone(); 64]).unwrap();
    vec![
        ("ShadowMap", Box::new(presets::reeves87().over(Raw::new(view, vec![5.0; 64]).unwrap()).unwrap())),
        ("Around", Box::new(Around::new(Pcf::default(), faces.to_vec()).unwrap())),
        ("ShadowMap over glass", Box::new(presets::reeves87().over(glass(&view)).unwrap())),
        ("Around glass", Box::new(Around::new(Pcf::default(), views.iter().map(glass).collect()).unwrap())),
        ("LatLong", Box::new(lat_long)),
        ("Tags", Box::new(Tags(TagMap::new(view, [])))),
        ("Unshadowed", Box::new(Unshadowed)),
        ("RayCast", Box::new(ray())),
        ("AreaRegion", Box::new(AreaRegion::new(ray()))),
        ("AreaLight", Box::new(AreaLight::new(ray(), 0.5))),
        ("Mean", Box::new(Mean(vec![Box::new(ray())]))),
        ("Mean of none", Box::new(Mean(vec![]))),
        ("Planar", Box::new(planar)),
    ]
}

/// What a refusal says; `None` where there is none.
fn refusal(ask: impl FnOnce()) -> Option<String> {
    let payload = catch_unwind(AssertUnwindSafe(ask)).err()?;
    payload.downcast_ref::<String>().cloned()
}

#[test]
fn answers_of_another_number_than_the_points_are_refused_by_every_shadow() {
    let face = Face { corners: [Vec3::new(-1.0, 1.0, -1.0), Vec3::new(0.0, 1.0, 2.0), Vec3::ONE], object: 0 };
    let glass = Body { passes: Vec3::new(0.9, 0.1, 0.1), ..Body::default() };
    let key = Key::new(0, 0, 0);
    let at = [SurfacePoint::at(Vec3::ZERO, Vec3::Y); 3];
    // Opaque things and glass take different ways to the light that passes.
    for body in [Body::default(), glass] {
        let geometry = Geometry::from_faces(vec![face], vec![body]);
        for (name, shadow) in every_shadow(&geometry) {
            for wrong in [0, 2, 4] {
                let wanted = format!("3 surface points need 3 answers, but the slice given holds {wrong}");
                let fractions = refusal(|| shadow.fractions(&at, key, &mut vec![0.0; wrong]));
                assert_eq!(fractions.as_ref(), Some(&wanted), "{name}: fractions");
                let passed = refusal(|| shadow.transmittances(&at, key, &[0.0; 3], &mut vec![Vec3::ZERO; wrong]));
                assert_eq!(passed.as_ref(), Some(&wanted), "{name}: transmittances");
                let known = refusal(|| shadow.transmittances(&at, key, &vec![0.0; wrong], &mut [Vec3::ZERO; 3]));
                assert_eq!(known.as_ref(), Some(&wanted), "{name}: fractions given to transmittances");
            }
            assert_eq!(refusal(|| shadow.fractions(&at, key, &mut [0.0; 3])), None, "{name}");
            assert_eq!(refusal(|| shadow.fractions(&[], key, &mut [])), None, "{name}: no points at all");
        }
    }
}
