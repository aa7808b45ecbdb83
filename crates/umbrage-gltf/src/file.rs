//! A file whose version, extensions and buffers were looked at.

use crate::budget::Budget;
use crate::error::quoted;
use crate::json::At;
use crate::note::{Level, Notes};
use crate::{GltfError, Note, uri};
use serde_json::Value;
use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use umbrage_scene::Texture;

/// Extensions that are read.
const READ: [&str; 4] =
    ["EXT_mesh_gpu_instancing", "KHR_lights_punctual", "KHR_mesh_quantization", "KHR_texture_transform"];
/// How the names of extensions begin that change shading only.
const SHADING: &str = "KHR_materials_";

/// All that the other modules read from.
#[derive(Debug)]
pub(crate) struct File<'a> {
    /// The document.
    pub root: At<'a>,
    /// What may still be allocated.
    pub budget: Budget,
    /// The bytes of each buffer; `None` for one that names no source.
    pub buffers: Vec<Option<Cow<'a, [u8]>>>,
    /// Whether positions may be other than floats.
    pub quantised: bool,
    /// Where the files lie that the scene names.
    pub folder: Option<&'a Path>,
    /// Textures by their numbers, once they were read.
    pub textures: RefCell<BTreeMap<usize, Arc<Texture>>>,
    notes: RefCell<Notes>,
}

impl<'a> File<'a> {
    /// Looks at a document. `bin` is the buffer of a binary container.
    pub fn open(
        document: &'a Value,
        bin: Option<&'a [u8]>,
        folder: Option<&'a Path>,
        budget: Budget,
    ) -> Result<Self, GltfError> {
        let root = At::root(document);
        version(&root)?;
        let mut notes = Notes::default();
        extensions(&root, &mut notes)?;
        let used = root.list("extensionsUsed")?.iter().chain(root.list("extensionsRequired")?);
        let quantised = used.into_iter().any(|name| name == "KHR_mesh_quantization");
        let mut buffers = Vec::new();
        for (index, buffer) in root.items("buffers")?.iter().enumerate() {
            buffers.push(load(buffer, bin.filter(|_| index == 0), folder, &budget)?);
        }
        let (textures, notes) = (RefCell::default(), RefCell::new(notes));
        Ok(Self { root, budget, buffers, quantised, folder, textures, notes })
    }

    /// One of the lists at the document's root.
    pub fn all(&self, list: &str) -> Result<Vec<At<'a>>, GltfError> {
        self.root.items(list)
    }

    /// How many members a list at the document's root has.
    pub fn count(&self, list: &str) -> Result<usize, GltfError> {
        Ok(self.root.list(list)?.len())
    }

    /// A member of a list at the document's root.
    pub fn member(&self, list: &str, index: usize) -> Result<At<'a>, GltfError> {
        match self.root.get(list) {
            Some(all) => all.item(index),
            None => Err(self.root.wrong(list, "an array")),
        }
    }

    /// The bytes of the buffer view that a field `bufferView` names.
    pub fn view_bytes(&self, holder: &At) -> Result<&[u8], GltfError> {
        let views = self.count("bufferViews")?;
        let number = holder.index("bufferView", views, "bufferViews")?;
        let view =
            self.member("bufferViews", number.ok_or_else(|| holder.wrong("bufferView", "a number, or a uri"))?)?;
        let buffer = view.index("buffer", self.buffers.len(), "buffers")?;
        let buffer = buffer.ok_or_else(|| view.wrong("buffer", "a number"))?;
        let data = self.buffers.get(buffer).and_then(Option::as_deref).unwrap_or_default();
        let (offset, length) = (view.size("byteOffset", 0)?, view.size("byteLength", 0)?);
        offset.checked_add(length).and_then(|end| data.get(offset..end)).ok_or_else(|| {
            view.wrong("byteLength", format!("at most the bytes of buffers[{buffer}], {}, behind {offset}", data.len()))
        })
    }

    /// Adds a note.
    pub fn note(&self, level: Level, text: impl Into<String>) {
        self.notes.borrow_mut().add(level, text.into());
    }

    /// Adds a note that holds several times.
    pub fn note_times(&self, level: Level, text: impl Into<String>, times: u64) {
        self.notes.borrow_mut().add_times(level, text.into(), times);
    }

    /// All notes.
    pub fn finish(self) -> Vec<Note> {
        self.notes.into_inner().finish()
    }
}

fn version(root: &At) -> Result<(), GltfError> {
    let asset = root.get("asset").ok_or_else(|| root.wrong("asset", "an object with a version"))?;
    for (name, default) in [("version", None), ("minVersion", Some("2.0"))] {
        let version = asset.text(name)?.or(default).unwrap_or_default();
        if version.split('.').next() != Some("2") {
            return Err(asset.wrong(name, "2.0"));
        }
    }
    Ok(())
}

/// Refuses what is required and not supported; notes what is used and not supported.
fn extensions(root: &At, notes: &mut Notes) -> Result<(), GltfError> {
    let names = |list: &str| {
        let name = |(at, name): (usize, &'_ Value)| match name.as_str() {
            Some(name) => Ok(name.to_owned()),
            None => Err(GltfError::field(format!("{list}[{at}]"), name, "a text")),
        };
        root.list(list)?.iter().enumerate().map(name).collect::<Result<Vec<String>, _>>()
    };
    let known = |name: &str| READ.contains(&name);
    let required = names("extensionsRequired")?;
    for name in &required {
        if !known(name) && !name.starts_with(SHADING) {
            // Quoted by Debug in the message, which is bounded here.
            return Err(GltfError::Extension { name: name.chars().take(60).collect() });
        }
        if name.starts_with(SHADING) {
            notes.add(
                Level::Always,
                format!("the required extension {} changes shading only, and is ignored", quoted(name)),
            );
        }
    }
    for name in names("extensionsUsed")? {
        if !known(&name) && !required.contains(&name) {
            notes.add(Level::Verbose, format!("the extension {} is not supported, and is ignored", quoted(&name)));
        }
    }
    Ok(())
}

fn load<'a>(
    buffer: &At<'a>,
    bin: Option<&'a [u8]>,
    folder: Option<&Path>,
    budget: &Budget,
) -> Result<Option<Cow<'a, [u8]>>, GltfError> {
    let length = buffer.size("byteLength", 0)?;
    let bytes = match (buffer.text("uri")?, bin) {
        (Some(address), _) => Cow::from(uri::fetch(&buffer.path_of("uri"), address, length, folder, budget)?),
        (None, Some(bin)) => Cow::from(bin),
        (None, None) => return Ok(None),
    };
    if bytes.len() < length {
        return Err(buffer.wrong("byteLength", format!("at most the {} bytes that there are", bytes.len())));
    }
    // What lies behind the stated length belongs to nobody.
    Ok(Some(match bytes {
        Cow::Borrowed(bytes) => Cow::Borrowed(bytes.get(..length).unwrap_or(bytes)),
        Cow::Owned(mut bytes) => {
            bytes.truncate(length);
            Cow::Owned(bytes)
        }
    }))
}
