use std::fmt;
use std::str::FromStr;
use umbrage_plane::Bias;
use umbrage_shadow::MapRadius;

/// What the value of a [`Field`](crate::Field) may be. `Display` writes it as errors and help do: "expected ..".
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Kind {
    /// One of these words.
    Words(&'static [&'static str]),
    /// `on` or `off`.
    Switch,
    /// A whole number from 1 to this one.
    Whole(u32),
    /// A finite number from 0.
    Number,
    /// A finite number above 0.
    Positive,
    /// A number from 0 to this one, both included.
    UpTo(f32),
    /// A number from 0, below 1.
    BelowOne,
    /// A number above 0, at most 1.
    Ratio,
    /// A number from 0 with a unit: `w` or none for world units, `t` texels, `s` depth steps, `m` fractions of the range from near to far as screen depth has it.
    Bias,
    /// The same, or a range `a..b` with one unit behind it.
    BiasRange,
    /// A number from 0 with a unit: `t` or none for texels, `w` world units, `%` of the map.
    Radius,
    /// Two numbers `a..b` from 0 to 1.
    Pair,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Words(words) => f.write_str(&either(words)),
            Self::Switch => f.write_str("on or off"),
            Self::Whole(most) => write!(f, "a whole number from 1 to {most}"),
            Self::Number => f.write_str("a finite number from 0"),
            Self::Positive => f.write_str("a finite number above 0"),
            Self::UpTo(most) => write!(f, "a number from 0 to {most}"),
            Self::BelowOne => f.write_str("a number from 0, below 1"),
            Self::Ratio => f.write_str("a number above 0, at most 1"),
            Self::Bias => f.write_str("a number from 0 with a unit w, t, s or m"),
            Self::BiasRange => {
                f.write_str("a number from 0, or two as a..b with the smaller first, and one unit w, t, s or m")
            }
            Self::Radius => f.write_str("a number from 0 with a unit t (texels), w (world) or % (of the map)"),
            Self::Pair => f.write_str("two numbers a..b from 0 to 1"),
        }
    }
}

/// Words as a choice: "a, b or c".
pub fn either(words: &[&str]) -> String {
    match words {
        [] => String::new(),
        [only] => (*only).into(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}

/// A value that a field may have: how it is read and written. Reading what was written gives the same value.
pub trait Value: Sized {
    /// `None` for what is not of this kind.
    fn read(text: &str, kind: Kind) -> Option<Self>;

    fn write(&self) -> String;
}

impl Value for u32 {
    fn read(text: &str, kind: Kind) -> Option<Self> {
        let Kind::Whole(most) = kind else { return None };
        text.parse().ok().filter(|number| (1..=most).contains(number))
    }

    fn write(&self) -> String {
        self.to_string()
    }
}

impl Value for f32 {
    fn read(text: &str, kind: Kind) -> Option<Self> {
        let value = number(text)?;
        let fits = match kind {
            Kind::Number => true,
            Kind::Positive => value > 0.0,
            Kind::UpTo(most) => value <= most,
            Kind::BelowOne => value < 1.0,
            Kind::Ratio => value > 0.0 && value <= 1.0,
            _ => false,
        };
        fits.then_some(value)
    }

    fn write(&self) -> String {
        self.to_string()
    }
}

impl Value for bool {
    fn read(text: &str, _kind: Kind) -> Option<Self> {
        match text {
            "on" => Some(true),
            "off" => Some(false),
            _ => None,
        }
    }

    fn write(&self) -> String {
        if *self { "on" } else { "off" }.into()
    }
}

/// A finite number from 0; −0 is 0.
fn number(text: &str) -> Option<f32> {
    f32::from_str(text).ok().filter(|number| number.is_finite() && *number >= 0.0).map(f32::abs)
}

/// A number of one unit as a bias.
type Unit = fn(f32) -> Bias;

/// The digits of a bias, and its unit.
fn unit(text: &str) -> (&str, Unit) {
    let units: [(char, Unit); 4] = [('w', Bias::World), ('t', Bias::Texels), ('s', Bias::Steps), ('m', Bias::Map)];
    let named = units.into_iter().find_map(|(letter, unit)| Some((text.strip_suffix(letter)?, unit)));
    named.unwrap_or((text, Bias::World))
}

/// The number of a bias, and the letter of its unit.
fn parts(bias: Bias) -> (f32, &'static str) {
    match bias {
        Bias::World(number) => (number, ""),
        Bias::Texels(number) => (number, "t"),
        Bias::Steps(number) => (number, "s"),
        Bias::Map(number) => (number, "m"),
    }
}

impl Value for Bias {
    fn read(text: &str, _kind: Kind) -> Option<Self> {
        let (digits, unit) = unit(text);
        number(digits).map(unit)
    }

    fn write(&self) -> String {
        let (number, unit) = parts(*self);
        format!("{number}{unit}")
    }
}

/// The ends of a range of biases, in one unit.
impl Value for (Bias, Bias) {
    fn read(text: &str, kind: Kind) -> Option<Self> {
        let (digits, unit) = unit(text);
        let Some((low, high)) = digits.split_once("..") else {
            return Bias::read(text, kind).map(|bias| (bias, bias));
        };
        let ends = number(low).zip(number(high)).filter(|(low, high)| low <= high);
        ends.map(|(low, high)| (unit(low), unit(high)))
    }

    fn write(&self) -> String {
        let ((low, _), (high, unit)) = (parts(self.0), parts(self.1));
        if self.0 == self.1 { self.0.write() } else { format!("{low}..{high}{unit}") }
    }
}

impl Value for MapRadius {
    fn read(text: &str, _kind: Kind) -> Option<Self> {
        type Unit = fn(f32) -> MapRadius;
        let units: [(char, Unit); 3] =
            [('w', Self::World), ('t', Self::Texels), ('%', |percent| Self::Fraction(percent / 100.0))];
        let named = units.into_iter().find_map(|(letter, unit)| Some((text.strip_suffix(letter)?, unit)));
        let (digits, unit) = named.unwrap_or((text, Self::Texels));
        number(digits).map(unit)
    }

    fn write(&self) -> String {
        match self {
            Self::Texels(radius) => format!("{radius}t"),
            Self::World(radius) => format!("{radius}w"),
            Self::Fraction(share) => format!("{}%", percent(*share)),
        }
    }
}

/// A number of per cent that is read as this fraction: a hundred times it, or a few roundings beside that.
fn percent(share: f32) -> f32 {
    let about = share * 100.0;
    let beside = |steps: i32| f32::from_bits(about.to_bits().saturating_add_signed(steps));
    let near = [0, 1, -1, 2, -2].into_iter().map(beside);
    near.into_iter().find(|percent| percent / 100.0 == share).unwrap_or(about)
}

/// The ends of a range of fractions.
impl Value for (f32, f32) {
    fn read(text: &str, _kind: Kind) -> Option<Self> {
        let (near, far) = text.split_once("..")?;
        f32::read(near, Kind::UpTo(1.0)).zip(f32::read(far, Kind::UpTo(1.0)))
    }

    fn write(&self) -> String {
        format!("{}..{}", self.0, self.1)
    }
}
