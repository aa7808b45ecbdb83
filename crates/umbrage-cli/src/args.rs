//! The command line.

use crate::compare_args::CompareArgs;
use crate::values::{
    Area, Frames, MOST_PICTURES, Shard, TurnLight, area, frames, pixel, radius, samples, seconds, shard, size,
    tolerance, turn_light,
};
use clap::{Args, Parser, Subcommand, ValueEnum};
use glam::UVec2;
use std::path::PathBuf;
use std::str::FromStr;
use umbrage_depth::Storage;
use umbrage_engines::Engine;

/// Shadows of your own scenes: maps that need no bias, compared with ray-traced truth
#[derive(Parser)]
#[command(name = "umbrage", bin_name = "umbrage", version, propagate_version = true, max_term_width = 100)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
    /// Worker threads, one for each core unless given; changes no result
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Seed of all randomness
    #[arg(long, global = true, value_name = "N", default_value_t = 0)]
    pub seed: u32,
    /// Print what was done as JSON on stdout
    #[arg(long, global = true)]
    pub json: bool,
    /// Print nothing but errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Also report what was left alone and why
    #[arg(short, long, global = true)]
    pub verbose: bool,
    /// When to colour errors and help: auto is on a terminal, unless NO_COLOR is set
    #[arg(long, global = true, value_name = "WHEN", value_enum, default_value_t = clap::ColorChoice::Auto)]
    pub color: clap::ColorChoice,
    /// Most memory that may be used, such as 2GiB; 4 GiB or half of the machine's memory unless given
    #[arg(long, global = true, value_name = "SIZE", value_parser = crate::memory::parse)]
    pub max_memory: Option<u64>,
}

#[derive(Subcommand)]
pub enum Command {
    /// Draw the lit picture of a scene
    #[command(after_help = "Examples:
  umbrage render fixtures/scenes/suzi.glb -o suzi.png
  umbrage render gallery:spot-room --recipe woo92 --map-size 256 -o room.exr
  umbrage render gallery:table gallery:contact-box --frames 1..2 --size 96x72 -o frames/")]
    Render(RenderArgs),
    /// Draw the fraction in shadow alone, one picture for each light
    #[command(after_help = "Examples:
  umbrage shadow fixtures/scenes/bunny.glb --area --map-size 128 --size 96x72 -o shadows
  umbrage shadow gallery:three-lights --truth --size 128x128 --format exr -o truth
  umbrage shadow gallery:three-lights --size 96x72 --shard 1/2 -o shared")]
    Shadow(ShadowArgs),
    /// Judge recipes at several map sizes, or a shadow image of your own, against ray-traced truth: every fault by name
    #[command(after_help = "Exit codes: 0, and 3 where something is above what --fail-above allows.

Faults are fractions of the judged pixels: those that see one surface, inside the light's map and cone, that faces the light.
  false shadow  dark, and lit in truth
  false light   lit, and dark in truth
  acne          false shadow farther from truth's edges than the filter reaches: the surface shadows itself
  detachment    false light that is dark without the recipe's bias: the bias causes it
  leak          other false light farther from truth's edges than the filter reaches

Examples:
  umbrage compare gallery:contact-box --size 96x72 --samples 4 --map-size 128 -o compared
  umbrage compare gallery:table --recipe auto reeves87,bias=15 --map-size 128 256 --size 96x72 --fail-above rms=0.5,leak=5%
  umbrage compare gallery:three-lights --light red --size 128x128 --against truth/three-lights.red.exr --fail-above rms=0.02")]
    Compare(CompareArgs),
    /// Give pictures that were drawn by shards their names, once all of them are finished
    #[command(after_help = "The folder .parts in DIR is where shards leave them; it is removed.

Examples:
  umbrage render gallery:table gallery:contact-box --size 96x72 --shard 1/1 -o drawn/
  umbrage gather drawn")]
    Gather(GatherArgs),
    /// Print a job for a scheduler that draws a command line's pictures in N shards and then gathers them
    #[command(
        after_help = "Relative paths of an OpenJD template begin in its parameter Folder, which is the template's own folder unless given. A Slurm
script is run by sh, not by sbatch: it submits the shards as an array, and a job that gathers once all of them have succeeded.

Examples:
  umbrage jobs openjd 4 -- umbrage render fixtures/scenes/bend.glb --frames 1..48 -o bend/ > job.yaml
  umbrage jobs slurm 4 -- umbrage shadow 'shot.####.glb' --frames 1..240 --area -o shadows > job.sh"
    )]
    Jobs(JobsArgs),
    /// Write the shadow map of each light: one file for each, with one part, or with several around a light that one map cannot cover
    #[command(after_help = "Examples:
  umbrage bake gallery:contact-box -o maps
  umbrage bake gallery:three-lights --one-file --map-size 256 -o maps")]
    Bake(BakeArgs),
    /// Find the smallest bias that ends false shadow and the largest that keeps shadows at their casters, and print it in an
    /// engine's own settings
    #[command(
        after_help = "Every pixel of the camera that sees one surface facing the light is compared with rays. False shadow is the mean shadow on pixels whose
