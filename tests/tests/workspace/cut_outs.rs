//! Cut-outs: a board that a texture cuts into a checkerboard has the shadow of one that was sawn, in every kind of map and for rays,
//! and the camera sees through it.

use glam::{DVec3, DVec4, IVec2, UVec2, Vec2, Vec3, Vec4};
use std::sync::Arc;
use umbrage_bake::bake_tags;
use umbrage_depth::Storage;
use umbrage_oracle::{Geometry, RayCast, diagnose_recipe};
use umbrage_plane::{SurfacePoint, View};
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, Ground, NOTHING, Picture, Planar, Soup, light_shadow, picture};
use umbrage_sample::Key;
use umbrage_scene::{Cover, Interpolation, Light, Material, Mesh, Object, Scene, Shape, Texture, Wrap};

/// Squares along a side of the board, which is 8 units wide and 3 above the floor.
const SQUARES: u32 = 4;
const HEIGHT: f32 = 3.0;

fn square(low: Vec2, high: Vec2, height: f32) -> Mesh {
    let corners = [(low.x, high.y), (high.x, high.y), (high.x, low.y), (low.x, low.y)];
    Mesh::sheet(corners.map(|(x, z)| Vec3::new(x, height, z)), 1)
}

fn sheet(name: &str, mesh: Mesh) -> Object {
    Object::two_sided(name, Shape::Mesh(mesh), Material::matt(Vec3::splat(0.5)))
}

/// A board all in one piece; its texture's rows go along z.
fn board() -> Mesh {
    let uvs = vec![Vec2::Y, Vec2::ONE, Vec2::ZERO, Vec2::X];
    Mesh { uvs, ..square(Vec2::splat(-4.0), Vec2::splat(4.0), HEIGHT) }
}

fn is_there(column: u32, row: u32) -> bool {
    (column + row).is_multiple_of(2)
}

/// Squares that are there in turns; those that are not are of a colour that nobody may see.
fn checks() -> Texture {
    let texel = |i: u32| {
        let (x, y) = (i % SQUARES, i / SQUARES);
        if is_there(x, y) { Vec4::new(1.0, 0.5 * x as f32, 0.5 * y as f32, 1.0) } else { Vec4::new(9.0, 9.0, 9.0, 0.0) }
    };
    let texels = (0..SQUARES * SQUARES).map(texel).collect();
    Texture::linear(UVec2::splat(SQUARES), texels).unwrap().with_interpolation(Interpolation::Nearest)
}

fn masked() -> Object {
    sheet("board", board()).with_cover(Cover::cut_out(Arc::new(checks()), 0.5))
}

/// The same with a saw.
fn sawn() -> Object {
    let mut all = Mesh::default();
    for (x, y) in (0..SQUARES * SQUARES).map(|i| (i % SQUARES, i / SQUARES)).filter(|(x, y)| is_there(*x, *y)) {
        let low = Vec2::new(x as f32, y as f32) * (8.0 / SQUARES as f32) - 4.0;
        all.append(&square(low, low + 8.0 / SQUARES as f32, HEIGHT));
    }
    sheet("board", all)
}

fn sun() -> View {
    let eye = DVec3::new(6.0, 20.0, 4.0);
    View::orthographic(eye, DVec3::ZERO, DVec3::Z, 9.0, 1.0, 60.0, UVec2::splat(512)).unwrap()
}

fn spot() -> View {
    let eye = DVec3::new(-5.0, 14.0, 3.0);
    View::perspective(eye, DVec3::ZERO, DVec3::Z, 1.3, 1.0, 60.0, UVec2::splat(512)).unwrap()
}

/// A board above a floor.
fn scene(board: Object, view: &View) -> Scene {
    let eye = DVec3::new(2.0, 15.0, 9.0);
    Scene {
        name: "cut-out".into(),
        origin: DVec3::ZERO,
        objects: vec![sheet("floor", square(Vec2::splat(-12.0), Vec2::splat(12.0), 0.0)), board],
        lights: vec![Light {
            view: *view,
            ..Light::point("lamp", eye, DVec3::ZERO, 60.0, 1.0, 90.0, UVec2::ONE).unwrap()
        }],
        ambient: Vec3::ONE,
        background: Vec3::ZERO,
        camera: View::perspective(eye, DVec3::new(0.0, 0.0, -0.5), DVec3::Y, 1.0, 1.0, 90.0, UVec2::splat(96)).unwrap(),
    }
}

