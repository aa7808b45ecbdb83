//! The program behind `cargo xtask figures`.

use clap::Parser;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use umbrage_depth::Storage;
use umbrage_figures::{Context, Run, Truths, catalogue, goldens};
use umbrage_report::{Verdict, summary};

/// Make the papers' figures, each beside the truth and with a verdict, and a page to look at them
#[derive(Parser)]
#[command(name = "cargo xtask figures", bin_name = "cargo xtask figures")]
#[expect(clippy::struct_excessive_bools, reason = "the switches of a command line")]
struct Cli {
    /// Make only these figures; others that the folder already holds stay on the page
    #[arg(long, num_args = 1.., value_name = "ID")]
    only: Vec<String>,
    /// Smaller pictures and fewer samples; bounds that need full size are not judged
    #[arg(long)]
    quick: bool,
    /// The folder that is filled
    #[arg(long, value_name = "DIR", default_value = "target/figures")]
    out: PathBuf,
    /// Compare the README's pictures and the recorded numbers with what the code makes
    #[arg(long, conflicts_with_all = ["quick", "list", "seed"])]
    check: bool,
    /// Renew the README's pictures and the recorded numbers
    #[arg(long, conflicts_with_all = ["quick", "list", "seed", "check", "only"])]
    bless: bool,
    /// List the figures and make none
    #[arg(long)]
    list: bool,
    /// Worker threads, one per core unless given; changes no result
    #[arg(long, value_name = "N", value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=1024))]
    threads: Option<usize>,
    /// Seed of all randomness
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// How maps are kept while they are looked up; changes no result
    #[arg(long, value_name = "raw|bbox|tiled", default_value = "tiled")]
    storage: Storage,
}

/// The outcome of the run, as its exit code.
enum Outcome {
    /// 0: all is well.
    Good,
    /// 1: something is not as it must be.
    Failed,
    /// 2: the command line names something that does not exist.
    Usage,
    /// 3: a figure misses a bound.
    Missed,
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    // A panic is a defect of this program; it has been printed by then, and ends as any failure.
    match std::panic::catch_unwind(|| run(&cli)) {
        Ok(Ok(Outcome::Good)) => ExitCode::SUCCESS,
        Ok(Ok(Outcome::Usage)) => ExitCode::from(2),
        Ok(Ok(Outcome::Missed)) => ExitCode::from(3),
        Ok(Ok(Outcome::Failed)) | Err(_) => ExitCode::FAILURE,
        Ok(Err(error)) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// The repository, two folders above this package.
fn root() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().nth(2).unwrap_or(package)
}

fn run(cli: &Cli) -> anyhow::Result<Outcome> {
    let chosen = match catalogue::choose(&cli.only) {
        Ok(chosen) => chosen,
        Err(id) => {
            eprintln!("error: there is no figure {id:?}; cargo xtask figures --list lists them all");
            return Ok(Outcome::Usage);
        }
    };
    if cli.list {
        for figure in chosen {
            println!("{:10}  {:28}  {}", figure.id, figure.paper.name(), figure.title);
        }
        return Ok(Outcome::Good);
    }
    let context = Context { quick: cli.quick, seed: cli.seed, storage: cli.storage, truths: Truths::default() };
    let run = Run { figures: chosen, context, threads: cli.threads, out: cli.out.clone() };
    if cli.check || cli.bless {
        let all = goldens::all(&run)?;
        if cli.bless {
            all.write(root())?;
            return Ok(Outcome::Good);
        }
        let findings = all.compare(root());
        for finding in &findings {
            println!("{finding}");
        }
        println!("check: {} difference{}", findings.len(), if findings.len() == 1 { "" } else { "s" });
        return Ok(if findings.is_empty() { Outcome::Good } else { Outcome::Failed });
    }
    let report = run.make()?;
    println!("{}", summary(&report, &cli.out));
    Ok(if report.count(Verdict::Missed) > 0 { Outcome::Missed } else { Outcome::Good })
}
