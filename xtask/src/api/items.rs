//! The items of a crate's modules, each with the lines that describe it.

use super::text::text;
use anyhow::Context as _;
use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// What an item is to the crate's users.
#[derive(Debug)]
pub enum Kind {
    /// A `use`, with the names that it brings, as they are called where they are from.
    Uses(Vec<String>),
    /// Something with a name of its own.
    Defined,
    /// An `impl`; its name is the type's.
    Impl,
    /// A macro that is called beside items.
    Call,
}

/// An item, or what one `impl` gives.
#[derive(Debug)]
pub struct Item {
    pub kind: Kind,
    pub name: String,
    /// The modules above it.
    pub path: Vec<String>,
    pub is_public: bool,
    /// Whether all modules above it are public.
    pub is_exported: bool,
    pub lines: Vec<String>,
}

impl Item {
    /// Whether whoever uses the crate can name it where it stands.
    pub fn given_on(&self) -> bool {
        self.is_public && self.is_exported
    }
}

/// All items of a crate, from its `lib.rs` on.
pub fn of_crate(read: &dyn Fn(&str) -> Option<String>) -> anyhow::Result<Vec<Item>> {
    let mut all = Vec::new();
    let root = read("lib.rs").context("there is no lib.rs")?;
    module(&tokens(&root, "lib.rs")?, &[], true, read, &mut all)?;
    Ok(all)
}

fn tokens(source: &str, file: &str) -> anyhow::Result<Vec<TokenTree>> {
    let tokens: TokenStream = source.parse().map_err(|fault| anyhow::anyhow!("{file}: {fault}"))?;
    Ok(tokens.into_iter().collect())
}

fn is(token: Option<&TokenTree>, word: &str) -> bool {
    match token {
        Some(TokenTree::Ident(name)) => name == word,
        Some(TokenTree::Punct(sign)) => word.len() == 1 && word.starts_with(sign.as_char()),
        _ => false,
    }
}

fn braces(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace)
}

/// One item's tokens: what stands before its keyword, and from the keyword on to where the item ends.
struct Raw<'a> {
    attributes: Vec<String>,
    is_public: bool,
    tokens: &'a [TokenTree],
}

/// The items of one level, without those of tests and those that documentation hides.
fn split(tokens: &[TokenTree]) -> Vec<Raw<'_>> {
    let mut items = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let mut attributes = Vec::new();
        while is(tokens.get(at), "#") {
            at += if is(tokens.get(at + 1), "!") { 2 } else { 1 };
            attributes.push(text(&tokens[at..=at]));
            at += 1;
        }
        let mut is_public = false;
        if is(tokens.get(at), "pub") {
            at += 1;
            is_public = true;
            if let Some(TokenTree::Group(group)) = tokens.get(at)
                && group.delimiter() == Delimiter::Parenthesis
            {
                is_public = false;
                at += 1;
            }
        }
        let from = at;
        // Bodies end items, but not where a value or a list of names follows the keyword.
        let value = is(tokens.get(at), "use")
            || is(tokens.get(at), "static")
            || is(tokens.get(at), "type")
            || (is(tokens.get(at), "const") && !is(tokens.get(at + 1), "fn"));
        while at < tokens.len() && !is(tokens.get(at), ";") && (value || !braces(&tokens[at])) {
            at += 1;
        }
        // The end belongs to the item; what a macro's call in parentheses leaves behind is a single sign.
        at = (at + 1).min(tokens.len());
        let hidden = attributes.iter().any(|one| one == "[cfg(test)]" || one == "[doc(hidden)]");
        if at > from + 1 && !hidden {
            items.push(Raw { attributes, is_public, tokens: &tokens[from..at] });
        }
    }
    items
}

