use fearless_simd::{Simd, f32x16};
use glam::IVec2;
use umbrage_depth::DepthMap;
use umbrage_plane::{DepthRange, TexelRect, View};

/// A map as one colour of light sees it: its own map of that colour, or itself where all light passes alike.
pub(crate) enum Channel<'a, M> {
    Own(M),
    Alike(&'a M),
}

impl<'a, M: DepthMap> Channel<'a, M> {
    /// Red, green and blue of a map; `None` where all light passes alike.
    pub fn of(map: &'a M) -> Option<[Self; 3]> {
        map.colours().map(|maps| maps.map(Self::Own))
    }

    #[inline(always)]
    fn map(&self) -> &M {
        match self {
            Self::Own(map) => map,
            Self::Alike(map) => map,
        }
    }
}

impl<M: DepthMap> DepthMap for Channel<'_, M> {
    #[inline(always)]
    fn is_deep(&self) -> bool {
        self.map().is_deep()
    }

    #[inline(always)]
    fn view(&self) -> &View {
        self.map().view()
    }

    #[inline(always)]
    fn depth(&self, texel: IVec2) -> f32 {
        self.map().depth(texel)
    }

    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        self.map().look(simd, within, x, y)
    }

    #[inline(always)]
    fn range(&self, rect: TexelRect) -> DepthRange {
        self.map().range(rect)
    }

    #[inline(always)]
    fn passes(&self, texel: IVec2, depth: f32) -> f32 {
        self.map().passes(texel, depth)
    }

    fn bytes(&self) -> usize {
        self.map().bytes()
    }
}
