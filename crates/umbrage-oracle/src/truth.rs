use crate::Geometry;
use crate::place::{Place, Shot};
use glam::{DVec2, DVec3, DVec4, Vec3};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use umbrage_plane::{SurfacePoint, Verdict, View};
use umbrage_sample::Key;
use umbrage_shadow::{Shadow, Unshadowed, same_length};

/// What counts as truth. The default is physical: every object blocks light.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Truth {
    /// Only objects drawn into depth maps block light (Reeves 1987 leaves the ground out). Then only those are dark on the side away from the light, too.
    pub casters_only: bool,
    /// Hits on the receiver's own object nearer than this, world units, are passed over: for points that lie beside a
    /// finely tessellated surface instead of on it. 0 by default.
    pub own_slack: f64,
    /// Casts a ray even where the light's rules would say *lit* without a look (behind an open light, outside its map).
    /// *Shadowed* places, such as outside a spot's cone, stay dark: no light goes there.
    pub look_everywhere: bool,
}

/// A light for rays: its centre, and what it says about places it does not light.
#[derive(Clone, Copy, Debug)]
struct Lamp {
    /// Homogeneous: w = 1 a point, w = 0 a unit direction toward the light.
    at: DVec4,
    view: Option<View>,
    truth: Truth,
    /// Nothing in the way is transparent.
    opaque: bool,
}

impl Lamp {
    /// The answer that needs no ray.
    fn verdict(&self, at: &SurfacePoint) -> Option<f32> {
        let view = self.view.as_ref()?;
        let point = SurfacePoint { corner_offsets: [Vec3::ZERO; 4], ..*at };
        let place = match view.receiver(&point) {
            Ok(receiver) => view.locate(receiver.footprint.centre),
            Err(place) => place,
        };
        match view.rules().verdict(place) {
            Verdict::Shadowed => Some(1.0),
            Verdict::Lit if !self.truth.look_everywhere => Some(0.0),
            Verdict::Lit | Verdict::Compare => None,
        }
    }

    /// How light comes from `light` (homogeneous as [`Lamp::at`]) to a point, which `from` is on its surface.
    fn way(&self, geometry: &Geometry, at: &SurfacePoint, from: &Place, light: DVec4) -> Way {
        let end = (light.w != 0.0).then(|| geometry.place(light.truncate()));
        let way = end.map_or(light.truncate(), |end| end.at - from.at);
        let normal = at.normal.as_dvec3();
        let facing = normal.dot(way);
        let body = geometry.body(at.object);
        let opaque = body.passes == Vec3::ZERO;
        if body.solid && opaque && (body.casts || !self.truth.casters_only) && facing <= 0.0 {
            return Way::Known(Vec3::ZERO);
        }
        let from = from.lifted(normal * 1f64.copysign(facing));
        let way = end.map_or(way, |end| end.at - from.at);
        Way::Ray(Shot { object: Some(at.object), ..Shot::new(from, way, end) })
    }

    /// What passes of the light on each way, in their order; fast where they go much the same way.
    fn pass(&self, geometry: &Geometry, ways: &[Way]) -> Vec<Vec3> {
        let truth = self.truth;
        let counts = |shot: &Shot, index: u32, t: f64| {
            let object = geometry.faces()[index as usize].object;
            let ignored = truth.casters_only && !geometry.body(object).casts;
            let own = Some(object) == shot.object && t <= truth.own_slack;
            let at_the_light = || shot.end.is_some_and(|end| geometry.holds(index, &end));
            !(ignored || own || at_the_light())
        };
        let shots = ways.iter().filter_map(|way| if let Way::Ray(shot) = way { Some(shot) } else { None });
        // Any surface will do, whichever is found first.
        let dark = if self.opaque { geometry.blocked(&shots.collect::<Vec<_>>(), counts) } else { Vec::new() };
        let mut dark = dark.into_iter();
        let passes = |way: &Way| match way {
            Way::Known(passes) => *passes,
            Way::Ray(shot) => match dark.next() {
                Some(dark) => Vec3::splat(f32::from(u8::from(!dark))),
                None => geometry.passed(shot, counts),
            },
        };
        ways.iter().map(passes).collect()
    }
}

/// How light comes to a point.
enum Way {
    /// So much passes, whatever stands where.
    Known(Vec3),
    /// What is on a ray decides.
    Ray(Shot),
}

/// What passes of the light, linear RGB, over a number of samples.
#[derive(Clone, Copy)]
struct Passed {
    sum: Vec3,
    samples: f32,
}

impl Passed {
    const fn one(passes: Vec3) -> Self {
        Self { sum: passes, samples: 1.0 }
    }

    fn over(passes: &[Vec3]) -> Self {
        Self { sum: passes.iter().fold(Vec3::ZERO, |sum, passes| sum + passes), samples: passes.len() as f32 }
    }

    /// The mean shadow of the three channels. Sums of zeros and ones are exact: so is the fraction of dark samples.
    fn shadow(self) -> f32 {
        let all = 3.0 * self.samples;
        (all - self.sum.element_sum()) / all
    }

