//! Williams' four spheres: the scene, the filters of the figures, and the sphere that stands alone.

use super::masks::of;
use super::set::Set;
use crate::figure::Context;
use glam::DVec2;
use umbrage_plane::{Bias, View};
use umbrage_render::Picture;
use umbrage_render::post::{ShadowImage, shadow_image};
use umbrage_sample::Key;
use umbrage_scene::gallery;
use umbrage_shadow::williams::{Dither, Guard, Lookup};
use umbrage_shadow::{ShadowMap, Williams};

/// The paper's own settings: 512² in both views, 16-bit depth in both (W78-2).
pub const BITS: u32 = 16;

pub fn spheres(cx: &Context) -> Set {
    Set::new(gallery::four_spheres(), cx.pick(512, 256), cx.pick(512, 256))
}

/// Bias in texel widths, "px" in the figures; the light is at infinity, so it is one world distance everywhere. A departure from
/// C-11, which counts in depth steps τ·tanθ: half of one leaves no visible moiré (D-9), and a bias in the matrix does not depend on a slope.
pub fn reduced(pixels: f32) -> Williams {
    Williams::default().with_bias(Bias::Texels(pixels)).with_lookup(Lookup::Nearest).with_dither(Dither::OFF)
}

/// Interpolated except across silhouettes, and not dithered.
pub fn interpolated(pixels: f32) -> Williams {
    reduced(pixels).with_lookup(Lookup::Bilinear(Guard::default()))
}

pub fn dithered(pixels: f32) -> Williams {
    interpolated(pixels).with_dither(Dither::HALF_TEXEL)
}

/// As the paper has it: interpolated across silhouettes too, where empty texels count as the far plane (W78-14).
pub fn faithful(pixels: f32) -> Williams {
    dithered(pixels).with_lookup(Lookup::Bilinear(Guard::Faithful))
}

/// The shadow image of the post-process, in the paper's 16 bits.
pub fn post(cx: &Context, set: &Set, picture: &Picture, filter: Williams) -> ShadowImage {
    let light = ShadowMap { filter, map: set.quantised(BITS) };
    shadow_image(&picture.depth, &set.scene.camera, Some(BITS), &light, Key::new(cx.seed, 0, 0))
}

/// The sphere on which no other casts a shadow: lit exactly where it faces the light, and wholly in view.
pub struct Alone {
    pub id: u32,
    pub centre: DVec2,
    pub radius: f64,
}

pub fn alone(truth: &Picture, set: &Set) -> Option<Alone> {
    let count = set.scene.objects.len() as u32;
    let shadowed = |id: u32| {
        let facing = of(truth, |object| object == id);
        (0..facing.len()).filter(|&i| facing[i] && truth.facing[0][i] > 0.05 && truth.shadow[0][i] > 0.5).count()
    };
    let pixels = |id: u32| of(truth, |object| object == id).iter().filter(|on| **on).count();
    let most = (0..count).map(pixels).max()?;
    let id = (0..count).filter(|&id| pixels(id) * 100 >= most * 99).min_by_key(|&id| shadowed(id))?;
    let (centre, radius) = disc(&set.scene.camera, set, id);
    Some(Alone { id, centre, radius })
}

/// Centre and radius, in pixels, of a sphere's disc in an orthographic view.
pub fn disc(view: &View, set: &Set, id: u32) -> (DVec2, f64) {
    let mesh = set.scene.objects[id as usize].shape.mesh_for(view);
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for position in &mesh.positions {
        let at = view.eye_to_texel(view.world_to_eye().transform_point3(position.as_dvec3()));
        (low, high) = (low.min(at), high.max(at));
    }
    ((low + high) * 0.5, (high - low).max_element() * 0.5)
}
