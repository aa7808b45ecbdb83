use glam::{DVec3, UVec2};

/// Most columns or rows of a map.
const MOST_TEXELS: u32 = 32_768;

/// Why a view cannot be made. Each case names one fault, with the value that was given.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// A matrix of placement is not finite, or not a rotation and a shift.
    #[error("view placement is degenerate: {0}")]
    Placement(&'static str),
    /// A place or a direction has a coordinate that is NaN or infinite.
    #[error("view {what} {value} is not finite")]
    NotFinite {
        /// Which: `"eye"`, `"target"`, `"up"` or `"direction"`.
        what: &'static str,
        /// What was given.
        value: DVec3,
    },
    /// The eye and the target are equal, or so close together or far apart that no direction can be computed.
    #[error("view eye {eye} and target {target} give no direction of view: they {}", if eye == target { "are equal" } else { "are too close together or too far apart" })]
    NoDirection {
        /// Where the view stands.
        eye: DVec3,
        /// What it looks at.
        target: DVec3,
    },
    /// Up is zero, or parallel to the direction of view.
    #[error("view up {up} {}", if *up == DVec3::ZERO { "has no direction".to_owned() } else { format!("is parallel to the direction of view {ahead}") })]
    Up {
        /// What was given as up.
        up: DVec3,
        /// Unit direction of view.
        ahead: DVec3,
    },
    /// A field of view that is not within (0, π) radians.
    #[error("view field of view {radians} is not within (0, π) radians{}", degrees_hint(*radians))]
    FieldOfView {
        /// What was given as radians.
        radians: f64,
    },
    /// Half the height of an orthographic view is not positive and finite.
    #[error("view half height {0} is not positive and finite")]
    HalfHeight(f64),
    /// The scale of a projection is not positive and finite.
    #[error("view projection scale ({x}, {y}) is not positive and finite")]
    Scale {
        /// Scale in x.
        x: f64,
        /// Scale in y.
        y: f64,
    },
    /// The shift of a projection has a coordinate that is NaN or infinite.
    #[error("view projection shift ({x}, {y}) is not finite")]
    Shift {
        /// Shift in x.
        x: f64,
        /// Shift in y.
        y: f64,
    },
    /// A factor to scale a view by that is not positive and finite.
    #[error("view scale factor {0} is not positive and finite")]
    Factor(f64),
    /// The near distance is NaN or infinite.
    #[error("view near distance {0} is not finite")]
    Near(f64),
    /// The near distance is not above 0, as it must be in perspective.
    #[error("view near distance {0} is not above 0, as it must be in perspective")]
    NearAtEye(f64),
    /// The far distance is NaN or infinite.
    #[error("view far distance {0} is not finite")]
    Far(f64),
    /// The near distance is not below the far distance.
    #[error("view near distance {near} is not below its far distance {far}")]
    Range {
        /// Near distance.
        near: f64,
        /// Far distance.
        far: f64,
    },
    /// A cone of light the cosine of whose half-angle is not within [0, 1).
    #[error("cosine {0} of the half-angle of the view's cone is not within [0, 1)")]
    Cone(f64),
    /// A map side of 0 or more than 32,768 texels.
    #[error("view size {width} x {height} is not within 1..={MOST_TEXELS} texels on each side")]
    Size {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// A box to be seen that is not finite, whose corners are not in order, or that is a single point.
    #[error(
        "view bounds from {min} to {max} are not a finite box with min at or below max on each axis and some extent"
    )]
    Bounds {
        /// Corner of the smallest coordinates.
        min: DVec3,
        /// Corner of the largest coordinates.
        max: DVec3,
    },
    /// Fewer than three sectors around a light, or a sector that its margin makes 180° wide or more.
    #[error(
        "{count} sectors with half an angle of {half_radians} radians each: at least 3 are needed, each less than π wide"
    )]
    Sectors {
        /// Number of sectors.
        count: u32,
        /// Half of a sector's azimuth, with its margin.
        half_radians: f64,
    },
}

impl ViewError {
    /// [`ViewError::Size`] for a side of 0 or too many texels.
    pub(crate) fn of_size(size: UVec2) -> Result<(), Self> {
        if size.min_element() == 0 || size.max_element() > MOST_TEXELS {
            return Err(Self::Size { width: size.x, height: size.y });
        }
        Ok(())
    }

    /// [`ViewError::NotFinite`] for a coordinate that is NaN or infinite.
    pub(crate) fn of_finite(what: &'static str, value: DVec3) -> Result<(), Self> {
        if value.is_finite() { Ok(()) } else { Err(Self::NotFinite { what, value }) }
    }
}

fn degrees_hint(radians: f64) -> &'static str {
    if radians.is_finite() && radians > std::f64::consts::PI {
        "; it looks like degrees: use .to_radians()"
    } else {
        ""
    }
}