    fn mean(self) -> Vec3 {
        self.sum / self.samples
    }
}

/// A place in each of `across`² jittered cells of the unit square.
fn jittered(across: u32, key: Key) -> impl Iterator<Item = DVec2> {
    let across = across.max(1);
    (0..across * across).map(move |cell| {
        let jitter = DVec2::new(f64::from(key.unit(cell, 0)), f64::from(key.unit(cell, 1)));
        let corner = DVec2::new(f64::from(cell % across), f64::from(cell / across));
        (corner + jitter) / f64::from(across)
    })
}

/// Exact hard shadows by one ray per point: 0 or 1, and between where light passes through things.
///
/// * A point on a solid whose geometric normal does not face the light is dark: its own body is in the way. On a sheet
///   the ray alone decides, and the sheet at the point itself does not count.
/// * Every surface on the way stops its fraction of the light ([`Body::passes`](crate::Body::passes)); the shadow is the mean
///   over the channels of what is lost. A transparent solid is not an exception to its own points: the surfaces of it that
///   the ray crosses count, the one at the point itself does not.
/// * Places that the light's [`Rules`](umbrage_plane::Rules) call shadowed are dark, those they call lit are lit (but
///   see [`Truth::look_everywhere`]); a ray decides all others, near and far plane regardless.
/// * The point is on its own object's surface when it lies off it by no more than the rounding of f32; the ray then starts
///   on the surface itself. Faces that hold the point do not block it: shadows begin at a contact.
/// * A surface that holds the light blocks none of it, on either side: the light shines from its surface. Maps agree, as
///   such a surface is edge-on from the light and covers no texel.
pub struct RayCast<'a> {
    geometry: &'a Geometry,
    lamp: Lamp,
}

impl<'a> RayCast<'a> {
    /// Toward a light's view, by its rules.
    pub fn new(geometry: &'a Geometry, light: &View) -> Self {
        let lamp =
            Lamp { at: light.light(), view: Some(*light), truth: Truth::default(), opaque: geometry.is_opaque() };
        Self { geometry, lamp }
    }

    /// Toward a light without a map's edges: homogeneous, w = 1 a point, w = 0 a direction (any length) toward it.
    /// For lights of many views.
    pub fn everywhere(geometry: &'a Geometry, light: DVec4) -> Self {
        let at = if light.w == 0.0 { light.truncate().normalize_or_zero().extend(0.0) } else { light / light.w };
        Self { geometry, lamp: Lamp { at, view: None, truth: Truth::default(), opaque: geometry.is_opaque() } }
    }

    /// The same with another notion of truth.
    #[must_use]
    pub fn with(mut self, truth: Truth) -> Self {
        self.lamp.truth = truth;
        self
    }

    /// 0 lit, 1 dark.
    pub fn at(&self, point: &SurfacePoint) -> f32 {
        Passed::one(self.passes(point)).shadow()
    }

    /// What passes of the light, linear RGB: 1 lit, 0 dark.
    pub fn passes(&self, point: &SurfacePoint) -> Vec3 {
        self.all_passes(std::slice::from_ref(point))[0]
    }

    /// [`RayCast::passes`] of points that lie near each other.
    fn all_passes(&self, points: &[SurfacePoint]) -> Vec<Vec3> {
        let Self { geometry, lamp } = self;
        let way = |(point, from): (&SurfacePoint, Place)| match lamp.verdict(point) {
            Some(known) => Way::Known(Vec3::splat(1.0 - known)),
            None => lamp.way(geometry, point, &from, lamp.at),
        };
        let ways: Vec<Way> = points.iter().zip(geometry.all_settled(points.iter())).map(way).collect();
        lamp.pass(geometry, &ways)
    }
}

impl Shadow for RayCast<'_> {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        batches(at, out, |at| self.all_passes(at).into_iter().map(|passes| Passed::one(passes).shadow()));
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        if self.lamp.opaque {
            return Unshadowed.transmittances(at, key, fractions, out);
        }
        same_length(at, fractions);
        batches(at, out, |at| self.all_passes(at));
    }
}

/// The fraction of a region in hard shadow: `across`² stratified points over the quadrilateral of its corners.
///
/// All points are taken to lie on the region's tangent plane: where a region hangs over its surface's edge, so does its
/// truth. A picture shaded at every sample with [`RayCast`] has no such points.
pub struct AreaRegion<'a> {
    /// What answers at each point.
    pub ray: RayCast<'a>,
    /// Points along each axis; 16 (256 points) by default in [`AreaRegion::new`]. 0 counts as 1.
    pub across: u32,
}

impl<'a> AreaRegion<'a> {
    /// 256 points per region.
    pub fn new(ray: RayCast<'a>) -> Self {
        Self { ray, across: 16 }
    }
}

