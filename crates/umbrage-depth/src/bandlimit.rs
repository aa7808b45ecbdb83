use crate::{DepthMap, Raw};
use umbrage_plane::TexelRect;

/// The map with every depth replaced by the mean over the (2·`radius` + 1)² texels around it: the light's depth bandlimited
/// before it is looked up (Williams 1978).
///
/// A negative control, known not to help: a mean of depths is the depth of no surface, which is why percentage-closer
/// filtering compares first. Texels without a surface stay so and are left out of every mean.
#[must_use]
pub fn bandlimit(map: &Raw, radius: u16) -> Raw {
    let radius = i32::from(radius);
    map.replaced(|texel, depth| {
        if depth == f32::INFINITY {
            return depth;
        }
        let around = TexelRect::new(texel - radius, texel + radius + 1).texels();
        let finite = around.map(|texel| map.depth(texel)).filter(|depth| *depth < f32::INFINITY);
        let (sum, count) = finite.fold((0.0, 0.0), |(sum, count), depth| (sum + f64::from(depth), count + 1.0));
        (sum / count) as f32
    })
}
