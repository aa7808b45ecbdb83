//! Maps of facets as EXR files.
//!
//! Such a file has two parts. The first is what the file of a flat map holds, header and blocks alike: a program that reads shadow maps
//! finds the map's depths there.
//!
//! The second part is named `facets`, in a file of several maps `NAME.facets` beside the part `NAME` of the depths: scan lines, ZIP, one channel `facets` of 32-bit whole numbers (`UINT`). Its data window begins at
//! (0, 0) and is 1024 wide in files of ours; readers take any width up to 32,768. Its rows, from the top, are one stream of words, which the
//! part's `comments` describe in lines of `name=value`:
//!
//! ```text
//! umbrage facets 1
//! fine=4                     samples along a refined texel's side, 1 in maps without refinement
//! slots=16                   slots of a link
//! words=15023                words of the stream; zeros behind them fill the last row
//! digest=0123456789abcdef    64-bit FNV-1a
//! ```
//!
//! The words are those of [`FacetMap::to_words`], whose documentation says what each of them means: tiles of 32 × 32 texels with their tables
//! of planes, packed indices, blocks of samples, and links. Planes are keys over the texels of the display window: −1/ζ in a perspective view
//! and ζ in an orthographic one, where ζ is the axial depth, or the screen depth z_s in views of that kind.
//!
//! The digest is over the lines of the first part's `comments` except `window` and `digest`, each with its line feed, and then `fine`, `slots`
//! and the words, four bytes each, lowest byte first.
//!
//! Reading checks both digests, every word, and that the depths of the first part are those of the facets.

mod text;

use crate::error::{Fault, IoError};
use crate::file::read_bytes;
use crate::shadow_map::{
    About, FACETS, Found, Part, Parts, Preface, WordPart, check_digest, depths, encode_parts, flat, only, part,
    words_part,
};
use crate::write_file::write_bytes;
use std::path::Path;
use text::Description;
use umbrage_depth::{DepthMap, FacetMap, FacetSource, FacetWordsError};
use umbrage_plane::TexelRect;

/// Most texels that [`read_facet_map`] takes: 8192 × 8192. The facets may then take up to 1 GiB, which is 16 bytes per texel.
pub const DEFAULT_FACET_BUDGET: u64 = 1 << 26;

/// Most words of facets for each texel of the budget. Baked maps take no more than ten bytes per texel.
const WORDS_PER_TEXEL: u64 = 4;

/// As many words are always allowed, because the tiles of a small map are larger than the map.
const LEAST_WORDS: u64 = 1 << 20;

/// The file of a map of facets as bytes; the same bytes for the same map.
///
/// # Errors
/// A [`Fault`] when the map could not be read again: its `fine` is above 8, it has more than 256 slots, or its tiles were made for
/// another map. Baked maps can always be read again.
pub fn encode_facet_map(map: &FacetMap) -> Result<Vec<u8>, Fault> {
    encode_parts(&facet_parts(map, About::only(map), FACETS)?)
}

/// A map's part of depths, and that of its facets, which is called `words`.
pub(crate) fn facet_parts<'a>(map: &'a FacetMap, about: About<'a>, words: &str) -> Result<[Part<'a>; 2], Fault> {
    let of_words = || {
        let (head, fine, slots) = (about.head(map), map.fine(), map.slots());
        let all = map.to_words();
        let again = FacetMap::from_words(*map.view(), map.stored(), fine, slots, &all).map_err(fault)?;
        if again != *map {
            return Err(Fault::new("tiles", "other ones", "read again they are not the map's"));
        }
        let comments = Description::of(head, fine, slots, &all).text();
        words_part(words, &comments, all, about.display)
    };
    let of_words = of_words().map_err(|fault| fault.in_part(words))?;
    Ok([part(map, about)?, of_words])
}