impl AreaRegion<'_> {
    fn passed(&self, point: &SurfacePoint, key: Key) -> Passed {
        let [a, b, c, d] = point.corners();
        let points = jittered(self.across, key.region(point.region)).map(|s| {
            let position = a.lerp(b, s.x).lerp(d.lerp(c, s.x), s.y);
            SurfacePoint { position, corner_offsets: [Vec3::ZERO; 4], ..*point }
        });
        Passed::over(&self.ray.all_passes(&points.collect::<Vec<_>>()))
    }
}

impl Shadow for AreaRegion<'_> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        each(at, out, |point| self.passed(point, key).shadow());
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        if self.ray.lamp.opaque {
            return Unshadowed.transmittances(at, key, fractions, out);
        }
        same_length(at, fractions);
        each(at, out, |point| self.passed(point, key).mean());
    }
}

/// True soft shadows of a disc: the fraction of it that a point does not see.
///
/// A positional light becomes a disc of `radius` world units about its centre, square to its axis (to the receiver's
/// direction when it has no view); a directional light a disc on the sky, `radius` being the tangent of its angular
/// radius. Every part of the disc counts alike, whatever its angle with the surface; parts below a solid's horizon are
/// dark. Places are judged by the rules for the disc's centre.
pub struct AreaLight<'a> {
    ray: RayCast<'a>,
    /// World units (positional) or tangent of the angular radius (directional).
    pub radius: f64,
    /// Samples along each axis; 16 (256 points) in [`AreaLight::new`]. 0 counts as 1.
    pub across: u32,
}

impl<'a> AreaLight<'a> {
    /// 256 points on the disc.
    pub fn new(ray: RayCast<'a>, radius: f64) -> Self {
        Self { ray, radius, across: 16 }
    }

    /// A directional light of angular radius `radians` (the sun: .00465).
    pub fn sky(ray: RayCast<'a>, radians: f64) -> Self {
        Self::new(ray, radians.tan())
    }

    /// With at least so many samples (the figures take 256).
    #[must_use]
    pub fn with_samples(mut self, samples: u32) -> Self {
        self.across = f64::from(samples.max(1)).sqrt().ceil() as u32;
        self
    }

    fn passed(&self, point: &SurfacePoint, key: Key) -> Passed {
        let lamp = &self.ray.lamp;
        if let Some(known) = lamp.verdict(point) {
            return Passed::one(Vec3::splat(1.0 - known));
        }
        let axis = match (&lamp.view, lamp.at.w == 0.0) {
            (Some(view), false) => view.world_to_eye().row(2).truncate(),
            (_, true) => lamp.at.truncate(),
            (None, false) => lamp.at.truncate() - point.position,
        };
        let from = self.ray.geometry.settled(point);
        let (right, up) = axis.normalize_or(DVec3::Z).any_orthonormal_pair();
        let ways = jittered(self.across, key.region(point.region)).map(|s| {
            let on_disc = to_disc(s) * self.radius;
            let light = lamp.at + (right * on_disc.x + up * on_disc.y).extend(0.0);
            lamp.way(self.ray.geometry, point, &from, light)
        });
        Passed::over(&lamp.pass(self.ray.geometry, &ways.collect::<Vec<_>>()))
    }
}

impl Shadow for AreaLight<'_> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        each(at, out, |point| self.passed(point, key).shadow());
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        if self.ray.lamp.opaque {
            return Unshadowed.transmittances(at, key, fractions, out);
        }
        same_length(at, fractions);
        each(at, out, |point| self.passed(point, key).mean());
    }
}

/// The unit square onto the unit disc, areas kept, neighbours kept (Shirley & Chiu 1997).
fn to_disc(unit: DVec2) -> DVec2 {
    let at = unit * 2.0 - 1.0;
    if at == DVec2::ZERO {
        return at;
    }
    let (radius, angle) = if at.x.abs() > at.y.abs() {
        (at.x, FRAC_PI_4 * (at.y / at.x))
    } else {
        (at.y, FRAC_PI_2 - FRAC_PI_4 * (at.x / at.y))
    };
    DVec2::from_angle(angle) * radius
}

/// The answer of each point.
///
/// # Panics
/// When there is not one for each.
#[track_caller]
fn each<T: Send>(at: &[SurfacePoint], out: &mut [T], answer: impl Fn(&SurfacePoint) -> T + Sync) {
    batches(at, out, |at| at.iter().map(&answer));
}

/// The answer of each point, for many at once.
///
/// # Panics
/// When there is not one for each.
#[track_caller]
fn batches<'p, T: Send, A: IntoIterator<Item = T>>(
    at: &'p [SurfacePoint],
    out: &mut [T],
    answers: impl Fn(&'p [SurfacePoint]) -> A + Sync,
) {
    const BATCH: usize = 64;
    same_length(at, out);
    at.par_chunks(BATCH).zip(out.par_chunks_mut(BATCH)).for_each(|(at, out)| {
        for (answer, out) in answers(at).into_iter().zip(out) {
            *out = answer;
        }
    });
}
