use umbrage_depth::DepthMap;
use umbrage_plane::Projection;
use umbrage_sample::Disc;
use umbrage_shadow::{BiasCone, Filter, Met, Probe, Query, Simd};

/// Percentage-closer soft shadows: the farther the occluders, the wider the blur.
#[derive(Clone, Copy, Debug)]
pub struct Pcss {
    /// Where occluders are searched and the shadow is looked up.
    pub taps: Disc,
    /// Which depth is compared.
    pub depth: BiasCone,
    /// Width of the light, in texels of the map.
    pub light: f32,
}

impl Filter for Pcss {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32 {
        let own = query.receiver().depth;
        let (mut sum, mut weight) = (0.0, 0.0);
        let search = query.region_around(glam::Vec2::splat(self.light));
        query.each(&search, &self.taps, &self.depth, |seen| {
            // Places outside the map or the cone hold no occluder; `share` settles them below.
            let Met::Surfaces(surfaces) = &seen.met else { return };
            for (depth, stopped) in surfaces.iter().filter(|(depth, _)| *depth < seen.compared) {
                sum += depth * stopped;
                weight += stopped;
            }
        });
        // Parallel light has no distance: the gap to the occluders is compared with the map's width.
        let mean = sum / weight;
        let from = match query.view().projection() {
            Projection::Perspective { .. } => mean,
            Projection::Orthographic { half, .. } => 2.0 * half.max_element() as f32,
        };
        let width = if weight > 0.0 { self.light * ((own - mean) / from).max(0.0) } else { 0.0 };
        query.share(&query.region_around(glam::Vec2::splat(width.max(0.5))), &self.taps, &self.depth)
    }
}
