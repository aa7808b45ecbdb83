use super::NO_SLOPE;
use crate::about::{setting, source};
use crate::{About, Part};

pub(crate) const THREE: About = About {
    name: "three",
    title: "three.js, WebGLRenderer",
    version: "r187",
    sources: &[
        source("three, src/renderers/shaders/ShaderChunk/shadowmap_pars_fragment.glsl.js", "0.187.0 (r187)"),
        source("three, src/renderers/shaders/ShaderChunk/shadowmap_vertex.glsl.js", "0.187.0 (r187)"),
        source("three, src/lights/LightShadow.js", "0.187.0 (r187)"),
        source("three, src/renderers/webgl/WebGLShadowMap.js", "0.187.0 (r187)"),
    ],
    settings: &[
        setting(
            "bias",
            "depth from 0 at the near plane to 1 at the far one",
            0.0,
            "added to the receiver's depth, so that it is negative toward the light; reversed depth is taken care of",
        ),
        setting("normalBias", "world units", 0.0, "moves the receiver along its normal"),
    ],
    filter: "PCFShadowMap: 5 samples on a Vogel disc of radius 1 texel (radius), turned by interleaved gradient noise at each pixel, each a \
             bilinear comparison of 2 x 2 texels; map of 512 x 512",
    note: "For a spot light depth is that of its perspective, so that bias is exact at one distance. A cube face of a point light has the \
           same depth. Single-sided materials cast with their back faces unless shadowSide says otherwise.",
    lacks: &[(Part::Slope, NO_SLOPE)],
};

pub(crate) const BABYLON: About = About {
    name: "babylon",
    title: "Babylon.js, ShadowGenerator",
    version: "9.35",
    sources: &[
        source("@babylonjs/core, Shaders/ShadersInclude/shadowMapVertexMetric.js", "9.35.0"),
        source("@babylonjs/core, Shaders/ShadersInclude/shadowMapVertexNormalBias.js", "9.35.0"),
        source("@babylonjs/core, Shaders/ShadersInclude/shadowsFragmentFunctions.js", "9.35.0"),
        source("@babylonjs/core, Lights/Shadows/shadowGenerator.js", "9.35.0"),
        source("@babylonjs/core, Lights/spotLight.pure.js and directionalLight.pure.js, getDepthMinZ", "9.35.0"),
    ],
    settings: &[
        setting(
            "bias",
            "fractions of the way from the near plane to the far one; with a depth texture twice the depth from 0 to 1",
            0.000_05,
            "added to the depth of casters",
        ),
        setting(
            "normalBias",
            "world units at grazing light",
            0.0,
            "moves casters inward along their normals, times the sine of the angle between the normal and the direction to the light",
        ),
    ],
    filter: "FILTER_NONE: one nearest texel. FILTER_PCF, of high quality by default: 5 x 5 texels by bilinear comparisons; 3 x 3 for medium, \
             one for low",
    note: "Without a depth texture bias is linear for spot lights too. The cube map of a point light stores distances from the light \
           divided by near + far, which is not converted here.",
    lacks: &[(Part::Slope, NO_SLOPE), (Part::Normal, "the offset is nothing where the surface faces the light")],
};
