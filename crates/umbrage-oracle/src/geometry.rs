use glam::{DVec3, Vec3};
use obvhs::aabb::Aabb;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::bvh2::{Bvh2, node::Bvh2Node};
use obvhs::{BvhBuildParams, INVALID};
use std::time::Duration;
use umbrage_plane::View;
use umbrage_scene::Scene;

/// A triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Relative to [`Geometry::origin`], counter-clockwise from outside.
    pub corners: [Vec3; 3],
    /// Id of the object it belongs to.
    pub object: u32,
}

/// What an object's id stands for.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Body {
    /// Drawn into depth maps. Truth asks for it only under [`Truth::casters_only`](crate::Truth::casters_only).
    pub casts: bool,
    /// The closed boundary of a solid; false for an open sheet.
    pub solid: bool,
    /// Share of the light that passes one surface of it, linear RGB in 0..=1; 0, the default, is opaque (EXT-3).
    pub passes: Vec3,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance from the origin, world units, > 0.
    pub t: f64,
    /// Index of the face in [`Geometry::faces`].
    pub face: u32,
    /// Its object.
    pub object: u32,
    /// World space.
    pub position: DVec3,
    /// Unit normal on the outside (the counter-clockwise side), whichever side was met.
    pub normal: DVec3,
}

/// A scene's triangles, ready for rays. obvhs builds the tree; rays walk it in f64.
///
/// Positions are the f32 numbers of the scene, relative to its origin; everything after them is f64, and points and directions
/// that are asked about are of world space. No ray slips between triangles
/// that share an edge or a vertex (Woop, Benthin & Wald 2013); a ray through the edge itself meets both.
pub struct Geometry {
    origin: DVec3,
    faces: Vec<Face>,
    planes: Vec<Plane>,
    bodies: Vec<Body>,
    tree: Bvh2,
    extent: f64,
}

/// A face in f64, relative to the geometry's origin, with its unit normal.
#[derive(Clone, Copy)]
struct Plane {
    corners: [DVec3; 3],
    normal: DVec3,
}

/// A ray whose boxes are cheap to test. Relative to the geometry's origin.
#[derive(Clone, Copy)]
struct Ray {
    origin: DVec3,
    direction: DVec3,
    inverse: [f64; 3],
    /// The axis along which it goes most, and the two others.
    axes: [usize; 3],
    /// How far it moves along the two others per unit of the first.
    shear: [f64; 2],
}

impl Geometry {
    /// All objects of a scene, casters or not. Patches are diced as they are for `dice_for`: give the camera's view to
    /// judge the camera's picture, so that receivers lie on the surfaces that are traced.
    ///
    /// # Panics
    /// When the scene's origin is not finite.
    pub fn new(scene: &Scene, dice_for: &View) -> Self {
        let local = scene.about_origin(dice_for);
        let mut faces = Vec::new();
        for (object, thing) in scene.objects.iter().enumerate() {
            let mesh = thing.shape.mesh_for(&local);
            faces.extend(mesh.triangles.iter().map(|triangle| Face {
                corners: triangle.map(|index| mesh.positions[index as usize]),
                object: object as u32,
            }));
        }
        let bodies = scene.objects.iter();
        let bodies = bodies.map(|thing| Body { casts: thing.casts, solid: thing.solid, passes: thing.passes });
        Self { origin: scene.origin, ..Self::from_faces(faces, bodies.collect()) }
    }

