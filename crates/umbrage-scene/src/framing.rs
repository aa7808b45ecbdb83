//! Finding a light's view by itself.

use crate::{Light, Scene};
use glam::{DVec2, DVec3, UVec2};
use umbrage_plane::{Kind, Projection, Rules, Verdict, View, ViewError, up_for};

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
    /// The light shines by a cone about its axis, which must not be turned.
    #[error("a view with a cone of light cannot be turned toward a ball: its light would turn along")]
    Aimed,
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
    /// Ids of the objects that may throw a shadow onto something that the camera sees, judged by balls around them: all that
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

    /// The light with the narrowest view that holds every relevant caster ([`Scene::relevant_casters`]), from its own place: what
    /// the map's sides, near and far planes are is found. Sampling, cone and map size stay, and the kind unless another suits the new
    /// range ([`Kind::of_range`]); texels need not be square.
    ///
    /// What the light lights does not change. A light that shines alike in all directions is turned toward its casters. One
    /// with a cone or a tree keeps its axis, and its map is the part of the view that holds the casters within its cone;
    /// beyond that part nothing casts, so that all is lit there as far as the cone goes. A light whose only limits are its
    /// map's sides, beyond which all is dark ([`Rules::outside`](umbrage_plane::Rules)), keeps them.
    ///
    /// # Errors
    /// [`FrameError`].
    pub fn framed(&self, light: &Light) -> Result<Light, FrameError> {
        let relevant = self.relevant_casters(&light.view);
        let points: Vec<DVec3> = relevant.iter().flat_map(|&id| self.hull(&self.objects[id as usize])).collect();
        let view = &light.view;
        let bounded_by_map = view.cone().is_none() && view.rules().outside == Verdict::Shadowed;
        let aimed = view.cone().is_some() || light.tree.is_some() || bounded_by_map;
        let found = if aimed || !view.is_perspective() {
            *view
        } else {
            fit(view, Ball::around(&points).ok_or(FrameError::Nothing)?)?
        };
        let eye: Vec<DVec3> = points.iter().map(|&at| found.world_to_eye().transform_point3(at)).collect();
        let mut framed = closed_in(&found, &eye, bounded_by_map)?;
        if !bounded_by_map && aimed {
            framed = framed.with_rules(Rules { outside: Verdict::Lit, ..*view.rules() });
        }
        Ok(Light { view: framed, ..light.clone() })
    }
}

/// The part of a view that holds points of its eye space, its near and far planes just before and behind them; with its own sides if
/// they are to stay.
fn closed_in(view: &View, points: &[DVec3], keep_sides: bool) -> Result<View, FrameError> {
    /// How much is added on every side, as a fraction of the width.
    const MARGIN: f64 = 1.0 / 1024.0;
    let (low, high) =
        points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(-at.z), high.max(-at.z)));
    let (mut near, mut far) = (low - MARGIN * (high - low), high + MARGIN * (high - low));
    if view.is_perspective() {
        if high <= 0.0 {
            return Err(FrameError::Nothing);
        }
        near = if low > 0.0 { low * (1.0 - MARGIN) } else { view.near().min(0.5 * high) };
        far = high * (1.0 + MARGIN);
    }
    if near >= far {
        // All casters are at one distance: a flat sheet that the light looks straight at. Far away, f64 must still tell the two apart.
        let width = Ball::around(points).map_or(0.0, |ball| ball.radius);
        let widen = (MARGIN * width).max(near.abs() * f64::EPSILON * 1024.0);
        (near, far) = (near - widen, far + widen);
    }
    if keep_sides {
        return Ok(alike(&View::new(view.world_to_eye(), view.projection(), near, far, view.size())?, view));
    }
    let (mut least, mut most) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let mut limit = DVec2::INFINITY;
    if view.is_perspective() {
        if let Some(cos_half) = view.cone() {
            limit = DVec2::splat((1.0 - cos_half * cos_half).sqrt() / cos_half);
        }
        if low <= 0.0 {
            // Something reaches behind the light: of its shape nothing is known but that the light sees it on some side.
            let Projection::Perspective { k, shift } = view.projection() else { return Err(FrameError::Nothing) };
            let (a, b) = ((-1.0 - shift) / k, (1.0 - shift) / k);
            (least, most) = if limit.is_finite() { (-limit, limit) } else { (a, b) };
        } else {
            for at in points {
                let tangent = at.truncate() / -at.z;
                (least, most) = (least.min(tangent), most.max(tangent));
            }
        }
    } else {
        for at in points {
            (least, most) = (least.min(at.truncate()), most.max(at.truncate()));
        }
    }
    // A sheet that is edge-on to the light has no width of its own.
    let extent = most - least;
    let widen = MARGIN * extent.max(DVec2::splat(MARGIN * extent.max_element()));
    (least, most) = ((least - widen).max(-limit), (most + widen).min(limit));
    if !least.cmplt(most).all() {
        return Err(FrameError::Nothing);
    }
    let half = 0.5 * (most - least);
    let shift = -(most + least) / (most - least);
    let projection = if view.is_perspective() {
        Projection::Perspective { k: 1.0 / half, shift }
    } else {
        Projection::Orthographic { half, shift }
    };
    Ok(alike(&View::new(view.world_to_eye(), projection, near, far, view.size())?, view))
}

/// A view with everything of another that its constructor does not take. A kind that is the natural one of the other's range gives way
/// to the natural one of the new range.
fn alike(view: &View, other: &View) -> View {
    let natural = other.kind() == Kind::of_range(other.near(), other.far());
    if natural { view.alike(other).with_kind(view.kind()) } else { view.alike(other) }
}

fn ball(points: impl Iterator<Item = DVec3>) -> Option<Ball> {
    Ball::around(&points.collect::<Vec<_>>())
}

/// `light` turned toward a ball and closed in around it: full angle 2·asin(R/d) over both sides of the map, near plane at
/// d − R, far plane at d + R. Parallel light keeps its direction.
///
/// # Errors
/// [`FrameError::Aimed`] for a view with a cone, which would be turned along; [`FrameError::Inside`] when a light in
/// perspective stands within the ball; [`FrameError::View`] for a ball without extent.
pub fn fit(light: &View, ball: Ball) -> Result<View, FrameError> {
    // Texels need not be square: the ball touches all sides.
    let square = UVec2::ONE;
    let found = if light.is_perspective() {
        if light.cone().is_some() {
            return Err(FrameError::Aimed);
        }
        let eye = light.light().truncate();
        let distance = eye.distance(ball.centre);
        if distance <= ball.radius {
            return Err(FrameError::Inside { distance, radius: ball.radius });
        }
        let up = up_for(ball.centre - eye);
        let fov = 2.0 * (ball.radius / distance).asin();
        View::perspective(eye, ball.centre, up, fov, distance - ball.radius, distance + ball.radius, square)?
    } else {
        let eye = ball.centre - light.ahead() * (2.0 * ball.radius);
        View::orthographic(
            eye,
            ball.centre,
            up_for(light.ahead()),
            ball.radius,
            ball.radius,
            3.0 * ball.radius,
            square,
        )?
    };
    Ok(alike(&found.with_size(light.size())?, light))
}
