//! X-5, EXT-1: regions, lights with extent, and the light's rules.
use crate::bodies::{cuboid, floor, rectangle};
use glam::{DMat3, DVec3, DVec4, UVec2, Vec3};
use umbrage_oracle::{
    AreaLight, AreaRegion, Body, Face, Geometry, RayCast, Truth, gap_on_surface, predict, profile_on_surface,
};
use umbrage_plane::{Rules, SurfacePoint, View};
use umbrage_sample::Key;
use umbrage_scene::{Cover, Material, Mesh, Object, Scene, Shape};
use umbrage_shadow::Shadow;

const SOLID: Body = Body { casts: true, solid: true, passes: Vec3::ZERO };
const KEY: Key = Key::new(5, 0, 0);

/// A card at height 2 over x < 0, its edge above x = 0.
fn half_plane() -> Geometry {
    let corner = |x: f32, z: f32| Vec3::new(x, 2.0, z);
    let card =
        rectangle([corner(-90.0, -90.0), corner(-90.0, 90.0), corner(0.0, 90.0), corner(0.0, -90.0)], 0).to_vec();
    Geometry::from_faces(card, vec![Body { casts: true, solid: false, passes: Vec3::ZERO }])
}

fn on_floor(x: f32) -> SurfacePoint {
    SurfacePoint { object: 9, ..SurfacePoint::at(Vec3::new(x, 0.0, 0.0), Vec3::Y) }
}

fn lamp(rules: Rules) -> View {
    let size = UVec2::splat(64);
    View::perspective(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, 1.0, 1.0, 100.0, size).unwrap().with_rules(rules)
}

#[test]
fn r87_f6_region_truth_is_a_ratio_of_areas() {
    let geometry = half_plane();
    let truth = AreaRegion { across: 32, ..AreaRegion::new(RayCast::everywhere(&geometry, DVec4::Y)) };
    for (centre, expected) in [(-1.0, 1.0), (-0.25, 0.75), (0.0, 0.5), (0.1, 0.4), (0.6, 0.0)] {
        let mut region = on_floor(centre);
        region.corner_offsets = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|(x, z)| Vec3::new(x, 0.0, z));
        // One column of 32 strata straddles the edge: D-12's variance is below (.0023)².
        assert!((truth.fraction(&region, KEY) - expected).abs() < 0.01, "centre {centre}");
    }
    let point = on_floor(-0.001);
    assert_eq!(truth.fraction(&point, KEY), truth.ray.at(&point), "a region without extent is a point");
}

#[test]
fn d16_ext_1_penumbra_of_a_disc() {
    let geometry = half_plane();
    let radius = 0.5;
    // Light 10 above the floor, card 8 below the light: the penumbra is 2·.5·2/8 = .25 wide.
    let width = predict::expected_penumbra_width(2.0 * radius, 8.0, 10.0);
    assert_eq!(width, 0.25);
    let share_beyond = |offset: f64| (offset.acos() - offset * (1.0 - offset * offset).sqrt()) / std::f64::consts::PI;
    for light in
        [RayCast::new(&geometry, &lamp(Rules::OPEN)), RayCast::everywhere(&geometry, DVec4::new(0.0, 10.0, 0.0, 1.0))]
    {
        let truth = AreaLight::new(light, radius).with_samples(1000);
        assert_eq!(truth.across, 32);
        assert_eq!(truth.fraction(&on_floor(-0.51 * width as f32), KEY), 1.0);
        assert_eq!(truth.fraction(&on_floor(0.51 * width as f32), KEY), 0.0);
        for x in [-0.4, -0.2, 0.0, 0.15, 0.45] {
            let shadow = f64::from(truth.fraction(&on_floor((x * width) as f32), KEY));
            assert!((shadow - share_beyond(2.0 * x)).abs() < 0.01, "{x}: {shadow}");
        }
    }
}

