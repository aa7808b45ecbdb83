//! Who uses whom: names followed to where they are defined.

use super::tree::{Module, Tree};
use std::collections::{BTreeMap, BTreeSet};

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Meaning {
    Module(usize),
    /// Something that this module defines.
    ItemOf(usize),
}

/// Words that one search has asked for already, by module: whoever asks again goes round, or fails as the first did.
type Asked<'a> = BTreeSet<(usize, &'a str, bool)>;

/// Every pair of a module and another that it uses, with the first place where it does.
pub fn uses(tree: &Tree) -> BTreeMap<(usize, usize), String> {
    let mut uses = BTreeMap::new();
    for (index, module) in tree.modules.iter().enumerate() {
        let imports = module.imports.iter().filter(|import| !import.given_on && import.name != "*");
        let imported = imports.map(|import| (&import.path, import.line));
        let named =
            module.names.iter().filter(|named| tells(module, &named.path)).map(|named| (&named.path, named.line));
        for (path, line) in imported.chain(named) {
            if let Some(Meaning::ItemOf(other)) = tree.meaning(index, path, &mut Asked::new())
                && other != index
            {
                let place = || format!("{}:{line} uses {}", module.file, path.join("::"));
                uses.entry((index, other)).or_insert_with(place);
            }
        }
    }
    uses
}

/// Whether a name in code says more than the imports do: one word does only where it comes by a re-export or a `*`.
fn tells(module: &Module, path: &[String]) -> bool {
    let [word] = path else { return true };
    let privately = module.imports.iter().any(|import| !import.given_on && import.name == *word);
    !privately && !module.children.contains_key(word)
}

impl Tree {
    /// What a path means in a module; `None` for what is from elsewhere, or not known.
    fn meaning<'a>(&'a self, from: usize, path: &'a [String], asked: &mut Asked<'a>) -> Option<Meaning> {
        let (first, rest) = path.split_first()?;
        let mut meaning = match first.as_str() {
            "crate" => Meaning::Module(0),
            "self" => Meaning::Module(from),
            "super" => Meaning::Module(self.modules[from].parent?),
            name => self.look_up(from, name, !rest.is_empty(), asked)?,
        };
        for (index, name) in rest.iter().enumerate() {
            // Behind an item come its variants and functions.
            let Meaning::Module(module) = meaning else { break };
            meaning = match name.as_str() {
                "super" => Meaning::Module(self.modules[module].parent?),
                name => self.look_up(module, name, index + 1 < rest.len(), asked)?,
            };
        }
        Some(meaning)
    }

    /// What one word means in a module. A module and a function may bear one name: `goes_on` says that a module is meant.
    fn look_up<'a>(&'a self, at: usize, name: &'a str, goes_on: bool, asked: &mut Asked<'a>) -> Option<Meaning> {
        let module = &self.modules[at];
        let child = module.children.get(name).map(|&child| Meaning::Module(child));
        let item = module.items.contains(name).then_some(Meaning::ItemOf(at));
        let own = if goes_on { child.or(item) } else { item.or(child) };
        if own.is_some() {
            return own;
        }
        if !asked.insert((at, name, goes_on)) {
            return None;
        }
        // A `use` of one word alone brings another crate's name.
        let imports = module.imports.iter().filter(|import| import.name == name && import.path != [name]);
        let stars = module.imports.iter().filter(|import| import.name == "*");
        for import in imports {
            if let Some(meaning) = self.meaning(at, &import.path, asked) {
                return Some(meaning);
            }
        }
        for star in stars {
            if let Some(Meaning::Module(all)) = self.meaning(at, &star.path, asked)
                && all != at
                && let Some(meaning) = self.look_up(all, name, goes_on, asked)
            {
                return Some(meaning);
            }
        }
        None
    }
}
