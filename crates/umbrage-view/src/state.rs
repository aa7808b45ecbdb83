//! What the page shows, as it stands in the fragment of its address and in requests.

use form_urlencoded::{Serializer, parse};
use std::fmt::Display;

/// Most lights that may be turned.
pub const MOST_TURNS: usize = 64;
/// Most texels along a side of a map.
const MOST_TEXELS: u32 = 16_384;
/// Most columns and rows.
const MOST_PIXELS: u32 = 16_384;
/// Most bytes of a text.
const MOST_TEXT: usize = 4096;

/// What the picture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Show {
    /// The lit picture.
    #[default]
    Picture,
    /// The fraction of one light in shadow.
    Shadow,
    /// The lit picture by rays.
    Truth,
    /// All faults of one light's shadow, each in its colour.
    Faults,
    /// Dark that should be lit.
    FalseShadow,
    /// Lit that should be dark.
    FalseLight,
    /// False shadow that a surface casts on itself.
    Acne,
    /// False light that a bias makes.
    Detachment,
    /// False light that no bias makes.
    Leak,
    /// The difference from truth.
    Difference,
}

impl Show {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Picture,
        Self::Shadow,
        Self::Truth,
        Self::Faults,
        Self::FalseShadow,
        Self::FalseLight,
        Self::Acne,
        Self::Detachment,
        Self::Leak,
        Self::Difference,
    ];

    /// Its word in addresses.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Picture => "picture",
            Self::Shadow => "shadow",
            Self::Truth => "truth",
            Self::Faults => "faults",
            Self::FalseShadow => "false-shadow",
            Self::FalseLight => "false-light",
            Self::Acne => "acne",
            Self::Detachment => "detachment",
            Self::Leak => "leak",
            Self::Difference => "difference",
        }
    }

    /// Whether it compares one light's shadow with truth.
    pub const fn is_judged(self) -> bool {
        !matches!(self, Self::Picture | Self::Shadow | Self::Truth)
    }
}

/// All that the page shows. What is `None` is as the command line has it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// What is seen.
    pub show: Show,
    /// The recipe's text.
    pub recipe: Option<String>,
    /// Side of each light's map, texels, from 1.
    pub map_size: Option<u32>,
    /// The only light, by its name; all where it is `None`.
    pub light: Option<String>,
    /// Lights that were turned, each as a command line names it and its angles.
    pub turns: Vec<String>,
    /// Samples for each pixel.
    pub samples: Option<u32>,
    /// Where truth begins, as a fraction of the picture's width, 0 to 1; `None` where truth is not shown beside the result.
    pub wipe: Option<f64>,
    /// Column and row of the pixel that is explained, from 0.
    pub pixel: Option<[u32; 2]>,
}

/// What is wrong with the words of an address. Its `Display` is one line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name} = {value:?}: expected {expected}")]
pub struct StateError {
    name: String,
    value: String,
    expected: String,
}

impl StateError {
    fn new(name: &str, value: &str, expected: impl Display) -> Self {
        let shown: String = value.chars().take(80).collect();
        let name = name.chars().take(80).filter(|letter| !letter.is_control()).collect();
        Self { name, value: shown, expected: expected.to_string() }
    }
}

impl State {
    /// Reads what [`State::query`] wrote: names and values as in the query of an address.
    ///
    /// # Errors
    /// A name that is not known or comes twice, or a value that it cannot have.
    pub fn read(query: &str) -> Result<Self, StateError> {
        let mut state = Self::default();
        let mut known: Vec<String> = Vec::new();
        for (name, value) in parse(query.as_bytes()) {
            if name != "turn" && known.contains(&name.to_string()) {
                return Err(StateError::new(&name, &value, "it once"));
            }
            state.set(&name, &value)?;
            known.push(name.into_owned());
        }
        Ok(state)
    }

