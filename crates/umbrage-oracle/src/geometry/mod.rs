mod settled;

use crate::place::{Place, Shot};
use crate::ray::{Ray, Shaft};
use crate::triangle::Triangle;
use glam::{DVec2, DVec3, Vec2, Vec3};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use std::time::Duration;
use umbrage_plane::View;
use umbrage_scene::{Cover, Object, Scene};

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
    /// Drawn into depth maps. Truth regards it only under [`Truth::casters_only`](crate::Truth::casters_only).
    pub casts: bool,
    /// The closed boundary of a solid; false for an open sheet, and where its cover has holes or blends.
    pub solid: bool,
    /// Fraction of the light that passes one surface of it, linear RGB in 0..=1; 0, the default, is opaque. Where its cover blends
    /// it is what passes at an alpha of 1.
    pub passes: Vec3,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance from the origin, world units, > 0.
    pub t: f64,
    /// Index of the face in [`Geometry::faces`].
    pub face: u32,
    /// The id of its object.
    pub object: u32,
    /// Where it lies, in world space.
    pub position: DVec3,
    /// Unit normal on the outside (the counter-clockwise side), whichever side was met.
    pub normal: DVec3,
}

/// A scene's triangles, ready for rays. obvhs builds the tree; rays walk it in f64.
///
/// Positions are the f32 numbers of the scene, relative to its origin; everything after them is f64, and points and directions
/// that queries take are of world space. No ray slips between triangles
/// that share an edge or a vertex (Woop, Benthin & Wald 2013); a ray through the edge itself meets both. Where the
/// [`Cover`] of a scene's object says that nothing is there, no ray meets it.
///
/// Where a ray begins or ends on a surface, that surface is left out because it holds the point, not because it is near: what
/// counts as *holding* is the rounding of f64, some 10⁻¹² of the point's coordinates about the origin and of the face's size, so
/// that neither a scene's place in the world nor its extent changes what is in shadow.
pub struct Geometry {
    origin: DVec3,
    faces: Vec<Face>,
    triangles: Vec<Triangle>,
    bodies: Vec<Body>,
    /// What is known of covers; `None` where nothing has holes or blends.
    covers: Option<Covers>,
    tree: Bvh2,
}

/// Where nothing is of faces that have holes, and what passes those that blend.
struct Covers {
    of: Vec<Cover>,
    /// Places in the texture of each face's corners.
    uvs: Vec<[Vec2; 3]>,
}

/// What f64 arithmetic leaves between a point and the surface that it was computed on, as a fraction of coordinates and sizes:
/// room for a point that a camera sees from a thousand times as far away.
const EXACT: f64 = 1.0 / (1u64 << 40) as f64;

impl Geometry {
    /// All objects of a scene, casters or not. Patches are diced as they are for `dice_for`: give the camera's view to
    /// judge the camera's picture, so that receivers lie on the surfaces that are traced.
    ///
    /// # Panics
    /// When the scene's origin is not finite.
    pub fn new(scene: &Scene, dice_for: &View) -> Self {
        let about_origin = Self::about_origin(scene, &scene.about_origin(dice_for), |_| true);
        Self { origin: scene.origin, ..about_origin }
    }

    /// Some of the objects of a scene, about its origin as `view` is, for which patches are diced.
    pub(crate) fn about_origin(scene: &Scene, view: &View, keep: impl Fn(&Object) -> bool) -> Self {
        let (mut faces, mut uvs) = (Vec::new(), Vec::new());
        let kept = |(_, object): &(usize, &Object)| keep(object);
        let asked = |cover: &Cover| cover.has_holes() || cover.blends;
        let covered = scene.objects.iter().enumerate().filter(kept).any(|(_, object)| asked(&object.cover));
        for (id, object) in scene.objects.iter().enumerate().filter(kept) {
            let mesh = object.shape.mesh_for(view);
            let face = |local: usize| Face { corners: mesh.corners(local), object: id as u32 };
            for (local, face) in
                (0..mesh.triangles.len()).map(|local| (local, face(local))).filter(|(_, face)| usable(face))
            {
                faces.push(face);
                if covered {
                    uvs.push(mesh.corner_uvs(local));
                }
            }
        }
        let body = |object: &Object| Body { casts: object.casts, solid: object.is_solid(), passes: object.passes };
        let bodies = scene.objects.iter().map(body).collect();
        let of = || scene.objects.iter().map(|object| object.cover.clone()).collect();
        let covers = covered.then(|| Covers { of: of(), uvs });
        Self { covers, ..Self::from_faces(faces, bodies) }
    }

