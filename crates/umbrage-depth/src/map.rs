use fearless_simd::{Simd, f32x16, prelude::*};
use glam::IVec2;
use umbrage_plane::{DepthRange, TexelRect, View, floor_texel};

/// A kept map: one depth a texel, whatever the storage. Total: no look-up can fail.
///
/// Depths are in the kind of the map's view (C-4), grow away from the light, and are never NaN or −∞ (C-5).
pub trait DepthMap: Sync {
    /// True when texels hold more than one surface: [`DepthMap::passes`] then says more than a comparison with [`DepthMap::depth`].
    #[inline(always)]
    fn is_deep(&self) -> bool {
        false
    }

    /// The light's view; it says what the depths mean.
    fn view(&self) -> &View;

    /// The depth of a texel, of its nearest surface if there are several; +∞ where no surface is stored and everywhere outside the map.
    fn depth(&self, texel: IVec2) -> f32;

    /// The depths of the texels under sixteen positions (texel space). `within` encloses all of them that matter.
    ///
    /// For lanes inside `within` this equals calls of [`DepthMap::depth`] bit for bit; the others, NaN among them, give some depth or +∞.
    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        let _ = within;
        let (column, row) = (floor_texel(simd, x), floor_texel(simd, y));
        f32x16::load_array(simd, std::array::from_fn(|i| self.depth(IVec2::new(column[i], row[i]))))
    }

    /// Encloses every depth of `rect`, texels outside the map included (+∞). Never decides a result, only saves work.
    #[inline(always)]
    fn range(&self, rect: TexelRect) -> DepthRange {
        let _ = rect;
        DepthRange::UNKNOWN
    }

    /// The share of the light that passes all surfaces of a texel nearer than `depth`, in 0..=1; a surface at `depth` itself is not
    /// nearer (C-7). 1 or 0 unless the map [is deep](DepthMap::is_deep).
    #[inline(always)]
    fn passes(&self, texel: IVec2, depth: f32) -> f32 {
        if depth > self.depth(texel) { 0.0 } else { 1.0 }
    }

    /// The map as red, green and as blue light sees it; `None` where all light passes alike.
    fn colours(&self) -> Option<[Self; 3]>
    where
        Self: Sized,
    {
        None
    }

    /// Bytes held for depths alone, 4 each, as Reeves' Table 2 counts them: without directories and rectangles.
    fn bytes(&self) -> usize;
}
