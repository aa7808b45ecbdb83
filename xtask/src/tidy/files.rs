//! Sizes of files, and links between them.

/// No single file may be larger.
const LARGEST_FILE: u64 = 5_000_000;
/// All fixtures together may not be larger.
const ALL_FIXTURES: u64 = 5_000_000;

/// A file that is too large to keep.
pub fn too_large(file: &str, bytes: u64) -> Option<String> {
    (bytes > LARGEST_FILE).then(|| format!("{file}: {bytes} bytes are more than {LARGEST_FILE}"))
}

/// Fixtures that are too large together.
pub fn fixtures_too_large(bytes: &[u64]) -> Option<String> {
    let sum: u64 = bytes.iter().sum();
    (sum > ALL_FIXTURES).then(|| format!("fixtures: {sum} bytes together are more than {ALL_FIXTURES}"))
}

/// Links of a Markdown page to files that are not there. `exists` is called for each relative address.
pub fn dead_links(file: &str, text: &str, exists: impl Fn(&str) -> bool) -> Vec<String> {
    let mut findings = Vec::new();
    for link in links(text) {
        let path = link.split(['#', '?']).next().unwrap_or("");
        if !path.is_empty() && !elsewhere(path) && !exists(path) {
            findings.push(format!("{file}: there is no {path}"));
        }
    }
    findings
}

/// An address with a scheme, such as `https:`.
fn elsewhere(link: &str) -> bool {
    link.split_once(':')
        .is_some_and(|(scheme, _)| !scheme.is_empty() && scheme.bytes().all(|b| b.is_ascii_alphabetic()))
}

/// Addresses of Markdown links and of HTML's `src` and `href`; those in fenced code are examples and are passed over.
fn links(text: &str) -> Vec<&str> {
    let mut links = Vec::new();
    let mut fenced = false;
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        }
        if fenced {
            continue;
        }
        for (open, close) in [("](", ')'), ("src=\"", '"'), ("href=\"", '"')] {
            for (at, _) in line.match_indices(open) {
                let link = line[at + open.len()..].split(close).next().unwrap_or("");
                // A Markdown link may carry a title behind a space.
                links.extend(link.split(' ').next());
            }
        }
    }
    links
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_to_files_are_followed_and_others_are_not() {
        let text = "[a](here.md#part) ![b](gone.png \"title\") [c](https://x.y/z) [d](#part) <img src=\"lost.png\">\n\
                    ```\n[e](example.rs)\n```\n[f](mailto:a@b)";
        assert_eq!(
            dead_links("README.md", text, |link| link == "here.md"),
            ["README.md: there is no gone.png", "README.md: there is no lost.png"]
        );
    }

    #[test]
    fn sizes_have_limits() {
        assert_eq!(too_large("f", LARGEST_FILE), None);
        assert_eq!(too_large("f", 5_000_001).unwrap(), "f: 5000001 bytes are more than 5000000");
        assert_eq!(fixtures_too_large(&[2_500_000, 2_500_000]), None);
        assert!(fixtures_too_large(&[2_500_000, 2_500_001]).is_some());
    }
}
