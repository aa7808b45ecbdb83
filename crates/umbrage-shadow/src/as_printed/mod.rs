//! The printed listings as they stand, misprints included, for the errata figures and their tests only.
//!
//! Their behaviour is reproduced, without the garbled characters of the scans, and without panics or divisions by zero.
//!
//! * Reeves, Salesin & Cook 1987, Fig. 4: [`sample_shadow`] and what it takes.
//! * Wang & Molnar 1994, Fig. 10: [`percent_illumination`].
//! * Burley 2006: [`sample_depth`], [`soft_radius`], [`sample_blur`], [`soft_shadow`].

mod burley;
mod reeves;
mod wang_molnar;

pub use burley::{BurleyListing, Sample, sample_blur, sample_depth, soft_radius, soft_shadow};
pub use reeves::{Counts, FootprintConvention, Listing, RandRange, TextureRect, counts, sample_shadow};
pub use wang_molnar::{Division, percent_illumination};
