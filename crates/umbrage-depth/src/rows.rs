use crate::DepthMap;
use crate::map::texels_of_row;
use fearless_simd::{Simd, f32x16, prelude::*, u32x16};
use glam::IVec2;
use umbrage_plane::{TexelRect, floor_texel};

/// [`DepthMap::depth`] of depths that are kept row by row for `rect` alone.
#[inline(always)]
pub(crate) fn depth(depths: &[f32], rect: TexelRect, texel: IVec2) -> f32 {
    if !rect.contains(texel) {
        return f32::INFINITY;
    }
    let at = (texel - rect.min).as_uvec2();
    depths[at.y as usize * rect.size().x as usize + at.x as usize]
}

/// [`DepthMap::look`] of depths that are kept row by row for `rect` alone.
#[inline(always)]
pub(crate) fn look<S: Simd>(
    simd: S,
    depths: &[f32],
    rect: TexelRect,
    within: TexelRect,
    x: f32x16<S>,
    y: f32x16<S>,
) -> f32x16<S> {
    let width = rect.size().x;
    // As unsigned numbers, positions before the rectangle are past its end.
    let column: u32x16<S> = (floor_texel(simd, x) - rect.min.x).bitcast();
    let row: u32x16<S> = (floor_texel(simd, y) - rect.min.y).bitcast();
    let index = row * width + column;
    let mut found = [f32::INFINITY; 16];
    // Loops, because a closure would be a function of its own, compiled without the machine's instructions.
    if let Some((from, mask)) = window(depths, rect, within) {
        // Split by lengths that show that no masked index is out of bounds: all sixteen are read without a test.
        let (_, window) = depths.split_at_checked(from as usize).unwrap_or_default();
        if let Some((window, _)) = window.split_at_checked(mask as usize + 1) {
            let index = (index - from) & mask;
            for i in 0..16 {
                found[i] = window[(index[i] & mask) as usize];
            }
            return f32x16::load_array(simd, found);
        }
    }
    let height = u32x16::splat(simd, rect.size().y);
    let inside = column.simd_lt(u32x16::splat(simd, width)) & row.simd_lt(height);
    let index = inside.select(index, u32x16::splat(simd, u32::MAX));
    for i in 0..16 {
        if let Some(&depth) = depths.get(index[i] as usize) {
            found[i] = depth;
        }
    }
    f32x16::load_array(simd, found)
}

/// [`DepthMap::in_row`] of `map`, whose depths are kept row by row for `rect` alone.
#[inline(always)]
pub(crate) fn in_row<S: Simd>(
    simd: S,
    map: &impl DepthMap,
    (depths, rect): (&[f32], TexelRect),
    texel: IVec2,
    count: u32,
) -> f32x16<S> {
    let at = texel - rect.min;
    let size = rect.max - rect.min;
    if at.cmpge(IVec2::ZERO).all() && at.y < size.y && at.x <= size.x - count as i32 {
        let first = at.y as usize * size.x as usize + at.x as usize;
        // The last row may end before sixteen lanes do.
        if let Some((_, row)) = depths.split_at_checked(first)
            && let Some(row) = row.first_chunk()
        {
            return f32x16::load_array(simd, *row);
        }
    }
    f32x16::load_array(simd, texels_of_row(map, texel, count))
}

/// A stretch of as many depths as a power of two in which all rows of `within` lie: the index of its first, and that number less one. `None` where
/// `within` reaches out of the rectangle, and where its rows are a large part of all.
#[inline(always)]
fn window(depths: &[f32], rect: TexelRect, within: TexelRect) -> Option<(u32, u32)> {
    if within.is_empty() || !rect.encloses(within) {
        return None;
    }
    let width = (rect.max.x - rect.min.x) as u32;
    let rows = (within.max.y - within.min.y) as u32;
    // A map has no more than 2³⁰ texels.
    let mask = u32::MAX.checked_shr((rows * width - 1).leading_zeros()).unwrap_or(0);
    let last = (depths.len() as u32).checked_sub(mask + 1)?;
    Some((((within.min.y - rect.min.y) as u32 * width).min(last), mask))
}

/// The depths of `rect`, row by row.
pub(crate) fn copy(map: &impl DepthMap, rect: TexelRect) -> Vec<f32> {
    rect.texels().map(|texel| map.depth(texel)).collect()
}

/// The smallest rectangle around all texels of `within` that hold a surface.
pub(crate) fn finite(map: &impl DepthMap, within: TexelRect) -> TexelRect {
    within
        .texels()
        .filter(|&texel| map.depth(texel) < f32::INFINITY)
        .fold(TexelRect::EMPTY, |found, texel| found.union(TexelRect::new(texel, texel + IVec2::ONE)))
}