const FRAME: Frame = Frame { axis: 4, stochastic: false, every_sample: false, smooth: false, seed: 5, number: 0 };

fn mapped(scene: &Scene, text: &str) -> Picture {
    let recipe: Recipe = text.parse().unwrap();
    let light = light_shadow(&recipe, &[scene], &scene.lights[0].view, Storage::Tiled).unwrap();
    picture(scene, &[&*light.shadow], &FRAME)
}

fn traced(scene: &Scene) -> Picture {
    let geometry = Geometry::new(scene, &scene.camera);
    let rays = RayCast::new(&geometry, &scene.lights[0].view);
    picture(scene, &[&rays], &Frame { every_sample: true, ..FRAME })
}

/// Root mean square difference of two shadow images: over all, and over pixels that are one with all their neighbours in the second.
fn rms(found: &Picture, right: &Picture) -> (f64, f64) {
    let (width, height) = (right.size.x as i32, right.size.y as i32);
    let (found, right) = (&found.shadow[0], &right.shadow[0]);
    let flat = |i: i32| {
        let around = |x: i32, y: i32| right[(y.clamp(0, height - 1) * width + x.clamp(0, width - 1)) as usize];
        let (x, y) = (i % width, i / width);
        (-2..=2).all(|dy| (-2..=2).all(|dx| around(x + dx, y + dy) == right[i as usize]))
    };
    let (mut all, mut inner, mut count) = (0.0, 0.0, 0);
    for i in 0..width * height {
        let error = f64::from(found[i as usize] - right[i as usize]).powi(2);
        all += error;
        if flat(i) {
            (inner, count) = (inner + error, count + 1);
        }
    }
    assert!(count * 4 > width * height, "{count} pixels are away from edges");
    ((all / f64::from(width * height)).sqrt(), (inner / f64::from(count)).sqrt())
}

#[test]
fn rays_find_the_shadow_of_a_sawn_board_and_the_camera_sees_through() {
    for view in [sun(), spot()] {
        let (cut, sawn) = (traced(&scene(masked(), &view)), traced(&scene(sawn(), &view)));
        assert_eq!(cut.object, sawn.object);
        assert_eq!(cut.depth, sawn.depth);
        // Not to the bit: rays along the border of a square may go either way.
        let differ = cut.shadow[0].iter().zip(&sawn.shadow[0]).filter(|(cut, sawn)| cut != sawn).count();
        assert!(differ < 10, "{differ} pixels of {}", cut.object.len());
        let seen = |id: u32| cut.object.iter().filter(|object| **object == id).count();
        assert!(seen(0) > 2000 && seen(1) > 500, "{} {}", seen(0), seen(1));
    }
}

#[test]
fn maps_find_the_shadow_of_a_cut_out() {
    for view in [sun(), spot()] {
        let (cut, sawn) = (scene(masked(), &view), scene(sawn(), &view));
        let truth = traced(&cut);
        for (text, most) in [
            ("auto", 0.01),
            ("auto,window=fitted", 0.01),
            ("reeves87,bias=0.1,res-factor=1,samples=64", 0.02),
            ("reeves87,stored=second,bias=0.1,res-factor=1,samples=64", 0.02),
            ("reeves87,stored=deep,bias=0.1,res-factor=1,samples=64", 0.02),
            ("woo92,res-factor=1,samples=64", 0.02),
        ] {
            let found = mapped(&cut, text);
            let ((all, inner), (by_hand, _)) = (rms(&found, &truth), rms(&mapped(&sawn, text), &truth));
            assert!(all < most && inner < 0.005, "{text}: {all:.4} in all, {inner:.5} away from edges");
            assert!((all - by_hand).abs() < 0.002, "{text}: {all:.4}, and sawn {by_hand:.4}");
        }
    }
}

