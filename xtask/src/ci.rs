//! Everything that must hold before a change is taken, in one order, here and on any server.

use crate::programs::cargo;
use anyhow::Context as _;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// Runs every step, goes on after one that fails, and says at the end how each went. Whether all went well.
pub fn run(root: &Path) -> anyhow::Result<bool> {
    let settings = quick_to_compile();
    let mut steps = Steps { root, settings: &settings, ended: Vec::new() };
    let mut tests = Vec::new();
    steps.cargo("format", &["fmt", "--all", "--check"], &[])?;
    steps.cargo("lints", &["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"], &[])?;
    steps.cargo("tests, compiled", &["test", "--workspace", "--no-run"], &[])?;
    // Tests leave a processor idle now and then: figures are made meanwhile, by the program as it is tested. It is not compiled a second
    // time as its users have it, since optimising changes no bit of what it draws.
    let quick = steps.figures(&["--quick", "--out", "target/ci-figures/quick"]);
    let quick = std::thread::spawn(move || { quick }.output());
    steps.tests("tests", &["test", "--workspace"], &mut tests)?;
    steps.step("examples", || run_examples(root))?;
    steps.step("README's program in a package of its own", || crate::readme::run(root, &settings))?;
    // A page that links nowhere is worse than none.
    steps.cargo("documentation", &["doc", "--no-deps", "--workspace"], &[("RUSTDOCFLAGS", "-D warnings")])?;
    steps.own("tidy", &["tidy"])?;
    steps.own("packages for the registry", &["publish-check", "--no-verify"])?;
    steps.step("quick figures", || match quick.join() {
        Ok(Ok(made)) => {
            print!("{}{}", String::from_utf8_lossy(&made.stderr), String::from_utf8_lossy(&made.stdout));
            Ok(made.status.success())
        }
        // The program is missing when the tests did not compile.
        other => {
            println!("not made: {other:?}");
            Ok(false)
        }
    })?;
    // The quick figures stand there already and are used again.
    let mut check = steps.figures(&["--check", "--out", "target/ci-figures"]);
    steps.step("kept pictures and numbers", || Ok(check.status().is_ok_and(|status| status.success())))?;
    Ok(steps.tell(&tests))
}

/// Cargo's settings under which everything is compiled that is run once: without debug information, and where this machine's
/// processor is of the level x86-64-v3, for that level only, which nearly halves the code of filters. Results are the same bits.
fn quick_to_compile() -> Vec<(&'static str, &'static str)> {
    let mut settings = vec![
        // What is compiled once needs no pieces to be compiled again from: without them the tests of filters take 40 % of the time.
        ("CARGO_INCREMENTAL", "0"),
        ("CARGO_PROFILE_DEV_LTO", "off"),
        ("CARGO_PROFILE_DEV_DEBUG", "none"),
        ("CARGO_PROFILE_RELEASE_DEBUG", "none"),
    ];
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::is_x86_feature_detected as has;
        let vectors = has!("avx2") && has!("fma") && has!("f16c");
        let nobody_chose = std::env::var_os("RUSTFLAGS").is_none();
        if nobody_chose && vectors && has!("bmi1") && has!("bmi2") && has!("lzcnt") && has!("movbe") && has!("xsave") {
            settings.push(("RUSTFLAGS", "-C target-cpu=x86-64-v3"));
        }
    }
    settings
}

/// Runs every example program as the tests' step left it, goes on after one that fails, and says which did. Whether all went well.
fn run_examples(root: &Path) -> anyhow::Result<bool> {
    let names = examples(root)?;
    anyhow::ensure!(!names.is_empty(), "there is no example");
    let mut all = true;
    for name in names {
        println!("--- {name}");
        let program = tested(root, &format!("examples/{name}"));
        let good = Command::new(&program).current_dir(root).status().with_context(|| program.display().to_string())?;
        if !good.success() {
            println!("{name} FAILED");
        }
        all &= good.success();
    }
    Ok(all)
}

