use super::{NO_NORMAL, NO_SLOPE};
use crate::about::{setting, source};
use crate::{About, Part};

pub(crate) const RSL: About = About {
    name: "rsl",
    title: "RenderMan Shading Language, shadow() as Aqsis has it",
    version: "Aqsis, at the commits of its sources",
    sources: &[
        source(
            "aqsis/aqsis, include/aqsis/tex/filtering/sampleaccum.h, CqPcfAccum::accumulate",
            "commit 7dd6ee3d4ce669582551b2357580fbbb90ee3b0a",
        ),
        source(
            "aqsis/aqsis, include/aqsis/tex/filtering/texturesampleoptions.h, CqShadowSampleOptions",
            "commit 065c4c0eab389856610e36f9d5b28d7814fa4e57",
        ),
        source(
            "aqsis/aqsis, libs/tex/filtering/shadowsampler.cpp, CqShadowSampler::sample",
            "commit 0a7749c9aef06af3690ecbe74ff1379b26cd4348",
        ),
    ],
    settings: &[
        setting(
            "bias0",
            "world units along the light's axis",
            0.0,
            "below this a sample is lit; between both the shadow is a ramp",
        ),
        setting("bias1", "world units along the light's axis", 0.0, "from this on a sample is dark"),
    ],
    filter: "percentage-closer filter over the region of a shading sample, an elliptical Gaussian (EWA) cut off at 2, at least 2 texels \
             wide: every texel of its support where these are no more than samples (32), else so many at random; width 1, blur 0, \
             both in s and t, blur as a fraction of the map's side",
    note: "The receiver's depth is a plane over the region, so that slopes within it need no bias. With equal biases they are one constant \
           bias; Reeves' own draws each sample's from bias0..bias1 at random.",
    lacks: &[(Part::Slope, NO_SLOPE), (Part::Normal, NO_NORMAL)],
};