#[test]
fn d16_penumbra_of_the_sky() {
    let geometry = half_plane();
    let sun = AreaLight::sky(RayCast::everywhere(&geometry, DVec4::Y * 3.0), 0.1);
    let half = predict::sky_penumbra_half_width(0.1, 2.0) as f32;
    assert_eq!(sun.fraction(&on_floor(-1.01 * half), KEY), 1.0);
    assert_eq!(sun.fraction(&on_floor(1.01 * half), KEY), 0.0);
    let (inside, outside) = (sun.fraction(&on_floor(-0.97 * half), KEY), sun.fraction(&on_floor(0.9 * half), KEY));
    assert!(inside < 1.0 && outside > 0.0, "{inside} {outside}");
    assert!((sun.fraction(&on_floor(0.0), KEY) - 0.5).abs() < 0.02);
}

#[test]
fn c10_a_spot_is_dark_outside_its_cone() {
    let geometry = Geometry::from_faces(floor(50.0, 0).to_vec(), vec![SOLID]);
    let at = |x: f32, y: f32| SurfacePoint::at(Vec3::new(x, y, 0.0), Vec3::Y);
    let spot = RayCast::new(&geometry, &lamp(Rules::SPOT).with_cone(Some(0.4_f64.atan().cos())).unwrap());
    assert_eq!(spot.at(&at(3.9, 0.0)), 0.0);
    assert_eq!(spot.at(&at(4.1, 0.0)), 1.0, "outside the cone");
    assert_eq!(spot.at(&at(20.0, 0.0)), 1.0, "outside the map");
    assert_eq!(spot.at(&at(0.0, 11.0)), 1.0, "behind the light");
    let spot = spot.with(Truth { look_everywhere: true, ..Truth::default() });
    assert_eq!(spot.at(&at(4.1, 0.0)), 1.0, "no light goes there, whoever looks");
}

#[test]
fn c10_an_open_light_lights_what_its_map_does_not_hold() {
    let block = cuboid(DVec3::new(19.0, 0.0, -1.0), DVec3::new(20.0, 3.0, 1.0), DMat3::IDENTITY, 0);
    let geometry = Geometry::from_faces(block, vec![SOLID]);
    let behind_block = on_floor(21.0);
    let open = RayCast::new(&geometry, &lamp(Rules::OPEN));
    assert_eq!(open.at(&behind_block), 0.0);
    let everywhere = open.with(Truth { look_everywhere: true, ..Truth::default() });
    assert_eq!(everywhere.at(&behind_block), 1.0);
}

#[test]
fn truth_counts_every_object_unless_told() {
    let roof =
        |object| Face { corners: [(-9.0, -9.0), (0.0, 9.0), (9.0, -9.0)].map(|(x, z)| Vec3::new(x, 1.0, z)), object };
    let geometry = Geometry::from_faces(vec![roof(0)], vec![Body { casts: false, solid: true, passes: Vec3::ZERO }]);
    let below = on_floor(0.0);
    let roof_underside = SurfacePoint::at(Vec3::new(0.0, 1.0, 0.0), Vec3::NEG_Y);
    let truth = RayCast::everywhere(&geometry, DVec4::Y);
    assert_eq!((truth.at(&below), truth.at(&roof_underside)), (1.0, 1.0));
    let truth = truth.with(Truth { casters_only: true, ..Truth::default() });
    assert_eq!((truth.at(&below), truth.at(&roof_underside)), (0.0, 0.0));
    let geometry = Geometry::from_faces(vec![roof(9)], vec![]);
    let truth = RayCast::everywhere(&geometry, DVec4::Y);
    assert_eq!(truth.at(&below), 1.0);
    assert_eq!(truth.with(Truth { own_slack: 1.5, ..Truth::default() }).at(&below), 0.0, "its own object, 1 away");
}

#[test]
fn m7_gap_on_a_surface() {
    let geometry = half_plane();
    let truth = RayCast::everywhere(&geometry, DVec4::Y);
    let gap = gap_on_surface(&truth, &on_floor(1.3), Vec3::NEG_X * 2.0, 0.25, 9.0, KEY).unwrap();
    assert!((gap - 1.3).abs() < 0.25 / 64.0 + 1e-6, "{gap}");
    assert_eq!(gap_on_surface(&truth, &on_floor(-0.1), Vec3::NEG_X, 0.25, 9.0, KEY), Some(0.0));
    assert_eq!(gap_on_surface(&truth, &on_floor(1.3), Vec3::X, 0.25, 9.0, KEY), None);
    assert_eq!(gap_on_surface(&truth, &on_floor(1.3), Vec3::ZERO, 0.25, 9.0, KEY), None);
}

