use glam::IVec2;
use umbrage_depth::DepthMap;

/// The grey of the farthest surface; what is beyond it and stays white is seen against it.
const FARTHEST: f32 = 0.75;

/// A map as a picture (Reeves 1987): linear grey, rows from the top, 0 at the nearest stored depth, rising in proportion to depth to
/// 0.75 at the farthest, 1 where nothing is stored. A map with one depth only is black there.
pub fn depth_view(map: &impl DepthMap) -> Vec<f32> {
    let size = map.view().size().as_ivec2();
    let texels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| IVec2::new(x, y)));
    let depths: Vec<f32> = texels.map(|texel| map.depth(texel)).collect();
    let finite = || depths.iter().copied().filter(|depth| depth.is_finite());
    let (nearest, farthest) = finite().fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), d| (a.min(d), b.max(d)));
    let grey = |depth: f32| {
        if !depth.is_finite() {
            1.0
        } else if farthest > nearest {
            // Halved first: the range of finite depths may itself not be finite.
            FARTHEST * ((0.5 * depth - 0.5 * nearest) / (0.5 * farthest - 0.5 * nearest))
        } else {
            0.0
        }
    };
    depths.into_iter().map(grey).collect()
}
