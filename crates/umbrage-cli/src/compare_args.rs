//! The options of `umbrage compare`.

use crate::values::{Area, TurnLight, area, samples, seconds, size, turn_light};
use clap::Args;
use glam::UVec2;
use std::path::PathBuf;

#[derive(Args)]
pub struct CompareArgs {
    /// A glTF file (.glb or .gltf), or `gallery:NAME`, a built-in scene (`umbrage scenes` lists them)
    #[arg(value_name = "SCENE")]
    pub source: String,
    /// The algorithms, as for --recipe of the other commands; auto and each paper's unless given, and none with --against
    #[arg(long, value_name = "R", num_args = 1..)]
    pub recipe: Vec<String>,
    /// Sides of the maps, texels
    #[arg(long, value_name = "N", num_args = 1.., default_values_t = [512], value_parser = clap::value_parser!(u32).range(1..=16384))]
    pub map_size: Vec<u32>,
    /// Only these lights
    #[arg(long, value_name = "NAME", num_args = 1..)]
    pub light: Vec<String>,
    /// Turn a light about the point that it shines at until it lies in this direction from there, at its old distance: degrees from +x toward +z, and
    /// above the horizon; may be given for several lights
    #[arg(long, value_name = "NAME=AZIMUTH,ELEVATION", value_parser = turn_light)]
    pub turn_light: Vec<TurnLight>,
    /// Columns and rows of the pictures; the vertical angle of view is kept
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<UVec2>,
    /// Samples for each pixel, of truth and of results: 1 (its centre), 4, 16 or 64
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = samples)]
    pub samples: u32,
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
    /// Truth and recipes for the size of each light, as the file gives it in `extras`, or for this radius in world units (of a sun: radians)
    #[arg(long, value_name = "RADIUS", num_args = 0..=1, require_equals = true, default_missing_value = "file", value_parser = area)]
    pub area: Option<Area>,
    /// The folder that is filled with a page that compares results with truth (index.html), heat maps of the faults, and report.json, which is
    /// what --json prints
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Also judge a shadow image of your own, PNG or EXR: the fraction in shadow, linear, of the size of the pictures
    #[arg(long, value_name = "IMAGE")]
    pub against: Option<PathBuf>,
    /// The image of --against holds the fraction of the light that arrives, not the fraction in shadow
    #[arg(long, requires = "against")]
    pub invert: bool,
    /// Exit with 3 where a recipe or the image exceeds one of these, such as rms=0.02,acne=0.1%
    ///
    /// For each recipe and the image: rms, false-shadow, false-light, acne, penumbra-ratio, displacement, displacement-x, displacement-y, edge-shift,
    /// edge-shift-signed. For recipes alone: detachment, leak, detached, detached-texels, noise, bake-ms, look-up-ns.
    #[arg(long, value_name = "NAME=NUMBER,..")]
    pub fail_above: Option<String>,
}
