use crate::error::Fault;
use crate::shadow_map::{FACETS_SIGNATURE, Head, digest, value};

/// What follows the signature in the first line of the text.
const VERSION: &str = " 1";

/// What the part of the facets says of its words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Description {
    /// Samples along a refined texel's side.
    pub fine: u32,
    /// Slots of a link.
    pub slots: u32,
    /// How many of the part's words are the map's; behind them its last row is filled up.
    pub words: usize,
    /// Of all this, the words and what the part of the depths says before its own.
    pub digest: u64,
}

impl Description {
    pub fn of(head: Head<'_>, fine: u32, slots: u32, words: &[u32]) -> Self {
        let digest = digest(head, [fine, slots].iter().chain(words).copied());
        Self { fine, slots, words: words.len(), digest }
    }

    /// As lines of `name=value`.
    pub fn text(self) -> String {
        let Self { fine, slots, words, digest } = self;
        format!("{FACETS_SIGNATURE}{VERSION}\nfine={fine}\nslots={slots}\nwords={words}\ndigest={digest:016x}\n")
    }

    /// From such lines.
    pub fn parse(text: Option<&str>) -> Result<Self, Fault> {
        let signature = format!("{FACETS_SIGNATURE}{VERSION}");
        let lines = text.and_then(|text| text.strip_prefix(&signature)?.strip_prefix('\n'));
        let lines = lines.ok_or_else(|| {
            let first = text.and_then(|text| text.lines().next()).unwrap_or("missing");
            Fault::new("comments", first, format!("does not begin with {signature:?}"))
        })?;
        Ok(Self {
            fine: line(lines, "fine", |value| value.parse().ok())?,
            slots: line(lines, "slots", |value| value.parse().ok())?,
            words: line(lines, "words", |value| value.parse().ok())?,
            digest: line(lines, "digest", |value| u64::from_str_radix(value, 16).ok())?,
        })
    }
}

fn line<T>(lines: &str, name: &str, parse: impl Fn(&str) -> Option<T>) -> Result<T, Fault> {
    let value = value(lines, name);
    let number = value.and_then(parse);
    number.ok_or_else(|| Fault::new(format!("comments: {name}"), value.unwrap_or("missing"), "not a whole number"))
}
