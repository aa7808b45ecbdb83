//! The numbers of what is compared with truth, and their limits.

mod limits;
mod row;

pub use limits::{Limits, limits};
pub use row::{Made, NUMBERS, Number, Row, SHOWN, rounded};