/// The path of a program that the tests' step compiled.
fn tested(root: &Path, name: &str) -> PathBuf {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |folder| root.join(folder));
    target.join("debug").join(name).with_extension(std::env::consts::EXE_EXTENSION)
}

/// The names of all example programs, in order.
fn examples(root: &Path) -> anyhow::Result<Vec<String>> {
    let folder = root.join("examples/examples");
    let mut names = Vec::new();
    for entry in std::fs::read_dir(&folder).with_context(|| folder.display().to_string())? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "rs") {
            names.extend(path.file_stem().map(|name| name.to_string_lossy().into_owned()));
        }
    }
    names.sort_unstable();
    Ok(names)
}

struct Steps<'a> {
    root: &'a Path,
    /// Variables of the environment of all that is started.
    settings: &'a [(&'static str, &'static str)],
    ended: Vec<(&'static str, bool, f64)>,
}

impl Steps<'_> {
    fn command(&self, program: impl AsRef<std::ffi::OsStr>, args: &[&str]) -> Command {
        let mut command = Command::new(program);
        command.args(args).envs(self.settings.iter().copied()).current_dir(self.root);
        command
    }

    /// The program that makes the figures, as it was compiled for its tests.
    fn figures(&self, args: &[&str]) -> Command {
        self.command(tested(self.root, "umbrage-figures"), args)
    }

    fn step(&mut self, name: &'static str, run: impl FnOnce() -> anyhow::Result<bool>) -> anyhow::Result<()> {
        println!("\n=== {name} ===");
        let start = Instant::now();
        let good = run().context(name)?;
        self.ended.push((name, good, start.elapsed().as_secs_f64()));
        Ok(())
    }

    fn cargo(&mut self, name: &'static str, args: &[&str], environment: &[(&str, &str)]) -> anyhow::Result<()> {
        let mut command = self.command(cargo(), args);
        command.envs(environment.iter().copied());
        self.step(name, || Ok(command.status()?.success()))
    }

    /// One of this program's own chores, as its user would run it.
    fn own(&mut self, name: &'static str, args: &[&str]) -> anyhow::Result<()> {
        let mut command = self.command(std::env::current_exe()?, args);
        self.step(name, || Ok(command.status()?.success()))
    }

    /// The tests, printed as they come; the closing line of each program is kept in `closing`.
    fn tests(&mut self, name: &'static str, args: &[&str], closing: &mut Vec<String>) -> anyhow::Result<()> {
        let mut command = self.command(cargo(), args);
        self.step(name, || {
            let mut child = command.stdout(Stdio::piped()).spawn()?;
            if let Some(output) = child.stdout.take() {
                for line in BufReader::new(output).lines() {
                    let line = line?;
                    println!("{line}");
                    if line.starts_with("test result:") {
                        closing.push(line);
                    }
                }
            }
            Ok(child.wait()?.success())
        })
    }

    fn tell(&self, tests: &[String]) -> bool {
        println!("\n=== summary ===");
        for (name, good, seconds) in &self.ended {
            println!("{:6}  {seconds:6.1} s  {name}", if *good { "ok" } else { "FAILED" });
        }
        for line in tests {
            println!("{line}");
        }
        let (passed, failed) = sum(tests);
        println!("{passed} passed, {failed} failed");
        self.ended.iter().all(|(_, good, _)| *good)
    }
}

/// Passed and failed tests over all closing lines.
fn sum(closing: &[String]) -> (u64, u64) {
    let count = |line: &str, what: &str| -> u64 {
        let before = line.split([';', '.']).find_map(|part| part.trim().strip_suffix(what));
        before.and_then(|number| number.trim().parse().ok()).unwrap_or(0)
    };
    closing.iter().fold((0, 0), |sum, line| (sum.0 + count(line, "passed"), sum.1 + count(line, "failed")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closing_lines_are_summed() {
        let lines = [
            "test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.01s",
            "test result: FAILED. 3 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out; finished in 1.20s",
        ];
        assert_eq!(sum(&lines.map(String::from)), (15, 2));
        assert_eq!(sum(&[]), (0, 0));
    }
}
