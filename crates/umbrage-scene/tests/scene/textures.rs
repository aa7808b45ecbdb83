//! Textures, and what they make of surfaces, against values worked out by hand.

use glam::{DVec2, UVec2, Vec2, Vec3, Vec4};
use proptest::prelude::*;
use std::sync::Arc;
use umbrage_scene::{
    Cover, Interpolation, Material, Mesh, MeshError, Object, Shape, Texture, TextureError, Wrap, gallery,
};

/// Three texels across and two down: red counts columns, green rows; alpha is 1 but in the last texel.
fn counted() -> Texture {
    let texel = |i: u8| Vec4::new(f32::from(i % 3), f32::from(i / 3), 0.0, if i == 5 { 0.0 } else { 1.0 });
    Texture::linear(UVec2::new(3, 2), (0..6).map(texel).collect()).unwrap()
}

/// The column and the row of the texel at a place.
fn nearest(wrap: [Wrap; 2], u: f64, v: f64) -> [f32; 2] {
    let texture = counted().with_interpolation(Interpolation::Nearest).with_wrap(wrap);
    texture.sample(DVec2::new(u, v)).truncate().truncate().to_array()
}

#[test]
fn the_upper_left_corner_is_the_first_texel() {
    let wrap = [Wrap::Clamp; 2];
    assert_eq!(counted().size(), UVec2::new(3, 2));
    assert_eq!(nearest(wrap, 0.01, 0.01), [0.0, 0.0]);
    assert_eq!(nearest(wrap, 0.99, 0.01), [2.0, 0.0]);
    assert_eq!(nearest(wrap, 0.01, 0.99), [0.0, 1.0]);
    assert_eq!(nearest(wrap, 0.5, 0.5), [1.0, 1.0], "borders belong to what is right of and below them");
    assert_eq!(nearest(wrap, 1.0, 1.0), [2.0, 1.0]);
}

#[test]
fn each_axis_wraps_by_its_own_rule() {
    // Middles of columns, from two images to the left of the first to one right of it.
    let columns = |wrap: Wrap| -> Vec<f32> {
        (-6..6).map(|i| nearest([wrap, Wrap::Clamp], (f64::from(i) + 0.5) / 3.0, 0.1)[0]).collect()
    };
    assert_eq!(columns(Wrap::Repeat), [0., 1., 2., 0., 1., 2., 0., 1., 2., 0., 1., 2.]);
    assert_eq!(columns(Wrap::Mirror), [0., 1., 2., 2., 1., 0., 0., 1., 2., 2., 1., 0.]);
    assert_eq!(columns(Wrap::Clamp), [0., 0., 0., 0., 0., 0., 0., 1., 2., 2., 2., 2.]);
    let rows = |wrap: Wrap| [-0.75, -0.25, 0.25, 0.75, 1.25, 1.75].map(|v| nearest([Wrap::Clamp, wrap], 0.5, v)[1]);
    assert_eq!(rows(Wrap::Repeat), [0., 1., 0., 1., 0., 1.]);
    assert_eq!(rows(Wrap::Mirror), [1., 0., 0., 1., 1., 0.]);
    assert_eq!(rows(Wrap::Clamp), [0., 0., 0., 1., 1., 1.]);
}

#[test]
fn between_texels_they_are_mixed_by_nearness() {
    let at = |wrap: Wrap, u: f64, v: f64| counted().with_wrap([wrap; 2]).sample(DVec2::new(u, v));
    // The middle of a texel is the texel.
    assert_eq!(at(Wrap::Repeat, 0.5, 0.25), Vec4::new(1.0, 0.0, 0.0, 1.0));
    // A quarter of the way from column 1 to 2, half of the way from row 0 to 1.
    let mixed = at(Wrap::Repeat, (1.5 + 0.25) / 3.0, 0.5);
    assert!(mixed.abs_diff_eq(Vec4::new(1.25, 0.5, 0.0, 0.875), 1e-6), "{mixed}");
    // The left border lies between column 2 and column 0 where it repeats, else within column 0.
    assert!((at(Wrap::Repeat, 0.0, 0.25).x - 1.0).abs() < 1e-6);
    assert_eq!([Wrap::Mirror, Wrap::Clamp].map(|wrap| at(wrap, 0.0, 0.25).x), [0.0; 2]);
    assert_eq!(at(Wrap::Clamp, 9.0, 9.0), Vec4::new(2.0, 1.0, 0.0, 0.0));
}

