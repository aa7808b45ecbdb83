//! Whether a package works: unpacked in a folder that holds nothing else, its program run in an empty environment.

use super::package::output;
use anyhow::{Context as _, ensure};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Unpacks a package, runs its program there, and reads its manual page.
pub fn works(package: &Path) -> anyhow::Result<()> {
    let clean = std::env::temp_dir().join(format!("umbrage-dist-{}", std::process::id()));
    std::fs::create_dir(&clean).with_context(|| clean.display().to_string())?;
    let good = unpacked(package, &clean);
    std::fs::remove_dir_all(&clean).with_context(|| clean.display().to_string())?;
    good
}

fn unpacked(package: &Path, clean: &Path) -> anyhow::Result<()> {
    let is_debian = package.extension().is_some_and(|end| end == "deb");
    if is_debian {
        output(Command::new("dpkg-deb").arg("--extract").arg(package).arg(clean))?;
    } else {
        output(Command::new("tar").args(["--strip-components=1", "-xzf"]).arg(package).arg("-C").arg(clean))?;
    }
    let (program, manual) =
        if is_debian { ("usr/bin/umbrage", "usr/share/man/man1/umbrage.1.gz") } else { ("umbrage", "man/umbrage.1") };
    let program = clean.join(format!("{program}{}", std::env::consts::EXE_SUFFIX));
    ensure!(clean.join(manual).is_file(), "there is no {manual}");
    let run = |args: &[&str]| output(Command::new(&program).args(args).env_clear().current_dir(clean));
    ensure!(run(&["--version"])?.starts_with("umbrage "), "the program does not state its version");
    run(&["shadow", "gallery:contact-box", "--size", "32x24", "-o", "shadows"])?;
    let pictures = files(&clean.join("shadows"))?;
    ensure!(pictures.iter().any(|file| file.extension().is_some_and(|end| end == "png")), "no shadow was drawn");
    Ok(())
}

fn files(folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    entries.map(|entry| Ok(entry?.path())).collect()
}