    /// From triangles of world space and what their objects are. Objects without a body count as sheets that do not cast; triangles
    /// with a coordinate that is not finite, or without area, are never met.
    pub fn from_faces(faces: Vec<Face>, bodies: Vec<Body>) -> Self {
        let faces: Vec<Face> = faces.into_iter().filter(usable).collect();
        let boxes: Vec<Aabb> = faces.iter().map(|face| Aabb::from_points(&face.corners.map(Vec3::to_vec3a))).collect();
        let tree = if boxes.is_empty() {
            Bvh2::default()
        } else {
            build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Duration::default())
        };
        let triangles = faces.iter().map(|face| Triangle::new(face.corners)).collect();
        Self { origin: DVec3::ZERO, faces, triangles, bodies, covers: None, tree }
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
        let blends = self.covers.iter().flat_map(|covers| &covers.of).any(|cover| cover.blends);
        !blends && self.bodies.iter().all(|body| body.passes == Vec3::ZERO)
    }

    /// A world-space point as it is given.
    pub(crate) fn place(&self, world: DVec3) -> Place {
        let at = world - self.origin;
        let rounding = EXACT * at.abs().max_element() + 4.0 * f64::EPSILON * world.abs().max_element();
        Place { at, rounding }
    }

    /// True when a place lies on a face, border included.
    pub(crate) fn holds(&self, face: u32, place: &Place) -> bool {
        let triangle = &self.triangles[face as usize];
        triangle.nearest(place.at).distance(place.at) <= 2.0 * (place.rounding + EXACT * triangle.size())
    }

    /// True when a surface lies between `from` and `to`. Faces that hold either of them do not count.
    pub fn occluded(&self, from: DVec3, to: DVec3) -> bool {
        let [from, to] = [from, to].map(|end| self.place(end));
        let shot = Shot::new(from, to.at - from.at, Some(to));
        !self.is_free(0, &shot, &|shot, face, _| shot.end.is_none_or(|end| !self.holds(face, &end)))
    }

    /// True when a surface lies in a direction, at any distance. Faces that hold `from` do not count.
    pub fn occluded_toward(&self, from: DVec3, direction: DVec3) -> bool {
        !self.is_free(0, &Shot::new(self.place(from), direction, None), &|_, _, _| true)
    }

    /// False when a hit nearer than a ray's reach, on a face at or below a node that does not hold the ray's beginning, `counts`: it is
    /// given the face and the distance along the ray.
    fn is_free(&self, node: u32, shot: &Shot, counts: &impl Fn(&Shot, u32, f64) -> bool) -> bool {
        let Shot { ray, from, reach, .. } = shot;
        ray.walk_from(&self.tree, &self.triangles, node, *reach, &mut |face, t| {
            let there = || self.covers.is_none() || self.is_there(face, ray.at(t));
            let blocks = t < *reach && there() && counts(shot, face, t) && !self.holds(face, from);
            if blocks { None } else { Some(*reach) }
        })
    }

    /// For each ray whether a hit as [`Geometry::is_free`] has it is in its way; fast where they go much the same way.
    pub(crate) fn blocked(&self, shots: &[&Shot], counts: impl Fn(&Shot, u32, f64) -> bool) -> Vec<bool> {
        // Starting at up to so many nodes takes a ray no more time than starting at the root.
        const NODES: usize = 16;
        let most = if shots.len() < 4 { 1 } else { NODES };
        let mut nodes = Shaft::around(shots.iter().map(|shot| &shot.ray)).nodes(&self.tree, most);
        let blocked = |shot: &&Shot| {
            let at = nodes.iter().position(|&node| !self.is_free(node, shot, &counts));
            // What blocks one ray often blocks the next.
            at.inspect(|&at| nodes.swap(0, at)).is_some()
        };
        shots.iter().map(blocked).collect()
    }

    /// What passes of the light along a ray, the product over the surfaces that `count`, as [`Geometry::is_free`] has it.
    ///
    /// A ray through a shared edge meets both its faces but crosses one surface: faces of an object that are met from the
    /// same side at one distance count once.
    pub(crate) fn passed(&self, shot: &Shot, counts: impl Fn(&Shot, u32, f64) -> bool) -> Vec3 {
        let &Shot { ref ray, ref from, reach, .. } = shot;
        let mut passes = Vec3::ONE;
        let mut crossed: Vec<(u32, bool, f64)> = Vec::new();
        self.walk(ray, reach, &mut |index, t| {
            if t < reach && counts(shot, index, t) && !self.holds(index, from) {
                let (face, triangle) = (&self.faces[index as usize], &self.triangles[index as usize]);
                let outside = triangle.normal.dot(ray.direction()) < 0.0;
                // Both planes are met with the rounding of f64, which a grazing ray stretches.
                let slack = 16.0 * EXACT * (t + triangle.size());
                let again = |&(object, side, at): &(u32, bool, f64)| {
                    object == face.object && side == outside && (at - t).abs() <= slack
                };
                if !crossed.iter().any(again) {
                    crossed.push((face.object, outside, t));
                    passes *= self.passes(index, ray.at(t));
                }
            }
            (passes != Vec3::ZERO).then_some(reach)
        });
        passes
    }

    /// The nearest surface in a direction (need not be unit), both sides seen; at equal distances the face with the
    /// lower index. `None` for a direction of length 0.
    pub fn first_hit(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        self.nearest(origin, direction, |_| true)
    }

    /// The same from a point on a surface: faces that hold it do not count.
    pub(crate) fn next_hit(&self, from: DVec3, direction: DVec3) -> Option<Hit> {
        let place = self.place(from);
        self.nearest(from, direction, |face| !self.holds(face, &place))
    }

    fn nearest(&self, origin: DVec3, direction: DVec3, counts: impl Fn(u32) -> bool) -> Option<Hit> {
        let direction = direction.try_normalize()?;
        let mut best: Option<(f64, u32)> = None;
        self.walk(&Ray::new(origin - self.origin, direction), f64::INFINITY, &mut |face, t| {
            if best.is_none_or(|(known, index)| t < known || (t == known && face < index)) && counts(face) {
                best = Some((t, face));
            }
            Some(best.map_or(f64::INFINITY, |(t, _)| t))
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
            normal: self.triangles[face as usize].normal,
        }
    }

    /// Whether anything of a face is at a place of it, relative to the origin.
    pub(crate) fn is_there(&self, face: u32, at: DVec3) -> bool {
        let Some(covers) = &self.covers else { return true };
        let cover = &covers.of[self.faces[face as usize].object as usize];
        !cover.has_holes() || cover.is_there(self.uv(covers, face, at))
    }

    /// What passes of the light at a place of a face, relative to the origin.
    fn passes(&self, face: u32, at: DVec3) -> Vec3 {
        let object = self.faces[face as usize].object;
        let passes = self.body(object).passes;
        let Some(covers) = &self.covers else { return passes };
        let cover = &covers.of[object as usize];
        if cover.blends { cover.passes(passes, self.uv(covers, face, at)) } else { passes }
    }

    /// Where a place of a face, relative to the origin, lies in the texture.
    fn uv(&self, covers: &Covers, face: u32, at: DVec3) -> DVec2 {
        let [a, b, c] = covers.uvs[face as usize].map(Vec2::as_dvec2);
        let DVec3 { x, y, z } = self.triangles[face as usize].weights(at);
        a * x + b * y + c * z
    }

    /// [`Ray::walk`] over all faces, but through their holes.
    fn walk(&self, ray: &Ray, mut reach: f64, visit: &mut impl FnMut(u32, f64) -> Option<f64>) {
        if self.covers.is_none() {
            return ray.walk(&self.tree, &self.triangles, reach, visit);
        }
        ray.walk(&self.tree, &self.triangles, reach, &mut |face, t| {
            if self.is_there(face, ray.at(t)) {
                reach = visit(face, t)?;
            }
            Some(reach)
        });
    }
}

/// Whether a face can be met at all.
fn usable(face: &Face) -> bool {
    face.corners.iter().all(|at| at.is_finite())
}
