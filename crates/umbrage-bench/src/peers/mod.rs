//! Other ways to the same answers, in the same program: compiled with the same flags, run in turn with ours.
//!
//! | peer | what it is | beside |
//! |---|---|---|
//! | [`software`] | `euc`, a software rasteriser with a depth buffer of f32 | pass 1 |
//! | [`memory`] | clearing a buffer and a minimum over it for each layer | pass 1 |
//! | [`listing`] | the listing of Reeves 1987, one tap after another | look-ups |
//! | [`rays`] | shadow rays with `obvhs` | the whole job |

pub mod listing;
pub mod memory;
pub mod rays;
pub mod software;
