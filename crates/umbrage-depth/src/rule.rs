use crate::Stored;
use glam::DVec2;
use umbrage_plane::{Decode, Facet};

/// Which of the surfaces behind a texel is stored (spec X-3).
///
/// A rule is a reduction over the fragments of a texel whose result does not depend on their order, so that
/// neither threads nor tiling can change a bit. Rules see keys ([`umbrage_plane::Affine`]); keys become depths once, in [`DepthRule::resolve`].
pub trait DepthRule: Sync {
    /// What is kept per texel while fragments arrive.
    type Cell: Copy + Send;
    /// A texel that no fragment has met.
    const EMPTY: Self::Cell;
    /// How often all fragments are offered.
    const PASSES: u32 = 1;

    /// Offers one fragment: its key at the texel's sample position and whether its outside is seen there. A key of NaN changes nothing.
    fn add(&self, pass: u32, cell: &mut Self::Cell, key: f32, front: bool, facet: &Facet);

    /// Which surface the depths of this rule belong to; [`Stored::Other`] for a rule that none of the others name.
    fn stored(&self) -> Stored;

    /// The depth to store, at the texel's sample position; +∞ where nothing is.
    fn resolve(&self, cell: Self::Cell, decode: &Decode, at: DVec2) -> f32;
}