#[test]
fn tags_and_planar_shadows_have_the_same_holes() {
    for view in [sun(), spot()] {
        let scenes = [scene(masked(), &view), scene(sawn(), &view)];
        let tags = scenes.each_ref().map(|scene| bake_tags(&view, Soup::casters(scene, &view).casting()));
        let texels = (0..512 * 512).map(|i| IVec2::new(i % 512, i / 512));
        let differ = texels.filter(|texel| tags[0].id(*texel) != tags[1].id(*texel)).count();
        assert!(differ < 100, "{differ} texels");
        let ground = Ground { centre: DVec3::ZERO, normal: DVec3::Y, half_side: 12.0 };
        let planar = scenes.each_ref().map(|scene| {
            let shadow = Planar::new(scene, &view, ground, 0, 512).unwrap();
            picture(scene, &[&shadow], &FRAME).shadow.swap_remove(0)
        });
        let differ = (0..planar[0].len()).filter(|i| (planar[0][*i] - planar[1][*i]).abs() > 0.3).count();
        assert!(differ < 20, "{differ} pixels");
    }
}

/// Two moments whose boards have their holes where the other has none: each is tested by its own.
#[test]
fn every_moment_has_its_own_holes() {
    let uvs = board().uvs.iter().map(|uv| *uv + Vec2::X / SQUARES as f32).collect();
    let moved = sheet("board", Mesh { uvs, ..board() }).with_cover(masked().cover);
    let scenes = [scene(masked(), &sun()), scene(moved, &sun())];
    let moments = scenes.each_ref();
    // Under the middle of each square of the board, which the sun throws aside.
    let aside = DVec3::new(6.0, 20.0, 4.0) * (f64::from(HEIGHT) / 20.0);
    let under = |i: u32| DVec3::new(f64::from(i % SQUARES) * 2.0 - 3.0, 0.0, f64::from(i / SQUARES) * 2.0 - 3.0);
    let points: Vec<SurfacePoint> = (0..SQUARES * SQUARES)
        .map(|i| SurfacePoint::at(under(i) - DVec3::new(aside.x, 0.0, aside.z), Vec3::Y))
        .collect();
    for text in ["auto", "reeves87,stored=deep,bias=0.1,res-factor=1"] {
        let recipe: Recipe = text.parse().unwrap();
        let fractions = |moments: &[&Scene]| {
            let light = light_shadow(&recipe, moments, &sun(), Storage::Tiled).unwrap();
            let mut fractions = vec![0.0; points.len()];
            light.shadow.fractions(&points, Key::new(1, 0, 0), &mut fractions);
            fractions
        };
        let [first, second] = moments.map(|moment| fractions(&[moment]));
        for i in 0..SQUARES * SQUARES {
            let dark = f32::from(u8::from(is_there(i % SQUARES, i / SQUARES)));
            assert_eq!([first[i as usize], second[i as usize]], [dark, 1.0 - dark], "{text}, square {i}");
        }
        assert_eq!(fractions(&moments), vec![0.5; points.len()], "{text}");
    }
}

#[test]
fn light_that_passes_a_cut_out_is_dimmed_where_it_is_there() {
    let glass = Object { passes: Vec3::new(0.5, 0.25, 0.0), ..masked() };
    let scene = scene(glass, &spot());
    let (found, truth) = (mapped(&scene, "auto"), traced(&scene));
    let (all, inner) = rms(&found, &truth);
    assert!(all < 0.02 && inner < 0.005, "{all:.4} in all, {inner:.5} away from edges");
    let darkest = truth.shadow[0].iter().copied().fold(0.0, f32::max);
    assert!((darkest - 0.75).abs() < 1e-5, "one surface in the way: {darkest}");
}

#[test]
fn far_from_the_origin_nothing_changes() {
    let near = scene(masked(), &spot());
    let far = near.clone().moved(DVec3::new(4e6, -2e6, 1e6)).unwrap();
    for shot in [traced, |scene: &Scene| mapped(scene, "auto")] {
        let [near, far] = [&near, &far].map(shot);
        assert_eq!(near.object, far.object);
        let differ = near.shadow[0].iter().zip(&far.shadow[0]).filter(|(near, far)| (*near - *far).abs() > 0.1);
        assert!(differ.count() < 20);
    }
}

