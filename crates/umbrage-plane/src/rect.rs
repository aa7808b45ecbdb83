use glam::{IVec2, UVec2, Vec2};

/// A half-open rectangle of texels: `min` is inside, `max` is the first outside on each axis.
///
/// Empty when `max` is not greater than `min` on both axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TexelRect {
    /// First column and row inside.
    pub min: IVec2,
    /// First column and row past the end.
    pub max: IVec2,
}

impl TexelRect {
    /// The rectangle without a texel.
    pub const EMPTY: Self = Self { min: IVec2::ZERO, max: IVec2::ZERO };

    /// From inclusive `min` to exclusive `max`.
    pub const fn new(min: IVec2, max: IVec2) -> Self {
        Self { min, max }
    }

    /// All texels of a map of `size`.
    pub fn of_size(size: UVec2) -> Self {
        Self { min: IVec2::ZERO, max: size.as_ivec2() }
    }

    /// The texels that `[centre − half, centre + half]` touches, in texel units. Coordinates beyond ±2³⁰ saturate there; NaN gives an empty rectangle.
    #[inline(always)]
    pub fn around(centre: Vec2, half: Vec2) -> Self {
        const FAR: f32 = 1_073_741_824.0;
        let low = (centre - half).floor();
        let high = (centre + half).floor();
        if !(low.is_finite() || high.is_finite()) && (low.is_nan() || high.is_nan()) {
            return Self::EMPTY;
        }
        let clamp = |v: Vec2| v.clamp(Vec2::splat(-FAR), Vec2::splat(FAR)).as_ivec2();
        Self { min: clamp(low), max: clamp(high) + IVec2::ONE }
    }

    /// True when no texel is inside.
    pub fn is_empty(self) -> bool {
        self.max.x <= self.min.x || self.max.y <= self.min.y
    }

    /// Columns and rows; zero where empty.
    pub fn size(self) -> UVec2 {
        (self.max - self.min).max(IVec2::ZERO).as_uvec2()
    }

    /// Number of texels.
    pub fn area(self) -> usize {
        let size = self.size();
        size.x as usize * size.y as usize
    }

    /// True when `texel` is inside.
    #[inline(always)]
    pub fn contains(self, texel: IVec2) -> bool {
        texel.x >= self.min.x && texel.y >= self.min.y && texel.x < self.max.x && texel.y < self.max.y
    }

    /// True when every texel of `other` is inside; an empty `other` always is.
    #[inline(always)]
    pub fn encloses(self, other: Self) -> bool {
        other.is_empty() || (self.min.cmple(other.min).all() && self.max.cmpge(other.max).all())
    }

    /// The texels inside both.
    #[inline(always)]
    pub fn intersect(self, other: Self) -> Self {
        Self { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// The smallest rectangle around both; an empty one adds nothing.
    pub fn union(self, other: Self) -> Self {
        if self.is_empty() {
            other
        } else if other.is_empty() {
            self
        } else {
            Self { min: self.min.min(other.min), max: self.max.max(other.max) }
        }
    }

    /// The texels row by row, from the top left.
    pub fn texels(self) -> impl Iterator<Item = IVec2> {
        (self.min.y..self.max.y).flat_map(move |y| (self.min.x..self.max.x).map(move |x| IVec2::new(x, y)))
    }
}
