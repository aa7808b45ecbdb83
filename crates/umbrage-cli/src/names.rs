//! Names of files, made from names that people gave.

use std::path::{Path, PathBuf};

/// A name that any file system takes: characters outside A–Z a–z 0–9 . _ - become `_`, and no dot comes first.
pub fn plain(name: &str) -> String {
    let plain: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '_' }).collect();
    match plain.strip_prefix('.') {
        Some(rest) => format!("_{rest}"),
        None if plain.is_empty() => "_".into(),
        None => plain,
    }
}

/// A plain name for each, all different also where case does not count: a second one of a name gets `-2`, a third `-3`.
pub fn distinct<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut taken: Vec<String> = Vec::new();
    for name in names {
        let first = plain(name);
        let is_taken = |name: &str, taken: &[String]| taken.iter().any(|other| other.eq_ignore_ascii_case(name));
        let mut own = first.clone();
        let mut number = 2;
        while is_taken(&own, &taken) {
            own = format!("{first}-{number}");
            number += 1;
        }
        taken.push(own);
    }
    taken
}

/// `FOLDER/SCENE.EXT` where a scene has one light, `FOLDER/SCENE.LIGHT.EXT` where it has several; `parts` come between.
pub fn file(folder: &Path, scene: &str, light: Option<&str>, parts: &[&str], extension: &str) -> PathBuf {
    let mut name = plain(scene);
    for part in light.iter().chain(parts) {
        name = format!("{name}.{part}");
    }
    folder.join(format!("{name}.{extension}"))
}
