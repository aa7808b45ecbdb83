//! Whether the crates could be published now: the dry run of it on a copy of the repository, with the switch turned on there.

use crate::programs::cargo;
use anyhow::{Context as _, ensure};
use std::path::{Path, PathBuf};
use std::process::Command;
use toml::{Table, Value};

/// The switch that every published package inherits, as `Cargo.toml` has it while nobody has decided to publish.
const OFF: &str = "\npublish = false\n";
const ON: &str = "\npublish = true\n";

/// What each package must hold.
const NEEDED: [&str; 4] = ["Cargo.toml", "README.md", "LICENSE-MIT", "LICENSE-APACHE"];

/// Copies the repository's files, turns the switch on in the copy, and runs `cargo publish --workspace --dry-run` there; then looks
/// into the list of each package's files. With `verify` cargo also compiles each package from what it holds, as the registry's users
/// will. Whether all went well.
pub fn run(root: &Path, verify: bool) -> anyhow::Result<bool> {
    let copy = std::env::temp_dir().join(format!("umbrage-publish-{}", std::process::id()));
    copy_tree(root, &copy)?;
    let good = checked(root, &copy, verify);
    std::fs::remove_dir_all(&copy).with_context(|| copy.display().to_string())?;
    good
}

fn checked(root: &Path, copy: &Path, verify: bool) -> anyhow::Result<bool> {
    let manifest = copy.join("Cargo.toml");
    let text = std::fs::read_to_string(&manifest).context("Cargo.toml")?;
    std::fs::write(&manifest, turned_on(&text)?).context("Cargo.toml")?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |folder| root.join(folder));
    let start = |args: &[&str]| {
        let mut command = Command::new(cargo());
        command.args(args).current_dir(copy).env("CARGO_TARGET_DIR", target.join("publish"));
        command
    };
    let published = published(copy)?;
    ensure!(!published.is_empty(), "no package inherits the switch");
    for package in &published {
        let listed = start(&["package", "--list", "--package", package]).output().context("cargo package")?;
        ensure!(listed.status.success(), "{package}: {}", String::from_utf8_lossy(&listed.stderr).trim());
        let files = String::from_utf8_lossy(&listed.stdout);
        for needed in NEEDED {
            ensure!(files.lines().any(|file| file == needed), "{package} has no {needed}");
        }
    }
    let mut args = vec!["publish", "--workspace", "--dry-run", "--quiet"];
    if !verify {
        args.push("--no-verify");
    }
    let good = start(&args).status().context("cargo publish")?.success();
    if good {
        println!("{} packages could be published: {}", published.len(), published.join(", "));
    }
    Ok(good)
}

/// The workspace's manifest with the switch turned on.
fn turned_on(text: &str) -> anyhow::Result<String> {
    ensure!(text.matches(OFF).count() == 1, "Cargo.toml has no single line `publish = false`");
    Ok(text.replacen(OFF, ON, 1))
}

/// The packages that inherit the switch, by name, in the order of their names.
fn published(root: &Path) -> anyhow::Result<Vec<String>> {
    let mut names = Vec::new();
    let folder = root.join("crates");
    for entry in std::fs::read_dir(&folder).with_context(|| folder.display().to_string())? {
        let file = entry?.path().join("Cargo.toml");
        if let Ok(text) = std::fs::read_to_string(&file) {
            let manifest: Table = text.parse().with_context(|| file.display().to_string())?;
            let package = manifest.get("package").and_then(Value::as_table);
            let inherits = package.and_then(|package| package.get("publish")).is_some_and(Value::is_table);
            if let Some(name) = package.and_then(|package| package["name"].as_str()).filter(|_| inherits) {
                names.push(name.to_string());
            }
        }
    }
    names.sort_unstable();
    Ok(names)
}

/// Copies what git keeps and what it would keep; a link becomes the file that it leads to, as in a package.
fn copy_tree(root: &Path, copy: &Path) -> anyhow::Result<()> {
    let listed = Command::new("git")
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
        .current_dir(root)
        .output()
        .context("git ls-files")?;
    ensure!(listed.status.success(), "git ls-files: {}", String::from_utf8_lossy(&listed.stderr).trim());
    let names = String::from_utf8(listed.stdout).context("a file's name is not UTF-8")?;
    for name in names.split('\0').filter(|name| !name.is_empty()) {
        let (from, to) = (root.join(name), copy.join(name));
        // Deleted, but not yet in a commit.
        if !from.exists() {
            continue;
        }
        let folder: PathBuf = to.parent().unwrap_or(copy).to_path_buf();
        std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
        std::fs::copy(&from, &to).with_context(|| name.to_string())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_switch_is_found_once_and_turned_on() {
        assert_eq!(turned_on("[a]\npublish = false\nb = 1\n").unwrap(), "[a]\npublish = true\nb = 1\n");
        for text in ["[a]\npublish = true\n", "publish = false\n", "\npublish = false\n\npublish = false\n"] {
            let refused = turned_on(text).unwrap_err().to_string();
            assert_eq!(refused, "Cargo.toml has no single line `publish = false`");
        }
    }

    #[test]
    fn the_citation_states_the_version_of_the_workspace() {
        let read = |file: &str| std::fs::read_to_string(crate::root().join(file)).unwrap();
        let manifest: Table = read("Cargo.toml").parse().unwrap();
        let version = manifest["workspace"]["package"]["version"].as_str().unwrap();
        assert!(read("CITATION.cff").contains(&format!("\nversion: {version}\n")), "{version}");
        for (name, dependency) in manifest["workspace"]["dependencies"].as_table().unwrap() {
            if let Some(stated) = dependency.get("version").filter(|_| dependency.get("path").is_some()) {
                assert_eq!(stated.as_str(), Some(version), "{name}");
            }
        }
    }

    #[test]
    fn libraries_and_the_command_inherit_the_switch_and_what_only_this_repository_needs_does_not() {
        let names = published(&crate::root()).unwrap();
        for name in ["umbrage-cli", "umbrage-plane", "umbrage-report", "umbrage-shadow"] {
            assert!(names.iter().any(|one| one == name), "{name}");
        }
        for name in ["umbrage-bench", "umbrage-figures", "umbrage-fuzz"] {
            assert!(names.iter().all(|one| one != name), "{name}");
        }
    }
}
