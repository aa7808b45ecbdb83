//! The scene that a command is about.

use crate::args::SceneArgs;
use crate::lights::{self, Lamp};
use crate::memory::{self, Need};
use crate::names;
use crate::shell::{Shell, Usage};
use crate::turns;
use anyhow::{Context, anyhow};
use glam::{DVec2, UVec2};
use std::path::Path;
use umbrage_gltf::{Level, ReadOptions};
use umbrage_io::read_bytes;
use umbrage_plane::{Projection, View, ViewError};
use umbrage_recipe::{Recipe, RecipeError};
use umbrage_scene::{Scene, gallery};

/// The prefix of the name of a built-in scene.
pub const GALLERY: &str = "gallery:";

/// Rows of a picture whose size is not given.
const HEIGHT: u32 = 512;

/// A scene with its camera and maps as given on the command line.
pub struct Stage {
    pub scene: Scene,
    /// The lights that cast shadows and are wanted.
    pub lamps: Vec<Lamp>,
    /// How many lights cast shadows, wanted or not.
    pub casting: usize,
    /// What the command line names; otherwise each light has its own, or else the default.
    pub recipe: Option<Recipe>,
    /// The value of `--max-memory`, bytes.
    pub max_memory: Option<u64>,
    /// What all this and its maps may take.
    pub need: Need,
}

impl Stage {
    /// The scene of a file or of the gallery, by `source`. `samples` are those of each pixel of a picture, 0 where none is drawn.
    ///
    /// # Errors
    /// One line that says what is wrong with the scene or with what is required of it; also when it needs more than `max_memory`.
    pub fn new(
        source: &str,
        args: &SceneArgs,
        max_memory: Option<u64>,
        samples: u32,
        shell: &mut Shell<'_>,
    ) -> anyhow::Result<Self> {
        let stage = Self::unchecked(source, args, max_memory, samples, shell)?;
        stage.need.check(max_memory)?;
        Ok(stage)
    }

    /// The same however much memory it needs.
    ///
    /// # Errors
    /// One line that says what is wrong with the scene or with what is required of it.
    pub fn unchecked(
        source: &str,
        args: &SceneArgs,
        max_memory: Option<u64>,
        samples: u32,
        shell: &mut Shell<'_>,
    ) -> anyhow::Result<Self> {
        let (mut scene, lamps) = match source.strip_prefix(GALLERY) {
            Some(name) => built_in(name, args)?,
            None => from_file(source, args, max_memory, shell)?,
        };
        let size = scene.camera.size();
        let recipe = args.recipe.as_deref().map(|text| recipe(text, args.map_size)).transpose()?;
        let mut lamps = casting(&scene, lamps);
        turns::turn(&mut scene, &mut lamps, &args.turn_light)?;
        let lamps = lights::wanted(&scene, lamps, &args.light)?;
        let casting = scene.lights.iter().filter(|light| light.casts).count();
        let triangles = scene.objects.iter().map(|object| match &object.shape {
            umbrage_scene::Shape::Mesh(mesh) => mesh.triangles.len() as u64,
            // Patches are diced to about one piece for each pixel that they cover.
            umbrage_scene::Shape::Patches(patches) => patches.len() as u64,
        });
        let maps: u64 = lamps.iter().map(|lamp| lamp.views.len() as u64).sum();
        let picture = if samples == 0 { UVec2::ZERO } else { size };
        let texels = maps * u64::from(args.map_size).pow(2);
        let need = Need { picture, samples, triangles: triangles.sum(), texels, ..Need::default() };
        if shell.verbose {
            // Several views together cover every direction.
            for lamp in lamps.iter().filter(|lamp| lamp.views.len() == 1) {
                let light = &scene.lights[lamp.light];
                for object in scene.casters_outside(&light.view) {
                    let object = &scene.objects[object as usize].name;
                    shell.note(&format!("note: {object:?} reaches beyond the map of the light {:?}", light.name));
                }
            }
        }
        Ok(Self { scene, lamps, casting, recipe, max_memory, need })
    }

