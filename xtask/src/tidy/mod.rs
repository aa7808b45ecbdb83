//! What no compiler checks: dependency arrows, circles of modules, allowed packages, words that must not be there, file sizes, links.
//!
//! Each check is a function from text to findings, so that each can be shown to fail; this module walks the repository and
//! hands them the text.

mod arrows;
mod files;
mod ids;
mod modules;
mod packages;
mod sources;
mod words;

use anyhow::Context as _;
use std::path::{Path, PathBuf};

/// Every finding of the repository, a line each, in a fixed order.
pub fn findings(root: &Path) -> anyhow::Result<Vec<String>> {
    let mut paths = Vec::new();
    walk(root, &mut paths)?;
    let mut findings = Vec::new();
    let mut fixtures = Vec::new();
    let page = std::fs::read_to_string(root.join(ids::PAGE)).unwrap_or_default();
    let explained = ids::explained(&page);
    for path in &paths {
        let name = relative(root, path);
        let length = path.metadata().with_context(|| name.clone())?.len();
        findings.extend(files::too_large(&name, length));
        if name.starts_with("fixtures/") {
            fixtures.push(length);
        }
        let read = || std::fs::read_to_string(path).with_context(|| name.clone());
        if name.ends_with("/Cargo.toml") {
            let (folder, text) = (path.parent().unwrap_or(root), read()?);
            findings.extend(arrows::manifest(&name, &text));
            findings.extend(packages::manifest(&name, &text, |file| folder.join(file).exists()));
        } else if path.extension().is_some_and(|end| end == "rs") {
            let text = read()?;
            findings.extend(sources::source(&name, &text));
            // This program's own tests make some up.
            if !name.starts_with("xtask/") {
                findings.extend(ids::cited(&name, &text, &explained));
            }
            // The list of words has them all.
            if name != "xtask/src/tidy/words.rs" {
                findings.extend(words::words(&name, &text));
            }
            if name.ends_with("/src/lib.rs") || name.ends_with("/src/main.rs") {
                findings.extend(modules::circles(&name, &|file| std::fs::read_to_string(root.join(file)).ok()));
            }
        } else if path.extension().is_some_and(|end| end == "md") {
            let folder = path.parent().unwrap_or(root);
            findings.extend(files::dead_links(&name, &read()?, |link| folder.join(link).exists()));
        }
    }
    findings.extend(files::fixtures_too_large(&fixtures));
    findings.extend(crate::api::findings(root, false)?);
    Ok(findings)
}

/// Every file below a folder, sorted; build results and git's own are passed over, links are not followed.
fn walk(folder: &Path, paths: &mut Vec<PathBuf>) -> anyhow::Result<()> {
    let entries = std::fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut entries = entries.collect::<Result<Vec<_>, _>>()?;
    entries.sort_by_key(std::fs::DirEntry::file_name);
    for entry in entries {
        let kind = entry.file_type()?;
        if kind.is_dir() && entry.file_name() != "target" && entry.file_name() != ".git" {
            walk(&entry.path(), paths)?;
        } else if kind.is_file() {
            paths.push(entry.path());
        }
    }
    Ok(())
}

/// The path from the repository, with slashes.
fn relative(root: &Path, path: &Path) -> String {
    path.strip_prefix(root).unwrap_or(path).to_string_lossy().replace('\\', "/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repository_is_walked_and_its_faults_are_told_by_file() {
        let root = std::env::temp_dir().join(format!("umbrage-tidy-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&root);
        let put = |name: &str, text: &str| {
            let path = root.join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(&path, text).unwrap();
        };
        put(
            "crates/umbrage-depth/Cargo.toml",
            "[package]\nname = \"umbrage-depth\"\npublish = false\n[dependencies]\numbrage-raster = {}\n",
        );
        put("crates/umbrage-depth/src/lib.rs", "fn main() { dbg!(1); }");
        put("README.md", "[here](crates/umbrage-depth/src/lib.rs) [gone](crates/gone.rs)");
        put("target/debug/x.rs", "todo!()");
        let findings = findings(&root).unwrap();
        std::fs::remove_dir_all(&root).unwrap();
        assert_eq!(
            findings,
            [
                "README.md: there is no crates/gone.rs",
                "crates/umbrage-depth/Cargo.toml: lints are not the workspace's",
                "crates/umbrage-depth/Cargo.toml: umbrage-depth may not use umbrage-raster",
                "crates/umbrage-depth/src/lib.rs:1: dbg! stands in code",
            ]
        );
    }
}
