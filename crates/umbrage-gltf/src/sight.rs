//! Where cameras and lights stand and which way they look, and what of the scene lies before them.

use crate::GltfError;
use glam::{DAffine3, DMat3, DMat4, DVec3};
use umbrage_plane::up_for;
use umbrage_scene::{Object, Shape};

/// A place and a direction: what a camera and a light keep of their node. They look along the node's −z axis as it lies in the
/// world, whatever mirrors or shears it; +y is up as far as that is square to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight {
    pub eye: DVec3,
    /// Right, up and back, unit vectors of the world.
    pub axes: DMat3,
}

impl Sight {
    /// What a node at `world` sees; `path` is named where it has no direction.
    pub fn of(world: DAffine3, path: &str) -> Result<Self, GltfError> {
        let wrong = |what: &str| GltfError::field(path, what, "a place and a direction in the world");
        let (eye, matrix) = (world.translation, world.matrix3);
        if !(eye.is_finite() && matrix.is_finite()) {
            return Err(wrong("a transform that is not finite"));
        }
        let back = unit(matrix.z_axis).ok_or_else(|| wrong("a transform without a z axis"))?;
        let up = unit(matrix.y_axis).filter(|up| up.cross(back).length() > 1e-9).unwrap_or_else(|| up_for(back));
        Self::looking(eye, back, up).ok_or_else(|| wrong("a transform without a direction"))
    }

    /// A sight from `eye` with its back, a unit vector, and about what is up.
    pub fn looking(eye: DVec3, back: DVec3, up: DVec3) -> Option<Self> {
        let right = unit(up.cross(back))?;
        Some(Self { eye, axes: DMat3::from_cols(right, back.cross(right), back) })
    }

    /// The placement of a view.
    pub fn world_to_eye(&self) -> DMat4 {
        DMat4::from_mat3(self.axes.transpose()) * DMat4::from_translation(-self.eye)
    }
}

fn unit(vector: DVec3) -> Option<DVec3> {
    let most = vector.abs().max_element();
    (vector / most).try_normalize()
}

/// What stands in a scene, for questions about all of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Things<'a> {
    pub objects: &'a [Object],
    pub origin: DVec3,
    /// A box of the world around all of them, with some extent.
    pub bounds: [DVec3; 2],
}

impl<'a> Things<'a> {
    /// Objects about an origin. Without any their box is the one of half an edge of 1 about the world's origin.
    pub fn new(objects: &'a [Object], origin: DVec3) -> Self {
        let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        for at in objects.iter().flat_map(|object| object.shape.hull()) {
            let at = origin + at.as_dvec3();
            bounds = [bounds[0].min(at), bounds[1].max(at)];
        }
        if !bounds[0].is_finite() {
            bounds = [DVec3::NEG_ONE, DVec3::ONE];
        } else if bounds[0] == bounds[1] {
            let least = bounds[0].abs().max_element().max(1.0) * 1e-6;
            bounds = [bounds[0] - least, bounds[1] + least];
        }
        Self { objects, origin, bounds }
    }

    /// The middle of the box.
    pub fn middle(&self) -> DVec3 {
        self.bounds[0] + (self.bounds[1] - self.bounds[0]) * 0.5
    }

    /// Half the box's diagonal.
    pub fn radius(&self) -> f64 {
        (self.bounds[1] - self.bounds[0]).length() * 0.5
    }

    /// A box around all in the axes of a sight: right, up, and behind its eye.
    pub fn in_sight(&self, sight: &Sight) -> [DVec3; 2] {
        let (turn, from) = (sight.axes.transpose(), self.origin - sight.eye);
        let points = self.objects.iter().flat_map(|object| object.shape.hull());
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [low, high] = points.fold(empty, |[low, high], at| {
            let at = turn * (at.as_dvec3() + from);
            [low.min(at), high.max(at)]
        });
        if low.is_finite() {
            return [low, high];
        }
        let (middle, half) = (turn * (self.middle() - sight.eye), DVec3::splat(self.radius()));
        [middle - half, middle + half]
    }

    /// At least as near to a place as any caster, by boxes around its triangles, and as far as the farthest point of anything.
    pub fn reach(&self, eye: DVec3) -> [f64; 2] {
        let from = self.origin - eye;
        let (mut near, mut far) = (f64::INFINITY, 0.0_f64);
        for object in self.objects {
            far = object.shape.hull().fold(far, |far, at| far.max((at.as_dvec3() + from).length()));
            if object.casts && matches!(object.shape, Shape::Mesh(_)) {
                near = near.min(object.shape.nearest(-from));
            }
        }
        [near, far]
    }
}
