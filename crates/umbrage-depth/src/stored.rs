use std::fmt;

/// Which surface the depths of a map belong to: what a [`DepthRule`](crate::DepthRule) keeps, without its parameters.
///
/// A filter may be put over any of them, and mixtures that nobody published are free. Each paper's preset expects one, because its comparison
/// is only right over that: a filter without a bias shadows half of every lit surface of a map of [`Stored::First`].
///
/// [`Stored::name`] is the word that recipes and files use; `Display` writes the same thing for people.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Stored {
    /// The nearest surface ([`First`](crate::First); Williams 1978, Reeves 1987). Also what a comparison sees of a map of all surfaces.
    #[default]
    First,
    /// The second surface, whichever way it faces ([`Second`](crate::Second); Wang & Molnar 1994).
    Second,
    /// The nearest surface that faces away from the light ([`BackFace`](crate::BackFace); Wang & Molnar 1994).
    BackFace,
    /// A depth between the two nearest surfaces ([`Midpoint`](crate::Midpoint); Woo 1992).
    Midpoint,
    /// None of these: the surface of a rule that is not published here. No preset expects it.
    Other,
}

impl Stored {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::First, Self::Second, Self::BackFace, Self::Midpoint, Self::Other];

    /// The word for it in recipes and files: `first`, `second`, `back-face`, `midpoint` or `other`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::First => "first",
            Self::Second => "second",
            Self::BackFace => "back-face",
            Self::Midpoint => "midpoint",
            Self::Other => "other",
        }
    }

    /// The one with this [`name`](Self::name); `None` for any other text.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|stored| stored.name() == name)
    }
}

impl fmt::Display for Stored {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::First => "nearest surfaces",
            Self::Second => "second surfaces",
            Self::BackFace => "back faces",
            Self::Midpoint => "midpoints",
            Self::Other => "surfaces chosen by a rule of its own",
        })
    }
}
