//! Presets that share fields.

use crate::PresetName;

pub const AUTO: &[PresetName] = &[PresetName::Auto];

/// These presets and those of engines that are percentage closer in a few texels.
macro_rules! and_closer {
    ($($preset:ident),+ $(,)?) => {
        &[
            $(PresetName::$preset,)+
            PresetName::ThreePcf,
            PresetName::BabylonNone,
            PresetName::BabylonPcf,
            PresetName::FilamentPcf,
            PresetName::BevyGaussian,
            PresetName::GodotPcf,
            PresetName::UrpHard,
            PresetName::UrpSoft,
            PresetName::HdrpPcf5,
            PresetName::HdrpPcf7,
        ]
    };
}

/// These presets and those of engines.
macro_rules! and_engines {
    ($($preset:ident),+ $(,)?) => {
        and_closer![$($preset,)+ ThreeVsm, HdrpPcss]
    };
}

/// All presets whose map stores depths: which surface it stores can be chosen.
pub const STORING: &[PresetName] = and_engines![
    Williams78,
    Reeves87,
    Reeves87Recommended,
    Woo92,
    WangMolnar94,
    Burley,
    Fernando,
    Ordinary,
    Vsm,
    Esm,
    Evsm2,
    Evsm4,
    Msm,
];
pub const CLOSER: &[PresetName] = and_closer![Reeves87, Reeves87Recommended, Woo92];
pub const SOFT: &[PresetName] = &[PresetName::Burley, PresetName::Fernando];
pub const COMPARED: &[PresetName] = and_engines![Reeves87, Reeves87Recommended, Woo92, Burley, Fernando];
pub const PLANES: &[PresetName] = and_engines![Reeves87, Reeves87Recommended, Woo92, WangMolnar94, Burley, Fernando];
pub const REGIONS: &[PresetName] = and_closer![Reeves87, Reeves87Recommended, Woo92, WangMolnar94];
pub const FACTORS: &[PresetName] = and_closer![Reeves87, Reeves87Recommended, Woo92, WangMolnar94, Ordinary];
pub const CONDITIONAL: &[PresetName] = &[PresetName::WangMolnar94];
pub const WILLIAMS: &[PresetName] = &[PresetName::Williams78];
pub const SINGLE: &[PresetName] = &[
    PresetName::Williams78,
    PresetName::WangMolnar94,
    PresetName::Ordinary,
    PresetName::Vsm,
    PresetName::Esm,
    PresetName::Evsm2,
    PresetName::Evsm4,
    PresetName::Msm,
];
pub const PREFILTERED: &[PresetName] =
    &[PresetName::Vsm, PresetName::Esm, PresetName::Evsm2, PresetName::Evsm4, PresetName::Msm];
pub const MOMENTS: &[PresetName] =
    &[PresetName::Vsm, PresetName::Esm, PresetName::Evsm2, PresetName::Evsm4, PresetName::Msm, PresetName::ThreeVsm];
pub const VARIANCE: &[PresetName] = &[PresetName::Vsm, PresetName::Evsm2, PresetName::Evsm4, PresetName::ThreeVsm];
pub const DEVIATION: &[PresetName] = &[PresetName::ThreeVsm];
pub const HDRP: &[PresetName] = &[PresetName::HdrpPcss];
