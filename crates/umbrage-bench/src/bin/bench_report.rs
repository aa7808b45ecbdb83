//! Measures ours beside peers and prints rows, fields between tabs; `cargo xtask bench-report` makes a table of them.
//!
//! `bench-report [--quick] [--native]` measures; `bench-report --kernel NAME` runs one kernel once, for counting its instructions.

use std::process::ExitCode;
use umbrage_bench::kernels;
use umbrage_bench::report::{Settings, measure};

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    if let [option, name] = args.as_slice()
        && option == "--kernel"
    {
        let Some(elements) = kernels::run(name) else {
            eprintln!("error: there is no kernel {name:?}; there are {}", kernels::NAMES.join(", "));
            return ExitCode::from(2);
        };
        println!("kernel\t{name}\t{elements}\t{}", kernels::instruction_set());
        return ExitCode::SUCCESS;
    }
    let mut settings = Settings::default();
    for arg in &args {
        match arg.as_str() {
            "--quick" => settings.quick = true,
            "--native" => settings.native = true,
            _ => {
                eprintln!("error: {arg:?} means nothing; there are --quick, --native and --kernel NAME");
                return ExitCode::from(2);
            }
        }
    }
    measure(settings, |line| println!("{line}"));
    ExitCode::SUCCESS
}
