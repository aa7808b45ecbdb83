//! Jobs for schedulers, run by those that are installed.

use crate::examples::shell;
use crate::typed::{files, folder, good, refused, text};
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

const WORDS: [&str; 9] =
    ["umbrage", "shadow", "gallery:three-lights", "--size", "24x18", "--map-size", "32", "-o", "it's drawn"];

/// A folder with a job's text in a file of a name, and the names of the pictures that it draws.
fn job(scheduler: &str, name: &str) -> (std::path::PathBuf, String) {
    let folder = folder(&format!("templates-{scheduler}"));
    let made = good(&[&["jobs", scheduler, "2", "--"], &WORDS[..]].concat());
    std::fs::write(folder.join(name), &made.out).expect("a file");
    (folder, made.out)
}

/// The pictures are there, and those that one machine draws.
fn check(folder: &Path) {
    let whole = folder.join("whole");
    good(&["shadow", "gallery:three-lights", "--size", "24x18", "--map-size", "32", "-q", "-o", text(&whole)]);
    for name in files(&whole) {
        let [one, other] = [&whole, &folder.join("it's drawn")].map(|folder| std::fs::read(folder.join(&name)));
        assert!(one.expect("a picture") == other.expect("a picture"), "{name}");
    }
}

/// Whether a scheduler answers to a command.
fn answers(command: &[&str]) -> bool {
    let answer = Command::new(command[0]).args(&command[1..]).output();
    let found = answer.is_ok_and(|answer| answer.status.success() && !answer.stdout.is_empty());
    if !found {
        println!("skipped: {} is not installed, or no scheduler answers it", command[0]);
    }
    found
}

/// Lines of a template, each a key, a key with a value, or an item of a list: the depth of every line is that of its list or map.
#[test]
fn an_openjd_template_draws_in_shards_and_gathers() {
    let (folder, template) = job("openjd", "job.yaml");
    let mut open = vec![0];
    for line in template.lines() {
        let depth = line.len() - line.trim_start().len();
        let text = line.trim_start();
        open.retain(|outer| *outer <= depth);
        assert!(depth == 0 || open.last() == Some(&depth), "{line:?} stands at no depth of {open:?}");
        let item = text.strip_prefix("- ").unwrap_or(text);
        let inner = depth + text.len() - item.len();
        match item.split_once(':').filter(|_| !item.starts_with('"')) {
            // What a key holds stands deeper, by two or, in an item, by what the item's keys do.
            Some((key, "")) => {
                assert!(key.chars().all(char::is_alphanumeric), "{line:?}");
                open.extend([inner, inner + 2]);
            }
            Some((key, value)) => {
                assert!(key.chars().all(char::is_alphanumeric) && value.starts_with(' '), "{line:?}");
                open.push(inner);
            }
            None => assert!(serde_json::from_str::<String>(item).is_ok(), "{line:?} is no text"),
        }
    }
    let has = |line: &str| assert!(template.lines().any(|own| own.trim() == line), "{line}: {template}");
    has("specificationVersion: jobtemplate-2023-09");
    has("type: INT");
    has("range: 1-2");
    has("- \"{{Task.Param.Shard}}/2\"");
    has("- dependsOn: Draw");
    has("- \"it's drawn\"");
    if answers(&["openjd", "--version"]) {
        shell(&folder, "openjd check job.yaml && openjd run job.yaml");
        check(&folder);
    }
}

/// A stand-in for sbatch runs what it is given at once, each number of the array in turn, and keeps the options.
#[test]
fn a_slurm_script_submits_shards_and_what_gathers_them() {
    let (folder, _) = job("slurm", "job.sh");
    let stand_in = "#!/bin/sh
echo \"$@\" >> options
cat > submitted
count=$(echo \"$@\" | sed -n 's/.*--array=1-\\([0-9]*\\).*/\\1/p')
for number in $(seq ${count:-1}); do SLURM_ARRAY_TASK_ID=$number sh -e submitted >&2; done
echo '17;cluster'
";
    std::fs::create_dir(folder.join("bin")).expect("a folder");
    std::fs::write(folder.join("bin/sbatch"), stand_in).expect("a file");
    shell(&folder, "chmod +x bin/sbatch && PATH=\"$PWD/bin:$PATH\" sh job.sh");
    let options = std::fs::read_to_string(folder.join("options")).expect("options");
    let expected = "--parsable --job-name=umbrage --array=1-2
--job-name=umbrage-gather --dependency=afterok:17 --kill-on-invalid-dep=yes\n";
    assert_eq!(options, expected);
    check(&folder);
    if answers(&["sinfo", "--noheader"]) {
        std::fs::remove_dir_all(folder.join("it's drawn")).expect("a folder");
        shell(&folder, "sh job.sh");
        let (start, drawn) = (Instant::now(), folder.join("it's drawn"));
        while start.elapsed() < Duration::from_secs(120)
            && !files(&folder.join("whole")).iter().all(|name| drawn.join(name).is_file())
        {
            std::thread::sleep(Duration::from_millis(200));
        }
        check(&folder);
    }
}

#[test]
fn only_what_can_be_shared_becomes_a_job() {
    let refusal = |words: &[&str]| refused(2, &[&["jobs", "openjd", "2", "--"], words].concat());
    let line = "error: COMMAND LINE: ";
    assert_eq!(refusal(&["umbrage", "scenes"]), format!("{line}expected umbrage render or umbrage shadow"));
    let shard = ["shadow", "gallery:table", "-o", "a", "--shard", "1/2"];
    assert_eq!(refusal(&shard), format!("{line}--shard: each shard is given its own"));
    assert!(refusal(&["shadow", "a.glb", "-o", "a{{b}}"]).contains("\"a{{b}}\""));
    assert!(refusal(&["shadow", "a.glb", "-o", "a\nb"]).contains("expected no control characters"));
    assert!(refusal(&["shadow", "a.glb", "-o", "a", "--frames", "2..1"]).contains("'2..1'"));
    assert!(refusal(&["render", "a.glb", "-o", "nowhere"]).contains("--output nowhere: expected a folder"));
    // Scenes may come last, after two dashes.
    let made = good(&["jobs", "slurm", "3", "--", "render", "-o", "drawn/", "--", "-a.glb"]).out;
    assert!(made.contains("exec umbrage render -o drawn/ --shard \"$SLURM_ARRAY_TASK_ID/3\" -- -a.glb\n"), "{made}");
    assert!(made.contains("exec umbrage gather -- drawn/\n"), "{made}");
}
