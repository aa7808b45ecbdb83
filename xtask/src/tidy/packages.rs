//! What the registry asks of a package, or that a package says itself that it is not for the registry.

use toml::{Table, Value};

/// The registry's names of subjects that are used here. It refuses others only when a package is sent.
const CATEGORIES: [&str; 13] = [
    "algorithms",
    "command-line-utilities",
    "data-structures",
    "development-tools::testing",
    "game-development",
    "graphics",
    "mathematics",
    "multimedia::images",
    "parser-implementations",
    "rendering",
    "rendering::data-formats",
    "rendering::engine",
    "visualization",
];

/// Files that stand beside a published package's manifest.
const BESIDE: [&str; 3] = ["README.md", "LICENSE-MIT", "LICENSE-APACHE"];

/// Findings of one package's manifest; `there` answers whether a file stands beside it.
pub fn manifest(file: &str, text: &str, there: impl Fn(&str) -> bool) -> Vec<String> {
    // Whoever checks arrows reports a manifest that cannot be read.
    let Some(package) = text.parse::<Table>().ok().and_then(|manifest| manifest.get("package")?.as_table().cloned())
    else {
        return Vec::new();
    };
    let finding = |what: &str| format!("{file}: {what}");
    match package.get("publish") {
        Some(Value::Boolean(false)) => return Vec::new(),
        Some(Value::Table(inherited)) if inherited.get("workspace") == Some(&Value::Boolean(true)) => {}
        _ => return vec![finding("neither inherits the switch `publish` nor says false")],
    }
    let mut findings = Vec::new();
    let text = |key: &str| package.get(key).and_then(Value::as_str).unwrap_or("");
    let list = |key: &str| -> Vec<&str> {
        package.get(key).and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str).collect()
    };
    if text("description").is_empty() {
        findings.push(finding("has no description"));
    }
    if text("readme") != "README.md" {
        findings.push(finding("readme is not README.md"));
    }
    if text("documentation") != format!("https://docs.rs/{}", text("name")) {
        findings.push(finding("documentation is not the package's page on docs.rs"));
    }
    let (keywords, categories) = (list("keywords"), list("categories"));
    let plain = |word: &&str| {
        word.len() <= 20
            && word.starts_with(|letter: char| letter.is_ascii_alphanumeric())
            && word.chars().all(|letter| letter.is_ascii_alphanumeric() || "-_+".contains(letter))
    };
    if !(1..=5).contains(&keywords.len()) || !keywords.iter().all(plain) {
        findings.push(finding("keywords are not one to five plain words of at most 20 letters"));
    }
    if !(1..=5).contains(&categories.len()) || !categories.iter().all(|one| CATEGORIES.contains(one)) {
        findings.push(finding("categories are not one to five of the registry's"));
    }
    let on_docs_rs = package.get("metadata").and_then(|metadata| metadata.get("docs")?.get("rs")?.get("all-features"));
    if on_docs_rs != Some(&Value::Boolean(true)) {
        findings.push(finding("docs.rs would not show all features"));
    }
    findings.extend(BESIDE.iter().filter(|name| !there(name)).map(|name| finding(&format!("has no {name} beside it"))));
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "[package]\nname = \"p\"\npublish.workspace = true\ndescription = \"d\"\nreadme = \"README.md\"\n\
        documentation = \"https://docs.rs/p\"\nkeywords = [\"shadow-map\"]\ncategories = [\"graphics\"]\n\
        [package.metadata.docs.rs]\nall-features = true\n";

    fn found(text: &str) -> Vec<String> {
        manifest("m", text, |_| true)
    }

    #[test]
    fn a_package_for_the_registry_says_all_that_it_asks() {
        assert_eq!(found(GOOD), Vec::<String>::new());
        for (from, to, what) in [
            ("description = \"d\"", "", "has no description"),
            ("README.md", "../README.md", "readme is not README.md"),
            ("docs.rs/p", "docs.rs/q", "documentation is not the package's page on docs.rs"),
            ("[\"shadow-map\"]", "[]", "keywords are not one to five plain words of at most 20 letters"),
            ("shadow-map", "shadow map", "keywords are not one to five plain words of at most 20 letters"),
            ("\"graphics\"", "\"pictures\"", "categories are not one to five of the registry's"),
            ("all-features = true", "", "docs.rs would not show all features"),
        ] {
            assert_eq!(found(&GOOD.replace(from, to)), [format!("m: {what}")]);
        }
        let without = manifest("m", GOOD, |name| name != "LICENSE-MIT");
        assert_eq!(without, ["m: has no LICENSE-MIT beside it"]);
    }

    #[test]
    fn the_others_say_that_they_are_not_for_it() {
        assert!(found("[package]\nname = \"p\"\npublish = false\n").is_empty());
        for rest in ["", "publish = true\n", "publish = [\"mine\"]\n"] {
            let wanted = ["m: neither inherits the switch `publish` nor says false"];
            assert_eq!(found(&format!("[package]\nname = \"p\"\n{rest}")), wanted);
        }
    }
}
