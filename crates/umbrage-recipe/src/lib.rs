//! Shadow algorithms by name.
//!
//! A [`Recipe`] is a line of text or a TOML table that names a preset and what differs from it. It bakes the map that it needs from any triangles, and binds
//! its filter over a map. Everything that can be written is in one table of [`Field`]s.
//!
//! ```
//! use umbrage_recipe::{Field, PresetName, Recipe};
//!
//! let recipe: Recipe = "woo92,samples=32".parse()?;
//! assert_eq!(recipe.preset(), PresetName::Woo92);
//! let samples = Field::of(PresetName::Woo92).find(|field| field.name == "samples").unwrap();
//! assert_eq!(samples.kind.to_string(), "a whole number from 1 to 65536");
//! assert_eq!(samples.default(PresetName::Woo92).as_deref(), Some("16"));
//! # Ok::<(), umbrage_recipe::RecipeError>(())
//! ```
//!
//! A filter made by hand is put over a map by [`bind`]. The [guide] leads from a renderer to shadows, by this crate and those below it.
//!
//! The [conventions](umbrage_plane#conventions) are those of `umbrage-plane`. This crate knows no scene and opens no file. It has no features.

mod bake;
mod bind;
mod engine;
mod error;
mod field;
mod fields;
mod groups;
#[doc = include_str!("../GUIDE.md")]
pub mod guide {}
mod kind;
mod light;
mod moments;
mod pattern;
mod preset;
mod reach;
mod recipe;
mod rsl;
mod settings;
mod table;
#[cfg(test)]
mod tests;
mod text;
mod values;

pub use bind::bind;
pub use error::RecipeError;
pub use field::Field;
pub use kind::Kind;
pub use light::{Keeps, LightMap, LightShadow, LightUse};
pub use preset::PresetName;
pub use recipe::Recipe;
pub use table::{help, markdown};
