//! Views that are made for what is looked at: windows about receivers, and several views for what one cannot hold.

use crate::{Kind, Place, Projection, Rules, View, ViewError};
use glam::{DMat3, DMat4, DVec2, DVec3, UVec2};

/// Directions about the axis in which windows are tried: every third degree of a quarter turn.
const TURNS: usize = 30;
const TURN: f64 = 3.0;

/// Texels that are left free at each side of a window, and one more that snapping takes.
const MARGIN: f64 = 1.5;

/// Widths of texels are powers of this: an eighth of an octave.
const LADDER: f64 = 8.0;

impl View {
    /// The same light with its map's window about those receivers, points of the world, that its map and its cone hold: what else the map shows matters
    /// to no receiver. Of windows turned by every third degree about the axis the one of least area; 1½ texels are left free around, and texels need not be
    /// square. Without such receivers, and where no window is smaller than the view's own, the view as it is.
    ///
    /// The axis stays where it is, so that cones survive. Texels are one of eight widths per octave and lie on multiples of it, so that a window that follows
    /// a moving camera keeps sampling the same places as long as it can: shadows do not shimmer.
    ///
    /// # Errors
    /// [`ViewError`] where no view has that window, as for receivers in places that are not finite.
    pub fn fitted(self, receivers: impl IntoIterator<Item = DVec3>) -> Result<Self, ViewError> {
        let axes: [DVec2; 2 * TURNS] = std::array::from_fn(|i| DVec2::from_angle((TURN * i as f64).to_radians()));
        let mut ranges = [(f64::INFINITY, f64::NEG_INFINITY); 2 * TURNS];
        for at in receivers {
            let eye = self.world_to_eye.transform_point3(at);
            if self.is_perspective() && (eye.z >= 0.0 || eye.z.is_nan()) {
                continue;
            }
            if self.locate(self.eye_to_texel(eye).as_vec2()) != Place::Inside {
                continue;
            }
            let place = if self.is_perspective() { eye.truncate() / -eye.z } else { eye.truncate() };
            for (axis, (low, high)) in axes.iter().zip(&mut ranges) {
                let along = axis.dot(place);
                (*low, *high) = (low.min(along), high.max(along));
            }
        }
        if ranges[0].0 > ranges[0].1 {
            return Ok(self);
        }
        let (size, own) = (self.size.as_dvec2(), self.texel_world(1.0));
        // What one texel is wide where nothing is.
        let least = own / 1024.0;
        let window = |turn: usize| {
            let ((left, right), (low, high)) = (ranges[turn], ranges[turn + TURNS]);
            let needed = DVec2::new(right - left, high - low) / (size - (2.0 * MARGIN + 1.0)).max(DVec2::ONE);
            let texel = needed.max(least).map(|width| ((width.log2() * LADDER).ceil() / LADDER).exp2());
            let first = ((DVec2::new(left, low) - MARGIN * texel) / texel).floor() * texel;
            (texel, first)
        };
        let area = |turn: &usize| {
            let (texel, _) = window(*turn);
            texel.x * texel.y
        };
        let best = (0..TURNS).min_by(|a, b| area(a).total_cmp(&area(b))).unwrap_or(0);
        let (texel, first) = window(best);
        if texel.x * texel.y >= own.x * own.y {
            return Ok(self);
        }
        let half = texel * size * 0.5;
        let shift = -(first + half) / half;
        let projection = match self.projection {
            Projection::Perspective { .. } => Projection::Perspective { k: half.recip(), shift },
            Projection::Orthographic { .. } => Projection::Orthographic { half, shift },
        };
        let turned = DMat4::from_rotation_z(-(TURN * best as f64).to_radians()) * self.world_to_eye;
        Self::new(turned, projection, self.near, self.far, self.size).map(|view| view.alike(&self))
    }

    /// Five views in this perspective one's place that together see whatever lies before it, up to 90° from its axis: one ahead, 90° wide, and the
    /// nearer halves of four beside it, as the faces of a cube. What lies outside of one is compared, because a neighbour answers there
    /// ([`Rules::AROUND`]); they have no cone. Together they hold about as many texels as the view's own map, square ones.
    ///
    /// For spot lights so wide that one flat map cannot hold their cone, or wastes most of itself on its rim.
    ///
    /// # Errors
    /// [`ViewError`]; [`ViewError::Cone`] for a view that is not in perspective.
    pub fn faces_ahead(self) -> Result<[Self; 5], ViewError> {
        if !self.is_perspective() {
            return Err(ViewError::Cone(0.0));
        }
        let texels = self.size.as_dvec2();
        let side = ((texels.x * texels.y / 3.0).sqrt().ceil() as u32).next_multiple_of(2).max(2);
        let kind = if self.kind == Kind::Screen { Kind::Radial } else { self.kind };
        let face = |ahead: DVec3, up: DVec3, projection: Projection, size: UVec2| {
            let turn = DMat3::from_cols(ahead.cross(up), up, -ahead).transpose();
            let view = Self::new(DMat4::from_mat3(turn) * self.world_to_eye, projection, self.near, self.far, size)?;
            Ok(Self { kind, rules: Rules::AROUND, cone: None, ..view.alike(&self) })
        };
        let half = Projection::Perspective { k: DVec2::new(1.0, 2.0), shift: DVec2::new(0.0, -1.0) };
        let beside = |ahead| face(ahead, DVec3::NEG_Z, half, UVec2::new(side, side / 2));
        Ok([
            face(DVec3::NEG_Z, DVec3::Y, Projection::perspective(DVec2::ONE), UVec2::splat(side))?,
            beside(DVec3::X)?,
            beside(DVec3::NEG_X)?,
            beside(DVec3::Y)?,
            beside(DVec3::NEG_Y)?,
        ])
    }

    /// Whether a world point lies outside this perspective view's cone, or behind it; not for a view without a cone. Unlike
    /// [`View::locate`] it needs no map that holds the cone.
    #[inline(always)]
    pub fn beyond_cone(&self, at: DVec3) -> bool {
        let eye = self.world_to_eye.transform_point3(at);
        let Some(cos_half) = self.cone.filter(|_| self.is_perspective()) else { return false };
        eye.z >= 0.0 || eye.z * eye.z < cos_half * cos_half * eye.length_squared()
    }
}
