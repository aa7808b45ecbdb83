//! One picture of a figure.

use glam::{UVec2, Vec3};
use serde::{Deserialize, Serialize};

/// What a panel is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// A method's picture.
    Result,
    /// Ray-traced truth.
    Truth,
    /// Difference from truth as colours.
    Error,
    /// A depth map or other material.
    Map,
}

/// One picture of a figure, linear light.
#[derive(Clone, Debug)]
pub struct Panel {
    /// File stem, unique in its figure.
    pub name: String,
    /// What is seen.
    pub caption: String,
    /// Parameters under the picture.
    pub parameters: Vec<(String, String)>,
    /// Pixels.
    pub size: UVec2,
    /// Linear RGB, rows from the top.
    pub pixels: Vec<Vec3>,
    /// Each pixel is written as `zoom` × `zoom` (R87's figures are zooms).
    pub zoom: u32,
    /// What it is for.
    pub role: Role,
    /// Name of the truth panel that it can be wiped against.
    pub against: Option<String>,
}

impl Panel {
    /// A colour picture.
    pub fn rgb(name: &str, caption: &str, size: UVec2, pixels: Vec<Vec3>) -> Self {
        Self {
            name: name.into(),
            caption: caption.into(),
            parameters: Vec::new(),
            size,
            pixels,
            zoom: 1,
            role: Role::Result,
            against: None,
        }
    }

    /// A grey picture: 0 black, 1 white.
    pub fn grey(name: &str, caption: &str, size: UVec2, values: Vec<f32>) -> Self {
        Self::rgb(name, caption, size, values.into_iter().map(Vec3::splat).collect())
    }

    /// Adds a parameter.
    #[expect(clippy::needless_pass_by_value, reason = "callers hand over literals")]
    pub fn with(mut self, name: &str, value: impl ToString) -> Self {
        self.parameters.push((name.into(), value.to_string()));
        self
    }

    /// Says what it is for.
    pub fn role(mut self, role: Role) -> Self {
        self.role = role;
        self
    }

    /// Enlarges it by pixel replication.
    pub fn zoom(mut self, zoom: u32) -> Self {
        self.zoom = zoom;
        self
    }

    /// Names the truth panel it is compared with.
    pub fn against(mut self, truth: &str) -> Self {
        self.against = Some(truth.into());
        self
    }
}
