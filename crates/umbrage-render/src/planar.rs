use crate::Soup;
use glam::{DVec2, DVec3, DVec4, UVec2};
use std::sync::Arc;
use umbrage_bake::{Caster, MaskPlace, bake};
use umbrage_depth::{DepthMap, First, Tiled};
use umbrage_plane::{SurfacePoint, View, ViewError, planar_shadow};
use umbrage_raster::{Cull, Triangle};
use umbrage_sample::Key;
use umbrage_scene::Scene;
use umbrage_shadow::{Shadow, same_length};

/// A rectangle of a plane that receives planar shadows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Its middle, world space.
    pub centre: DVec3,
    /// Normal on the lit side, any length but 0.
    pub normal: DVec3,
    /// Half of its larger side, world units; the rectangle is a square.
    pub half_side: f64,
}

/// The cheaper method that Williams contrasts with his: every caster is flattened onto one plane (Williams 1978).
///
/// The shadow is drawn once into a mask of the plane, so that nothing darkens twice. Points elsewhere get no shadow, whatever stands
/// between them and the light: not other objects, not curved receivers.
pub struct Planar {
    /// Looks down on the plane; a finite depth is shadow.
    mask: Arc<Tiled>,
    ground: Ground,
}

impl Planar {
    /// Flattens what casts in `scene` but the object `receiver` onto `ground`, as `light` throws it. What is not between light and
    /// plane is cut off. `texels` across the mask.
    ///
    /// # Errors
    /// [`ViewError`], for a ground or a mask without extent.
    pub fn new(scene: &Scene, light: &View, ground: Ground, receiver: u32, texels: u32) -> Result<Self, ViewError> {
        let normal = ground.normal.normalize_or_zero();
        let up = normal.any_orthonormal_vector();
        let (eye, half) = (ground.centre + normal, ground.half_side);
        let looking_down = View::orthographic(eye, ground.centre, up, half, 0.5, 1.5, UVec2::splat(texels))?;
        let light_at = light.light();
        let flatten = Flatten {
            centre: ground.centre,
            plane: normal.extend(0.0),
            light: (light_at.truncate() - ground.centre * light_at.w).extend(light_at.w),
        };
        let soup = Soup::casters(scene, light);
        let flat: Vec<(u32, Triangle)> = (0..)
            .zip(soup.triangles())
            .filter(|(_, triangle)| triangle.object != receiver)
            .flat_map(|(index, triangle)| flatten.triangle(&triangle).into_iter().map(move |flat| (index, flat)))
            .collect();
        let alpha_test = |place: &MaskPlace| {
            let (index, Triangle { corners: [a, b, c], .. }) = flat[place.triangle as usize];
            let at = a * place.weights.x + b * place.weights.y + c * place.weights.z;
            let thrown_by = flatten.back(at, soup.corners(index).0);
            soup.cover(index).is_there(soup.uv(index, thrown_by))
        };
        let casters = flat.iter().map(|&(index, triangle)| {
            let caster = Caster::from(triangle);
            if soup.cover(index).has_holes() { caster.with_mask(&alpha_test) } else { caster }
        });
        let mask = bake(&looking_down, casters, &First, Cull::None).map;
        Ok(Self { mask, ground: Ground { normal, ..ground } })
    }

    fn is_dark(&self, at: &SurfacePoint) -> bool {
        let world = at.position;
        let off = (world - self.ground.centre).dot(self.ground.normal).abs();
        let faces = at.normal.as_dvec3().dot(self.ground.normal) > 0.5;
        if !faces || off > 1e-4 * self.ground.half_side {
            return false;
        }
        let view = self.mask.view();
        let texel: DVec2 = view.eye_to_texel(view.world_to_eye().transform_point3(world));
        self.mask.depth(texel.floor().as_ivec2()).is_finite()
    }
}

impl Shadow for Planar {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        same_length(at, out);
        for (point, fraction) in at.iter().zip(out) {
            *fraction = f32::from(u8::from(self.is_dark(point)));
        }
    }
}

/// Throws triangles onto a plane. It counts from the ground's middle: products of large coordinates would leave nothing of
/// small ones.
struct Flatten {
    centre: DVec3,
    plane: DVec4,
    light: DVec4,
}

impl Flatten {
    /// The shadow of the part of a triangle that is above the plane and below a point light.
    fn triangle(&self, triangle: &Triangle) -> Vec<Triangle> {
        let height = |at: DVec3| self.plane.dot(at.extend(1.0));
        let lamp = self.plane.dot(self.light);
        if lamp <= 0.0 {
            return Vec::new();
        }
        let mut corners: Vec<DVec3> = triangle.corners.iter().map(|corner| corner - self.centre).collect();
        corners = keep(&corners, height);
        if self.light.w != 0.0 {
            // A little below the light: its own height has no shadow.
            corners = keep(&corners, |at| (1.0 - 1e-6) * lamp - height(at));
        }
        let matrix = planar_shadow(self.plane, self.light);
        let flat: Vec<DVec3> = corners
            .iter()
            .map(|corner| {
                let at = matrix * corner.extend(1.0);
                self.centre + at.truncate() / at.w
            })
            .collect();
        (1..flat.len().saturating_sub(1))
            .map(|i| Triangle { corners: [flat[0], flat[i], flat[i + 1]], ..*triangle })
            .collect()
    }
}

impl Flatten {
    /// The place of a triangle's plane whose shadow is at a place of the ground.
    fn back(&self, at: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
        let normal = (b - a).cross(c - a);
        let toward_light = self.light.truncate() - (at - self.centre) * self.light.w;
        at + toward_light * (normal.dot(a - at) / normal.dot(toward_light))
    }
}

/// The part of a polygon where `inside` is not negative (Sutherland and Hodgman 1974).
fn keep(corners: &[DVec3], inside: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (index, &start) in corners.iter().enumerate() {
        let end = corners[(index + 1) % corners.len()];
        let (at_start, at_end) = (inside(start), inside(end));
        if at_start >= 0.0 {
            kept.push(start);
        }
        if (at_start >= 0.0) != (at_end >= 0.0) {
            kept.push(start + (end - start) * (at_start / (at_start - at_end)));
        }
    }
    kept
}