#[test]
fn places_that_are_no_places_see_a_texel_too() {
    for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
        let texture = counted().with_wrap([wrap; 2]);
        for uv in [DVec2::NAN, DVec2::INFINITY, DVec2::new(f64::NEG_INFINITY, 0.5)] {
            assert_eq!(texture.sample(uv), texture.sample(DVec2::ZERO));
        }
        for far in [f64::MAX, f64::MIN, 1e18, -1e18] {
            assert!(texture.sample(DVec2::splat(far)).is_finite(), "{wrap:?} {far}");
        }
    }
}

#[test]
fn colours_of_8_bits_are_srgb_and_alpha_is_not() {
    let one = |texel: [u8; 4]| Texture::srgb(UVec2::ONE, vec![texel]).unwrap().sample(DVec2::splat(0.3));
    assert_eq!(one([0, 255, 0, 255]), Vec4::new(0.0, 1.0, 0.0, 1.0));
    // 10/255 lies on the straight piece of the curve, 188/255 is half of the light.
    let grey = one([188, 10, 128, 128]);
    assert!(grey.abs_diff_eq(Vec4::new(0.502_886, 0.003_035, 0.215_861, 128.0 / 255.0), 1e-5), "{grey}");
}

#[test]
fn what_is_no_image_is_refused() {
    let size = UVec2::new(2, 3);
    assert_eq!(Texture::srgb(UVec2::new(0, 3), vec![]), Err(TextureError::Empty(0, 3)));
    assert_eq!(Texture::srgb(size, vec![[0; 4]; 5]), Err(TextureError::Length { size: [2, 3], texels: 5 }));
    let few = Texture::srgb(UVec2::MAX, vec![[0; 4]]).unwrap_err();
    assert_eq!(few.to_string(), "a texture of 4294967295 x 4294967295 texels has 1 of them");
    let mut texels = vec![Vec4::ONE; 6];
    texels[4].w = f32::NAN;
    assert_eq!(Texture::linear(size, texels), Err(TextureError::NotFinite { texel: 4 }));
}

#[test]
fn a_cover_has_holes_where_alpha_is_below_its_cutoff() {
    let half = Texture::linear(UVec2::new(2, 1), vec![Vec4::splat(0.5), Vec4::ZERO]).unwrap();
    let half = Arc::new(half.with_interpolation(Interpolation::Nearest));
    let [left, right] = [DVec2::new(0.25, 0.5), DVec2::new(0.75, 0.5)];
    let there = |cutoff: f32| [left, right].map(|uv| Cover::cut_out(Arc::clone(&half), cutoff).is_there(uv));
    assert_eq!(there(0.5), [true, false], "equal is there");
    assert_eq!(there(0.500_001), [false, false]);
    assert_eq!(there(0.0), [true, true]);
    // An alpha factor f is divided out: there where alpha × f ≥ cutoff, for f = 0 too.
    assert_eq!(there(0.5 / 0.0), [false, false]);
    assert_eq!(there(f32::NAN), [true, true]);
    let whole = Cover::textured(Arc::clone(&half));
    assert!(!whole.has_holes() && whole.is_there(right));
    assert_eq!(whole.colour(left), Vec3::splat(0.5));
    let bare = Cover { cutoff: Some(0.5), ..Cover::default() };
    assert!(bare.has_holes() && bare.is_there(left) && bare.colour(left) == Vec3::ONE);
    assert!(!Cover { cutoff: Some(2.0), ..Cover::default() }.is_there(left));
}

#[test]
fn a_solid_with_holes_is_none() {
    let cube = Object::solid("cube", Mesh::cuboid(Vec3::ZERO, Vec3::ONE), Material::matt(Vec3::ONE));
    let cover = |cutoff| Cover { cutoff, ..Cover::textured(Arc::new(counted())) };
    assert!(cube.is_solid() && cube.clone().with_cover(cover(None)).is_solid());
    assert!(!cube.with_cover(cover(Some(0.5))).is_solid());
    assert!(gallery::sphere_plane().objects.iter().all(|object| object.cover == Cover::default()));
    assert!(!Object::two_sided("none", Shape::Patches(vec![]), Material::matt(Vec3::ONE)).is_solid());
}

