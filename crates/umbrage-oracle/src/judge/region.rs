//! The box that a filter looks at, laid on a receiver, and what truth says all over it.

use super::{FOREIGN, Judge, PLACES, on_plane};
use crate::Hit;
use glam::{DVec2, DVec3, Vec2, Vec3};
use umbrage_plane::{Receiver, SurfacePoint, View};
use umbrage_recipe::Recipe;

/// How far a filter looks: half-extents in texels about a receiver's place in a map.
pub(super) type Reach<'a> = dyn Fn(&View, &Receiver) -> Vec2 + Sync + 'a;

impl Judge<'_> {
    /// Truth at the places of the box that a filter looks at for a pixel, in any order; of a foreign image's pixel where the filter is not known.
    pub(super) fn around(&self, pixel: usize, reach: Option<&Reach<'_>>) -> Option<Vec<f32>> {
        let point = self.point(pixel)?;
        let (view, receiver) = self.received(&point)?;
        let (view, middle, half) = if let Some(reach) = reach {
            (view, receiver.texel, reach(view, &receiver).as_dvec2())
        } else {
            let width = self.camera.size().x as usize;
            let pixel = DVec2::new((pixel % width) as f64, (pixel / width) as f64) + 0.5;
            (&self.camera, pixel, DVec2::splat(FOREIGN))
        };
        let on_surface = self.places(&point, view, (middle, half));
        let mut truth = vec![0.0; on_surface.len()];
        self.rays.fractions(&on_surface, self.key, &mut truth);
        Some(truth)
    }

    /// The places of a box of a view, its middle and half-extents in texels, that a point's surface has there.
    fn places(&self, point: &SurfacePoint, view: &View, (middle, half): (DVec2, DVec2)) -> Vec<SurfacePoint> {
        let steps = (0..PLACES * PLACES).map(|index| DVec2::new(f64::from(index % PLACES), f64::from(index / PLACES)));
        let at = |step: DVec2| middle + half * (step * (2.0 / f64::from(PLACES - 1)) - 1.0);
        // What the box shows far off the receiver is another surface, or none.
        let places: Vec<DVec3> = steps.filter_map(|step| on_plane(view, at(step), point)).collect();
        let radius = places.iter().map(|place| place.distance(point.position)).fold(0.0, f64::max);
        places.into_iter().filter_map(|place| self.settled(point, place, radius)).collect()
    }

    /// Whether a recipe's bias can pass what truth says blocks a pixel's light: whether somewhere in the box that the filter looks at it lies before what
    /// is compared by no more than the recipe's [largest bias](Recipe::largest_bias). False without a bias, and for pixels that see nothing
    /// in the light's maps.
    ///
    /// # Panics
    /// If the index is past the last pixel.
    pub fn bias_passes(&self, pixel: usize, recipe: &Recipe) -> bool {
        let Some(point) = self.point(pixel) else { return false };
        let Some((view, receiver)) = self.received(&point) else { return false };
        let most = f64::from(recipe.largest_bias(view, &receiver));
        if most == 0.0 {
            return false;
        }
        let reach = recipe.reach(view, &receiver).as_dvec2();
        let own = SurfacePoint { corner_offsets: [Vec3::ZERO; 4], ..point };
        let places = self.places(&point, view, (receiver.texel, reach));
        let zeta = |at: DVec3| -view.world_to_eye().transform_point3(at).z;
        // A plane's depths are compared with what is stored about each place, one depth for all of the region with what is stored anywhere in it.
        let compared =
            |place: &SurfacePoint| zeta(if recipe.follows_plane() { place.position } else { point.position });
        places
            .iter()
            .chain([&own])
            .any(|place| self.blocker(place, view).is_some_and(|hit| compared(place) - zeta(hit.position) <= most))
    }

    /// What a ray from a point meets before the light of a view.
    fn blocker(&self, point: &SurfacePoint, view: &View) -> Option<Hit> {
        let at = self.geometry.on_facet(point);
        let hit = self.geometry.next_hit(at, view.toward_eye(point.position))?;
        let light = view.light();
        let is_before = light.w == 0.0 || hit.t < light.truncate().distance(at);
        is_before.then_some(hit)
    }

    /// A place of a point's tangent plane, brought along the normal onto the surface of the same object, at most `radius` away; `None` where
    /// there is none of it.
    fn settled(&self, point: &SurfacePoint, place: DVec3, radius: f64) -> Option<SurfacePoint> {
        let normal = point.normal.as_dvec3();
        let there = SurfacePoint { position: place, corner_offsets: [Vec3::ZERO; 4], ..*point };
        let hits = self.geometry.hits(place + normal * radius, -normal);
        let own = hits.iter().filter(|hit| hit.object == point.object && hit.t <= 2.0 * radius);
        let nearest = own.min_by(|a, b| (a.t - radius).abs().total_cmp(&(b.t - radius).abs()))?;
        let side = 1f64.copysign(nearest.normal.dot(normal));
        Some(SurfacePoint { position: nearest.position, normal: (nearest.normal * side).as_vec3(), ..there })
    }

    /// How far away what blocks a pixel's light is, along the ray: world units, and texels of the map there. `None` where nothing does.
    pub(super) fn blocked_at(&self, pixel: usize) -> Option<(f64, f64)> {
        let point = self.point(pixel)?;
        let (view, receiver) = self.received(&point)?;
        let hit = self.blocker(&point, view)?;
        Some((hit.t, hit.t / f64::from(receiver.texel_world.max_element())))
    }
}
