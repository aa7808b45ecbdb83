//! Drawing every picture of a command line.

use crate::args::{Cli, TakesArgs};
use crate::draws::{Draws, noted, of_take, save, twice};
use crate::parts;
use crate::report::written;
use crate::shell::Shell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use umbrage_io::{Fault, create_folder};

/// Draws the takes of a command line: one into `output`, a folder if the command `fills_a_folder`; several into a folder; or a shard of
/// them.
///
/// # Errors
/// The first thing that failed. Pictures that were finished before stay.
pub fn run(
    cli: &Cli,
    args: &TakesArgs,
    frame: u32,
    (output, fills_a_folder): (&Path, bool),
    command: &dyn Draws,
    shell: &mut Shell<'_>,
) -> anyhow::Result<()> {
    let takes = args.takes(frame)?;
    if let Some(shard) = args.shard {
        return parts::run(cli, args, shard, &takes, output, command, shell);
    }
    let (mut files, mut lights) = (Vec::new(), Vec::new());
    let mut known = BTreeMap::new();
    for (index, take) in takes.iter().enumerate() {
        let stage = command.stage(&take.source, shell).map_err(|error| of_take(error, take, args))?;
        if index == 0 && fills_a_folder {
            create_folder(output)?;
        }
        let mut keep = |file: PathBuf, bytes: Result<Vec<u8>, Fault>| {
            let path = if fills_a_folder { output.join(&file) } else { output.to_path_buf() };
            let lower = file.display().to_string().to_ascii_lowercase();
            if let Some(other) = known.insert(lower, &take.source) {
                return Err(twice(other, &take.source, &file));
            }
            save(&path, bytes)?;
            files.push(path);
            Ok(())
        };
        let drawn = command.draw(stage, take, &|_| true, &mut keep, shell);
        lights.extend(noted(drawn, take, args, shell)?);
    }
    written(cli, shell, &files, [("lights", lights.into())])
}
