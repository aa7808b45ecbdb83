//! What any judged run writes: figures of pictures, plots, tables and numbers with their bounds, a verdict on each, a record
//! and a page to look at.
//!
//! An [`Entry`] says what a figure is called and how it is [made](Made). A [`Run`] makes its entries one after another into
//! a folder: a folder for each figure, `report.json`, `timings.json`, and `index.html`, which needs nothing from elsewhere.
//! A figure that was made by the same program with the same settings is kept, and a run of some figures leaves the others
//! on the page. [`show`] makes such a page of figures that are there already. This crate knows no paper and no scene.
//!
//! ```no_run
//! use umbrage_report::{Entry, Heading, Made, Measure, Run, Verdict, Words};
//!
//! let heading = Heading {
//!     id: "sum".into(),
//!     paper: "Trials".into(),
//!     title: "A sum".into(),
//!     claim: "Two and two are four.".into(),
//!     look: "Look at the sum.".into(),
//! };
//! let make = || Ok(Made { measures: vec![Measure::exactly("2 + 2", 2.0 + 2.0, "", 4.0)], ..Made::default() });
//! let entries = vec![Entry { heading, make: Box::new(make) }];
//! let run = Run { entries, words: Words::default(), quick: false, settings: String::new(), threads: None, only: Vec::new(), out: "target/trials".into() };
//! assert_eq!(run.make()?.count(Verdict::Reproduced), 1);
//! # Ok::<(), anyhow::Error>(())
//! ```
//!
//! This crate opens files in the run's own folder only. It has no features.

mod article;
pub mod diagram;
mod folder;
pub mod letters;
mod made;
mod measure;
mod page;
mod panel;
pub mod plot;
mod record;
mod run;
mod shown;
pub mod text;

pub use made::{Made, Table, Verdict};
pub use measure::{Bound, Kind, Measure};
pub use page::Words;
pub use panel::{Panel, Role};
pub use record::{FigureRecord, Heading, MeasureRecord, PanelRecord, Report, TableRecord};
pub use run::{Entry, Run, summary};
pub use shown::show;
