//! `umbrage view`.

mod base;
mod command;
mod held;
mod open;
mod table;
mod truths;
mod viewer;

use crate::args::{Cli, ViewArgs};
use crate::shell::Shell;
use anyhow::Context;
use serde_json::json;
use std::sync::Arc;
use umbrage_view::Server;
use viewer::Viewer;

pub fn run(cli: &Cli, args: &ViewArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let viewer = Viewer::new(cli, args, shell)?;
    let server = Server::bind(args.port).with_context(|| format!("--port {}", args.port))?;
    let address = server.address();
    if cli.json {
        writeln!(shell.out, "{}", json!({ "address": address }))?;
    } else {
        writeln!(shell.out, "{address}")?;
    }
    // The address is needed now, not once the command has ended.
    shell.out.flush()?;
    shell.note("the page is available while this runs; Ctrl-C ends it");
    if args.open
        && let Err(problem) = open::in_browser(&address)
    {
        shell.note(&format!("warning: --open: {problem}"));
    }
    server.run(Arc::new(viewer)).context("the page's server")
}
