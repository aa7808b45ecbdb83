use glam::DVec2;

/// Cells along each side of a region.
const SIDE: u32 = 8;

/// Which part of a region is its surface: a pixel that shows two surfaces is one region of each, and neither fills it.
///
/// The parallelogram of the region is cut into 8 × 8 cells, along its first edge and along its second, and each is covered or not. Places in it are given in
/// half-axes: −1 to 1 along each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cells(u64);

impl Cells {
    /// The whole region.
    pub const ALL: Self = Self(u64::MAX);
    /// Nothing yet: what [`Cells::with`] begins with. A region of no cell counts as a whole one.
    pub const NONE: Self = Self(0);

    /// The same and one cell of a grid of `across` × `across`; `column` and `row` are below `across`, which is 1, 2, 4 or 8 (other
    /// values count as the next lower of these).
    #[must_use]
    pub fn with(self, column: u32, row: u32, across: u32) -> Self {
        let side = SIDE >> across.clamp(1, SIDE).ilog2();
        let line = ((1u64 << side) - 1) << (column * side).min(SIDE - side);
        let rows = |bits: u64, y: u32| bits | line << (SIDE * y);
        let first = (row * side).min(SIDE - side);
        Self(self.0 | (first..first + side).fold(0, rows))
    }

    /// Whether the region is its surface all over.
    #[inline(always)]
    #[must_use]
    pub fn is_whole(self) -> bool {
        self.0 == u64::MAX || self.0 == 0
    }

    /// The mean place of the covered cells, half-axes: what a region's [position](crate::SurfacePoint::position) is the image of.
    #[must_use]
    pub fn centroid(self) -> DVec2 {
        if self.is_whole() {
            return DVec2::ZERO;
        }
        let place = |line: u32| f64::from(2 * line + 1) / f64::from(SIDE) - 1.0;
        let count = |mask: u64| f64::from((self.0 & mask).count_ones());
        let columns = (0..SIDE).map(|x| place(x) * count(Self::column(x)));
        let rows = (0..SIDE).map(|y| place(y) * count(Self::row(y)));
        DVec2::new(columns.sum(), rows.sum()) / f64::from(self.0.count_ones())
    }

    /// The least box of half-axes that holds the covered cells: its middle and half-extents.
    #[must_use]
    pub fn bounds(self) -> (DVec2, DVec2) {
        if self.is_whole() {
            return (DVec2::ZERO, DVec2::ONE);
        }
        let within = |line: fn(u32) -> u64| {
            let hit = |at: &u32| self.0 & line(*at) != 0;
            let first = (0..SIDE).find(hit).unwrap_or(0);
            let last = (0..SIDE).rev().find(hit).unwrap_or(SIDE - 1) + 1;
            (f64::from(first + last) / f64::from(SIDE) - 1.0, f64::from(last - first) / f64::from(SIDE))
        };
        let ((x, half_x), (y, half_y)) = (within(Self::column), within(Self::row));
        (DVec2::new(x, y), DVec2::new(half_x, half_y))
    }

    /// How much of a cell of a grid of `across` × `across` is covered, 0 to 1; of a grid whose lines are not those of the 8 × 8 cells, whether the cell at its middle is.
    #[inline(always)]
    #[must_use]
    pub fn share(self, column: u32, row: u32, across: u32) -> f32 {
        if self.is_whole() {
            return 1.0;
        }
        if across > 0 && SIDE.is_multiple_of(across) {
            let cell = Self::NONE.with(column, row, across).0;
            return (self.0 & cell).count_ones() as f32 / cell.count_ones() as f32;
        }
        let cell = |at: u32| (2 * at + 1) * SIDE / (2 * across.max(1));
        f32::from(u8::from(self.0 & Self::column(cell(column)) & Self::row(cell(row)) != 0))
    }

    const fn column(x: u32) -> u64 {
        0x0101_0101_0101_0101 << x
    }

    const fn row(y: u32) -> u64 {
        0xff << (SIDE * y)
    }
}
