//! Patterns by name.

/// Where the map is looked up.
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
