use crate::probe::{PlaceJudged, Probe, TapJudged};
use umbrage_plane::{Place, Receiver, View};

/// What a filter did for one receiver and one map, step by step: why the receiver is lit or dark.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Explanation {
    /// The map's view.
    pub view: View,
    /// The receiver in the map's space; `None` where it has no place there.
    pub receiver: Option<Receiver>,
    /// The place by which the view's rules alone settled the result, where they did.
    pub placed: Option<Place>,
    /// The result that depth ranges alone settled, where they did; true is dark.
    pub culled: Option<bool>,
    /// The look-ups of the map, in their order: one for percentage closer, two where a second test was needed, a search and a look-up for soft
    /// shadows.
    pub questions: Vec<Question>,
    /// Whether the receiver was compared on its tangent plane (Wang & Molnar 1994).
    pub on_plane: bool,
    /// Over maps of facets, each place that was judged and the votes of the samples around it.
    pub places: Vec<PlaceJudged>,
    /// Texels read.
    pub texels: u32,
    /// The filter's result, from 0 lit to 1 dark.
    pub fraction: f32,
}

/// The taps that a filter took together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Question {
    /// In the order in which they were taken.
    pub taps: Vec<TapJudged>,
}

impl Question {
    /// The weighted fraction of the taps that are dark, as the filter itself adds it up; 0 without taps. For a search it is the fraction that lies behind
    /// something.
    pub fn share(&self) -> f32 {
        let (mut dark, mut all) = (0.0, 0.0);
        for tap in &self.taps {
            all += tap.weight;
            dark += tap.weight * tap.dark;
        }
        if all > 0.0 { dark / all } else { 0.0 }
    }
}

impl Explanation {
    /// Nothing done yet.
    pub(crate) fn of(view: &View, receiver: Option<Receiver>) -> Self {
        Self {
            view: *view,
            receiver,
            placed: None,
            culled: None,
            questions: Vec::new(),
            on_plane: false,
            places: Vec::new(),
            texels: 0,
            fraction: 0.0,
        }
    }
}

impl Probe for Explanation {
    const EXPLAINS: bool = true;

    fn placed(&mut self, place: Place) {
        self.placed = Some(place);
    }

    fn culled(&mut self, dark: bool) {
        self.culled = Some(dark);
    }

    fn looked(&mut self, texels: u32) {
        self.texels += texels;
    }

    fn virtual_sampled(&mut self) {
        self.on_plane = true;
    }

    fn judged(&mut self, place: &PlaceJudged) {
        self.places.push(place.clone());
    }

    fn asked(&mut self) {
        self.questions.push(Question::default());
    }

    fn tapped(&mut self, tap: &TapJudged) {
        if let Some(question) = self.questions.last_mut() {
            question.taps.push(*tap);
        }
    }
}
