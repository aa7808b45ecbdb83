//! Instructions of the hottest kernels, which do not depend on what else the machine does, beside the recorded ones; and closures
//! that a compiler left outside the loops they belong into.

use super::program::{Flags, built, rustc};
use anyhow::{Context as _, bail, ensure};
use std::path::Path;
use std::process::Command;

/// The recorded counts.
const RECORDED: &str = "crates/umbrage-bench/instructions.csv";
const HEADING: &str = "kernel,elements,instructions,instruction set,compiler";
/// How far a count may lie from the recorded one, either way: what was made faster is to be recorded as well.
const MOST: f64 = 0.02;
/// As in `umbrage_bench::kernels::NAMES`.
const KERNELS: [&str; 6] = ["transform", "pcf-raw", "auto", "bins-tiny", "tiles-layers", "pcf-plane-raw"];

/// Functions whose closures belong inside them: one that stands alone is called for every sixteen taps or every receiver, with all it
/// works on in memory. Closures of the filter `dual_plane` are called less often; they may stand alone.
const INLINED: [&str; 8] = [
    "umbrage_plane::batch::",
    "umbrage_shadow::query::Query",
    "umbrage_shadow::depths::",
    "umbrage_shadow::filters::pcf::",
    "umbrage_sample::jittered::",
    "umbrage_sample::grid::",
    "umbrage_depth::rows::",
    "umbrage_depth::tiled::",
];

/// A kernel's count.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Count {
    kernel: String,
    elements: u64,
    instructions: u64,
    set: String,
    compiler: String,
}

impl Count {
    fn parse(line: &str) -> anyhow::Result<Self> {
        let [kernel, elements, instructions, set, compiler] = line.split(',').collect::<Vec<_>>()[..] else {
            bail!("{RECORDED}: {line:?} has not five fields");
        };
        let number = |text: &str| text.parse().with_context(|| format!("{RECORDED}: {text:?}"));
        Ok(Self {
            kernel: kernel.into(),
            elements: number(elements)?,
            instructions: number(instructions)?,
            set: set.into(),
            compiler: compiler.into(),
        })
    }

    fn line(&self) -> String {
        let Self { kernel, elements, instructions, set, compiler } = self;
        format!("{kernel},{elements},{instructions},{set},{compiler}\n")
    }

    /// How much more instructions than recorded, as a fraction; fewer are negative.
    fn beyond(&self, recorded: &Self) -> f64 {
        self.instructions as f64 / recorded.instructions as f64 - 1.0
    }
}

/// Counts, compares or records, and looks at symbols. Whether all is as it should be.
pub fn run(root: &Path, bless: bool) -> anyhow::Result<bool> {
    let program = built(root, Flags::Default)?;
    let inlined = symbols(&program)?;
    let file = root.join(RECORDED);
    let text = std::fs::read_to_string(&file).unwrap_or_else(|_| format!("{HEADING}\n"));
    let recorded = text.lines().skip(1).map(Count::parse).collect::<anyhow::Result<Vec<_>>>()?;
    let compiler = rustc()?;
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("instructions: skipped, as valgrind is not installed");
        return Ok(inlined);
    }
    if !bless && recorded.first().is_none_or(|count| count.compiler != compiler) {
        println!("instructions: skipped, as those recorded are of another compiler than {compiler}");
        return Ok(inlined);
    }
    let mut counts = Vec::new();
    for kernel in KERNELS {
        let count = counted(root, &program, kernel, &compiler)?;
        if !bless && recorded.first().is_some_and(|first| first.set != count.set) {
            println!("instructions: skipped, as those recorded are of another set than {}", count.set);
            return Ok(inlined);
        }
        let each = count.instructions as f64 / count.elements as f64;
        println!("{kernel}: {} instructions, {each:.1} for each of {}", count.instructions, count.elements);
        counts.push(count);
    }
    if bless {
        let lines: String = counts.iter().map(Count::line).collect();
        std::fs::write(&file, format!("{HEADING}\n{lines}")).with_context(|| RECORDED)?;
        return Ok(inlined);
    }
    let mut good = inlined;
    for count in &counts {
        let Some(before) = recorded.iter().find(|other| other.kernel == count.kernel) else {
            println!("{}: no count is recorded; --bless records it", count.kernel);
            good = false;
            continue;
        };
        let beyond = count.beyond(before);
        if beyond.abs() > MOST {
            let recorded = before.instructions;
            println!("{}: {:+.1} % beside the {recorded} recorded; --bless records it", count.kernel, beyond * 100.0);
            good = false;
        }
    }
    Ok(good)
}

