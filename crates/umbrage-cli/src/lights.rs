//! The lights of a scene that cast shadows.

use crate::shell::Usage;
use umbrage_plane::View;
use umbrage_scene::Scene;

/// A light of a scene, and the views in which it has maps.
#[derive(Clone)]
pub struct Lamp {
    /// Which of the scene's lights it is.
    pub light: usize,
    /// Its name in names of files.
    pub name: String,
    /// The views that its maps have: one, or several that stand around it.
    pub views: Vec<View>,
    /// Its radius: world units, of a sun radians; 0 where it has none.
    pub radius: f64,
}

impl Lamp {
    /// Whether a name is the light's own, or the one that it has in names of files.
    pub fn is_called(&self, scene: &Scene, name: &str) -> bool {
        self.name == name || scene.lights[self.light].name == name
    }

    /// The views that a judge and a recipe are given. A spot too wide for one map is split by the recipe; one view of it knows its cone.
    pub fn whole_views<'a>(&'a self, scene: &'a Scene) -> &'a [View] {
        let view = &scene.lights[self.light].view;
        if view.cone().is_some() { std::slice::from_ref(view) } else { &self.views }
    }
}

/// The lights that cast shadows and are named, or all of them where none is named.
///
/// # Errors
/// A name that no light has.
pub fn wanted(scene: &Scene, mut lamps: Vec<Lamp>, wanted: &[String]) -> anyhow::Result<Vec<Lamp>> {
    for name in wanted {
        check_name("--light", scene, &lamps, name)?;
    }
    lamps.retain(|lamp| wanted.is_empty() || wanted.iter().any(|name| lamp.is_called(scene, name)));
    Ok(lamps)
}

/// Succeeds if one of the lights has this name.
///
/// # Errors
/// One line with the names that there are; `option` is what the name was given by.
pub fn check_name(option: &str, scene: &Scene, lamps: &[Lamp], name: &str) -> anyhow::Result<()> {
    if lamps.iter().any(|lamp| lamp.is_called(scene, name)) {
        return Ok(());
    }
    let known: Vec<&str> = lamps.iter().map(|lamp| lamp.name.as_str()).collect();
    Err(Usage(format!("{option} {name:?}: the lights that cast shadows are {}", known.join(", "))).into())
}
