//! The camera's pass: visibility sampled many times, shaded once per surface and pixel (X-4, R87-8).

use glam::{DVec3, UVec2, Vec3};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use umbrage_plane::{SurfacePoint, View};
use umbrage_render::{Frame, NOTHING, Sight, picture, picture_where, rays_where};
use umbrage_sample::Key;
use umbrage_scene::{Light, Material, Mesh, Object, Scene, gallery};
use umbrage_shadow::Shadow;

/// Remembers the points that it is given.
#[derive(Default)]
struct Asked(Mutex<Vec<SurfacePoint>>);

impl Shadow for Asked {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        self.0.lock().unwrap().extend_from_slice(at);
        out.fill(0.25);
    }
}

/// Two boards that share the middle of a picture of 16 × 16: the left one nearer, its edge a third into pixel column 5.
fn boards() -> Scene {
    let camera = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 8.0, 1.0, 50.0, UVec2::splat(16)).unwrap();
    let board = |x0: f32, x1: f32, z: f32| Mesh::cuboid(Vec3::new(x0, -9.0, z - 1.0), Vec3::new(x1, 9.0, z));
    let edge = 5.0 + 1.0 / 3.0 - 8.0;
    let light = Light::point("lamp", DVec3::new(0.0, 0.0, 20.0), DVec3::ZERO, 90.0, 1.0, 99.0, UVec2::splat(8));
    Scene {
        name: "boards".into(),
        origin: DVec3::ZERO,
        objects: vec![
            Object::solid("near", board(-9.0, edge, -5.0), Material::matt(Vec3::new(0.5, 0.0, 0.0))),
            Object::solid("far", board(-9.0, 4.0, -10.0), Material::matt(Vec3::new(0.0, 0.5, 0.0))),
        ],
        lights: vec![light.unwrap()],
        ambient: Vec3::ONE,
        background: Vec3::new(0.0, 0.0, 1.0),
        camera,
    }
}

#[test]
fn x4_one_region_a_surface_and_pixel_with_its_share_of_the_samples() {
    let (scene, asked) = (boards(), Asked::default());
    let seen = picture(&scene, &[&asked], &Frame { axis: 8, ..Frame::default() });
    let regions = asked.0.into_inner().unwrap();
    // Columns 0 to 11 show something; column 5 both boards.
    assert_eq!((seen.regions, regions.len()), (16 * 13, 16 * 13));
    for y in 0..16 {
        let i = y * 16 + 5;
        assert_eq!((seen.object[i], seen.object[y * 16 + 13]), (1, NOTHING));
        // Stratified in x: within one of eight columns of cells.
        assert!((seen.share[i] - 2.0 / 3.0).abs() < 0.125, "{}", seen.share[i]);
        assert!((seen.shadow[0][i] - 0.25).abs() < 1e-6, "shares add up to the whole pixel");
    }
    let mut names: Vec<u32> = regions.iter().map(|region| region.region).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), regions.len(), "every region has a name of its own");
}

#[test]
fn the_surfaces_of_a_pixel_share_its_cells() {
    let (scene, asked) = (boards(), Asked::default());
    picture(&scene, &[&asked], &Frame { axis: 4, stochastic: false, ..Frame::default() });
    let regions = asked.0.into_inner().unwrap();
    let shares = |region: &SurfacePoint| -> Vec<f32> { (0..4).map(|x| region.cells.share(x, 2, 4)).collect() };
    let mut split = 0;
    for region in &regions {
        let others: Vec<_> = regions.iter().filter(|other| other.region >> 6 == region.region >> 6).collect();
        match others.as_slice() {
            // Of the columns of samples at 1/8, 3/8, 5/8 and 7/8, the nearer board has those left of 1/3.
            [near, far] => {
                split += 1;
                assert_eq!((shares(near), shares(far)), (vec![1.0, 0.0, 0.0, 0.0], vec![0.0, 1.0, 1.0, 1.0]));
                // Where the cells have their centroid, there the region is.
                let middle = |region: &SurfacePoint| region.position.x - 0.5 * region.cells.centroid().x;
                assert!((middle(near) - middle(far)).abs() < 1e-6 && (middle(near) + 2.5).abs() < 1e-6);
            }
            _ => assert!(region.cells.is_whole()),
        }
    }
    assert_eq!(split, 2 * 16);
    let again = Asked::default();
    picture(&scene, &[&again], &Frame { axis: 4, every_sample: true, ..Frame::default() });
    assert!(again.0.into_inner().unwrap().iter().all(|region| region.cells.is_whole()));
}

#[test]
fn pixels_that_are_wanted_are_the_same_in_a_part_of_the_picture() {
    let (scene, frame) = (boards(), Frame { axis: 2, ..Frame::default() });
    let (all, some) = (picture(&scene, &[], &frame), picture_where(&scene, &[], &frame, |pixel| pixel % 3 == 0));
    for i in 0..all.share.len() {
        if i % 3 == 0 {
            assert_eq!((all.colour[i], all.share[i], all.depth[i]), (some.colour[i], some.share[i], some.depth[i]));
        } else {
            assert_eq!((some.colour[i], some.object[i]), (scene.background, NOTHING));
        }
    }
}

