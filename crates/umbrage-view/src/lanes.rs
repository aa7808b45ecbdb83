//! The order in which requests are drawn.

use crate::Stop;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::{Semaphore, SemaphorePermit};

/// Most requests that wait to be drawn; further ones are refused.
const MOST_WAITING: usize = 128;

/// One lane for pictures that are drawn at once, one for those that take long; one picture at a time in each.
pub struct Lanes {
    waiting: Arc<Semaphore>,
    quick: Arc<Semaphore>,
    slow: Arc<Semaphore>,
    now: Arc<Mutex<Now>>,
}

/// What is being drawn.
#[derive(Default)]
struct Now {
    /// How many quick pictures are being drawn or waited for.
    quick: usize,
    /// What stops the slow one.
    slow: Stop,
}

/// A quick picture that is being drawn or waited for, until this is dropped.
struct Quick(Arc<Mutex<Now>>);

impl Quick {
    fn begin(now: &Arc<Mutex<Now>>) -> Self {
        let mut all = lock(now);
        all.quick += 1;
        all.slow.set();
        Self(Arc::clone(now))
    }
}

impl Drop for Quick {
    fn drop(&mut self) {
        lock(&self.0).quick -= 1;
    }
}

fn lock(now: &Mutex<Now>) -> MutexGuard<'_, Now> {
    now.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Sets a [`Stop`] when it is dropped: whoever waited has gone away, or has been answered.
pub struct StopAtEnd(pub Stop);

impl Drop for StopAtEnd {
    fn drop(&mut self) {
        self.0.set();
    }
}

impl Lanes {
    pub fn new() -> Self {
        let one = || Arc::new(Semaphore::new(1));
        Self { waiting: Arc::new(Semaphore::new(MOST_WAITING)), quick: one(), slow: one(), now: Arc::default() }
    }

    /// A place among the waiting requests; `None` where there are too many.
    pub fn enter(&self) -> Option<SemaphorePermit<'_>> {
        self.waiting.try_acquire().ok()
    }

    /// Runs the drawing on a thread of its own once it is its turn; `None` where it panicked. A quick picture stops the slow one that is being drawn.
    pub async fn run<T: Send + 'static>(
        &self,
        is_slow: bool,
        stop: &Stop,
        draw: impl FnOnce() -> T + Send + 'static,
    ) -> Option<T> {
        let quick = (!is_slow).then(|| Quick::begin(&self.now));
        let lane = if is_slow { &self.slow } else { &self.quick };
        let place = Arc::clone(lane).acquire_owned().await.ok()?;
        if is_slow {
            let mut now = lock(&self.now);
            now.slow = stop.clone();
            if now.quick > 0 {
                stop.set();
            }
        }
        let work = move || {
            let drawn = draw();
            // The next one begins only when this one has ended, whether anybody still waits for it or not.
            drop((place, quick));
            drawn
        };
        tokio::task::spawn_blocking(work).await.ok()
    }
}
