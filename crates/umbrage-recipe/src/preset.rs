use crate::engine::EngineBias;
use crate::pattern::PatternName;
use umbrage_depth::Stored;
use umbrage_engines::Engine;
use umbrage_plane::Bias;
use umbrage_shadow::presets;

/// An engine's kernel and its default bias.
pub struct ByEngine {
    pub bias: EngineBias,
    pub pattern: PatternName,
    /// Half-extent of the region, texels.
    pub half: f32,
    /// Samples of patterns that have a number of them.
    pub samples: u32,
}

/// The name that a recipe begins with: a paper's algorithm, or a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PresetName {
    /// Facets and two planes, without a bias: the default.
    Auto,
    /// Point by point (Williams 1978).
    Williams78,
    /// Percentage closer, biases of a range (Reeves, Salesin & Cook 1987), as the listing sets its parameters.
    Reeves87,
    /// The same with the values that the paper's text advises.
    Reeves87Recommended,
    /// Percentage closer without a bias over midpoints (Woo 1992).
    Woo92,
    /// The nearest four texels of second surfaces, and the tangent plane where they disagree (Wang & Molnar 1994).
    WangMolnar94,
    /// Soft shadows with the bias cone (Burley 2006).
    Burley,
    /// Soft shadows with a plain mean and a constant bias (Fernando 2005, as Burley describes it).
    Fernando,
    /// Depths filtered first: the control of Reeves 1987, §3.
    Ordinary,
    /// Variance shadow maps (Donnelly & Lauritzen 2006).
    Vsm,
    /// Exponential shadow maps (Annen et al. 2008).
    Esm,
    /// Exponential variance shadow maps of two channels (Lauritzen & McCool 2008).
    Evsm2,
    /// The same of four channels.
    Evsm4,
    /// Moment shadow maps (Peters & Klein 2015).
    Msm,
    /// three.js, `PCFShadowMap`: five bilinear comparisons on a disc, over back faces.
    ThreePcf,
    /// three.js, `VSMShadowMap`: a mean and a deviation of a box of texels, and Chebyshev's inequality.
    ThreeVsm,
    /// Babylon.js, `FILTER_NONE`: the nearest texel.
    BabylonNone,
    /// Babylon.js, `FILTER_PCF` of high quality: Castaño's 5 × 5 texels.
    BabylonPcf,
    /// Filament, `PCF`: Castaño's 3 × 3 texels.
    FilamentPcf,
    /// Bevy, `Gaussian`: Castaño's 5 × 5 texels.
    BevyGaussian,
    /// Godot 4, `Soft Low`: four bilinear comparisons on a disc.
    GodotPcf,
    /// Unity's Universal Render Pipeline, hard shadows: one bilinear comparison.
    UrpHard,
    /// Unity's Universal Render Pipeline, soft shadows of medium quality: a tent of 5 × 5 texels.
    UrpSoft,
    /// Unity's High Definition Render Pipeline, medium quality, spot lights: a tent of 5 × 5 texels.
    HdrpPcf5,
    /// Unity's High Definition Render Pipeline, medium quality, directional lights: a tent of 7 × 7 texels.
    HdrpPcf7,
    /// Unity's High Definition Render Pipeline, high quality: soft shadows by the size of the light.
    HdrpPcss,
}

impl PresetName {
    /// All of them.
    pub const ALL: [Self; 26] = [
        Self::Auto,
        Self::Williams78,
        Self::Reeves87,
        Self::Reeves87Recommended,
        Self::Woo92,
        Self::WangMolnar94,
        Self::Burley,
        Self::Fernando,
        Self::Ordinary,
        Self::Vsm,
        Self::Esm,
        Self::Evsm2,
        Self::Evsm4,
        Self::Msm,
        Self::ThreePcf,
        Self::ThreeVsm,
        Self::BabylonNone,
        Self::BabylonPcf,
        Self::FilamentPcf,
        Self::BevyGaussian,
        Self::GodotPcf,
        Self::UrpHard,
        Self::UrpSoft,
        Self::HdrpPcf5,
        Self::HdrpPcf7,
        Self::HdrpPcss,
    ];