surroundings are lit for as far as the filter reaches, false light the mean light on pixels in shadow, minus what the filter alone
leaves there. Engines' settings are exact for the receiver in the middle of the judged ones; umbrage-engines has their formulas and sources.

Examples:
  umbrage bias gallery:contact-box --size 96x72
  umbrage bias gallery:table --size 96x72 --engine godot -o plots"
    )]
    Bias(BiasArgs),
    /// Explain why a pixel is lit or dark: what it sees, each texel that is read, the result by rays, and the name of the fault if they differ
    #[command(
        after_help = "Pixels are counted from 0 in the upper left. Taps are listed as the filter takes them; their weighted results add up to its own.

Examples:
  umbrage explain gallery:table --pixel 60,44 --size 96x72 --recipe reeves87,bias=0
  umbrage explain gallery:contact-box --pixel 48,40 --size 96x72 -o texels.svg"
    )]
    Explain(ExplainArgs),
    /// Print what a file of shadow maps holds
    #[command(after_help = "Examples:
  umbrage info maps/contact-box.exr
  umbrage info maps/three-lights.exr --part red --picture depths.png")]
    Info(InfoArgs),
    /// Look points up in a shadow map: a line of numbers in, a fraction out
    #[command(
        after_help = "A line is x y z nx ny nz [ux uy uz vx vy vz]: position and normal in world space, and the full edges of the
footprint; commas or blanks separate them. A first line of names is skipped.

Examples:
  echo '0 0 0 0 1 0' | umbrage lookup maps/three-lights.exr --part red
  umbrage lookup maps/contact-box.exr --recipe auto --keep-going < points.csv > fractions.txt"
    )]
    Lookup(LookupArgs),
    /// Write a scene as binary glTF, with its lights and the windows of their maps
    #[command(after_help = "Examples:
  umbrage export gallery:contact-box -o box.glb
  umbrage export gallery:three-lights --map-size 1024 -o lights.glb")]
    Export(ExportArgs),
    /// Show a scene on a page in a browser: change the recipe, drag the light, compare with truth under a divider, click a pixel
    #[command(
        after_help = "The printed address works on this machine alone, and only as long as the command runs; Ctrl-C ends it. Nothing is written.

Examples:
  umbrage view gallery:knot --open
  umbrage view fixtures/scenes/suzi.glb --size 640x480 --recipe reeves87"
    )]
    View(ViewArgs),
    /// List the algorithms by name, or the parameters of one
    #[command(after_help = "Examples:
  umbrage recipes
  umbrage recipes woo92")]
    Recipes(RecipesArgs),
    /// List the built-in scenes
    #[command(after_help = "Examples:
  umbrage scenes
  umbrage scenes --json")]
    Scenes,
    /// Write manual pages or shell completions
    #[command(hide = true)]
    Generate(GenerateArgs),
}

/// The pictures that are drawn, and how they are divided among machines.
#[derive(Args)]
pub struct TakesArgs {
    /// glTF files (.glb or .gltf), or `gallery:NAME`, built-in scenes (`umbrage scenes` lists them)
    #[arg(value_name = "SCENE", required = true)]
    pub scenes: Vec<String>,
    /// Draw the frames from A to B, both included. A frame's number is its key of randomness, as --frame gives it, and stands in place of
    /// each run of # in SCENE, with zeros before it to the length of the run: in frame 7, shot.####.glb is shot.0007.glb. A SCENE without
    /// # is the same in all frames, at the moment of --time, with different noise. Pictures have the number in four digits: in place of
    /// the run in the scene's name, or else after the name
    #[arg(long, value_name = "A..B", value_parser = frames, conflicts_with = "frame")]
    pub frames: Option<Frames>,
    /// Draw only the I-th picture and every N-th after it, into the folder .parts of the output, unless they are already there; once all
    /// N shards are done, `umbrage gather` gives the pictures their names
    #[arg(long, value_name = "I/N", value_parser = shard)]
    pub shard: Option<Shard>,
}