#[test]
fn places_in_the_texture_are_one_a_position_or_none() {
    let mut mesh = Mesh::cuboid(Vec3::ZERO, Vec3::ONE);
    assert_eq!((mesh.check(), mesh.corner_uvs(3)), (Ok(()), [Vec2::ZERO; 3]));
    mesh.uvs = vec![Vec2::ONE; 23];
    assert_eq!(mesh.check(), Err(MeshError::Uvs { positions: 24, uvs: 23 }));
    mesh.uvs.push(Vec2::new(0.0, f32::NAN));
    assert_eq!(mesh.check(), Err(MeshError::NotFinite { vertex: 23 }));
    mesh.uvs[23] = Vec2::X;
    assert_eq!((mesh.check(), mesh.corner_uvs(11)), (Ok(()), [Vec2::ONE, Vec2::ONE, Vec2::X]));
}

#[test]
fn appended_meshes_keep_their_places_in_the_texture() {
    let sheet = Mesh::sheet([Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y], 1);
    let placed = Mesh { uvs: (0..4).map(|i| Vec2::new(i as f32, 1.0)).collect(), ..sheet.clone() };
    let joined = |first: &Mesh, second: &Mesh| {
        let mut all = first.clone();
        all.append(second);
        assert_eq!(all.check(), Ok(()));
        all
    };
    assert!(joined(&sheet, &sheet).uvs.is_empty());
    for (first, second) in [(&placed, &placed), (&placed, &sheet), (&sheet, &placed)] {
        let all = joined(first, second);
        for triangle in 0..2 {
            assert_eq!(all.corner_uvs(triangle), first.corner_uvs(triangle));
            assert_eq!(all.corner_uvs(triangle + 2), second.corner_uvs(triangle));
        }
    }
}

proptest! {
    /// An alpha test of exactly the alpha that all texels have: no rounding between them may cut anything.
    #[test]
    fn a_mean_of_equal_texels_is_what_they_are(alpha in 0.0f32..1.0, u in -9.0f64..9.0, v in -9.0f64..9.0) {
        let texture = Texture::linear(UVec2::new(3, 5), vec![Vec4::splat(alpha); 15]).unwrap();
        prop_assert_eq!(texture.sample(DVec2::new(u, v)), Vec4::splat(alpha));
    }
}

#[test]
fn alpha_that_blends_lets_light_pass() {
    let texels = vec![Vec4::ONE, Vec4::new(1.0, 1.0, 1.0, 0.25), Vec4::new(1.0, 1.0, 1.0, -3.0)];
    let texture = Texture::linear(UVec2::new(3, 1), texels).unwrap().with_interpolation(Interpolation::Nearest);
    assert_eq!(texture.least_alpha(), -3.0);
    assert_eq!(Texture::srgb(UVec2::new(2, 1), vec![[9, 9, 9, 255], [9, 9, 9, 51]]).unwrap().least_alpha(), 0.2);
    let cover = Cover::blended(Arc::new(texture));
    let red = Vec3::new(0.5, 0.0, 0.0);
    let passes = |cover: &Cover| [0.1, 0.5, 0.9].map(|u| cover.passes(red, DVec2::new(u, 0.5)));
    assert_eq!(passes(&cover), [red, Vec3::new(0.875, 0.75, 0.75), Vec3::ONE]);
    assert_eq!(passes(&Cover { blends: false, ..cover.clone() }), [red; 3]);
    assert_eq!(passes(&Cover { texture: None, ..cover.clone() }), [red; 3]);
    assert!(!cover.has_holes());
    let cube = Object::solid("cube", Mesh::cuboid(Vec3::ZERO, Vec3::ONE), Material::matt(Vec3::ONE));
    assert!(!cube.with_cover(cover).is_solid(), "it may be clear at places");
}

#[test]
fn colours_are_one_a_position_or_none() {
    let sheet = Mesh::sheet([Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y], 1);
    assert_eq!(sheet.corner_colours(0), [Vec3::ONE; 3]);
    let mut painted = Mesh { colours: vec![Vec3::X; 3], ..sheet.clone() };
    assert_eq!(painted.check(), Err(MeshError::Colours { positions: 4, colours: 3 }));
    painted.colours.push(Vec3::splat(f32::INFINITY));
    assert_eq!(painted.check(), Err(MeshError::NotFinite { vertex: 3 }));
    painted.colours[3] = Vec3::Y;
    assert_eq!(painted.check(), Ok(()));
    for (first, second) in [(&painted, &painted), (&painted, &sheet), (&sheet, &painted)] {
        let mut all = first.clone();
        all.append(second);
        assert_eq!(all.check(), Ok(()));
        let each = [first, second].map(|mesh| (0..2).map(|triangle| mesh.corner_colours(triangle)).collect::<Vec<_>>());
        assert_eq!((0..4).map(|triangle| all.corner_colours(triangle)).collect::<Vec<_>>(), each.concat());
    }
}
