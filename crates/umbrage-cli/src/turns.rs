//! Lights that are turned.

use crate::lights::{self, Lamp};
use crate::values::TurnLight;
use anyhow::Context;
use umbrage_plane::{View, ViewError, cube_views};
use umbrage_scene::Scene;

/// Views of a lamp that shines all around.
const AROUND: usize = 6;

/// Turns lights that cast shadows, and the views of their maps; of several turns of a light the last one counts.
///
/// # Errors
/// A name that no light has, or an impossible view.
pub fn turn(scene: &mut Scene, lamps: &mut [Lamp], turns: &[TurnLight]) -> anyhow::Result<()> {
    for turn in turns {
        lights::check_name("--turn-light", scene, lamps, &turn.name)?;
    }
    for lamp in lamps {
        let Some(turn) = turns.iter().rfind(|turn| lamp.is_called(scene, &turn.name)) else { continue };
        let turned = scene.turned(&scene.lights[lamp.light].view, turn.to);
        let views = turned.and_then(|view| Ok((view, views(&view, &lamp.views)?)));
        let (view, views) = views.with_context(|| format!("--turn-light {turn}"))?;
        scene.lights[lamp.light].view = view;
        lamp.views = views;
    }
    Ok(())
}

/// The views of the maps of a light whose own view was turned.
fn views(own: &View, before: &[View]) -> Result<Vec<View>, ViewError> {
    match before {
        [_] => Ok(vec![*own]),
        [first, ..] if before.len() == AROUND => {
            let eye = own.light().truncate();
            Ok(cube_views(eye, own.near(), own.far(), first.size().x)?.to_vec())
        }
        _ => Ok(own.faces_ahead()?.to_vec()),
    }
}