/// How a scene is seen.
#[derive(Args, Clone)]
pub struct SceneArgs {
    /// Columns and rows of the picture; the vertical angle of view is kept
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<UVec2>,
    /// Side of each light's map, texels
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u32).range(1..=16384))]
    pub map_size: u32,
    /// The algorithm: text such as `woo92,samples=32`, a TOML file, or RenderMan's words such as `rsl,samples=32,blur=0.01,bias=0.1`; each
    /// light's own, or else auto, unless given
    #[arg(long, value_name = "R")]
    pub recipe: Option<String>,
    /// Only these lights
    #[arg(long, value_name = "NAME", num_args = 1..)]
    pub light: Vec<String>,
    /// Turn a light about the point that it shines at until it lies in this direction from there, at its old distance: degrees from +x toward +z, and
    /// above the horizon; may be given for several lights
    #[arg(long, value_name = "NAME=AZIMUTH,ELEVATION", value_parser = turn_light)]
    pub turn_light: Vec<TurnLight>,
    /// The camera of a file, its first unless given
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// The moment at which a file's animation is sampled; without it objects are placed as in the file
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    pub time: Option<f64>,
    /// The animation that --time samples, the file's first unless given
    #[arg(long, value_name = "NAME", requires = "time")]
    pub animation: Option<String>,
    /// Key of randomness; a different number gives different noise
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub frame: u32,
}

#[derive(Args)]
pub struct RenderArgs {
    #[command(flatten)]
    pub takes: TakesArgs,
    #[command(flatten)]
    pub scene: SceneArgs,
    /// The picture, .png (sRGB) or .exr (linear); for several scenes, frames or shards the folder that is filled, which exists or
    /// is written with / at its end
    #[arg(short, long, value_name = "IMAGE|DIR")]
    pub output: PathBuf,
    /// The format of pictures in a folder: png (sRGB) or exr (linear); png unless given
    #[arg(long, value_enum)]
    pub format: Option<Format>,
    /// Samples for each pixel: 1 (its centre), 4, 16 or 64
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = samples)]
    pub samples: u32,
    /// Cast rays instead of looking maps up
    #[arg(long)]
    pub truth: bool,
}

#[derive(Args)]
pub struct ShadowArgs {
    #[command(flatten)]
    pub takes: TakesArgs,
    #[command(flatten)]
    pub scene: SceneArgs,
    /// The folder that is filled
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Samples for each pixel: 1 (its centre), 4, 16 or 64; 1 unless given, with --truth 64
    #[arg(long, value_name = "N", value_parser = samples)]
    pub samples: Option<u32>,
    /// 16-bit linear grey, or 32-bit floats
    #[arg(long, value_enum, default_value_t = Format::Png)]
    pub format: Format,
    /// Where maps lie: as the light defines, or fitted to what the camera sees
    #[arg(long, value_enum, default_value_t = WindowArg::File)]
    pub window: WindowArg,
    /// Filter for the size of each light, as the file gives it in `extras`, or for this radius in world units (of a sun: radians)
    #[arg(long, value_name = "RADIUS", num_args = 0..=1, require_equals = true, default_missing_value = "file", value_parser = area)]
    pub area: Option<Area>,
    /// Cast rays instead of looking maps up
    #[arg(long)]
    pub truth: bool,
}

#[derive(Args)]
pub struct GatherArgs {
    /// The folder that the shards filled, their -o
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
}

