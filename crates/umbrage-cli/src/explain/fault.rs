//! What is wrong with a judged pixel, by name.

use std::fmt;
use umbrage_oracle::judge::{DARK, LIT};
use umbrage_plane::Receiver;
use umbrage_shadow::Explanation;

/// A fault.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// In shadow where truth is lit: the receiver's own surface, or one that is not between, is stored nearer than the receiver.
    Acne {
        /// How much nearer, world units, at most.
        nearer: f64,
        /// The slope-scaled bias that clears it, texels; `None` where the surface is edge-on.
        clears: Option<f64>,
    },
    /// Lit where truth is dark, and dark without the bias, which reaches what blocks the light.
    Detachment {
        /// From the receiver to what blocks it, along the ray, world units and widths of a texel.
        gap: f64,
        texels: f64,
    },
    /// Lit where truth is dark, with or without a bias.
    Leak,
    /// The same, but dark without the bias for what is stored of its own surface: what blocks the light is farther away than the bias reaches.
    HiddenLeak {
        /// From the receiver to what blocks it, along the ray, world units.
        gap: f64,
    },
}

impl Fault {
    pub fn name(&self) -> &'static str {
        match self {
            Self::Acne { .. } => "acne",
            Self::Detachment { .. } => "detachment",
            Self::Leak | Self::HiddenLeak { .. } => "leak",
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let short = crate::bias::short;
        match self {
            Self::Acne { nearer, clears } => {
                write!(
                    f,
                    "acne: what truth does not see between is stored up to {} world units nearer; ",
                    short(*nearer)
                )?;
                match clears {
                    Some(texels) => write!(f, "a slope-scaled bias of {} texels or `auto` clears it", short(*texels)),
                    None => write!(f, "`auto` clears it"),
                }
            }
            Self::Detachment { gap, texels } => write!(
                f,
                "detachment: what blocks the light is {} world units away, {} texels, and the bias passes it; `auto` needs none",
                short(*gap),
                short(*texels)
            ),
            Self::Leak => {
                write!(f, "leak: the map knows nothing nearer than the receiver there, with or without a bias")
            }
            Self::HiddenLeak { gap } => write!(
                f,
                "leak: what blocks the light is {} world units away, farther than the bias reaches; without it what is stored of the surface itself hides \
                 the leak",
                short(*gap)
            ),
        }
    }
}

/// The evidence by which a fault is named.
#[derive(Clone, Copy, Debug)]
pub struct Answers {
    fraction: f32,
    truth: f32,
    /// The receiver of the map whose dark taps are stored nearest, and by how much.
    nearest: Option<(Receiver, f64)>,
    /// From the receiver to what blocks the light.
    gap: f64,
}

impl Answers {
    /// A pixel's value and its truth, the maps that were looked up for one of its regions, and the distance to what blocks the light there by rays.
    pub fn new<'a>(fraction: f32, truth: f32, maps: impl Iterator<Item = &'a Explanation>, gap: Option<f64>) -> Self {
        let nearest = maps.filter_map(|explanation| Some((explanation.receiver?, nearer(explanation))));
        let nearest = nearest.reduce(|known, other| if other.1 > known.1 { other } else { known });
        Self { fraction, truth, nearest, gap: gap.unwrap_or(0.0) }
    }
}

/// What is wrong with a judged pixel; `without` is its value without a bias, `passes` whether the bias reaches what blocks the light.
pub fn of(
    answers: &Answers,
    without: impl FnOnce() -> anyhow::Result<Option<f32>>,
    passes: impl FnOnce() -> bool,
) -> anyhow::Result<Option<Fault>> {
    let Answers { fraction, truth, nearest, gap } = *answers;
    if truth < LIT && fraction > 0.5 {
        let nearer = nearest.map_or(0.0, |(_, nearer)| nearer);
        let step = nearest.map(|(receiver, _)| f64::from(receiver.texel_world.max_element() * receiver.slope));
        let clears = step.filter(|step| step.is_finite() && *step > 0.0).map(|step| nearer / step);
        return Ok(Some(Fault::Acne { nearer, clears }));
    }
    if truth > DARK && fraction < 0.5 {
        if without()?.is_none_or(|dark| dark <= 0.5) {
            return Ok(Some(Fault::Leak));
        }
        if !passes() {
            return Ok(Some(Fault::HiddenLeak { gap }));
        }
        let texel = nearest.map_or(f64::INFINITY, |(receiver, _)| f64::from(receiver.texel_world.max_element()));
        return Ok(Some(Fault::Detachment { gap, texels: gap / texel }));
    }
    Ok(None)
}

/// How much nearer to the light than the receiver the nearest dark tap is stored, in the map's own depths.
fn nearer(explanation: &Explanation) -> f64 {
    let Some(receiver) = explanation.receiver else { return 0.0 };
    let taps = explanation.questions.last().map_or(&[][..], |question| &question.taps);
    let dark = taps.iter().filter(|tap| tap.dark > 0.5 && tap.ruled.is_none());
    let by_taps = dark.map(|tap| f64::from(receiver.depth - tap.stored)).fold(0.0, f64::max);
    let votes = explanation.places.iter().filter(|place| place.dark).flat_map(|place| &place.votes);
    votes.filter(|vote| vote.dark).map(|vote| vote.at_place).fold(by_taps, f64::max)
}
