//! What a deep map's file holds beside its view.

use umbrage_depth::{DeepMap, DepthMap, Step};
use umbrage_plane::TexelRect;

/// The attribute that holds the bound of a map's compression.
pub(super) const EPSILON: &str = "epsilon";

/// The channels of a map through which all light passes alike, in the order that files need.
pub(super) const GREY: [&str; 3] = ["A", "Z", "passes.Y"];

/// The channels of the others.
pub(super) const COLOUR: [&str; 8] = ["A", "AB", "AG", "AR", "Z", "passes.B", "passes.G", "passes.R"];

/// True when red, green and blue pass alike, bit for bit.
pub(super) fn is_grey(map: &DeepMap) -> bool {
    let texels = TexelRect::of_size(map.view().size()).texels();
    let grey = |step: &Step| step.passes.to_array().iter().all(|share| share.to_bits() == step.passes.x.to_bits());
    texels.flat_map(|texel| map.steps(texel)).all(grey)
}

/// All that a map holds beside its view, for its digest. Numbers of steps go in as their bits.
pub(super) fn numbers(map: &DeepMap) -> impl Iterator<Item = f32> {
    let texels = TexelRect::of_size(map.view().size()).texels();
    let texels = texels.flat_map(|texel| {
        let steps = map.steps(texel);
        let values = steps.iter().flat_map(|step| [step.depth, step.passes.x, step.passes.y, step.passes.z]);
        std::iter::once(f32::from_bits(steps.len() as u32)).chain(values)
    });
    std::iter::once(map.epsilon()).chain(texels)
}
