use glam::{DVec2, Vec2};
use umbrage_depth::FacetSample;
use umbrage_plane::Place;

/// One tap of a region, as a filter judged it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TapJudged {
    /// Where it is, texels of the map.
    pub at: Vec2,
    /// The nearest depth that its texel stores, of the map's kind; +∞ where no surface is stored.
    pub stored: f32,
    /// The receiver's depth that is compared there, of the map's kind.
    pub compared: f32,
    /// How much it counts.
    pub weight: f32,
    /// The result of the view's rules for its place, where they settle it; the depths do not count then.
    pub ruled: Option<f32>,
    /// The result: 0 lit, 1 dark, in between where casters let light pass.
    pub dark: f32,
}

/// One place of a region, as [`DualPlane`](crate::DualPlane) judged it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceJudged {
    /// Where it is, texels of the map.
    pub at: DVec2,
    /// Whether the view's rules call it dark, where they settle it; votes do not count then.
    pub ruled: Option<bool>,
    /// The votes of the samples around it: upper left, upper right, lower left, lower right.
    pub votes: [Vote; 4],
    /// Where the sides between samples of different votes are crossed by the shadow's edge: upper and lower from the left, left and right from above.
    pub crossings: [Option<Crossing>; 4],
    /// The result.
    pub dark: bool,
}

/// The vote of a sample of a map of facets on a place: dark where the receiver's plane lies behind the facet's by more than `passed` both at the sample and at
/// the
/// place. Distances are world units along the light's axis, converted by the size of a depth step at the receiver; −∞ where the sample sees nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vote {
    /// The facet's plane, where it was sampled, and how wide the sample is.
    pub sample: FacetSample,
    /// How far the receiver's plane lies behind the facet's where the sample was taken.
    pub at_sample: f64,
    /// The same at the place that is judged.
    pub at_place: f64,
    /// The margin that both must exceed: what the sample's width and the gentler slope leave open, and roundings.
    pub passed: f64,
    /// The vote.
    pub dark: bool,
}

/// Where the side between two samples is crossed, 0 at the first and 1 at the second, and how that is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Crossing {
    /// There the map's links say that one surface ends in front of the other.
    Link(f64),
    /// There the receiver's plane passes from behind one facet to in front of the other.
    Planes(f64),
    /// Nothing is known.
    Halfway,
}

impl Crossing {
    /// Where it is.
    #[inline(always)]
    #[must_use]
    pub fn place(self) -> f64 {
        match self {
            Self::Link(place) | Self::Planes(place) => place,
            Self::Halfway => 0.5,
        }
    }
}

/// Receives what a filter does, for counters and for explanations. Every method does nothing unless overridden, and `()` is the probe that costs nothing.
pub trait Probe {
    /// Whether [`Probe::judged`] is called for every place that is judged, and [`Probe::tapped`] for every tap, which takes longer than the
    /// result itself. A constant, so that filters are compiled without it for probes that only count.
    const EXPLAINS: bool = false;

    /// A receiver that its place alone settled.
    #[inline(always)]
    fn placed(&mut self, place: Place) {
        let _ = place;
    }
    /// A region settled by depth ranges without a look-up; `dark` is the result.
    #[inline(always)]
    fn culled(&mut self, dark: bool) {
        let _ = dark;
    }
    /// A region that was looked up, with the number of texels read.
    #[inline(always)]
    fn looked(&mut self, texels: u32) {
        let _ = texels;
    }
    /// A region that was compared on its tangent plane (Wang & Molnar 1994).
    #[inline(always)]
    fn virtual_sampled(&mut self) {}
    /// A place of a region over a map of facets: the votes of the samples around it, and why it is lit or dark. Called only when [`Probe::EXPLAINS`].
    #[inline(always)]
    fn judged(&mut self, place: &PlaceJudged) {
        let _ = place;
    }
    /// The taps that follow belong to one look-up. Called only when [`Probe::EXPLAINS`].
    #[inline(always)]
    fn asked(&mut self) {}
    /// One tap of a region. Called only when [`Probe::EXPLAINS`].
    #[inline(always)]
    fn tapped(&mut self, tap: &TapJudged) {
        let _ = tap;
    }
    /// A comparison by whole units first; `conclusive` when they settled it (Woo 1992).
    #[inline(always)]
    fn compared(&mut self, conclusive: bool) {
        let _ = conclusive;
    }
}

impl Probe for () {}

/// Counts of what filters did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Receivers settled by their place.
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
