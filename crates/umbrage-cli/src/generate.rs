//! `umbrage generate`: what packages install beside the program.

use crate::args::{Cli, GenerateArgs, What};
use anyhow::Context;
use clap::{CommandFactory, ValueEnum};
use clap_complete::Shell;
use umbrage_io::{create_folder, write_bytes};

pub fn run(args: &GenerateArgs) -> anyhow::Result<()> {
    let folder = &args.folder;
    create_folder(folder)?;
    let mut command = Cli::command();
    command.build();
    match args.what {
        What::Completions => {
            for shell in Shell::value_variants() {
                let mut bytes = Vec::new();
                clap_complete::generate(*shell, &mut command, "umbrage", &mut bytes);
                let name = match shell {
                    Shell::Bash => "umbrage.bash".into(),
                    Shell::Zsh => "_umbrage".into(),
                    other => format!("umbrage.{other}"),
                };
                write_bytes(&folder.join(name), &bytes)?;
            }
        }
        What::Man => {
            let shown: Vec<_> = command.get_subcommands().filter(|sub| !sub.is_hide_set()).cloned().collect();
            for page in std::iter::once(command).chain(shown) {
                let name = page.get_display_name().unwrap_or("umbrage").replace(' ', "-");
                let mut bytes = Vec::new();
                clap_mangen::Man::new(page).render(&mut bytes).context("manual page")?;
                write_bytes(&folder.join(format!("{name}.1")), &bytes)?;
            }
        }
    }
    Ok(())
}
