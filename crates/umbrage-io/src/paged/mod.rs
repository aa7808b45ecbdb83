//! Maps whose tiles stay in their file until they are looked at (Reeves 1987, §3.3).

mod lru;
mod pager;

use crate::error::IoError;
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::IVec2;
use pager::{Page, Pager};
use std::cell::RefCell;
use std::path::Path;
use std::sync::{Arc, Weak};
use umbrage_depth::{DepthMap, Stored};
use umbrage_plane::{DepthRange, TexelRect, View, floor_texel};

/// A shadow map of which only the tiles looked at last are in memory (Reeves 1987): pages of the file's own tiles, 64×64 texels and
/// 16 KiB in files of ours, the least recently used giving way.
///
/// It answers as the [`Raw`](umbrage_depth::Raw) map of [`read_shadow_map`](crate::read_shadow_map) does, bit for bit, whatever
/// the number of pages and threads. Texels outside the file's data window are +∞ and need no page. Memory: the pages, one more for
/// each thread that looks (its last one, kept until the thread looks at another), 12 bytes per tile for finding them, the header.
///
/// A look-up cannot fail, but a file can: the first tile that cannot be read is reported by [`PagedHandle::error`]. From then on nothing is
/// read and every look-up answers +∞, so that whoever opened the map checks once per bucket and throws the picture away.
///
/// What is checked: at open all that [`read_shadow_map`](crate::read_shadow_map) checks of header and offset table, and all that it
/// checks of a tile when that tile is read. Not the digest: it is over the whole map, and only reading the whole map can tell that
/// depths were replaced by other depths.
///
/// The file is held open. Replacing it by a rename ([`write_atomic`](crate::write_atomic)) or, where the system lets one, removing it
/// changes nothing; writing into it does.
///
/// ```
/// # use glam::{DVec3, IVec2, UVec2};
/// # use umbrage_depth::{DepthMap, Raw};
/// # use umbrage_plane::View;
/// # let lamp = View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::X, 1.0, 0.0, 9.0, UVec2::new(200, 100))?;
/// # let path = std::env::temp_dir().join(format!("umbrage-paged-{}.exr", std::process::id()));
/// let map = Raw::new(lamp, vec![2.5; 200 * 100])?;
/// umbrage_io::write_shadow_map(&path, &map)?;
/// let (paged, handle) = umbrage_io::Paged::open(&path, 3)?;
/// assert_eq!(paged.depth(IVec2::new(150, 70)), 2.5);
/// assert_eq!(paged.depth(IVec2::new(200, 70)), f32::INFINITY);
/// assert_eq!((handle.faults(), handle.resident_pages()), (1, 1));
/// assert!(handle.error().is_none());
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Paged {
    view: View,
    stored: Stored,
    pager: Arc<Pager>,
}

/// What whoever opened a [`Paged`] map keeps of it: its first error and its counters. Clones see the same map.
#[derive(Clone, Debug)]
pub struct PagedHandle {
    pager: Arc<Pager>,
}

impl Paged {
    /// Opens a tiled shadow map of at most 2²² tiles with room for `pages` of them, 1 or more. Header and offset table are read,
    /// no tile.
    ///
    /// # Errors
    /// [`IoError`]: one line with the file, the field and its value, when `pages` is 0, the system refuses, header or offset table are
    /// damaged or hostile, or the file is not a tiled shadow map.
    pub fn open(path: &Path, pages: usize) -> Result<(Self, PagedHandle), IoError> {
        let (pager, view, stored) = Pager::open(path, pages)?;
        let pager = Arc::new(pager);
        Ok((Self { view, stored, pager: Arc::clone(&pager) }, PagedHandle { pager }))
    }

