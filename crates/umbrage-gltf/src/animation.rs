//! Animations, sampled at one moment.

use crate::accessor::{Accessor, Component, Wanted};
use crate::error::quoted;
use crate::file::File;
use crate::json::At;
use crate::note::Level;
use crate::{GltfError, ReadOptions};
use glam::{DQuat, DVec3};
use std::collections::BTreeMap;

/// What animations say of a node; `None` for what they leave as the file has it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pose {
    pub translation: Option<DVec3>,
    pub rotation: Option<DQuat>,
    pub scale: Option<DVec3>,
    /// One number for each morph target.
    pub weights: Option<Vec<f64>>,
}

const TIMES: Wanted = Wanted { kind: "SCALAR", lanes: 1, of: &[Component::F32], quantised: &[] };
const VECTORS: Wanted = Wanted { kind: "VEC3", lanes: 3, of: &[Component::F32], quantised: &[] };
const SMALL: &[Component] = &[Component::F32, Component::I8, Component::U8, Component::I16, Component::U16];
const ROTATIONS: Wanted = Wanted { kind: "VEC4", lanes: 4, of: SMALL, quantised: &[] };
const WEIGHTS: Wanted = Wanted { kind: "SCALAR", lanes: 1, of: SMALL, quantised: &[] };

/// The poses at the moment that was chosen, by node.
pub(crate) fn poses(file: &File, options: &ReadOptions) -> Result<BTreeMap<usize, Pose>, GltfError> {
    let mut poses: BTreeMap<usize, Pose> = BTreeMap::new();
    let Some(time) = options.time else { return Ok(poses) };
    if !time.is_finite() {
        return Err(GltfError::field("time", time, "seconds, a finite number"));
    }
    let Some(animation) = chosen(file, options.animation.as_deref())? else { return Ok(poses) };
    let samplers = animation.items("samplers")?;
    for channel in animation.items("channels")? {
        let sampler = channel.index("sampler", samplers.len(), "samplers")?;
        let sampler =
            sampler.and_then(|index| samplers.get(index)).ok_or_else(|| channel.wrong("sampler", "a number"))?;
        let target = channel.get("target").ok_or_else(|| channel.wrong("target", "an object"))?;
        let Some(node) = target.index("node", file.count("nodes")?, "nodes")? else {
            file.note(Level::Always, format!("{} has no node, and is ignored", target.path));
            continue;
        };
        let pose = poses.entry(node).or_default();
        match target.text("path")? {
            Some("translation") => pose.translation = Some(vector(file, sampler, time)?),
            Some("scale") => pose.scale = Some(vector(file, sampler, time)?),
            Some("rotation") => pose.rotation = Some(rotation(file, sampler, time)?),
            Some("weights") => {
                let targets = targets(file, node)?;
                if targets > 0 {
                    pose.weights = Some(Keys::open(file, sampler, &WEIGHTS, targets, time)?.mixed(file, lerp)?);
                }
            }
            Some("pointer") => {
                file.note(Level::Always, format!("{} animates what is not a node, and is ignored", target.path));
            }
            _ => return Err(target.wrong("path", "translation, rotation, scale or weights")),
        }
    }
    Ok(poses)
}

/// The animation of that name, or the first one.
fn chosen<'a>(file: &File<'a>, name: Option<&str>) -> Result<Option<At<'a>>, GltfError> {
    let animations = file.all("animations")?;
    let Some(name) = name else {
        if animations.is_empty() {
            file.note(Level::Always, "there is no animation: all stands as the file has it at any time");
        }
        return Ok(animations.into_iter().next());
    };
    let names: Vec<String> = animations.iter().filter_map(At::name).take(8).map(quoted).collect();
    let found = animations.into_iter().find(|animation| animation.name() == Some(name));
    match found {
        Some(found) => Ok(Some(found)),
        None if names.is_empty() => Err(GltfError::field("animations", quoted(name), "no name, since none has one")),
        None => Err(GltfError::field("animations", quoted(name), format!("one of {}", names.join(", ")))),
    }
}

/// How many morph targets a node's mesh has.
fn targets(file: &File, node: usize) -> Result<usize, GltfError> {
    let node = file.member("nodes", node)?;
    let Some(mesh) = node.index("mesh", file.count("meshes")?, "meshes")? else { return Ok(0) };
    let first = file.member("meshes", mesh)?.get("primitives").map(|all| all.item(0)).transpose()?;
    first.map_or(Ok(0), |primitive| Ok(primitive.list("targets")?.len()))
}

fn vector(file: &File, sampler: &At, time: f64) -> Result<DVec3, GltfError> {
    let value = Keys::open(file, sampler, &VECTORS, 3, time)?.mixed(file, lerp)?;
    finite(sampler, value).map(|value| DVec3::from_slice(&value))
}

