//! Which parts of a file are maps.

use super::channel;
use super::parts::Parts;
use super::words::is_words;
use crate::error::Fault;

/// A map in a file.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    /// Its part, which has its depths.
    pub part: usize,
    /// The part that has its facets.
    pub words: Option<usize>,
    /// What its part is called.
    pub name: String,
}

/// The maps of a file, in its order, and the names of parts that are none. `channel` is what depths are called, where that is known.
pub(crate) fn found(parts: &Parts, channel: Option<&str>) -> Result<(Vec<Found>, Vec<String>), Fault> {
    let (mut maps, mut words, mut others) = (Vec::new(), Vec::new(), Vec::new());
    for part in 0..parts.count() {
        let (header, name) = (parts.header(part), parts.name(part));
        if parts.count() > 1 && is_words(header) {
            words.push((part, name));
        } else if parts.count() == 1 || channel::place(header, channel).is_some() {
            // What is wrong with the only part is said when it is read.
            maps.push(Found { part, words: None, name });
        } else {
            others.push(name);
        }
    }
    if maps.is_empty() && words.is_empty() {
        let problem = format!("no channel {} in any of them", channel.unwrap_or("Z"));
        return Err(Fault::new("parts", others.join(", "), problem));
    }
    for (part, name) in words {
        let only = maps.len() == 1;
        let owns = |map: &&mut Found| map.words.is_none() && (only || name == facets_of(&map.name));
        match maps.iter_mut().find(owns) {
            Some(map) => map.words = Some(part),
            None => return Err(Fault::new("parts", name, "facets of a map that is not there")),
        }
    }
    Ok((maps, others))
}

/// The only map of a file.
pub(crate) fn only(parts: &Parts) -> Result<Found, Fault> {
    let (mut maps, _) = found(parts, None)?;
    match maps.pop() {
        Some(map) if maps.is_empty() => Ok(map),
        last => {
            maps.extend(last);
            let names = maps.iter().map(|map| map.name.as_str()).collect::<Vec<_>>().join(", ");
            Err(Fault::new("parts", names, "one map is wanted, and the file has several"))
        }
    }
}

/// What the part of a map's facets is called in a file of several maps.
pub(crate) fn facets_of(map: &str) -> String {
    format!("{map}.facets")
}
