use fearless_simd::{Simd, f32x4, i32x4, prelude::*};
use glam::IVec2;
use umbrage_plane::{Footprint, TexelRect, View};

/// A region in the map's texels.
#[derive(Clone, Copy)]
pub(crate) struct Area {
    /// All texels that the region touches.
    pub rect: TexelRect,
    /// Whether all of it lies inside the map and the cone.
    pub inside: bool,
}

impl Area {
    /// [`TexelRect::around`] and [`View::holds`], of all four sides at once where there is no cone. A region of NaN is not inside, and its
    /// rectangle is unspecified.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, view: &View, region: &Footprint) -> Self {
        const FAR: f32 = 1_073_741_824.0;
        let (centre, half) = (region.centre, region.half);
        let (low, high) = (centre - half, centre + half);
        let sides = f32x4::load_array(simd, [low.x, low.y, high.x, high.y]);
        let whole = sides.floor().max(f32x4::splat(simd, -FAR)).min(f32x4::splat(simd, FAR));
        let [left, top, right, bottom]: [i32; 4] = whole.to_int::<i32x4<S>>().into();
        let (min, last) = (IVec2::new(left, top), IVec2::new(right, bottom));
        let inside = if view.cone().is_some() {
            view.holds(centre, half)
        } else {
            let size = view.size().as_vec2();
            let within = sides.simd_ge(f32x4::splat(simd, 0.0))
                & sides.simd_lt(f32x4::load_array(simd, [size.x, size.y, size.x, size.y]));
            within.all_true()
        };
        Self { rect: TexelRect::new(min, last + IVec2::ONE), inside }
    }
}

/// Half-extent of a region, texels, whose rows are too short to be read one by one.
pub(crate) const LONG: f32 = 5.0;

/// Whether a window is read in less time row by row than sixteen texels at a time, wherever they lie: rows need half of the instructions or less, but a
/// short one as many as a long one. Its texels are few enough to be counted in f32.
#[inline(always)]
pub(crate) fn reads_well(window: TexelRect) -> bool {
    let IVec2 { x: columns, y: rows } = window.max - window.min;
    let in_sixteens = |texels: i32| (texels + 15) >> 4;
    columns < MOST && rows < MOST && 2 * rows * in_sixteens(columns) <= 3 * in_sixteens(columns * rows)
}

/// Sides of a window whose texels are counted without rounding.
const MOST: i32 = 1 << 12;
