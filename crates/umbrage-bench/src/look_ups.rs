//! Every filter over every storage: a million regions of three texels to each side, sixteen taps where the filter takes taps.
//!
//! Each is there twice: from points of the world, as a renderer asks, and from receivers that are in the light's space already. The
//! answers are the same bits.

use crate::raster::{facets, first, midpoint, refined, second};
use crate::scene::{HALF, Scene, bias};
use fearless_simd::{f32x16, prelude::*};
use glam::Vec2;
use std::fmt;
use std::sync::Arc;
use umbrage_bake::{Deep, bake_deep};
use umbrage_depth::{DepthMap, Raw};
use umbrage_plane::{Bias, Receiver, SurfacePoint, TexelRect, View, vectorized};
use umbrage_sample::{Jittered, Key, Table};
use umbrage_shadow::{
    BiasCone, Biased, Conditional, DualPlane, Filter, OnPlane, Pcf, Query, Shadow, ShadowMap, Simd, Soft,
};

/// The key of all look-ups.
pub const KEY: Key = Key::new(1, 0, 0);

/// A filter over a map.
pub struct LookUp {
    /// The filter's name.
    pub filter: &'static str,
    /// The storage's name.
    pub storage: &'static str,
    /// What the map holds, bytes.
    pub allocated: usize,
    shadow: Box<dyn Ready>,
}

impl fmt::Debug for LookUp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LookUp").field("filter", &self.filter).field("storage", &self.storage).finish_non_exhaustive()
    }
}

/// What answers from both spaces.
trait Ready: Shadow {
    fn ready(&self, receivers: &[Receiver], out: &mut [f32]);
}

impl<F: Filter, M: DepthMap> Ready for ShadowMap<F, M> {
    fn ready(&self, receivers: &[Receiver], out: &mut [f32]) {
        ready(self, receivers, out);
    }
}

/// Fractions of receivers that are in the light's space already; receiver i is region i.
pub fn ready<F: Filter, M: DepthMap>(shadow: &ShadowMap<F, M>, receivers: &[Receiver], out: &mut [f32]) {
    vectorized!(simd => ready_with(simd, shadow, receivers, out));
}

#[inline(always)]
fn ready_with<S: Simd, F: Filter, M: DepthMap>(
    simd: S,
    shadow: &ShadowMap<F, M>,
    receivers: &[Receiver],
    out: &mut [f32],
) {
    for (region, (receiver, out)) in receivers.iter().zip(out).enumerate() {
        *out = Query::new(simd, &shadow.map, receiver, KEY.region(region as u32), &mut ()).ask(&shadow.filter);
    }
}

impl LookUp {
    fn new<F: Filter + 'static, M: DepthMap + 'static>(
        filter: &'static str,
        storage: &'static str,
        how: F,
        map: M,
    ) -> Self {
        let allocated = map.allocated();
        Self { filter, storage, allocated, shadow: Box::new(ShadowMap { filter: how, map }) }
    }

    /// From points of the world.
    pub fn of_points(&self, points: &[SurfacePoint], out: &mut [f32]) {
        self.shadow.fractions(points, KEY, out);
    }

    /// From receivers.
    pub fn of_receivers(&self, receivers: &[Receiver], out: &mut [f32]) {
        self.shadow.ready(receivers, out);
    }
}

/// Percentage closer with biases of a range: what stands beside the listing.
pub fn closer(view: &View) -> Pcf {
    let [low, high] = bias(view);
    with_depth(Biased::world(low, high))
}

/// Percentage closer on the receiver's tangent plane.
pub fn on_plane(view: &View) -> Pcf<Jittered, OnPlane> {
    with_depth(OnPlane::biased(Bias::World(0.25 * bias(view)[0])))
}

fn with_depth<D: umbrage_shadow::ReceiverDepth>(depth: D) -> Pcf<Jittered, D> {
    Pcf::default().with_res_factor(0.0).with_min_size(HALF).with_depth(depth)
}

/// Every filter over maps of the scene.
pub fn all(scene: &Scene, view: &View) -> Vec<LookUp> {
    let mesh = &scene.mesh;
    let nearest = first(view, mesh).map;
    let (middle, beyond) = (midpoint(view, mesh).map, second(view, mesh).map);
    let deep = bake_deep(view, [mesh.indexed()], &Deep::default().with_axis(1)).map;
    let refined = refined(view, mesh).map;
    let mut all = Vec::new();
    /// A filter over a tiled map and over a raw copy of it.
    macro_rules! both {
        ($name:literal, $filter:expr, $map:expr) => {
            let raw = Arc::new(Raw::copy_of($map));
            all.push(LookUp::new($name, "raw", $filter, raw));
            all.push(LookUp::new($name, "tiled", $filter, Arc::clone($map)));
        };
    }
    both!("pcf-bias", closer(view), &nearest);
    // Behind the tiled map, which it is held to.
    all.push(LookUp::new("pcf-bias", "facets", closer(view), facets(view, mesh).map));
    both!("pcf-table", closer(view).with_pattern(Table::default()), &nearest);
    both!("pcf-plane", on_plane(view), &nearest);
    both!("pcf-cone", with_depth(BiasCone::default()), &nearest);
    both!("woo92", with_depth(Biased::constant(Bias::ZERO)), &middle);
    // Four by four texels are sixteen.
    both!("wang-molnar94", Conditional::default().with_min_size(2.0), &beyond);
    both!("burley", Soft::default(), &nearest);
    all.push(LookUp::new("auto", "facets", DualPlane::default(), refined));
    all.push(LookUp::new("pcf-bias", "deep", closer(view), deep));
    all
}

/// Sums of sixteen depths of each receiver's region, and nothing else of a look-up: what storages cost.
pub fn depths(map: &impl DepthMap, receivers: &[Receiver], out: &mut [f32]) {
    vectorized!(simd => depths_with(simd, map, receivers, out));
}

#[inline(always)]
fn depths_with<S: Simd, M: DepthMap>(simd: S, map: &M, receivers: &[Receiver], out: &mut [f32]) {
    // The middles of four by four equal parts.
    let place = |part: usize| HALF * (part as f32 - 1.5) * 0.5;
    let x = f32x16::load_array(simd, std::array::from_fn(|tap| place(tap % 4)));
    let y = f32x16::load_array(simd, std::array::from_fn(|tap| place(tap / 4)));
    for (receiver, out) in receivers.iter().zip(out) {
        let centre = receiver.texel.as_vec2();
        let within = TexelRect::around(centre, Vec2::splat(HALF));
        let depths = map.look(simd, within, x + f32x16::splat(simd, centre.x), y + f32x16::splat(simd, centre.y));
        let depths: [f32; 16] = depths.into();
        *out = depths.iter().sum();
    }
}

/// Mean of fractions.
pub fn mean(fractions: &[f32]) -> f64 {
    fractions.iter().copied().map(f64::from).sum::<f64>() / fractions.len() as f64
}
