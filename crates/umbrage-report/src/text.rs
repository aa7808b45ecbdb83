//! How text and numbers are put into HTML, SVG and CSV.

use std::fmt::Write as _;

/// Text that HTML and SVG take as text, inside elements and inside double-quoted attributes.
pub fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            other => safe.push(other),
        }
    }
    safe
}

/// Text as it is printed: `1e-3` is 10⁻³, `x^2` is x², `tau` is τ, `N.L` is N·L and `-1` is −1. Recipes and ids such as
/// `epsilon=0.01` and `12-13` stay as they are written. A power that Unicode cannot raise keeps its `^`.
pub fn proper(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let mut out = String::with_capacity(text.len());
    let mut at = 0;
    while let Some(&letter) = letters.get(at) {
        let before = at.checked_sub(1).map(|index| letters[index]);
        let free = before.is_none_or(|one| !one.is_alphanumeric() && !matches!(one, '_' | '.' | '-'));
        let rest = &letters[at..];
        let (set, taken) = match letter {
            '0'..='9' | '-' | '−' if free => number(rest, before).unwrap_or((letter.to_string(), 1)),
            '^' => raised(&power(&rest[1..])).map_or(("^".into(), 1), |power| {
                let taken = 1 + power.chars().count();
                (power, taken)
            }),
            _ if letter.is_ascii_alphabetic() => {
                let length = rest.iter().take_while(|one| one.is_ascii_alphabetic()).count();
                let plain: String = rest[..length].iter().collect();
                let bound =
                    !rest.get(length).is_some_and(|one| one.is_alphanumeric() || matches!(one, '=' | '_' | '-'));
                match greek(&plain) {
                    Some(letter) if free && bound && before != Some(',') => (letter.into(), length),
                    _ if free && rest.starts_with(&['N', '.', 'L']) => ("N·L".into(), 3),
                    _ => (plain, length),
                }
            }
            _ => (letter.to_string(), 1),
        };
        out.push_str(&set);
        at += taken;
    }
    out
}

/// [`proper`] text as HTML; what Unicode cannot raise is raised by markup.
pub fn html(text: &str) -> String {
    let text = proper(text);
    let mut parts = text.split('^');
    let mut out = escape(parts.next().unwrap_or_default());
    for part in parts {
        let letters: Vec<char> = part.chars().collect();
        let power = power(&letters);
        // Writing to a string cannot fail.
        let _ = match part.strip_prefix(power.as_str()) {
            Some(rest) if !power.is_empty() => {
                write!(out, "<sup>{}</sup>{}", escape(&power.replace('-', "−")), escape(rest))
            }
            _ => write!(out, "^{}", escape(part)),
        };
    }
    out
}

/// A number at the start of `text` as it is printed, and how many letters it was; `None` for a hyphen that is not a sign.
fn number(text: &[char], before: Option<char>) -> Option<(String, usize)> {
    let digits = |from: usize| text[from..].iter().take_while(|one| one.is_ascii_digit()).count();
    let point = |at: usize| text.get(at) == Some(&'.') && digits(at + 1) > 0;
    let signed = usize::from(matches!(text[0], '-' | '−'));
    let mut end = signed + digits(signed);
    if point(end) {
        end += 1 + digits(end + 1);
    }
    if end == signed || (signed == 1 && before == Some('=')) {
        return None;
    }
    let lead: String = text[signed..end].iter().collect();
    let sign = if signed == 1 { "−" } else { "" };
    if matches!(text.get(end), Some('e' | 'E')) {
        let negative = text.get(end + 1) == Some(&'-');
        let from = end + 1 + usize::from(matches!(text.get(end + 1), Some('-' | '+')));
        let length = text.get(from..).map_or(0, |_| digits(from));
        let ends = text.get(from + length).is_none_or(|one| !one.is_alphanumeric());
        if length > 0 && ends {
            let digits: String = text[from..from + length].iter().collect();
            let power = if negative { format!("-{digits}") } else { digits };
            return Some((sign.to_string() + &ten(&lead, &power), from + length));
        }
    }
    Some((sign.to_string() + &lead, end))
}

/// What stands behind a `^`: a signed number, or one letter.
fn power(text: &[char]) -> String {
    let signs = usize::from(text.first().is_some_and(|one| matches!(one, '-' | '−' | '+')));
    let is_digit = |one: &&char| one.is_ascii_digit() || matches!(one, '½' | '¼' | '¾' | '⅓' | '⅔');
    let digits = text[signs..].iter().take_while(is_digit).count();
    let letter = usize::from(digits == 0 && text.get(signs).is_some_and(char::is_ascii_alphabetic));
    if digits + letter == 0 { String::new() } else { text[..signs + digits + letter].iter().collect() }
}

/// A whole power in raised letters; `None` where Unicode has none for it.
fn raised(power: &str) -> Option<String> {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |letter: char| match letter {
        '-' | '−' => Some('⁻'),
        '+' => Some('⁺'),
        'n' => Some('ⁿ'),
        other => other.to_digit(10).map(|digit| RAISED[digit as usize]),
    };
    if power.is_empty() { None } else { power.chars().map(raise).collect() }
}

