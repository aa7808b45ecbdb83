//! One module's source as tokens: what it declares, defines, imports and names.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use std::collections::BTreeSet;

/// A name that a `use` brings into a module.
#[derive(Debug)]
pub struct Import {
    /// As it is called here; `*` for all of a module's.
    pub name: String,
    /// Where it is from, as written.
    pub path: Vec<String>,
    /// Whether it is given on by `pub`, in whatever measure.
    pub given_on: bool,
    pub line: usize,
}

/// A name in code: one word, or several with `::` between.
#[derive(Debug)]
pub struct Named {
    pub path: Vec<String>,
    pub line: usize,
}

/// What one module's source says, without the modules inside it.
#[derive(Debug, Default)]
pub struct Source {
    /// Modules declared here, those that stand in place with their tokens.
    pub modules: Vec<(String, Option<TokenStream>)>,
    /// What is defined here.
    pub items: BTreeSet<String>,
    pub imports: Vec<Import>,
    pub names: Vec<Named>,
}

impl Source {
    pub fn new(tokens: TokenStream) -> Self {
        let mut source = Self::default();
        source.module(&live(tokens));
        source
    }

    /// The tokens of a module's own level, or of a macro that is called there.
    fn module(&mut self, tokens: &[TokenTree]) {
        let mut at = 0;
        while at < tokens.len() {
            let word = word(tokens, at);
            match (word.as_deref(), tokens.get(at + 1)) {
                (Some("mod"), Some(TokenTree::Ident(name))) => {
                    let body = braces(tokens, at + 2);
                    self.modules.push((name.to_string(), body.map(Group::stream)));
                    at += 3;
                    continue;
                }
                (Some("macro_rules"), _) => {
                    self.items.extend(self::word(tokens, at + 2));
                    if let Some(TokenTree::Group(body)) = tokens.get(at + 3) {
                        self.code(&live(body.stream()));
                    }
                    at += 4;
                    continue;
                }
                (Some("use"), _) => {
                    at = self.import(tokens, at);
                    continue;
                }
                (
                    Some("fn" | "struct" | "enum" | "union" | "trait" | "type" | "const"),
                    Some(TokenTree::Ident(name)),
                ) => {
                    self.items.insert(name.to_string());
                }
                (Some("static"), Some(TokenTree::Ident(name))) => {
                    let name = if name == "mut" { self::word(tokens, at + 2) } else { Some(name.to_string()) };
                    self.items.extend(name);
                }
                _ => {}
            }
            at = match &tokens[at] {
                // A macro that is called here may spell out items.
                TokenTree::Group(group) if at > 0 && punct(tokens, at - 1, '!') => {
                    self.module(&live(group.stream()));
                    at + 1
                }
                _ => self.one(tokens, at),
            };
        }
    }

    /// Tokens inside bodies, types and arguments.
    fn code(&mut self, tokens: &[TokenTree]) {
        let mut at = 0;
        while at < tokens.len() {
            at =
                if word(tokens, at).as_deref() == Some("use") { self.import(tokens, at) } else { self.one(tokens, at) };
        }
    }

    /// A name or a group of code, or a token that is neither; where the next begins.
    fn one(&mut self, tokens: &[TokenTree], at: usize) -> usize {
        match &tokens[at] {
            TokenTree::Group(group) => self.code(&live(group.stream())),
            TokenTree::Ident(first) => {
                let mut path = vec![first.to_string()];
                let mut end = at + 1;
                while colons(tokens, end)
                    && let Some(next) = word(tokens, end + 2)
                {
                    path.push(next);
                    end += 3;
                }
                let member = at > 0 && punct(tokens, at - 1, '.') && !(at > 1 && punct(tokens, at - 2, '.'));
                let lifetime = at > 0 && punct(tokens, at - 1, '\'');
                let inner = at > 1 && colons(tokens, at - 2);
                let field = path.len() == 1 && punct(tokens, end, ':') && !colons(tokens, end);
                if !(member || lifetime || inner || field) {
                    self.names.push(Named { path, line: first.span().start().line });
                }
                return end;
            }
            _ => {}
        }
        at + 1
    }

    /// A `use` with all its names; where the next token begins.
    fn import(&mut self, tokens: &[TokenTree], at: usize) -> usize {
        let in_part = |at: usize| matches!(&tokens[at], TokenTree::Group(g) if g.delimiter() == Delimiter::Parenthesis);
        let visible = if at > 1 && in_part(at - 1) { at - 2 } else { at.saturating_sub(1) };
        let given_on = at > 0 && word(tokens, visible).as_deref() == Some("pub");
        let end = (at..tokens.len()).find(|&i| punct(tokens, i, ';')).unwrap_or(tokens.len());
        self.branches(&tokens[at + 1..end], &[], given_on);
        end + 1
    }

