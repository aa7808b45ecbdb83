//! The project's chores: `figures`, `ci`, `tidy`, `api`, `dist`, `publish-check`, `bench-report`. This program starts others and reads sources; it uses no crate of
//! Umbrage, so that it is there in seconds.

mod api;
mod bench_report;
mod ci;
mod dist;
mod figures;
mod programs;
mod publish;
mod readme;
mod tidy;

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const HELP: &str = "\
Umbrage's chores

Usage: cargo xtask <COMMAND>

Commands:
  figures  Make the papers' figures, each beside the truth and with a verdict, and a page to look at them;
           `cargo xtask figures --help` lists its options
  ci       Everything that must hold before a change is taken
  tidy     Check dependency arrows, circles of modules, allowed packages, file sizes, links and words that must not be there
  api      Compare what the renderer's crates offer with what is kept of it; with --bless keep what they offer now
  dist     Build the command, and pack it with its manual pages and completions: a tarball and a Debian package in target/dist
  publish-check
           Run the dry run of publishing all crates on a copy of the repository; with --no-verify without compiling them
  bench-report
           Measure beside other rasterisers, rays and the memory's limit, and make a table and a diagram of it;
           `cargo xtask bench-report --help` lists its options
  help     Print this
";

/// What the command line wants.
#[derive(Debug, PartialEq, Eq)]
enum Chore {
    /// The figures' program with these arguments.
    Figures(Vec<OsString>),
    /// The report of measurements, with its options.
    BenchReport(Vec<OsString>),
    Ci,
    Tidy,
    Dist,
    /// What the crates offer, compared or kept.
    Api {
        bless: bool,
    },
    /// The dry run of publishing, with every package compiled or not.
    PublishCheck {
        verify: bool,
    },
    Help,
}

/// The chore of a command line without the program's own name, or what is wrong with it.
fn chore(args: impl IntoIterator<Item = OsString>) -> Result<Chore, String> {
    let mut args = args.into_iter();
    let name = args.next().ok_or("a command is missing")?;
    let rest: Vec<OsString> = args.collect();
    let chore = match name.to_str() {
        Some("figures") => return Ok(Chore::Figures(rest)),
        Some("bench-report") => return Ok(Chore::BenchReport(rest)),
        Some("help" | "--help" | "-h") => return Ok(Chore::Help),
        Some("api") if rest == ["--bless"] => return Ok(Chore::Api { bless: true }),
        Some("api") => Chore::Api { bless: false },
        Some("publish-check") if rest == ["--no-verify"] => return Ok(Chore::PublishCheck { verify: false }),
        Some("publish-check") => Chore::PublishCheck { verify: true },
        Some("ci") => Chore::Ci,
        Some("tidy") => Chore::Tidy,
        Some("dist") => Chore::Dist,
        _ => return Err(format!("there is no command {:?}", name.display().to_string())),
    };
    match rest.first() {
        None => Ok(chore),
        Some(flag) if flag == "--help" || flag == "-h" => Ok(Chore::Help),
        Some(other) => {
            Err(format!("{} takes no argument, so {:?} means nothing", name.display(), other.display().to_string()))
        }
    }
}

fn main() -> ExitCode {
    let chore = match chore(std::env::args_os().skip(1)) {
        Ok(chore) => chore,
        Err(fault) => {
            eprint!("error: {fault}\n\n{HELP}");
            return ExitCode::from(2);
        }
    };
    let ended = match chore {
        Chore::Figures(args) => figures::run(&root(), &args),
        Chore::BenchReport(args) => bench_report::run(&root(), &args).map(good_or_failed),
        Chore::Ci => ci::run(&root()).map(good_or_failed),
        Chore::Tidy => tidy(&root()).map(good_or_failed),
        Chore::Dist => dist::run(&root()).map(good_or_failed),
        Chore::Api { bless } => api::run(&root(), bless).map(good_or_failed),
        Chore::PublishCheck { verify } => publish::run(&root(), verify).map(good_or_failed),
        Chore::Help => {
            print!("{HELP}");
            Ok(ExitCode::SUCCESS)
        }
    };
    ended.unwrap_or_else(|error| {
        eprintln!("error: {error:#}");
        ExitCode::FAILURE
    })
}

fn good_or_failed(good: bool) -> ExitCode {
    if good { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The repository: this package's parent folder.
fn root() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package).to_path_buf()
}

/// Prints every finding; whether there is none.
fn tidy(root: &Path) -> anyhow::Result<bool> {
    let findings = tidy::findings(root)?;
    for finding in &findings {
        println!("{finding}");
    }
    println!("tidy: {} finding{}", findings.len(), if findings.len() == 1 { "" } else { "s" });
    Ok(findings.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(args: &[&str]) -> Result<Chore, String> {
        chore(args.iter().map(OsString::from))
    }

    #[test]
    fn chores_are_known_by_name_and_every_one_stands_in_the_help() {
        assert_eq!(of(&["ci"]), Ok(Chore::Ci));
        assert_eq!(of(&["tidy"]), Ok(Chore::Tidy));
        for help in ["help", "--help", "-h"] {
            assert_eq!(of(&[help]), Ok(Chore::Help));
        }
        assert_eq!(of(&["ci", "--help"]), Ok(Chore::Help));
        assert_eq!(of(&["dist"]), Ok(Chore::Dist));
        assert_eq!(of(&["publish-check"]), Ok(Chore::PublishCheck { verify: true }));
        assert_eq!(of(&["publish-check", "--no-verify"]), Ok(Chore::PublishCheck { verify: false }));
        assert_eq!(of(&["api"]), Ok(Chore::Api { bless: false }));
        assert_eq!(of(&["api", "--bless"]), Ok(Chore::Api { bless: true }));
        let names = ["figures ", "ci ", "tidy ", "api ", "dist ", "publish-check\n", "bench-report\n"];
        assert!(names.iter().all(|name| HELP.contains(&format!("\n  {name}"))));
    }

    #[test]
    fn the_arguments_of_figures_and_of_the_report_go_on_as_they_are() {
        let args = ["--only", "R87-F7", "--help", "--", "-q"];
        let all = of(&[&["figures"], args.as_slice()].concat());
        assert_eq!(all, Ok(Chore::Figures(args.map(OsString::from).to_vec())));
        assert_eq!(of(&["bench-report", "-h"]), Ok(Chore::BenchReport(vec!["-h".into()])));
    }

    #[test]
    fn a_command_line_that_makes_no_sense_is_refused() {
        assert_eq!(of(&[]).unwrap_err(), "a command is missing");
        assert_eq!(of(&["figure"]).unwrap_err(), "there is no command \"figure\"");
        assert_eq!(of(&["tidy", "now"]).unwrap_err(), "tidy takes no argument, so \"now\" means nothing");
    }
}
