//! The law of ranges: what a storage's ranges and a compared depth's bounds settle is what taps would have said.

use super::places::lamp;
use super::subject::{Found, KEY, same};
use glam::{Vec2, Vec3};
use umbrage_depth::{DepthMap, Raw};
use umbrage_plane::{Footprint, Receiver, Rules, SurfacePoint};
use umbrage_sample::EveryTexel;
use umbrage_shadow::{Pcf, ReceiverDepth, ShadowMap};

/// Holds a storage, made by `kept`, and a compared depth against each other: depths a few units in the last place apart, each compared with
/// its neighbours, under filters that may and may not cull.
///
/// # Errors
/// The first receiver whose answer culling changes.
///
/// # Panics
/// Never: the map and the view that it makes are valid.
pub fn culling<M: DepthMap>(kept: impl Fn(&Raw) -> M, depth: &(impl ReceiverDepth + Copy)) -> Found {
    let view = lamp(Rules::OPEN);
    let by_ulps = |ulps: u32| (0..ulps).fold(10f32.next_down().next_down(), |depth, _| depth.next_up());
    for spread in [1, 2, 5] {
        let stored = |i: u32| by_ulps(KEY.bits(i, spread) % spread);
        let map = Raw::new(view, (0..64 * 64).map(stored).collect()).expect("a map");
        let map = kept(&map);
        let filter = |cull| {
            Pcf::default()
                .with_pattern(EveryTexel)
                .with_depth(*depth)
                .with_res_factor(1.0)
                .with_min_size(0.0)
                .with_cull(cull)
        };
        let ask =
            |cull, receiver: &Receiver, key| ShadowMap { filter: filter(cull), map: &map }.fraction_of(receiver, key);
        for i in 0..400 {
            let centre = Vec2::new(KEY.unit(i, 5), KEY.unit(i, 6)) * 48.0 + 8.0;
            let world = view.world_at(centre.as_dvec2(), view.key(10.0)).as_vec3();
            let Ok(seen) = view.receiver(&SurfacePoint::at(world, Vec3::Y)) else { continue };
            let footprint = Footprint::boxed(centre, Vec2::splat(KEY.unit(i, 7) * 4.0));
            let near = by_ulps(KEY.bits(i, 4) % 9).next_down().next_down();
            let receiver = Receiver { footprint, depth: near, eye: seen.eye * f64::from(near) / -seen.eye.z, ..seen };
            let key = KEY.region(i);
            same("receiver", i as usize, &[ask(true, &receiver, key), ask(false, &receiver, key)])?;
        }
    }
    Ok(())
}
