//! The list of all pictures that shards share, as each shard writes it beside its parts.

use crate::shell::Usage;
use anyhow::{Context, anyhow, bail};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use umbrage_io::{IoError, read_bytes, remove_folder, write_bytes};

/// The folder of the parts, in that of the pictures.
const FOLDER: &str = ".parts";
/// The list's file in it.
const FILE: &str = "manifest.json";
/// More than the longest list.
const MOST_BYTES: u64 = 1 << 28;

/// One picture.
#[derive(Clone, Debug)]
pub struct Job {
    /// The picture's name.
    pub picture: String,
    /// The name under which a shard writes it.
    pub part: String,
    /// The scene, the number of its frame, and the light if there are several.
    pub source: String,
    pub frame: u32,
    pub light: Option<String>,
    /// Of the scene.
    pub digest: String,
}

/// What the shards of a command line draw.
pub struct Manifest {
    /// The version of this program, the command and its options, by their names.
    pub head: Map<String, Value>,
    /// All pictures, in the order in which one machine would draw them.
    pub jobs: Vec<Job>,
}

/// Where the parts of the pictures of a folder lie.
pub fn parts_of(folder: &Path) -> PathBuf {
    folder.join(FOLDER)
}

/// Where their list is.
pub fn path_in(parts: &Path) -> PathBuf {
    parts.join(FILE)
}

impl Manifest {
    /// Writes the list into a folder of parts, unless it is there already.
    ///
    /// # Errors
    /// A different list is there: the first difference; that of an option counts as an invalid command line.
    pub fn write(&self, parts: &Path) -> anyhow::Result<()> {
        let path = path_in(parts);
        let own = self.json();
        if !path.is_file() {
            write_bytes(&path, format!("{own:#}\n").as_bytes())?;
        }
        // Another shard may have written it in the meantime.
        let there = value(&path)?;
        let Some((field, theirs, own)) = difference(&there, &own) else { return Ok(()) };
        let problem = format!(
            "{}: {field} is {theirs}, but {own} here: shards have one command line, and begin anew where {} is removed",
            path.display(),
            parts.display()
        );
        Err(if self.head.contains_key(&field) { Usage(problem).into() } else { anyhow!(problem) })
    }

    fn json(&self) -> Value {
        let job = |job: &Job| {
            let Job { picture, part, source, frame, light, digest } = job;
            json!({ "picture": picture, "part": part, "scene": source, "frame": frame, "light": light, "digest": digest })
        };
        let mut all = Value::Object(self.head.clone());
        all["jobs"] = self.jobs.iter().map(job).collect();
        all
    }
}

/// Removes a folder of parts that are gathered.
///
/// # Errors
/// A file that cannot be written or removed.
pub fn remove(parts: &Path) -> Result<(), IoError> {
    // If this is interrupted, parts that are already removed do not count as missing.
    write_bytes(&path_in(parts), json!({ "jobs": [] }).to_string().as_bytes())?;
    remove_folder(parts)
}

/// The names of the pictures in a folder of parts, each with its part's.
///
/// # Errors
/// A list that cannot be read, or one that this program would not write.
pub fn read(parts: &Path) -> anyhow::Result<Vec<(String, String)>> {
    let path = path_in(parts);
    let value = value(&path)?;
    let jobs = value["jobs"].as_array().with_context(|| format!("{}: jobs: expected a list", path.display()))?;
    let name = |index: usize, field: &str| {
        let found = &jobs[index][field];
        // A name with a folder in it would write elsewhere.
        let plain = found.as_str().filter(|name| crate::names::plain(name) == **name);
        match plain {
            Some(name) => Ok(name.to_owned()),
            None => bail!("{}: jobs[{index}].{field} is {found}: expected a file's name", path.display()),
        }
    };
    (0..jobs.len()).map(|index| Ok((name(index, "picture")?, name(index, "part")?))).collect()
}

fn value(path: &Path) -> anyhow::Result<Value> {
    let bytes = read_bytes(path, MOST_BYTES)?;
    serde_json::from_slice(&bytes).with_context(|| path.display().to_string())
}

/// The first thing that is not the same in two lists, and what both have there.
fn difference(there: &Value, own: &Value) -> Option<(String, Value, Value)> {
    let none = Map::new();
    let (one, other) = (there.as_object().unwrap_or(&none), own.as_object().unwrap_or(&none));
    let first = ["version", "command"].map(String::from);
    let mut names = first.iter().chain(one.keys()).chain(other.keys()).filter(|name| *name != "jobs");
    if let Some(name) = names.find(|name| one.get(*name) != other.get(*name)) {
        let (theirs, own) = (there[name].clone(), own[name].clone());
        return Some((name.clone(), theirs, own));
    }
    let count = |jobs: &Value| jobs.as_array().map_or(0, Vec::len);
    let (before, after) = (&there["jobs"], &own["jobs"]);
    if count(before) != count(after) {
        return Some(("number of pictures".into(), count(before).into(), count(after).into()));
    }
    let index = (0..count(after)).find(|index| before[index] != after[index])?;
    let (before, after) = (&before[index], &after[index]);
    let fields = ["scene", "frame", "light", "picture", "digest", "part"];
    let field = fields.into_iter().find(|field| before[field] != after[field]).unwrap_or("part");
    Some((format!("{field} of {}", after["picture"]), before[field].clone(), after[field].clone()))
}