#[derive(Args)]
pub struct JobsArgs {
    /// The form of the job
    #[arg(value_enum)]
    pub scheduler: Scheduler,
    /// How many shards share the pictures
    #[arg(value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MOST_PICTURES as i64))]
    pub shards: u32,
    /// The shared command line: `umbrage render` or `umbrage shadow` with all that follows, except --shard
    #[arg(value_name = "COMMAND LINE", last = true, required = true)]
    pub words: Vec<String>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Scheduler {
    /// Open Job Description, a template of the version 2023-09 in YAML
    Openjd,
    /// A script that submits jobs to Slurm
    Slurm,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    Png,
    Exr,
}

impl Format {
    /// The extension of such files.
    pub fn extension(self) -> &'static str {
        if self == Self::Png { "png" } else { "exr" }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum WindowArg {
    File,
    Fitted,
}

#[derive(Args)]
pub struct BakeArgs {
    /// A glTF file (.glb or .gltf), or `gallery:NAME`, a built-in scene (`umbrage scenes` lists them)
    #[arg(value_name = "SCENE")]
    pub source: String,
    #[command(flatten)]
    pub scene: SceneArgs,
    /// The folder that is filled
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// What each texel stores
    #[arg(long, value_enum, default_value_t = RuleArg::Facets)]
    pub rule: RuleArg,
    /// How maps of one depth per texel are stored: raw files hold every texel, bbox files the rectangle around all surfaces
    #[arg(long, value_name = "raw|bbox|tiled", default_value = "raw")]
    pub storage: Storage,
    /// Write one file, SCENE.exr, with the parts of all lights
    #[arg(long)]
    pub one_file: bool,
}

#[derive(Args)]
pub struct BiasArgs {
    /// A glTF file (.glb or .gltf), or `gallery:NAME`, a built-in scene (`umbrage scenes` lists them)
    #[arg(value_name = "SCENE")]
    pub source: String,
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Print the settings of this engine alone, and their sources
    #[arg(long, value_name = "E", value_parser = <Engine as FromStr>::from_str)]
    pub engine: Option<Engine>,
    /// Half of the filter's width, texels; 0 for one texel
    #[arg(long, value_name = "TEXELS", default_value_t = 1.5, value_parser = radius)]
    pub radius: f64,
    /// The percentage of false shadow, and of false light, that counts as none
    #[arg(long, value_name = "PERCENT", default_value_t = 0.5, value_parser = tolerance)]
    pub tolerance: f64,
    /// Fill this folder with a plot of false light against false shadow for each light
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

#[derive(Args)]
pub struct ExplainArgs {
    /// A glTF file (.glb or .gltf), or `gallery:NAME`, a built-in scene (`umbrage scenes` lists them)
    #[arg(value_name = "SCENE")]
    pub source: String,
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Column and row of a pixel; may be given several times
    #[arg(long, value_name = "X,Y", required = true, value_parser = pixel)]
    pub pixel: Vec<[u32; 2]>,
    /// Samples for each pixel, as for `umbrage shadow`
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = samples)]
    pub samples: u32,
    /// Draw the texels around the first surface of the pixel, with its footprint and the taps
    #[arg(short, long, value_name = "FILE.svg")]
    pub output: Option<PathBuf>,
}

#[derive(Args)]
pub struct ViewArgs {
    /// A glTF file (.glb or .gltf), or `gallery:NAME`, a built-in scene (`umbrage scenes` lists them)
    #[arg(value_name = "SCENE")]
    pub source: String,
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Samples for each pixel at first: 1 (its centre), 4, 16 or 64
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = samples)]
    pub samples: u32,
    /// The port to listen on, a free one unless given
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub port: u16,
    /// Open the page in the system's default browser
    #[arg(long)]
    pub open: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum RuleArg {
    First,
    Second,
    BackFace,
    Midpoint,
    Facets,
    Deep,
}

#[derive(Args)]
pub struct ExportArgs {
    /// A glTF file (.glb or .gltf), or `gallery:NAME`, a built-in scene (`umbrage scenes` lists them)
    #[arg(value_name = "SCENE")]
    pub source: String,
    #[command(flatten)]
    pub scene: SceneArgs,
    /// The file, .glb
    #[arg(short, long, value_name = "FILE.glb")]
    pub output: PathBuf,
}

/// A file of maps, and how to read it.
#[derive(Args)]
pub struct MapArgs {
    /// The file of one map, or of several in parts
    #[arg(value_name = "MAP.exr")]
    pub map: PathBuf,
    /// Only the part of this name, or those of the light of this name
    #[arg(long, value_name = "NAME")]
    pub part: Option<String>,
    /// The channel of depths in another program's file; Z, or the only one that ends in .Z, unless given
    #[arg(long, value_name = "NAME")]
    pub channel: Option<String>,
    /// The view of the light of another program's file: a JSON file, or its text
    ///
    /// {"worldtocamera": [16 numbers], "worldtoscreen": [16 numbers], "near": N, "far": N, "depth": "axial"}
    ///
    /// The matrices are those of OpenEXR and RenderMan: rows one after the other, a point is a row from the left, the camera looks along +z,
    /// and the screen goes from -1, -1 lower left to 1, 1 upper right (or from 0, 0 upper left to 1, 1 lower right). near and far are
    /// distances along the axis; they may be left out where worldtoscreen takes them to 0 and 1. depth is axial (along the axis), radial
    /// (from the light) or screen (a z-buffer: 0 at near, 1 at far, nothing seen at 1); axial unless given.
    #[arg(long, value_name = "FILE|TEXT")]
    pub view: Option<String>,
}

#[derive(Args)]
pub struct InfoArgs {
    #[command(flatten)]
    pub maps: MapArgs,
    /// Also draw the depths in grey, near ones dark; those of several parts side by side
    #[arg(long, value_name = "IMAGE.png")]
    pub picture: Option<PathBuf>,
}

#[derive(Args)]
pub struct LookupArgs {
    #[command(flatten)]
    pub maps: MapArgs,
    /// The algorithm; unless given, the one that the map was made for
    #[arg(long, value_name = "R")]
    pub recipe: Option<String>,
    /// Print NaN for a line that cannot be read, and go on
    #[arg(long)]
    pub keep_going: bool,
}

#[derive(Args)]
pub struct RecipesArgs {
    /// The algorithm whose parameters are listed
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
}

#[derive(Args)]
pub struct GenerateArgs {
    #[arg(value_enum)]
    pub what: What,
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum What {
    Man,
    Completions,
}
