//! What no crate can show alone: laws that every filter keeps, laws that run from scene to picture, and the example of the README.

pub mod laws;
pub mod outside;

#[doc = include_str!("../../README.md")]
#[cfg(doctest)]
pub struct Readme;
