//! Geometry that reaches the eye and beyond (C-10).

use crate::oracle::{Camera, bins, fragments, meet, solid};
use crate::scenes::{cuboid, places, samplings, turns};
use glam::{DVec2, DVec3, Quat, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_plane::{Facing, TexelRect};

const NEAR: f64 = 0.5;
const SIZE: UVec2 = UVec2::new(43, 29);

/// What the beam of light between four rays around a texel position says: all four meet one of the triangles in front of
/// the limit, the whole beam meets none, or neither is sure.
fn surely(camera: &Camera, texel: DVec2, triangles: &[[Vec3; 3]]) -> Option<bool> {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let rays = corners.map(|(x, y)| camera.ray(texel + DVec2::new(x, y) / 128.0));
    let hit = rays.iter().all(|ray| {
        triangles.iter().any(|corners| {
            let (zeta, parts) = meet(*ray, *corners);
            zeta > NEAR / 1000.0 && parts.iter().all(|part| *part >= -1e-12)
        })
    });
    // A sliver may pass between the rays: only a beam without any of it is empty.
    let empty = || triangles.iter().all(|corners| within(camera, &rays, *corners).is_empty());
    if hit { Some(true) } else { empty().then_some(false) }
}

/// The part of a triangle between four rays from the camera's eye and beyond the limit, as a polygon.
fn within(camera: &Camera, rays: &[(DVec3, DVec3); 4], corners: [Vec3; 3]) -> Vec<DVec3> {
    let middle: DVec3 = rays.iter().map(|ray| ray.1).sum();
    let sides = [0, 1, 2, 3].map(|index| {
        let normal = rays[index].1.cross(rays[(index + 1) % 4].1);
        (normal * normal.dot(middle).signum(), 0.0)
    });
    let mut polygon: Vec<DVec3> = corners.iter().map(|corner| corner.as_dvec3() - camera.eye).collect();
    for (normal, least) in sides.into_iter().chain([(camera.forward, NEAR / 1000.0)]) {
        let height = |at: DVec3| normal.dot(at) - least;
        let mut kept = Vec::new();
        for (index, &to) in polygon.iter().enumerate() {
            let from = polygon[(index + polygon.len() - 1) % polygon.len()];
            if (height(from) >= 0.0) != (height(to) >= 0.0) {
                kept.push(from.lerp(to, height(from) / (height(from) - height(to))));
            }
            if height(to) >= 0.0 {
                kept.push(to);
            }
        }
        polygon = kept;
    }
    polygon
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_500))]

    #[test]
    fn c_10_quads_through_the_near_plane_are_cut_and_not_lost(
        centre in places(4.0),
        turn in turns(),
        half in (0.1_f32..50.0, 0.1_f32..50.0),
        target in places(1.0),
        sampling in samplings(),
    ) {
        prop_assume!(target.cross(DVec3::Y).length() > 0.1);
        let camera = Camera::new(DVec3::ZERO, target, 0.8, true, SIZE);
        let view = camera.view(NEAR, 100.0).with_sampling(sampling);
        let corner = |x: f32, y: f32| centre.as_vec3() + turn * Vec3::new(x * half.0, y * half.1, 0.0);
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        let triangles = [[a, b, c], [a, c, d]];
        // A plane that all but contains the eye has nothing but edges.
        let normal = (b - a).cross(d - a).as_dvec3().normalize();
        prop_assume!(normal.dot(a.as_dvec3()).abs() > 0.02);
        let found = fragments(&bins(&view, triangles.map(solid)));
        let mut side = None;
        for texel in TexelRect::of_size(SIZE).texels() {
            let facets = found.get(&(texel.y, texel.x)).map_or(&[][..], Vec::as_slice);
            prop_assert!(facets.len() <= 1, "texel {}", texel);
            if let Some(hit) = surely(&camera, sampling.position(texel), &triangles) {
                prop_assert_eq!(facets.len(), usize::from(hit), "texel {}", texel);
                prop_assert!(!hit || *side.get_or_insert(facets[0].facing) == facets[0].facing);
            }
        }
    }

    #[test]
    fn c_10_a_box_around_the_eye_shows_its_inside_everywhere(
        eye in places(0.9), turn in turns(), stretch in 1_f32..1000.0, target in places(1.0), sampling in samplings(),
    ) {
        prop_assume!(target.cross(DVec3::Y).length() > 0.1);
        let camera = Camera::new(eye, eye + target, 0.9, true, SIZE);
        let view = camera.view(NEAR, 100.0).with_sampling(sampling);
        // Every wall is at least 1.8 − √3·0.9 from the eye: more than the limit at which walls are cut.
        let found = fragments(&bins(&view, cuboid(Vec3::ZERO, Vec3::new(1.8, 1.8 * stretch, 2.5), turn)));
        for texel in TexelRect::of_size(SIZE).texels() {
            let facets = found.get(&(texel.y, texel.x)).map_or(&[][..], Vec::as_slice);
            prop_assert_eq!(facets.len(), 1, "texel {}", texel);
            prop_assert_eq!(facets[0].facing, Facing::Back);
        }
    }
}

#[test]
fn c_10_casters_before_the_near_plane_are_kept_and_counted() {
    let turn = Quat::IDENTITY;
    for perspective in [true, false] {
        let camera = Camera::new(DVec3::ZERO, DVec3::NEG_Z, 1.0, perspective, SIZE);
        let view = camera.view(NEAR, 100.0);
        let before = bins(&view, cuboid(Vec3::new(0.0, 0.0, -0.3), Vec3::splat(0.1), turn));
        assert_eq!((before.stats().before_near, before.stats().clipped), (before.stats().kept(), 0));
        assert!(!fragments(&before).is_empty());

        let through = bins(&view, cuboid(Vec3::new(0.0, 0.0, -0.5), Vec3::splat(0.2), turn));
        // The far face alone is behind the near plane throughout; side walls are edge-on in an orthographic view.
        assert_eq!(through.stats().before_near, through.stats().kept() - 2);

        let behind = bins(&view, cuboid(Vec3::new(0.0, 0.0, 3.0), Vec3::splat(0.5), turn));
        assert_eq!(
            fragments(&behind).is_empty(),
            perspective,
            "parallel light comes from infinitely far behind the view"
        );
        assert_eq!(behind.stats().outside, if perspective { 12 } else { 0 });
        assert_eq!(behind.stats().before_near, behind.stats().kept());
    }
}

#[test]
fn c_10_a_floor_under_the_eye_reaches_the_horizon() {
    let size = UVec2::new(64, 64);
    let camera = Camera::new(DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.0, 1.0, -1.0), 1.5, true, size);
    let far = 1e6;
    let [a, b, c, d] = [(-far, far), (far, far), (far, -far), (-far, -far)].map(|(x, z)| Vec3::new(x, 0.0, z));
    let bins = bins(&camera.view(0.1, 100.0), [solid([a, b, c]), solid([a, c, d])]);
    let found = fragments(&bins);
    assert_eq!(bins.stats().clipped, 2);
    assert!(TexelRect::of_size(size).texels().all(|texel| {
        let facets = found.get(&(texel.y, texel.x)).map_or(&[][..], Vec::as_slice);
        facets.len() == usize::from(texel.y >= 32) && facets.iter().all(|facet| facet.facing == Facing::Front)
    }));
}
