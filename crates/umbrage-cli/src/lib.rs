//! The `umbrage` command as a function, so that tests can call it: [`run`].
//!
//! ```text
//! cargo install umbrage-cli
//!
//! umbrage render room.glb -o room.png      the lit picture
//! umbrage shadow room.glb -o shadows       the fraction in shadow alone, one file for each light
//! umbrage compare room.glb -o compared     every method beside rays, each fault by name
//! umbrage help                             the other commands
//! ```
//!
//! Each command is a few calls that a user of the libraries could make. This crate has no other interface and no features.

mod args;
mod bake;
mod bias;
mod compare;
mod compare_args;
mod digest;
mod draws;
mod explain;
mod export;
mod farm;
mod gather;
mod generate;
mod info;
mod lamp;
mod lights;
mod listing;
mod lookup;
mod manifest;
mod maps;
mod memory;
mod names;
mod paint;
mod parts;
mod pictures;
mod render;
mod report;
mod scores;
mod shadow;
mod shell;
mod stage;
mod takes;
mod turns;
mod values;
mod view;

use args::{Cli, Command};
use clap::Parser;
use shell::{Exceeded, Output, Shell, Usage, line};
use std::ffi::OsString;
use std::io::{BufRead, ErrorKind, Write};

/// Runs a command line, the program's name first, and returns its exit code: 0 for success, 1 for a failure, 2 for an invalid command line, 3
/// where `compare` found more than `--fail-above` allows. Every failure is one line on `err`. If `err` `is_terminal`, errors have colours and
/// progress bars are drawn on the process's standard error.
pub fn run(
    args: impl IntoIterator<Item = OsString>,
    input: &mut dyn BufRead,
    out: &mut dyn Write,
    err: &mut dyn Write,
    is_terminal: bool,
) -> u8 {
    let args: Vec<OsString> = args.into_iter().collect();
    let coloured = is_coloured(&args, is_terminal);
    let cli = match Cli::try_parse_from(args) {
        Ok(cli) => cli,
        Err(error) => {
            let text = error.render();
            let (to, code): (&mut dyn Write, u8) = if error.use_stderr() { (err, 2) } else { (out, 0) };
            let _ = if coloured { write!(to, "{}", text.ansi()) } else { write!(to, "{text}") };
            return code;
        }
    };
    let mut out = Output(out);
    let mut shell = Shell { input, out: &mut out, err, quiet: cli.quiet, verbose: cli.verbose, is_terminal };
    let done = with_threads(cli.threads.map(usize::from), &mut shell, |shell| {
        command(&cli, shell)?;
        // What is still in a buffer is not written yet.
        Ok(shell.out.flush()?)
    });
    match done {
        Ok(()) => 0,
        Err(error) if is_closed(&error) => 0,
        Err(error) => {
            let line = line(&error);
            let error_word = if coloured { "\x1b[1;31merror:\x1b[0m" } else { "error:" };
            let _ = writeln!(err, "{error_word} {line}");
            match error {
                error if error.is::<Usage>() => 2,
                error if error.is::<Exceeded>() => 3,
                _ => 1,
            }
        }
    }
}

/// Whether errors and help are coloured. `--color` is found before the command line is parsed, so that it also holds for errors of parsing.
fn is_coloured(args: &[OsString], is_terminal: bool) -> bool {
    let words: Vec<&str> = args.iter().filter_map(|arg| arg.to_str()).collect();
    let joined = words.iter().find_map(|word| word.strip_prefix("--color="));
    let apart = words.windows(2).find(|pair| pair[0] == "--color").map(|pair| pair[1]);
    match joined.or(apart) {
        Some("always") => true,
        Some("never") => false,
        _ => is_terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
    }
}

fn command(cli: &Cli, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    match &cli.command {
        Command::Render(args) => render::run(cli, args, shell),
        Command::Shadow(args) => shadow::run(cli, args, shell),
        Command::Gather(args) => gather::run(cli, args, shell),
        Command::Jobs(args) => farm::run(args, shell),
        Command::Compare(args) => compare::run(cli, args, shell),
        Command::Bake(args) => bake::run(cli, args, shell),
        Command::Bias(args) => bias::run(cli, args, shell),
        Command::Explain(args) => explain::run(cli, args, shell),
        Command::Export(args) => export::run(cli, args, shell),
        Command::Info(args) => info::run(cli, args, shell),
        Command::Lookup(args) => lookup::run(cli, args, shell),
        Command::View(args) => view::run(cli, args, shell),
        Command::Recipes(args) => listing::recipes(cli, args, shell),
        Command::Scenes => listing::scenes(cli, shell),
        Command::Generate(args) => generate::run(args),
    }
}

/// Calls `work` on this many threads; no result depends on their number.
fn with_threads(
    threads: Option<usize>,
    shell: &mut Shell<'_>,
    work: impl FnOnce(&mut Shell<'_>) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    if let Some(threads) = threads {
        // A pool may already exist in a program that calls this function twice.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
    }
    work(shell)
}

/// Whether the reader of what was written has gone away.
fn is_closed(error: &anyhow::Error) -> bool {
    let closed = |cause: &std::io::Error| cause.kind() == ErrorKind::BrokenPipe;
    error.chain().any(|cause| cause.downcast_ref::<std::io::Error>().is_some_and(closed))
}
