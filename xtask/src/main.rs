//! The project's chores: `figures`, `ci`, `tidy`.

mod ci;
mod diagram;
mod figure;
#[expect(clippy::unnecessary_wraps, reason = "all figures are made by functions of one type")]
mod figures;
mod folder;
mod goldens;
mod page;
mod plot;
mod record;
mod run;
mod text;
mod tidy;

use clap::{Args, Parser, Subcommand};
use figure::{Context, Figure, Verdict};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use umbrage_render::Storage;

/// Umbrage's chores.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Make the papers' figures, each beside the truth and with a verdict, and a page to look at them
    Figures(FiguresArgs),
    /// Everything that must hold before a change is taken
    Ci,
    /// Check dependency arrows, allowed packages, file sizes, links and words that must not be there
    Tidy,
}

#[derive(Args)]
#[expect(clippy::struct_excessive_bools, reason = "the switches of a command line")]
struct FiguresArgs {
    /// Only these figures
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
    /// Worker threads, one a core unless told; changes no result
    #[arg(long, value_name = "N", value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=1024))]
    threads: Option<usize>,
    /// Seed of all randomness
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// How maps are kept while they are looked up; changes no result
    #[arg(long, value_name = "raw|bbox|tiled", default_value = "tiled")]
    storage: Storage,
}

/// What a chore ends with, as the exit code says it.
enum Outcome {
    /// 0: all is well.
    Good,
    /// 1: something is not as it must be.
    Failed,
    /// 2: the command line asks for what there is not.
    Usage,
    /// 3: a figure is missed.
    Missed,
}

fn main() -> ExitCode {
    let chore = Cli::parse().chore;
    // A panic is a defect of ours; it has been printed by then, and ends as any failure.
    let ended = std::panic::catch_unwind(|| match chore {
        Chore::Figures(args) => figures(&args),
        Chore::Ci => ci::run(&root()).map(good_or_failed),
        Chore::Tidy => tidy(&root()),
    });
    match ended {
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

fn good_or_failed(good: bool) -> Outcome {
    if good { Outcome::Good } else { Outcome::Failed }
}

/// The repository: this package's parent folder.
fn root() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package).to_path_buf()
}

fn tidy(root: &Path) -> anyhow::Result<Outcome> {
    let findings = tidy::findings(root)?;
    for finding in &findings {
        println!("{finding}");
    }
    println!("tidy: {} findings", findings.len());
    Ok(good_or_failed(findings.is_empty()))
}

fn figures(args: &FiguresArgs) -> anyhow::Result<Outcome> {
    let chosen = match choose(figures::FIGURES, &args.only) {
        Ok(chosen) => chosen,
        Err(id) => {
            eprintln!("error: there is no figure {id:?}; cargo xtask figures --list names them all");
            return Ok(Outcome::Usage);
        }
    };
    if args.list {
        for figure in chosen {
            println!("{:10}  {:28}  {}", figure.id, figure.paper.name(), figure.title);
        }
        return Ok(Outcome::Good);
    }
    let context = Context { quick: args.quick, seed: args.seed, storage: args.storage };
    let run = run::Run { figures: chosen, context, threads: args.threads, out: args.out.clone() };
    if args.check || args.bless {
        let all = goldens::all(&run)?;
        return if args.bless {
            all.write(&root())?;
            Ok(Outcome::Good)
        } else {
            let findings = all.compare(&root());
            for finding in &findings {
                println!("{finding}");
            }
            println!("check: {} differences", findings.len());
            Ok(good_or_failed(findings.is_empty()))
        };
    }
    let report = run.make()?;
    println!("{}", run::summary(&report, &args.out));
    Ok(if report.count(Verdict::Missed) > 0 { Outcome::Missed } else { Outcome::Good })
}

/// The figures of the catalogue with these ids, in the catalogue's order; all for no id. An id that is unknown is the error.
fn choose<'a>(catalogue: &[&'a Figure], ids: &[String]) -> Result<Vec<&'a Figure>, String> {
    let known = |id: &String| catalogue.iter().any(|figure| figure.id.eq_ignore_ascii_case(id));
    if let Some(unknown) = ids.iter().find(|id| !known(id)) {
        return Err(unknown.clone());
    }
    let asked = |figure: &&&Figure| ids.is_empty() || ids.iter().any(|id| figure.id.eq_ignore_ascii_case(id));
    Ok(catalogue.iter().filter(asked).copied().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_sound() {
        use clap::CommandFactory;
        Cli::command().debug_assert();
    }

    #[test]
    fn ids_of_the_catalogue_are_unique_and_fit_for_folders() {
        let mut ids: Vec<&str> = figures::FIGURES.iter().map(|figure| figure.id).collect();
        assert!(ids.iter().all(|id| id.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-')), "{ids:?}");
        ids.sort_unstable();
        assert!(ids.windows(2).all(|pair| !pair[0].eq_ignore_ascii_case(pair[1])), "{ids:?}");
        let papers: Vec<_> = figures::FIGURES.iter().map(|figure| figure.paper).collect();
        assert!(papers.is_sorted(), "papers are told one after another");
    }

    #[test]
    fn figures_are_chosen_by_id_in_the_order_of_the_catalogue() {
        let ids = |only: &[&str]| {
            let only: Vec<String> = only.iter().map(ToString::to_string).collect();
            choose(figures::FIGURES, &only).map(|chosen| chosen.iter().map(|figure| figure.id).collect::<Vec<_>>())
        };
        assert_eq!(ids(&[]).unwrap().len(), figures::FIGURES.len());
        assert_eq!(ids(&["r87-f7", "W78-F1"]).unwrap(), ["W78-F1", "R87-F7"]);
        assert_eq!(ids(&["W78-F1", "R87-F77"]).unwrap_err(), "R87-F77");
    }
}
