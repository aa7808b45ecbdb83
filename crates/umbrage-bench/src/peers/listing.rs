//! The listing of Reeves 1987, Figure 4, tap after tap, as lean as plain code is: a slice of depths, and the cheapest generator.
//!
//! It is given what it needs, a position in the map and a depth, and so does without the way into the light's space. The
//! fractions are those of [`as_printed`](umbrage_shadow::as_printed) with the same random numbers, which is as faithful to the
//! print but asks any map; [`assert_as_printed`] holds it to that.

use umbrage_depth::{DepthMap, Raw};
use umbrage_plane::Receiver;
use umbrage_shadow::as_printed::{Listing, RandRange, TextureRect, sample_shadow};

/// Taps that are wanted of a region (`NumSamples`); one is the least along an axis (`MinSamples`).
const NUM_SAMPLES: u32 = 16;

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

/// Random numbers in 0..1 by one product and one sum each.
#[derive(Clone, Copy, Debug)]
struct Generator(u32);

impl Generator {
    fn new() -> Self {
        Self(1)
    }

    #[inline(always)]
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    #[inline(always)]
    fn signed(&mut self) -> f32 {
        self.unit() * 2.0 - 1.0
    }
}

/// With numbers from −1 to 1 the listing's biases go from 2 · Bias0 − Bias1 to Bias1.
fn biases([low, high]: [f32; 2]) -> [f32; 2] {
    [0.5 * (low + high), high]
}

/// Fractions in shadow of regions of `half` texels to each side, sixteen taps each, biases of a range in world units.
pub fn fractions(map: &Raw, places: &[Place], half: f32, bias: [f32; 2], out: &mut [f32]) {
    let (depths, side) = (map.depths(), map.view().size().x as i32);
    let [bias0, bias1] = biases(bias);
    let mut rand = Generator::new();
    for (place, out) in places.iter().zip(out) {
        *out = fraction(depths, side, place, [half / side as f32; 2], [bias0, bias1], &mut rand);
    }
}

/// `SampleShadow` for a square map that is stored as a whole.
fn fraction(
    depths: &[f32],
    side: i32,
    place: &Place,
    [sres, tres]: [f32; 2],
    [bias0, bias1]: [f32; 2],
    rand: &mut Generator,
) -> f32 {
    if place.z < 0.0 {
        return 0.0;
    }
    let mapres = side as f32;
    let (sres, tres) = (mapres * sres, mapres * tres);
    let (s, t) = (place.at[0] * mapres, place.at[1] * mapres);
    if s - sres >= mapres || s + sres < 0.0 || t - tres >= mapres || t + tres < 0.0 {
        return 0.0;
    }
    let n = NUM_SAMPLES as f32;
    let clamp = |count: f32| (count as u32).clamp(1, NUM_SAMPLES);
    let (ns, nt) = if sres * tres * 4.0 < n {
        (clamp(sres * 2.0 + 0.5), clamp(tres * 2.0 + 0.5))
    } else {
        let nt = clamp((tres * n / sres).sqrt() + 0.5);
        (clamp(n / nt as f32 + 0.5), nt)
    };
    let (ds, dt) = (2.0 * sres / ns as f32, 2.0 * tres / nt as f32);
    let (js, jt) = (ds * 0.5, dt * 0.5);
    let mut in_shadow = 0_u32;
    let mut at_s = s - sres + js;
    for _ in 0..ns {
        let mut at_t = t - tres + jt;
        for _ in 0..nt {
            let u = (at_s + rand.signed() * js) as i32;
            let v = (at_t + rand.signed() * jt) as i32;
            let bias = rand.signed() * (bias1 - bias0) + bias0;
            if u >= 0 && u < side && v >= 0 && v < side {
                in_shadow += u32::from(place.z > depths[(v * side + u) as usize] + bias);
            }
            at_t += dt;
        }
        at_s += ds;
    }
    in_shadow as f32 / (ns * nt) as f32
}

/// Checks fractions of [`fractions`] against the listing as it is printed, with the same random numbers.
///
/// # Panics
/// When one differs.
pub fn assert_as_printed(map: &Raw, places: &[Place], half: f32, bias: [f32; 2], found: &[f32]) {
    let side = map.view().size().x;
    let last = side as i32 - 1;
    let all = TextureRect { umin: 0, umax: last, vmin: 0, vmax: last };
    let [bias0, bias1] = biases(bias);
    let listing = Listing { res_factor: 1.0, bias0, bias1, rand: RandRange::Signed, ..Listing::default() };
    let mut rand = Generator::new();
    for (index, (place, found)) in places.iter().zip(found).enumerate() {
        let size = [half / side as f32; 2];
        let printed = sample_shadow(&listing, map, all, place.at, place.z, size, || rand.unit());
        assert_eq!(*found, printed, "the listing's fraction of region {index}");
    }
}
