//! Turning a light about what it shines at.

use crate::{Object, Scene};
use glam::{DMat3, DMat4, DQuat, DVec2, DVec3};
use umbrage_plane::{Projection, View, ViewError};

/// What is added around that which a widened map must hold, as a fraction.
const MARGIN: f64 = 1.0 / 1024.0;
/// The least distance at which a lamp is turned, as a share of half the diagonal of the box around all objects: one in the middle of a scene moves as well.
const LEAST: f64 = 0.25;

/// In which direction a light stands, seen from what it shines at; y is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bearing {
    /// From +x toward +z, degrees.
    pub azimuth_deg: f64,
    /// Above the horizon, degrees: 90 is straight above.
    pub elevation_deg: f64,
}

impl Bearing {
    /// Of a direction of any length but 0; straight above and below the azimuth is 0.
    pub fn of(direction: DVec3) -> Self {
        let out = direction.x.hypot(direction.z);
        let azimuth = if out <= 1e-12 * direction.y.abs() { 0.0 } else { direction.z.atan2(direction.x) };
        Self { azimuth_deg: azimuth.to_degrees(), elevation_deg: direction.y.atan2(out).to_degrees() }
    }

    /// The unit vector.
    pub fn direction(self) -> DVec3 {
        self.frame() * DVec3::X
    }

    /// The turn that takes +x there: up from the horizon first, then about y.
    fn frame(self) -> DQuat {
        DQuat::from_rotation_y(-self.azimuth_deg.to_radians()) * DQuat::from_rotation_z(self.elevation_deg.to_radians())
    }
}

impl Scene {
    /// The place that a light is turned about: on the axis of its view, of a sun in the middle between its near and far plane, otherwise as far
    /// along as the middle of the box around all objects, but at least a quarter of its radius away, and between the near and the far plane.
    pub fn pivot(&self, light: &View) -> DVec3 {
        let eye = light.eye_to_world().w_axis.truncate();
        let mut along = 0.5 * (light.near() + light.far());
        if light.is_perspective() {
            let bounds = self.objects.iter().flat_map(|object| self.hull(object)).fold(None, |known, at| {
                let (low, high): (DVec3, DVec3) = known.unwrap_or((at, at));
                Some((low.min(at), high.max(at)))
            });
            let middle = bounds.map(|(low, high)| {
                let least = LEAST * 0.5 * (high - low).length();
                light.ahead().dot((low + high) * 0.5 - eye).max(least)
            });
            along = middle.filter(|along| along.is_finite()).unwrap_or(along).clamp(light.near(), light.far());
        }
        eye + light.ahead() * along
    }

    /// A light's view turned about its [pivot](Self::pivot) until the light stands at a bearing, at the same distance. The view's up turns along, so that bearings
    /// near to each other give maps near to each other. The bearing that it has gives the view as it is.
    ///
    /// The map keeps its sides, near and far plane. Where these held all of an object before, they are widened until they hold it again; what
    /// the light's own view left out stays out.
    ///
    /// # Errors
    /// [`ViewError`] for a bearing that is not finite.
    pub fn turned(&self, light: &View, to: Bearing) -> Result<View, ViewError> {
        let from = Bearing::of(-light.ahead());
        if from == to {
            return Ok(*light);
        }
        let turn = DMat3::from_quat(to.frame() * from.frame().inverse());
        let placed = light.eye_to_world();
        let pivot = self.pivot(light);
        let eye = pivot + turn * (placed.w_axis.truncate() - pivot);
        let axes = (turn * DMat3::from_mat4(placed)).transpose();
        let world_to_eye = DMat4::from_mat3(axes) * DMat4::from_translation(-eye);
        let made = |projection, near, far| {
            View::new(world_to_eye, projection, near, far, light.size()).map(|view| view.alike(light))
        };
        let turned = made(light.projection(), light.near(), light.far())?;
        match light.projection() {
            Projection::Orthographic { half, shift } => {
                let own = (half * (-1.0 - shift)).extend(light.near());
                let other = (half * (1.0 - shift)).extend(light.far());
                let (mut low, mut high) = (own, other);
                for object in &self.objects {
                    if let Some((least, most)) = self.seen(object, light)
                        && least.cmpge(own).all()
                        && most.cmple(other).all()
                        && let Some((least, most)) = self.seen(object, &turned)
                    {
                        let margin = (other - own) * MARGIN;
                        low = DVec3::select(least.cmplt(low), least - margin, low);
                        high = DVec3::select(most.cmpgt(high), most + margin, high);
                    }
                }
                if (low, high) == (own, other) {
                    return Ok(turned);
                }
                let (least, most) = (low.truncate(), high.truncate());
                let shift = -(most + least) / (most - least);
                made(Projection::Orthographic { half: 0.5 * (most - least), shift }, low.z, high.z)
            }
            Projection::Perspective { k, .. } => {
                let (near, far) = self.range(light, &turned, k);
                made(light.projection(), near, far)
            }
        }
    }

    /// The box around an object in a view's eye space, with distances along its axis for z; `None` for an object without extent.
    fn seen(&self, object: &Object, view: &View) -> Option<(DVec3, DVec3)> {
        let eye = |at| view.world_to_eye().transform_point3(at) * DVec3::new(1.0, 1.0, -1.0);
        let points = self.hull(object).map(eye);
        points.fold(None, |known, at| {
            let (low, high) = known.unwrap_or((at, at));
            Some((low.min(at), high.max(at)))
        })
    }

    /// Near and far plane of a lamp that was turned.
    fn range(&self, light: &View, turned: &View, k: DVec2) -> (f64, f64) {
        // The least cosine between the axis and a direction in which the map sees.
        let least = 1.0 / (1.0 + k.recip().length_squared()).sqrt();
        let place = |view: &View| view.eye_to_world().w_axis.truncate() - self.origin;
        let (before, after) = (place(light), place(turned));
        let (mut near, mut far) = (light.near(), light.far());
        for object in &self.objects {
            if self.seen(object, light).is_some_and(|(_, most)| most.z <= light.far()) {
                let farthest = object.shape.hull().map(|at| at.as_dvec3().distance(after)).fold(0.0, f64::max);
                far = far.max(if farthest > far { farthest * (1.0 + MARGIN) } else { far });
            }
            if object.casts && object.shape.nearest(before) * least >= light.near() {
                near = near.min(object.shape.nearest(after) * least * (1.0 - MARGIN));
            }
        }
        // A lamp that was turned into something: what is so near to it may be nearer than the near plane.
        (near.max(far * 1e-5).min(light.near()), far)
    }
}
