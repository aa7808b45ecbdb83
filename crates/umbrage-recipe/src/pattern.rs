//! Patterns by name.

/// Where one looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatternName {
    Jittered,
    Table,
    Uniform,
    Gaussian,
    Inside,
    Warp,
    Every,
    Tent,
    Centre,
    Disc,
    Castano5,
    Castano7,
    AreaTent,
    Vogel,
}
