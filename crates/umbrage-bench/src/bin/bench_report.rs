//! Measures ours beside peers and prints rows, fields between tabs; `cargo xtask bench-report` makes a table of them.
//!
//! `bench-report [--quick] [--native]` measures; `bench-report --scale [--quick]` measures how time and memory grow, each point in a process of
//! its own, which is `bench-report --point SERIES SIZE`; `bench-report --kernel NAME` runs one kernel once, for counting its instructions.

use std::error::Error;
use std::process::{Command, ExitCode};
use umbrage_bench::kernels;
use umbrage_bench::report::{Settings, measure};
use umbrage_bench::scale::Series;

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
    if let [option, series, size] = args.as_slice()
        && option == "--point"
    {
        return ended(point(series, size));
    }
    if args.first().is_some_and(|option| option == "--scale") && args[1..].iter().all(|option| option == "--quick") {
        return ended(scale(args.len() > 1));
    }
    let mut settings = Settings::default();
    for arg in &args {
        match arg.as_str() {
            "--quick" => settings.quick = true,
            "--native" => settings.native = true,
            _ => {
                eprintln!(
                    "error: {arg:?} means nothing; there are --quick, --native, --scale, --point SERIES SIZE and --kernel NAME"
                );
                return ExitCode::from(2);
            }
        }
    }
    measure(settings, |line| println!("{line}"));
    ExitCode::SUCCESS
}

fn ended(done: Result<(), Box<dyn Error>>) -> ExitCode {
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Measures one point, in this process.
fn point(series: &str, size: &str) -> Result<(), Box<dyn Error>> {
    let found = Series::named(series).ok_or_else(|| format!("there is no series {series:?}"))?;
    let size: u32 = size.parse().map_err(|error| format!("size {size:?}: {error}"))?;
    for quantity in found.measure(size)? {
        println!("point\t{series}\t{size}\t{quantity}");
    }
    Ok(())
}

/// Measures all points, each in a process of its own.
fn scale(quick: bool) -> Result<(), Box<dyn Error>> {
    let program = std::env::current_exe()?;
    for series in Series::ALL {
        for size in series.sizes(quick) {
            let status = Command::new(&program).args(["--point", series.name(), &size.to_string()]).status()?;
            if !status.success() {
                return Err(format!("{} {size}: {status}", series.name()).into());
            }
        }
    }
    println!("fact\tthreads\t{}", std::thread::available_parallelism()?);
    Ok(())
}
