//! The README's program for a renderer of one's own, built as its reader would build it.

use crate::programs::cargo;
use anyhow::Context as _;
use std::path::Path;
use std::process::Command;

/// What `cargo new` writes above the dependencies.
const PACKAGE: &str = "[package]\nname = \"renderer\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n";
/// Where the README has the repository: beside the renderer's folder.
const BESIDE: &str = "../umbrage/";

/// Makes a fresh package outside the workspace of nothing but the README's two blocks, runs it, and says whether all went well.
///
/// The workspace's own lock file goes with it, so that no other versions are fetched than those that are tested here. `settings` are
/// cargo's, as variables of its environment.
pub fn run(root: &Path, settings: &[(&str, &str)]) -> anyhow::Result<bool> {
    let text = std::fs::read_to_string(root.join("README.md")).context("README.md")?;
    let (manifest, program) = (block(&text, "toml")?, block(&text, "rust")?);
    let folder = std::env::temp_dir().join(format!("umbrage-readme-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("src")).with_context(|| folder.display().to_string())?;
    let here = root.to_str().context("the repository's path is not UTF-8")?.replace('\\', "/");
    std::fs::write(folder.join("Cargo.toml"), format!("{PACKAGE}{}", manifest.replace(BESIDE, &format!("{here}/"))))?;
    std::fs::write(folder.join("src/main.rs"), program)?;
    std::fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock"))?;
    let status = Command::new(cargo())
        .args(["run", "--quiet"])
        .current_dir(&folder)
        .envs(settings.iter().copied())
        .env("CARGO_TARGET_DIR", root.join("target/readme"))
        .status()
        .context("cargo run")?;
    std::fs::remove_dir_all(&folder).with_context(|| folder.display().to_string())?;
    Ok(status.success())
}

/// The one fenced block of a language.
fn block<'a>(text: &'a str, language: &str) -> anyhow::Result<&'a str> {
    let open = format!("\n```{language}\n");
    let (_, rest) = text.split_once(&open).with_context(|| format!("README.md has no block of {language}"))?;
    anyhow::ensure!(!rest.contains(&open), "README.md has more than one block of {language}");
    let (block, _) = rest.split_once("\n```").with_context(|| format!("README.md's block of {language} has no end"))?;
    Ok(block)
}

#[cfg(test)]
mod tests {
    use super::*;
    use toml::{Table, Value};

    #[test]
    fn one_block_of_a_language_is_found_and_none_or_two_are_refused() {
        let text = "# A\n```sh\nls\n```\n\n```rust\nfn main() {\n}\n```\n";
        assert_eq!(block(text, "rust").unwrap(), "fn main() {\n}");
        assert_eq!(block(text, "toml").unwrap_err().to_string(), "README.md has no block of toml");
        let twice = block(&text.repeat(2), "sh").unwrap_err();
        assert_eq!(twice.to_string(), "README.md has more than one block of sh");
        assert!(block("\n```sh\nls\n", "sh").is_err());
    }

    #[test]
    fn the_readme_names_packages_that_stand_where_it_says_and_its_program_uses_no_other() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let text = std::fs::read_to_string(root.join("README.md")).unwrap();
        let manifest: Table = block(&text, "toml").unwrap().parse().unwrap();
        let dependencies = manifest["dependencies"].as_table().unwrap();
        for (name, dependency) in dependencies.iter().filter(|(_, dependency)| dependency.is_table()) {
            let path = dependency["path"].as_str().and_then(|path| path.strip_prefix(BESIDE)).unwrap();
            let there: Table = std::fs::read_to_string(root.join(path).join("Cargo.toml")).unwrap().parse().unwrap();
            assert_eq!(there["package"]["name"].as_str(), Some(name.as_str()), "{path}");
        }
        // The versions of others are the workspace's, or its types would not be the caller's.
        let workspace: Table = std::fs::read_to_string(root.join("Cargo.toml")).unwrap().parse().unwrap();
        for (name, version) in dependencies.iter().filter_map(|(name, version)| Some((name, version.as_str()?))) {
            assert_eq!(workspace["workspace"]["dependencies"][name].as_str(), Some(version), "{name}");
        }
        let program = block(&text, "rust").unwrap();
        let used = program.lines().filter_map(|line| line.strip_prefix("use ")?.split("::").next());
        let used: Vec<String> = used.map(|name| name.replace('_', "-")).collect();
        assert!(used.len() >= 5 && used.iter().all(|name| dependencies.contains_key(name)), "{used:?}");
        assert_eq!(dependencies.values().filter(|value| matches!(value, Value::String(_))).count(), 1, "glam alone");
    }
}
