use super::Shadow;
use super::around::nearest;
use super::parts::in_parts;
use crate::{Biased, Pcf, Query};
use glam::{DVec2, DVec3, IVec2, UVec2, Vec2};
use umbrage_depth::{DepthMap, MapError, Raw};
use umbrage_plane::{
    DepthRange, Footprint, Kind, Receiver, Rules, SurfacePoint, TexelRect, View, ViewError, vectorized,
};
use umbrage_sample::{Jittered, Key, Pattern};

/// Why a latitude-longitude map cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LatLongError {
    /// No map to take depths from.
    #[error("a latitude-longitude map is made from at least one map")]
    Empty,
    /// The maps store no Euclidean distance.
    #[error("a latitude-longitude map is made from maps of radial depth")]
    Kind,
    /// Its size is unusable.
    #[error(transparent)]
    Size(#[from] ViewError),
    /// A depth is unusable.
    #[error(transparent)]
    Depth(#[from] MapError),
}

/// A light in all directions as one map over latitude and longitude (Reeves 1987): columns go once around +y, from −x through
/// −z, +x and +z back; rows from +y down to −y. Depths are Euclidean.
///
/// Texels are smaller toward the poles, and regions near them wider in texels. The tangent plane is not an affine function here: only
/// biases are offered.
#[derive(Clone, Debug, PartialEq)]
pub struct LatLong<P = Jittered> {
    /// The filter over it.
    pub filter: Pcf<P, Biased>,
    eye: DVec3,
    map: Wrapped,
}

impl<P: Pattern> LatLong<P> {
    /// From maps around one light, such as a cube's faces: each texel takes the depth that they store in its direction. They
    /// should be at least as fine: faces of a quarter of `size.x` have texels of the same angle.
    ///
    /// # Errors
    /// [`LatLongError`].
    pub fn from_maps<M: DepthMap>(filter: Pcf<P, Biased>, maps: &[M], size: UVec2) -> Result<Self, LatLongError> {
        let first = maps.first().ok_or(LatLongError::Empty)?.view();
        if maps.iter().any(|map| map.view().kind() != Kind::Radial) {
            return Err(LatLongError::Kind);
        }
        // Stands for the texel grid alone: nothing is projected by it.
        let grid = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, first.near(), first.far(), size)?;
        let grid = grid.with_kind(Kind::Radial).with_rules(Rules::AROUND);
        let seen = |texel: IVec2| {
            let direction = direction(texel.as_dvec2() + 0.5, size);
            let map = &maps[nearest(maps, direction)];
            let eye = map.view().world_to_eye().transform_vector3(direction);
            map.depth(map.view().eye_to_texel(eye).floor().as_ivec2())
        };
        let depths = TexelRect::of_size(size).texels().map(seen).collect();
        Ok(Self { filter, eye: first.light().truncate(), map: Wrapped(Raw::new(grid, depths)?) })
    }

    /// Bytes held for depths.
    pub fn bytes(&self) -> usize {
        self.map.bytes()
    }

    /// A surface point on the map; corners on the far side of the date line are moved to this side.
    fn receiver(&self, at: &SurfacePoint) -> Receiver {
        let size = self.map.view().size();
        let from_eye = at.position - self.eye;
        let distance = from_eye.length();
        let centre = texel(from_eye, size);
        let width = f64::from(size.x);
        let corners = at.corner_offsets.map(|offset| {
            let mut place = texel(from_eye + offset.as_dvec3(), size);
            place.x -= ((place.x - centre.x) / width).round() * width;
            place.as_vec2()
        });
        let most = size.as_vec2() * Vec2::new(0.5, 0.25);
        let around = Footprint::around(corners);
        let footprint = Footprint { half: around.half.min(most), ..around };
        let (toward, normal) = (-from_eye / distance, at.normal.as_dvec3());
        let facing = normal.dot(toward);
        let step = distance * std::f64::consts::PI / size.as_dvec2();
        let level = (1.0 - (from_eye.y / distance).powi(2)).sqrt();
        Receiver {
            kind: Kind::Radial,
            footprint,
            texel: centre,
            axes: footprint.axes(),
            cells: at.cells,
            depth: distance as f32,
            texel_world: (step * DVec2::new(2.0 * level, 1.0)).as_vec2(),
            facing: facing as f32,
            slope: ((1.0 - facing * facing).max(0.0).sqrt() / facing.abs()) as f32,
            object: at.object,
            eye: from_eye,
            normal,
        }
    }
}

impl<P: Pattern> Shadow for LatLong<P> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        in_parts(at, out, |at, out| {
            vectorized!(simd => {
                for (point, fraction) in at.iter().zip(out.iter_mut()) {
                    let (receiver, key) = (self.receiver(point), key.region(point.region));
                    *fraction = Query::new(simd, &self.map, &receiver, key, &mut ()).ask(&self.filter);
                }
            });
        });
    }
}

/// The direction that a texel position shows, of unit length.
fn direction(texel: DVec2, size: UVec2) -> DVec3 {
    let turns = texel / size.as_dvec2();
    let (sin_down, cos_down) = (turns.y * std::f64::consts::PI).sin_cos();
    let (sin, cos) = (turns.x * std::f64::consts::TAU).sin_cos();
    DVec3::new(-cos * sin_down, cos_down, -sin * sin_down)
}

/// Where a direction (any length but 0) falls: columns in 0..width, rows in 0..=height.
fn texel(direction: DVec3, size: UVec2) -> DVec2 {
    let around = (-direction.z).atan2(-direction.x).rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU;
    let down = (direction.y / direction.length()).clamp(-1.0, 1.0).acos() / std::f64::consts::PI;
    DVec2::new(around, down) * size.as_dvec2()
}

/// A map that goes on at its left and right border, and across the poles.
#[derive(Clone, Debug, PartialEq)]
struct Wrapped(Raw);

impl DepthMap for Wrapped {
    fn view(&self) -> &View {
        self.0.view()
    }

    fn depth(&self, texel: IVec2) -> f32 {
        let size = self.view().size().as_ivec2();
        let mut at = texel;
        if at.y < 0 || at.y >= size.y {
            let row = at.y.rem_euclid(2 * size.y);
            let over = row >= size.y;
            at.y = if over { 2 * size.y - 1 - row } else { row };
            at.x += if over { size.x / 2 } else { 0 };
        }
        self.0.depth(IVec2::new(at.x.rem_euclid(size.x), at.y))
    }

    fn range(&self, rect: TexelRect) -> DepthRange {
        if TexelRect::of_size(self.view().size()).encloses(rect) { self.0.range(rect) } else { DepthRange::UNKNOWN }
    }

    fn bytes(&self) -> usize {
        self.0.bytes()
    }

    fn allocated(&self) -> usize {
        self.0.allocated()
    }
}
