//! Triangles taken so many at a time, in memory that is used again.

use crate::Caster;
use crate::masks::Masks;
use umbrage_plane::{TexelRect, View};
use umbrage_raster::{Bins, Cull};

/// Sorts so many triangles at a time into tiles, and calls `each` with their bins and masks, and with true for the last; once at least.
pub(crate) fn each_chunk<'a>(
    view: &View,
    window: TexelRect,
    cull: Cull,
    most: usize,
    casters: impl IntoIterator<Item: Into<Caster<'a>>>,
    mut each: impl FnMut(&Bins, &Masks<'a>, bool),
) {
    let mut casters = casters.into_iter().fuse().peekable();
    let (mut masks, mut drawn) = (Masks::new(view), None);
    loop {
        masks.advance();
        let triangles = casters.by_ref().take(most.max(1)).map(|caster| masks.note(caster.into()));
        let bins = match &mut drawn {
            None => drawn.insert(Bins::new(view, window, cull, triangles)),
            Some(bins) => {
                bins.refill(triangles);
                bins
            }
        };
        let last = casters.peek().is_none();
        each(bins, &masks, last);
        if last {
            return;
        }
    }
}
