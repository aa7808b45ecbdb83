//! EXT-3, X-5: light that passes through things; EXT-2: means over time.
use crate::bodies::{cuboid, rectangle};
use glam::{DMat3, DVec3, DVec4, Vec3};
use umbrage_oracle::{AreaLight, AreaRegion, Body, Face, Geometry, RayCast, Truth};
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;
use umbrage_shadow::{Mean, Shadow, Unshadowed};

const KEY: Key = Key::new(7, 0, 0);
const RED: Vec3 = Vec3::new(0.5, 0.25, 0.0);
const GREY: Vec3 = Vec3::splat(0.5);

fn sheet(passes: Vec3) -> Body {
    Body { casts: true, solid: false, passes }
}

/// A square card at `height`, 10 to all sides of x = `middle`.
fn card(height: f32, middle: f32, object: u32) -> Vec<Face> {
    let corner = |x: f32, z: f32| Vec3::new(middle + 10.0 * x, height, 10.0 * z);
    rectangle([corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)], object).to_vec()
}

fn on_floor(x: f32, z: f32) -> SurfacePoint {
    SurfacePoint { object: 9, ..SurfacePoint::at(Vec3::new(x, 0.0, z), Vec3::Y) }
}

fn passes(shadow: &dyn Shadow, at: SurfacePoint) -> (f32, Vec3) {
    let (mut dark, mut out) = ([0.0], [Vec3::NAN]);
    shadow.fractions(&[at], KEY, &mut dark);
    shadow.transmittances(&[at], KEY, &dark, &mut out);
    (dark[0], out[0])
}

#[test]
fn ext_3_every_surface_takes_its_share() {
    let faces = [card(1.0, 0.0, 0), card(2.0, 5.0, 1), card(3.0, 40.0, 2)].concat();
    let geometry = Geometry::from_faces(faces, vec![sheet(RED), sheet(GREY), sheet(Vec3::ZERO)]);
    assert!(!geometry.is_opaque());
    let truth = RayCast::everywhere(&geometry, DVec4::Y);
    assert_eq!(passes(&truth, on_floor(-6.0, 1.0)), (0.75, RED));
    assert_eq!(passes(&truth, on_floor(3.0, 1.0)), (0.875, RED * GREY));
    assert_eq!(passes(&truth, on_floor(12.0, 1.0)), (0.5, GREY));
    assert_eq!(passes(&truth, on_floor(40.0, 1.0)), (1.0, Vec3::ZERO), "opaque stops");
    assert_eq!(passes(&truth, on_floor(20.0, 1.0)), (0.0, Vec3::ONE));
}

#[test]
fn ext_3_a_shared_edge_is_one_surface() {
    let geometry = Geometry::from_faces(card(1.0, 0.0, 0), vec![sheet(RED)]);
    let truth = RayCast::everywhere(&geometry, DVec4::Y);
    // On the diagonal of the card, where a ray meets both triangles.
    for along in [-7.0, -0.1, 0.0, 3.3] {
        for at in [on_floor(along, along), on_floor(along, -along)] {
            assert_eq!(truth.passes(&at), RED, "{at:?}");
        }
    }
    // A vertex fan, met at its hub, and a thin plate, whose two surfaces stay two.
    let hub = Vec3::Y;
    let rim =
        [Vec3::new(1.0, 1.0, 0.0), Vec3::new(0.0, 1.0, -1.0), Vec3::new(-1.0, 1.0, 0.0), Vec3::new(0.0, 1.0, 1.0)];
    let fan = (0..4).map(|i| Face { corners: [hub, rim[i], rim[(i + 1) % 4]], object: 0 }).collect();
    let geometry = Geometry::from_faces(fan, vec![sheet(RED)]);
    assert_eq!(RayCast::everywhere(&geometry, DVec4::Y).passes(&on_floor(0.0, 0.0)), RED);
    let plate = cuboid(DVec3::new(-1.0, 1.0, -1.0), DVec3::new(1.0, 1.0 + 1e-6, 1.0), DMat3::IDENTITY, 0);
    let geometry = Geometry::from_faces(plate, vec![Body { solid: true, ..sheet(RED) }]);
    assert_eq!(RayCast::everywhere(&geometry, DVec4::Y).passes(&on_floor(0.0, 0.0)), RED * RED);
}

