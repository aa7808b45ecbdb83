use glam::Vec2;

/// The image of a shaded region in a map, in texel units.
///
/// A pixel's image is a quadrilateral; `centre` and `half` are its bounding box as Reeves' listing wants it
/// (half-extents, not full sizes).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// Centre of the bounding box.
    pub centre: Vec2,
    /// Half of the bounding box's width and height, ≥ 0.
    pub half: Vec2,
    /// The region's corners in order around it, in texels. All equal for a point.
    pub corners: [Vec2; 4],
}

impl Footprint {
    /// A point without extent.
    pub const fn point(at: Vec2) -> Self {
        Self { centre: at, half: Vec2::ZERO, corners: [at; 4] }
    }

    /// An axis-parallel box.
    pub fn boxed(centre: Vec2, half: Vec2) -> Self {
        let across = Vec2::new(half.x, -half.y);
        Self { centre, half, corners: [centre - half, centre + across, centre + half, centre - across] }
    }

    /// The bounding box of four corners.
    #[inline(always)]
    pub fn around(corners: [Vec2; 4]) -> Self {
        let (mut low, mut high) = (corners[0], corners[0]);
        for corner in corners {
            low = low.min(corner);
            high = high.max(corner);
        }
        Self { centre: (low + high) * 0.5, half: (high - low) * 0.5, corners }
    }

    /// Enlarged about a point of it, the image of what is shaded: half-extents times `factor`, then at least `min_half`, then at most
    /// `max_half` (Reeves' `ResFactor` and `MinSize`, in that order). Corners scale alike, axis by axis, so that
    /// the box stays the bounding box of the quadrilateral and all patterns look at one region, not about the quadrilateral's
    /// centroid (a departure from Reeves 1987, Fig. 3d). Where an axis without extent gets one, the region becomes the box.
    ///
    /// In perspective the box's centre shows another place of the surface, at another depth, than the point does: the less of the
    /// region's own extent is left, the closer the result lies around the point.
    #[inline(always)]
    pub fn scaled(&self, about: Vec2, factor: f32, min_half: f32, max_half: Vec2) -> Self {
        let most = max_half.max(Vec2::ZERO);
        let grown = (self.half * factor).min(most);
        let half = grown.max(Vec2::splat(min_half)).min(most);
        let ratio = |new: f32, old: f32| if old > 0.0 { new / old } else { 0.0 };
        let ratios = |new: Vec2| Vec2::new(ratio(new.x, self.half.x), ratio(new.y, self.half.y));
        // What is left of the region's own extent decides how far from the point its centre is: exactly where it was for all of it.
        let centre = self.centre + (self.centre - about) * (ratios(grown) - 1.0);
        if (self.half.x <= 0.0 && half.x > 0.0) || (self.half.y <= 0.0 && half.y > 0.0) {
            return Self::boxed(centre, half);
        }
        let scale = ratios(half);
        Self { centre, half, corners: self.corners.map(|corner| centre + (corner - self.centre) * scale) }
    }

    /// Half-axes: along the first edge, from the first corner to the second, and along the second edge, each the mean of two
    /// opposite edges. They span the quadrilateral where it is a parallelogram.
    #[inline(always)]
    pub fn axes(&self) -> [Vec2; 2] {
        let [a, b, c, d] = self.corners;
        [((b - a) + (c - d)) * 0.25, ((d - a) + (c - b)) * 0.25]
    }

    /// Twice-signed area of the quadrilateral divided by the area of its bounding box, as a fraction in 0..=1; 0 for a degenerate box.
    pub fn quad_share(&self) -> f32 {
        let [a, b, c, d] = self.corners;
        let area = 0.5 * (c - a).perp_dot(d - b).abs();
        let whole = 4.0 * self.half.x * self.half.y;
        if whole > 0.0 { area / whole } else { 0.0 }
    }
}
