//! What a server needs from the program that draws.

use crate::{Ask, State};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The program that draws for the page. All functions may be called from any thread, [`picture`](Self::picture) and [`explanation`](Self::explanation) from
/// two at once.
pub trait Answers: Send + Sync + 'static {
    /// What the page has to know before its first request: JSON that it reads once.
    fn about(&self) -> String;

    /// The command lines that draw what a state shows, as JSON. Returns at once.
    ///
    /// # Errors
    /// [`Refusal::Wrong`] for an invalid state.
    fn lines(&self, state: &State) -> Result<String, Refusal>;

    /// A picture.
    ///
    /// # Errors
    /// [`Refusal`].
    fn picture(&self, ask: &Ask, stop: &Stop) -> Result<Picture, Refusal>;

    /// Why the state's pixel is as it is, as JSON.
    ///
    /// # Errors
    /// [`Refusal`].
    fn explanation(&self, state: &State, stop: &Stop) -> Result<String, Refusal>;
}

/// A picture for the page.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Picture {
    /// The bytes of a PNG file.
    pub png: Vec<u8>,
    /// Facts about it: JSON in one line of printable ASCII.
    pub about: String,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The request is invalid or impossible: a line that explains why.
    Wrong(String),
    /// [`Stop`] was set.
    Stopped,
}

/// Set once nobody waits for an answer any more. The drawing code reads it often.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Records that nobody waits.
    pub fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether nobody waits.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Succeeds while somebody waits.
    ///
    /// # Errors
    /// [`Refusal::Stopped`].
    pub fn check(&self) -> Result<(), Refusal> {
        if self.is_set() { Err(Refusal::Stopped) } else { Ok(()) }
    }
}
