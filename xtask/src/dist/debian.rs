//! The Debian package: files where the distribution has them, and what `dpkg` asks of a package.

use super::package::{NAME, Package, TEXTS, copied, output};
use anyhow::Context as _;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where each shell looks for completions, by the file that `umbrage generate` writes.
const COMPLETIONS: [(&str, &str); 3] = [
    ("umbrage.bash", "usr/share/bash-completion/completions/umbrage"),
    ("_umbrage", "usr/share/zsh/vendor-completions/_umbrage"),
    ("umbrage.fish", "usr/share/fish/vendor_completions.d/umbrage.fish"),
];

/// Makes the package beside the folder that it is made of. `None` where `dpkg-deb` is not installed.
pub fn packed(dist: &Path, package: &Package) -> anyhow::Result<Option<PathBuf>> {
    if Command::new("dpkg-deb").arg("--version").output().is_err() {
        return Ok(None);
    }
    let kind = architecture(&package.machine);
    let tree = dist.join("debian");
    let put = |from: &Path, to: &str| {
        let to = tree.join(to);
        let folder = to.parent().unwrap_or(&tree);
        std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        copied(from, &to)
    };
    let here = &package.folder;
    put(&here.join(NAME), "usr/bin/umbrage")?;
    for (from, to) in COMPLETIONS {
        put(&here.join("completions").join(from), to)?;
    }
    for page in std::fs::read_dir(here.join("man")).context("man")? {
        let page = page?;
        let to = format!("usr/share/man/man1/{}", page.file_name().display());
        put(&page.path(), &to)?;
        output(Command::new("gzip").arg("-9n").arg(tree.join(to)))?;
    }
    for text in TEXTS {
        put(&here.join(text), &format!("usr/share/doc/umbrage/{text}"))?;
    }
    std::fs::write(tree.join("usr/share/doc/umbrage/copyright"), COPYRIGHT).context("copyright")?;
    let kilobytes = size(&tree)?.div_ceil(1024);
    std::fs::create_dir_all(tree.join("DEBIAN")).context("DEBIAN")?;
    std::fs::write(tree.join("DEBIAN/control"), control(&package.version, kind, kilobytes)).context("control")?;
    let file = dist.join(format!("{NAME}_{}_{kind}.deb", package.version));
    let mut command = Command::new("dpkg-deb");
    command.env("SOURCE_DATE_EPOCH", "0").args(["--root-owner-group", "--build"]);
    output(command.arg(&tree).arg(&file))?;
    std::fs::remove_dir_all(&tree).with_context(|| tree.display().to_string())?;
    Ok(Some(file))
}

const COPYRIGHT: &str = "\
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Umbrage

Files: *
Copyright: The Umbrage authors
License: Expat or Apache-2.0
 Either of the two, at your option. Their texts are LICENSE-MIT and LICENSE-APACHE beside this file.
";

/// As Debian names a machine that rustc names otherwise.
fn architecture(machine: &str) -> &str {
    match machine.split('-').next().unwrap_or(machine) {
        "x86_64" => "amd64",
        "aarch64" => "arm64",
        "i686" => "i386",
        "riscv64gc" => "riscv64",
        other => other,
    }
}

/// What `dpkg` reads. A static program depends on nothing.
fn control(version: &str, architecture: &str, kilobytes: u64) -> String {
    format!(
        "Package: umbrage\nVersion: {version}\nArchitecture: {architecture}\nMaintainer: The Umbrage authors <authors@umbrage.invalid>\n\
         Installed-Size: {kilobytes}\nSection: graphics\nPriority: optional\n\
         Description: reference for depth-map shadows\n \
         Draws the shadows, shadow maps and pictures of glTF scenes by the\n algorithms of the classic papers, beside ray-traced truth, and measures\n \
         the faults of each.\n"
    )
}

/// Bytes of all files below a folder.
fn size(folder: &Path) -> anyhow::Result<u64> {
    let mut sum = 0;
    for entry in std::fs::read_dir(folder).with_context(|| folder.display().to_string())? {
        let entry = entry?;
        let about = entry.metadata()?;
        sum += if about.is_dir() { size(&entry.path())? } else { about.len() };
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_control_file_has_a_field_on_each_line_and_a_description_that_is_indented() {
        let text = control("0.1.0", architecture("x86_64-unknown-linux-gnu"), 12);
        let fields: Vec<&str> = text.lines().filter(|line| !line.starts_with(' ')).collect();
        assert!(fields.iter().all(|line| line.contains(": ")), "{text}");
        assert!(text.contains("\nArchitecture: amd64\n") && text.contains("\nInstalled-Size: 12\n"));
        assert!(text.ends_with('\n') && text.lines().all(|line| line.len() <= 80), "{text}");
    }
}
