//! The box that a filter looks at, laid on a receiver, and what truth says all over it.

use super::{FOREIGN, Judge, PLACES, on_plane};
use glam::{DVec2, DVec3, Vec2, Vec3};
use umbrage_plane::{Receiver, SurfacePoint, View};

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
        let steps = (0..PLACES * PLACES).map(|index| DVec2::new(f64::from(index % PLACES), f64::from(index / PLACES)));
        let at = |step: DVec2| middle + half * (step * (2.0 / f64::from(PLACES - 1)) - 1.0);
        // What the box shows far off the receiver is another surface, or none.
        let places: Vec<DVec3> = steps.filter_map(|step| on_plane(view, at(step), &point)).collect();
        let radius = places.iter().map(|place| place.distance(point.position)).fold(0.0, f64::max);
        let on_surface: Vec<SurfacePoint> =
            places.into_iter().filter_map(|place| self.settled(&point, place, radius)).collect();
        let mut truth = vec![0.0; on_surface.len()];
        self.rays.fractions(&on_surface, self.key, &mut truth);
        Some(truth)
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
        let at = self.geometry.on_facet(&point);
        let hit = self.geometry.next_hit(at, view.toward_eye(point.position))?;
        let light = view.light();
        let is_before = light.w == 0.0 || hit.t < light.truncate().distance(at);
        is_before.then(|| (hit.t, hit.t / f64::from(receiver.texel_world.max_element())))
    }
}
