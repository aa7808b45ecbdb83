use umbrage_depth::Stored;
use umbrage_plane::Bias;
use umbrage_shadow::presets;

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
    /// The same as the text of the paper advises.
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
}

impl PresetName {
    /// All of them.
    pub const ALL: [Self; 14] = [
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
            Self::Ordinary => "depths filtered before they are compared: how it is not done",
            Self::Vsm => "variance shadow maps (Donnelly & Lauritzen 2006)",
            Self::Esm => "exponential shadow maps (Annen et al. 2008)",
            Self::Evsm2 => "exponential variance shadow maps of two channels (Lauritzen & McCool 2008)",
            Self::Evsm4 => "the same of four channels",
            Self::Msm => "moment shadow maps (Peters & Klein 2015)",
        }
    }

    /// The one with this [`name`](Self::name); `None` for any other text.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.name() == name)
    }

    /// The surfaces that the paper's comparison is right over, as [`umbrage_shadow::presets`] have them.
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
        }
    }
}
