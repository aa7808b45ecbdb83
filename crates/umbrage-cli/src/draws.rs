//! What the commands that draw have in common.

use crate::args::TakesArgs;
use crate::report::Line;
use crate::shell::{Shell, Usage};
use crate::stage::Stage;
use crate::takes::Take;
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};
use umbrage_io::{Fault, IoError, write_bytes};

/// A command that draws pictures of scenes.
pub trait Draws {
    /// All that its pictures depend on besides the scene, the frame and the light, by the names of the options.
    ///
    /// # Errors
    /// An option that cannot be read.
    fn options(&self) -> anyhow::Result<Map<String, Value>>;

    /// The lights that have pictures of their own, as they stand in names of files; one without a name where a take has one picture.
    ///
    /// # Errors
    /// A scene that cannot be used.
    fn lights(&self, source: &str, shell: &mut Shell<'_>) -> anyhow::Result<Vec<Option<String>>>;

    /// The name of a picture in its folder.
    fn file(&self, take: &Take, light: Option<&str>) -> PathBuf;

    /// Reads a scene.
    ///
    /// # Errors
    /// A scene that cannot be used.
    fn stage(&self, source: &str, shell: &mut Shell<'_>) -> anyhow::Result<Stage>;

    /// Draws the wanted pictures of a take, by the names that [`Self::file`] gives them, and passes each to `keep` as soon as it is drawn.
    ///
    /// # Errors
    /// A light that cannot be used, or what `keep` returned.
    fn draw(
        &self,
        stage: Stage,
        take: &Take,
        wanted: &dyn Fn(&Path) -> bool,
        keep: &mut Keep<'_>,
        shell: &mut Shell<'_>,
    ) -> anyhow::Result<Vec<Line>>;
}

/// Takes a picture's name and the bytes of its file.
pub type Keep<'a> = dyn FnMut(PathBuf, Result<Vec<u8>, Fault>) -> anyhow::Result<()> + 'a;

/// Two pictures that would have one name.
pub fn twice(scene: &str, other: &str, file: &Path) -> anyhow::Error {
    Usage(format!("pictures of {scene} and of {other} would both be called {}", file.display())).into()
}

/// Writes a picture as a whole or not at all.
///
/// # Errors
/// What is wrong with the picture or with its place, after the file's name.
pub fn save(path: &Path, bytes: Result<Vec<u8>, Fault>) -> Result<(), IoError> {
    let bytes = bytes.map_err(|fault| IoError::Content { file: path.display().to_string(), fault })?;
    write_bytes(path, &bytes)
}

/// Prints a line for each light of a take that was drawn, and returns the same for programs.
pub fn noted(
    drawn: anyhow::Result<Vec<Line>>,
    take: &Take,
    args: &TakesArgs,
    shell: &mut Shell<'_>,
) -> anyhow::Result<Vec<Value>> {
    let name = args.are_several().then_some(take.name.as_str());
    let lines = drawn.map_err(|error| of_take(error, take, args))?;
    for line in &lines {
        line.note(name, shell);
    }
    Ok(lines.iter().map(|line| line.json(name)).collect())
}

/// An error that names its scene where there are several takes.
pub fn of_take(error: anyhow::Error, take: &Take, args: &TakesArgs) -> anyhow::Error {
    if !args.are_several() || format!("{error:#}").contains(&take.source) {
        return error;
    }
    error.context(take.source.clone())
}
