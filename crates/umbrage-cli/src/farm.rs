//! `umbrage jobs`: schedulers have their own ways to start, retry and wait for work; here the work is put into their own forms.

use crate::args::{Cli, Command, JobsArgs, Scheduler};
use crate::render;
use crate::shell::{Shell, Usage, quoted};
use clap::Parser;
use serde_json::json;
use std::path::PathBuf;

/// What shares the work under each scheduler.
struct Job<'a> {
    /// `umbrage render` or `umbrage shadow`.
    name: &'static str,
    /// The command line, the program's name first.
    words: Vec<&'a str>,
    /// What is gathered.
    folder: String,
    shards: u32,
}

pub fn run(args: &JobsArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let job = job(args)?;
    let text = match args.scheduler {
        Scheduler::Openjd => openjd(&job)?,
        Scheduler::Slurm => slurm(&job),
    };
    Ok(write!(shell.out, "{text}")?)
}

/// Reads the command line that is shared.
fn job(args: &JobsArgs) -> anyhow::Result<Job<'_>> {
    const NAME: &str = "umbrage";
    let words: Vec<&str> = args.words.iter().map(String::as_str).collect();
    let rest = words.strip_prefix(&[NAME]).unwrap_or(&words);
    let words: Vec<&str> = std::iter::once(NAME).chain(rest.iter().copied()).collect();
    if let Some(word) = words.iter().find(|word| word.chars().any(char::is_control)) {
        return Err(Usage(format!("COMMAND LINE: {word:?}: expected no control characters")).into());
    }
    let cli = Cli::try_parse_from(&words).map_err(|error| {
        let text = error.to_string();
        let line = text.lines().next().unwrap_or_default();
        Usage(format!("COMMAND LINE: {}", line.strip_prefix("error: ").unwrap_or(line)))
    })?;
    let (name, takes, output): (_, _, &PathBuf) = match &cli.command {
        Command::Render(args) => {
            render::check(args, true)?;
            ("umbrage render", &args.takes, &args.output)
        }
        Command::Shadow(args) => ("umbrage shadow", &args.takes, &args.output),
        _ => return Err(Usage("COMMAND LINE: expected umbrage render or umbrage shadow".into()).into()),
    };
    if takes.shard.is_some() {
        return Err(Usage("COMMAND LINE: --shard: each shard is given its own".into()).into());
    }
    Ok(Job { name, words, folder: output.display().to_string(), shards: args.shards })
}

impl<'a> Job<'a> {
    /// The command line of a shard. What comes after `--` are scenes.
    fn shard(&self, shard: &'a str) -> Vec<&'a str> {
        let end = self.words.iter().position(|word| *word == "--").unwrap_or(self.words.len());
        let (options, scenes) = self.words.split_at(end);
        [options, &["--shard", shard], scenes].concat()
    }

    /// The command line that gathers. What follows `--` is a folder even if its name begins as an option's does.
    fn gather(&self) -> Vec<&str> {
        vec!["umbrage", "gather", "--", &self.folder]
    }
}

/// A template of Open Job Description. Text in double quotes with the escapes of JSON is also YAML.
fn openjd(job: &Job<'_>) -> anyhow::Result<String> {
    if let Some(word) = job.words.iter().find(|word| word.contains("{{")) {
        return Err(Usage(format!(
            "COMMAND LINE: {word:?}: Open Job Description reads {{{{ as the start of a parameter"
        ))
        .into());
    }
    // A task starts in a folder of its own.
    let action = |words: &[&str]| {
        let shell = ["-c", "cd \"$0\" && exec \"$@\"", "{{Param.Folder}}"];
        let args: Vec<String> = shell.iter().chain(words).map(|word| format!("          - {}", json!(word))).collect();
        format!(
            "    script:\n      actions:\n        onRun:\n          command: sh\n          args:\n{}\n",
            args.join("\n")
        )
    };
    let (name, shards) = (json!(job.name), job.shards);
    let shard = format!("{{{{Task.Param.Shard}}}}/{shards}");
    let (draw, gather) = (action(&job.shard(&shard)), action(&job.gather()));
    Ok(format!(
        "specificationVersion: jobtemplate-2023-09
name: {name}
parameterDefinitions:
  - name: Folder
    type: PATH
    objectType: DIRECTORY
    default: .
    description: Where relative paths begin; the folder of this file unless given.
steps:
  - name: Draw
    parameterSpace:
      taskParameterDefinitions:
        - name: Shard
          type: INT
          range: 1-{shards}
{draw}  - name: Gather
    dependencies:
      - dependsOn: Draw
{gather}"
    ))
}

/// A script that submits an array of shards, and a job that waits for it.
fn slurm(job: &Job<'_>) -> String {
    let shards = job.shards;
    // The only word that a shard's shell has to replace.
    let shard = format!("$SLURM_ARRAY_TASK_ID/{shards}");
    let word = |word: &&str| if *word == shard { format!("\"{word}\"") } else { quoted(word) };
    let line = |words: &[&str]| words.iter().map(word).collect::<Vec<_>>().join(" ");
    let draw = line(&job.shard(&shard));
    let gather = line(&job.gather());
    format!(
        "#!/bin/sh
# Run this by sh where the command line's relative paths begin. Options for sbatch may be set in its variables SBATCH_*.
set -e
job=$(sbatch --parsable --job-name=umbrage --array=1-{shards} <<'END'
#!/bin/sh
exec {draw}
END
)
sbatch --job-name=umbrage-gather --dependency=afterok:\"${{job%%;*}}\" --kill-on-invalid-dep=yes <<'END'
#!/bin/sh
exec {gather}
END
"
    )
}
