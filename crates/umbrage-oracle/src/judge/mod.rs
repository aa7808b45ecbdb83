//! The faults of anybody's scene under anybody's light: what a shadow image gets wrong against truth, found without a place put by hand.
//!
//! A [`Judge`] knows what the camera sees of a scene, where its light is and what rays say. It gives the [`Score`] of any shadow image of the
//! same camera: how large each fault is, and [where](Where) it is.
//!
//! | what | definition |
//! |---|---|
//! | judged | pixels that see one surface, all of it inside the light's map and its cone, at a cosine above [`FACING`] |
//! | false shadow | judged, truth below [`LIT`], result above ½ |
//! | false light | judged, truth above [`DARK`], result below ½ |
//! | acne | false shadow farther from truth's edges than the filter looks |
//! | detachment | false light that is dark in the same picture without any bias, not for the filter's width, and where the bias reaches what blocks the light |
//! | leak | other false light farther from truth's edges than the filter looks |
//!
//! **How far the filter looks.** A filter looks at a box of the map about the receiver's place ([`Recipe::reach`](umbrage_recipe::Recipe::reach)), and can be
//! wrong without any fault of its comparison wherever an edge of truth goes through it. That box is laid on the receiver, pixel by pixel: rays
//! are cast from [`PLACES`]² places of it, its border included, each brought along the normal onto the surface of the receiver's own object.
//! Where all of them agree, no edge of truth is as near as the filter looks, whether the camera sees it or something hides it.
//! In acne, then, what was compared is the receiver's own surface, or one that truth does not see between the receiver and the light.
//!
//! For a detachment the picture without bias, of the same filter, takes the place of the distance, so that thin shadows have it too: what the filter's
//! width alone makes light is light in both. Acne may darken the one without bias, though. So most of the box must be dark in truth, and
//! the result less than half as dark as all of the box is, and somewhere in the box what blocks the light must lie before what is compared by no
//! more than the recipe's [largest bias](umbrage_recipe::Recipe::largest_bias): a bias passes nothing that is farther away. Two sheets that are closer together than the bias count as a detachment as well:
//! without the bias the lower one would be dark. How large a detachment is, is the distance along the light's ray from the receiver to what truth
//! says blocks it.
//!
//! A foreign image has no recipe: its filter is taken to look [`FOREIGN`] pixels far, and detachment and leaks, which only a picture
//! without bias can tell apart, are left out.

mod marks;
mod region;
mod score;
mod unjudged;

pub use marks::Where;
pub use score::{Drawn, Score, Size};
pub use unjudged::Unjudged;

use glam::{DVec2, DVec3, UVec2, Vec3};
use rayon::prelude::*;
use umbrage_plane::{Receiver, SurfacePoint, View};
use umbrage_sample::Key;
use umbrage_shadow::Shadow;

use crate::Geometry;

/// Least cosine between a judged surface and the light.
pub const FACING: f32 = 0.02;
/// Below this truth is lit.
pub const LIT: f32 = 0.05;
/// Above this truth is dark.
pub const DARK: f32 = 0.95;
/// Places along each side of the box that a filter looks at.
pub const PLACES: u32 = 5;
/// How far the filter of a foreign image is taken to look, pixels to each side.
pub const FOREIGN: f64 = 3.0;

/// What a camera sees, pixel by pixel; all slices have a pixel for each of the camera's texels, rows from the top.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The largest surface's place, world space; NaN where nothing is seen.
    pub position: &'a [DVec3],
    /// Its geometric unit normal on the visible side.
    pub normal: &'a [Vec3],
    /// Its object.
    pub object: &'a [u32],
    /// Fraction of the pixel that its object has, 0..=1.
    pub share: &'a [f32],
    /// Mean cosine between geometric normal and light over the pixel.
    pub facing: &'a [f32],
}

/// Truth of one light, and which pixels are judged by it.
pub struct Judge<'a> {
    camera: View,
    lights: Vec<View>,
    geometry: &'a Geometry,
    rays: &'a (dyn Shadow + 'a),
    key: Key,
    seen: Seen<'a>,
    truth: &'a [f32],
    judged: Vec<bool>,
}

impl<'a> Judge<'a> {
    /// `truth` is the picture that `rays` gave, `lights` the views of the light's maps: one, or several that stand around it. `geometry` is what was traced.
    ///
    /// # Panics
    /// When a slice has another number of pixels than the camera.
    pub fn new(
        (camera, lights): (&View, &[View]),
        geometry: &'a Geometry,
        (rays, truth): (&'a (dyn Shadow + 'a), &'a [f32]),
        seen: Seen<'a>,
    ) -> Self {
        let pixels = camera.size().element_product() as usize;
        let Seen { position, normal, object, share, facing } = seen;
        let lengths = [truth.len(), position.len(), normal.len(), object.len(), share.len(), facing.len()];
        assert!(lengths.iter().all(|length| *length == pixels), "a picture of another size than the camera's");
        let mut judge = Self {
            camera: *camera,
            lights: lights.to_vec(),
            geometry,
            rays,
            key: Key::new(0, 0, 0),
            seen,
            truth,
            judged: Vec::new(),
        };
        judge.judged = (0..pixels).into_par_iter().map(|pixel| judge.unjudged(pixel).is_none()).collect();
        judge
    }

    /// Columns and rows.
    pub fn size(&self) -> UVec2 {
        self.camera.size()
    }

    /// The pixels that are judged.
    pub fn judged(&self) -> &[bool] {
        &self.judged
    }

    /// Truth, 1 dark.
    pub fn truth(&self) -> &'a [f32] {
        self.truth
    }

    /// What a pixel sees, with the pixel's own extent on the tangent plane; `None` where that is edge-on.
    fn point(&self, pixel: usize) -> Option<SurfacePoint> {
        let (position, normal) = (self.seen.position[pixel], self.seen.normal[pixel]);
        let width = self.camera.size().x as usize;
        let corner = DVec2::new((pixel % width) as f64, (pixel / width) as f64);
        let point = SurfacePoint {
            object: self.seen.object[pixel],
            region: pixel as u32,
            ..SurfacePoint::at(position, normal)
        };
        let around =
            [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|by| on_plane(&self.camera, corner + by, &point));
        let [Some(a), Some(b), Some(c), Some(d)] = around else { return None };
        Some(point.with_corners([a, b, c, d]))
    }

    /// The view of the light's maps that a point lies in, and the point there; `None` where it lies in none.
    fn received(&self, point: &SurfacePoint) -> Option<(&View, Receiver)> {
        let inside = |view: &'_ View| {
            let receiver = view.receiver(point).ok()?;
            view.holds(receiver.texel.as_vec2(), glam::Vec2::ZERO).then_some(receiver)
        };
        self.lights.iter().find_map(|view| Some((view, inside(view)?)))
    }
}

/// Where the ray through a view's texel position meets the tangent plane of a point; `None` where that is more than a few times as far away as the point itself.
fn on_plane(view: &View, texel: DVec2, point: &SurfacePoint) -> Option<DVec3> {
    let (origin, direction) = view.ray(texel);
    let normal = point.normal.as_dvec3();
    let t = (point.position - origin).dot(normal) / direction.dot(normal);
    let own = (point.position - origin).length();
    (t > 0.25 * own && t < 4.0 * own).then(|| origin + direction * t)
}
