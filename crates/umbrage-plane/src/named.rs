use crate::{Projection, Rules, View, ViewError, look_at, up_for};
use glam::{DMat3, DMat4, DVec2, DVec3, UVec2};

/// By what fraction of its diagonal a box is widened on each side by [`View::directional`], so that its surface is inside.
const MARGIN: f64 = 1.0 / 1024.0;

/// A spot light by names, for [`View::spot`].
///
/// ```
/// use glam::{DVec3, UVec2};
/// use umbrage_plane::{SpotView, View};
///
/// let lamp = View::spot(SpotView {
///     eye: DVec3::new(0.0, 10.0, 0.0),
///     target: DVec3::ZERO,
///     full_angle_radians: 60f64.to_radians(),
///     size: UVec2::splat(512),
///     ..SpotView::default()
/// })?;
/// assert_eq!(lamp.ahead(), DVec3::NEG_Y);
/// # Ok::<(), umbrage_plane::ViewError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotView {
    /// Where the light stands, in world space.
    pub eye: DVec3,
    /// A place on its axis, in the world; not the eye.
    pub target: DVec3,
    /// The direction in world space, of any length but 0, that is up on its map; `None` stands for [`up_for`] its direction.
    pub up: Option<DVec3>,
    /// Angle from edge to edge of its cone, radians, within (0, π). The cone touches the upper and lower side of the map.
    pub full_angle_radians: f64,
    /// Distance of the near plane, world units, above 0.
    pub near: f64,
    /// Distance of the far plane, world units, above `near`.
    pub far: f64,
    /// Columns and rows of its map, each within 1..=32768. Texels are square.
    pub size: UVec2,
}

impl Default for SpotView {
    /// At the origin, looking down −z, 90° wide, from 0.1 to 1000 world units, with 1024 × 1024 texels.
    fn default() -> Self {
        Self {
            eye: DVec3::ZERO,
            target: DVec3::NEG_Z,
            up: None,
            full_angle_radians: std::f64::consts::FRAC_PI_2,
            near: 0.1,
            far: 1000.0,
            size: UVec2::splat(1024),
        }
    }
}

impl View {
    /// A spot light: nothing leaves it outside its cone, so that all is dark there and behind it ([`Rules::SPOT`]; Woo 1992).
    ///
    /// # Errors
    /// As [`View::perspective`].
    pub fn spot(spot: SpotView) -> Result<Self, ViewError> {
        let SpotView { eye, target, up, full_angle_radians, near, far, size } = spot;
        let up = up.unwrap_or_else(|| up_for(target - eye));
        Self::perspective(eye, target, up, full_angle_radians, near, far, size)?
            .with_rules(Rules::SPOT)
            .with_cone(Some((0.5 * full_angle_radians).cos()))
    }

    /// A light at infinity in the direction `toward_light` (from the scene to the light, of any length but 0), whose map just
    /// holds a box of the world. `bounds` are the box's corners of smallest and of largest coordinates.
    ///
    /// The box is widened by 1/1024 of its diagonal on every side, so that its surface lies inside the map and between the near
    /// and the far plane. It may be flat. The map's up is [`up_for`] the light's direction; its texels need not be square.
    /// Outside the map all is lit ([`Rules::OPEN`]).
    ///
    /// # Errors
    /// [`ViewError::NotFinite`] or [`ViewError::NoDirection`] for the direction, [`ViewError::Bounds`] for the box, and as
    /// [`View::new`].
    pub fn directional(toward_light: DVec3, bounds: [DVec3; 2], size: UVec2) -> Result<Self, ViewError> {
        let [min, max] = bounds;
        let diagonal = (max - min).length();
        if !(min.is_finite() && max.is_finite() && min.cmple(max).all() && diagonal > 0.0 && diagonal.is_finite()) {
            return Err(ViewError::Bounds { min, max });
        }
        ViewError::of_finite("direction", toward_light)?;
        let no_direction = ViewError::NoDirection { eye: toward_light, target: DVec3::ZERO };
        let toward = toward_light.try_normalize().ok_or(no_direction)?;
        let axes = look_at(DVec3::ZERO, -toward, up_for(toward))?;
        let margin = diagonal * MARGIN;
        // Half the box's width along an axis of the view: what each of its three edges adds there.
        let half = DMat3::from_mat4(axes).abs() * ((max - min) * 0.5) + margin;
        let centre = min + (max - min) * 0.5;
        // One margin in front of the near plane, which no depth needs but which keeps it positive.
        let world_to_eye = axes * DMat4::from_translation(-(centre + toward * (half.z + margin)));
        let far = 2.0 * half.z + margin;
        Self::new(world_to_eye, Projection::orthographic(DVec2::new(half.x, half.y)), margin, far, size)
    }
}