#[test]
fn x5_a_scene_is_all_its_objects() {
    let card = |casts, height: f32| Object {
        name: String::new(),
        shape: Shape::Mesh(Mesh {
            positions: [(-9.0, -9.0), (0.0, 9.0), (9.0, -9.0)].map(|(x, z)| Vec3::new(x, height, z)).to_vec(),
            normals: vec![Vec3::Y; 3],
            triangles: vec![[0, 1, 2]],
            surfaces: vec![0],
            ..Mesh::default()
        }),
        material: Material { diffuse: Vec3::ONE, specular: Vec3::ZERO, shininess: 1.0 },
        casts,
        receives: true,
        solid: !casts,
        passes: Vec3::ZERO,
        cover: Cover::default(),
    };
    let scene = Scene {
        name: String::new(),
        origin: DVec3::ZERO,
        objects: vec![card(true, 1.0), card(false, 2.0)],
        lights: vec![],
        ambient: Vec3::ZERO,
        background: Vec3::ZERO,
        camera: lamp(Rules::OPEN),
    };
    let geometry = Geometry::new(&scene, &scene.camera);
    assert_eq!(geometry.body(0), Body { casts: true, solid: false, passes: Vec3::ZERO });
    assert_eq!(geometry.body(1), Body { casts: false, solid: true, passes: Vec3::ZERO });
    let met: Vec<(u32, f64)> = geometry.hits(DVec3::ZERO, DVec3::Y).iter().map(|hit| (hit.object, hit.t)).collect();
    assert_eq!(met, [(0, 1.0), (1, 2.0)]);
}

/// A shadow that grows along x from 0 at `from` to 1 at `to`.
struct Ramp {
    from: f32,
    to: f32,
}

impl Shadow for Ramp {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        for (point, out) in at.iter().zip(out) {
            *out = ((point.position.x as f32 - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
        }
    }
}

#[test]
fn m1_world_width_of_a_ramp_along_a_line() {
    let ramp = Ramp { from: 2.0, to: 5.0 };
    let profile = profile_on_surface(&ramp, &on_floor(3.0), Vec3::X * 7.0, 6.0, 241, KEY);
    assert_eq!((profile.points.len(), profile.points[0].0, profile.points[240].0), (241, -6.0, 6.0));
    assert!((profile.width().unwrap() - 2.4).abs() < 1e-4);
    assert!((profile.midpoint().unwrap() - 0.5).abs() < 1e-4);
    // Across it at 60°: twice as wide along the line.
    let slanted = Vec3::new(0.5, 0.0, 0.75f32.sqrt());
    let profile = profile_on_surface(&ramp, &on_floor(3.5), slanted, 12.0, 481, KEY);
    assert!((profile.width().unwrap() - 4.8).abs() < 1e-4);
    assert_eq!(profile_on_surface(&ramp, &on_floor(3.5), Vec3::NEG_X, 6.0, 241, KEY).width(), None, "shadow behind");
    assert!(profile_on_surface(&ramp, &on_floor(3.5), Vec3::ZERO, 6.0, 241, KEY).points.is_empty());
    assert!(profile_on_surface(&ramp, &on_floor(3.5), Vec3::X, 6.0, 1, KEY).points.is_empty());
}

#[test]
fn d16_v65_disc_edge_is_what_rays_find() {
    let geometry = half_plane();
    let light = RayCast::new(&geometry, &lamp(Rules::OPEN));
    let truth = AreaLight::new(light, 0.5).with_samples(4096);
    let width = predict::expected_penumbra_width(1.0, 8.0, 10.0);
    let profile = profile_on_surface(&truth, &on_floor(0.0), Vec3::NEG_X, width as f32, 401, KEY);
    let ten_to_ninety = profile.width().unwrap();
    assert!((ten_to_ninety / (predict::DISC_EDGE_10_90 * width) - 1.0).abs() < 0.01, "{ten_to_ninety}");
    for &(distance, shadow) in &profile.points {
        let predicted = predict::disc_edge(-2.0 * distance / width);
        assert!((shadow - predicted).abs() < 0.01, "{distance}: {shadow} is not {predicted}");
    }
}
