//! What people report about shadow maps and depth files, each situation rebuilt small, with the right answer beside what is found:
//! `cargo test -p umbrage-tests reported -- --nocapture` prints the table.

mod lights;
mod stage;
mod things;

use lights::{framing, parallel, places_and_biases, resolution, truth};
use std::fmt::Display;
use things::{maps_and_files, meshes, stacks};

/// One row: where it belongs, what is rebuilt, and the right answer beside the one found.
struct Row {
    kind: &'static str,
    situation: String,
    right: String,
    found: String,
}

/// The list.
#[derive(Default)]
struct Table(Vec<Row>);

impl Table {
    /// Adds a row.
    fn row(&mut self, kind: &'static str, situation: impl Into<String>, right: impl Display, found: impl Display) {
        let (right, found) = (right.to_string(), found.to_string());
        self.0.push(Row { kind, situation: situation.into(), right, found });
    }
}

#[test]
fn every_reported_situation_has_its_right_answer() {
    let mut table = Table::default();
    for part in [truth, framing, parallel, resolution, places_and_biases, stacks, maps_and_files, meshes] {
        part(&mut table);
    }
    let mut wrong = Vec::new();
    for Row { kind, situation, right, found } in &table.0 {
        let verdict = if right == found { "ok" } else { "WRONG" };
        println!("| {kind} | {situation} | {right} | {found} | {verdict} |");
        if right != found {
            wrong.push(format!("{situation}: {found} instead of {right}"));
        }
    }
    assert!(table.0.len() > 60 && wrong.is_empty(), "{} of {} rows:\n{}", wrong.len(), table.0.len(), wrong.join("\n"));
}
