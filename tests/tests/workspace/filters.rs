//! The laws of filters, held against every filter, and against filters, storages and depths that break them.

use fearless_simd::{Simd, f32x16};
use glam::IVec2;
use umbrage_depth::{Bbox, DepthMap, Raw, Tiled};
use umbrage_plane::{Bias, DepthRange, Receiver, TexelRect, View};
use umbrage_sample::{EveryTexel, Taps};
use umbrage_shadow::{
    BiasCone, Biased, Filter, Met, NormalOffset, OnPlane, Probe, Query, ReceiverDepth, SlopeScaled, Spread,
};
use umbrage_tests::laws::{self, Subject, culling, every_filter};

#[test]
fn c_10_b06_11_r87_21_r87_22_every_filter_keeps_every_law() {
    for subject in every_filter() {
        laws::hold(&subject).unwrap();
    }
    let darkness = ["an empty map is lit and a full one dark", "a veil passes its fraction, in colour too"];
    assert!(darkness.iter().all(|name| laws::EVERY.iter().any(|(law, _)| law == name)));
    laws::hold_but(&laws::thinning(), &darkness).unwrap();
    let deep = ["opaque surfaces of a deep map are those of a plain one"];
    assert!(laws::EVERY.iter().any(|(law, _)| deep.contains(law)));
    for subject in laws::prefiltered() {
        laws::hold_but(&subject, &deep).unwrap();
    }
}

#[test]
fn r87_22_what_ranges_settle_is_what_taps_say() {
    fn each_storage(depth: impl ReceiverDepth + Copy) {
        culling(Raw::clone, &depth).unwrap();
        culling(|map| Bbox::from(map), &depth).unwrap();
        culling(|map| Tiled::from(map), &depth).unwrap();
    }
    each_storage(Biased::constant(Bias::ZERO));
    each_storage(Biased::world(0.0, 2e-6).with_spread(Spread::Ramp));
    each_storage(OnPlane::default());
    each_storage(BiasCone::default().with_slope(1e-6));
    each_storage(SlopeScaled::default().with_slope(1e-6));
    each_storage(NormalOffset::default().with_texels(1e-5));
}

/// The mean of a transform at each tap; 0 without a tap.
fn mean<S: Simd, M: DepthMap, P: Probe>(
    query: &mut Query<'_, S, M, P>,
    dark: impl Fn(&umbrage_shadow::Seen<'_>) -> f32,
) -> f32 {
    let (mut sum, mut weight) = (0.0, 0.0);
    query.each(&query.region(1.0, 1.0), &EveryTexel, &Biased::default(), |seen| {
        sum += dark(seen) * seen.tap.weight;
        weight += seen.tap.weight;
    });
    if weight > 0.0 { sum / weight } else { 0.0 }
}

/// Reads depths itself and drops the verdict of the place.
#[derive(Clone)]
struct DropsVerdicts;

impl Filter for DropsVerdicts {
    fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32 {
        mean(query, |seen| match &seen.met {
            Met::Surfaces(surfaces) => surfaces.dark(seen.compared),
            Met::Settled(_) => 0.0,
        })
    }
}

/// Takes whatever is nearest for opaque.
#[derive(Clone)]
struct IgnoresGlass;

impl Filter for IgnoresGlass {
    fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32 {
        mean(query, |seen| match &seen.met {
            Met::Surfaces(surfaces) => f32::from(u8::from(seen.compared > surfaces.nearest())),
            Met::Settled(dark) => *dark,
        })
    }
}

/// The mean of all that is reported: the control, which keeps every law.
#[derive(Clone)]
struct Honest;

impl Filter for Honest {
    #[expect(
        clippy::redundant_closure_for_method_calls,
        reason = "the method of one lifetime is not a function of all"
    )]
    fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32 {
        mean(query, |seen| seen.dark())
    }
}

/// Compares by the receiver's slope, and says that it does not.
#[derive(Clone)]
struct HidesSlope;

impl Filter for HidesSlope {
    fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32 {
        query.share(&query.region(1.0, 1.0), &EveryTexel, &Biased::constant(Bias::Steps(1.0)))
    }

    fn asks_tilt<M: DepthMap>(&self, _: &M) -> bool {
        false
    }
}

#[test]
fn the_laws_catch_a_filter_that_uses_a_slope_it_does_not_ask_for() {
    let broken = laws::hold(&Subject::new("hides slope", HidesSlope)).unwrap_err();
    assert!(broken.contains("a batch is its points one by one"), "{broken}");
}

#[test]
fn the_laws_catch_a_filter_that_drops_verdicts_and_one_that_ignores_what_passes() {
    let broken = |subject: Subject| laws::hold(&subject).unwrap_err();
    let dropped = broken(Subject::new("drops verdicts", DropsVerdicts));
    assert!(dropped.contains("places outside the map"), "{dropped}");
    let ignored = broken(Subject::new("ignores glass", IgnoresGlass));
    assert!(ignored.contains("a veil passes its fraction"), "{ignored}");
    laws::hold(&Subject::new("honest", Honest)).unwrap();
}

/// Tiles whose ranges are too narrow by one unit in the last place, at one end.
#[derive(Clone)]
struct Tight {
    tiles: Tiled,
    upper: bool,
}

impl DepthMap for Tight {
    fn view(&self) -> &View {
        self.tiles.view()
    }

    fn depth(&self, texel: IVec2) -> f32 {
        self.tiles.depth(texel)
    }

    fn range(&self, rect: TexelRect) -> DepthRange {
        let DepthRange { min, max } = self.tiles.range(rect);
        if self.upper { DepthRange { min, max: max.next_down() } } else { DepthRange { min: min.next_up(), max } }
    }

    fn bytes(&self) -> usize {
        self.tiles.bytes()
    }

    fn allocated(&self) -> usize {
        self.tiles.allocated()
    }
}

/// A constant bias whose bounds are too narrow by one unit in the last place, at one end.
#[derive(Clone, Copy)]
struct Short {
    upper: bool,
}

impl ReceiverDepth for Short {
    fn lanes<S: Simd>(&self, simd: S, view: &View, receiver: &Receiver, taps: &Taps<S>) -> f32x16<S> {
        Biased::constant(Bias::ZERO).lanes(simd, view, receiver, taps) + 0.0
    }

    fn bounds(&self, view: &View, receiver: &Receiver, rect: TexelRect) -> DepthRange {
        let DepthRange { min, max } = Biased::constant(Bias::ZERO).bounds(view, receiver, rect);
        if self.upper { DepthRange { min, max: max.next_down() } } else { DepthRange { min: min.next_up(), max } }
    }
}

#[test]
fn the_law_of_ranges_catches_a_storage_and_a_depth_that_are_one_unit_too_tight() {
    let exact = Biased::constant(Bias::ZERO);
    for upper in [false, true] {
        assert!(culling(|map| Tight { tiles: Tiled::from(map), upper }, &exact).is_err(), "storage, upper: {upper}");
        assert!(culling(|map| Tiled::from(map), &Short { upper }).is_err(), "depth, upper: {upper}");
    }
}
