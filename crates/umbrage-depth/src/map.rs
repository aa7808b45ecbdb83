use crate::{Facets, MomentSource, Stored, Translucent};
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::IVec2;
use std::sync::Arc;
use umbrage_plane::{DepthRange, TexelRect, View, floor_texel};

/// A stored map: one depth per texel, whatever the storage. Look-ups never fail.
///
/// Depths are in the kind of the map's view, grow away from the light, and are never NaN or −∞.
/// References and [`Arc`]s of maps are maps too, so that several filters can share one.
pub trait DepthMap: Send + Sync {
    /// The light's view, which says what the depths mean.
    fn view(&self) -> &View;

    /// The depth of a texel, or of its nearest surface if it has several; +∞ where no surface is stored and everywhere
    /// outside the map.
    fn depth(&self, texel: IVec2) -> f32;

    /// The depths of the texels under sixteen positions (texel space). `within` encloses all of them that matter.
    ///
    /// For lanes inside `within` this equals calls of [`DepthMap::depth`] bit for bit; the others, NaN among them, give
    /// some depth or +∞.
    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        let _ = within;
        let (column, row) = (floor_texel(simd, x), floor_texel(simd, y));
        let mut depths = [0.0; 16];
        for i in 0..16 {
            depths[i] = self.depth(IVec2::new(column[i], row[i]));
        }
        f32x16::load_array(simd, depths)
    }

    /// The depths of `count` texels of a row, at most sixteen, from `texel` to the right, as [`DepthMap::depth`] gives them; the other lanes give some depth
    /// or +∞.
    #[inline(always)]
    fn in_row<S: Simd>(&self, simd: S, texel: IVec2, count: u32) -> f32x16<S> {
        f32x16::load_array(simd, texels_of_row(self, texel, count))
    }

    /// Encloses every depth of `rect`, texels outside the map included (+∞). It never decides a result, it only saves
    /// work.
    #[inline(always)]
    fn range(&self, rect: TexelRect) -> DepthRange {
        let _ = rect;
        DepthRange::UNKNOWN
    }

    /// What the map's surfaces let through, for a deep map; `None` where every surface is opaque.
    #[inline(always)]
    fn translucent(&self) -> Option<&dyn Translucent> {
        None
    }

    /// What the map knows of facets; `None` where it knows depths alone.
    #[inline(always)]
    fn facets(&self) -> Option<Facets<'_>> {
        None
    }

    /// Moments of the map's depths; `None` where it knows the depths alone.
    #[inline(always)]
    fn moments(&self) -> Option<&dyn MomentSource> {
        None
    }

    /// Which surface the depths belong to.
    #[inline(always)]
    fn stored(&self) -> Stored {
        Stored::First
    }

    /// Bytes held for depths alone, 4 each, as Reeves' Table 2 counts them: without directories and rectangles. Of maps that keep something
    /// else, that.
    fn bytes(&self) -> usize;

    /// All bytes that the map holds, directories, tables and itself included.
    fn allocated(&self) -> usize;
}

/// The depths of texels of a row, each looked up.
#[inline(never)]
pub(crate) fn texels_of_row(map: &(impl DepthMap + ?Sized), texel: IVec2, count: u32) -> [f32; 16] {
    let mut depths = [f32::INFINITY; 16];
    for (depth, x) in depths[..count.min(16) as usize].iter_mut().zip(texel.x..) {
        *depth = map.depth(IVec2::new(x, texel.y));
    }
    depths
}

/// [`DepthMap`] of something that stands for another map.
macro_rules! forward {
    ($type:ty) => {
        impl<M: DepthMap + ?Sized> DepthMap for $type {
            #[inline(always)]
            fn view(&self) -> &View {
                (**self).view()
            }

            #[inline(always)]
            fn depth(&self, texel: IVec2) -> f32 {
                (**self).depth(texel)
            }

            #[inline(always)]
            fn look<S: Simd>(&self, simd: S, within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
                (**self).look(simd, within, x, y)
            }

            #[inline(always)]
            fn in_row<S: Simd>(&self, simd: S, texel: IVec2, count: u32) -> f32x16<S> {
                (**self).in_row(simd, texel, count)
            }

            #[inline(always)]
            fn range(&self, rect: TexelRect) -> DepthRange {
                (**self).range(rect)
            }

            #[inline(always)]
            fn translucent(&self) -> Option<&dyn Translucent> {
                (**self).translucent()
            }

            #[inline(always)]
            fn facets(&self) -> Option<Facets<'_>> {
                (**self).facets()
            }

            #[inline(always)]
            fn moments(&self) -> Option<&dyn MomentSource> {
                (**self).moments()
            }

            fn stored(&self) -> Stored {
                (**self).stored()
            }

            fn bytes(&self) -> usize {
                (**self).bytes()
            }

            fn allocated(&self) -> usize {
                (**self).allocated()
            }
        }
    };
}

forward!(&M);
forward!(Arc<M>);