    /// From triangles of world space and what their objects are. Objects without a body count as sheets that do not cast; triangles
    /// with a coordinate that is not finite, or without area, are never met.
    pub fn from_faces(faces: Vec<Face>, bodies: Vec<Body>) -> Self {
        let faces: Vec<Face> = faces.into_iter().filter(|face| face.corners.iter().all(|at| at.is_finite())).collect();
        let boxes: Vec<Aabb> = faces.iter().map(|face| Aabb::from_points(&face.corners.map(Vec3::to_vec3a))).collect();
        let tree = if boxes.is_empty() {
            Bvh2::default()
        } else {
            build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Duration::default())
        };
        let planes = faces
            .iter()
            .map(|face| {
                let corners = face.corners.map(Vec3::as_dvec3);
                let [a, b, c] = corners;
                Plane { corners, normal: (b - a).cross(c - a).normalize_or_zero() }
            })
            .collect();
        let extent = faces.iter().flat_map(|face| face.corners).map(|at| f64::from(at.abs().max_element()));
        let extent = extent.fold(0.0, f64::max);
        Self { origin: DVec3::ZERO, faces, planes, bodies, tree, extent }
    }

    /// The world-space point that the faces are relative to: the scene's.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The triangles, by the index that [`Hit::face`] names.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// What an object is; the default (neither solid nor casting) for an id that the scene does not have.
    pub fn body(&self, object: u32) -> Body {
        self.bodies.get(object as usize).copied().unwrap_or_default()
    }

    /// True when no object lets light through: rays then end at the first surface.
    pub fn is_opaque(&self) -> bool {
        self.bodies.iter().all(|body| body.passes == Vec3::ZERO)
    }

    /// How far a world-space point that was rounded to f32 about the origin may lie off the surface it came from, world units,
    /// with room to spare: eight half-ulps of its largest coordinate there.
    pub fn margin(&self, at: DVec3) -> f64 {
        const EIGHT_HALF_ULPS: f64 = 1.0 / 2_097_152.0;
        ((at - self.origin).abs().max_element() * EIGHT_HALF_ULPS).max(self.extent * (EIGHT_HALF_ULPS / 512.0))
    }

    /// True when a surface lies between `from` and `to`, both excluded. Surfaces through `from` do not count: those
    /// whose plane passes within [`Geometry::margin`] of it.
    pub fn occluded(&self, from: DVec3, to: DVec3) -> bool {
        let way = to - from;
        self.blocked(from, way, way.length(), |off_plane, _, _| off_plane > self.margin(from))
    }

    /// True when a surface lies in a direction, at any distance. Surfaces through `from` do not count, as above.
    pub fn occluded_toward(&self, from: DVec3, direction: DVec3) -> bool {
        self.blocked(from, direction, f64::INFINITY, |off_plane, _, _| off_plane > self.margin(from))
    }

    /// True when a hit nearer than `reach` world units `counts`: it is given how far the origin is off the face's
    /// plane, the face, and the distance along the ray.
    pub(crate) fn blocked(
        &self,
        from: DVec3,
        direction: DVec3,
        reach: f64,
        mut counts: impl FnMut(f64, &Face, f64) -> bool,
    ) -> bool {
        let Some(direction) = direction.try_normalize() else { return false };
        let mut found = false;
        self.walk(&Ray::new(from - self.origin, direction), reach, &mut |face, t| {
            let off_plane = t * self.planes[face as usize].normal.dot(direction).abs();
            found = t < reach && counts(off_plane, &self.faces[face as usize], t);
            if found { None } else { Some(reach) }
        });
        found
    }

    /// What passes of the light along a ray, the product over the surfaces that `count`, nearer than `reach` world units.
    ///
    /// A ray through a shared edge meets both its faces but crosses one surface: faces of an object that are met from the
    /// same side within [`Geometry::margin`] of each other count once.
    pub(crate) fn passed(
        &self,
        from: DVec3,
        direction: DVec3,
        reach: f64,
        counts: impl Fn(&Face, f64) -> bool,
    ) -> Vec3 {
        let Some(direction) = direction.try_normalize() else { return Vec3::ONE };
        let mut passes = Vec3::ONE;
        let mut crossed: Vec<(u32, bool, f64)> = Vec::new();
        self.walk(&Ray::new(from - self.origin, direction), reach, &mut |index, t| {
            let face = &self.faces[index as usize];
            if t < reach && counts(face, t) {
                let outside = self.planes[index as usize].normal.dot(direction) < 0.0;
                let slack = self.margin(from + direction * t);
                let again = |&(object, side, at): &(u32, bool, f64)| {
                    object == face.object && side == outside && (at - t).abs() <= slack
                };
                if !crossed.iter().any(again) {
                    crossed.push((face.object, outside, t));
                    passes *= self.body(face.object).passes;
                }
            }
            (passes != Vec3::ZERO).then_some(reach)
        });
        passes
    }

    /// The nearest surface in a direction (need not be unit), both sides seen; at equal distances the face with the
    /// lower index. `None` for a direction of length 0.
    pub fn first_hit(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let direction = direction.try_normalize()?;
        let mut best: Option<(f64, u32)> = None;
        self.walk(&Ray::new(origin - self.origin, direction), f64::INFINITY, &mut |face, t| {
            if best.is_none_or(|(known, index)| t < known || (t == known && face < index)) {
                best = Some((t, face));
            }
            best.map(|(t, _)| t)
        });
        best.map(|(t, face)| self.hit(origin, direction, t, face))
    }

    /// Every surface in a direction, nearest first; a ray through a shared edge meets both faces.
    pub fn hits(&self, origin: DVec3, direction: DVec3) -> Vec<Hit> {
        let Some(direction) = direction.try_normalize() else { return Vec::new() };
        let mut found = Vec::new();
        self.walk(&Ray::new(origin - self.origin, direction), f64::INFINITY, &mut |face, t| {
            found.push(self.hit(origin, direction, t, face));
            Some(f64::INFINITY)
        });
        found.sort_by(|a, b| a.t.total_cmp(&b.t).then(a.face.cmp(&b.face)));
        found
    }

    fn hit(&self, origin: DVec3, direction: DVec3, t: f64, face: u32) -> Hit {
        Hit {
            t,
            face,
            object: self.faces[face as usize].object,
            position: origin + direction * t,
            normal: self.planes[face as usize].normal,
        }
    }

    /// Tells `visit` each face that the ray meets at 0 < t, and takes from it how far still to look; `None` ends it.
    fn walk(&self, ray: &Ray, mut reach: f64, visit: &mut impl FnMut(u32, f64) -> Option<f64>) {
        if let Some(root) = self.tree.nodes.first()
            && ray.enters(root).is_some()
        {
            self.descend(root, ray, &mut reach, visit);
        }
    }

    /// False when the walk has ended.
    fn descend(
        &self,
        node: &Bvh2Node,
        ray: &Ray,
        reach: &mut f64,
        visit: &mut impl FnMut(u32, f64) -> Option<f64>,
    ) -> bool {
        let first = node.first_index as usize;
        if node.is_leaf() {
            for &face in &self.tree.primitive_indices[first..first + node.prim_count as usize] {
                debug_assert_ne!(face, INVALID, "a tree built once has no vacant slots");
                if let Some(t) = ray.meets(&self.planes[face as usize])
                    && t <= *reach
                {
                    match visit(face, t) {
                        Some(further) => *reach = further,
                        None => return false,
                    }
                }
            }
            return true;
        }
        let [mut near, mut far] = [first, first + 1].map(|child| {
            let child = &self.tree.nodes[child];
            (ray.enters(child), child)
        });
        if near.0.is_none() || far.0.is_some_and(|far| near.0.is_some_and(|near| far < near)) {
            std::mem::swap(&mut near, &mut far);
        }
        [near, far]
            .into_iter()
            .all(|(entry, child)| entry.is_none_or(|entry| entry > *reach) || self.descend(child, ray, reach, visit))
    }
}

