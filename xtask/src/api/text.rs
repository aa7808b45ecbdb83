//! Tokens as a line of text, spaced as people write them.

use proc_macro2::{Delimiter, Spacing, TokenTree};

/// The tokens in one line.
pub fn text(tokens: &[TokenTree]) -> String {
    let mut line = String::new();
    let mut before: Option<Last> = None;
    for (at, token) in tokens.iter().enumerate() {
        let (piece, last) = match token {
            TokenTree::Ident(name) => (name.to_string(), Last::Word),
            TokenTree::Literal(value) => (value.to_string(), Last::Word),
            TokenTree::Punct(sign) => (sign.as_char().to_string(), sign_of(tokens, at)),
            TokenTree::Group(group) => {
                let is_list = before == Some(Last::Close) && group.delimiter() == Delimiter::Brace;
                (grouped(group, is_list), Last::Group(group.delimiter()))
            }
        };
        if before.is_some_and(|before| apart(before, last)) {
            line.push(' ');
        }
        line.push_str(&piece);
        before = Some(last);
    }
    line
}

/// What ends a piece of text, as far as the space behind it depends on it.
#[derive(Clone, Copy, PartialEq)]
enum Last {
    Word,
    Group(Delimiter),
    /// Stands close to both neighbours: `::`, `<`, `&`, `'`, `!`, `.`, `#`.
    Close,
    /// Close to what is before it, apart from what comes: `,`, `:`, `;`.
    Comma,
    /// `>`: as a group's end.
    End,
    /// Apart from both: `=`, `+`, `->`, `|`.
    Between,
    /// The first half of a sign of two halves, apart from what is before it alone.
    Half,
    /// The other half, apart from what comes alone.
    OtherHalf,
}

fn sign_of(tokens: &[TokenTree], at: usize) -> Last {
    let sign = |at: Option<usize>| match at.and_then(|at| tokens.get(at)) {
        Some(TokenTree::Punct(sign)) => Some((sign.as_char(), sign.spacing() == Spacing::Joint)),
        _ => None,
    };
    let (this, joint) = sign(Some(at)).unwrap_or((' ', false));
    let next = sign(Some(at + 1)).filter(|_| joint).map(|(next, _)| next);
    let previous = sign(at.checked_sub(1)).filter(|(_, joint)| *joint).map(|(previous, _)| previous);
    match (this, previous, next) {
        (':', Some(':'), _) | (':', _, Some(':')) | ('.', _, _) => Last::Close,
        ('-' | '=', _, Some('>')) => Last::Half,
        ('>', Some('-' | '='), _) => Last::OtherHalf,
        (',' | ':' | ';', _, _) => Last::Comma,
        ('>', _, _) => Last::End,
        ('=' | '+' | '|' | '*' | '-' | '/', _, _) => Last::Between,
        _ => Last::Close,
    }
}

fn apart(before: Last, this: Last) -> bool {
    use Last::{Between, Close, Comma, End, Group, Half, OtherHalf, Word};
    let between = matches!(before, Comma | Between | OtherHalf) || matches!(this, Between | Half);
    match (before, this) {
        (Half, OtherHalf) | (_, Comma | End | OtherHalf) => false,
        _ if between => true,
        (Close | Half, _) => false,
        (_, Group(Delimiter::Brace)) => true,
        (_, this) => this == Word,
    }
}

/// A group with its signs; the braces of a list of names stand close.
fn grouped(group: &proc_macro2::Group, is_list: bool) -> String {
    let inner = text(&group.stream().into_iter().collect::<Vec<_>>());
    match group.delimiter() {
        // The comma before a bracket on a line of its own; that of a tuple of one is part of it.
        Delimiter::Parenthesis if inner.contains(", ") => format!("({})", inner.trim_end_matches(',')),
        Delimiter::Parenthesis => format!("({inner})"),
        Delimiter::Bracket => format!("[{inner}]"),
        Delimiter::Brace if is_list || inner.is_empty() => format!("{{{}}}", inner.trim_end_matches(',')),
        Delimiter::Brace => format!("{{ {} }}", inner.trim_end_matches(',')),
        Delimiter::None => inner,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_are_spaced_as_they_are_written() {
        for line in [
            "fn seen<'a>(at: &'a str, f: impl Fn(&[u8]) -> Option<u8>) -> &'a str",
            "impl<T: Copy + Send> a::B for Kept<T, 4>",
            "pub use a::{Kept, Shape as Form}",
            "struct A([f32; 3])",
        ] {
            let tokens: proc_macro2::TokenStream = line.parse().unwrap();
            assert_eq!(text(&tokens.into_iter().collect::<Vec<_>>()), line);
        }
    }
}