/// Instructions inside the kernel alone, by callgrind.
fn counted(root: &Path, program: &Path, kernel: &str, compiler: &str) -> anyhow::Result<Count> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=*kernels*measured*"])
        .arg(program)
        .args(["--kernel", kernel])
        .current_dir(root)
        .output()
        .context("valgrind")?;
    let (printed, collected) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    ensure!(output.status.success(), "valgrind of {kernel}: {collected}");
    let line = printed.lines().find_map(|line| line.strip_prefix("kernel\t")).context("the program prints no count")?;
    let [_, elements, set] = line.split('\t').collect::<Vec<_>>()[..] else { bail!("{line:?}") };
    let instructions = collected_in(&collected).with_context(|| format!("callgrind counts nothing: {collected}"))?;
    ensure!(instructions > 0, "callgrind did not find the kernel {kernel}");
    Ok(Count {
        kernel: kernel.into(),
        elements: elements.parse()?,
        instructions,
        set: set.into(),
        compiler: compiler.into(),
    })
}

/// The number behind `Collected :`.
fn collected_in(text: &str) -> Option<u64> {
    let line = text.lines().find(|line| line.contains("Collected :"))?;
    line.split("Collected :").nth(1)?.split_whitespace().next()?.parse().ok()
}

/// Whether no closure of a kernel stands alone; prints those that do.
fn symbols(program: &Path) -> anyhow::Result<bool> {
    let Ok(output) = Command::new("nm").arg("-C").arg(program).output() else {
        println!("closures: skipped, as nm is not installed");
        return Ok(true);
    };
    ensure!(output.status.success(), "nm: {}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout);
    ensure!(text.contains("umbrage_shadow::"), "nm finds no symbol of umbrage-shadow in {}", program.display());
    let alone = outlined(&text);
    for symbol in &alone {
        println!("{symbol} stands alone: mark the closure #[inline(always)] where it is passed on");
    }
    println!("closures: {} of the kernels' stand alone", alone.len());
    Ok(alone.is_empty())
}

/// Closures of the kernels among a program's symbols.
fn outlined(symbols: &str) -> Vec<&str> {
    let named = symbols.lines().filter_map(|line| line.splitn(3, ' ').nth(2));
    let mut alone: Vec<&str> = named
        .filter(|symbol| symbol.contains("{{closure}}") || symbol.contains("{closure#"))
        .filter(|symbol| INLINED.iter().any(|function| symbol.trim_start_matches('<').starts_with(function)))
        .collect();
    alone.sort_unstable();
    alone.dedup();
    alone
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_written_as_they_are_read() {
        let line = "auto,16384,1000000,Avx2,rustc 1.95.0 (abc 2026-04-14)\n";
        let count = Count::parse(line.trim()).unwrap();
        assert_eq!(count.line(), line);
        assert_eq!(Count { instructions: 1_250_000, ..count.clone() }.beyond(&count), 0.25);
        assert!(Count::parse("auto,1,2,Avx2").is_err());
    }

    #[test]
    fn the_collected_number_is_found() {
        assert_eq!(collected_in("==1== Events    : Ir\n==1== Collected : 123456\n"), Some(123_456));
        assert_eq!(collected_in("==1== nothing"), None);
    }

    #[test]
    fn closures_of_kernels_are_distinguished_from_others() {
        let symbols = "0000000000001000 t <umbrage_shadow::query::Query<S,M,P>>::share_by::{{closure}}\n\
                       0000000000001000 t umbrage_shadow::query::Query<S,M,P>::share_by\n\
                       0000000000002000 t umbrage_bake::pass1::bake::{{closure}}\n\
                       0000000000003000 t umbrage_depth::rows::look::{closure#0}\n";
        let found = outlined(symbols);
        assert_eq!(
            found,
            ["<umbrage_shadow::query::Query<S,M,P>>::share_by::{{closure}}", "umbrage_depth::rows::look::{closure#0}"]
        );
    }
}