    /// The defaults of engines among them.
    pub const ENGINES: [Self; 12] = [
        Self::ThreePcf,
        Self::ThreeVsm,
        Self::BabylonNone,
        Self::BabylonPcf,
        Self::FilamentPcf,
        Self::BevyGaussian,
        Self::GodotPcf,
        Self::UrpHard,
        Self::UrpSoft,
        Self::HdrpPcf5,
        Self::HdrpPcf7,
        Self::HdrpPcss,
    ];

    /// The word for it in recipes.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Williams78 => "williams78",
            Self::Reeves87 => "reeves87",
            Self::Reeves87Recommended => "reeves87-recommended",
            Self::Woo92 => "woo92",
            Self::WangMolnar94 => "wang-molnar94",
            Self::Burley => "burley",
            Self::Fernando => "fernando",
            Self::Ordinary => "ordinary",
            Self::Vsm => "vsm",
            Self::Esm => "esm",
            Self::Evsm2 => "evsm2",
            Self::Evsm4 => "evsm4",
            Self::Msm => "msm",
            Self::ThreePcf => "three-pcf",
            Self::ThreeVsm => "three-vsm",
            Self::BabylonNone => "babylon-none",
            Self::BabylonPcf => "babylon-pcf",
            Self::FilamentPcf => "filament-pcf",
            Self::BevyGaussian => "bevy-gaussian",
            Self::GodotPcf => "godot-pcf",
            Self::UrpHard => "urp-hard",
            Self::UrpSoft => "urp-soft",
            Self::HdrpPcf5 => "hdrp-pcf5",
            Self::HdrpPcf7 => "hdrp-pcf7",
            Self::HdrpPcss => "hdrp-pcss",
        }
    }

    /// What it does, in a few words for a list.
    #[must_use]
    pub const fn about(self) -> &'static str {
        match self {
            Self::Auto => "facets and two planes, without a bias: the default",
            Self::Williams78 => "point by point (Williams 1978)",
            Self::Reeves87 => "percentage closer, biases of a range (Reeves, Salesin & Cook 1987)",
            Self::Reeves87Recommended => "the same with the numbers that the paper's text advises",
            Self::Woo92 => "percentage closer without a bias, over midpoints (Woo 1992)",
            Self::WangMolnar94 => "second surfaces, and tangent planes where texels disagree (Wang & Molnar 1994)",
            Self::Burley => "soft shadows with the bias cone (Burley 2006)",
            Self::Fernando => "soft shadows with a plain mean and a constant bias (Fernando 2005)",
            Self::Ordinary => "depths filtered before they are compared, which is wrong: a control",
            Self::Vsm => "variance shadow maps (Donnelly & Lauritzen 2006)",
            Self::Esm => "exponential shadow maps (Annen et al. 2008)",
            Self::Evsm2 => "exponential variance shadow maps of two channels (Lauritzen & McCool 2008)",
            Self::Evsm4 => "the same of four channels",
            Self::Msm => "moment shadow maps (Peters & Klein 2015)",
            Self::ThreePcf => "three.js, PCFShadowMap: five bilinear comparisons on a disc, over back faces",
            Self::ThreeVsm => "three.js, VSMShadowMap: mean and deviation of a box of texels, Chebyshev's inequality",
            Self::BabylonNone => "Babylon.js, FILTER_NONE: the nearest texel",
            Self::BabylonPcf => "Babylon.js, FILTER_PCF, high quality: Castaño's 5 x 5 texels",
            Self::FilamentPcf => "Filament, PCF: Castaño's 3 x 3 texels",
            Self::BevyGaussian => "Bevy, Gaussian: Castaño's 5 x 5 texels",
            Self::GodotPcf => "Godot 4, Soft Low: four bilinear comparisons on a disc",
            Self::UrpHard => "Unity URP, hard shadows: one bilinear comparison",
            Self::UrpSoft => "Unity URP, soft shadows, medium quality: a tent of 5 x 5 texels",
            Self::HdrpPcf5 => "Unity HDRP, medium quality, spot lights: a tent of 5 x 5 texels",
            Self::HdrpPcf7 => "Unity HDRP, medium quality, directional lights: a tent of 7 x 7 texels",
            Self::HdrpPcss => "Unity HDRP, high quality: soft shadows by the size of the light",
        }
    }

    /// The engine whose default it is; `None` for the papers' and Umbrage's own.
    #[must_use]
    pub fn engine(self) -> Option<Engine> {
        self.by_engine().map(|by| by.bias.engine())
    }

    /// The parts of an engine's preset.
    pub(crate) const fn by_engine(self) -> Option<ByEngine> {
        use EngineBias as Bias;
        use PatternName::{AreaTent, Castano5, Centre, Tent, Vogel};
        let (bias, pattern, half, samples) = match self {
            Self::ThreePcf => (Bias::Three, Vogel, 2.0, 5),
            // Looked up once, in a map that is filtered beforehand.
            Self::ThreeVsm => (Bias::Three, Centre, 0.0, 1),
            Self::BabylonNone => (Bias::Babylon, Centre, 0.0, 1),
            Self::BabylonPcf => (Bias::BabylonPcf, Castano5, 3.0, 1),
            Self::FilamentPcf => (Bias::Filament, Tent, 2.0, 1),
            Self::BevyGaussian => (Bias::Bevy, Castano5, 3.0, 1),
            Self::GodotPcf => (Bias::Godot, Vogel, 3.0, 4),
            Self::UrpHard => (Bias::Urp, Tent, 1.0, 1),
            Self::UrpSoft => (Bias::UrpSoft, AreaTent, 3.0, 1),
            Self::HdrpPcf5 => (Bias::Hdrp, AreaTent, 3.0, 1),
            Self::HdrpPcf7 => (Bias::Hdrp, AreaTent, 4.0, 1),
            // The least disc, and the texels of its bilinear comparisons.
            Self::HdrpPcss => (Bias::HdrpPcss, Vogel, 1.5, 16),
            _ => return None,
        };
        Some(ByEngine { bias, pattern, half, samples })
    }

    /// Whether its maps are filtered before they are looked up.
    pub(crate) const fn is_prefiltered(self) -> bool {
        matches!(self, Self::Vsm | Self::Esm | Self::Evsm2 | Self::Evsm4 | Self::Msm | Self::ThreeVsm)
    }

    /// The one with this [`name`](Self::name); `None` for any other text.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.name() == name)
    }

    /// The surfaces for which the paper's comparison is right, as in [`umbrage_shadow::presets`].
    #[must_use]
    pub fn expects(self) -> &'static [Stored] {
        match self {
            Self::Auto => presets::auto().expects,
            Self::Williams78 => presets::williams78().expects,
            // Reeves' control is over the maps of his own filter.
            Self::Reeves87 | Self::Ordinary => presets::reeves87().expects,
            Self::Reeves87Recommended => presets::reeves87_recommended().expects,
            Self::Woo92 => presets::woo92().expects,
            Self::WangMolnar94 => presets::wang_molnar94().expects,
            Self::Burley => presets::burley().expects,
            Self::Fernando => presets::fernando(Bias::ZERO).expects,
            Self::Vsm => presets::vsm().expects,
            Self::Esm => presets::esm().expects,
            Self::Evsm2 => presets::evsm2().expects,
            Self::Evsm4 => presets::evsm4().expects,
            Self::Msm => presets::msm().expects,
            // The faces with which single-sided materials cast there.
            Self::ThreePcf => &[Stored::BackFace],
            Self::ThreeVsm
            | Self::BabylonNone
            | Self::BabylonPcf
            | Self::FilamentPcf
            | Self::BevyGaussian
            | Self::GodotPcf
            | Self::UrpHard
            | Self::UrpSoft
            | Self::HdrpPcf5
            | Self::HdrpPcf7
            | Self::HdrpPcss => &[Stored::First],
        }
    }
}
