use crate::About;
use crate::about::{source, unknown};

pub(crate) const UNREAL: About = About {
    name: "unreal",
    title: "Unreal Engine, ULightComponent",
    version: "5.5",
    sources: &[
        source("dev.epicgames.com, API, ULightComponent::ShadowBias", "5.5"),
        source("dev.epicgames.com, API, ULightComponent::ShadowSlopeBias", "5.5"),
    ],
    settings: &[
        unknown(
            "ShadowBias",
            "none that is documented, from 0 to 1",
            "how far from its caster a shadow begins; the documentation calls 0.5 a good tradeoff",
        ),
        unknown(
            "ShadowSlopeBias",
            "none that is documented, from 0 to 1",
            "in addition, by the slope of a surface; the documentation calls 0.5 a good tradeoff",
        ),
    ],
    filter: "the documentation gives no kernel; both biases also affect the soft transition of shadows",
    note: "the engine's documentation gives its bias settings no formula, and its sources are under a licence of their own",
    lacks: &[],
};
