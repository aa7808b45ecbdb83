//! What no crate can show alone: laws that run from scene to picture, and the example of the README.

#[doc = include_str!("../../README.md")]
#[cfg(doctest)]
pub struct Readme;
