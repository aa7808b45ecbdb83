//! Rays through a mesh by `obvhs`, with either of its trees: that of two children is built sooner, that of eight traversed faster.
//!
//! Both are built as its middle preset says, which of all presets took the least time for the whole job, for one ray and for
//! sixteen.

use crate::meshes::Mesh;
use glam::{Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;
use std::fmt;
use std::time::Duration;
use umbrage_plane::SurfacePoint;

/// Where rays begin, in lengths of the ray: beyond the surface that they leave.
const BEGIN: f32 = 1e-3;

/// A disc that faces the ground and gives light.
#[derive(Clone, Copy, Debug)]
pub struct Disc {
    /// Its centre.
    pub centre: Vec3,
    /// Its radius.
    pub radius: f32,
}

/// Either tree.
enum Nodes {
    Two(Bvh2),
    Eight(CwBvh),
}

/// A tree over triangles.
pub struct Tree {
    nodes: Nodes,
    /// In the tree's order.
    triangles: Vec<RtTriangle>,
}

impl fmt::Debug for Tree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Tree").field("triangles", &self.triangles.len()).finish_non_exhaustive()
    }
}

impl Tree {
    /// A tree of two children at each node.
    pub fn of_two(mesh: &Mesh) -> Self {
        let triangles = triangles(mesh);
        let tree = build_bvh2_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Duration::default());
        Self { triangles: ordered(&triangles, &tree.primitive_indices), nodes: Nodes::Two(tree) }
    }

    /// A tree of eight children at each node.
    pub fn of_eight(mesh: &Mesh) -> Self {
        let triangles = triangles(mesh);
        let tree = build_cwbvh_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Duration::default());
        Self { triangles: ordered(&triangles, &tree.primitive_indices), nodes: Nodes::Eight(tree) }
    }

    /// The nearest triangle along a ray, by its place in the tree's order.
    fn hit(&self, origin: Vec3, direction: Vec3) -> RayHit {
        let ray = Ray::new_inf(origin.into(), direction.into());
        let mut hit = RayHit::none();
        let met = |ray: &Ray, index: usize| self.triangles[index].intersect(ray);
        match &self.nodes {
            Nodes::Two(tree) => tree.ray_traverse(ray, &mut hit, met),
            Nodes::Eight(tree) => tree.ray_traverse(ray, &mut hit, met),
        };
        hit
    }

    /// The nearest triangle along a ray, if there is one.
    pub fn nearest(&self, origin: Vec3, direction: Vec3) -> Option<usize> {
        let hit = self.hit(origin, direction);
        let order = match &self.nodes {
            Nodes::Two(tree) => &tree.primitive_indices,
            Nodes::Eight(tree) => &tree.primitive_indices,
        };
        (hit.t < f32::INFINITY).then(|| order[hit.primitive_id as usize] as usize)
    }

    fn is_dark(&self, from: Vec3A, to: Vec3A) -> bool {
        let ray = Ray::new(from, to - from, BEGIN, 1.0);
        let met = |ray: &Ray, index: usize| self.triangles[index].intersect(ray);
        match &self.nodes {
            Nodes::Two(tree) => !tree.ray_traverse_miss(ray, met),
            Nodes::Eight(tree) => !tree.ray_traverse_miss(ray, met),
        }
    }

    /// Fractions in shadow by one ray to the light's centre.
    pub fn one_ray(&self, points: &[SurfacePoint], light: Disc, out: &mut [f32]) {
        let to = light.centre.into();
        for (point, out) in points.iter().zip(out) {
            *out = f32::from(u8::from(self.is_dark(point.position.as_vec3a(), to)));
        }
    }

    /// Fractions in shadow by sixteen rays: one to each of sixteen rings of equal area, turned anew for each point.
    pub fn sixteen_rays(&self, points: &[SurfacePoint], light: Disc, out: &mut [f32]) {
        const GOLDEN: f32 = 2.399_963_2;
        let places: [Vec3A; 16] = std::array::from_fn(|ring| {
            let (sin, cos) = (GOLDEN * ring as f32).sin_cos();
            Vec3A::new(cos, 0.0, sin) * (light.radius * ((ring as f32 + 0.5) / 16.0).sqrt())
        });
        let mut state = 0x2545_F491_u32;
        for (point, out) in points.iter().zip(out) {
            state = state.wrapping_mul(0x2C92_77B5).wrapping_add(0xAC56_4B05);
            let (sin, cos) = ((state >> 8) as f32 * (std::f32::consts::TAU / 16_777_216.0)).sin_cos();
            let from = point.position.as_vec3a();
            let dark = places.iter().filter(|place| {
                let turned = Vec3A::new(place.x * cos - place.z * sin, 0.0, place.x * sin + place.z * cos);
                self.is_dark(from, turned + Vec3A::from(light.centre))
            });
            *out = dark.count() as f32 / 16.0;
        }
    }
}

fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let triangle = |index: usize| {
        let [v0, v1, v2] = mesh.corners(index).map(Vec3A::from);
        Triangle { v0, v1, v2 }
    };
    (0..mesh.triangles.len()).map(triangle).collect()
}

fn ordered(triangles: &[Triangle], order: &[u32]) -> Vec<RtTriangle> {
    order.iter().map(|index| RtTriangle::from(&triangles[*index as usize])).collect()
}
