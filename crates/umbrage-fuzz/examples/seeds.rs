//! Writes good files of every format for libFuzzer to begin with: `cargo run -p umbrage-fuzz --example seeds -- fuzz/corpus`.

use std::path::PathBuf;
use umbrage_fuzz::TARGETS;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let corpus = PathBuf::from(std::env::args_os().nth(1).ok_or("give the folder to write to")?);
    for target in TARGETS {
        let folder = corpus.join(target.name);
        std::fs::create_dir_all(&folder)?;
        for (number, seed) in (target.seeds)().into_iter().enumerate() {
            std::fs::write(folder.join(format!("seed-{number}")), seed)?;
        }
    }
    Ok(())
}
