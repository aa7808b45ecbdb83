//! The program's command line.

use std::process::{Command, Output};

fn figures(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_umbrage-figures")).args(arguments).output().unwrap()
}

#[test]
fn the_command_line_lists_its_figures_and_refuses_what_it_does_not_know() {
    let list = figures(&["--list", "--only", "r87-f7"]);
    let text = String::from_utf8(list.stdout).unwrap();
    assert!(list.status.success() && text.starts_with("R87-F7 ") && text.lines().count() == 1, "{text}");
    for (arguments, named) in [(["--only", "R87-F77"], "R87-F77"), (["--storage", "paper"], "paper")] {
        let refused = figures(&arguments);
        let text = String::from_utf8(refused.stderr).unwrap();
        assert!(refused.status.code() == Some(2) && text.contains(named), "{text}");
    }
}