/// A number as a multiple of a power of ten; one times it is the power alone.
fn ten(lead: &str, power: &str) -> String {
    let power = raised(power).unwrap_or_else(|| format!("^{power}"));
    match lead {
        "1" => format!("10{power}"),
        "-1" => format!("−10{power}"),
        _ => format!("{lead} × 10{power}"),
    }
}

/// The letter of a Greek letter's name.
fn greek(name: &str) -> Option<&'static str> {
    const LETTERS: [(&str, &str); 18] = [
        ("alpha", "α"),
        ("beta", "β"),
        ("gamma", "γ"),
        ("delta", "δ"),
        ("epsilon", "ε"),
        ("zeta", "ζ"),
        ("eta", "η"),
        ("theta", "θ"),
        ("lambda", "λ"),
        ("mu", "μ"),
        ("pi", "π"),
        ("rho", "ρ"),
        ("sigma", "σ"),
        ("tau", "τ"),
        ("phi", "φ"),
        ("chi", "χ"),
        ("psi", "ψ"),
        ("omega", "ω"),
    ];
    LETTERS.iter().find(|(known, _)| *known == name).map(|(_, letter)| *letter)
}

/// The value rounded to so many significant digits; NaN, ∞ and 0 as they are.
pub fn rounded(value: f64, digits: usize) -> f64 {
    // The formatter rounds decimals correctly, and its text is always a number.
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

/// A number for people: so many significant digits at most, no trailing zeros, powers of ten only where plain digits would
/// be long.
pub fn short(value: f64, digits: usize) -> String {
    let value = rounded(value, digits);
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return if value.is_nan() {
            "not a number"
        } else if value > 0.0 {
            "∞"
        } else {
            "−∞"
        }
        .into();
    }
    let plain = if (1e-4..1e7).contains(&value.abs()) {
        value.to_string()
    } else {
        let text = format!("{value:e}");
        let (lead, power) = text.split_once('e').unwrap_or((&text, "0"));
        ten(lead, power)
    };
    plain.replace('-', "−")
}

/// A name as part of a file name and of an address: Latin letters and digits stay, anything between them is one hyphen.
pub fn file_stem(name: &str) -> String {
    let words = name.split(|letter: char| !letter.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join("-")
}

/// A field of a CSV row.
pub fn csv_field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.into() }
}

/// So many figures, as people say it.
pub(crate) fn figures(count: usize) -> String {
    format!("{count} figure{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_becomes_text() {
        assert_eq!(escape("<a href=\"x\">'&'"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;");
    }

    #[test]
    fn numbers_are_short_and_say_what_they_are_not() {
        assert_eq!(short(0.123_456_7, 4), "0.1235");
        assert_eq!(short(-2.0, 4), "−2");
        assert_eq!(short(1_048_576.0, 9), "1048576");
        assert_eq!(short(2.5e-7, 4), "2.5 × 10⁻⁷");
        assert_eq!(short(1e-7, 4), "10⁻⁷");
        assert_eq!(short(-1e9, 4), "−10⁹");
        assert_eq!(short(-0.0, 4), "0");
        assert_eq!(short(f64::NAN, 4), "not a number");
        assert_eq!(short(f64::NEG_INFINITY, 4), "−∞");
    }

    #[test]
    fn powers_greek_and_signs_are_set_as_they_are_printed() {
        for (typed, printed) in [
            ("1e-3", "10⁻³"),
            ("an error of 2.5E-7, at most", "an error of 2.5 × 10⁻⁷, at most"),
            ("10^6 units, x^2", "10⁶ units, x²"),
            ("tau = 0.5, sigma", "τ = 0.5, σ"),
            ("N.L below .3", "N·L below .3"),
            ("-6.840", "−6.840"),
            ("from -1 to 2", "from −1 to 2"),
            ("0x1e5, 12-13, D-9, R87-F9", "0x1e5, 12-13, D-9, R87-F9"),
            ("burley,stored=deep,epsilon=0.01,bias=-1", "burley,stored=deep,epsilon=0.01,bias=-1"),
            ("betamax, theta-like", "betamax, theta-like"),
            ("1e, e-3, ^, 2e-", "1e, e-3, ^, 2e-"),
            ("2048², N^−¾", "2048², N^−¾"),
        ] {
            assert_eq!(proper(typed), printed, "{typed}");
            assert_eq!(proper(&proper(typed)), printed, "{typed} twice");
        }
        assert_eq!(html("as N^−¾ across <b>"), "as N<sup>−¾</sup> across &lt;b&gt;");
        assert_eq!(html("a ^ b"), "a ^ b");
    }

    #[test]
    fn rounding_keeps_significant_digits() {
        assert_eq!(rounded(22.944_444_444_4, 9), 22.944_444_4);
        assert!(rounded(f64::NAN, 9).is_nan());
        assert_eq!(rounded(f64::INFINITY, 9), f64::INFINITY);
    }

    #[test]
    fn names_of_files_are_plain() {
        assert_eq!(file_stem("truth: edge on the plane"), "truth-edge-on-the-plane");
        assert_eq!(file_stem("../a/b"), "a-b");
        assert_eq!(file_stem("·"), "");
    }

    #[test]
    fn csv_fields_keep_commas_and_quotes() {
        assert_eq!(csv_field("plain"), "plain");
        assert_eq!(csv_field("a,\"b\""), "\"a,\"\"b\"\"\"");
    }
}
