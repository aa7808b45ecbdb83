//! Williams' post-process: shadows put into a finished picture, and the stages that work on the shadow image
//! (Williams 1978). The order is fixed: [`shadow_image`] (transform, dither, look up, compare),
//! [`dequantise_edges`], [`low_pass`], [`darken`].

mod edges;

pub use edges::dequantise_edges;

use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_depth::{DepthMap, quantum};
use umbrage_plane::{Footprint, Kind, Place, Projection, Receiver, SurfacePoint, TexelRect, Verdict, View};
use umbrage_sample::Key;
use umbrage_shadow::williams::{observer_to_light, transform};
use umbrage_shadow::{Shadow, ShadowMap, Williams};

/// The binary shadow of every visible pixel, tested after the picture was made.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadowImage {
    /// Pixels across and down.
    pub size: UVec2,
    /// 1 in shadow, 0 lit, 0 where nothing is seen.
    pub shadow: Vec<f32>,
    /// Points put through the matrix: the pixels with a surface, whatever the scene's complexity (Williams 1978).
    pub transforms: u64,
}

/// Transforms each visible pixel of a finished picture into the light's view by one matrix and tests it there (Williams 1978).
///
/// `zeta` is the picture's depth along the observer's axis, +∞ where nothing is seen: such pixels are skipped.
/// `z_bits` (8 to 24, others as the nearest of these) rounds it to an integer depth first, which is the extra quantisation of this mode. Each pixel is taken to
/// be at its centre, wherever its surface point was: a renderer that snaps points to pixels adds its error here.
pub fn shadow_image<M: DepthMap>(
    zeta: &[f32],
    observer: &View,
    z_bits: Option<u32>,
    light: &ShadowMap<Williams, M>,
    key: Key,
) -> ShadowImage {
    let size = observer.size();
    let matrix = observer_to_light(observer, light.map.view());
    let observer_screen = observer.with_kind(Kind::Screen);
    let mut transforms = 0;
    let mut one = |pixel: UVec2, zeta: f32| {
        if !zeta.is_finite() {
            return 0.0;
        }
        transforms += 1;
        let z = f64::from(observer_screen.depth(DVec3::new(0.0, 0.0, -f64::from(zeta))));
        let z = z_bits.map_or(z, |bits| f64::from(quantum(z, bits)) / f64::from(quantum(1.0, bits)));
        let centre = (pixel.as_dvec2() + 0.5) / size.as_dvec2();
        let screen = DVec3::new(centre.x * 2.0 - 1.0, 1.0 - centre.y * 2.0, z);
        let region = pixel.y * size.x + pixel.x;
        match transform(&matrix, screen) {
            Some(at) => test(light, at, key.region(region)),
            None => f32::from(u8::from(light.map.view().rules().verdict(Place::Behind) == Verdict::Shadowed)),
        }
    };
    let shadow =
        TexelRect::of_size(size).texels().zip(zeta).map(|(pixel, &zeta)| one(pixel.as_uvec2(), zeta)).collect();
    ShadowImage { size, shadow, transforms }
}

/// Stands in for the slope that a finished picture does not know: steep, 83°, so that [`Guard::Steps`](umbrage_shadow::williams::Guard) still
/// interpolates where surfaces turn away from the light, which is where interpolation is needed. A bias in depth steps counts in it, too.
const UNKNOWN_SLOPE: f32 = 8.0;

/// Tests a point of the light's screen.
fn test<M: DepthMap>(light: &ShadowMap<Williams, M>, screen: DVec3, key: Key) -> f32 {
    let view = light.map.view();
    let (n, f) = (view.near(), view.far());
    let zeta = match view.projection() {
        Projection::Perspective { .. } => f * n / (f - screen.z * (f - n)),
        Projection::Orthographic { .. } => n + screen.z * (f - n),
    };
    let texel = view.screen_to_texel(DVec2::new(screen.x, screen.y));
    let key_depth = view.key(zeta);
    let world = view.world_at(texel, key_depth);
    let seen = SurfacePoint::at(world, view.toward_eye(world).as_vec3());
    match view.receiver(&seen) {
        Ok(receiver) => {
            let depth = if view.kind() == Kind::Screen { screen.z as f32 } else { receiver.depth };
            let footprint = Footprint::point(texel.as_vec2());
            let receiver = Receiver { footprint, texel, depth, slope: UNKNOWN_SLOPE, ..receiver };
            light.fraction_of(&receiver, key)
        }
        Err(_) => light.fraction(&seen, key),
    }
}

/// Separable binomial low-pass \[1 2 1\]/4, repeated; works on a shadow image, never on depth (Williams 1978). Edges repeat outward.
pub fn low_pass(size: UVec2, image: &[f32], repeats: u32) -> Vec<f32> {
    let (width, height) = (size.x as usize, size.y as usize);
    let mut image = image.to_vec();
    for _ in 0..repeats {
        let across: Vec<f32> = (0..width * height)
            .map(|i| {
                let (x, row) = (i % width, i - i % width);
                let (left, right) = (row + x.saturating_sub(1), row + (x + 1).min(width - 1));
                (image[left] + 2.0 * image[i] + image[right]) * 0.25
            })
            .collect();
        image = (0..width * height)
            .map(|i| {
                let (x, y) = (i % width, i / width);
                let (up, down) = (y.saturating_sub(1) * width + x, (y + 1).min(height - 1) * width + x);
                (across[up] + 2.0 * across[i] + across[down]) * 0.25
            })
            .collect();
    }
    image
}

/// Applies a shadow image to a finished picture: colour · (1 − density · shadow) (Williams 1978).
///
/// Highlights are dimmed, not removed: the known flaw of this mode. `density` is 1 less the ambient fraction; 1 gives black shadows.
pub fn darken(colour: &[Vec3], shadow: &[f32], density: f32) -> Vec<Vec3> {
    colour.iter().zip(shadow).map(|(colour, shadow)| *colour * (1.0 - density * shadow)).collect()
}