fn module(
    tokens: &[TokenTree],
    path: &[String],
    is_exported: bool,
    read: &dyn Fn(&str) -> Option<String>,
    all: &mut Vec<Item>,
) -> anyhow::Result<()> {
    for raw in split(tokens) {
        let second = raw.tokens.get(1).map(ToString::to_string).unwrap_or_default();
        let mut item = |kind, name: String, lines| {
            all.push(Item { kind, name, path: path.to_vec(), is_public: raw.is_public, is_exported, lines });
        };
        match raw.tokens[0].to_string().as_str() {
            "mod" => {
                item(Kind::Defined, second.clone(), vec![format!("pub mod {second}")]);
                let below: Vec<String> = path.iter().cloned().chain([second.clone()]).collect();
                let open = is_exported && raw.is_public;
                if let Some(TokenTree::Group(body)) = raw.tokens.get(2) {
                    let body: Vec<TokenTree> = body.stream().into_iter().collect();
                    module(&body, &below, open, read, all)?;
                } else {
                    let files = [format!("{}.rs", below.join("/")), format!("{}/mod.rs", below.join("/"))];
                    let found = files.iter().find_map(|file| Some((file, read(file)?)));
                    let (file, source) = found.with_context(|| format!("there is no {}", files[0]))?;
                    module(&self::tokens(&source, file)?, &below, open, read, all)?;
                }
            }
            "use" => {
                let line = format!("pub {}", text(without_end(raw.tokens)));
                item(Kind::Uses(names(raw.tokens)), String::new(), vec![line]);
            }
            "impl" => {
                let (name, lines) = given(&raw);
                item(Kind::Impl, name, lines);
            }
            "macro_rules" => {}
            _ if is_call(raw.tokens) => item(Kind::Call, String::new(), vec![text(without_end(raw.tokens))]),
            _ => {
                let (name, lines) = defined(&raw);
                item(Kind::Defined, name, lines);
            }
        }
    }
    Ok(())
}

/// A path with `!` and a group.
fn is_call(tokens: &[TokenTree]) -> bool {
    let sign = tokens.iter().position(|token| is(Some(token), "!"));
    sign.is_some_and(|sign| {
        tokens[..sign].iter().all(|token| matches!(token, TokenTree::Ident(_)) || is(Some(token), ":"))
    })
}

fn without_end(tokens: &[TokenTree]) -> &[TokenTree] {
    if is(tokens.last(), ";") { &tokens[..tokens.len() - 1] } else { tokens }
}

/// The names at the ends of a `use`, as they are called where they are from.
fn names(tokens: &[TokenTree]) -> Vec<String> {
    let mut names = Vec::new();
    let mut last: Option<String> = None;
    let mut renamed = false;
    for token in tokens {
        match token {
            TokenTree::Ident(word) if word == "as" => renamed = true,
            TokenTree::Ident(_) if renamed => {}
            TokenTree::Ident(word) => last = Some(word.to_string()),
            TokenTree::Punct(sign) if sign.as_char() == ',' => {
                names.extend(last.take());
                renamed = false;
            }
            TokenTree::Group(group) => {
                last = None;
                names.extend(self::names(&group.stream().into_iter().collect::<Vec<_>>()));
            }
            _ => {}
        }
    }
    names.extend(last);
    names
}

/// Attributes that users of an item meet.
fn shown(attributes: &[String]) -> String {
    let met = |one: &&String| {
        ["[derive(", "[cfg(", "[non_exhaustive", "[must_use"].iter().any(|begin| one.starts_with(begin))
    };
    attributes.iter().filter(met).flat_map(|one| ["#", one, " "]).collect()
}

/// A function, type, trait, constant: its name, and its lines.
fn defined(raw: &Raw<'_>) -> (String, Vec<String>) {
    const BEFORE: [&str; 6] = ["const", "fn", "struct", "enum", "trait", "unsafe"];
    let name = raw
        .tokens
        .iter()
        .skip(1)
        .find(|token| matches!(token, TokenTree::Ident(word) if !BEFORE.contains(&word.to_string().as_str())));
    let name = name.map(ToString::to_string).unwrap_or_default();
    let head = format!("{}pub ", shown(&raw.attributes));
    let body = match raw.tokens.last() {
        Some(TokenTree::Group(body)) if body.delimiter() == Delimiter::Brace => {
            Some(body.stream().into_iter().collect::<Vec<_>>())
        }
        _ => None,
    };
    let end = if body.is_some() { raw.tokens.len() - 1 } else { raw.tokens.len() };
    let front = &raw.tokens[..end];
    let lines = match (raw.tokens[0].to_string().as_str(), body) {
        ("struct", Some(body)) => vec![format!("{head}{} {{ {} }}", text(front), fields(&body))],
        ("enum", Some(body)) => {
            vec![format!("{head}{} {{ {} }}", text(front), text(&bare(&body)).trim_end_matches(','))]
        }
        ("trait", Some(body)) => {
            let members = split(&body).into_iter().map(|member| {
                let has_body = member.tokens.last().is_some_and(braces);
                format!("trait {name}: {}{}", signature(member.tokens), if has_body { " { .. }" } else { "" })
            });
            [format!("{head}{}", text(front))].into_iter().chain(members).collect()
        }
        ("struct", None) => vec![format!("{head}{}", text(&bare(without_end(front))))],
        _ => vec![format!("{head}{}", signature(raw.tokens))],
    };
    (name, lines)
}

