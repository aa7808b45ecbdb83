//! SIMD kernels against their scalar twins, bit for bit.

use std::sync::Arc;
use umbrage_depth::{Bbox, DepthMap, Map, Raw, Tiled};
use umbrage_plane::{Bias, Kind, Receiver, Sampling, Verdict, View, vectorized};
use umbrage_sample::{
    AnyPattern, AreaTent, Castano, Centre, Disc, EveryTexel, Gaussian, InsideQuadReject, InsideQuadWarp, Jittered, Key,
    Pattern, Spiral, Table, Tent, Uniform, Vogel, each_tap,
};
use umbrage_shadow::{
    AnyDepth, BiasCone, Biased, Filter, NormalOffset, OffsetGrowth, OnPlane, Pcf, Radius, ReceiverDepth, ShadowMap,
    SlopeScaled,
};
use umbrage_tests::laws::{KEY, baked, receivers};

fn ask<F: Filter>(filter: &F, map: &Map, receiver: &Receiver, key: Key) -> f32 {
    ShadowMap { filter, map }.fraction_of(receiver, key)
}

/// Percentage-closer filtering one tap at a time, without ranges, tiles or lanes.
fn naive<P: Pattern>(filter: &Pcf<P, Biased>, map: &Raw, receiver: &Receiver, key: Key) -> f32 {
    let view: &View = map.view();
    let region = receiver.footprint.scaled(
        receiver.texel.as_vec2(),
        filter.res_factor,
        filter.min_size,
        view.size().as_vec2() * 0.25,
    );
    let (low, high) = (receiver.nearer(view, filter.depth.low), receiver.nearer(view, filter.depth.high));
    let (mut hits, mut count) = (0.0f32, 0.0f32);
    each_tap(&filter.pattern, &region, key, |tap| {
        let compared = if low == high { low } else { tap.u * (high - low) + low };
        let dark = match view.rules().verdict(view.locate(tap.at)) {
            Verdict::Lit => false,
            Verdict::Shadowed => true,
            Verdict::Compare => compared > map.depth(tap.at.floor().as_ivec2()),
        };
        count += tap.weight;
        hits += if dark { tap.weight } else { 0.0 };
    });
    hits / count
}

/// A pattern as itself in the twin; in the filter as it is, or as one of any.
fn twin<P: Pattern + Copy>(pattern: P, filtered: impl Pattern + Copy, maps: &[Arc<Tiled>]) {
    for map in maps {
        let raw = Raw::copy_of(map);
        let pcf = Pcf::default().with_res_factor(1.5);
        let (filter, plain) = (pcf.with_pattern(filtered), pcf.with_pattern(pattern));
        for (i, receiver) in receivers(map, 3000).iter().enumerate() {
            let key = KEY.region(i as u32);
            let (ours, plain) = (ask(&filter, &map.into(), receiver, key), naive(&plain, &raw, receiver, key));
            assert_eq!(ours.to_bits(), plain.to_bits(), "receiver {i}: {ours} {plain}");
        }
    }
}

fn any<P: Pattern + Copy + Into<AnyPattern>>(pattern: P, maps: &[Arc<Tiled>]) {
    twin(pattern, pattern.into(), maps);
}

#[test]
fn r87_13_r87_22_simd_and_culling_agree_with_one_tap_at_a_time() {
    let maps = [
        baked(Kind::Axial, Sampling::Centre),
        baked(Kind::Axial, Sampling::Jittered { seed: 4 }),
        baked(Kind::Radial, Sampling::Centre),
    ];
    twin(Jittered::default(), Jittered::default(), &maps);
    any(Centre, &maps);
    any(EveryTexel, &maps);
    any(Uniform::default().with_num_samples(23), &maps);
    any(Gaussian::default(), &maps);
    any(Jittered::default(), &maps);
    any(Jittered::default().with_num_samples(64).with_min_samples(3), &maps);
    any(Table::default(), &maps);
    any(InsideQuadReject::default(), &maps);
    any(InsideQuadWarp::default(), &maps);
    any(Disc::default(), &maps);
    any(Tent, &maps);
    any(Castano::Five, &maps);
    any(Castano::Seven, &maps);
    any(AreaTent, &maps);
    any(Vogel::default(), &maps);
    any(Spiral::default(), &maps);
}

