use crate::timing::wall_seconds;
use std::fmt;

/// Something that was measured of a point. As text it is three fields with tabs between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// What.
    pub what: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// How much.
    pub value: f64,
}

impl Quantity {
    /// The wall time of something, and what came of it.
    pub(super) fn timed<T>(what: &'static str, run: impl FnOnce() -> T) -> (Self, T) {
        let (mut run, mut result) = (Some(run), None);
        let seconds = wall_seconds(&mut || result = run.take().map(|run| run()));
        (Self { what, unit: "s", value: seconds }, result.expect("it ran"))
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\t{}\t{:.6}", self.what, self.unit, self.value)
    }
}
