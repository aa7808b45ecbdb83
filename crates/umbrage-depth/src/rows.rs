use crate::DepthMap;
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
pub(crate) fn look<S: Simd>(simd: S, depths: &[f32], rect: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
    let size = rect.size();
    // As unsigned numbers, positions before the rectangle are past its end.
    let column: u32x16<S> = (floor_texel(simd, x) - rect.min.x).bitcast();
    let row: u32x16<S> = (floor_texel(simd, y) - rect.min.y).bitcast();
    let inside = column.simd_lt(u32x16::splat(simd, size.x)) & row.simd_lt(u32x16::splat(simd, size.y));
    let index = inside.select(row * size.x + column, u32x16::splat(simd, u32::MAX));
    // A loop, because a closure would be a function of its own, compiled without the machine's instructions.
    let mut found = [f32::INFINITY; 16];
    for i in 0..16 {
        if let Some(&depth) = depths.get(index[i] as usize) {
            found[i] = depth;
        }
    }
    f32x16::load_array(simd, found)
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
