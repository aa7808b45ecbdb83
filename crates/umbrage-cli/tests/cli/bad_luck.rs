//! What happens to a command when data cannot be written.

use std::io::{self, BufWriter, ErrorKind, Write};

/// Runs a command as the program does, with a buffer before `out`; its code and what it says on stderr.
fn run(args: &[&str], out: impl Write) -> (u8, String) {
    let (mut out, mut err) = (BufWriter::new(out), Vec::new());
    let words = std::iter::once("umbrage").chain(args.iter().copied()).map(Into::into);
    let code = umbrage_cli::run(words, &mut io::empty(), &mut out, &mut err, false);
    // What is left in the buffer would be tried again.
    let _ = out.into_parts();
    (code, String::from_utf8(err).expect("text"))
}

/// A place where every write fails in one way.
struct Refuses(ErrorKind);

impl Write for Refuses {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(self.0.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_under_stdout_is_one_line() {
    let line = "error: standard output: no storage space\n";
    assert_eq!(run(&["scenes"], Refuses(ErrorKind::StorageFull)), (1, line.into()));
    assert_eq!(run(&["recipes", "auto"], Refuses(ErrorKind::StorageFull)), (1, line.into()));
    if let Ok(full) = std::fs::File::options().write(true).open("/dev/full") {
        let (code, line) = run(&["scenes"], full);
        assert_eq!((code, line.lines().count()), (1, 1), "{line}");
        assert!(line.starts_with("error: standard output: "), "{line}");
    }
}

#[test]
fn files_where_none_can_be_written_are_one_line() {
    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("no_folder");
    std::fs::write(&file, b"a file").expect("a file");
    let below = file.join("table.glb");
    let (code, line) = run(&["export", "gallery:table", "-o", below.to_str().expect("text")], io::sink());
    let start = format!("error: {}: cannot create a temporary file beside it: ", below.display());
    assert!(code == 1 && line.starts_with(&start) && line.lines().count() == 1, "{line}");
}