/// A camera that looks straight down on the board and on some of the floor around it: a pixel for each unit.
fn plan(board: Object) -> Scene {
    let eye = DVec3::Y * 20.0;
    let camera = View::orthographic(eye, DVec3::ZERO, DVec3::NEG_Z, 6.0, 1.0, 60.0, UVec2::splat(12)).unwrap();
    Scene { camera, lights: Vec::new(), ..scene(board, &sun()) }
}

#[test]
fn the_camera_sees_texels_where_they_lie_and_the_floor_through_holes() {
    let texture = Arc::new(checks());
    let whole = sheet("board", board()).with_cover(Cover::textured(Arc::clone(&texture)));
    for (board, cut) in [(masked(), true), (whole, false)] {
        for frame in [FRAME, Frame::CENTRES, Frame { every_sample: true, ..Frame::default() }] {
            let seen = picture(&plan(board.clone()), &[], &frame);
            for (i, y) in (0..12).flat_map(|y| (0..12).map(move |x| (y * 12 + x, y))) {
                let at = UVec2::new(i as u32 % 12, y as u32);
                let inside = at.cmpge(UVec2::splat(2)).all() && at.cmplt(UVec2::splat(10)).all();
                let square = at.saturating_sub(UVec2::splat(2)) / 2;
                let there = inside && (!cut || is_there(square.x, square.y));
                let texel = texture.sample((square.as_dvec2() + 0.5) / f64::from(SQUARES)).truncate();
                assert_eq!(seen.object[i], u32::from(there), "{at}, cut: {cut}");
                let expected = if there { texel * 0.5 } else { Vec3::splat(0.5) };
                assert!(seen.colour[i].abs_diff_eq(expected, 1e-5), "{at}, cut: {cut}: {} {expected}", seen.colour[i]);
            }
            assert!(!seen.object.contains(&NOTHING));
        }
    }
}

/// In perspective a texture is not linear over the picture, but over the surface.
#[test]
fn a_texture_lies_on_the_surface_and_not_on_the_picture() {
    let ramp = Texture::linear(UVec2::new(2, 2), vec![Vec4::W, Vec4::ONE, Vec4::W, Vec4::ONE]).unwrap();
    let ramp = Arc::new(ramp.with_wrap([Wrap::Clamp; 2]));
    // Over the middle half of the texture red goes from 0 at its left to 1 at its right.
    let uvs = [Vec2::Y, Vec2::ONE, Vec2::ZERO, Vec2::X].map(|uv| uv * 0.5 + 0.25).to_vec();
    let board = sheet("board", Mesh { uvs, ..board() }).with_cover(Cover::textured(ramp));
    let mut scene = scene(board, &sun());
    scene.lights.clear();
    let eye = DVec3::new(-9.0, 6.0, 2.0);
    scene.camera = View::perspective(eye, DVec3::Y * 3.0, DVec3::Y, 1.0, 0.5, 90.0, UVec2::splat(64)).unwrap();
    let seen = picture(&scene, &[], &Frame::CENTRES);
    let on_board = || (0..seen.object.len()).filter(|i| seen.object[*i] == 1);
    assert!(on_board().count() > 400);
    for i in on_board() {
        let expected = 0.5 * (seen.position[i].x / 8.0 + 0.5);
        assert!((f64::from(seen.colour[i].x) - expected).abs() < 1e-4, "{} {expected}", seen.colour[i]);
    }
}

/// What has an alpha of 1 where more is needed is not there at all, solid or not.
#[test]
fn what_is_cut_away_altogether_is_as_if_it_were_not() {
    let ball = Object::solid("ball", Mesh::sphere(Vec3::Y * 4.0, 2.0, 32), Material::matt(Vec3::ONE));
    let gone = ball.with_cover(Cover { cutoff: Some(1.5), ..Cover::default() });
    let scene = scene(gone, &spot());
    for seen in [traced(&scene), mapped(&scene, "auto"), mapped(&scene, "woo92"), mapped(&scene, "wang-molnar94")] {
        assert!(!seen.object.contains(&1));
        assert!(seen.shadow[0].iter().all(|shadow| *shadow == 0.0));
    }
    assert_eq!(
        RayCast::everywhere(&Geometry::new(&scene, &spot()), DVec4::Y).at(&SurfacePoint::at(Vec3::ZERO, Vec3::Y)),
        0.0
    );
    // Nor is anything wrong with it.
    let wrong = |scene: &Scene| diagnose_recipe(scene, &scene.lights[0], &"woo92".parse().unwrap());
    let alone = Scene { objects: scene.objects[..1].to_vec(), ..scene.clone() };
    assert_eq!(wrong(&scene), wrong(&alone));
}