    /// The names of a `use` behind a common beginning.
    fn branches(&mut self, tokens: &[TokenTree], before: &[String], given_on: bool) {
        for branch in tokens.split(|token| matches!(token, TokenTree::Punct(mark) if mark.as_char() == ',')) {
            let mut path = before.to_vec();
            let mut name = None;
            let Some(first) = branch.first() else { continue };
            let line = first.span().start().line;
            // From `::` on, another crate is meant.
            if before.is_empty() && colons(branch, 0) {
                continue;
            }
            let mut words = branch.iter();
            while let Some(token) = words.next() {
                match token {
                    TokenTree::Ident(word) if word == "as" => name = words.next().map(ToString::to_string),
                    TokenTree::Ident(word) if word == "self" && !path.is_empty() => {}
                    TokenTree::Ident(word) => path.push(word.to_string()),
                    TokenTree::Punct(mark) if mark.as_char() == '*' => name = Some("*".into()),
                    TokenTree::Group(group) => {
                        self.branches(&live(group.stream()), &path, given_on);
                        path.clear();
                    }
                    _ => {}
                }
            }
            if let Some(last) = path.last() {
                let name = name.unwrap_or_else(|| last.clone());
                self.imports.push(Import { name, path, given_on, line });
            }
        }
    }
}

fn word(tokens: &[TokenTree], at: usize) -> Option<String> {
    match tokens.get(at) {
        Some(TokenTree::Ident(word)) => Some(word.to_string()),
        _ => None,
    }
}

fn punct(tokens: &[TokenTree], at: usize, wanted: char) -> bool {
    matches!(tokens.get(at), Some(TokenTree::Punct(mark)) if mark.as_char() == wanted)
}

/// Whether `::` stands here.
fn colons(tokens: &[TokenTree], at: usize) -> bool {
    punct(tokens, at, ':') && punct(tokens, at + 1, ':')
}

fn braces(tokens: &[TokenTree], at: usize) -> Option<&Group> {
    match tokens.get(at) {
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace => Some(group),
        _ => None,
    }
}

/// The tokens without attributes, and without what an attribute keeps for tests.
fn live(tokens: TokenStream) -> Vec<TokenTree> {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut live = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while at < tokens.len() {
        let Some((group, next)) = attribute(&tokens, at) else {
            live.push(tokens[at].clone());
            at += 1;
            continue;
        };
        at = next;
        if for_tests(group) {
            while let Some((_, next)) = attribute(&tokens, at) {
                at = next;
            }
            at = item_end(&tokens, at);
        }
    }
    live
}

/// The brackets of an attribute that begins here, and what is behind them.
fn attribute(tokens: &[TokenTree], at: usize) -> Option<(&Group, usize)> {
    if !punct(tokens, at, '#') {
        return None;
    }
    let open = if punct(tokens, at + 1, '!') { at + 2 } else { at + 1 };
    match tokens.get(open) {
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Bracket => Some((group, open + 1)),
        _ => None,
    }
}

/// Whether an attribute is `cfg(test)`, or `cfg(all(test, ..))`.
fn for_tests(attribute: &Group) -> bool {
    fn needs_test(tokens: &[TokenTree]) -> bool {
        tokens.split(|token| matches!(token, TokenTree::Punct(mark) if mark.as_char() == ',')).any(|part| match part {
            [TokenTree::Ident(word)] => word == "test",
            [TokenTree::Ident(word), TokenTree::Group(group)] if word == "all" => {
                needs_test(&group.stream().into_iter().collect::<Vec<_>>())
            }
            _ => false,
        })
    }
    match attribute.stream().into_iter().collect::<Vec<_>>().as_slice() {
        [TokenTree::Ident(word), TokenTree::Group(group)] if word == "cfg" => {
            needs_test(&group.stream().into_iter().collect::<Vec<_>>())
        }
        _ => false,
    }
}

/// Behind the item, field or statement that begins here.
fn item_end(tokens: &[TokenTree], at: usize) -> usize {
    let to_semicolon = tokens[at..]
        .iter()
        .map_while(|token| if let TokenTree::Ident(word) = token { Some(word.to_string()) } else { None })
        .any(|word| ["use", "static", "type", "let"].contains(&word.as_str()))
        || matches!((word(tokens, at).as_deref(), word(tokens, at + 1).as_deref()), (Some("const"), Some(name)) if name != "fn");
    let ends =
        |i: usize| punct(tokens, i, ';') || (!to_semicolon && (braces(tokens, i).is_some() || punct(tokens, i, ',')));
    (at..tokens.len()).find(|&i| ends(i)).map_or(tokens.len(), |end| end + 1)
}
