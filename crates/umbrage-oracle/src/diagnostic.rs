use umbrage_depth::Stored;

/// Something about a light and a scene that will show in the picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Diagnostic {
    /// A caster that the light's view does not wholly hold: its shadow is cut off (Williams 1978; W78-8).
    #[error(
        "light {light:?}: object {object:?} casts but lies partly outside the light's view: its shadow is cut off there"
    )]
    CasterOutside {
        /// The light's name.
        light: String,
        /// The object's name.
        object: String,
    },
    /// Integer depth is too coarse at the farthest receiver (Williams 1978; W78-9).
    #[error(
        "light {light:?}: at distance {farthest} a step of {bits}-bit depth is {step} world units, more than half the bias {bias}: \
         raise the near plane, the bits or the bias"
    )]
    SeverePerspective {
        /// The light's name.
        light: String,
        /// Bits of the depth.
        bits: u32,
        /// Axial distance of the farthest receiver.
        farthest: f64,
        /// The quantisation step there, world units.
        step: f64,
        /// The bias, world units.
        bias: f64,
    },
    /// Under the midpoint rule a single sheet leaves nothing to compare with where its receiver is not in the map (Woo 1992; W92-9).
    #[error(
        "light {light:?}: sheet {object:?} loses its shadow under the midpoint rule on {receiver:?}, which does not cast: let the receiver cast"
    )]
    VanishedShadow {
        /// The light's name.
        light: String,
        /// The sheet's name.
        object: String,
        /// The receiver's name.
        receiver: String,
    },
    /// An open mesh that claims to bound a solid: back faces and second surfaces are missing (Wang & Molnar 1994; WM94-14).
    #[error("object {object:?} is flagged solid but its mesh is open: flag it two-sided, or its shadow may vanish")]
    OpenSolid {
        /// The object's name.
        object: String,
    },
    /// A caster's texels span more depth than it is thick: whatever is stored inside it shadows it (Wang & Molnar 1994; WM94-17).
    #[error(
        "light {light:?}: object {object:?} is {thickness:.4} world units thick where depth changes by {step:.4} over the filter: \
         a map of {side_needed} texels a side would do"
    )]
    TooThin {
        /// The light's name.
        light: String,
        /// The object's name.
        object: String,
        /// Along the light's axis, world units.
        thickness: f64,
        /// What depth may be wrong by there, world units: τ·slope·(filter half-extent + ½), summed over the map's axes.
        step: f64,
        /// Texels along the map's longer side that bring the step down to what is stored behind the surface; `u32::MAX`
        /// when none does.
        side_needed: u32,
    },
}

/// What a light's map is going to be used for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Bits of integer depth; `None` for floats.
    pub depth_bits: Option<u32>,
    /// The bias, world units.
    pub bias_world: f64,
    /// What the map keeps.
    pub stored: Stored,
    /// Tangent of the steepest angle between a caster's surface and the map's plane that must be free of error, ≥ 0 (WM94-17).
    /// 0 does not ask.
    pub slope: f64,
    /// Half-extent of the filter, texels.
    pub filter_half: f64,
}
