use super::lru::Lru;
use crate::error::{Fault, IoError};
use crate::file::open_regular;
use crate::shadow_map::{Layout, Nearest, Parts, Preface, flat, only};
use exr::meta::MetaData;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use umbrage_depth::MapError;
use umbrage_depth::Stored;
use umbrage_plane::{TexelRect, View};

/// Most tiles of a file: their table and directory take 12 bytes each.
const MOST_TILES: u64 = 1 << 22;

/// Values from here on mean that no surface was seen.
const NO_SURFACE: f32 = 1e30;

/// A tile's depths, row by row, once they are read; empty when they could not be.
pub(super) type Page = Arc<OnceLock<Box<[f32]>>>;

/// The file and the pages that are kept of it.
#[derive(Debug)]
pub(super) struct Pager {
    path: PathBuf,
    file: Mutex<File>,
    /// Of the file, when it was opened.
    length: u64,
    meta: MetaData,
    pub(super) layout: Layout,
    /// Outside of it no surface was seen, whatever the file holds there.
    seen: TexelRect,
    nearest: Nearest,
    offsets: Vec<u64>,
    /// A page is in its slot before it is read, so that nobody else reads it and readers of other pages need not wait.
    pages: Mutex<Lru<Page>>,
    faults: AtomicU64,
    error: OnceLock<IoError>,
}

impl Pager {
    pub(super) fn open(path: &Path, pages: usize) -> Result<(Self, View, Stored), IoError> {
        if pages == 0 {
            return Err(Fault::new("pages", pages, "one must be kept at least").in_file(path));
        }
        let (file, length) = open_regular(path)?;
        let parts = Parts::read(BufReader::new(&file), length, MOST_TILES).map_err(|fault| fault.in_file(path))?;
        let preface = only(&parts).and_then(|map| flat(&parts, map.part, None, None, u64::MAX, None));
        let preface = preface.map_err(|fault| fault.in_file(path))?;
        let offsets = preface.offsets().to_vec();
        let Preface { view, stored, digest, layout, seen, .. } = preface;
        if !layout.is_tiled() {
            return Err(Fault::new("tiles", "missing", "scan lines cannot be paged").in_file(path));
        }
        let pager = Self {
            path: path.to_path_buf(),
            file: Mutex::new(file),
            length,
            meta: parts.meta,
            pages: Mutex::new(Lru::new(layout.count(), pages)),
            layout,
            seen,
            nearest: Nearest::of(&view, digest),
            offsets,
            faults: AtomicU64::new(0),
            error: OnceLock::new(),
        };
        Ok((pager, view, stored))
    }

    /// A tile's page, which is read when it was not kept. After the first error nothing is read.
    pub(super) fn page(&self, tile: usize) -> Page {
        let page = Arc::clone(held(&self.pages).get_or_make(tile, Arc::default));
        let read = || match self.error() {
            None => self.read(tile).unwrap_or_else(|fault| {
                // Only the first one counts; another thread may have been faster.
                let _ = self.error.set(fault.in_file(&self.path));
                Box::default()
            }),
            Some(_) => Box::default(),
        };
        page.get_or_init(read);
        page
    }

    pub(super) fn error(&self) -> Option<&IoError> {
        self.error.get()
    }

    /// Tiles read so far.
    pub(super) fn faults(&self) -> u64 {
        self.faults.load(Ordering::Relaxed)
    }

    /// Bytes held to find blocks and pages.
    pub(super) fn directory_bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(self.offsets.as_slice()) + 4 * self.offsets.len()
    }

    /// Pages that are kept, and the bytes of their depths.
    pub(super) fn resident(&self) -> (usize, usize) {
        let pages = held(&self.pages);
        let bytes = |page: &Page| page.get().map_or(0, |depths| size_of_val(depths.as_ref()));
        (pages.values().len(), pages.values().map(bytes).sum())
    }

    fn read(&self, tile: usize) -> Result<Box<[f32]>, Fault> {
        self.faults.fetch_add(1, Ordering::Relaxed);
        let offset = self.offsets[tile];
        let bytes = self.bytes(offset, self.layout.most_bytes(tile));
        let bytes = bytes.map_err(|error| Fault::new(self.layout.name(tile, offset), "unreadable", error))?;
        let samples = self.layout.samples(&self.meta, &bytes, tile, offset)?;
        let area = self.layout.area(tile);
        let values = samples.as_chunks::<4>().0.iter().map(|sample| f32::from_ne_bytes(*sample));
        // Nearly all tiles are good and seen all over, and are known to be without a look at each texel's place.
        let bad = |value: f32| value.is_nan() || value == f32::NEG_INFINITY || self.nearest.refuses(value);
        if self.seen.intersect(area) == area && !values.clone().fold(false, |any, value| any | bad(value)) {
            let depth = |value| if value < NO_SURFACE { self.nearest.seen(value) } else { f32::INFINITY };
            return Ok(values.map(depth).collect());
        }
        let depths = area.texels().zip(values).map(|(texel, value)| {
            if !self.seen.contains(texel) {
                return Ok(f32::INFINITY);
            }
            if value.is_nan() || value == f32::NEG_INFINITY {
                return Err(Fault::new(
                    self.layout.name(tile, offset),
                    "no depths",
                    MapError::NotADepth { texel, value },
                ));
            }
            let name = || format!("channel Z at texel {}, {}", texel.x, texel.y);
            let value = self.nearest.check(value, name)?;
            Ok(if value < NO_SURFACE { value } else { f32::INFINITY })
        });
        depths.collect()
    }

    /// What the file holds from `offset` on; less than `most` bytes where it ends before.
    fn bytes(&self, offset: u64, most: usize) -> io::Result<Vec<u8>> {
        let most = (self.length - offset).min(most as u64);
        let mut bytes = Vec::new();
        bytes.try_reserve_exact(most as usize).map_err(io::Error::other)?;
        let mut file = held(&self.file);
        file.seek(SeekFrom::Start(offset))?;
        (&mut *file).take(most).read_to_end(&mut bytes)?;
        Ok(bytes)
    }
}

/// The lock. Nothing that may panic is done while one is held, so that whatever is behind it is whole.
fn held<T>(lock: &Mutex<T>) -> MutexGuard<'_, T> {
    lock.lock().unwrap_or_else(PoisonError::into_inner)
}
