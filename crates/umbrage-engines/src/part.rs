use std::fmt;

/// A part of a [`WorldBias`](crate::WorldBias).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// [`WorldBias::constant`](crate::WorldBias#structfield.constant).
    Constant,
    /// [`WorldBias::slope`](crate::WorldBias#structfield.slope).
    Slope,
    /// [`WorldBias::normal`](crate::WorldBias#structfield.normal).
    Normal,
}

impl Part {
    /// All of them, in the order of [`WorldBias`](crate::WorldBias).
    pub const ALL: [Self; 3] = [Self::Constant, Self::Slope, Self::Normal];
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Constant => "constant",
            Self::Slope => "slope",
            Self::Normal => "normal",
        })
    }
}
