use super::NO_SLOPE;
use crate::about::{setting, source};
use crate::{About, Part};

pub(crate) const FILAMENT: About = About {
    name: "filament",
    title: "Filament, LightManager::ShadowOptions",
    version: "at the commits of its sources",
    sources: &[
        source("google/filament, filament/src/ShadowMap.cpp", "commit 0362f36ef6e6017426730cbbb68e7af1fda2f38c"),
        source("google/filament, filament/src/ShadowMapManager.cpp", "commit 003e5005713cba55cbd3f3a423c472000b96b868"),
        source(
            "google/filament, shaders/src/surface_shadowing.glsl",
            "commit 24a7bc2799eee5e5694b5df2adea457727ae25d8",
        ),
        source("google/filament, shaders/src/surface_getters.fs", "commit 24a7bc2799eee5e5694b5df2adea457727ae25d8"),
        source(
            "google/filament, filament/include/filament/LightManager.h",
            "commit 0769aabf294034a110b83894e5c120c92775ab1f",
        ),
        source("google/filament, shaders/src/surface_shadowing.fs", "commit 128523a2f98a1ba5fd111bd4b69963989d0054ba"),
        source(
            "google/filament, filament/src/components/LightManager.cpp",
            "commit 008b2816f882f339283614bb723ce7f5dc87f7c7",
        ),
    ],
    settings: &[
        setting(
            "constantBias",
            "world units along the light's axis",
            0.001,
            "moves casters away from the light; clamped to 0 to 2",
        ),
        setting(
            "normalBias",
            "half texels for a directional light, texels for a spot, at grazing light",
            1.0,
            "moves the receiver along its normal, times the sine of the angle to the light; clamped to 0 to 3",
        ),
        setting(
            "polygonOffsetConstant",
            "units of the depth format",
            0.5,
            "moves the depth of casters away from the light; 0 leaves it to constantBias, which is in world units",
        ),
        setting(
            "polygonOffsetSlope",
            "texels",
            2.0,
            "times the change of depth from texel to texel, moves the depth of casters away from the light",
        ),
    ],
    filter: "SHADOW_SAMPLING_PCF_LOW: 4 bilinear comparisons over 3 x 3 texels, the tent of Castano 2013; map of 1024 x 1024 with a border of \
             1 texel",
    note: "Maps are reversed, and a border leaves map_size - 2 texels for the light. Not for VSM, which has none of these biases, nor for \
           LiSPSM, whose texels differ over the map.",
    lacks: &[
        (Part::Constant, "constantBias is clamped to 0 to 2"),
        (Part::Normal, "the offset is nothing where the surface faces the light, and normalBias is clamped to 0 to 3"),
    ],
};

pub(crate) const BEVY: About = About {
    name: "bevy",
    title: "Bevy, DirectionalLight and SpotLight",
    version: "0.20.1",
    sources: &[
        source("bevy_pbr, src/render/shadows.wesl", "0.20.1"),
        source("bevy_pbr, src/render/light.rs", "0.20.1"),
        source("bevy_pbr, src/render/shadow_sampling.wesl", "0.20.1"),
        source("bevy_light, src/directional_light.rs, spot_light.rs, point_light.rs, cascade.rs, lib.rs", "0.20.1"),
    ],
    settings: &[
        setting(
            "shadow_depth_bias",
            "world units along the ray",
            0.02,
            "moves the receiver toward the light; a point light's default is 0.08",
        ),
        setting(
            "shadow_normal_bias",
            "texels times the square root of 2",
            1.8,
            "moves the receiver along its normal; a point light's default is 0.6",
        ),
    ],
    filter: "ShadowFilteringMethod::Gaussian: for directional and spot lights 9 bilinear comparisons over 5 x 5 texels (Castano 2013); maps of \
             2048 x 2048, of 1024 x 1024 for point lights",
    note: "A spot light's texel is taken at the receiver's distance along the axis, a cascade's is its own. Casters have no depth bias.",
    lacks: &[(Part::Slope, NO_SLOPE)],
};

pub(crate) const GODOT: About = About {
    name: "godot",
    title: "Godot 4, Forward+, DirectionalLight3D and SpotLight3D",
    version: "4, at the commits of its sources",
    sources: &[
        source(
            "godotengine/godot, servers/rendering/renderer_rd/storage_rd/light_storage.cpp",
            "commit 8403baa5a1e36485516c769a6393e056ed55192a",
        ),
        source(
            "godotengine/godot, servers/rendering/renderer_scene_cull.cpp",
            "commit 0001ea78a2d5ad6739dccaacf84ca89aa2f5ca7f",
        ),
        source(
            "godotengine/godot, servers/rendering/renderer_rd/shaders/scene_forward_lights_inc.glsl",
            "commit 8bae2a49c6fb4ac65abbe9d0b5265fcb06e8b1d7",
        ),
        source(
            "godotengine/godot, servers/rendering/renderer_rd/shaders/forward_clustered/scene_forward_clustered.glsl, BIAS_FUNC",
            "commit 333f0f910f164851218c5ece26d4c4b4931d4a30",
        ),
        source("godotengine/godot, doc/classes/Light3D.xml", "commit 04e491c0297a4dddadf85d4b42d676d7fd95e7d7"),
    ],
    settings: &[
        setting(
            "shadow_bias",
            "hundredths of the depth range times the filter's radius; for a spot light hundredths of its range over the distance, a step of depth \
             times the distance along the axis",
            0.1,
            "moves the receiver toward the light",
        ),
        setting(
            "shadow_normal_bias",
            "texels for a directional light; for a spot light 10 / map size of the distance from the light, times 1 - N.L",
            2.0,
            "moves the receiver along its normal; a directional light's keeps its depth, which is a negative constant part here",
        ),
    ],
    filter: "Soft Low: 4 bilinear comparisons on a disc of radius 2 texels (times shadow_blur, 1), turned at random at each pixel; Soft Medium 8 \
             and 2, High 16 and 3, Ultra 32 and 4; directional map of 4096 x 4096",
    note: "A spot light's near and far planes must be Godot's own, its far plane the light's range; its step of depth is taken at the receiver \
           before the offset. Of an omni light nothing is converted.",
    lacks: &[
        (Part::Slope, NO_SLOPE),
        (Part::Normal, "a spot light's offset is nothing where the surface faces the light"),
    ],
};
