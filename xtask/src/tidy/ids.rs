//! Ids of requirements: explained on one page, and never in documentation.

use std::collections::BTreeSet;

/// The page that explains them.
pub const PAGE: &str = "tests/requirements.md";

/// Crates that are not published: their documentation may cite ids, since their readers have the repository.
const UNPUBLISHED: [&str; 3] = ["crates/umbrage-bench/", "crates/umbrage-figures/", "crates/umbrage-fuzz/"];

/// The ids that the page explains: the first cells of its tables.
pub fn explained(page: &str) -> BTreeSet<&str> {
    let cells = page.lines().filter_map(|line| line.strip_prefix("| ")?.split(" |").next());
    cells.flat_map(|cell| cell.split(", ")).filter(|word| is_id(word)).collect()
}

/// Findings of one source file or page: ids that are not explained, and ids in the documentation of a published crate.
pub fn cited(file: &str, text: &str, explained: &BTreeSet<&str>) -> Vec<String> {
    let documented =
        file.starts_with("crates/") && file.contains("/src/") && !UNPUBLISHED.iter().any(|one| file.starts_with(one));
    let mut findings = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let mut say = |what: String| findings.push(format!("{file}:{}: {what}", index + 1));
        let comment = line.trim_start();
        let shown = documented && (comment.starts_with("///") || comment.starts_with("//!"));
        for word in words(line) {
            if is_id(word) && !explained.contains(word) {
                say(format!("{word} is not explained in {PAGE}"));
            }
            if shown && (is_id(word) || is_figure(word) || is_measure(word)) {
                say(format!("{word} means nothing to readers of the documentation"));
            }
        }
    }
    findings
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|letter: char| !letter.is_alphanumeric() && letter != '-' && letter != '_')
}

fn digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// A number, perhaps with a letter behind it that tells it from its neighbour.
fn numbered(text: &str) -> bool {
    digits(text) || text.strip_suffix(|letter| ('a'..='d').contains(&letter)).is_some_and(digits)
}

/// Whether a word is the id of a requirement, convention, derivation, erratum, extension, trap, vector or common need.
fn is_id(word: &str) -> bool {
    match word.split_once('-') {
        Some(("W78" | "R87" | "W92" | "WM94" | "B06" | "EXT" | "C" | "D" | "T" | "X", number)) => numbered(number),
        Some(("E", place)) => place.strip_prefix(['R', 'M', 'B', 'W']).is_some_and(digits),
        None => word.strip_prefix('V').is_some_and(|number| number.len() > 1 && number.len() < 4 && numbered(number)),
        Some(_) => false,
    }
}

/// Whether a word is the id of a figure or a claim of a paper.
fn is_figure(word: &str) -> bool {
    matches!(word.split_once('-'), Some(("W78" | "R87" | "W92" | "WM94" | "B06", rest)) if !rest.is_empty())
}

/// Whether a word is the id of a measure.
fn is_measure(word: &str) -> bool {
    word.strip_prefix('M').is_some_and(|number| number.len() < 3 && digits(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str =
        "| id | asked |\n|---|---|\n| R87-22 | tiles |\n| V46b, V46c | codes |\n| C-10, D-9 and more | no |\n";

    #[test]
    fn the_page_explains_what_its_tables_begin_with() {
        let ids: Vec<&str> = explained(TABLE).into_iter().collect();
        assert_eq!(ids, ["C-10", "R87-22", "V46b", "V46c"]);
    }

    #[test]
    fn an_id_that_is_cited_is_explained() {
        let ids = explained(TABLE);
        for good in ["// (R87-22, V46b)", "fn r87_23()", "R87-F7", "1e-5 UTF-8 D-Bus X-ray V8 M0 C-3PO V2", "// C-10."]
        {
            assert!(cited("tests/a.rs", good, &ids).is_empty(), "{good}");
        }
        for (bad, id) in [("// (R87-23)", "R87-23"), ("\"E-R15:\"", "E-R15"), ("V47", "V47"), ("T-1..T-2", "T-1")] {
            assert_eq!(cited("a.rs", bad, &ids)[0], format!("a.rs:1: {id} is not explained in {PAGE}"));
        }
    }

    #[test]
    fn documentation_of_published_crates_has_no_id() {
        let ids = explained(TABLE);
        for id in ["R87-22", "R87-F7", "W78-plane", "M2"] {
            let text = format!("fn a() {{}}\n    /// Lit ({id}).\n    // Lit ({id}).\n");
            let wanted = [format!("crates/x/src/a.rs:2: {id} means nothing to readers of the documentation")];
            assert_eq!(cited("crates/x/src/a.rs", &text, &ids), wanted);
            for other in ["crates/umbrage-figures/src/a.rs", "crates/x/tests/a.rs", "tests/src/a.rs"] {
                assert!(cited(other, &text, &ids).is_empty());
            }
        }
    }
}
