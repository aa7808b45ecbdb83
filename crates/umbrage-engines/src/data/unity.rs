use crate::about::{setting, source};
use crate::{About, Part};

pub(crate) const URP: About = About {
    name: "urp",
    title: "Unity, Universal Render Pipeline",
    version: "at the commits of its sources",
    sources: &[
        source(
            "Unity-Technologies/Graphics, Packages/com.unity.render-pipelines.universal/Runtime/ShadowUtils.cs, GetShadowBias",
            "commit b850b71a2d0323a9702b331f5e573cfe8a5e68c5",
        ),
        source(
            "Unity-Technologies/Graphics, Packages/com.unity.render-pipelines.universal/ShaderLibrary/Shadows.hlsl, ApplyShadowBias",
            "commit 7023b7421472871574aca464b30ee8b6dbacf18c",
        ),
        source(
            "Unity-Technologies/Graphics, Packages/com.unity.render-pipelines.universal/Runtime/Data/UniversalRenderPipelineAsset.cs",
            "commit 2aa675fe947280b46a1f9f86f683c71cee7292e8",
        ),
    ],
    settings: &[
        setting(
            "depth bias",
            "texels times the filter's radius, along the ray",
            1.0,
            "moves casters away from the light; clamped to 0 to 10",
        ),
        setting(
            "normal bias",
            "texels times the filter's radius, at grazing light",
            1.0,
            "moves casters inward along their normals, times 1 - N.L; clamped to 0 to 10",
        ),
    ],
    filter: "hard shadows by default: one bilinear comparison of 2 x 2 texels; soft ones of medium quality 5 x 5 texels, of low 3 x 3, of high 7 x 7, \
             by which the biases are multiplied by 2.5, 1.5 and 3.5",
    note: "A spot light's texel is half of one at its far plane, whatever the receiver's distance. Point lights have no normal bias.",
    lacks: &[
        (Part::Constant, "depth bias is clamped to 0 to 10, and one unit of the depth format is always added"),
        (Part::Slope, "a slope of 2.5 texels is always added, and cannot be set"),
        (
            Part::Normal,
            "the offset is nothing where the surface faces the light, and normal bias is clamped to 0 to 10",
        ),
    ],
};

pub(crate) const HDRP: About = About {
    name: "hdrp",
    title: "Unity, High Definition Render Pipeline",
    version: "at the commits of its sources",
    sources: &[
        source(
            "Unity-Technologies/Graphics, Packages/com.unity.render-pipelines.high-definition/Runtime/Lighting/Shadow/HDShadowAlgorithms.hlsl",
            "commit 1618c8156be38551ae30ede5b15e502bb5323d25",
        ),
        source(
            "Unity-Technologies/Graphics, .../Runtime/Lighting/Shadow/HDShadowUtils.cs, GetSlopeBias",
            "commit c9ae81ff1f4e4e0b955b5eb4f0ce55a7dbad9128",
        ),
        source(
            "Unity-Technologies/Graphics, .../Runtime/Lighting/Shadow/HDShadowAtlas.cs, SetGlobalDepthBias",
            "commit 6a723fffdc88ad8ccc6793c790a2c5a71638750f",
        ),
        source(
            "Unity-Technologies/Graphics, .../Runtime/Lighting/Light/HDAdditionalLightData.cs, SetCommonShadowRequestSettings and defaults",
            "commit 5fa8b26fd33df55339214c7f82b827f3060c0161",
        ),
    ],
    settings: &[
        setting(
            "normalBias",
            "texels times the square root of 2, a spot light's at its distance from the light",
            0.75,
            "moves the receiver along its normal",
        ),
        setting(
            "slopeBias",
            "five texels",
            0.5,
            "times the change of depth from texel to texel, moves the depth of casters away from the light; not for PCSS, where it is more",
        ),
    ],
    filter: "medium quality: a tent of 5 x 5 texels for spot and point lights, of 7 x 7 for directional ones; low 3 x 3 and 5 x 5, high PCSS",
    note: "A constant part is fixed: 1/65536 of depth from 0 to 1, and one unit of the depth format.",
    lacks: &[(Part::Constant, "the constant part is fixed: 1/65536 of depth, and one unit of the depth format")],
};
