//! Triangles taken so many at a time, in memory that is used again.

use crate::Casting;
use crate::masks::Masks;
use umbrage_plane::{TexelRect, View};
use umbrage_raster::{Bins, Cull, Geometry};

/// Sorts so many triangles at a time into tiles, and calls `each` with their bins and masks, and with true for the last; once at least.
pub(crate) fn each_chunk<'a>(
    view: &View,
    window: TexelRect,
    cull: Cull,
    most: usize,
    casters: impl IntoIterator<Item: Into<Casting<'a>>>,
    mut each: impl FnMut(&Bins, &Masks<'a>, bool),
) {
    let mut chunks = Chunks { casters: casters.into_iter().map(Into::into).fuse(), next: None };
    let (mut masks, mut drawn) = (Masks::new(view), None);
    loop {
        masks.advance();
        let mut left = most.max(1);
        let geometry = std::iter::from_fn(|| chunks.next(&mut masks, &mut left));
        let bins = match &mut drawn {
            None => drawn.insert(Bins::new(view, window, cull, geometry)),
            Some(bins) => {
                bins.refill(geometry);
                bins
            }
        };
        let last = chunks.is_done();
        each(bins, &masks, last);
        if last {
            return;
        }
    }
}

/// Casters that are taken in chunks.
struct Chunks<'a, I> {
    casters: I,
    /// What has been taken from the iterator, and not yet given.
    next: Option<Casting<'a>>,
}

impl<'a, I: Iterator<Item = Casting<'a>>> Chunks<'a, I> {
    /// Notes the next casters, if there are any, of at most so many triangles, which are subtracted; none where it is 0.
    #[inline(always)]
    fn next(&mut self, masks: &mut Masks<'a>, left: &mut usize) -> Option<Geometry<'a>> {
        if *left == 0 {
            return None;
        }
        // One after the other, as casters that are known to have no mask are then noted without being written to memory.
        if let Some(casting) = self.next.take() {
            return Some(masks.note(self.part(casting, left)));
        }
        let casting = self.casters.next()?;
        Some(masks.note(self.part(casting, left)))
    }

    /// What of it is given now.
    #[inline(always)]
    fn part(&mut self, casting: Casting<'a>, left: &mut usize) -> Casting<'a> {
        match casting {
            Casting::One(caster) => {
                *left -= 1;
                Casting::One(caster)
            }
            Casting::Mesh(mut mesh) => {
                let now = mesh.split_to(*left);
                *left -= now.len();
                self.next = (!mesh.is_empty()).then_some(Casting::Mesh(mesh));
                Casting::Mesh(now)
            }
        }
    }

    /// Whether there are no more.
    fn is_done(&mut self) -> bool {
        if self.next.is_none() {
            self.next = self.casters.next();
        }
        self.next.is_none()
    }
}