/// What blends lets light pass by its alpha at each place: the default is as rays, and other recipes see all of it that is not clear.
#[test]
fn light_passes_what_blends_by_its_alpha() {
    // Alpha rises from 0 at the left of the board to 1 at its right.
    let ramp = Texture::linear(UVec2::new(2, 1), vec![Vec4::new(1.0, 1.0, 1.0, 0.0), Vec4::ONE]).unwrap();
    let uvs = [Vec2::Y, Vec2::ONE, Vec2::ZERO, Vec2::X].map(|uv| uv * 0.5 + 0.25).to_vec();
    let board = sheet("board", Mesh { uvs, ..board() });
    let board = Object { passes: Vec3::new(0.25, 0.0, 0.5), ..board };
    let blended = board.with_cover(Cover::blended(Arc::new(ramp.with_wrap([Wrap::Clamp; 2]))));
    for view in [sun(), spot()] {
        let scene = scene(blended.clone(), &view);
        let geometry = Geometry::new(&scene, &scene.camera);
        let truth = RayCast::new(&geometry, &view);
        let made = light_shadow(&Recipe::default(), &[&scene], &view, Storage::Tiled).unwrap();
        let mut between = 0;
        for (x, z) in (0..400).map(|i| ((i % 20) as f32 * 0.7 - 6.65, (i / 20) as f32 * 0.7 - 6.65)) {
            let corners =
                [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(u, v)| DVec3::new(u, 0.0, v) * 0.01);
            let at = SurfacePoint::at(Vec3::new(x, 0.0, z), Vec3::Y);
            let at = SurfacePoint { object: 0, ..at.with_corners(corners.map(|corner| at.position + corner)) };
            let expected = truth.passes(&at);
            let (mut dark, mut found) = ([0.0], [Vec3::ONE]);
            made.shadow.fractions(&[at], Key::new(0, 0, 0), &mut dark);
            made.shadow.transmittances(&[at], Key::new(0, 0, 0), &dark, &mut found);
            // The board's own edge is blurred by a texel.
            let beside = [-0.1, 0.1].map(|by| truth.passes(&SurfacePoint::at(Vec3::new(x + by, 0.0, z + by), Vec3::Y)));
            if beside.iter().all(|light| (*light - expected).abs().max_element() < 0.05) {
                assert!((found[0] - expected).abs().max_element() < 0.03, "{x} {z}: {} {expected}", found[0]);
                between += u32::from(expected.y > 0.05 && expected.y < 0.95);
            }
        }
        assert!(between > 50, "{between}");
    }
}

/// Colours of corners are mixed over the surface, and multiply the texture.
#[test]
fn colours_of_corners_multiply_the_texture() {
    let colours = board().positions.iter().map(|at| Vec3::new(at.x / 8.0 + 0.5, 1.0, 0.25)).collect();
    let cover = Cover::textured(Arc::new(Texture::linear(UVec2::ONE, vec![Vec4::new(1.0, 0.5, 1.0, 1.0)]).unwrap()));
    let painted = sheet("board", Mesh { colours, ..board() });
    for (board, green) in [(painted.clone(), 0.5), (painted.with_cover(cover), 0.25)] {
        let mut scene = scene(board, &sun());
        scene.lights.clear();
        let seen = picture(&scene, &[], &Frame::CENTRES);
        let on_board: Vec<usize> = (0..seen.object.len()).filter(|i| seen.object[*i] == 1).collect();
        assert!(on_board.len() > 400);
        for i in on_board {
            let expected = Vec3::new((0.5 * (seen.position[i].x / 8.0 + 0.5)) as f32, green, 0.125);
            assert!((seen.colour[i] - expected).abs().max_element() < 1e-4, "{} {expected}", seen.colour[i]);
        }
    }
}