impl Ray {
    /// `direction` is a unit vector.
    fn new(origin: DVec3, direction: DVec3) -> Self {
        // A huge number instead of 1/0: an origin on a box's side then gives 0, not NaN.
        let inverse = direction.to_array().map(|d| if d.abs() > 1e-300 { 1.0 / d } else { 1e300 });
        let along = direction.abs().max_position();
        let axes = [along, (along + 1) % 3, (along + 2) % 3];
        let shear = [direction[axes[1]] / direction[along], direction[axes[2]] / direction[along]];
        Self { origin, direction, inverse, axes, shear }
    }

    /// The distance at which the ray enters a node's box, ≥ 0; `None` when it misses.
    #[inline(always)]
    fn enters(&self, node: &Bvh2Node) -> Option<f64> {
        // Three roundings on either side: a box that is touched must not be missed.
        const WIDEN: f64 = 1.0 + 8.0 * f64::EPSILON;
        let (low, high) = (node.aabb().min.to_array(), node.aabb().max.to_array());
        let origin = self.origin.to_array();
        let (mut near, mut far) = (0.0f64, f64::INFINITY);
        for axis in 0..3 {
            let a = (f64::from(low[axis]) - origin[axis]) * self.inverse[axis];
            let b = (f64::from(high[axis]) - origin[axis]) * self.inverse[axis];
            near = near.max(a.min(b));
            far = far.min(a.max(b));
        }
        (near <= far * WIDEN).then_some(near)
    }

    /// The distance to a face, > 0, both sides met; `None` when it is missed or edge-on.
    ///
    /// Corners are sheared so that the ray is the origin of a plane, then each edge says on which side it passes: the
    /// difference of two products, whose rounded sign is never wrong, only 0 at times, and 0 counts as met.
    #[inline(always)]
    fn meets(&self, plane: &Plane) -> Option<f64> {
        let [along, across, up] = self.axes;
        let [a, b, c] = plane.corners.map(|corner| {
            let from = (corner - self.origin).to_array();
            (from[across] - self.shear[0] * from[along], from[up] - self.shear[1] * from[along])
        });
        let (u, v, w) = (c.0 * b.1 - c.1 * b.0, a.0 * c.1 - a.1 * c.0, b.0 * a.1 - b.1 * a.0);
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let slope = plane.normal.dot(self.direction);
        if u + v + w == 0.0 || slope == 0.0 {
            return None;
        }
        let t = plane.normal.dot(plane.corners[0] - self.origin) / slope;
        (t > 0.0).then_some(t)
    }
}
