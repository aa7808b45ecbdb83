//! Whether the modules inside a crate use one another one way.
//!
//! One module uses another when its code names something that is *defined* in the other: by a `use`, by a path such as
//! `crate::a::B`, `super::B` or `a::B`, or through a name that a `use` with `pub` or a `*` brought into its scope. Every name is
//! followed through all re-exports to the module where it is defined. So
//!
//! * declaring a child, and re-exporting what it defines, is not a use; a parent whose own code names it is one;
//! * a child that names what its parent defines uses the parent: the two may not use each other;
//! * importing a module is not a use, but naming what is in it is;
//! * what stands under `#[cfg(test)]`, in attributes, comments and strings does not count;
//! * methods and fields are not followed: an `impl` may stand in another module than its type.
//!
//! Files are read as tokens, macros' included, and no macro is expanded: an item whose name no source spells after its
//! keyword (`struct`, `fn` ..) has no known place, and what uses it is passed over. A name of one word that happens to be a local variable's
//! and a re-export's counts as that re-export. `#[path]` and `include!` are not known here.
//!
//! A crate is in order when these uses form no circle. Where they do, its shortest circles are named, with a place for each step.

mod circle;
mod resolve;
mod tokens;
mod tree;

use circle::shortest_circles;
use resolve::uses;
use tree::Tree;