/// A function without its body, a constant without its value.
fn signature(tokens: &[TokenTree]) -> String {
    let is_value = is(tokens.first(), "static") || (is(tokens.first(), "const") && !is(tokens.get(1), "fn"));
    let end = if is_value { tokens.iter().position(|token| is(Some(token), "=")) } else { None };
    let end = end.unwrap_or_else(|| {
        let last = tokens.last().is_some_and(|token| braces(token) || is(Some(token), ";"));
        tokens.len() - usize::from(last)
    });
    text(&tokens[..end])
}

/// Public fields of a struct with names; two dots stand for the others.
fn fields(body: &[TokenTree]) -> String {
    let mut shown = Vec::new();
    let mut hides = false;
    let mut depth = 0;
    let at_comma = |token: &TokenTree, depth: &mut i32| {
        if let TokenTree::Punct(sign) = token {
            match sign.as_char() {
                '<' => *depth += 1,
                '>' => *depth -= 1,
                ',' => return *depth == 0,
                _ => {}
            }
        }
        false
    };
    for field in body.split(|token| at_comma(token, &mut depth)).filter(|field| !field.is_empty()) {
        let field = bare(field);
        let near = matches!(field.get(1), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis);
        if is(field.first(), "pub") && !near { shown.push(text(&field)) } else { hides = !field.is_empty() || hides }
    }
    if hides {
        shown.push("..".into());
    }
    shown.join(", ")
}

/// Tokens without attributes, at any depth.
fn bare(tokens: &[TokenTree]) -> Vec<TokenTree> {
    let mut out: Vec<TokenTree> = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        if is(tokens.get(at), "#") {
            at += 2;
            continue;
        }
        out.push(match &tokens[at] {
            TokenTree::Group(group) => {
                let inner = bare(&group.stream().into_iter().collect::<Vec<_>>());
                proc_macro2::Group::new(group.delimiter(), inner.into_iter().collect()).into()
            }
            other => other.clone(),
        });
        at += 1;
    }
    out
}

/// What an `impl` gives: the type's name, and a line for the trait, or for each public member.
fn given(raw: &Raw<'_>) -> (String, Vec<String>) {
    let end = raw.tokens.len() - 1;
    let front = &raw.tokens[..end];
    let mut depth = 0;
    let mut of = 1;
    let mut is_trait = false;
    let mut stop = end;
    for (at, token) in front.iter().enumerate() {
        match token {
            TokenTree::Punct(sign) if sign.as_char() == '<' => depth += 1,
            // The arrow of a function type is no bracket.
            TokenTree::Punct(sign)
                if sign.as_char() == '>' && !is(at.checked_sub(1).and_then(|at| front.get(at)), "-") =>
            {
                depth -= 1;
                // Behind the parameters of the `impl` itself.
                if depth == 0 && of == 1 && !is_trait && is(front.get(1), "<") {
                    of = at + 1;
                }
            }
            TokenTree::Ident(word) if depth == 0 && word == "for" => (is_trait, of) = (true, at + 1),
            TokenTree::Ident(word) if depth == 0 && word == "where" => stop = stop.min(at),
            _ => {}
        }
    }
    let mut name = String::new();
    for token in &front[of.min(stop)..stop] {
        match token {
            TokenTree::Ident(word) => name = word.to_string(),
            TokenTree::Punct(sign) if sign.as_char() == '<' => break,
            _ => {}
        }
    }
    let head = format!("{}{}", shown(&raw.attributes), text(front));
    let lines = match raw.tokens.last() {
        Some(TokenTree::Group(body)) if !is_trait => {
            let body: Vec<TokenTree> = body.stream().into_iter().collect();
            let members = split(&body);
            let public = members.iter().filter(|member| member.is_public);
            public
                .map(|member| format!("{head}: {}pub {}", shown(&member.attributes), signature(member.tokens)))
                .collect()
        }
        _ => vec![head],
    };
    (name, lines)
}
