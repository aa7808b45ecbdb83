use crate::map::texels_of_row;
use crate::{
    Bbox, DeepMap, DepthMap, FacetMap, Facets, MomentMap, MomentSource, Raw, Stored, Tiled, Translucent, rows,
};
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::IVec2;
use std::str::FromStr;
use std::sync::Arc;
use umbrage_plane::{DepthRange, TexelRect, View};

/// How a map of one surface per texel is kept while it is looked up. Answers are the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Storage {
    /// Every texel.
    Raw,
    /// The rectangle around all surfaces (Reeves 1987, §3.3).
    Bbox,
    /// 32 × 32 tiles with their ranges (Reeves 1987, §3.3).
    #[default]
    Tiled,
}

/// A word that does not name a [`Storage`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("storage = {0:?}: expected raw, bbox or tiled")]
pub struct StorageError(
    /// The word.
    pub String,
);

impl FromStr for Storage {
    type Err = StorageError;

    fn from_str(text: &str) -> Result<Self, StorageError> {
        match text {
            "raw" => Ok(Self::Raw),
            "bbox" => Ok(Self::Bbox),
            "tiled" => Ok(Self::Tiled),
            _ => Err(StorageError(text.into())),
        }
    }
}

/// A light's map in whichever form it is kept: one type for all of them, so that each filter is compiled once. Clones share
/// their depths.
#[derive(Clone, Debug)]
pub enum Map {
    /// Every texel.
    Raw(Arc<Raw>),
    /// The rectangle around all surfaces.
    Bbox(Arc<Bbox>),
    /// Tiles: what pass 1 makes.
    Tiled(Arc<Tiled>),
    /// Which facet each texel sees.
    Facets(Arc<FacetMap>),
    /// Several surfaces per texel, each letting light through.
    Deep(Arc<DeepMap>),
    /// Every texel, and moments of the depths.
    Moments(Arc<MomentMap>),
}

/// The same expression over whichever map it is.
macro_rules! each {
    ($self:expr, $map:ident => $answer:expr) => {
        match $self {
            Map::Raw($map) => $answer,
            Map::Bbox($map) => $answer,
            Map::Tiled($map) => $answer,
            Map::Facets($map) => $answer,
            Map::Deep($map) => $answer,
            Map::Moments($map) => $answer,
        }
    };
}

impl Map {
    /// The same map in another storage; a deep one, one of facets and one of moments stay as they are. Nothing is copied where it is kept so already.
    #[must_use]
    pub fn kept(self, storage: Storage) -> Self {
        match (storage, self) {
            (_, kept @ (Self::Deep(_) | Self::Facets(_) | Self::Moments(_)))
            | (Storage::Raw, kept @ Self::Raw(_))
            | (Storage::Bbox, kept @ Self::Bbox(_))
            | (Storage::Tiled, kept @ Self::Tiled(_)) => kept,
            (Storage::Raw, map) => Raw::copy_of(&map).into(),
            (Storage::Bbox, map) => Bbox::from(&Raw::copy_of(&map)).into(),
            (Storage::Tiled, map) => Tiled::copy_of(&map).into(),
        }
    }
}

/// Conversions from one storage, owned or shared.
macro_rules! from {
    ($storage:ty, $variant:ident) => {
        impl From<$storage> for Map {
            fn from(map: $storage) -> Self {
                Self::$variant(Arc::new(map))
            }
        }

        impl From<Arc<$storage>> for Map {
            fn from(map: Arc<$storage>) -> Self {
                Self::$variant(map)
            }
        }

        impl From<&Arc<$storage>> for Map {
            fn from(map: &Arc<$storage>) -> Self {
                Self::$variant(Arc::clone(map))
            }
        }
    };
}

from!(Raw, Raw);
from!(Bbox, Bbox);
from!(Tiled, Tiled);
from!(FacetMap, Facets);
from!(DeepMap, Deep);
from!(MomentMap, Moments);

/// Conversions between storages: all of a map's depths, kept otherwise.
macro_rules! convert {
    ($from:ty, $to:ty) => {
        impl From<&$from> for $to {
            fn from(map: &$from) -> Self {
                Self::copy_of(map)
            }
        }
    };
}

convert!(Bbox, Raw);
convert!(Tiled, Raw);
convert!(Raw, Bbox);
convert!(Raw, Tiled);
convert!(Bbox, Tiled);

impl From<&Tiled> for Bbox {
    fn from(map: &Tiled) -> Self {
        // No texel outside the tiles needs a look.
        Self::within(map, map.kept())
    }
}

impl From<&Self> for Map {
    /// The same map, shared.
    fn from(map: &Self) -> Self {
        map.clone()
    }
}

/// The look-up of a map that reads its texels one by one: slow as it is, it need not be compiled for every filter.
#[inline(never)]
fn one_by_one<S: Simd>(simd: S, map: &impl DepthMap, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
    simd.vectorize(
        #[inline(always)]
        || map.look(simd, TexelRect::of_size(map.view().size()), x, y),
    )
}

impl DepthMap for Map {
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
        let (depths, rect) = match self {
            Self::Raw(map) => (map.depths(), TexelRect::of_size(map.view().size())),
            Self::Bbox(map) => (map.depths(), map.finite()),
            Self::Moments(map) => (map.depths(), TexelRect::of_size(map.view().size())),
            Self::Tiled(map) => return map.look(simd, within, x, y),
            Self::Facets(map) => return one_by_one(simd, map.as_ref(), x, y),
            Self::Deep(map) => return one_by_one(simd, map.as_ref(), x, y),
        };
        rows::look(simd, depths, rect, within, x, y)
    }

    #[inline(always)]
    fn in_row<S: Simd>(&self, simd: S, texel: IVec2, count: u32) -> f32x16<S> {
        match self {
            Self::Raw(map) => map.in_row(simd, texel, count),
            Self::Tiled(map) => map.in_row(simd, texel, count),
            other => f32x16::load_array(simd, texels_of_row(other, texel, count)),
        }
    }

    #[inline(always)]
    fn range(&self, rect: TexelRect) -> DepthRange {
        each!(self, map => map.range(rect))
    }

    #[inline(always)]
    fn translucent(&self) -> Option<&dyn Translucent> {
        each!(self, map => map.translucent())
    }

    #[inline(always)]
    fn facets(&self) -> Option<Facets<'_>> {
        if let Self::Facets(map) = self { Some(Facets::Map(map)) } else { None }
    }

    #[inline(always)]
    fn moments(&self) -> Option<&dyn MomentSource> {
        if let Self::Moments(map) = self { Some(map.as_ref()) } else { None }
    }

    fn stored(&self) -> Stored {
        each!(self, map => map.stored())
    }

    fn bytes(&self) -> usize {
        each!(self, map => map.bytes())
    }

    fn allocated(&self) -> usize {
        each!(self, map => map.allocated())
    }
}
