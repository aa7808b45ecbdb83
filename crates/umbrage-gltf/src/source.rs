//! Lights as KHR_lights_punctual describes them, with what their extras add.

use crate::GltfError;
use crate::file::File;
use crate::json::At;
use crate::nodes::Nodes;
use crate::sight::Sight;
use crate::window::{Window, extra, size, window};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

const LIGHTS: &str = "KHR_lights_punctual";

/// How a light shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shines {
    /// Within a cone; half-angles of full light and of none, radians.
    Spot { inner: f64, outer: f64 },
    /// Everywhere.
    Point,
    /// Along parallel rays.
    Sun,
}

/// A light of the file, where it stands.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub name: Option<String>,
    pub path: String,
    pub sight: Sight,
    pub shines: Shines,
    /// Linear RGB times candela, or times lux for a sun.
    pub intensity: DVec3,
    /// Where its light ends, world units.
    pub range: Option<f64>,
    pub window: Option<Window>,
    /// World units, or radians for a sun.
    pub size: f64,
    pub casts: bool,
}

/// All lights that the scene shows.
pub(crate) fn sources(file: &File, nodes: &Nodes) -> Result<Vec<Source>, GltfError> {
    let all = file.root.extension(LIGHTS).map(|lights| lights.items("lights")).transpose()?.unwrap_or_default();
    let mut sources = Vec::new();
    for &number in &nodes.shown {
        let node = &nodes.all[number];
        let Some(holder) = node.at.extension(LIGHTS) else { continue };
        let light = holder.index("light", all.len(), "lights")?.and_then(|light| all.get(light));
        let light = light.ok_or_else(|| holder.wrong("light", "the number of a light"))?;
        file.budget.charge(&holder.path, 1, 1024)?;
        sources.push(source(&node.at, light, Sight::of(node.world, &node.at.path)?)?);
    }
    Ok(sources)
}

fn source(node: &At, light: &At, sight: Sight) -> Result<Source, GltfError> {
    let (shines, needed, kind) = match light.text("type")? {
        Some("spot") => (spot(light)?, "perspective", "a spot"),
        Some("point") => (Shines::Point, "perspective", "a point"),
        Some("directional") => (Shines::Sun, "orthographic", "a sun"),
        _ => return Err(light.wrong("type", "spot, point or directional")),
    };
    let colour = light.numbers("color")?.unwrap_or([1.0; 3]);
    if !colour.iter().all(|channel| (0.0..=1e6).contains(channel)) {
        return Err(light.wrong("color", "numbers from 0"));
    }
    let strength =
        light.number_in("intensity", 1.0, |number| (0.0..=1e30).contains(&number), "a number from 0 to 1e30")?;
    let range = match light.number("range")? {
        None => None,
        Some(_) => Some(light.number_in("range", 0.0, |range| range > 0.0, "world units above 0")?),
    };
    let casts = extra(node, light, "casts").map_or(Ok(true), |extras| extras.flag("casts", true))?;
    let name = node.name().or(light.name()).map(str::to_owned);
    Ok(Source {
        name,
        path: node.path.clone(),
        sight,
        shines,
        intensity: DVec3::from_array(colour) * strength,
        range,
        window: window(node, light, needed, kind)?,
        size: size(node, light, shines == Shines::Sun)?,
        casts,
    })
}

fn spot(light: &At) -> Result<Shines, GltfError> {
    let none = serde_json::Value::Null;
    // Every number of the cone has a default, and so has the cone.
    let spot = light.get("spot").unwrap_or(At { value: &none, path: light.path_of("spot") });
    let outer = spot.number_in(
        "outerConeAngle",
        FRAC_PI_4,
        |angle| angle > 0.0 && angle <= FRAC_PI_2 + 1e-6,
        "radians above 0, up to pi/2",
    )?;
    let least = "radians from 0, up to outerConeAngle";
    let inner = spot.number_in("innerConeAngle", 0.0, |angle| (0.0..=outer).contains(&angle), least)?;
    Ok(Shines::Spot { inner, outer: outer.min(FRAC_PI_2) })
}
