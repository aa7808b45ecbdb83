use crate::{
    AreaTent, Castano, Centre, Disc, EveryTexel, Gaussian, InsideQuadReject, InsideQuadWarp, Jittered, Key, Pattern,
    Spiral, Table, Taps, Tent, Uniform, Vogel,
};
use fearless_simd::Simd;
use umbrage_plane::{Footprint, TexelRect};

/// Any of this crate's patterns, chosen when the program runs: what a recipe's `pattern=` becomes.
///
/// Taps are the same bits as the pattern's own. Code over it is compiled once for all patterns, and pays one indirect call for
/// sixteen taps; where that counts, name the pattern's own type instead.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum AnyPattern {
    /// [`Centre`].
    Centre(Centre),
    /// [`EveryTexel`].
    EveryTexel(EveryTexel),
    /// [`Tent`].
    Tent(Tent),
    /// [`Uniform`].
    Uniform(Uniform),
    /// [`Gaussian`].
    Gaussian(Gaussian),
    /// [`Jittered`].
    Jittered(Jittered),
    /// [`Table`].
    Table(Table),
    /// [`InsideQuadReject`].
    InsideQuadReject(InsideQuadReject),
    /// [`InsideQuadWarp`].
    InsideQuadWarp(InsideQuadWarp),
    /// [`Disc`].
    Disc(Disc),
    /// [`Castano`].
    Castano(Castano),
    /// [`AreaTent`].
    AreaTent(AreaTent),
    /// [`Vogel`].
    Vogel(Vogel),
    /// [`Spiral`].
    Spiral(Spiral),
}

/// The same expression over whichever pattern it is.
macro_rules! each {
    ($self:expr, $pattern:ident => $answer:expr) => {
        match $self {
            AnyPattern::Centre($pattern) => $answer,
            AnyPattern::EveryTexel($pattern) => $answer,
            AnyPattern::Tent($pattern) => $answer,
            AnyPattern::Uniform($pattern) => $answer,
            AnyPattern::Gaussian($pattern) => $answer,
            AnyPattern::Jittered($pattern) => $answer,
            AnyPattern::Table($pattern) => $answer,
            AnyPattern::InsideQuadReject($pattern) => $answer,
            AnyPattern::InsideQuadWarp($pattern) => $answer,
            AnyPattern::Disc($pattern) => $answer,
            AnyPattern::Castano($pattern) => $answer,
            AnyPattern::AreaTent($pattern) => $answer,
            AnyPattern::Vogel($pattern) => $answer,
            AnyPattern::Spiral($pattern) => $answer,
        }
    };
}

macro_rules! from {
    ($($pattern:ident),*) => {
        $(impl From<$pattern> for AnyPattern {
            fn from(pattern: $pattern) -> Self {
                Self::$pattern(pattern)
            }
        })*
    };
}

from!(
    Centre,
    EveryTexel,
    Tent,
    Uniform,
    Gaussian,
    Jittered,
    Table,
    InsideQuadReject,
    InsideQuadWarp,
    Disc,
    Castano,
    AreaTent,
    Vogel,
    Spiral
);

impl Pattern for AnyPattern {
    #[inline(always)]
    fn weighted(&self) -> bool {
        each!(self, pattern => pattern.weighted())
    }

    #[inline(always)]
    fn window(&self, region: &Footprint) -> Option<TexelRect> {
        each!(self, pattern => pattern.window(region))
    }

    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        // Each side of the indirect call states the instructions that it is compiled for.
        let mut each = |taps: &Taps<S>| {
            simd.vectorize(
                #[inline(always)]
                || each(taps),
            );
        };
        self.erased(simd, region, key, &mut each);
    }
}

impl AnyPattern {
    /// Compiled once for each instruction set, whatever is done with the taps.
    #[inline(never)]
    fn erased<S: Simd>(&self, simd: S, region: &Footprint, key: Key, each: &mut dyn FnMut(&Taps<S>)) {
        simd.vectorize(
            #[inline(always)]
            || {
                each!(
                    self,
                    pattern => pattern.taps(
                        simd,
                        region,
                        key,
                        #[inline(always)]
                        |taps| each(taps),
                    )
                );
            },
        );
    }
}
