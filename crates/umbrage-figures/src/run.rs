//! A run of the catalogue's figures.

use crate::catalogue;
use crate::figure::{Context, Figure};
use std::path::PathBuf;
use umbrage_report::Report;

/// What a run makes and where it puts it.
pub struct Run<'a> {
    /// Those that are made, in the order of the gallery.
    pub figures: Vec<&'a Figure>,
    /// The settings that every figure is made with.
    pub context: Context,
    /// Worker threads; `None` is one per core. Changes no bit.
    pub threads: Option<usize>,
    /// The folder that is filled.
    pub out: PathBuf,
}

impl Run<'_> {
    /// Makes what is not there yet, and writes report and gallery; figures of the catalogue that the folder holds already
    /// stay in both. The report that is returned holds the run's own figures only.
    ///
    /// # Errors
    /// When a figure fails or a file cannot be written.
    pub fn make(&self) -> anyhow::Result<Report> {
        let run = umbrage_report::Run {
            entries: catalogue::figures().map(|figure| figure.entry(&self.context)).collect(),
            words: catalogue::words(),
            only: self.figures.iter().map(|figure| figure.id.into()).collect(),
            quick: self.context.quick,
            settings: self.context.settings(),
            threads: self.threads,
            out: self.out.clone(),
        };
        run.make()
    }
}
