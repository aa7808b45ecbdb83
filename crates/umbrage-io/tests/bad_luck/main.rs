//! Whatever fails while a file is written, and whenever: the old file is whole or the new one is.
//!
//! The source of the write path stands in this program, too, so that its steps can fail without users seeing a way to make them.

#[path = "../../src/error.rs"]
#[expect(dead_code, reason = "the rest of it is for files that are read")]
mod error;
#[path = "../../src/write_file.rs"]
mod write_file;

use std::cell::{Cell, RefCell};
use std::io::{Error, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use std::{fs, io};
use write_file::{Output, Step, write_atomic, write_bytes, write_in_steps};

/// What is written, in several pieces, each larger than a buffer.
const PIECES: [&[u8]; 4] = [&[1; 20_000], &[2; 30_000], &[3; 10], &[4; 20_000]];

fn fill(file: &mut dyn Write) -> io::Result<()> {
    PIECES.iter().try_for_each(|piece| file.write_all(piece))
}

fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("bad_luck").join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a place for test files");
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<String> = entries.map(|name| name.into_string().expect("UTF-8")).collect();
    names.sort();
    names
}

/// Writes with the steps that `fails` says failing: the number of a step, from 0, and what it is. All steps that were tried, and the
/// refusal.
fn unlucky(path: &Path, kind: ErrorKind, fails: impl Fn(usize, Step) -> bool) -> (Vec<Step>, Option<String>) {
    let steps = RefCell::new(Vec::new());
    let before = |step: Step| {
        let number = steps.borrow().len();
        steps.borrow_mut().push(step);
        if fails(number, step) { Err(Error::from(kind)) } else { Ok(()) }
    };
    let all = |file: &mut dyn Output| fill(file).map_err(error::system(path, "write"));
    let written = write_in_steps(path, all, &before);
    (steps.into_inner(), written.err().map(|error| error.to_string()))
}

#[test]
fn each_step_may_fail_and_leaves_the_old_file_or_none() {
    let folder = folder("each_step");
    let path = folder.join("map.exr");
    for old in [None, Some(b"old".as_slice())] {
        if let Some(old) = old {
            write_bytes(&path, old).expect("written");
        }
        let before = names(&folder);
        let mut last = None;
        for unlucky_step in 0.. {
            let (steps, refusal) = unlucky(&path, ErrorKind::StorageFull, |number, _| number == unlucky_step);
            let Some(line) = refusal else {
                assert_eq!(steps.len(), unlucky_step, "there was no such step");
                break;
            };
            let failed = steps[unlucky_step];
            let tried = match failed {
                Step::Create => "create a temporary file beside it",
                Step::Write => "write",
                Step::Flush => "flush to the disk",
                Step::Rename => "rename the finished temporary file to it",
                Step::Remove => unreachable!("nothing is removed while all is well"),
            };
            assert_eq!(line, format!("{}: cannot {tried}: no storage space", path.display()));
            assert_eq!(fs::read(&path).ok().as_deref(), old, "{failed:?}");
            assert_eq!(names(&folder), before, "{failed:?}");
            last = Some((unlucky_step, failed));
        }
        let (count, failed) = last.expect("it failed at all");
        assert!(count >= 6 && failed == Step::Rename, "create, several writes, flush, rename: {count} {failed:?}");
        assert_eq!(fs::read(&path).expect("written"), PIECES.concat());
        fs::remove_file(&path).expect("removed");
    }
}

/// The temporary file cannot be removed either: it stays, and goes with the next run.
#[test]
fn what_could_not_be_removed_is_replaced_later() {
    let folder = folder("not_removed");
    let path = folder.join("map.exr");
    for unlucky_step in [2, 4] {
        write_bytes(&path, b"old").expect("written");
        let fails = |number: usize, step: Step| number == unlucky_step || step == Step::Remove;
        let (steps, refusal) = unlucky(&path, ErrorKind::ReadOnlyFilesystem, fails);
        assert_eq!(steps.last(), Some(&Step::Remove));
        assert!(refusal.expect("refused").ends_with(": read-only filesystem or storage medium"));
        assert_eq!(fs::read(&path).expect("whole"), b"old");
        assert_eq!(names(&folder), [".map.exr.0.tmp", "map.exr"]);
        write_atomic(&path, fill).expect("written");
        assert_eq!(fs::read(&path).expect("whole"), PIECES.concat());
        assert_eq!(names(&folder), ["map.exr"]);
    }
}

