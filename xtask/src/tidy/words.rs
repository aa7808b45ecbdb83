//! Words that a native reader stumbles on, in comments and messages.

/// Parts of the names of measures, which `fixtures/figures.csv` holds as keys.
const NAMES: [&str; 3] =
    ["16 exact rays a pixel: error", "false shadow over the share of the disc", "the bias that D-9 asks for"];

/// What is written, and what is meant. Each begins and ends at the borders of words.
const WORDS: [(&str, &str); 43] = [
    ("depth a texel", "per texel"),
    ("depths a texel", "per texel"),
    ("bytes a texel", "per texel"),
    ("floats a texel", "per texel"),
    ("object a texel", "per texel"),
    ("sample a texel", "per texel"),
    ("samples a texel", "per texel"),
    ("once a texel", "per texel"),
    ("sample a pixel", "per pixel"),
    ("samples a pixel", "per pixel"),
    ("rays a pixel", "per pixel"),
    ("number a pixel", "per pixel"),
    ("texels a pixel", "per pixel"),
    ("texels a side", "per side"),
    ("points a region", "per region"),
    ("taps a region", "per region"),
    ("ray a point", "per point"),
    ("radians a frame", "per frame"),
    ("draw an axis", "per axis"),
    ("is no depth", "is not a depth"),
    ("are no depths", "are not depths"),
    ("is no map", "is not a map"),
    ("are no map", "are not a map"),
    ("is no surface of", "is not a surface of"),
    ("is no solid", "is not a solid"),
    ("is no PNG", "is not a PNG"),
    ("is no EXR", "is not an EXR file"),
    ("is no length", "is not a length"),
    ("is no share", "is not a fraction"),
    ("the share of", "the fraction of"),
    ("The share of", "The fraction of"),
    ("is told by", "is reported by"),
    ("is asked", "is read, tested or evaluated"),
    ("are asked", "are read, tested or evaluated"),
    ("was asked", "was chosen or given"),
    ("were asked", "were chosen or given"),
    ("be asked", "be read, tested or evaluated"),
    ("asks for", "needs"),
    ("tells of", "reports"),
    ("less truth", "minus truth"),
    ("Less truth", "Minus truth"),
    ("rms error, share", "rms error"),
    ("light with a size", "area light"),
];

/// Findings of one source file.
pub fn words(file: &str, text: &str) -> Vec<String> {
    let mut findings = Vec::new();
    for (index, line) in text.lines().enumerate() {
        // In code the same letters would be names.
        let said = line.find("//").into_iter().chain(line.find('"')).min().map_or("", |at| &line[at..]);
        if NAMES.iter().any(|name| said.contains(name)) {
            continue;
        }
        for (word, meant) in WORDS.into_iter().filter(|(word, _)| stands(said, word)) {
            findings.push(format!("{file}:{}: {word:?} should be {meant:?}", index + 1));
        }
    }
    findings
}

fn stands(line: &str, word: &str) -> bool {
    line.match_indices(word).any(|(at, _)| {
        let before = line[..at].chars().next_back().is_some_and(char::is_alphanumeric);
        let after = line[at + word.len()..].chars().next().is_some_and(char::is_alphanumeric);
        !before && !after
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_found_in_comments_and_messages() {
        let file = "crates/umbrage-plane/src/a.rs";
        let wanted = [format!("{file}:1: \"depth a texel\" should be \"per texel\"")];
        for line in ["/// One depth a texel.", "let x = 1; // one depth a texel", "    \"one depth a texel, or none\""]
        {
            assert_eq!(words(file, line), wanted, "{line}");
        }
        for line in ["depth a texel", "/// One depth per texel.", "/// In depth a texels' mean"] {
            assert!(words(file, line).is_empty(), "{line}");
        }
        let measure = r#"Measure::info("16 exact rays a pixel: error, mean of all scenes", sixteen, "rms")"#;
        assert!(words(file, measure).is_empty());
    }
}
