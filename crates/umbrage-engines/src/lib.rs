//! What the shadow-bias settings of renderers, engines and graphics interfaces mean in world units, and which settings give a
//! wanted bias: data and pure formulas, each with its public source.
//!
//! An [`Engine`] says [what it is](Engine::about): its settings with their units and defaults, its filter, and the sources and
//! versions that were read. [`Engine::world`] turns its settings into a [`WorldBias`], [`Engine::settings`] turns a wanted
//! [`WorldBias`] into its settings, and names every part that it cannot express. Both are exact for the
//! [`Conditions`] that are given: a light's projection, its map, and a receiver in it.
//!
//! ```
//! use umbrage_engines::{Conditions, Engine, WorldBias};
//!
//! // The sun over twenty metres, 1024 texels, a range of a hundred metres; the ground is thirty metres away and
//! // tilted by sixty degrees.
//! let sun = Conditions::orthographic(20.0, 1024, 0.0, 100.0, 30.0)?.with_light_at(0.5);
//!
//! // Two centimetres along the light's direction are how much in three.js?
//! let three: Engine = "three".parse()?;
//! let wanted = WorldBias::constant(0.02);
//! let found = three.settings(&wanted, &sun)?;
//! assert!(found.unmet.is_empty());
//! let lines: Vec<String> = found.settings.iter().map(ToString::to_string).collect();
//! assert_eq!(lines, ["bias = -0.0002", "normalBias = 0"]);
//!
//! // And what do Filament's own defaults do there?
//! let filament = Engine::Filament.world(&[], &sun)?;
//! assert_eq!(filament.least.slope, 2.0);
//! # Ok::<(), umbrage_engines::EngineError>(())
//! ```
//!
//! | name | engine | settings | read in |
//! |---|---|---|---|
//! | `rsl` | RenderMan Shading Language, as Aqsis has it | `bias0`, `bias1` | source |
//! | `three` | three.js | `bias`, `normalBias` | source |
//! | `babylon` | Babylon.js | `bias`, `normalBias` | source |
//! | `filament` | Filament | `constantBias`, `normalBias`, `polygonOffsetConstant`, `polygonOffsetSlope` | source |
//! | `bevy` | Bevy | `shadow_depth_bias`, `shadow_normal_bias` | source |
//! | `godot` | Godot 4, Forward+ | `shadow_bias`, `shadow_normal_bias` | source |
//! | `urp` | Unity, Universal Render Pipeline | `depth bias`, `normal bias` | source |
//! | `hdrp` | Unity, High Definition Render Pipeline | `normalBias`, `slopeBias` | source |
//! | `unreal` | Unreal Engine | `ShadowBias`, `ShadowSlopeBias` | documentation; no public formula, so no numbers |
//! | `d3d` | Direct3D 11 and 12 | `DepthBias`, `SlopeScaledDepthBias`, `DepthBiasClamp` | documentation |
//! | `vulkan` | Vulkan | `depthBiasConstantFactor`, `depthBiasSlopeFactor`, `depthBiasClamp` | specification |
//! | `webgpu` | WebGPU | `depthBias`, `depthBiasSlopeScale`, `depthBiasClamp` | conformance tests |
//!
//! Engines move the receiver toward the light or the casters away from it; which of both is the same comparison. Where a map's
//! depth is not linear, a conversion holds at the receiver's distance: the same setting is a larger bias farther away.
//!
//! The [conventions](umbrage_plane#conventions) are those of `umbrage-plane`. This crate knows no map, no scene and no
//! file. It has no features.

#![warn(missing_debug_implementations)]

mod about;
mod bias;
mod conditions;
mod data;
mod engine;
mod error;
mod models;
mod part;
mod translation;

pub use about::{About, SettingInfo, Source};
pub use bias::{WorldBias, WorldRange};
pub use conditions::{Conditions, DepthFormat};
pub use engine::Engine;
pub use error::EngineError;
pub use part::Part;
pub use translation::{Setting, Translation, Unmet};
