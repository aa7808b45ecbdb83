//! Where rays begin and end.

use crate::ray::Ray;
use glam::DVec3;

/// A place that faces may hold: where a ray begins or ends.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    /// Relative to the geometry's origin.
    pub at: DVec3,
    /// How far it may lie off a surface that it was computed on in f64, world units, but for what the face's own size adds.
    pub rounding: f64,
}

impl Place {
    /// Moved by its rounding, which [`Geometry::holds`](crate::Geometry) allows for: what lies in the plane of a facet that is edge-on to the light
    /// is then on the side of it that the query is about.
    pub(crate) fn lifted(self, normal: DVec3) -> Self {
        Self { at: self.at + normal * self.rounding, ..self }
    }
}

/// A ray that begins, and perhaps ends, where faces may hold it.
pub(crate) struct Shot {
    pub ray: Ray,
    pub from: Place,
    /// Where it ends, if it ends.
    pub end: Option<Place>,
    /// How far away that is, world units: what is met there does not count.
    pub reach: f64,
    /// The object that it begins on, where it is known.
    pub object: Option<u32>,
}

impl Shot {
    /// `way` is any vector along it, and the whole of it when it ends. Nothing is met along none.
    pub(crate) fn new(from: Place, way: DVec3, end: Option<Place>) -> Self {
        let reach = if end.is_some() { way.length() } else { f64::INFINITY };
        let (direction, reach) = way.try_normalize().map_or((DVec3::X, 0.0), |direction| (direction, reach));
        Self { ray: Ray::new(from.at, direction), from, end, reach, object: None }
    }
}
