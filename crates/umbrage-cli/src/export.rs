//! `umbrage export`.

use crate::args::{Cli, ExportArgs};
use crate::shell::{Shell, Usage};
use crate::stage::Stage;
use umbrage_io::write_bytes;

pub fn run(cli: &Cli, args: &ExportArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    if !args.output.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("glb")) {
        return Err(Usage(format!("--output {}: expected .glb", args.output.display())).into());
    }
    let stage = Stage::new(&args.source, &args.scene, cli.max_memory, 0, shell)?;
    Ok(write_bytes(&args.output, &umbrage_gltf::encode(&stage.scene)?)?)
}
