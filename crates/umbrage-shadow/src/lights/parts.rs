//! Large batches, split over threads.

use super::same_length;
use umbrage_plane::SurfacePoint;

/// Points per part: enough that starting a part costs little in comparison.
#[cfg(feature = "rayon")]
const PART: usize = 2048;

/// Calls `work` with all points and the results that it writes: with the feature `rayon`, part by part on the threads of the current pool
/// where there are two parts or more. What is written must depend on each point alone, so that it is the same for any number of threads.
///
/// # Panics
/// As [`same_length`].
#[inline(always)]
pub(super) fn in_parts(at: &[SurfacePoint], out: &mut [f32], work: impl Fn(&[SurfacePoint], &mut [f32]) + Sync) {
    same_length(at, out);
    #[cfg(feature = "rayon")]
    if at.len() >= 2 * PART && rayon::current_num_threads() > 1 {
        use rayon::prelude::*;
        at.par_chunks(PART).zip(out.par_chunks_mut(PART)).for_each(|(at, out)| work(at, out));
        return;
    }
    work(at, out);
}