#[test]
fn a_sight_gives_the_pictures_of_its_scene() {
    let (scene, frame) = (boards(), Frame::default());
    let sight = Sight::new(&scene, &frame);
    for shadows in [&[][..], &[&Asked::default() as &dyn Shadow]] {
        let (kept, anew) = (sight.picture(&scene, shadows), picture(&scene, shadows, &frame));
        assert_eq!((&kept.colour, &kept.shadow, &kept.facing), (&anew.colour, &anew.shadow, &anew.facing));
        assert_eq!((&kept.object, &kept.share, &kept.depth), (&anew.object, &anew.share, &anew.depth));
        assert_eq!((kept.fragments, kept.passing, kept.regions), (anew.fragments, anew.passing, anew.regions));
    }
}

#[test]
fn r87_8_a_region_s_corners_are_its_pixel_s_on_the_tangent_plane() {
    let (scene, asked) = (boards(), Asked::default());
    picture(&scene, &[&asked], &Frame::CENTRES);
    for region in asked.0.into_inner().unwrap() {
        let want = [(-0.5, 0.5), (0.5, 0.5), (0.5, -0.5), (-0.5, -0.5)].map(|(x, y)| Vec3::new(x, y, 0.0));
        for (corner, want) in region.corner_offsets.into_iter().zip(want) {
            assert!(corner.abs_diff_eq(want, 1e-4), "{corner} {want}");
        }
        assert_eq!(region.normal, Vec3::Z);
    }
}

#[test]
fn x4_every_sample_shades_each_and_gives_the_same_picture_in_the_mean() {
    let scene = boards();
    let (once, each) = (Asked::default(), Asked::default());
    let frame = Frame { axis: 4, ..Frame::default() };
    let a = picture(&scene, &[&once], &frame);
    let b = picture(&scene, &[&each], &Frame { every_sample: true, ..frame });
    // Seven eighths of the picture show a board: 12 of 16 columns.
    assert_eq!((a.regions, b.regions), (16 * 13, 16 * 12 * 16));
    for (a, b) in a.colour.iter().zip(&b.colour) {
        assert!(a.abs_diff_eq(*b, 1e-2), "{a} {b}");
    }
}

#[test]
fn what_is_before_the_near_plane_is_not_seen() {
    let mut scene = boards();
    let near = Mesh::cuboid(Vec3::new(-3.0, -3.0, -0.9), Vec3::new(3.0, 3.0, -0.5));
    let without = picture(&scene, &[], &Frame::CENTRES);
    scene.objects.push(Object::solid("too near", near, Material::matt(Vec3::ONE)));
    let with = picture(&scene, &[], &Frame::CENTRES);
    assert_eq!((with.depth, with.colour), (without.depth, without.colour));
}

#[test]
fn r87_25_a_light_that_does_not_cast_is_not_asked() {
    let (mut scene, asked) = (boards(), Asked::default());
    scene.lights[0].casts = false;
    let seen = picture(&scene, &[&asked], &Frame::CENTRES);
    assert!(asked.0.into_inner().unwrap().is_empty());
    assert!(seen.shadow[0].iter().all(|share| *share == 0.0));
}

#[test]
fn samples_that_do_not_fit_one_grid_are_fewer() {
    let camera = gallery::sphere_plane().camera;
    let frame = Frame { axis: 8, ..Frame::default() };
    let across = |size: u32| frame.sample_view(&camera.with_size(UVec2::new(size, 1)).unwrap()).size().x;
    assert_eq!((across(4096), across(4097), across(20_000)), (32_768, 16_388, 20_000));
}

#[test]
fn pictures_of_shadows_alone_differ_in_their_colour_only() {
    let scene = boards();
    for every_sample in [false, true] {
        let frame = Frame { axis: 4, every_sample, ..Frame::default() };
        let shadow = Striped::default();
        let (all, sight) = (picture(&scene, &[&shadow], &frame), Sight::new(&scene, &frame));
        assert!(all.shadow[0].iter().any(|&dark| dark > 0.0));
        assert!(!shadow.points.load(Ordering::Relaxed));
        let by_points = rays_where(&scene, &[&shadow], &frame, |_| true);
        assert!(shadow.points.load(Ordering::Relaxed));
        for some in [by_points, sight.shadows(&scene, &[&shadow])] {
            assert_eq!((&some.shadow, &some.facing, &some.object), (&all.shadow, &all.facing, &all.object));
            assert_eq!((&some.share, &some.normal, &some.depth), (&all.share, &all.normal, &all.depth));
            assert!(some.colour.iter().all(|colour| *colour == scene.background));
        }
        assert!(all.colour.iter().any(|colour| *colour != scene.background));
    }
}

/// Dark at every other place across, whatever the extent; remembers whether it was given points without any.
#[derive(Default)]
struct Striped {
    points: AtomicBool,
}

impl Shadow for Striped {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        for (point, dark) in at.iter().zip(out) {
            *dark = f32::from(u8::from(point.position.x.rem_euclid(0.5) < 0.25));
            if point.corner_offsets == [Vec3::ZERO; 4] {
                self.points.store(true, Ordering::Relaxed);
            }
        }
    }
}
