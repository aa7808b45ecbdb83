/// Shadow without a bias over a map of facets ([`FacetMap`](umbrage_depth::FacetMap)): the receiver's tangent plane is compared with the caster's own plane,
/// and edges run
/// between the samples of a texel, not along its border.
///
/// A sample of the map calls a place of the receiver dark when the receiver's plane lies behind the sample's **both** at the sample's centre and at
/// the place itself: convex folds pass the first test, concave folds the second. The margin that both tests require is not a bias but what a
/// sample cannot resolve: half a sample's width and a quarter of the gentler slope over it. Where the four samples around a place disagree, the
/// map's links give the place between two of them where the surface changes, and marching squares the course of the edge. A region is crossed by `across` lines: on each,
/// `across` + 1 places are judged, and between two that disagree the edge is searched for. The parts of the region that are not its
/// [surface](umbrage_plane::Cells) are left out.
///
/// Umbrage's own. Casters' planes are after Dou et al. 2014, edges in texels after Sen, Cammarano & Hanrahan 2003.
/// Over a map without facets it compares the receiver's plane at every texel of its region, which is the best that such a map can give; over a deep map the
/// plane is moved
/// toward the light by as much as its own slope separates a texel's samples.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct DualPlane {
    /// Lines across the region, and parts of each between places that are judged; 1 judges the point itself alone.
    pub across: u32,
    /// The margin for a sample's width, in widths of the sample. ½ is half of it.
    pub width_term: f64,
    /// The margin for slope, in changes of depth over a sample's width along both axes, of the gentler of the two planes.
    pub slope_term: f64,
    /// The least width of a sample for both terms, in widths of the region: a region's tangent plane leaves a curved surface toward its
    /// sides.
    pub footprint_term: f64,
}

impl Default for DualPlane {
    fn default() -> Self {
        Self { across: 4, width_term: 0.5, slope_term: 0.25, footprint_term: 0.25 }
    }
}

umbrage_plane::builders!([] DualPlane {
    with_across across: u32,
    with_width_term width_term: f64,
    with_slope_term slope_term: f64,
    with_footprint_term footprint_term: f64,
});
