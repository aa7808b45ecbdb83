//! The scene that a command is about.

use crate::args::SceneArgs;
use crate::memory::Need;
use crate::names;
use crate::shell::{Shell, Usage};
use anyhow::{Context, anyhow};
use glam::{DVec2, UVec2};
use std::path::Path;
use umbrage_io::read_bytes;
use umbrage_plane::{Projection, View, ViewError};
use umbrage_recipe::Recipe;
use umbrage_scene::{Scene, gallery};

/// Rows of a picture whose size is not given.
const HEIGHT: u32 = 512;

/// A light of a scene, and the views in which it has maps.
pub struct Lamp {
    /// Which of the scene's lights it is.
    pub light: usize,
    /// Its name in names of files.
    pub name: String,
    /// The views that its maps have: one, or several that stand around it.
    pub views: Vec<View>,
}

/// A scene with its camera and maps as the command line wants them.
pub struct Stage {
    pub scene: Scene,
    /// The lights that cast shadows and are wanted.
    pub lamps: Vec<Lamp>,
    /// How many lights cast shadows, wanted or not.
    pub casting: usize,
    /// What the command line names; otherwise each light has its own, or else the default.
    pub recipe: Option<Recipe>,
}

impl Stage {
    /// The scene that is asked for. `samples` are those of each pixel of a picture, 0 where none is drawn.
    ///
    /// # Errors
    /// One line that says what is wrong with the scene or with what was asked of it.
    pub fn new(args: &SceneArgs, max_memory: Option<u64>, samples: u32, shell: &mut Shell<'_>) -> anyhow::Result<Self> {
        let Some(name) = args.scene.strip_prefix("gallery:") else {
            return Err(Usage(format!("scene {:?}: expected gallery:NAME", args.scene)).into());
        };
        let Some((_, make)) = gallery::ALL.iter().find(|(known, _)| *known == name) else {
            return Err(Usage(format!("scene gallery:{name} is not known; `umbrage scenes` lists them")).into());
        };
        let mut scene = make();
        let aspect = f64::from(scene.camera.size().x) / f64::from(scene.camera.size().y);
        let size =
            args.size.unwrap_or_else(|| UVec2::new((f64::from(HEIGHT) * aspect).round().max(1.0) as u32, HEIGHT));
        scene.camera = sized(&scene.camera, size).with_context(|| format!("--size {} x {}", size.x, size.y))?;
        for light in &mut scene.lights {
            light.view = light.view.with_size(UVec2::splat(args.map_size)).context("--map-size")?;
        }
        let recipe = args.recipe.as_deref().map(|text| recipe(text, args.map_size)).transpose()?;
        let lamps = lamps(&scene, &args.light)?;
        let casting = scene.lights.iter().filter(|light| light.casts).count();
        let triangles = scene.objects.iter().map(|object| match &object.shape {
            umbrage_scene::Shape::Mesh(mesh) => mesh.triangles.len() as u64,
            // Patches are diced to about one piece for each pixel that they cover.
            umbrage_scene::Shape::Patches(patches) => patches.len() as u64,
        });
        let maps: u64 = lamps.iter().map(|lamp| lamp.views.len() as u64).sum();
        let picture = if samples == 0 { UVec2::ZERO } else { size };
        let texels = maps * u64::from(args.map_size).pow(2);
        Need { file_bytes: 0, picture, samples, triangles: triangles.sum(), texels }.check(max_memory)?;
        if shell.verbose {
            let outside = lamps.iter().flat_map(|lamp| scene.casters_outside(&scene.lights[lamp.light].view));
            for object in outside {
                shell.note(&format!("note: {:?} reaches beyond a light's map", scene.objects[object as usize].name));
            }
        }
        Ok(Self { scene, lamps, casting, recipe })
    }

    /// The light's part of a file's name: nothing where the scene has one light that casts.
    pub fn part<'a>(&self, lamp: &'a Lamp) -> Option<&'a str> {
        (self.casting > 1).then_some(lamp.name.as_str())
    }

    /// The recipe of a light: the command line's, or that of its own tree, or the default.
    ///
    /// # Errors
    /// A recipe of the tree that cannot be read.
    pub fn recipe_of(&self, lamp: &Lamp) -> anyhow::Result<Recipe> {
        if let Some(recipe) = self.recipe {
            return Ok(recipe);
        }
        let light = &self.scene.lights[lamp.light];
        match light.tree.as_ref().and_then(|tree| tree.recipe()) {
            Some(text) if !text.is_empty() => text.parse().with_context(|| format!("light {:?}", light.name)),
            _ => Ok(Recipe::default()),
        }
    }
}

/// The camera with another size: what it sees from top to bottom stays, and its pixels keep their shape.
fn sized(camera: &View, size: UVec2) -> Result<View, ViewError> {
    let aspect = |size: UVec2| f64::from(size.x) / f64::from(size.y);
    let wider = aspect(size) / aspect(camera.size());
    let projection = match camera.projection() {
        Projection::Perspective { k, shift } => Projection::Perspective { k: DVec2::new(k.x / wider, k.y), shift },
        Projection::Orthographic { half, shift } => {
            Projection::Orthographic { half: DVec2::new(half.x * wider, half.y), shift }
        }
    };
    let view = View::new(camera.world_to_eye(), projection, camera.near(), camera.far(), size)?;
    Ok(view.alike(camera))
}

/// The lights that cast shadows, those of them that are named where any are.
fn lamps(scene: &Scene, wanted: &[String]) -> anyhow::Result<Vec<Lamp>> {
    let names = names::distinct(scene.lights.iter().map(|light| light.name.as_str()));
    let casting = || scene.lights.iter().zip(&names).enumerate().filter(|(_, (light, _))| light.casts);
    if let Some(unknown) =
        wanted.iter().find(|name| !casting().any(|(_, (light, own))| light.name == **name || own == *name))
    {
        let known: Vec<&str> = casting().map(|(_, (_, own))| own.as_str()).collect();
        return Err(Usage(format!("--light {unknown:?}: the lights that cast shadows are {}", known.join(", "))).into());
    }
    let is_wanted =
        |light: &str, own: &str| wanted.is_empty() || wanted.iter().any(|name| name == light || name == own);
    let lamps = casting().filter(|(_, (light, own))| is_wanted(&light.name, own));
    Ok(lamps.map(|(light, (of, name))| Lamp { light, name: name.clone(), views: vec![of.view] }).collect())
}

/// A recipe as it is written, or as a TOML file holds it; `rsl,` and the parameters of that language's `shadow()` are one for maps of `map_size` texels a side.
///
/// # Errors
/// What is wrong with it, after the file's name where it is one.
pub fn recipe(text: &str, map_size: u32) -> anyhow::Result<Recipe> {
    /// More than any table of fields.
    const MOST_BYTES: u64 = 1 << 20;
    let path = Path::new(text);
    if path.extension().is_none_or(|extension| extension != "toml") {
        let read = match text.strip_prefix("rsl,") {
            Some(parameters) => Recipe::from_rsl(parameters, map_size),
            None => text.parse(),
        };
        return read.map_err(|error| Usage(format!("--recipe: {error}")).into());
    }
    let text = String::from_utf8(read_bytes(path, MOST_BYTES)?).map_err(|_| anyhow!("{}: not text", path.display()))?;
    Recipe::from_toml(&text).with_context(|| path.display().to_string())
}