/// The circles of the crate whose root is `root` (such as `crates/x/src/lib.rs`), a finding each. `read` gives the text of a file
/// of that crate, and `None` where there is none.
pub fn circles(root: &str, read: &dyn Fn(&str) -> Option<String>) -> Vec<String> {
    let tree = match Tree::read(root, read) {
        Ok(tree) => tree,
        Err(fault) => return vec![fault],
    };
    let uses = uses(&tree);
    shortest_circles(uses.keys().copied())
        .into_iter()
        .map(|circle| {
            let name = |module: usize| tree.modules[module].name.as_str();
            let way: Vec<&str> = circle.iter().chain(circle.first()).map(|&module| name(module)).collect();
            let steps = (0..circle.len()).map(|i| (circle[i], circle[(i + 1) % circle.len()]));
            let places: Vec<String> = steps.filter_map(|step| uses.get(&step).cloned()).collect();
            format!("{root}: modules use one another in a circle: {} ({})", way.join(" -> "), places.join("; "))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The circles of a crate in memory, without the places.
    fn ways(files: &[(&str, &str)]) -> Vec<String> {
        found(files).iter().map(|text| text.split(": ").nth(2).unwrap().split(" (").next().unwrap().into()).collect()
    }

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let read = |name: &str| files.iter().find(|(file, _)| *file == name).map(|(_, text)| (*text).to_string());
        circles("lib.rs", &read)
    }

    const NONE: [&str; 0] = [];

    #[test]
    fn one_way_is_in_order() {
        let files = [
            ("lib.rs", "mod a; mod b; pub use a::A; pub use b::{B, make};"),
            ("a.rs", "pub struct A;"),
            ("b.rs", "use crate::A; pub struct B(A); pub fn make() -> crate::a::A { A }"),
        ];
        assert_eq!(ways(&files), NONE);
    }

    #[test]
    fn a_direct_circle_is_named_with_its_places() {
        let files = [
            ("lib.rs", "mod a;\nmod b;"),
            ("a.rs", "use crate::b::B;\npub struct A(B);"),
            ("b.rs", "pub struct B;\n\nfn f() -> crate::a::A { todo() }"),
        ];
        let expected = "lib.rs: modules use one another in a circle: a -> b -> a (a.rs:1 uses crate::b::B; b.rs:3 uses crate::a::A)";
        assert_eq!(found(&files), [expected]);
    }

    #[test]
    fn re_exports_hide_no_circle() {
        let b = "use crate::{A as Other}; pub struct B(Other);";
        for root in ["mod a; mod b; pub use a::A; pub use b::B;", "mod a; mod b; pub use a::*; pub use b::*;"] {
            assert_eq!(
                ways(&[("lib.rs", root), ("a.rs", "use crate::B; pub struct A(B);"), ("b.rs", b)]),
                ["a -> b -> a"]
            );
            let through_star = "use crate::*; pub struct A(B);";
            assert_eq!(ways(&[("lib.rs", root), ("a.rs", through_star), ("b.rs", b)]), ["a -> b -> a"]);
        }
        // Over two re-exports.
        let files = [
            ("lib.rs", "mod a; mod b; mod c; use c::B as Hidden; struct Root(Hidden);"),
            ("a.rs", "use super::c::Both; pub struct A(Both);"),
            ("b.rs", b.replace("crate::{A as Other}", "super::a::A as Other").leak()),
            ("c.rs", "pub use crate::b::B; pub use B as Both;"),
        ];
        assert_eq!(ways(&files), ["a -> b -> a"]);
    }

    #[test]
    fn a_parent_and_its_child_may_not_use_each_other() {
        let child = ("a.rs", "pub struct A(super::Root);");
        let root = |code: &str| format!("mod a; pub use a::A; pub struct Root; {code}");
        let of = |code: &str| ways(&[("lib.rs", &root(code)), child]);
        assert_eq!(of(""), NONE, "declaring and re-exporting are no use");
        for code in [
            "fn f(_: A) {}",
            "fn f() { a::A::new(); }",
            "use a::A as B;",
            "fn f(_: crate::A) {}",
            "fn f(_: self::a::A) {}",
        ] {
            assert_eq!(of(code), ["crate -> a -> crate"], "{code}");
        }
        assert_eq!(of("fn f() { x.A; let a = a; }"), NONE, "a field and a variable");
    }

    #[test]
    fn modules_nest() {
        let files = [
            ("lib.rs", "mod a; mod d { pub mod e { pub struct E(crate::a::c::C); } }"),
            ("a/mod.rs", "pub mod b; pub mod c; pub use b::B;"),
            ("a/b.rs", "pub mod low; pub struct B;"),
            ("a/b/low.rs", "use super::super::c::C; pub fn low(_: C) {}"),
            ("a/c.rs", "use crate::d::e; pub struct C(super::b::low::Low, e::E); fn f() { super::b::low::low(); }"),
        ];
        assert_eq!(ways(&files), ["a::b::low -> a::c -> a::b::low", "a::c -> d::e -> a::c"]);
    }

    #[test]
    fn tests_comments_strings_and_attributes_do_not_count() {
        let b = "pub struct B; #[cfg(test)] mod tests { use crate::a::A; } /// [`crate::a::A`]\nfn f() { \"crate::a::A\"; // crate::a::A\n }
                 #[cfg(all(test, unix))] use crate::a::{A}; #[cfg(test)] fn g() -> crate::a::A { A } #[doc(alias = \"x\")] #[cfg(test)] mod more;";
        let a = "use crate::b::B; pub struct A(B);";
        assert_eq!(ways(&[("lib.rs", "mod a; mod b;"), ("a.rs", a), ("b.rs", b)]), NONE);
        for live in [
            "#[cfg(not(test))] use crate::a::A;",
            "#[cfg(any(test, unix))] use crate::a::A;",
            "#[cfg(test)] use x::y; use crate::a::A;",
        ] {
            assert_eq!(
                ways(&[("lib.rs", "mod a; mod b;"), ("a.rs", a), ("b.rs", &format!("pub struct B; {live}"))]),
                ["a -> b -> a"]
            );
        }
    }

    #[test]
    fn macros_are_looked_into_and_what_they_alone_define_is_passed_over() {
        let a = "use crate::b::B; pub struct A(B); made!(Hidden); made! { pub struct Shown; }";
        let of = |b: &str| ways(&[("lib.rs", "mod a; mod b;"), ("a.rs", a), ("b.rs", b)]);
        assert_eq!(of("pub struct B; use crate::a::Hidden;"), NONE);
        assert_eq!(of("pub struct B; use crate::a::Shown;"), ["a -> b -> a"]);
        assert_eq!(of("pub struct B; fn f() { assert!(crate::a::A == 1); }"), ["a -> b -> a"]);
    }

    #[test]
    fn stars_that_lead_round_come_to_an_end() {
        let all = "pub use super::*; pub use super::b::*; pub use super::c::*; pub use other::all::*;";
        let files = ["a.rs", "b.rs", "c.rs"].map(|file| (file, format!("{all} fn f() {{ unknown(unknown::x); }}")));
        let mut files: Vec<(&str, &str)> = files.iter().map(|(file, text)| (*file, text.as_str())).collect();
        files.push(("lib.rs", "mod a; mod b; mod c; pub use a::*; pub use b::*; pub use c::*;"));
        assert_eq!(ways(&files), NONE);
    }

    #[test]
    fn what_cannot_be_read_is_a_finding() {
        assert_eq!(found(&[("lib.rs", "mod a;")]), ["lib.rs: there is no file for the module a"]);
        assert!(found(&[("lib.rs", "fn f( {")])[0].starts_with("lib.rs: is not Rust: "));
    }
}
