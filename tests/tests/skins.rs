//! Cut-outs: a board that a texture cuts into a checkerboard has the shadow of one that was sawn, in every kind of map and for rays, and the
//! camera sees through it.

use glam::{DVec2, DVec3, DVec4, UVec2, Vec2, Vec3, Vec4};
use std::sync::Arc;
use umbrage_depth::Storage;
use umbrage_oracle::{Geometry, RayCast, diagnose_recipe};
use umbrage_plane::{SurfacePoint, View};
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, NOTHING, Picture, light_shadow, picture, receivers};
use umbrage_sample::Key;
use umbrage_scene::{Interpolation, Light, Material, Mesh, Object, Scene, Shape, Skin, Texture};
use umbrage_shadow::{Shadow, Unshadowed};

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
    sheet("board", board()).with_skin(Skin::cut_out(Arc::new(checks()), 0.5))
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
fn scene(board: Object, view: View) -> Scene {
    let eye = DVec3::new(2.0, 15.0, 9.0);
    Scene {
        name: "cut-out".into(),
        origin: DVec3::ZERO,
        objects: vec![sheet("floor", square(Vec2::splat(-12.0), Vec2::splat(12.0), 0.0)), board],
        lights: vec![Light { view, ..Light::point("lamp", eye, DVec3::ZERO, 60.0, 1.0, 90.0, UVec2::ONE).unwrap() }],
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
        let (cut, sawn) = (traced(&scene(masked(), view)), traced(&scene(sawn(), view)));
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
        let (cut, sawn) = (scene(masked(), view), scene(sawn(), view));
        let truth = traced(&cut);
        for (text, most) in [
            ("auto", 0.02),
            ("reeves87,bias=0.1,res-factor=1,samples=64", 0.03),
            ("woo92,res-factor=1,samples=64", 0.03),
            ("reeves87,stored=second,bias=0.1,res-factor=1,samples=64", 0.03),
            ("reeves87,stored=deep,bias=0.1,res-factor=1,samples=64", 0.03),
        ] {
            let found = mapped(&cut, text);
            let ((all, inner), (by_hand, _)) = (rms(&found, &truth), rms(&mapped(&sawn, text), &truth));
            println!("{text}: {all:.4} in all, {inner:.5} away from edges; sawn {by_hand:.4}");
        }
    }
}
