//! A map's file, row of tiles by row of tiles.

use super::channel::Channel;
use super::file::{Head, start};
use super::write::{About, TILE, tiled};
use super::{Layout, text};
use crate::error::{Fault, IoError, system};
use crate::write_file::{Output, write_in_steps};
use exr::meta::header::Header;
use rayon::prelude::*;
use std::io::SeekFrom;
use std::path::Path;
use umbrage_depth::{Stored, Tile};
use umbrage_plane::{TexelRect, View};

/// Rows of tiles of a map in a row of tiles of a file.
const ROWS: u32 = TILE as u32 / umbrage_depth::TILE;

/// Takes a map's tiles for [`write_shadow_map_by_rows`].
pub struct TileRows<'a> {
    path: &'a Path,
    file: &'a mut dyn Output,
    head: text::Head<'a>,
    header: Header,
    layout: Layout,
    digest: text::Digest,
    /// Rows of the map's tiles that were taken.
    taken: u32,
    /// A row of the file's tiles as far as it was taken, in rows of texels.
    line: Vec<f32>,
    /// Where each finished block of the file is.
    offsets: Vec<u64>,
    position: u64,
}

/// Writes a map's file as a whole or not at all, as [`write_shadow_map`](crate::write_shadow_map) does, without ever holding the map: `fill`
/// gives its rows of tiles one after the other, such as those of a bake in bands. Held are 64 rows of texels and 8 bytes for each 64×64 texels.
///
/// `name` is that of the file's one part, printable and of Latin letters, such as the light's; [`write_shadow_map`](crate::write_shadow_map) gives `shadow`.
/// `fill` may write fewer rows than the map has: the others have no surface. The file holds all texels of the map, also those around the
/// surfaces, which [`write_shadow_map`](crate::write_shadow_map) leaves out; maps that have a surface in each row and column at the edge have
/// the same bytes by both. [`Paged`](crate::Paged) looks it up without ever holding it either.
///
/// ```
/// # use glam::{DVec3, IVec2, UVec2};
/// # use umbrage_depth::{DepthMap, Tile};
/// # use umbrage_plane::View;
/// use umbrage_depth::Stored;
/// use umbrage_io::{Paged, write_shadow_map_by_rows};
///
/// # let lamp = View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::X, 1.0, 0.0, 9.0, UVec2::new(64, 640))?;
/// # let path = std::env::temp_dir().join(format!("umbrage-rows-{}.exr", std::process::id()));
/// // A map of 2 x 20 tiles, each of one depth.
/// write_shadow_map_by_rows(&path, "lamp", &lamp, Stored::First, |rows| {
///     for row in 0..20 {
///         let tile = Tile::new(Box::new([row as f32; 1024]), UVec2::splat(32));
///         rows.push(&[tile, None])?;
///     }
///     Ok(())
/// })?;
/// let (map, _) = Paged::open(&path, 4)?;
/// assert_eq!(map.depth(IVec2::new(31, 639)), 19.0);
/// assert_eq!(map.depth(IVec2::new(32, 639)), f32::INFINITY);
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`IoError`], when the system refuses, the name does not do, or `fill` fails; whatever was there before is still there then.
pub fn write_shadow_map_by_rows<T>(
    path: &Path,
    name: &str,
    view: &View,
    stored: Stored,
    fill: impl FnOnce(&mut TileRows<'_>) -> Result<T, IoError>,
) -> Result<T, IoError> {
    let write = |file: &mut dyn Output| {
        let head = text::Head { view, stored, light_cone: None };
        let mut rows = TileRows::new((path, name), file, head)?;
        let filled = fill(&mut rows)?;
        rows.finish()?;
        Ok(filled)
    };
    write_in_steps(path, write, &|_| Ok(()))
}

impl<'a> TileRows<'a> {
    fn new((path, name): (&'a Path, &str), file: &'a mut dyn Output, head: text::Head<'a>) -> Result<Self, IoError> {
        let window = TexelRect::of_size(head.view.size());
        let about = About { name, light_cone: None, display: head.view.size() };
        let unwritable = |fault: Fault| fault.in_file(path);
        let comments = text::with_digest(head, window, 0);
        let header = tiled(about.header(head.view, &comments, window, &["Z"]).map_err(unwritable)?);
        let layout = Layout::new(&header, None, window, Channel::ONLY).map_err(unwritable)?;
        let mut rows = Self {
            path,
            file,
            head,
            header,
            layout,
            digest: text::Digest::of(head),
            taken: 0,
            line: Vec::new(),
            offsets: Vec::new(),
            position: 0,
        };
        // It is written again in the end, in the same length, with the digest and the blocks' places.
        let (start, _) = rows.start(0)?;
        rows.write(&start)?;
        Ok(rows)
    }

    /// Takes the next row of the map's tiles, as [`Tiled::from_tiles`](umbrage_depth::Tiled::from_tiles) takes them: of a map that is w texels wide
    /// ⌈w/32⌉ tiles from the left.
    ///
    /// # Errors
    /// [`IoError`], when the system refuses, or the row is one too many or of another length.
    pub fn push(&mut self, row: &[Option<Tile>]) -> Result<(), IoError> {
        let grid = self.head.view.size().map(|side| side.div_ceil(umbrage_depth::TILE));
        let fault = |field: &str, value: usize, problem: String| Fault::new(field, value, problem).in_file(self.path);
        if self.taken == grid.y {
            return Err(fault("rows of tiles", grid.y as usize + 1, format!("the map has {}", grid.y)));
        }
        if row.len() != grid.x as usize {
            return Err(fault("tiles of a row", row.len(), format!("the map has {}", grid.x)));
        }
        let side = umbrage_depth::TILE as usize;
        let width = self.head.view.size().x as usize;
        let height = (self.head.view.size().y - self.taken * umbrage_depth::TILE).min(umbrage_depth::TILE) as usize;
        for y in 0..height {
            for (tile, left) in row.iter().zip((0..width).step_by(side)) {
                let columns = side.min(width - left);
                match tile {
                    Some(tile) => self.line.extend(&tile.depths()[y * side..][..columns]),
                    None => self.line.resize(self.line.len() + columns, f32::INFINITY),
                }
            }
        }
        self.taken += 1;
        if self.taken.is_multiple_of(ROWS) || self.taken == grid.y {
            self.pack()?;
        }
        Ok(())
    }

    /// Writes the file's tiles of the line.
    fn pack(&mut self) -> Result<(), IoError> {
        self.digest.add(self.line.iter().map(|depth| depth.to_bits()));
        let width = self.head.view.size().x as usize;
        let first = self.offsets.len();
        let pack = |index: usize| {
            let area = self.layout.area(index);
            let columns = area.min.x as usize..area.max.x as usize;
            let rows = self.line.chunks_exact(width).flat_map(|row| &row[columns.clone()]);
            self.layout.pack(&self.header, index, rows.flat_map(|depth| depth.to_ne_bytes()).collect())
        };
        let blocks: Vec<_> = (first..first + width.div_ceil(TILE)).into_par_iter().map(pack).collect();
        for block in blocks {
            let block = block.map_err(|error| Fault::new("part", "unwritable", error).in_file(self.path))?;
            self.offsets.push(self.position);
            self.write(&block)?;
        }
        self.line.clear();
        Ok(())
    }

    /// Fills what is left of the map, and what could not be known at the start.
    fn finish(mut self) -> Result<(), IoError> {
        let grid = self.head.view.size().map(|side| side.div_ceil(umbrage_depth::TILE));
        let empty = vec![None; grid.x as usize];
        while self.taken < grid.y {
            self.push(&empty)?;
        }
        let (mut start, table) = self.start(self.digest.0)?;
        for (entry, offset) in start[table..].as_chunks_mut::<8>().0.iter_mut().zip(&self.offsets) {
            *entry = offset.to_le_bytes();
        }
        self.file.seek(SeekFrom::Start(0)).map_err(system(self.path, "go back to its start"))?;
        self.write(&start)
    }

    /// What stands before the blocks, and where in it the table of their places begins.
    fn start(&self, digest: u64) -> Result<(Vec<u8>, usize), IoError> {
        let mut header = self.header.clone();
        let comments = text::with_digest(self.head, TexelRect::of_size(self.head.view.size()), digest);
        header.own_attributes.comments = Some(exr::prelude::Text::from(comments.as_str()));
        let head = Head { header: &header, further: None, deep: false };
        start(&[head]).map_err(|fault| fault.in_file(self.path))
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), IoError> {
        self.position += bytes.len() as u64;
        self.file.write_all(bytes).map_err(system(self.path, "write"))
    }
}

impl std::fmt::Debug for TileRows<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TileRows").field("path", &self.path).field("taken", &self.taken).finish_non_exhaustive()
    }
}