/// Regions wide enough for whole rows of texels to be read, whose biases are drawn for each tap.
#[test]
fn r87_13_whole_rows_agree_with_one_tap_at_a_time() {
    let mut wide = 0;
    for map in [baked(Kind::Axial, Sampling::Centre), baked(Kind::Radial, Sampling::Jittered { seed: 4 })] {
        let (raw, bbox) = (Arc::new(Raw::copy_of(&map)), Arc::new(Bbox::copy_of(&map)));
        let storages: [Map; 3] = [Map::from(&raw), Map::from(&bbox), Map::from(&map)];
        for least in [5.5, 8.0, 16.3] {
            let filter = Pcf::default().with_pattern(EveryTexel).with_min_size(least);
            let any = filter.with_pattern(AnyPattern::from(EveryTexel));
            for (i, receiver) in receivers(&map, 400).iter().enumerate() {
                let key = KEY.region(i as u32);
                let plain = naive(&filter, &raw, receiver, key);
                wide += usize::from(plain > 0.0 && plain < 1.0);
                for map in &storages {
                    let found = [ask(&filter, map, receiver, key), ask(&any, map, receiver, key)];
                    assert_eq!(found.map(f32::to_bits), [plain.to_bits(); 2], "{i} of {least}: {found:?} {plain}");
                }
                let own = ShadowMap { filter, map: map.as_ref() }.fraction_of(receiver, key);
                assert_eq!(own.to_bits(), plain.to_bits(), "{i} of {least}: {own} {plain}");
            }
        }
    }
    assert!(wide > 300, "{wide} regions across an edge");
}

/// Depth ranges settle regions under a cone and on planes of any reach, and change no answer.
#[test]
fn r87_22_culling_changes_no_answer_whatever_depth_is_compared() {
    let depths: [(&str, AnyDepth); 5] = [
        ("cone", BiasCone::default().into()),
        ("nominal", BiasCone::default().with_radius(Radius::Nominal).with_base(0.1).with_slope(0.5).into()),
        ("near plane", OnPlane::default().with_slack(1.0).with_reach(0.5).into()),
        ("slope-scaled", SlopeScaled::default().with_constant(Bias::Map(1e-4)).with_most(0.5).into()),
        ("offset", NormalOffset::default().with_texels(3.0).with_growth(OffsetGrowth::Versine).into()),
    ];
    for kind in [Kind::Axial, Kind::Screen, Kind::Radial] {
        let map = baked(kind, Sampling::Jittered { seed: 5 });
        for (name, depth) in depths {
            let disc = Pcf::default().with_pattern(Disc::default()).with_res_factor(1.0).with_min_size(1.0);
            let filter = |cull| disc.with_depth(depth).with_cull(cull);
            for (i, receiver) in receivers(&map, 3000).iter().enumerate() {
                let key = KEY.region(i as u32);
                let both = [true, false].map(|cull| ask(&filter(cull), &(&map).into(), receiver, key));
                assert_eq!(both[0], both[1], "{name} {i}");
            }
        }
    }
}

#[test]
fn bounds_enclose_every_compared_depth() {
    for kind in [Kind::Axial, Kind::Screen, Kind::Radial] {
        let map = baked(kind, Sampling::Jittered { seed: 2 });
        encloses("plane", &OnPlane::biased(Bias::World(0.2)), &map);
        encloses("near plane", &OnPlane::default().with_slack(1.0).with_reach(0.25).with_bias(Bias::Texels(0.5)), &map);
        encloses("biased", &Biased::default(), &map);
        encloses("slope-scaled", &SlopeScaled::default().with_constant(Bias::Texels(0.5)), &map);
        encloses("offset", &NormalOffset::default().with_bias(Bias::World(0.1)), &map);
        encloses("cone", &BiasCone::default(), &map);
        encloses(
            "nominal cone",
            &BiasCone::default().with_base(0.3).with_slope(1.0).with_radius(Radius::Nominal),
            &map,
        );
    }
}

fn encloses<D: ReceiverDepth>(name: &str, depth: &D, map: &Tiled) {
    let view = map.view();
    for (i, receiver) in receivers(map, 2000).iter().enumerate() {
        let rect = umbrage_plane::TexelRect::around(receiver.footprint.centre, receiver.footprint.half);
        let bounds = depth.bounds(view, receiver, rect);
        vectorized!(simd => Jittered::default().taps(simd, &receiver.footprint, KEY.region(i as u32), |taps| {
            let compared = depth.lanes(simd, view, receiver, taps);
            for lane in (0..16).filter(|lane| taps.mask >> lane & 1 == 1) {
                let compared = compared[lane];
                assert!((bounds.min..=bounds.max).contains(&compared), "{name} {i}: {compared} not in {bounds:?}");
            }
        }));
    }
}
