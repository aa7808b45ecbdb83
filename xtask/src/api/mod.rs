//! What the renderer's crates offer, as text that is kept: a change of it shows in `git diff`, a line for each public item.
//!
//! Sources are read as tokens and no macro is expanded: a macro that is called beside items stands there as its call. What counts are the
//! names that `lib.rs` gives on, everything public in its public modules, and what `impl`s give to them. Methods of traits from elsewhere
//! are not listed, only that the trait is implemented.

mod items;
mod text;

use anyhow::Context as _;
use items::{Item, Kind};
use std::collections::BTreeSet;
use std::path::Path;

/// The crates that a renderer takes.
const CRATES: [&str; 6] =
    ["umbrage-plane", "umbrage-sample", "umbrage-depth", "umbrage-shadow", "umbrage-raster", "umbrage-bake"];

/// What each of the crates offers, beside what is kept of it. With `bless` the kept text is replaced. Whether the two were the same, or are now.
pub fn run(root: &Path, bless: bool) -> anyhow::Result<bool> {
    let findings = findings(root, bless)?;
    for finding in &findings {
        println!("{finding}");
    }
    Ok(findings.is_empty())
}

/// A finding for each line that is kept and not offered, or offered and not kept; none after a blessing.
pub fn findings(root: &Path, bless: bool) -> anyhow::Result<Vec<String>> {
    let mut findings = Vec::new();
    for name in CRATES {
        let folder = root.join("crates").join(name);
        // A part of the repository is enough for this program's tests.
        if !folder.join("src/lib.rs").is_file() {
            continue;
        }
        let read = |file: &str| std::fs::read_to_string(folder.join("src").join(file)).ok();
        let offered = surface(&read).with_context(|| name.to_string())?;
        let file = format!("crates/{name}/api.txt");
        let path = root.join(&file);
        if bless {
            std::fs::write(&path, offered.join("\n") + "\n").with_context(|| file.clone())?;
            continue;
        }
        let Ok(kept) = std::fs::read_to_string(&path) else { continue };
        findings.extend(differences(&file, &kept, &offered));
    }
    Ok(findings)
}

fn differences(file: &str, kept: &str, offered: &[String]) -> Vec<String> {
    let kept: BTreeSet<&str> = kept.lines().collect();
    let offered: BTreeSet<&str> = offered.iter().map(String::as_str).collect();
    let gone = kept.difference(&offered).map(|line| format!("{file}: is no longer offered: {line}"));
    let new = offered.difference(&kept).map(|line| format!("{file}: is offered and not kept: {line}"));
    let mut findings: Vec<String> = gone.chain(new).collect();
    if !findings.is_empty() {
        findings.push(format!("{file}: `cargo xtask api --bless` keeps what is offered now"));
    }
    findings
}

/// What a crate offers, a line for each item, sorted. `read` gives the text of a file below its `src`, and `None` where there is none.
fn surface(read: &dyn Fn(&str) -> Option<String>) -> anyhow::Result<Vec<String>> {
    let all = items::of_crate(read)?;
    let mut given_on: BTreeSet<&str> = all.iter().filter(|item| item.given_on()).map(|item| &*item.name).collect();
    for item in all.iter().filter(|item| item.path.is_empty()) {
        if let Kind::Uses(names) = &item.kind {
            given_on.extend(names.iter().map(String::as_str));
        }
    }
    let mut lines = BTreeSet::new();
    for item in &all {
        let offered = match &item.kind {
            Kind::Uses(_) | Kind::Call => item.given_on() || matches!(item.kind, Kind::Call),
            Kind::Impl => given_on.contains(&*item.name),
            Kind::Defined => item.is_public && (item.is_exported || given_on.contains(&*item.name)),
        };
        if offered {
            lines.extend(lines_of(item));
        }
    }
    Ok(lines.into_iter().collect())
}

/// Public modules stand before what is in them.
fn lines_of(item: &Item) -> Vec<String> {
    let prefix =
        if item.given_on() && !item.path.is_empty() { format!("{}: ", item.path.join("::")) } else { String::new() };
    item.lines.iter().map(|line| format!("{prefix}{line}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(files: &[(&str, &str)]) -> Vec<String> {
        surface(&|name| files.iter().find(|(file, _)| *file == name).map(|(_, text)| (*text).to_string())).unwrap()
    }

    #[test]
    fn what_is_given_on_is_listed_with_its_fields_and_methods_and_nothing_else() {
        let lib = "//! Doc.\nmod a;\nmod b;\npub mod open;\npub use a::{Kept, Shape as Form, Trait};\npub use glam;\n\
                   #[cfg(test)]\nmod tests { pub struct No; }\n";
        let a = "/// D.\n#[derive(Clone, Debug)]\npub struct Kept<T = f32> where T: Copy { pub width: T, hidden: u32 }\n\
                 pub struct Alone(pub u32);\n\
                 impl<T: Copy> Kept<T> { pub fn new(width: T) -> Self { Self { width, hidden: 1 } } fn own(&self) {} pub(crate) fn near() {} }\n\
                 impl<T> std::fmt::Display for Kept<T> { fn fmt(&self) {} }\n\
                 builders!([] Kept { with_width width: f32 });\n\
                 #[non_exhaustive] pub enum Shape { Round { radius: f32 }, Flat(u8), None }\n\
                 pub trait Trait: Send { const N: usize; fn must(&self, x: &[u8]) -> Option<u8>; fn may(&self) -> bool { true } }\n";
        let b = "pub fn hidden() {}\n";
        let open = "pub const SIZE: usize = 4;\npub fn seen<'a>(at: &'a str) -> &'a str { at }\nfn unseen() {}\n";
        let lines = of(&[("lib.rs", lib), ("a.rs", a), ("b.rs", b), ("open.rs", open)]);
        let wanted = [
            "#[derive(Clone, Debug)] pub struct Kept<T = f32> where T: Copy { pub width: T, .. }",
            "#[non_exhaustive] pub enum Shape { Round { radius: f32 }, Flat(u8), None }",
            "builders!([] Kept { with_width width: f32 })",
            "impl<T: Copy> Kept<T>: pub fn new(width: T) -> Self",
            "impl<T> std::fmt::Display for Kept<T>",
            "open: pub const SIZE: usize",
            "open: pub fn seen<'a>(at: &'a str) -> &'a str",
            "pub mod open",
            "pub trait Trait: Send",
            "pub use a::{Kept, Shape as Form, Trait}",
            "pub use glam",
            "trait Trait: const N: usize",
            "trait Trait: fn may(&self) -> bool { .. }",
            "trait Trait: fn must(&self, x: &[u8]) -> Option<u8>",
        ];
        assert_eq!(lines, wanted);
    }

    #[test]
    fn what_is_gone_and_what_is_new_is_named() {
        assert!(differences("f", "a\nb\n", &["a".into(), "b".into()]).is_empty());
        let found = differences("f", "a\nb\n", &["b".into(), "c".into()]);
        assert_eq!(found[..2], ["f: is no longer offered: a", "f: is offered and not kept: c"]);
    }
}
