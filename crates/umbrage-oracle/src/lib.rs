//! Truth by ray casting, and the measures of shadow faults.
