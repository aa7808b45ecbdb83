//! A run of the catalogue's figures.

use crate::figure::{Context, Figure};
use std::path::PathBuf;
use umbrage_report::Report;

/// What a run makes and where it puts it.
pub struct Run<'a> {
    /// In the order of the gallery.
    pub figures: Vec<&'a Figure>,
    /// What every figure is asked.
    pub context: Context,
    /// Worker threads; `None` is one a core. Changes no bit.
    pub threads: Option<usize>,
    /// The folder that is filled.
    pub out: PathBuf,
}

impl Run<'_> {
    /// Makes what is not there yet, then writes report and gallery.
    ///
    /// # Errors
    /// When a figure fails or a file cannot be written.
    pub fn make(&self) -> anyhow::Result<Report> {
        let run = umbrage_report::Run {
            entries: self.figures.iter().map(|figure| figure.entry(&self.context)).collect(),
            quick: self.context.quick,
            settings: self.context.settings(),
            threads: self.threads,
            out: self.out.clone(),
        };
        run.make()
    }
}
