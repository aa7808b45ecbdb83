//! The command lines that README and help show, run as they stand by a shell, one after the other in one folder.

use std::path::{Path, PathBuf};
use std::process::Command;

const BINARY: &str = env!("CARGO_BIN_EXE_umbrage");

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    let scenes = folder.join("fixtures/scenes");
    std::fs::create_dir_all(&scenes).expect("a folder");
    for name in ["suzi.glb", "bunny.glb", "bend.glb"] {
        let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/scenes").join(name);
        std::fs::copy(kept, scenes.join(name)).expect("a scene");
    }
    std::fs::write(folder.join("points.csv"), "x,y,z,nx,ny,nz\n60,0,0,0,1,0\n150,0,150,0,1,0\n").expect("a file");
    folder
}

/// Runs a line of a shell that must succeed, and returns what it printed.
pub fn shell(folder: &Path, line: &str) -> String {
    let programs = Path::new(BINARY).parent().expect("a folder").display();
    let path = format!("{programs}:{}", std::env::var("PATH").unwrap_or_default());
    let ran =
        Command::new("sh").args(["-e", "-c", line]).current_dir(folder).env("PATH", path).output().expect("a shell");
    assert!(ran.status.success(), "{line}: {}", String::from_utf8_lossy(&ran.stderr));
    String::from_utf8(ran.stdout).expect("text")
}

/// The lines of a text that call the program, in order.
fn lines(text: &str) -> Vec<&str> {
    let calls = |line: &&str| line.starts_with("umbrage ") || line.contains("| umbrage ");
    text.lines().map(str::trim).filter(calls).map(|line| line.split(" #").next().unwrap_or(line).trim()).collect()
}

#[test]
fn every_example_of_help_runs() {
    let folder = folder("examples-help");
    // Maps are baked before they are looked up.
    let commands =
        ["render", "shadow", "compare", "gather", "jobs", "bake", "export", "info", "lookup", "recipes", "scenes"];
    for command in commands {
        let help = shell(&folder, &format!("umbrage {command} --help"));
        let (_, examples) = help.split_once("Examples:").expect("examples");
        let examples = lines(examples);
        let shown = if ["render", "shadow", "compare"].contains(&command) { 3 } else { 2 };
        assert_eq!(examples.len(), shown, "{command}: {examples:?}");
        for line in examples {
            shell(&folder, line);
        }
    }
    assert_eq!(std::fs::read_to_string(folder.join("fractions.txt")).expect("a file"), "1.000000000\n0.000000000\n");
}

/// A page of the repository.
fn page(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)).expect("a page")
}

/// The first block of a language behind a heading.
fn block<'a>(text: &'a str, heading: &str, language: &str) -> &'a str {
    let (_, section) = text.split_once(heading).expect("a section about the command");
    let (_, block) = section.split_once(&format!("```{language}\n")).expect("a block");
    block.split_once("\n```").expect("its end").0
}

#[test]
fn every_example_of_the_commands_page_runs() {
    let folder = folder("examples-page");
    let page = page("crates/TOOL.md");
    let lines = lines(block(&page, "# The `umbrage` command", "sh"));
    assert!(lines.len() >= 12, "{lines:?}");
    for line in lines {
        shell(&folder, line);
    }
}

#[test]
fn the_readmes_example_prints_what_stands_beside_it() {
    let folder = folder("examples-readme");
    let readme = page("README.md");
    let lines = lines(block(&readme, "## From the shell", "sh"));
    let [line] = lines[..] else { panic!("{lines:?}") };
    assert_eq!(shell(&folder, line).trim_end(), block(&readme, "## From the shell", "text"));
}
