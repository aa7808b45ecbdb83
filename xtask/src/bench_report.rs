//! Measures ours beside peers and makes a page of it: builds the program of `umbrage-bench`, runs it, and hands its rows on.

mod counts;
mod limits;
mod page;
mod program;
mod rows;
mod scale;

use anyhow::{Context as _, bail, ensure};
use page::{Column, Facts};
use program::{Flags, built, rustc};
use rows::Report;
use scale::Scale;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

const HELP: &str = "\
Measure beside peers

Usage: cargo xtask bench-report [OPTIONS]

Options:
      --native        Also compile for this machine's own processor, with fat LTO, and put both side by side
      --quick         Small workloads, each once: for the assertions, in seconds; no goal is judged
      --scale         Instead: how time and memory grow with triangles, maps and pictures, up to 10^8 triangles, maps of
                      32,768 and pictures of 8,192 a side; takes several minutes, 8 GB of memory and 1 GB of temporary disk
      --out DIR       Where the table (.md) and the chart (.svg) go [default: target/bench-report]
      --instructions  Instead: count the instructions of the hottest kernels under valgrind, compare them with the
                      recorded ones, and look for closures that were not inlined
      --bless         With --instructions: record what was counted
";

/// What the command line wants.
#[derive(Debug, PartialEq, Eq)]
enum Wanted {
    /// The report.
    Report {
        native: bool,
        quick: bool,
        out: Option<PathBuf>,
    },
    /// Growth of time and memory.
    Scale {
        quick: bool,
        out: Option<PathBuf>,
    },
    /// Counts of instructions.
    Counts {
        bless: bool,
    },
    Help,
}

impl Wanted {
    fn parse(args: &[OsString]) -> anyhow::Result<Self> {
        let (mut native, mut quick, mut scale, mut out, mut counts, mut bless) = Default::default();
        let mut args = args.iter();
        while let Some(arg) = args.next() {
            match arg.to_str() {
                Some("--help" | "-h") => return Ok(Self::Help),
                Some("--native") => native = true,
                Some("--quick") => quick = true,
                Some("--scale") => scale = true,
                Some("--instructions") => counts = true,
                Some("--bless") => bless = true,
                Some("--out") => out = Some(args.next().context("--out wants a folder")?.into()),
                _ => bail!("bench-report has no option {:?}", arg.display().to_string()),
            }
        }
        if counts {
            ensure!(!native && !quick && !scale && out.is_none(), "--instructions goes with --bless alone");
            return Ok(Self::Counts { bless });
        }
        ensure!(!bless, "--bless goes with --instructions alone");
        if scale {
            ensure!(!native, "--scale goes with --quick and --out alone");
            return Ok(Self::Scale { quick, out });
        }
        Ok(Self::Report { native, quick, out })
    }
}

/// Runs the chore. Whether all went well: a goal that is missed is a fact of the report and not a failure.
pub fn run(root: &Path, args: &[OsString]) -> anyhow::Result<bool> {
    match Wanted::parse(args)? {
        Wanted::Report { native, quick, out } => report(root, native, quick, out)?,
        Wanted::Scale { quick, out } => scaled(root, quick, out)?,
        Wanted::Counts { bless } => return counts::run(root, bless),
        Wanted::Help => print!("{HELP}"),
    }
    Ok(true)
}

/// Beside peers.
fn report(root: &Path, native: bool, quick: bool, out: Option<PathBuf>) -> anyhow::Result<()> {
    let small: &[&str] = if quick { &["--quick"] } else { &[] };
    let column = |flags, title, args: &[&str]| -> anyhow::Result<Column> {
        Ok(Column { flags: title, report: Report::parse(&measured(root, flags, args, &KEPT)?)? })
    };
    let mut columns = vec![column(Flags::Default, "default flags", small)?];
    if native {
        columns.push(column(Flags::Native, "target-cpu=native, fat LTO", &[small, &["--native"]].concat())?);
    }
    let facts = Facts { processor: processor(), rustc: rustc()?, quick };
    write(root, out, "bench-report", &page::markdown(&facts, &columns), &page::svg(&facts, &columns))
}

