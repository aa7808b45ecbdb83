//! Words that must not stand in code.

/// Stands where `word` does, unless a letter of a name touches it.
fn stands(line: &str, word: &str) -> bool {
    let name = |letter: char| letter.is_alphanumeric() || letter == '_';
    line.match_indices(word).any(|(at, _)| {
        let before = line[..at].chars().next_back().is_some_and(name);
        let after = word.ends_with(name) && line[at + word.len()..].chars().next().is_some_and(name);
        !before && !after
    })
}

/// Never, anywhere.
const FORBIDDEN: [&str; 4] = ["unsafe", "todo!", "dbg!", "unimplemented!"];
/// Signs of a file being opened.
const FILES: [&str; 4] = ["std::fs", "fs::", "File::", "OpenOptions"];

/// Where files may be opened: what reads and writes them for all, what keeps runs on disk, what makes broken ones, and the chores.
const OPENS_FILES: [&str; 6] = [
    "crates/umbrage-io/",
    "crates/umbrage-gltf/",
    "crates/umbrage-report/",
    "crates/umbrage-figures/",
    "crates/umbrage-fuzz/",
    "xtask/",
];

/// Findings of one source file.
pub fn source(file: &str, text: &str) -> Vec<String> {
    let mut findings = Vec::new();
    let opens_files = OPENS_FILES.iter().any(|folder| file.starts_with(folder));
    let for_tests = ["tests/", "examples/"].iter().any(|folder| file.starts_with(folder))
        || ["/tests/", "/benches/", "/build.rs"].iter().any(|part| file.contains(part));
    for (index, line) in code(text).lines().enumerate() {
        let mut say = |what: &str| findings.push(format!("{file}:{}: {what}", index + 1));
        for word in FORBIDDEN.into_iter().filter(|word| stands(line, word)) {
            say(&format!("{word} stands in code"));
        }
        if line.contains("#[allow(") || line.contains("#![allow(") {
            say("allow where expect with a reason belongs");
        }
        if !opens_files
            && !for_tests
            && let Some(word) = FILES.into_iter().find(|word| stands(line, word))
        {
            say(&format!("{word} opens files outside umbrage-io"));
        }
    }
    findings
}

/// The source with comments and the insides of strings blanked, line for line.
fn code(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let mut code = String::with_capacity(text.len());
    let mut at = 0;
    while at < letters.len() {
        let end = match letters[at] {
            '/' if letters.get(at + 1) == Some(&'/') => line_end(&letters, at),
            '/' if letters.get(at + 1) == Some(&'*') => comment_end(&letters, at),
            '"' => string_end(&letters, at),
            'r' if !touches_name(&letters, at) => raw_string_end(&letters, at).unwrap_or(at),
            '\'' => char_end(&letters, at),
            _ => at,
        };
        if end == at {
            code.push(letters[at]);
            at += 1;
        } else {
            code.extend(letters[at..end].iter().map(|letter| if *letter == '\n' { '\n' } else { ' ' }));
            at = end;
        }
    }
    code
}

/// Whether a name goes on across this place, so that its letter begins no raw string. `br` does begin one.
fn touches_name(letters: &[char], at: usize) -> bool {
    let name = |index: usize| letters[index].is_alphanumeric() || letters[index] == '_';
    let byte = at > 0 && letters[at - 1] == 'b' && !(at > 1 && name(at - 2));
    at > 0 && name(at - 1) && !byte
}

fn line_end(letters: &[char], at: usize) -> usize {
    letters[at..].iter().position(|letter| *letter == '\n').map_or(letters.len(), |length| at + length)
}

/// Block comments nest.
fn comment_end(letters: &[char], mut at: usize) -> usize {
    let mut depth = 0;
    while at < letters.len() {
        match (letters[at], letters.get(at + 1)) {
            ('/', Some('*')) => (depth, at) = (depth + 1, at + 2),
            ('*', Some('/')) if depth == 1 => return at + 2,
            ('*', Some('/')) => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
    }
    at
}

fn string_end(letters: &[char], mut at: usize) -> usize {
    at += 1;
    while at < letters.len() {
        match letters[at] {
            '\\' => at += 2,
            '"' => return at + 1,
            _ => at += 1,
        }
    }
    letters.len()
}

/// `None` where no raw string begins.
fn raw_string_end(letters: &[char], at: usize) -> Option<usize> {
    let hashes = letters[at + 1..].iter().take_while(|letter| **letter == '#').count();
    let open = at + 1 + hashes;
    if letters.get(open) != Some(&'"') {
        return None;
    }
    let closes = |end: usize| {
        letters[end] == '"' && letters[end + 1..].iter().take(hashes).filter(|l| **l == '#').count() == hashes
    };
    Some((open + 1..letters.len()).find(|end| closes(*end)).map_or(letters.len(), |end| end + 1 + hashes))
}

/// A character's end; a lifetime's tick ends where it begins.
fn char_end(letters: &[char], at: usize) -> usize {
    match (letters.get(at + 1), letters.get(at + 2)) {
        (Some('\\'), _) => {
            let rest = letters.get(at + 3..).unwrap_or(&[]);
            rest.iter().position(|letter| *letter == '\'').map_or(at, |length| at + 4 + length)
        }
        (Some(_), Some('\'')) => at + 3,
        _ => at,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_forbidden_word_is_found_in_code_and_nowhere_else() {
        for word in FORBIDDEN {
            let bad = format!("fn f() {{\n    {word} {{ }}\n}}\n");
            assert_eq!(source("crates/x/src/a.rs", &bad), [format!("crates/x/src/a.rs:2: {word} stands in code")]);
            let talk = format!(
                "// {word}\n/* a /* {word} */ {word} */\nlet s = \"\\\"{word}\"; let r = r#\"\"{word}\"#; let b = br\"{word}\";\nlet my_{word}\n"
            );
            assert_eq!(source("crates/x/src/a.rs", &talk), Vec::<String>::new(), "{talk}");
        }
        assert!(source("a.rs", "let unsafe_code = 1;").is_empty());
    }

    #[test]
    fn quotes_as_characters_do_not_begin_strings() {
        let text = "let a = '\"'; dbg!(1); let b = '\\''; let c: &'static str = \"dbg!\"; dbg!(2)";
        assert_eq!(source("a.rs", text).len(), 1, "one line, one finding a word");
        assert!(code("'\"' x").ends_with(" x") && code("&'a str").contains("'a str"));
        assert_eq!(code("a\n/*\n*/b").lines().count(), 3, "lines keep their numbers");
    }

    #[test]
    fn files_are_opened_in_few_places_only() {
        for text in ["use std::fs;", "use std::{fs::File};", "File::open(p)", "OpenOptions::new()"] {
            assert_eq!(source("crates/umbrage-scene/src/a.rs", text).len(), 1, "{text}");
            let own = OPENS_FILES.map(|folder| format!("{folder}src/a.rs"));
            for allowed in own.iter().map(String::as_str).chain(["tests/src/a.rs", "crates/x/tests/a.rs"]) {
                assert!(source(allowed, text).is_empty(), "{allowed}: {text}");
            }
        }
        assert!(source("crates/x/src/a.rs", "fn offs::x; MyFile::open").is_empty());
    }

    #[test]
    fn lints_are_expected_not_allowed() {
        assert_eq!(source("a.rs", "#[allow(dead_code)]"), ["a.rs:1: allow where expect with a reason belongs"]);
        assert!(source("a.rs", "#[expect(dead_code, reason = \"r\")]").is_empty());
    }
}