    fn set(&mut self, name: &str, value: &str) -> Result<(), StateError> {
        let wrong = |expected: &str| StateError::new(name, value, expected);
        match name {
            "show" => {
                let named = Show::ALL.into_iter().find(|show| show.name() == value);
                self.show = named.ok_or_else(|| wrong(&Show::ALL.map(Show::name).join(", ")))?;
            }
            "recipe" => self.recipe = Some(text(name, value)?),
            "map-size" => self.map_size = Some(whole(value, 1, MOST_TEXELS).ok_or_else(|| wrong("1 to 16384 texels"))?),
            "light" => self.light = Some(text(name, value)?),
            "turn" if self.turns.len() == MOST_TURNS => return Err(wrong("fewer lights that are turned")),
            "turn" => self.turns.push(text(name, value)?),
            "samples" => {
                let samples = whole(value, 1, 64).filter(|samples| [1, 4, 16, 64].contains(samples));
                self.samples = Some(samples.ok_or_else(|| wrong("1, 4, 16 or 64"))?);
            }
            "wipe" => {
                let share = value.parse().ok().filter(|share| (0.0..=1.0).contains(share));
                self.wipe = Some(share.ok_or_else(|| wrong("a number from 0 to 1"))?);
            }
            "pixel" => {
                let at = |text: &str| whole(text, 0, MOST_PIXELS - 1);
                let pixel = value.split_once(',').and_then(|(x, y)| Some([at(x)?, at(y)?]));
                self.pixel = Some(pixel.ok_or_else(|| wrong("X,Y, whole numbers from 0"))?);
            }
            _ => {
                let expected = "one of show, recipe, map-size, light, turn, samples, wipe, pixel";
                return Err(StateError::new("name", name, expected));
            }
        }
        Ok(())
    }

    /// The state as the query of an address; [`State::read`] gives the same state back.
    pub fn query(&self) -> String {
        let mut query = Serializer::new(String::new());
        if self.show != Show::default() {
            query.append_pair("show", self.show.name());
        }
        let number = |number: Option<u32>| number.map(|number| number.to_string());
        for (name, value) in [
            ("recipe", self.recipe.clone()),
            ("map-size", number(self.map_size)),
            ("light", self.light.clone()),
            ("samples", number(self.samples)),
            ("wipe", self.wipe.map(|share| share.to_string())),
            ("pixel", self.pixel.map(|[x, y]| format!("{x},{y}"))),
        ] {
            if let Some(value) = value {
                query.append_pair(name, &value);
            }
        }
        for turn in &self.turns {
            query.append_pair("turn", turn);
        }
        query.finish()
    }
}

/// A text without control characters.
fn text(name: &str, value: &str) -> Result<String, StateError> {
    if value.len() > MOST_TEXT || value.chars().any(char::is_control) {
        return Err(StateError::new(name, value, format!("a line of at most {MOST_TEXT} bytes")));
    }
    Ok(value.into())
}

fn whole(value: &str, least: u32, most: u32) -> Option<u32> {
    let digits = !value.is_empty() && value.bytes().all(|byte| byte.is_ascii_digit());
    value.parse().ok().filter(|number| digits && (least..=most).contains(number))
}

/// Which of the two pictures on either side of the divider.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Of {
    /// What the state shows.
    #[default]
    Result,
    /// The same by rays.
    Truth,
}

/// A requested picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ask {
    /// What it shows.
    pub state: State,
    /// By maps or by rays.
    pub of: Of,
    /// Small, with one sample for each pixel: for what moves.
    pub draft: bool,
}

impl Ask {
    /// Reads a query: `of=truth` and `draft=1` among the words of a state.
    ///
    /// # Errors
    /// As [`State::read`].
    pub fn read(query: &str) -> Result<Self, StateError> {
        let mut ask = Self::default();
        let mut rest = Serializer::new(String::new());
        for (name, value) in parse(query.as_bytes()) {
            match (&*name, &*value) {
                ("of", "truth") => ask.of = Of::Truth,
                ("of", "result") => ask.of = Of::Result,
                ("of", _) => return Err(StateError::new(&name, &value, "result or truth")),
                ("draft", "1") => ask.draft = true,
                ("draft", "0") => ask.draft = false,
                ("draft", _) => return Err(StateError::new(&name, &value, "0 or 1")),
                _ => {
                    rest.append_pair(&name, &value);
                }
            }
        }
        ask.state = State::read(&rest.finish())?;
        Ok(ask)
    }

    /// Whether rays are cast for all of a large picture.
    pub fn is_slow(&self) -> bool {
        if self.draft {
            return false;
        }
        self.of == Of::Truth || self.state.show == Show::Truth || self.state.show.is_judged()
    }
}
