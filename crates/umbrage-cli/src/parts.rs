//! A shard: its part of the pictures of a command line. Each is written under a name derived from everything that it is drawn from, so
//! that a shard that was stopped resumes where it was, and no picture of another scene or of other options is mistaken for one of these.

use crate::args::{Cli, Command, TakesArgs};
use crate::digest::{self, Digest};
use crate::draws::{Draws, noted, of_take, save, twice};
use crate::manifest::{Job, Manifest, parts_of};
use crate::report::written;
use crate::shell::{Shell, Usage};
use crate::takes::Take;
use crate::values::{MOST_PICTURES, Shard};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use umbrage_io::{Fault, create_folder};

/// Draws a shard's part of all takes into the parts of a folder.
///
/// # Errors
/// The first thing that failed. Parts that were finished before stay.
pub fn run(
    cli: &Cli,
    args: &TakesArgs,
    shard: Shard,
    takes: &[Take],
    folder: &Path,
    command: &dyn Draws,
    shell: &mut Shell<'_>,
) -> anyhow::Result<()> {
    let planned = jobs(cli, args, takes, command, shell)?;
    let parts = parts_of(folder);
    let manifest =
        Manifest { head: head(cli, args, command)?, jobs: planned.iter().map(|(_, job)| job.clone()).collect() };
    create_folder(&parts)?;
    manifest.write(&parts)?;
    let of_shard: Vec<&(usize, Job)> =
        planned.iter().enumerate().filter(|(index, _)| shard.draws(*index)).map(|(_, job)| job).collect();
    let left: Vec<&(usize, Job)> =
        of_shard.iter().copied().filter(|(_, job)| !parts.join(&job.part).is_file()).collect();
    let (mut files, mut lights) = (Vec::new(), Vec::new());
    for group in left.chunk_by(|one, next| one.0 == next.0) {
        let take = &takes[group[0].0];
        let part = |file: &Path| group.iter().find(|(_, job)| Path::new(&job.picture) == file);
        let stage = command.stage(&take.source, shell).map_err(|error| of_take(error, take, args))?;
        let mut keep = |file: PathBuf, bytes: Result<Vec<u8>, Fault>| {
            let Some((_, job)) = part(&file) else { return Ok(()) };
            let path = parts.join(&job.part);
            save(&path, bytes)?;
            files.push(path);
            Ok(())
        };
        let drawn = command.draw(stage, take, &|file| part(file).is_some(), &mut keep, shell);
        lights.extend(noted(drawn, take, args, shell)?);
    }
    let Shard { number, count } = shard;
    let there = of_shard.len() - left.len();
    shell.note(&format!(
        "shard {number} of {count}: {} of {} pictures, {there} of them there already",
        of_shard.len(),
        planned.len()
    ));
    let counts = json!({ "all": planned.len(), "shard": of_shard.len(), "there": there });
    written(cli, shell, &files, [("lights", lights.into()), ("pictures", counts)])
}

/// What must be the same for all shards, besides the pictures themselves.
fn head(cli: &Cli, args: &TakesArgs, command: &dyn Draws) -> anyhow::Result<Map<String, Value>> {
    let mut all = command.options()?;
    let frames = args.frames.as_ref().map(|frames| format!("{}..{}", frames.start(), frames.end()));
    for (name, value) in [
        ("version", json!(env!("CARGO_PKG_VERSION"))),
        ("command", json!(name(cli))),
        ("SCENE", json!(args.scenes)),
        ("frames", json!(frames)),
    ] {
        all.insert(name.into(), value);
    }
    Ok(all)
}

fn name(cli: &Cli) -> &'static str {
    if matches!(cli.command, Command::Render(_)) { "render" } else { "shadow" }
}

/// All pictures in the order in which one machine draws them, each with the index of its take.
fn jobs(
    cli: &Cli,
    args: &TakesArgs,
    takes: &[Take],
    command: &dyn Draws,
    shell: &mut Shell<'_>,
) -> anyhow::Result<Vec<(usize, Job)>> {
    let options = Value::Object(command.options()?).to_string();
    let start =
        || Digest::new().with(env!("CARGO_PKG_VERSION").as_bytes()).with(name(cli).as_bytes()).with(options.as_bytes());
    // Notes about a scene are for the shard that draws it.
    let (input, out, err) = (&mut *shell.input, &mut *shell.out, &mut *shell.err);
    let mut silent = Shell { input, out, err, quiet: true, verbose: false, is_terminal: false };
    let (mut jobs, mut known) = (Vec::new(), BTreeMap::new());
    // The scene that was read last: all frames of a scene without # have the same.
    let mut last: Option<(&str, String, Vec<Option<String>>)> = None;
    for (index, take) in takes.iter().enumerate() {
        if last.as_ref().is_none_or(|(source, ..)| *source != take.source) {
            let digest = digest::of_scene(&take.source, cli.max_memory);
            let read = digest.and_then(|digest| Ok((digest, command.lights(&take.source, &mut silent)?)));
            let (digest, lights) = read.map_err(|error| of_take(error, take, args))?;
            last = Some((&take.source, digest, lights));
        }
        let Some((_, digest, lights)) = &last else { continue };
        for light in lights {
            let file = command.file(take, light.as_deref());
            let picture = file.display().to_string();
            if let Some(other) = known.insert(picture.to_ascii_lowercase(), &take.source) {
                return Err(twice(other, &take.source, &file));
            }
            let own = start().with(digest.as_bytes()).with(&take.frame.to_le_bytes());
            let own = own.with(light.as_deref().unwrap_or_default().as_bytes()).text();
            let extension = file.extension().unwrap_or_default().display();
            let part = format!("{own}.{extension}");
            let (source, frame, light, digest) = (take.source.clone(), take.frame, light.clone(), digest.clone());
            jobs.push((index, Job { picture, part, source, frame, light, digest }));
        }
        if jobs.len() > MOST_PICTURES {
            return Err(Usage(format!("SCENE and --frames: more than {MOST_PICTURES} pictures")).into());
        }
    }
    Ok(jobs)
}
