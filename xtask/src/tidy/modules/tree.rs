//! All modules of a crate, read from its root on.

use super::tokens::{Import, Named, Source};
use proc_macro2::TokenStream;
use std::collections::{BTreeMap, BTreeSet};

/// A module, its place in the tree and what its source says.
#[derive(Debug)]
pub struct Module {
    /// Its path from the root, which is called `crate` itself.
    pub name: String,
    pub file: String,
    /// `None` for the root.
    pub parent: Option<usize>,
    pub children: BTreeMap<String, usize>,
    pub items: BTreeSet<String>,
    pub imports: Vec<Import>,
    pub names: Vec<Named>,
}

/// The modules of a crate; the first is its root.
#[derive(Debug, Default)]
pub struct Tree {
    pub modules: Vec<Module>,
}

/// What is known of a module before its source is read.
struct Place<'a> {
    name: String,
    file: &'a str,
    /// Where the files of its children are, with a slash at the end.
    folder: String,
    parent: Option<usize>,
}

impl Tree {
    /// Reads the file and those of all modules below it. The error is a finding.
    pub fn read(root: &str, read: &dyn Fn(&str) -> Option<String>) -> Result<Self, String> {
        let mut tree = Self::default();
        let text = read(root).ok_or_else(|| format!("{root}: there is no such file"))?;
        let folder = root.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/"));
        tree.add(Place { name: "crate".into(), file: root, folder, parent: None }, tokens(root, &text)?, read)?;
        Ok(tree)
    }

    fn add(
        &mut self,
        place: Place,
        tokens: TokenStream,
        read: &dyn Fn(&str) -> Option<String>,
    ) -> Result<usize, String> {
        let Place { name, file, folder, parent } = place;
        let Source { modules, items, imports, names } = Source::new(tokens);
        let index = self.modules.len();
        let prefix = if parent.is_some() { format!("{name}::") } else { String::new() };
        let children = BTreeMap::new();
        self.modules.push(Module { name, file: file.into(), parent, children, items, imports, names });
        for (child, body) in modules {
            let below = |file| Place {
                name: format!("{prefix}{child}"),
                file,
                folder: format!("{folder}{child}/"),
                parent: Some(index),
            };
            let added = if let Some(body) = body {
                self.add(below(file), body, read)?
            } else {
                let files = [format!("{folder}{child}.rs"), format!("{folder}{child}/mod.rs")];
                let found = files.iter().find_map(|file| Some((file, read(file)?)));
                let (own, text) = found.ok_or_else(|| format!("{file}: there is no file for the module {child}"))?;
                self.add(below(own), self::tokens(own, &text)?, read)?
            };
            self.modules[index].children.insert(child, added);
        }
        Ok(index)
    }
}

fn tokens(file: &str, text: &str) -> Result<TokenStream, String> {
    text.parse().map_err(|error| format!("{file}: is not Rust: {error}"))
}
