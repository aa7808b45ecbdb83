use super::NO_NORMAL;
use crate::about::{setting, source, whole};
use crate::{About, Part};

/// What the slope settings of all three interfaces do.
const SLOPE: &str = "times the change of depth from texel to texel, the larger of a row's and a column's, is added to the depth of casters; negative where \
                     depth is reversed";

/// What the constant settings of all three interfaces do.
const CONSTANT: &str = "units that are added to the depth of casters; negative where depth is reversed";

/// What the clamps of all three interfaces do.
const CLAMP: &str = "the most that the sum may be, or the least where it is negative; 0 means that there is no clamp";

/// What holds for all three interfaces.
const NOTE: &str = "A surface that rises along the map's diagonal has as little as 0.71 of the slope's part where the larger of a row's and a \
                    column's change counts. In perspective constant and slope are added as steps of depth: each is exact at the receiver for itself, \
                    the slope to first order.";

pub(crate) const D3D: About = About {
    name: "d3d",
    title: "Direct3D 11 and 12, rasterizer state",
    version: "11 and 12",
    sources: &[source(
        "learn.microsoft.com, win32/direct3d11/d3d10-graphics-programming-guide-output-merger-stage-depth-bias",
        "Direct3D 11",
    )],
    settings: &[
        whole("DepthBias", "units r of the depth format", 0.0, CONSTANT),
        setting("SlopeScaledDepthBias", "texels", 0.0, SLOPE),
        setting("DepthBiasClamp", "depth from 0 to 1", 0.0, CLAMP),
    ],
    filter: "none of its own",
    note: NOTE,
    lacks: &[(Part::Normal, NO_NORMAL)],
};

pub(crate) const VULKAN: About = About {
    name: "vulkan",
    title: "Vulkan, rasterization state",
    version: "1.3",
    sources: &[source(
        "KhronosGroup/Vulkan-Docs, chapters/primsrast.adoc, Depth Bias Computation",
        "1.3, commit 012db30fd16929f9fd30dfbc2a7c86e048d64015",
    )],
    settings: &[
        setting("depthBiasConstantFactor", "units r of the depth format", 0.0, CONSTANT),
        setting("depthBiasSlopeFactor", "texels", 0.0, SLOPE),
        setting("depthBiasClamp", "depth from 0 to 1", 0.0, CLAMP),
    ],
    filter: "none of its own",
    note: "For whole numbers of n bits r is implementation-dependent: at most 2 x 2^-n, and 2^-n with depthBiasExact. The slope is the length of \
           the gradient, or as an approximation the larger of a row's and a column's change, as little as 0.71 of it.",
    lacks: &[(Part::Normal, NO_NORMAL)],
};

pub(crate) const WEB_GPU: About = About {
    name: "webgpu",
    title: "WebGPU, GPUDepthStencilState",
    version: "1",
    sources: &[
        source(
            "gpuweb/cts, src/webgpu/api/operation/rendering/depth_bias.spec.ts, which names Direct3D's formula as the one of WebGPU",
            "commit 2d85cd409b7c4ecc136e9b89c2eb0fb4cfdcca7e",
        ),
        source("dontcallmedom.github.io/webidlpedia, GPUDepthStencilState, for names and defaults", "WebGPU 1"),
        source(
            "learn.microsoft.com, win32/direct3d11/d3d10-graphics-programming-guide-output-merger-stage-depth-bias, for r of whole numbers",
            "Direct3D 11",
        ),
    ],
    settings: &[
        whole("depthBias", "units r of the depth format; depth24plus is 24 bits or a 32-bit float", 0.0, CONSTANT),
        setting("depthBiasSlopeScale", "texels", 0.0, SLOPE),
        setting("depthBiasClamp", "depth from 0 to 1", 0.0, CLAMP),
    ],
    filter: "none of its own",
    note: NOTE,
    lacks: &[(Part::Normal, NO_NORMAL)],
};
