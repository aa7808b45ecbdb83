//! How text and numbers are put into HTML, SVG and CSV.

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
        let (lead, power) = split_power(value);
        format!("{lead} × 10{power}")
    };
    plain.replace('-', "−")
}

/// A number's leading digits, and its power of ten raised.
fn split_power(value: f64) -> (String, String) {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let text = format!("{value:e}");
    let (lead, power) = text.split_once('e').unwrap_or((&text, "0"));
    let raise = |letter: char| letter.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    (lead.into(), power.chars().map(raise).collect())
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
        assert_eq!(short(-0.0, 4), "0");
        assert_eq!(short(f64::NAN, 4), "not a number");
        assert_eq!(short(f64::NEG_INFINITY, 4), "−∞");
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