/// A write that is interrupted by a signal or takes fewer bytes than it was given is continued, not failed.
#[test]
fn interrupted_writes_go_on() {
    let path = folder("interrupted").join("map.exr");
    let interrupted = Cell::new(0);
    let fails = |_, step: Step| {
        let now = step == Step::Write && interrupted.get() % 2 == 0;
        interrupted.set(interrupted.get() + 1);
        now
    };
    let (_, refusal) = unlucky(&path, ErrorKind::Interrupted, fails);
    assert_eq!(refusal, None);
    assert_eq!(fs::read(&path).expect("written"), PIECES.concat());
    assert!(interrupted.get() > 6);
}

#[test]
fn places_where_nothing_can_be_written_are_one_line() {
    let folder = folder("places");
    fs::write(folder.join("file"), b"no folder").expect("a file");
    let mut places =
        vec![folder.join("file").join("map.exr"), folder.join("none").join("map.exr"), PathBuf::from("..")];
    if cfg!(target_os = "linux") {
        // Nobody may write there, not even root, whom no permissions bind.
        places.push(PathBuf::from("/proc/self/map.exr"));
    }
    for place in places {
        let line = write_bytes(&place, b"x").expect_err("refused").to_string();
        let start = format!("{}: cannot create a temporary file beside it: ", place.display());
        assert!(line.starts_with(&start) && !line.contains('\n'), "{line}");
    }
    assert_eq!(names(&folder), ["file"]);
}

/// Names the file that [`is_killed_while_it_writes`] is to write.
const FILE: &str = "UMBRAGE_TEST_FILE";

#[test]
#[ignore = "the program that the test below kills"]
fn is_killed_while_it_writes() {
    let path = std::env::var_os(FILE).expect("a file to write");
    let written = write_atomic(Path::new(&path), |file| {
        fill(file)?;
        file.flush()?;
        std::thread::sleep(Duration::from_secs(50));
        Err(Error::other("nobody came to kill it"))
    });
    written.expect("killed");
}

#[test]
fn a_killed_run_leaves_the_old_file_and_the_next_one_ends_as_if_there_had_been_none() {
    let folder = folder("killed");
    let (path, temporary) = (folder.join("map.exr"), folder.join(".map.exr.0.tmp"));
    write_bytes(&path, b"old").expect("written");
    let mut child = Command::new(std::env::current_exe().expect("a program"))
        .args(["--ignored", "--exact", "is_killed_while_it_writes"])
        .env(FILE, &path)
        .stdout(Stdio::null())
        .spawn()
        .expect("started");
    let long = PIECES.concat().len() as u64;
    let start = Instant::now();
    while fs::metadata(&temporary).map_or(0, |facts| facts.len()) < long {
        assert!(start.elapsed() < Duration::from_secs(30), "it writes nothing");
        std::thread::sleep(Duration::from_millis(5));
    }
    // While it lives, what it writes is left alone.
    write_bytes(&path, b"newer").expect("written");
    assert_eq!(names(&folder), [".map.exr.0.tmp", "map.exr"]);
    assert_eq!(fs::metadata(&temporary).expect("there").len(), long);
    child.kill().expect("killed");
    child.wait().expect("gone");
    assert_eq!(fs::read(&path).expect("whole"), b"newer");
    assert_eq!(names(&folder), [".map.exr.0.tmp", "map.exr"]);
    write_atomic(&path, fill).expect("written");
    assert_eq!(fs::read(&path).expect("whole"), PIECES.concat());
    assert_eq!(names(&folder), ["map.exr"]);
}
