//! Finding a light's view by itself (spec EXT-9).

use crate::{Light, Scene};
use glam::{DVec3, UVec2};
use umbrage_plane::{Projection, View, ViewError};

/// A ball in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its middle.
    pub centre: DVec3,
    /// Its radius, world units, ≥ 0.
    pub radius: f64,
}

/// Why a light's view cannot be found.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FrameError {
    /// Nothing casts onto what the camera sees.
    #[error("no object casts a shadow onto what the camera sees")]
    Nothing,
    /// The light stands within the ball around what must be seen: it needs views in several directions.
    #[error(
        "the light stands inside its casters ({distance} from the middle of a ball of radius {radius}): use a cube or sectors"
    )]
    Inside {
        /// From the light to the ball's middle.
        distance: f64,
        /// The ball's radius.
        radius: f64,
    },
    /// The view that was found is none.
    #[error(transparent)]
    View(#[from] ViewError),
}

impl Ball {
    /// A ball around points, no more than a few per cent larger than need be (Ritter 1990). `None` without a point.
    pub fn around(points: &[DVec3]) -> Option<Self> {
        let first = *points.first()?;
        let farthest = |from: DVec3| {
            points.iter().fold(from, |best, &at| if at.distance(from) > best.distance(from) { at } else { best })
        };
        let a = farthest(first);
        let b = farthest(a);
        let start = Self { centre: (a + b) * 0.5, radius: a.distance(b) * 0.5 };
        Some(points.iter().fold(start, |ball, &at| {
            let distance = at.distance(ball.centre);
            if distance <= ball.radius {
                return ball;
            }
            let radius = 0.5 * (ball.radius + distance);
            Self { centre: ball.centre + (at - ball.centre) * ((distance - radius) / distance), radius }
        }))
    }

    /// Whether the ball may be in a view: false only when it lies wholly beyond one side.
    fn may_be_seen(&self, view: &View) -> bool {
        let eye = view.world_to_eye().transform_point3(self.centre);
        let beyond = |distance: f64| distance > self.radius;
        if beyond(eye.z + view.near()) || beyond(-eye.z - view.far()) {
            return false;
        }
        match view.projection() {
            Projection::Orthographic { half, shift } => {
                let from_middle = (eye.truncate() + half * shift).abs();
                !beyond(from_middle.x - half.x) && !beyond(from_middle.y - half.y)
            }
            Projection::Perspective { k, shift } => {
                // The planes of two opposite sides: ±k·x + (1 ∓ shift)·z = 0.
                let side = |at: f64, k: f64, far: f64| (at * k + far * eye.z) / k.hypot(far);
                let beyond =
                    |at: f64, k: f64, shift: f64| beyond(side(at, k, 1.0 - shift)) || beyond(side(-at, k, 1.0 + shift));
                !beyond(eye.x, k.x, shift.x) && !beyond(eye.y, k.y, shift.y)
            }
        }
    }

    /// Whether this ball may throw its shadow on `receiver`: nearer to the light, and in its direction.
    fn may_shadow(&self, receiver: &Self, light: &View) -> bool {
        if !light.is_perspective() {
            let across = receiver.centre - self.centre;
            let along = light.ahead().dot(across);
            return along > -(self.radius + receiver.radius)
                && (across - light.ahead() * along).length() <= self.radius + receiver.radius;
        }
        let eye = light.light().truncate();
        let half = |ball: &Self| (ball.radius / ball.centre.distance(eye)).min(1.0).asin();
        let (own, other) = (self.centre - eye, receiver.centre - eye);
        own.length() - self.radius <= other.length() + receiver.radius
            && own.angle_between(other) <= half(self) + half(receiver)
    }
}

impl Scene {
    /// Ids of the objects that may throw a shadow onto something that the camera sees, judged by balls around them (EXT-9): all that
    /// a light's map has to hold.
    pub fn relevant_casters(&self, light: &View) -> Vec<u32> {
        let balls: Vec<Option<Ball>> = self.objects.iter().map(|object| ball(self.hull(object))).collect();
        let seen: Vec<Ball> = self
            .objects
            .iter()
            .zip(&balls)
            .filter(|(object, _)| object.receives)
            .filter_map(|(_, ball)| ball.filter(|ball| ball.may_be_seen(&self.camera)))
            .collect();
        let relevant = |(object, ball): &(&crate::Object, &Option<Ball>)| {
            object.casts && ball.is_some_and(|own| seen.iter().any(|receiver| own.may_shadow(receiver, light)))
        };
        let all = self.objects.iter().zip(&balls).enumerate();
        all.filter(|(_, pair)| relevant(pair)).map(|(id, _)| id as u32).collect()
    }

    /// The light with the narrowest view that holds every relevant caster ([`Scene::relevant_casters`]), from its own place: field of
    /// view, near and far planes are found (EXT-9, V66). Kind, sampling, rules, cone and map size stay.
    ///
    /// # Errors
    /// [`FrameError`].
    pub fn framed(&self, light: &Light) -> Result<Light, FrameError> {
        let relevant = self.relevant_casters(&light.view);
        let points = relevant.iter().flat_map(|&id| self.hull(&self.objects[id as usize]));
        let ball = ball(points).ok_or(FrameError::Nothing)?;
        Ok(Light { view: fit(&light.view, ball)?, ..light.clone() })
    }
}

fn ball(points: impl Iterator<Item = DVec3>) -> Option<Ball> {
    Ball::around(&points.collect::<Vec<_>>())
}

/// `light` turned toward a ball and closed in around it: full angle 2·asin(R/d), near plane at d − R, far plane at d + R (V66).
///
/// # Errors
/// [`FrameError::Inside`] when a light in perspective stands within the ball; [`FrameError::View`] for a ball without extent.
pub fn fit(light: &View, ball: Ball) -> Result<View, FrameError> {
    let size: UVec2 = light.size();
    let up = if light.ahead().y.abs() < 0.999 { DVec3::Y } else { DVec3::Z };
    let found = if light.is_perspective() {
        let eye = light.light().truncate();
        let distance = eye.distance(ball.centre);
        if distance <= ball.radius {
            return Err(FrameError::Inside { distance, radius: ball.radius });
        }
        let toward = (ball.centre - eye).normalize();
        let up = if toward.y.abs() < 0.999 { DVec3::Y } else { DVec3::Z };
        let fov = 2.0 * (ball.radius / distance).asin();
        View::perspective(eye, ball.centre, up, fov, distance - ball.radius, distance + ball.radius, size)?
    } else {
        let eye = ball.centre - light.ahead() * (2.0 * ball.radius);
        View::orthographic(eye, ball.centre, up, ball.radius, ball.radius, 3.0 * ball.radius, size)?
    };
    let cone = light.cone().filter(|_| light.is_perspective());
    Ok(found.with_kind(light.kind()).with_sampling(light.sampling()).with_rules(*light.rules()).with_cone(cone)?)
}
