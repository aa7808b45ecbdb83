/// How finely the texels of a [`bake_refined`](crate::bake_refined) map are stored where one plane is not enough.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Refinement {
    /// Samples along a refined texel's side: 2, 4 or 8.
    pub fine: u32,
    /// Slots of a link between two samples: a power of two from 2 to 64/`fine`. It is even, so that no slot lies on a third sample.
    pub slots: u32,
    /// How far a sample may lie off its texel's plane before the texel is refined, in widths of a texel there.
    pub tolerance: f64,
}

impl Default for Refinement {
    fn default() -> Self {
        Self { fine: 4, slots: 16, tolerance: 0.5 }
    }
}

umbrage_plane::builders!([] Refinement { with_fine fine: u32, with_slots slots: u32, with_tolerance tolerance: f64 });
