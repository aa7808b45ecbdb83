//! The `umbrage` command.

use std::io::{BufWriter, IsTerminal, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    // Nothing that has its final name is half written, so that there is nothing to clean up.
    if let Err(error) = ctrlc::set_handler(|| std::process::exit(130)) {
        eprintln!("warning: interrupts are not caught: {error}");
    }
    let mut out = BufWriter::new(std::io::stdout().lock());
    let mut err = std::io::stderr();
    let is_terminal = err.is_terminal();
    let mut stdin = std::io::stdin().lock();
    let code = umbrage_cli::run(std::env::args_os(), &mut stdin, &mut out, &mut err, is_terminal);
    // A reader that has gone away has all that it wanted.
    let _ = out.flush();
    ExitCode::from(code)
}