/// Writes the file of a map of facets, as a whole or not at all. Programs that read shadow maps find the map's depths in it, and so do
/// [`read_shadow_map`](crate::read_shadow_map) and [`Paged`](crate::Paged).
///
/// # Errors
/// [`IoError`], when the system refuses or [`encode_facet_map`] does.
pub fn write_facet_map(path: &Path, map: &FacetMap) -> Result<(), IoError> {
    write_bytes(path, &encode_facet_map(map).map_err(|fault| fault.in_file(path))?)
}

/// Reads a map of facets: it equals the one that was written, and every look-up of depths, samples and links gives the same bits.
///
/// # Errors
/// [`IoError`]: one line with the file, the field and its value, when the system refuses or the file is damaged, hostile, too large
/// ([`DEFAULT_FACET_BUDGET`]) or no map of facets.
pub fn read_facet_map(path: &Path) -> Result<FacetMap, IoError> {
    read_facet_map_within(path, DEFAULT_FACET_BUDGET)
}

/// As [`read_facet_map`], for maps of at most `most_texels` texels whose facets take at most 16 · `most_texels` bytes, or 4 MiB where that is
/// more.
///
/// # Errors
/// As [`read_facet_map`].
pub fn read_facet_map_within(path: &Path, most_texels: u64) -> Result<FacetMap, IoError> {
    // Stored without loss, a texel takes at most four bytes and so does a word; the rest is headers, offset tables and what a coder adds.
    let most_bytes = most_words(most_texels).saturating_add(most_texels).saturating_mul(5).saturating_add(1 << 20);
    decode_facet_map(&read_bytes(path, most_bytes)?, most_texels).map_err(|fault| fault.in_file(path))
}

/// As [`read_facet_map_within`], from bytes.
///
/// # Errors
/// A [`Fault`], when the bytes are not a map of facets of that size.
pub fn decode_facet_map(bytes: &[u8], most_texels: u64) -> Result<FacetMap, Fault> {
    let parts = Parts::read(bytes, bytes.len() as u64, u64::MAX)?;
    let found = only(&parts)?;
    facets(&flat(&parts, found.part, None, None, most_texels, None)?, &found, bytes, most_texels)
}

/// The map of a part and that of its facets.
pub(crate) fn facets(file: &Preface<'_>, found: &Found, bytes: &[u8], most_texels: u64) -> Result<FacetMap, Fault> {
    let part = found.words.ok_or_else(|| Fault::new("parts", 1, "a map of facets has them in a second one"))?;
    if file.digest.is_none() {
        return Err(Fault::new("comments", "no view", "facets need it in full precision"));
    }
    let depths = depths(file, bytes)?;
    let map = of_words(file, part, bytes, most_words(most_texels));
    let map = map.map_err(|fault| fault.in_part(&file.parts.name(part)))?;
    for (texel, depth) in TexelRect::of_size(file.view.size()).texels().zip(depths) {
        let own = map.depth(texel);
        if own.to_bits() != depth.to_bits() {
            let field = format!("channel Z at texel {}, {}", texel.x, texel.y);
            return Err(Fault::new(field, depth, format!("the facet there is at {own}")));
        }
    }
    Ok(map)
}

/// The map by its words alone, of which there may be so many.
fn of_words(file: &Preface<'_>, part: usize, bytes: &[u8], most: u64) -> Result<FacetMap, Fault> {
    let part = WordPart::new(file.parts, part)?;
    let comments = part.comments();
    let described = Description::parse(comments.as_deref())?;
    let all = part.read(bytes, most)?;
    let words = all
        .get(..described.words)
        .ok_or_else(|| Fault::new("comments: words", described.words, format!("there are only {}", all.len())))?;
    let Description { fine, slots, digest, .. } = described;
    check_digest(Some(digest), Description::of(file.head(), fine, slots, words).digest)?;
    FacetMap::from_words(file.view, file.stored, fine, slots, words).map_err(fault)
}

fn most_words(most_texels: u64) -> u64 {
    most_texels.saturating_mul(WORDS_PER_TEXEL).max(LEAST_WORDS)
}

/// A fault of words as one of the file.
fn fault(error: FacetWordsError) -> Fault {
    Fault::new(error.field, error.value, error.problem)
}
