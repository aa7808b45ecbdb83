//! What a user installs: the command with its manual pages and completions, as a folder, a tarball and a Debian package, each unpacked and
//! tried in a clean folder.

mod debian;
mod package;
mod tried;

use crate::programs::cargo;
use anyhow::{Context as _, ensure};
use package::{NAME, Package, TEXTS, copied, output};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Builds the command and fills `target/dist` anew. On Linux the program is static, and there is a Debian package where `dpkg-deb` is. Whether all
/// went well.
pub fn run(root: &Path) -> anyhow::Result<bool> {
    let machine = machine()?;
    let is_static = machine.ends_with("-linux-gnu");
    let Some(program) = built(root, &machine, is_static)? else { return Ok(false) };
    if is_static {
        ensure!(is_static_program(&program)?, "{} still needs libraries", program.display());
    }
    let dist = root.join("target/dist");
    if dist.exists() {
        std::fs::remove_dir_all(&dist).with_context(|| dist.display().to_string())?;
    }
    let version = version(root)?;
    let package = Package { folder: dist.join(format!("{NAME}-{version}-{machine}")), version, machine };
    filled(root, &package, &program, is_static)?;
    let mut made = vec![tarball(&dist, &package)?];
    if is_static {
        match debian::packed(&dist, &package)? {
            Some(file) => made.push(file),
            None => println!("there is no dpkg-deb, and so no Debian package"),
        }
    }
    for file in &made {
        tried::works(file).with_context(|| file.display().to_string())?;
        println!("{} holds a program that works where nothing else is", file.display());
    }
    Ok(true)
}

/// Of rustc's own.
fn machine() -> anyhow::Result<String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let text = output(Command::new(rustc).arg("-vV"))?;
    let host = text.lines().find_map(|line| line.strip_prefix("host: "));
    Ok(host.context("rustc does not say which machine it is for")?.to_string())
}

fn version(root: &Path) -> anyhow::Result<String> {
    let manifest: toml::Table = std::fs::read_to_string(root.join("Cargo.toml")).context("Cargo.toml")?.parse()?;
    let version = manifest.get("workspace").and_then(|workspace| workspace.get("package")?.get("version")?.as_str());
    Ok(version.context("Cargo.toml states no version")?.to_string())
}

/// The path of the program, built in release; `None` where it does not compile. Static programs need the machine to be named, so that what runs while
/// the program is compiled is not static.
fn built(root: &Path, machine: &str, is_static: bool) -> anyhow::Result<Option<PathBuf>> {
    let mut command = Command::new(cargo());
    command.args(["build", "--release", "--package", "umbrage-cli", "--target", machine]).current_dir(root);
    if is_static {
        let flags = std::env::var("RUSTFLAGS").unwrap_or_default();
        command.env("RUSTFLAGS", format!("{flags} -C target-feature=+crt-static").trim());
    }
    if !command.status().context("cargo build")?.success() {
        return Ok(None);
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |folder| root.join(folder));
    Ok(Some(target.join(machine).join("release").join(format!("{NAME}{}", std::env::consts::EXE_SUFFIX))))
}

/// Whether a program needs no library, by `ldd`, which ends with an error for some of those.
fn is_static_program(program: &Path) -> anyhow::Result<bool> {
    let said = Command::new("ldd").arg(program).output().context("ldd")?;
    let text = [said.stdout, said.stderr].concat();
    let text = String::from_utf8_lossy(&text);
    Ok(text.contains("statically linked") || text.contains("not a dynamic executable"))
}

/// Puts the program, what it says of itself, and the texts into the package's folder.
fn filled(root: &Path, package: &Package, program: &Path, is_static: bool) -> anyhow::Result<()> {
    let folder = &package.folder;
    std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    for what in ["man", "completions"] {
        output(Command::new(program).args(["generate", what]).arg(folder.join(what)))?;
    }
    let copy = folder.join(program.file_name().context("a program has a name")?);
    copied(program, &copy)?;
    // Names and lines are for whoever profiles it; they are five sixths of the file.
    if is_static {
        output(Command::new("strip").arg("--strip-all").arg(&copy))?;
    }
    copied(&root.join("crates/umbrage-cli/README.md"), &folder.join("README.md"))?;
    TEXTS.iter().try_for_each(|text| copied(&root.join(text), &folder.join(text)))
}

/// The package's folder in one file; the same folder makes the same bytes, whoever packs it and when.
fn tarball(dist: &Path, package: &Package) -> anyhow::Result<PathBuf> {
    let name = package.folder.file_name().context("a folder has a name")?;
    let file = dist.join(format!("{}.tar.gz", name.display()));
    let mut command = Command::new("tar");
    command.args(["--sort=name", "--owner=0", "--group=0", "--numeric-owner", "--mtime=@0", "--use-compress-program"]);
    output(command.arg("gzip -9n").arg("-cf").arg(&file).arg("-C").arg(dist).arg(name))?;
    Ok(file)
}
