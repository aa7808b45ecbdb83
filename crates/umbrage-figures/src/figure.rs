//! What a figure of the catalogue is, and the settings that a run makes it with.

use crate::stage::truths::Truths;
use umbrage_depth::Storage;
use umbrage_report::{Entry, Heading, Made};

/// Where a figure comes from; the gallery's order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Paper {
    /// Williams 1978.
    Williams78,
    /// Reeves, Salesin & Cook 1987.
    Reeves87,
    /// Woo 1992.
    Woo92,
    /// Wang & Molnar 1994.
    WangMolnar94,
    /// Burley 2006.
    Burley06,
    /// This project's own.
    Umbrage,
}

impl Paper {
    /// Authors and year.
    pub fn name(self) -> &'static str {
        match self {
            Self::Williams78 => "Williams 1978",
            Self::Reeves87 => "Reeves, Salesin & Cook 1987",
            Self::Woo92 => "Woo 1992",
            Self::WangMolnar94 => "Wang & Molnar 1994",
            Self::Burley06 => "Burley 2006",
            Self::Umbrage => "Umbrage",
        }
    }
}

/// One row of the catalogue.
pub struct Figure {
    /// The row's id without panel letters, such as `R87-F7`.
    pub id: &'static str,
    /// Its paper.
    pub paper: Paper,
    /// A few words.
    pub title: &'static str,
    /// What the figure must show: the paper's claim, in a sentence.
    pub claim: &'static str,
    /// What to look at: a sentence that begins with it, after "Look at".
    pub look: &'static str,
    /// Makes it.
    pub make: fn(&Context) -> anyhow::Result<Made>,
}

impl Figure {
    /// The figure as a run makes it.
    pub fn entry<'a>(&'a self, cx: &'a Context) -> Entry<'a> {
        let heading = Heading {
            id: self.id.into(),
            paper: self.paper.name().into(),
            title: self.title.into(),
            claim: self.claim.into(),
            look: self.look.into(),
        };
        Entry { heading, make: Box::new(|| (self.make)(cx)) }
    }
}

/// The settings of a run, the same for every figure.
#[derive(Clone, Debug, Default)]
pub struct Context {
    /// Smaller pictures and fewer samples.
    pub quick: bool,
    /// Seed of all randomness.
    pub seed: u32,
    /// How maps are kept while they are looked up. Changes no bit.
    pub storage: Storage,
    /// Truths that were made already.
    pub truths: Truths,
}

impl Context {
    /// The first in a full run, the second in a quick one.
    pub fn pick<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }

    /// What pictures and numbers depend on, as text. The storage changes none of them, which is what a run with another
    /// storage is there to show: it must not be given the old files.
    pub(crate) fn settings(&self) -> String {
        let Self { quick, seed, storage, truths: _ } = self;
        format!("quick {quick}, seed {seed}, storage {storage:?}")
    }
}
