use crate::folder;
use std::fs;
use std::io::Error;
use umbrage_io::{IoError, write_atomic, write_bytes};

fn names(folder: &std::path::Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").file_name());
    entries.map(|name| name.into_string().expect("UTF-8")).collect()
}

#[test]
fn a_file_is_written_whole_and_replaces_the_old_one() {
    let folder = folder("whole");
    let path = folder.join("picture.png");
    write_bytes(&path, b"old").expect("written");
    write_bytes(&path, b"newer").expect("written");
    assert_eq!(fs::read(&path).expect("readable"), b"newer");
    assert_eq!(names(&folder), ["picture.png"]);
}

#[test]
fn failure_leaves_the_old_file_and_nothing_else() {
    let folder = folder("failure");
    let path = folder.join("picture.png");
    write_bytes(&path, b"old").expect("written");
    let fails = write_atomic(&path, |file| {
        file.write_all(&vec![7; 100_000])?;
        Err(Error::other("disk on fire"))
    });
    let message = fails.expect_err("it failed").to_string();
    assert!(
        message.contains("picture.png") && message.contains("disk on fire") && !message.contains('\n'),
        "{message}"
    );
    assert_eq!(fs::read(&path).expect("readable"), b"old");
    assert_eq!(names(&folder), ["picture.png"]);
    let fresh = write_atomic(&folder.join("other"), |_| Err(Error::other("no")));
    assert!(matches!(fresh, Err(IoError::System { action: "write", .. })));
    assert_eq!(names(&folder), ["picture.png"]);
}

#[test]
fn a_name_that_a_folder_has_is_refused_and_nothing_stays_behind() {
    let folder = folder("occupied");
    fs::create_dir(folder.join("maps")).expect("a folder");
    fs::write(folder.join("maps").join("inside"), b"kept").expect("a file");
    assert!(write_bytes(&folder.join("maps"), b"x").is_err());
    assert_eq!(names(&folder), ["maps"]);
    assert!(write_bytes(&folder.join("none").join("x"), b"x").is_err());
    assert!(write_bytes(std::path::Path::new("/"), b"x").is_err());
}

/// What a killed run left behind is replaced; what may be somebody else's is not touched.
#[cfg(unix)]
#[test]
fn files_of_interrupted_runs_are_no_obstacle() {
    let folder = folder("interrupted");
    let (own, path) = (|number: u32| folder.join(format!(".a.exr.{number}.tmp")), folder.join("a.exr"));
    fs::write(own(0), b"torn").expect("a file");
    write_bytes(&path, b"whole").expect("written");
    assert_eq!(fs::read(&path).expect("readable"), b"whole");
    assert_eq!(names(&folder), ["a.exr"]);
    fs::write(folder.join("other"), b"kept").expect("a file");
    std::os::unix::fs::symlink(folder.join("other"), own(0)).expect("a link");
    assert!(std::process::Command::new("mkfifo").arg(own(1)).status().expect("mkfifo runs").success());
    fs::write(own(2), b"being written").expect("a file");
    let writing = fs::File::open(own(2)).expect("readable");
    writing.lock().expect("a lock");
    write_bytes(&path, b"again").expect("written");
    assert_eq!(fs::read(&path).expect("readable"), b"again");
    assert_eq!(fs::read(folder.join("other")).expect("readable"), b"kept");
    assert_eq!(fs::read(own(2)).expect("readable"), b"being written");
    assert_eq!(names(&folder).len(), 5);
}

/// Two runs that write one file never tear it, nor trip over each other.
#[test]
fn one_file_may_be_written_by_several_at_once() {
    let folder = folder("at_once");
    let path = folder.join("a.exr");
    std::thread::scope(|scope| {
        for number in 0..4u8 {
            let path = &path;
            scope.spawn(move || (0..50).for_each(|_| write_bytes(path, &vec![number; 20_000]).expect("written")));
        }
    });
    let bytes = fs::read(&path).expect("readable");
    assert!(bytes.len() == 20_000 && bytes.iter().all(|byte| *byte == bytes[0]));
    assert_eq!(names(&folder), ["a.exr"]);
}

#[cfg(unix)]
#[test]
fn pipes_and_files_past_the_budget_are_refused_and_never_waited_for() {
    let folder = folder("pipe");
    let pipe = folder.join("map.exr");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo runs");
    assert!(made.success());
    let (tell, told) = std::sync::mpsc::channel();
    std::thread::spawn(move || tell.send(umbrage_io::read_shadow_map(&pipe).map(|_| ()).map_err(|e| e.to_string())));
    let answer = told.recv_timeout(std::time::Duration::from_secs(20)).expect("an answer without waiting");
    assert!(answer.expect_err("refused").contains("not a regular file"));
    let long = folder.join("long.exr");
    fs::File::create(&long).and_then(|file| file.set_len(1 << 40)).expect("a sparse file");
    let refused = umbrage_io::read_shadow_map(&long).expect_err("refused").to_string();
    assert!(refused.contains("long.exr") && refused.contains("1099511627776 bytes are more than"), "{refused}");
}
