//! Keys of facets against rays met with planes (design decision 5).

use crate::oracle::{Camera, bins, fragments, meet, solid, texel_view};
use crate::scenes::{places, samplings};
use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_plane::{Kind, Sampling};

const SIZE: UVec2 = UVec2::new(37, 23);

/// Distance between two positive floats in units in the last place.
fn ulps(a: f32, b: f32) -> u32 {
    a.to_bits().abs_diff(b.to_bits())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4_000))]

    #[test]
    fn depths_are_within_two_ulp_of_ray_and_plane(
        eye in places(20.0),
        target in places(20.0),
        corners in proptest::array::uniform3((-0.5_f64..1.5, -0.5_f64..1.5, 1.0_f64..60.0)),
        perspective in any::<bool>(),
        sampling in samplings(),
    ) {
        prop_assume!((target - eye).cross(DVec3::Y).length() > 1.0);
        let camera = Camera::new(eye, target, if perspective { 0.6 } else { 10.0 }, perspective, SIZE);
        let view = camera.view(1.0, 100.0).with_sampling(sampling);
        let corners =
            corners.map(|(x, y, zeta)| camera.point(DVec2::new(x, y) * SIZE.as_dvec2(), zeta).as_vec3());
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let radial = view.with_kind(Kind::Radial).decode();
        let mut seen = Vec::new();
        for ((y, x), facets) in fragments(&bins(&view, [solid(corners)])) {
            let at = sampling.position(IVec2::new(x, y));
            let ray = camera.ray(at);
            if normal.dot(ray.1.normalize()).abs() < 1e-3 {
                continue;
            }
            let (zeta, _) = meet(ray, corners);
            // Just past a corner on the horizon a plane may be met nowhere or behind the eye.
            if !(0.5..1000.0).contains(&zeta) {
                continue;
            }
            let key = facets[0].key(sampling, IVec2::new(x, y));
            let depth = view.decode().depth(key, at);
            prop_assert!(ulps(depth, zeta as f32) <= 2, "{} is not {} at {}", depth, zeta, at);
            let distance = (ray.1 * zeta).length();
            prop_assert!(ulps(radial.depth(key, at), distance as f32) <= 2);
            seen.push((at, zeta));
        }
        // Post-projective depth has keys of its own; it is compared where it is positive, as near to the near plane as that is.
        let screen = view.with_kind(Kind::Screen);
        for ((y, x), facets) in fragments(&bins(&screen, [solid(corners)])) {
            let at = sampling.position(IVec2::new(x, y));
            if let Some((_, zeta)) = seen.iter().find(|(place, zeta)| *place == at && *zeta > 1.0 + 1e-6) {
                let exact = if perspective { 100.0 * (zeta - 1.0) / (zeta * 99.0) } else { (zeta - 1.0) / 99.0 };
                let depth = screen.decode().depth(facets[0].key(sampling, IVec2::new(x, y)), at);
                prop_assert!(ulps(depth, exact as f32) <= 2, "z_s {} is not {} at {}", depth, exact, at);
            }
        }
    }

    /// However thin and edge-on: no sample's key leaves the triangle's range by more than half of it.
    #[test]
    fn edge_on_triangles_keep_to_their_range_of_keys(
        column in 1_i32..36, share in -1_f32..2.0, thin in 0.000_1_f32..0.02, mirrored in any::<bool>(),
        y in 1_f32..18.0, zeta in 2_f32..20.0, long in 0.1_f32..50.0,
    ) {
        let view = texel_view(SIZE, Sampling::Centre);
        let middle = SIZE.as_vec2() * 0.5;
        let corner = |x: f32, y: f32, zeta: f32| Vec3::new(x - middle.x, middle.y - y, -zeta);
        let thin = if mirrored { -thin } else { thin };
        let x = column as f32 + 0.5 - thin * share;
        let corners = [corner(x, y, zeta), corner(x + thin, y + 2.0, zeta + long), corner(x, y + 3.0, zeta)];
        for ((row, column), facets) in fragments(&bins(&view, [solid(corners)])) {
            let key = facets[0].key(Sampling::Centre, IVec2::new(column, row));
            let spare = 0.51 * long;
            prop_assert!((zeta - spare..=zeta + long + spare).contains(&key), "{} in {} + {}", key, zeta, long);
        }
    }
}

#[test]
fn an_edge_on_wall_has_the_mean_key_of_its_corners() {
    // A wall along the light's rays, a fifth of a snapping step wide: snapped to a whole one, it has a column of samples on its left edge.
    let view = texel_view(UVec2::new(8, 8), Sampling::Centre);
    let [left, right] = [0.5 + 0.4 / 256.0, 0.5 + 0.6 / 256.0];
    let corners = [Vec3::new(left, 3.0, -2.0), Vec3::new(right, 0.0, -8.0), Vec3::new(left, -3.0, -2.0)];
    let bins = bins(&view, [solid(corners)]);
    let facet = bins.facet(0).unwrap();
    assert_eq!((facet.plane.c, facet.plane.dx, facet.plane.dy), (4.0, 0.0, 0.0));
    assert!(!fragments(&bins).is_empty());
}

#[test]
fn c_2_a_known_plane_has_its_known_keys() {
    // A wall five units away, square to the view: −1/ζ in perspective, ζ in parallel light, everywhere.
    for perspective in [true, false] {
        let camera = Camera::new(DVec3::ZERO, DVec3::NEG_Z, 1.0, perspective, UVec2::splat(8));
        let corners = [Vec3::new(-90.0, -90.0, -5.0), Vec3::new(90.0, -90.0, -5.0), Vec3::new(0.0, 90.0, -5.0)];
        let bins = bins(&camera.view(1.0, 10.0), [solid(corners)]);
        let found = fragments(&bins);
        assert_eq!(found.len(), 64);
        for ((y, x), facets) in found {
            let expected = if perspective { -0.2 } else { 5.0 };
            assert_eq!(facets[0].key(Sampling::Centre, IVec2::new(x, y)), expected);
        }
    }
}