    /// The depths of at most 32 texels; +∞ for those outside `within`. Those of one tile are answered together, so that a footprint
    /// across tiles fetches each of them once.
    fn depths<const N: usize>(&self, within: TexelRect, texels: [IVec2; N]) -> [f32; N] {
        const { assert!(N <= 32, "one bit a texel") };
        let mut depths = [f32::INFINITY; N];
        if self.pager.error().is_some() {
            return depths;
        }
        let within = self.pager.layout.window().intersect(within);
        let inside = |i: usize| u32::from(within.contains(texels[i])) << i;
        let mut left = (0..N).fold(0, |lanes, i| lanes | inside(i));
        LAST.with_borrow_mut(|slot| {
            let mut last = slot.take().filter(|last| last.pager.as_ptr() == Arc::as_ptr(&self.pager));
            while left != 0 {
                if let Some(last) = &last {
                    left = last.answer(left, &texels, &mut depths);
                }
                if left != 0 {
                    last = Some(self.page(texels[left.trailing_zeros() as usize], last));
                }
            }
            *slot = last;
        });
        depths
    }

    /// The page under a texel of the data window, in place of another one of this map.
    fn page(&self, texel: IVec2, last: Option<Last>) -> Last {
        let tile = self.pager.layout.index(texel);
        let (area, page) = (self.pager.layout.area(tile), self.pager.page(tile));
        let pager = last.map_or_else(|| Arc::downgrade(&self.pager), |last| last.pager);
        Last { pager, area, page }
    }
}

thread_local! {
    /// The page that this thread looked at last: nearly every look-up is in the same one as the look-up before, and then needs no
    /// lock. It changes no answer and no count of a single thread, whose last page is always the newest.
    static LAST: RefCell<Option<Last>> = const { RefCell::new(None) };
}

struct Last {
    /// Weak, so that the map may go, while no other can take its address.
    pager: Weak<Pager>,
    area: TexelRect,
    page: Page,
}

impl Last {
    /// Fills in the depths of those texels among `lanes` that lie in this page; the lanes that do not.
    #[inline(always)]
    fn answer<const N: usize>(&self, lanes: u32, texels: &[IVec2; N], depths: &mut [f32; N]) -> u32 {
        let stored = self.page.get().map_or(&[][..], |stored| stored);
        let width = self.area.size().x as usize;
        let mut left = lanes;
        for i in 0..N {
            if lanes & 1 << i != 0 && self.area.contains(texels[i]) {
                let at = (texels[i] - self.area.min).as_uvec2();
                depths[i] = stored.get(at.y as usize * width + at.x as usize).copied().unwrap_or(f32::INFINITY);
                left &= !(1 << i);
            }
        }
        left
    }
}

impl DepthMap for Paged {
    fn view(&self) -> &View {
        &self.view
    }

    fn depth(&self, texel: IVec2) -> f32 {
        self.depths(self.pager.layout.window(), [texel])[0]
    }

    /// Lanes outside `within` are +∞ and cost no page.
    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        let (column, row) = (floor_texel(simd, x), floor_texel(simd, y));
        f32x16::load_array(simd, self.depths(within, std::array::from_fn(|i| IVec2::new(column[i], row[i]))))
    }

    /// Nothing outside the data window, unknown inside: no tile is read to answer this.
    fn range(&self, rect: TexelRect) -> DepthRange {
        if self.pager.layout.window().intersect(rect).is_empty() { DepthRange::NOTHING } else { DepthRange::UNKNOWN }
    }

    fn stored(&self) -> Stored {
        self.stored
    }

    /// Of the pages that are resident now.
    fn bytes(&self) -> usize {
        self.pager.resident().1
    }

    fn allocated(&self) -> usize {
        self.bytes() + self.pager.directory_bytes()
    }
}

impl PagedHandle {
    /// The first error, once a tile could not be read: one line with the file, the tile and the problem. Every look-up that
    /// began later has answered +∞.
    pub fn error(&self) -> Option<&IoError> {
        self.pager.error()
    }

    /// Page faults: how often a tile was read.
    pub fn faults(&self) -> u64 {
        self.pager.faults()
    }

    /// Tiles in memory, those that are just being read included; never more than `pages`. What threads keep of tiles that have given way
    /// is not counted.
    pub fn resident_pages(&self) -> usize {
        self.pager.resident().0
    }
}