#[test]
fn ext_3_a_transparent_solid_shades_its_own_far_side_by_what_is_crossed() {
    let block = |passes| {
        let faces = cuboid(DVec3::splat(-1.0), DVec3::ONE, DMat3::IDENTITY, 0);
        Geometry::from_faces(faces, vec![Body { casts: true, solid: true, passes }])
    };
    let (top, bottom) = (SurfacePoint::at(Vec3::Y, Vec3::Y), SurfacePoint::at(Vec3::NEG_Y, Vec3::NEG_Y));
    let glass = block(RED);
    let truth = RayCast::everywhere(&glass, DVec4::Y);
    assert_eq!(truth.passes(&top), Vec3::ONE);
    assert_eq!(truth.passes(&bottom), RED, "its front only: the surface at the point does not count");
    let below = SurfacePoint { object: 3, ..SurfacePoint::at(Vec3::NEG_Y * 4.0, Vec3::Y) };
    assert_eq!(truth.passes(&below), RED * RED);
    let stone = block(Vec3::ZERO);
    let truth = RayCast::everywhere(&stone, DVec4::Y);
    assert_eq!((truth.at(&top), truth.at(&bottom), truth.at(&below)), (0.0, 1.0, 1.0));
}

#[test]
fn x5_truth_s_notions_hold_for_what_passes() {
    let bodies = vec![sheet(RED), Body { casts: false, ..sheet(GREY) }];
    let geometry = Geometry::from_faces([card(1.0, 0.0, 0), card(2.0, 0.0, 1)].concat(), bodies);
    let truth = |truth| RayCast::everywhere(&geometry, DVec4::Y).with(truth);
    let at = on_floor(1.0, 2.0);
    assert_eq!(truth(Truth::default()).passes(&at), RED * GREY);
    assert_eq!(truth(Truth { casters_only: true, ..Truth::default() }).passes(&at), RED);
    let own = SurfacePoint { object: 0, ..at };
    assert_eq!(truth(Truth { own_slack: 1.5, ..Truth::default() }).passes(&own), GREY);
    // A positional light between the cards.
    assert_eq!(RayCast::everywhere(&geometry, DVec4::new(1.0, 1.5, 2.0, 1.0)).passes(&at), RED);
}

#[test]
fn ext_1_ext_3_regions_and_discs_mean_what_passes() {
    let geometry = Geometry::from_faces(card(2.0, -10.0, 0), vec![sheet(RED)]);
    let ray = || RayCast::everywhere(&geometry, DVec4::Y);
    let mut region = on_floor(-0.25, 0.5);
    region.corner_offsets = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|(x, z)| Vec3::new(x, 0.0, z));
    let disc = AreaLight::new(ray(), 0.1).with_samples(1024);
    // Three quarters of the region lie under the card; half of the disc at its edge.
    for (answer, share) in [
        (passes(&AreaRegion { across: 32, ..AreaRegion::new(ray()) }, region), 0.75),
        (passes(&disc, on_floor(0.0, 0.5)), 0.5),
    ] {
        let (dark, through) = answer;
        let expected = Vec3::ONE.lerp(RED, share);
        assert!((through - expected).abs().max_element() < 0.01, "{through} is not {expected}");
        assert!((dark - (1.0 - through.element_sum() / 3.0)).abs() < 1e-6);
    }
}

#[test]
fn x5_opaque_answers_are_exact_shares() {
    let geometry = Geometry::from_faces(card(2.0, -10.0, 0), vec![sheet(Vec3::ZERO)]);
    assert!(geometry.is_opaque());
    let mut disc = AreaLight::new(RayCast::everywhere(&geometry, DVec4::Y), 0.1);
    disc.across = 7;
    for step in -10..10 {
        let (dark, through) = passes(&disc, on_floor(0.02 * step as f32, 0.5));
        let hits = (dark * 49.0).round();
        assert_eq!(dark.to_bits(), (hits / 49.0).to_bits());
        assert_eq!(through, Vec3::splat(1.0 - dark));
    }
}

#[test]
fn ext_2_the_mean_of_times_is_a_blurred_shadow() {
    // A card that moves right by 1 at each of four times, its edge at 0, 1, 2 and 3; then the same in red.
    for (colour, loss) in [(Vec3::ZERO, Vec3::ONE), (RED, Vec3::ONE - RED)] {
        let times: Vec<Geometry> =
            (0..4).map(|time| Geometry::from_faces(card(2.0, time as f32 - 10.0, 0), vec![sheet(colour)])).collect();
        let rays = times.iter().map(|geometry| Box::new(RayCast::everywhere(geometry, DVec4::Y)) as Box<dyn Shadow>);
        let blurred = Mean(rays.collect());
        for (x, times_dark) in [(-0.5, 4.0), (0.5, 3.0), (1.5, 2.0), (2.5, 1.0), (3.5, 0.0)] {
            let (dark, through) = passes(&blurred, on_floor(x, 0.3));
            assert_eq!(through, Vec3::ONE - loss * (times_dark / 4.0));
            assert_eq!(dark, loss.element_sum() / 3.0 * times_dark / 4.0);
        }
    }
    assert_eq!(passes(&Mean(vec![]), on_floor(0.0, 0.0)), (0.0, Vec3::ONE));
    assert_eq!(passes(&Mean(vec![Box::new(Unshadowed)]), on_floor(0.0, 0.0)), (0.0, Vec3::ONE));
}
