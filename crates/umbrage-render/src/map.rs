use crate::recipe::Storage;
use fearless_simd::{Simd, f32x16};
use glam::IVec2;
use umbrage_depth::{Bbox, DeepMap, DepthMap, Raw, Tiled};
use umbrage_plane::{DepthRange, TexelRect, View};

/// A light's map in whichever form it is kept: one type for all, so that each filter is compiled once.
#[derive(Clone, Debug)]
pub enum Map {
    /// Every texel.
    Raw(Raw),
    /// The rectangle around all surfaces.
    Bbox(Bbox),
    /// Tiles: what pass 1 makes.
    Tiled(Tiled),
    /// Several surfaces a texel, each letting light through.
    Deep(DeepMap),
}

/// The same of whichever map it is.
macro_rules! each {
    ($self:expr, $map:ident => $answer:expr) => {
        match $self {
            Map::Raw($map) => $answer,
            Map::Bbox($map) => $answer,
            Map::Tiled($map) => $answer,
            Map::Deep($map) => $answer,
        }
    };
}

impl Map {
    /// The same map kept otherwise; a deep one as it is.
    #[must_use]
    pub fn kept(self, storage: Storage) -> Self {
        match (storage, self) {
            (_, kept @ Self::Deep(_))
            | (Storage::Raw, kept @ Self::Raw(_))
            | (Storage::Bbox, kept @ Self::Bbox(_))
            | (Storage::Tiled, kept @ Self::Tiled(_)) => kept,
            (Storage::Raw, map) => Self::Raw(Raw::copy_of(&map)),
            (Storage::Bbox, map) => Self::Bbox(Bbox::from(&Raw::copy_of(&map))),
            (Storage::Tiled, map) => Self::Tiled(Tiled::copy_of(&map)),
        }
    }
}

impl From<Tiled> for Map {
    fn from(map: Tiled) -> Self {
        Self::Tiled(map)
    }
}

impl From<&Tiled> for Map {
    fn from(map: &Tiled) -> Self {
        Self::Tiled(map.clone())
    }
}

impl From<&Self> for Map {
    fn from(map: &Self) -> Self {
        map.clone()
    }
}

impl From<DeepMap> for Map {
    fn from(map: DeepMap) -> Self {
        Self::Deep(map)
    }
}

impl DepthMap for Map {
    #[inline(always)]
    fn is_deep(&self) -> bool {
        matches!(self, Self::Deep(_))
    }

    #[inline(always)]
    fn view(&self) -> &View {
        each!(self, map => map.view())
    }

    #[inline(always)]
    fn depth(&self, texel: IVec2) -> f32 {
        each!(self, map => map.depth(texel))
    }

    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        each!(self, map => map.look(simd, within, x, y))
    }

    #[inline(always)]
    fn range(&self, rect: TexelRect) -> DepthRange {
        each!(self, map => map.range(rect))
    }

    #[inline(always)]
    fn passes(&self, texel: IVec2, depth: f32) -> f32 {
        each!(self, map => map.passes(texel, depth))
    }

    fn colours(&self) -> Option<[Self; 3]> {
        match self {
            Self::Deep(map) => map.colours().map(|maps| maps.map(Self::Deep)),
            _ => None,
        }
    }

    fn bytes(&self) -> usize {
        each!(self, map => map.bytes())
    }
}