/// By size.
fn scaled(root: &Path, quick: bool, out: Option<PathBuf>) -> anyhow::Result<()> {
    let args: &[&str] = if quick { &["--scale", "--quick"] } else { &["--scale"] };
    let found = Scale::parse(&measured(root, Flags::Default, args, &[])?)?;
    let facts = Facts { processor: processor(), rustc: rustc()?, quick };
    write(root, out, "scale", &scale::markdown(&facts, &found), &scale::svg(&facts, &found))
}

/// Writes a table and a chart, and prints where they are.
fn write(root: &Path, out: Option<PathBuf>, name: &str, table: &str, chart: &str) -> anyhow::Result<()> {
    let folder = out.unwrap_or_else(|| root.join("target/bench-report"));
    std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    for (extension, text) in [("md", table), ("svg", chart)] {
        let file = folder.join(name).with_extension(extension);
        std::fs::write(&file, text).with_context(|| file.display().to_string())?;
        println!("{}", file.display());
    }
    Ok(())
}

/// What makes glibc keep memory that is freed, that of threads too. By itself it gives some of it back, depending on what else was allocated before, and
/// needs it again in the next run: a quarter of a bake of a large map is spent so, or none of it. Peers draw into buffers that they keep.
const KEPT: [(&str, &str); 3] =
    [("MALLOC_TOP_PAD_", "67108864"), ("MALLOC_TRIM_THRESHOLD_", "1073741824"), ("MALLOC_MMAP_THRESHOLD_", "33554432")];

/// What the program prints.
fn measured(root: &Path, flags: Flags, args: &[&str], settings: &[(&str, &str)]) -> anyhow::Result<String> {
    let program = built(root, flags)?;
    eprintln!("Measuring, which takes minutes; leave the machine alone.");
    let mut command = Command::new(&program);
    command.args(args).envs(settings.iter().copied()).stderr(std::process::Stdio::inherit());
    let output = command.output();
    let output = output.with_context(|| program.display().to_string())?;
    ensure!(output.status.success(), "{} failed", program.display());
    Ok(String::from_utf8(output.stdout)?)
}

/// The model of the processor, where the system knows it.
fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let value = |name: &str| {
        let line = text.lines().find(|line| line.starts_with(name))?;
        line.split_once(':').map(|(_, value)| value.trim().to_string())
    };
    let Some(name) = value("model name") else { return "unknown".into() };
    match (value("cpu family"), value("model")) {
        (Some(family), Some(model)) => format!("{name} (family {family}, model {model})"),
        _ => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(args: &[&str]) -> anyhow::Result<Wanted> {
        Wanted::parse(&args.iter().map(OsString::from).collect::<Vec<_>>())
    }

    #[test]
    fn options_are_known_and_stand_in_the_help() {
        let all = of(&["--native", "--quick", "--out", "there"]).unwrap();
        assert_eq!(all, Wanted::Report { native: true, quick: true, out: Some("there".into()) });
        let scale = of(&["--scale", "--quick", "--out", "there"]).unwrap();
        assert_eq!(scale, Wanted::Scale { quick: true, out: Some("there".into()) });
        assert_eq!(of(&["--instructions", "--bless"]).unwrap(), Wanted::Counts { bless: true });
        assert_eq!(of(&["--quick", "-h"]).unwrap(), Wanted::Help);
        for option in ["--native", "--quick", "--scale", "--out", "--instructions", "--bless"] {
            assert!(HELP.contains(&format!("      {option} ")), "{option}");
        }
    }

    #[test]
    fn what_does_not_go_together_is_refused() {
        for args in [
            &["--instructions", "--quick"][..],
            &["--scale", "--native"],
            &["--scale", "--instructions"],
            &["--bless"],
            &["--out"],
            &["now"],
        ] {
            assert!(of(args).is_err(), "{args:?}");
        }
    }
}
