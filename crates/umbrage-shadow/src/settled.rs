//! What a tap's place or a deep map settles, so that depths need not be compared.

use crate::surfaces::Channel;
use fearless_simd::Simd;
use glam::Vec2;
use umbrage_depth::Translucent;
use umbrage_plane::{Verdict, View};
use umbrage_sample::Taps;

/// What a deep map lets through at taps.
pub(crate) struct Passing<'a> {
    pub deep: &'a dyn Translucent,
    pub channel: Channel,
    pub view: &'a View,
    /// Whether all taps lie inside the map and the cone.
    pub inside: bool,
    pub weighted: bool,
}

impl Passing<'_> {
    /// Adds what does not pass at each tap, and the taps' weights. Apart from the loop around it, because that is compiled many times.
    #[inline(never)]
    pub fn add<S: Simd>(&self, simd: S, taps: &Taps<S>, compared: &[f32; 16], (hits, count): (&mut f32, &mut f32)) {
        simd.vectorize(
            #[inline(always)]
            || {
                for (i, compared) in compared.iter().enumerate() {
                    if taps.mask >> i & 1 == 1 {
                        let weight = if self.weighted { taps.weight[i] } else { 1.0 };
                        *count += weight;
                        *hits += weight * self.dark(taps.tap(i).at, *compared);
                    }
                }
            },
        );
    }

    /// What does not pass at one tap.
    #[inline(always)]
    pub fn dark(&self, at: Vec2, compared: f32) -> f32 {
        let passes = || self.deep.transmittance(at.floor().as_ivec2(), compared);
        let ruled = ruled(self.view, self.inside, at);
        ruled.unwrap_or_else(|| 1.0 - self.channel.of(passes(), self.deep.is_grey()))
    }
}

/// The hits of a batch of taps with those outside the map or the cone settled by the view's rules (Woo 1992). Few regions reach
/// out, so that this stands apart from the loop around it, which is compiled many times.
#[inline(never)]
pub(crate) fn by_rules<S: Simd>(view: &View, taps: &Taps<S>, mut nearer: u32) -> u32 {
    for i in (0..16).filter(|i| taps.mask >> i & 1 == 1) {
        match by_rule(view, taps.tap(i).at) {
            Some(dark) if dark > 0.0 => nearer |= 1 << i,
            Some(_) => nearer &= !(1 << i),
            None => {}
        }
    }
    nearer
}

/// The result of one tap whose place settles it, where not all taps are known to lie inside the map and the cone.
pub(crate) fn ruled(view: &View, inside: bool, texel: Vec2) -> Option<f32> {
    if inside { None } else { by_rule(view, texel) }
}

/// The result of one tap whose place settles it.
#[inline(always)]
pub(crate) fn by_rule(view: &View, texel: Vec2) -> Option<f32> {
    answer(view.rules().verdict(view.locate(texel)))
}

/// The fraction in shadow that a verdict stands for; `None` where the map must be looked up.
#[inline(always)]
pub(crate) fn answer(verdict: Verdict) -> Option<f32> {
    match verdict {
        Verdict::Lit => Some(0.0),
        Verdict::Shadowed => Some(1.0),
        Verdict::Compare => None,
    }
}
