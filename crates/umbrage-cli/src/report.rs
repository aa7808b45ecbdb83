//! The report of what a command did.

use crate::args::Cli;
use crate::shell::Shell;
use serde_json::{Map, Value, json};
use std::path::PathBuf;
use std::time::Duration;

/// What was done for one light.
pub struct Line {
    pub light: String,
    /// The algorithm.
    pub recipe: String,
    /// Bytes of its maps.
    pub bytes: usize,
    /// How long its maps took.
    pub baked: Duration,
    /// How long what was done with them took.
    pub looked_up: Duration,
}

impl Line {
    /// A line for people, after the picture's name where there are several.
    pub fn note(&self, picture: Option<&str>, shell: &mut Shell<'_>) {
        let Self { light, recipe, bytes, baked, looked_up } = self;
        let picture = picture.map(|name| format!("{name} ")).unwrap_or_default();
        let (baked, looked_up) = (milliseconds(*baked), milliseconds(*looked_up));
        shell.note(&format!(
            "{picture}{light}: {recipe}, {bytes} bytes, baked in {baked} ms, looked up in {looked_up} ms"
        ));
    }

    /// The same for programs.
    pub fn json(&self, picture: Option<&str>) -> Value {
        let mut line = json!({
            "light": self.light, "recipe": self.recipe, "bytes": self.bytes,
            "bake_ms": milliseconds(self.baked), "lookup_ms": milliseconds(self.looked_up),
        });
        if let Some(name) = picture {
            line["picture"] = json!(name);
        }
        line
    }
}

/// Reports what was written: as JSON on stdout where that is wanted, and one line for each light for people.
pub fn report(cli: &Cli, shell: &mut Shell<'_>, files: &[PathBuf], lines: &[Line]) -> anyhow::Result<()> {
    for line in lines {
        line.note(None, shell);
    }
    let lights = lines.iter().map(|line| line.json(None)).collect();
    written(cli, shell, files, [("lights", lights)])
}

/// Prints the files that were written, and `more` about them, as JSON on stdout where that is wanted.
pub fn written<const N: usize>(
    cli: &Cli,
    shell: &mut Shell<'_>,
    files: &[PathBuf],
    more: [(&str, Value); N],
) -> anyhow::Result<()> {
    if cli.json {
        let mut all: Map<String, Value> = more.into_iter().map(|(name, value)| (name.into(), value)).collect();
        all.insert("files".into(), files.iter().map(|file| file.display().to_string()).collect());
        writeln!(shell.out, "{}", Value::Object(all))?;
    }
    Ok(())
}

fn milliseconds(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e5).round() / 1e2
}