    /// The same with maps of this many texels per side.
    ///
    /// # Errors
    /// A size that a light's view cannot have.
    pub fn resize(&mut self, map_size: u32) -> anyhow::Result<()> {
        let size = UVec2::splat(map_size);
        for lamp in &mut self.lamps {
            let light = &mut self.scene.lights[lamp.light];
            for view in lamp.views.iter_mut().chain([&mut light.view]) {
                *view = view.with_size(size).context("--map-size")?;
            }
        }
        Ok(())
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
pub fn sized(camera: &View, size: UVec2) -> Result<View, ViewError> {
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

/// A scene of the gallery, and the views of its lights' maps.
fn built_in(name: &str, args: &SceneArgs) -> anyhow::Result<(Scene, Vec<umbrage_gltf::Lamp>)> {
    let Some((_, make)) = gallery::ALL.iter().find(|(known, _)| *known == name) else {
        return Err(Usage(format!("scene gallery:{name} is not known; `umbrage scenes` lists them")).into());
    };
    if args.camera.is_some() || args.time.is_some() {
        return Err(Usage("--camera and --time: built-in scenes have one camera and stand still".into()).into());
    }
    let mut scene = make();
    let aspect = f64::from(scene.camera.size().x) / f64::from(scene.camera.size().y);
    let size = args.size.unwrap_or_else(|| UVec2::new((f64::from(HEIGHT) * aspect).round().max(1.0) as u32, HEIGHT));
    scene.camera = sized(&scene.camera, size).with_context(|| format!("--size {} x {}", size.x, size.y))?;
    for light in &mut scene.lights {
        light.view = light.view.with_size(UVec2::splat(args.map_size)).context("--map-size")?;
    }
    let lamps = scene.lights.iter().map(|light| umbrage_gltf::Lamp { views: vec![light.view], radius: 0.0 }).collect();
    Ok((scene, lamps))
}

/// A scene from a file, whose reader's notes are passed on.
fn from_file(
    source: &str,
    args: &SceneArgs,
    max_memory: Option<u64>,
    shell: &mut Shell<'_>,
) -> anyhow::Result<(Scene, Vec<umbrage_gltf::Lamp>)> {
    let path = Path::new(source);
    let known = |extension: &std::ffi::OsStr| ["glb", "gltf"].iter().any(|known| extension.eq_ignore_ascii_case(known));
    if !path.extension().is_some_and(known) {
        return Err(Usage(format!("scene {source:?}: expected a .glb or .gltf file, or gallery:NAME")).into());
    }
    let options = ReadOptions::default()
        .with_size(args.size)
        .with_map_size(args.map_size)
        .with_camera(args.camera.clone())
        .with_time(args.time)
        .with_animation(args.animation.clone())
        .with_max_bytes(max_memory.unwrap_or_else(memory::default));
    let import = umbrage_gltf::read(path, &options)?;
    for note in &import.notes {
        if shell.verbose || note.level == Level::Always {
            shell.note(&format!("note: {note}"));
        }
    }
    Ok((import.scene, import.lamps))
}

/// The lights that cast shadows.
fn casting(scene: &Scene, lamps: Vec<umbrage_gltf::Lamp>) -> Vec<Lamp> {
    let names = names::distinct(scene.lights.iter().map(|light| light.name.as_str()));
    let lamp = |(light, lamp): (usize, umbrage_gltf::Lamp)| {
        let one = || Lamp { light, name: names[light].clone(), views: lamp.views, radius: lamp.radius };
        scene.lights[light].casts.then(one)
    };
    lamps.into_iter().enumerate().filter_map(lamp).collect()
}

/// A recipe from its text, or from a TOML file; `rsl,` and the parameters of that language's `shadow()` are one for maps of `map_size` texels per side.
///
/// # Errors
/// What is wrong with it, after the file's name where it is one.
pub fn recipe(text: &str, map_size: u32) -> anyhow::Result<Recipe> {
    /// More than any table of fields.
    const MOST_BYTES: u64 = 1 << 20;
    let path = Path::new(text);
    if path.extension().is_none_or(|extension| extension != "toml") {
        return recipe_text(text, map_size).map_err(|error| Usage(format!("--recipe: {error}")).into());
    }
    let text = String::from_utf8(read_bytes(path, MOST_BYTES)?).map_err(|_| anyhow!("{}: not text", path.display()))?;
    Recipe::from_toml(&text).with_context(|| path.display().to_string())
}

/// The same of text alone.
///
/// # Errors
/// What is wrong with it.
pub fn recipe_text(text: &str, map_size: u32) -> Result<Recipe, RecipeError> {
    match text.strip_prefix("rsl,") {
        Some(parameters) => Recipe::from_rsl(parameters, map_size),
        None => text.parse(),
    }
}
