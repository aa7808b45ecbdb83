//! What every filter keeps, whoever wrote it. [`EVERY`] are the laws; each takes a [`Subject`] and says what is wrong.
//!
//! A filter of one's own joins by one line:
//!
//! ```
//! use umbrage_tests::laws::{self, Subject};
//! use umbrage_tests::outside::Variance;
//!
//! laws::hold(&Subject::new("variance", Variance::default())).unwrap();
//! ```
//!
//! Storages and compared depths have a law of their own, [`culling`]: what ranges settle is what taps would have said.

mod batches;
mod culling;
mod deep;
mod filters;
mod maps;
mod places;
mod subject;

pub use culling::culling;
pub use filters::{every_filter, prefiltered, thinning};
pub use maps::{baked, receivers};
pub use subject::{Found, KEY, Subject};

/// A law: its name, and whether a filter keeps it.
pub type Law = (&'static str, fn(&Subject) -> Found);

/// Every law.
pub const EVERY: &[Law] = &[
    ("places outside the map and the cone answer by the view's rules", places::outside),
    ("dark rules never lighten", places::dark_rules),
    ("parallel light does not depend on where its eye stands", places::slid),
    ("an empty map is lit and a full one dark", places::empty_and_full),
    ("opaque surfaces of a deep map are those of a plain one", deep::opaque),
    ("a veil passes its fraction, in colour too", deep::veil),
    ("every storage and every machine gives the same bits", maps::storages),
    ("answers lie within 0 and 1", maps::bounded),
    ("receivers are placed, culled or sampled, and watching changes nothing", batches::counts),
    ("a batch is its points one by one, on any thread", batches::splits),
];

/// Holds a filter against every law.
///
/// # Errors
/// The first law that it breaks, and how.
pub fn hold(subject: &Subject) -> Found {
    hold_but(subject, &[])
}

/// Holds a filter against every law but some, given by their names.
///
/// # Errors
/// The first law that it breaks, and how.
pub fn hold_but(subject: &Subject, but: &[&str]) -> Found {
    let mut laws = EVERY.iter().filter(|(law, _)| !but.contains(law));
    laws.try_for_each(|(law, holds)| holds(subject).map_err(|how| format!("{}: {law}: {how}", subject.name)))
}
