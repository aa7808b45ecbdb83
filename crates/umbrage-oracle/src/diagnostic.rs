use umbrage_plane::Kind;

/// Something about a light and a scene that will show in the picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Diagnostic {
    /// A caster that the light's view does not wholly hold: its shadow is cut off (Williams 1978).
    #[error(
        "light {light:?}: object {object:?} casts but lies partly outside the light's view: its shadow is cut off there"
    )]
    CasterOutside {
        /// The light's name.
        light: String,
        /// The object's name.
        object: String,
    },
    /// Integer depth is too coarse at the farthest receiver (Williams 1978).
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
    /// The 24 bits of a float are too coarse for the farthest receiver in this kind of depth: narrow ranges far away in axial or
    /// radial depth, a near plane close to the light in screen depth.
    #[error(
        "light {light:?}: at distance {farthest} a float of {kind:?} depth is rounded to {step} world units, more than the {allowed} of half the bias or, without one, a \
         texel: {}",
        mend(*better)
    )]
    CoarseDepth {
        /// The light's name.
        light: String,
        /// What its map stores.
        kind: Kind,
        /// Axial distance of the farthest receiver.
        farthest: f64,
        /// From one float to the next there, world units.
        step: f64,
        /// Half the bias, or the side of a texel there without one, world units.
        allowed: f64,
        /// The kind that rounds to no more than that, if there is one.
        better: Option<Kind>,
    },
    /// The light stands inside a closed caster, a bulb or a shade: all that is outside of it is in its shadow, or, where its wall is
    /// nearer than 1/1024 of the near distance, lit through the hole that the near plane cuts.
    #[error(
        "light {light:?} stands inside the closed object {object:?}, whose nearest corner in front of it is at {nearest}: {}, so let the \
         object not cast",
        if *cut { "the near plane cuts a hole into it" } else { "everything outside is in its shadow" }
    )]
    Enclosed {
        /// The light's name.
        light: String,
        /// The object around it.
        object: String,
        /// Axial distance of the nearest of its corners in front of the light, world units.
        nearest: f64,
        /// Whether a corner is nearer than 1/1024 of the near distance, where triangles are cut off.
        cut: bool,
    },
    /// Casters are smaller than a texel where they are: they are met by chance, and their shadows come and go.
    #[error(
        "light {light:?}: {casters} of {of} casters are smaller than a texel, {object:?} for one, which is {size:.4} world units across \
         where a texel is {texel:.4}: use several views, a window fitted to the casters, or a map of {side_needed} texels a side"
    )]
    CoarseTexels {
        /// The light's name.
        light: String,
        /// Casters below a texel.
        casters: usize,
        /// All casters that the light has in front of it.
        of: usize,
        /// The caster with the largest texel for its size.
        object: String,
        /// Across, world units.
        size: f64,
        /// The larger side of a texel at its distance, world units.
        texel: f64,
        /// Texels along the map's longer side of which one is as small as the caster; `u32::MAX` when none is.
        side_needed: u32,
    },
    /// The bias is as large as what casts: shadows are lost, or start far behind what throws them.
    #[error(
        "light {light:?}: the bias of {bias} world units is more than half the size of {casters} of {of} casters, {object:?} for one, which \
         is {size:.6} across: give the bias in texels, or in the scene's own measure"
    )]
    LargeBias {
        /// The light's name.
        light: String,
        /// The bias, world units.
        bias: f64,
        /// Casters less than twice the bias across.
        casters: usize,
        /// All casters that the light has in front of it.
        of: usize,
        /// The smallest of them.
        object: String,
        /// Across, world units.
        size: f64,
    },
    /// Another surface lies so close behind a caster that what is stored between them shadows the caster: a rug on a floor, a
    /// floor that is drawn twice, boxes that touch (Woo 1992; Wang & Molnar 1994).
    #[error(
        "light {light:?}: {other:?} lies {gap:.6} world units behind {object:?} where depth changes by {step:.4} over the filter, so that \
         {object:?} shadows itself: store nearest surfaces with a bias, or back faces, or leave one of them out of the map"
    )]
    Stacked {
        /// The light's name.
        light: String,
        /// The object in front.
        object: String,
        /// What lies behind it; the same where a sheet lies on itself.
        other: String,
        /// Along the light's axis, world units; 0 for a duplicate.
        gap: f64,
        /// What depth may be wrong by there, as in [`Diagnostic::TooThin`].
        step: f64,
    },
    /// A sheet lies over itself, and the midpoint rule takes all of an object that faces one way for one surface: its shadow on itself is
    /// lost (Woo 1992).
    #[error(
        "light {light:?}: sheet {object:?} lies over itself, {gap:.4} world units apart at most, and same=surface takes both for one: its \
         shadow on itself is lost; use same=depth with one sub-sample, or make them two objects"
    )]
    LostFold {
        /// The light's name.
        light: String,
        /// The sheet's name.
        object: String,
        /// The largest distance between two folds, along the light's axis, world units.
        gap: f64,
    },
    /// Under the midpoint rule a single sheet leaves nothing to compare with where its receiver is not in the map (Woo 1992).
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
    /// An open mesh that claims to bound a solid: back faces and second surfaces are missing (Wang & Molnar 1994).
    #[error("object {object:?} is flagged solid but its mesh is open: flag it two-sided, or its shadow may vanish")]
    OpenSolid {
        /// The object's name.
        object: String,
    },
    /// A caster's texels span more depth than it is thick: whatever is stored inside it shadows it (Wang & Molnar 1994).
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

/// What to do about a kind of depth.
fn mend(better: Option<Kind>) -> String {
    match better {
        Some(kind) => format!("{kind:?} depth is fine enough"),
        None => "no kind is fine enough: bring the light nearer, or raise the near plane or the bias".into(),
    }
}
