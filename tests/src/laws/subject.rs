use umbrage_depth::{DepthMap, Map};
use umbrage_plane::{Receiver, SurfacePoint};
use umbrage_sample::Key;
use umbrage_shadow::{Counters, Filter, Query, Shadow, ShadowMap};

/// The key under which laws ask.
pub const KEY: Key = Key::new(11, 0, 0);

/// A filter to be judged. The laws know it only as what it answers over a [`Map`], so that each filter is compiled once.
pub struct Subject {
    /// Its name in messages.
    pub name: &'static str,
    filter: Box<dyn Judged>,
    kept: fn(Map) -> Map,
}

impl Subject {
    /// A filter under a name.
    pub fn new(name: &'static str, filter: impl Filter + Clone + 'static) -> Self {
        Self { name, filter: Box::new(filter), kept: |map| map }
    }

    /// The same over maps as `kept` makes them of those that laws ask about. What it has made it must leave alone.
    #[must_use]
    pub fn through(self, kept: fn(Map) -> Map) -> Self {
        Self { kept, ..self }
    }

    /// A map as the filter looks it up: what a law needs many times is made once.
    pub fn kept(&self, map: Map) -> Map {
        (self.kept)(map)
    }

    /// The filter over a map.
    pub fn over(&self, map: &Map) -> Box<dyn Shadow> {
        self.filter.over(self.kept(map.clone()))
    }

    /// The answers at points, and what was counted.
    pub fn counted(&self, map: &Map, at: &[SurfacePoint], out: &mut [f32]) -> Counters {
        self.filter.counted(self.kept(map.clone()), at, out)
    }

    /// The answer for a receiver that is already in the light's space.
    pub fn of(&self, map: &Map, receiver: &Receiver, key: Key) -> f32 {
        self.filter.of(self.kept(map.clone()), receiver, key)
    }

    /// The same with no instructions but those that every machine of this kind has.
    pub fn of_baseline(&self, map: &Map, receiver: &Receiver, key: Key) -> f32 {
        self.filter.of_baseline(&self.kept(map.clone()), receiver, key)
    }
}

/// A filter whose type is forgotten.
trait Judged {
    fn over(&self, map: Map) -> Box<dyn Shadow>;
    fn counted(&self, map: Map, at: &[SurfacePoint], out: &mut [f32]) -> Counters;
    fn of(&self, map: Map, receiver: &Receiver, key: Key) -> f32;
    fn of_baseline(&self, map: &Map, receiver: &Receiver, key: Key) -> f32;
}

impl<F: Filter + Clone + 'static> Judged for F {
    fn over(&self, map: Map) -> Box<dyn Shadow> {
        Box::new(ShadowMap { filter: self.clone(), map })
    }

    fn counted(&self, map: Map, at: &[SurfacePoint], out: &mut [f32]) -> Counters {
        let mut counters = Counters::default();
        ShadowMap { filter: self.clone(), map }.fractions_probed(at, KEY, out, &mut counters);
        counters
    }

    fn of(&self, map: Map, receiver: &Receiver, key: Key) -> f32 {
        ShadowMap { filter: self.clone(), map }.fraction_of(receiver, key)
    }

    fn of_baseline(&self, map: &Map, receiver: &Receiver, key: Key) -> f32 {
        #[cfg(target_arch = "x86_64")]
        let level = fearless_simd::Level::baseline().as_sse2().expect("x86-64 has SSE2");
        #[cfg(target_arch = "aarch64")]
        let level = fearless_simd::Level::baseline().as_neon().expect("AArch64 has Neon");
        Query::new(level, map, receiver, key, &mut ()).ask(self)
    }
}

/// What is wrong with a filter, or nothing.
pub type Found = Result<(), String>;

/// `wrong` unless `good`.
pub fn check(good: bool, wrong: impl FnOnce() -> String) -> Found {
    if good { Ok(()) } else { Err(wrong()) }
}

/// The same bits, or which answers differ.
pub fn same(what: &str, index: usize, answers: &[f32]) -> Found {
    let alike = answers.iter().all(|answer| answer.to_bits() == answers[0].to_bits());
    check(alike, || format!("{what} {index}: {answers:?}"))
}

/// The names of what two sets of depths are over.
pub fn size(map: &impl DepthMap) -> glam::Vec2 {
    map.view().size().as_vec2()
}
