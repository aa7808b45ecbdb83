//! Which scenes are drawn at which frames.

use crate::args::TakesArgs;
use crate::names;
use crate::shell::Usage;
use crate::stage::GALLERY;
use crate::values::MOST_PICTURES;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// A scene at a frame.
#[derive(Clone, Debug)]
pub struct Take {
    /// The scene, as it would be named alone on a command line.
    pub source: String,
    /// Key of randomness.
    pub frame: u32,
    /// The name of its pictures.
    pub name: String,
    /// What stands before a light's name where progress is shown: nothing where there is one take.
    pub label: String,
}

impl TakesArgs {
    /// Whether the output is a folder whatever the command.
    pub fn are_several(&self) -> bool {
        self.scenes.len() > 1 || self.frames.is_some() || self.shard.is_some()
    }

    /// Every scene at every frame, frames innermost; `frame` is that of all scenes where there are no several frames.
    ///
    /// # Errors
    /// Two takes of one name, also where only case differs, or too many of them.
    pub fn takes(&self, frame: u32) -> anyhow::Result<Vec<Take>> {
        let frames = self.frames.clone().unwrap_or(frame..=frame);
        let count = (u64::from(frames.end() - frames.start()) + 1).saturating_mul(self.scenes.len() as u64);
        if count > MOST_PICTURES as u64 {
            let problem = format!("{count} scenes and frames are more than {MOST_PICTURES}");
            return Err(Usage(format!("SCENE and --frames: {problem}")).into());
        }
        let mut takes = Vec::new();
        for scene in &self.scenes {
            for frame in frames.clone() {
                let number = self.frames.is_some().then_some(frame);
                let source = number.map_or(scene.clone(), |number| numbered(scene, number, None));
                let name = name(scene, number);
                let label =
                    if count == 1 { String::new() } else { format!("{name} ({} of {count}) ", takes.len() + 1) };
                takes.push(Take { source, frame, name, label });
            }
        }
        let mut known = BTreeMap::new();
        for take in &takes {
            if let Some(other) = known.insert(names::plain(&take.name).to_ascii_lowercase(), &take.source) {
                let Take { source, name, .. } = take;
                return Err(Usage(format!("scenes {other} and {source} are both called {name}")).into());
            }
        }
        Ok(takes)
    }
}

/// The name of a scene's pictures: the scene's own name, and a frame's number in place of a run of `#` in it, or else after it.
fn name(scene: &str, frame: Option<u32>) -> String {
    /// Digits of a frame's number in names.
    const DIGITS: usize = 4;
    let stem = match scene.strip_prefix(GALLERY) {
        Some(name) => name.into(),
        None => Path::new(scene).file_stem().map_or("scene".into(), |stem| stem.to_string_lossy()),
    };
    match frame {
        None => stem.into(),
        Some(frame) if stem.contains('#') => numbered(&stem, frame, Some(DIGITS)),
        Some(frame) => format!("{stem}.{frame:0DIGITS$}"),
    }
}

/// A text with a number in place of each run of `#`, with at least this many digits, or else as many as the run is long.
fn numbered(text: &str, number: u32, digits: Option<usize>) -> String {
    /// As long as a file's name may be; far longer numbers cannot be formatted.
    const MOST_DIGITS: usize = 255;
    let mut done = String::new();
    let mut rest = text;
    while let Some(start) = rest.find('#') {
        let run = &rest[start..];
        let after = run.trim_start_matches('#');
        let width = digits.unwrap_or((run.len() - after.len()).min(MOST_DIGITS));
        done += &rest[..start];
        // Writing to a string cannot fail.
        let _ = write!(done, "{number:0width$}");
        rest = after;
    }
    done + rest
}
