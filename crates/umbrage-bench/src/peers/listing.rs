//! The listing of Reeves 1987, Figure 4, tap after tap, with a generator of three shifts.
//!
//! It is given what it asks for, a position in the map and a depth, and so does without the way into the light's space.

use umbrage_depth::DepthMap;
use umbrage_depth::Raw;
use umbrage_plane::Receiver;
use umbrage_shadow::as_printed::{Listing, RandRange, TextureRect, sample_shadow};

/// What the listing is given of a receiver.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Position in the map, 0..1 on both axes.
    pub at: [f32; 2],
    /// Depth.
    pub z: f32,
}

/// What the listing is given of receivers, for a map of `side`² texels.
pub fn places(receivers: &[Receiver], side: u32) -> Vec<Place> {
    let place =
        |receiver: &Receiver| Place { at: (receiver.texel / f64::from(side)).as_vec2().to_array(), z: receiver.depth };
    receivers.iter().map(place).collect()
}

/// Fractions in shadow of regions of `half` texels to each side, 16 taps each, biases of a range in world units.
pub fn fractions(map: &Raw, places: &[Place], half: f32, bias: [f32; 2], out: &mut [f32]) {
    let side = map.view().size().x;
    let last = side as i32 - 1;
    let all = TextureRect { umin: 0, umax: last, vmin: 0, vmax: last };
    // With signed numbers the listing's biases go from 2 · Bias0 − Bias1 to Bias1.
    let (bias0, bias1) = (0.5 * (bias[0] + bias[1]), bias[1]);
    let listing = Listing { res_factor: 1.0, bias0, bias1, rand: RandRange::Signed, ..Listing::default() };
    let size = [half / side as f32; 2];
    let mut state = 0x9E37_79B9_u32;
    let mut rand = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        (state >> 8) as f32 * (1.0 / 16_777_216.0)
    };
    for (place, out) in places.iter().zip(out) {
        *out = sample_shadow(&listing, map, all, place.at, place.z, size, &mut rand);
    }
}
