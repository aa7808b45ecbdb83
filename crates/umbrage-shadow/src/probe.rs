use umbrage_plane::Place;

/// Is told what a filter does, for counters and for explanations. Every method does nothing unless overridden, and `()` is the probe that costs nothing.
pub trait Probe {
    /// A receiver whose answer its place alone settled.
    #[inline(always)]
    fn placed(&mut self, place: Place) {
        let _ = place;
    }
    /// A region settled by depth ranges without a look-up; `dark` is the answer.
    #[inline(always)]
    fn culled(&mut self, dark: bool) {
        let _ = dark;
    }
    /// A region that was looked up, with the number of texels read.
    #[inline(always)]
    fn looked(&mut self, texels: u32) {
        let _ = texels;
    }
    /// A region that was compared on its tangent plane (WM94-15).
    #[inline(always)]
    fn virtual_sampled(&mut self) {}
    /// A comparison by whole units first; `conclusive` when they settled it (W92-7).
    #[inline(always)]
    fn compared(&mut self, conclusive: bool) {
        let _ = conclusive;
    }
}

impl Probe for () {}

/// Counts of what filters did (spec X-6).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Receivers answered by their place.
    pub placed: u64,
    /// Regions found lit by ranges alone.
    pub culled_lit: u64,
    /// Regions found dark by ranges alone.
    pub culled_dark: u64,
    /// Regions that were looked up.
    pub sampled: u64,
    /// Texels read.
    pub lookups: u64,
    /// Regions compared on their tangent plane.
    pub virtual_sampled: u64,
    /// Comparisons that whole units settled.
    pub conclusive: u64,
    /// Comparisons that needed the fraction too.
    pub inconclusive: u64,
}

impl Counters {
    /// Both counts together.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            placed: self.placed + other.placed,
            culled_lit: self.culled_lit + other.culled_lit,
            culled_dark: self.culled_dark + other.culled_dark,
            sampled: self.sampled + other.sampled,
            lookups: self.lookups + other.lookups,
            virtual_sampled: self.virtual_sampled + other.virtual_sampled,
            conclusive: self.conclusive + other.conclusive,
            inconclusive: self.inconclusive + other.inconclusive,
        }
    }
}

impl Probe for Counters {
    fn placed(&mut self, _place: Place) {
        self.placed += 1;
    }
    fn culled(&mut self, dark: bool) {
        *(if dark { &mut self.culled_dark } else { &mut self.culled_lit }) += 1;
    }
    fn looked(&mut self, texels: u32) {
        self.sampled += 1;
        self.lookups += u64::from(texels);
    }
    fn virtual_sampled(&mut self) {
        self.virtual_sampled += 1;
    }
    fn compared(&mut self, conclusive: bool) {
        *(if conclusive { &mut self.conclusive } else { &mut self.inconclusive }) += 1;
    }
}
