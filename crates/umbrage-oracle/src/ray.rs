//! Rays through the tree of a geometry's faces.

use crate::triangle::Triangle;
use glam::DVec3;
use obvhs::INVALID;
use obvhs::bvh2::{Bvh2, node::Bvh2Node};
use std::collections::VecDeque;

/// Three roundings on either side: a box that is touched must not be missed.
const WIDEN: f64 = 1.0 + 8.0 * f64::EPSILON;

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

    /// The unit vector along it.
    pub fn direction(&self) -> DVec3 {
        self.direction
    }

    /// The place at a distance.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// The distance at which the ray enters a node's box, ≥ 0; `None` when it misses.
    #[inline(always)]
    fn enters(&self, node: &Bvh2Node) -> Option<f64> {
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
    pub fn meets(&self, plane: &Triangle) -> Option<f64> {
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
    pub fn walk(&self, tree: &Bvh2, faces: &[Triangle], reach: f64, visit: &mut impl FnMut(u32, f64) -> Option<f64>) {
        self.walk_from(tree, faces, 0, reach, visit);
    }

    /// [`Ray::walk`] from a node, of which 0 is the root; false when it has ended. There is nothing in a node that the tree does not have.
    pub fn walk_from(
        &self,
        tree: &Bvh2,
        faces: &[Triangle],
        node: u32,
        reach: f64,
        visit: &mut impl FnMut(u32, f64) -> Option<f64>,
    ) -> bool {
        let Some(below) = tree.nodes.get(node as usize) else { return true };
        self.enters(below).is_none_or(|entry| entry > reach && node != 0)
            || self.descend(tree, faces, below, &mut { reach }, visit)
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

/// Rays that go much the same way: what none of them meets is found out once for all.
pub(crate) struct Shaft {
    /// The box of their beginnings.
    low: DVec3,
    high: DVec3,
    /// The least and the greatest inverse along each axis.
    inverse: [[f64; 2]; 3],
}

impl Shaft {
    /// Around at least one ray.
    pub fn around<'a>(rays: impl Iterator<Item = &'a Ray>) -> Self {
        let (none, all) = (DVec3::splat(f64::NEG_INFINITY), DVec3::splat(f64::INFINITY));
        let mut shaft = Self { low: all, high: none, inverse: [[f64::INFINITY, f64::NEG_INFINITY]; 3] };
        for ray in rays {
            (shaft.low, shaft.high) = (shaft.low.min(ray.origin), shaft.high.max(ray.origin));
            for (known, inverse) in shaft.inverse.iter_mut().zip(ray.inverse) {
                *known = [known[0].min(inverse), known[1].max(inverse)];
            }
        }
        shaft
    }

    /// Nodes of a tree, no more than about `most`, below which are all leaves that one of the rays enters.
    pub fn nodes(&self, tree: &Bvh2, most: usize) -> Vec<u32> {
        let mut leaves = Vec::new();
        let mut inner: VecDeque<u32> = (0..tree.nodes.len().min(1) as u32).collect();
        while leaves.len() + inner.len() < most
            && let Some(index) = inner.pop_front()
        {
            let node = &tree.nodes[index as usize];
            if node.is_leaf() {
                leaves.push(index);
            } else {
                let children = [node.first_index, node.first_index + 1];
                inner.extend(children.iter().filter(|&&child| self.may_enter(&tree.nodes[child as usize])));
            }
        }
        leaves.extend(inner);
        leaves
    }

    /// False when [`Ray::enters`] is `None` for every ray: its arithmetic, which is monotonous also where it rounds, on their bounds.
    fn may_enter(&self, node: &Bvh2Node) -> bool {
        let (low, high) = (node.aabb().min.as_dvec3().to_array(), node.aabb().max.as_dvec3().to_array());
        let (first, last) = (self.low.to_array(), self.high.to_array());
        let (mut near, mut far) = (0.0f64, f64::INFINITY);
        for axis in 0..3 {
            let [least, most] = self.inverse[axis];
            // The sides that are met first and last, from where they are nearest and farthest.
            let (first, last) = if least > 0.0 {
                (low[axis] - last[axis], high[axis] - first[axis])
            } else if most < 0.0 {
                (high[axis] - first[axis], low[axis] - last[axis])
            } else {
                continue;
            };
            near = near.max((first * least).min(first * most));
            far = far.min((last * least).max(last * most));
        }
        near <= far * WIDEN
    }
}
