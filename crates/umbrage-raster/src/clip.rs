//! Cutting triangles where projection or snapping would end: behind the view, and far outside it.
//!
//! Every cut computes the new corner from the end of the edge that stays toward the one that goes, so that two triangles
//! cut at their common edge get the same corner to the bit, and what was watertight stays so.

use glam::DVec3;
use umbrage_plane::View;

/// Texel coordinates beyond ± this are cut off: 64 times the largest map. It keeps snapped coordinates below 2²⁹ in size, and
/// every product of the coverage test within an `i64`.
pub(crate) const GUARD_TEXELS: f64 = 2_097_152.0;

/// Perspective geometry is cut at this fraction of the near distance. Casters between the light and the near plane must not vanish,
/// but ζ = 0 cannot be projected.
pub(crate) const NEAR_LIMIT: f64 = 1.0 / 1024.0;

/// Cuts polygons; holds the memory it works in.
#[derive(Default)]
pub(crate) struct Clipper {
    corners: Vec<DVec3>,
    cut: Vec<DVec3>,
}

/// A projected polygon.
pub(crate) struct Projected<'a> {
    /// Texel x, texel y and key of each corner, in the triangle's order; less than three when nothing is left.
    pub corners: &'a [DVec3],
    /// True when something was cut off.
    pub clipped: bool,
}

impl Clipper {
    /// A triangle of eye space as the view's texels see it.
    pub fn project(&mut self, view: &View, eye: [DVec3; 3]) -> Projected<'_> {
        self.corners.clear();
        self.corners.extend(eye);
        let mut clipped = false;
        if view.is_perspective() {
            let limit = view.near() * NEAR_LIMIT;
            if !eye.iter().all(|corner| -corner.z >= limit) {
                clipped = true;
                self.keep(|corner| -corner.z - limit, |corner| corner.z = -limit);
            }
        }
        for corner in &mut self.corners {
            *corner = view.eye_to_texel(*corner).extend(view.key(-corner.z));
        }
        if !self.corners.iter().all(|corner| corner.x.abs() <= GUARD_TEXELS && corner.y.abs() <= GUARD_TEXELS) {
            clipped = true;
            self.keep(|corner| GUARD_TEXELS + corner.x, |corner| corner.x = -GUARD_TEXELS);
            self.keep(|corner| GUARD_TEXELS - corner.x, |corner| corner.x = GUARD_TEXELS);
            self.keep(|corner| GUARD_TEXELS + corner.y, |corner| corner.y = -GUARD_TEXELS);
            self.keep(|corner| GUARD_TEXELS - corner.y, |corner| corner.y = GUARD_TEXELS);
        }
        Projected { corners: &self.corners, clipped }
    }

    /// Keeps the part where `inside` is not negative (Sutherland and Hodgman 1974); `settle` puts a new corner exactly on the border.
    fn keep(&mut self, inside: impl Fn(DVec3) -> f64, settle: impl Fn(&mut DVec3)) {
        self.cut.clear();
        for (index, &start) in self.corners.iter().enumerate() {
            let end = self.corners[(index + 1) % self.corners.len()];
            let (at_start, at_end) = (inside(start), inside(end));
            if at_start >= 0.0 {
                self.cut.push(start);
            }
            if (at_start >= 0.0) != (at_end >= 0.0) {
                let (stays, goes, margin, excess) =
                    if at_start >= 0.0 { (start, end, at_start, at_end) } else { (end, start, at_end, at_start) };
                let mut border = stays + (goes - stays) * (margin / (margin - excess));
                settle(&mut border);
                self.cut.push(border);
            }
        }
        std::mem::swap(&mut self.corners, &mut self.cut);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec2;
    use proptest::prelude::*;

    fn cut(view: &View, eye: [DVec3; 3]) -> Vec<[u64; 3]> {
        let mut clipper = Clipper::default();
        let mut corners: Vec<_> =
            clipper.project(view, eye).corners.iter().map(|corner| corner.to_array().map(f64::to_bits)).collect();
        corners.sort_unstable();
        corners
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5_000))]

        /// Two neighbours run along their common edge in opposite directions.
        #[test]
        fn x2_an_edge_is_cut_at_the_same_place_in_both_directions(
            corners in proptest::array::uniform3((-1e7_f64..1e7, -1e7_f64..1e7, -9.0_f64..9.0)), perspective in any::<bool>(),
        ) {
            let view = if perspective {
                View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 0.1, 9.0, UVec2::splat(64))
            } else {
                View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 32.0, 0.1, 9.0, UVec2::splat(64))
            };
            let [a, b, c] = corners.map(DVec3::from);
            let view = view.unwrap();
            prop_assert_eq!(cut(&view, [a, b, c]), cut(&view, [c, b, a]));
        }
    }
}