fn rotation(file: &File, sampler: &At, time: f64) -> Result<DQuat, GltfError> {
    let quaternion = |value: &[f64]| DQuat::from_slice(value).normalize();
    let slerp = |a: &[f64], b: &[f64], t: f64| quaternion(a).slerp(quaternion(b), t).to_array().to_vec();
    let value = Keys::open(file, sampler, &ROTATIONS, 4, time)?.mixed(file, slerp)?;
    finite(sampler, quaternion(&value).to_array().to_vec()).map(|value| DQuat::from_slice(&value))
}

fn finite(sampler: &At, value: Vec<f64>) -> Result<Vec<f64>, GltfError> {
    if value.iter().all(|number| number.is_finite()) {
        return Ok(value);
    }
    Err(GltfError::field(
        sampler.path_of("output"),
        format!("{value:?}"),
        "finite numbers, and rotations that are not 0",
    ))
}

fn lerp(a: &[f64], b: &[f64], t: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + (b - a) * t).collect()
}

/// How values between two keys are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Between {
    Linear,
    Step,
    Cubic,
}

/// A sampler at a moment: the keys about it, and how far it is from the first to the second.
struct Keys<'a> {
    output: Accessor<'a>,
    between: Between,
    lanes: usize,
    about: [usize; 2],
    times: [f64; 2],
    /// From 0 to 1; 0 before the first key and after the last one.
    share: f64,
}

impl<'a> Keys<'a> {
    fn open(file: &'a File, sampler: &At, wanted: &Wanted, lanes: usize, time: f64) -> Result<Self, GltfError> {
        let needed = |field: &str| sampler.wrong(field, "the number of an accessor");
        let input = Accessor::of(file, sampler, "input", &TIMES)?.ok_or_else(|| needed("input"))?;
        let output = Accessor::of(file, sampler, "output", wanted)?.ok_or_else(|| needed("output"))?;
        let between = match sampler.text("interpolation")? {
            None | Some("LINEAR") => Between::Linear,
            Some("STEP") => Between::Step,
            Some("CUBICSPLINE") => Between::Cubic,
            Some(_) => return Err(sampler.wrong("interpolation", "LINEAR, STEP or CUBICSPLINE")),
        };
        let values = if between == Between::Cubic { 3 } else { 1 };
        let elements = (input.count as u64).saturating_mul(values).saturating_mul((lanes / wanted.lanes) as u64);
        let expected = "what its times and targets need";
        let output =
            output.counting(usize::try_from(elements).unwrap_or(usize::MAX), &sampler.path_of("output"), expected)?;
        // The first key that is later; times ascend.
        let (mut low, mut high) = (0, input.count);
        while low < high {
            let middle = low.midpoint(high);
            if input.lane(middle, 0) <= time { low = middle + 1 } else { high = middle }
        }
        let keys = [low.saturating_sub(1), low.min(input.count - 1)];
        let times = keys.map(|key| input.lane(key, 0));
        let [before, after] = times;
        if !(before.is_finite() && after.is_finite() && (before < after || keys[0] == keys[1])) {
            let value = format!("{before} and {after} at {} and {}", keys[0], keys[1]);
            return Err(GltfError::field(sampler.path_of("input"), value, "finite times that ascend"));
        }
        let share = if keys[0] == keys[1] { 0.0 } else { ((time - before) / (after - before)).clamp(0.0, 1.0) };
        Ok(Self { output, between, lanes, about: keys, times, share })
    }

    /// One of the values of a key: of a cubic spline 0 is the tangent before it, 1 its value, 2 the tangent behind it.
    fn value(&self, key: usize, part: usize) -> Vec<f64> {
        let element = if self.between == Between::Cubic { key * 3 + part } else { key };
        let one = |lane: usize| {
            if self.output.lanes() == self.lanes {
                self.output.lane(element, lane)
            } else {
                self.output.lane(element * self.lanes + lane, 0)
            }
        };
        (0..self.lanes).map(one).collect()
    }

    /// The value at the moment; `linear` is what lies between two values, as far as the third argument says.
    fn mixed(&self, file: &File, linear: impl Fn(&[f64], &[f64], f64) -> Vec<f64>) -> Result<Vec<f64>, GltfError> {
        file.budget.charge(&self.output.path, self.lanes as u64, 64)?;
        let [before, after] = self.about;
        let first = self.value(before, 1);
        if self.share == 0.0 || self.between == Between::Step {
            return Ok(first);
        }
        let second = self.value(after, 1);
        if self.between == Between::Linear {
            return Ok(linear(&first, &second, self.share));
        }
        let (leaving, arriving) = (self.value(before, 2), self.value(after, 0));
        let (t, seconds) = (self.share, self.times[1] - self.times[0]);
        let (t2, t3) = (t * t, t * t * t);
        let hermite = |lane: usize| {
            let at = |values: &[f64]| values.get(lane).copied().unwrap_or(0.0);
            (2.0 * t3 - 3.0 * t2 + 1.0) * at(&first)
                + seconds * (t3 - 2.0 * t2 + t) * at(&leaving)
                + (3.0 * t2 - 2.0 * t3) * at(&second)
                + seconds * (t3 - t2) * at(&arriving)
        };
        Ok((0..self.lanes).map(hermite).collect())
    }
}
