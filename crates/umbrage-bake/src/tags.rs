use crate::Casting;
use crate::masks::Masks;
use crate::pass1::{BY_WINDING, Pass};
use glam::UVec2;
use rayon::prelude::*;
use umbrage_depth::{ROW, Reduction, TagMap};
use umbrage_plane::{Facet, TexelRect, View};
use umbrage_raster::{BIN, Bins, Cull};

/// The nearest key and its object; of several objects at one key the smallest id, so that no order shows.
struct Nearest;

impl Reduction for Nearest {
    type Cell = (f32, u32);
    type Row = [(f32, u32); ROW];
    const EMPTY: (f32, u32) = (f32::INFINITY, u32::MAX);

    #[inline(always)]
    fn add(&self, _pass: u32, cell: &mut (f32, u32), key: f32, _front: bool, facet: &Facet) {
        if key < cell.0 || (key == cell.0 && facet.object < cell.1) {
            *cell = (key, facet.object);
        }
    }
}

/// Pass 1 of the baseline by object tags: the id of the nearest object of each texel (Wang & Molnar 1994).
pub fn bake_tags<'a>(view: &View, casters: impl IntoIterator<Item: Into<Casting<'a>>>) -> TagMap {
    let mut masks = Masks::new(view);
    let geometry = casters.into_iter().map(|casters| masks.note(casters));
    let bins = Bins::new(view, TexelRect::of_size(view.size()), Cull::None, geometry);
    let grid = bins.tiles();
    let pass = Pass { view, fine: view, rule: &Nearest, masks: &masks, front: BY_WINDING };
    let tiles: Vec<_> = (0..grid.x * grid.y)
        .into_par_iter()
        .map(|index| pass.cells(&bins, UVec2::new(index % grid.x, index / grid.x)).0)
        .collect();
    let id = |texel: glam::IVec2| {
        let (tile, at) = (texel.as_uvec2() / BIN, texel.as_uvec2() % BIN);
        let (key, object) = tiles[(tile.y * grid.x + tile.x) as usize].as_ref()?[(at.y * BIN + at.x) as usize];
        (key < f32::INFINITY).then_some(object)
    };
    TagMap::new(*view, TexelRect::of_size(view.size()).texels().map(id))
}
