//! Rays through the tree of a geometry's faces.

use crate::triangle::Triangle;
use glam::DVec3;
use obvhs::INVALID;
use obvhs::bvh2::{Bvh2, node::Bvh2Node};

/// A ray whose boxes are cheap to test. Relative to the geometry's origin.
#[derive(Clone, Copy)]
pub(crate) struct Ray {
    origin: DVec3,
    direction: DVec3,
    inverse: [f64; 3],
    /// The axis along which it goes most, and the two others.
    axes: [usize; 3],
    /// How far it moves along the two others per unit of the first.
    shear: [f64; 2],
}

impl Ray {
    /// `direction` is a unit vector.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        // A huge number instead of 1/0: an origin on a box's side then gives 0, not NaN.
        let inverse = direction.to_array().map(|d| if d.abs() > 1e-300 { 1.0 / d } else { 1e300 });
        let along = direction.abs().max_position();
        let axes = [along, (along + 1) % 3, (along + 2) % 3];
        let shear = [direction[axes[1]] / direction[along], direction[axes[2]] / direction[along]];
        Self { origin, direction, inverse, axes, shear }
    }

    /// The place at a distance.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
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
    fn meets(&self, plane: &Triangle) -> Option<f64> {
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

    /// Gives `visit` each face that the ray meets at 0 < t, and takes from it how far still to look; `None` ends it.
    pub fn walk(
        &self,
        tree: &Bvh2,
        faces: &[Triangle],
        mut reach: f64,
        visit: &mut impl FnMut(u32, f64) -> Option<f64>,
    ) {
        if let Some(root) = tree.nodes.first()
            && self.enters(root).is_some()
        {
            self.descend(tree, faces, root, &mut reach, visit);
        }
    }

    /// False when the walk has ended.
    fn descend(
        &self,
        tree: &Bvh2,
        faces: &[Triangle],
        node: &Bvh2Node,
        reach: &mut f64,
        visit: &mut impl FnMut(u32, f64) -> Option<f64>,
    ) -> bool {
        let first = node.first_index as usize;
        if node.is_leaf() {
            for &face in &tree.primitive_indices[first..first + node.prim_count as usize] {
                debug_assert_ne!(face, INVALID, "a tree built once has no vacant slots");
                if let Some(t) = self.meets(&faces[face as usize])
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
            let child = &tree.nodes[child];
            (self.enters(child), child)
        });
        if near.0.is_none() || far.0.is_some_and(|far| near.0.is_some_and(|near| far < near)) {
            std::mem::swap(&mut near, &mut far);
        }
        [near, far].into_iter().all(|(entry, child)| {
            entry.is_none_or(|entry| entry > *reach) || self.descend(tree, faces, child, reach, visit)
        })
    }
}
