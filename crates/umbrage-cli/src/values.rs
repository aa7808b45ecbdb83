//! Values of the command line, read from text.

use glam::UVec2;
use std::fmt;
use std::ops::RangeInclusive;
use umbrage_scene::Bearing;

/// Most pictures of one command line, and most shards of it, so that a list of them stays small.
pub const MOST_PICTURES: usize = 100_000;

/// How large lights are.
#[derive(Clone, Copy, PartialEq)]
pub enum Area {
    /// As in the scene.
    File,
    /// All of one radius: world units, of a sun radians.
    Radius(f64),
}

/// Numbers of frames; never empty.
pub type Frames = RangeInclusive<u32>;

/// One of the parts of a command line's pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which one, from 1.
    pub number: usize,
    /// How many there are, at least `number`.
    pub count: usize,
}

impl Shard {
    /// Whether the picture of an index from 0 is drawn by this shard.
    pub fn draws(self, index: usize) -> bool {
        index % self.count == self.number - 1
    }
}

/// Where a light is turned to.
#[derive(Clone, Debug, PartialEq)]
pub struct TurnLight {
    /// The light's name, or what it is called in names of files.
    pub name: String,
    /// From +x toward +z within a turn either way; elevations are from -90 to 90.
    pub to: Bearing,
}

/// As [`turn_light`] reads it.
impl fmt::Display for TurnLight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={},{}", self.name, self.to.azimuth_deg, self.to.elevation_deg)
    }
}

/// `NAME=AZIMUTH,ELEVATION`; a name may hold an equals sign.
pub fn turn_light(text: &str) -> Result<TurnLight, String> {
    let number = |text: &str, most: f64| text.trim().parse().ok().filter(|at: &f64| (-most..=most).contains(at));
    let read = || {
        let (name, angles) = text.rsplit_once('=')?;
        let (azimuth, elevation) = angles.split_once(',')?;
        let to = Bearing { azimuth_deg: number(azimuth, 360.0)?, elevation_deg: number(elevation, 90.0)? };
        Some(TurnLight { name: name.into(), to })
    };
    read().ok_or_else(|| "expected NAME=AZIMUTH,ELEVATION, degrees from -360 to 360 and from -90 to 90".into())
}

pub fn size(text: &str) -> Result<UVec2, String> {
    let side = |text: &str| text.parse::<u32>().ok().filter(|side| (1..=16384).contains(side));
    let sides = text.split_once('x').and_then(|(width, height)| Some(UVec2::new(side(width)?, side(height)?)));
    sides.ok_or_else(|| "expected WIDTHxHEIGHT, each from 1 to 16384".into())
}

pub fn samples(text: &str) -> Result<u32, String> {
    let number = text.parse().ok().filter(|number| [1, 4, 16, 64].contains(number));
    number.ok_or_else(|| "expected 1, 4, 16 or 64".into())
}

pub fn seconds(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|number: &f64| number.is_finite()).ok_or_else(|| "expected a finite number".into())
}

pub fn area(text: &str) -> Result<Area, String> {
    if text == "file" {
        return Ok(Area::File);
    }
    let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number > 0.0);
    number.map(Area::Radius).ok_or_else(|| "expected a finite number above 0".into())
}

/// `A..B`, both included.
pub fn frames(text: &str) -> Result<Frames, String> {
    let bounds = text.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
    let (first, last): (u32, u32) =
        bounds.ok_or("expected A..B, whole numbers from 0 to 4294967295, both frames included")?;
    if last < first {
        return Err(format!("expected a last frame that is not before the first: {last} is before {first}"));
    }
    Ok(first..=last)
}

/// `I/N`, where I is 1 to N.
pub fn shard(text: &str) -> Result<Shard, String> {
    let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    let shard = numbers.map(|(number, count)| Shard { number, count });
    let fits = |shard: &Shard| 1 <= shard.number && shard.number <= shard.count && shard.count <= MOST_PICTURES;
    shard.filter(fits).ok_or_else(|| format!("expected I/N, where N is 1 to {MOST_PICTURES} and I is 1 to N"))
}

/// A filter's half-width, texels.
pub fn radius(text: &str) -> Result<f64, String> {
    within(text, 0.0, 64.0)
}

/// A percentage that counts as none.
pub fn tolerance(text: &str) -> Result<f64, String> {
    within(text, 0.0, 100.0)
}

fn within(text: &str, least: f64, most: f64) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| (least..=most).contains(number));
    number.ok_or_else(|| format!("expected a number from {least} to {most}"))
}

/// Column and row of a pixel, from 0.
pub fn pixel(text: &str) -> Result<[u32; 2], String> {
    let parsed = text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    parsed.ok_or_else(|| "expected X,Y, two whole numbers from 0".into())
}
