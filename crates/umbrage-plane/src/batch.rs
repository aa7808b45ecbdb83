//! Many receivers at once. Every step is the one of [`View::receiver`], in its order of operations, over arrays of eight: so
//! that a compiler makes vector instructions of it, and the same bits.

#![expect(clippy::needless_range_loop, reason = "one index names a lane in several arrays")]

use crate::lanes::{LANES, Lanes, Lanes3};
use crate::{Footprint, Kind, Place, Projection, Receiver, SurfacePoint, View, vectorized};
use glam::{DMat4, DVec2, Vec2, Vec3};

impl Lanes3 {
    /// [`DMat4::transform_vector3`] of each.
    #[inline(always)]
    fn turned(&self, by: &DMat4) -> Self {
        let mut all = *self;
        for i in 0..LANES {
            let (x, y, z) = (self.x[i], self.y[i], self.z[i]);
            all.x[i] = by.z_axis.x * z + (by.y_axis.x * y + by.x_axis.x * x);
            all.y[i] = by.z_axis.y * z + (by.y_axis.y * y + by.x_axis.y * x);
            all.z[i] = by.z_axis.z * z + (by.y_axis.z * y + by.x_axis.z * x);
        }
        all
    }

    /// Each plus the other's.
    #[inline(always)]
    fn plus(&self, other: &Self) -> Self {
        let mut all = *self;
        for i in 0..LANES {
            all.x[i] += other.x[i];
            all.y[i] += other.y[i];
            all.z[i] += other.z[i];
        }
        all
    }

    /// [`DVec3::dot`] of each with the other's.
    #[inline(always)]
    fn dot(&self, other: &Self) -> Lanes {
        let mut all = [0.0; LANES];
        for i in 0..LANES {
            all[i] = self.x[i] * other.x[i] + self.y[i] * other.y[i] + self.z[i] * other.z[i];
        }
        all
    }
}

/// A place in a map of each, coordinate by coordinate.
#[derive(Clone, Copy)]
struct Lanes2<T> {
    x: [T; LANES],
    y: [T; LANES],
}

impl Lanes2<f64> {
    #[inline(always)]
    fn at(&self, lane: usize) -> DVec2 {
        DVec2::new(self.x[lane], self.y[lane])
    }
}

impl Lanes2<f32> {
    #[inline(always)]
    fn at(&self, lane: usize) -> Vec2 {
        Vec2::new(self.x[lane], self.y[lane])
    }
}

/// The map's origin, where nothing is known yet.
const NOWHERE: Lanes2<f32> = Lanes2 { x: [0.0; LANES], y: [0.0; LANES] };

/// The images of eight regions, as [`Footprint`] and [`Receiver::axes`] have them.
struct Regions {
    /// Whether a region has an extent, is all in front of the light, and small enough: the image of another one is a point, or has to be cut.
    whole: [bool; LANES],
    centre: Lanes2<f32>,
    half: Lanes2<f32>,
    corners: [Lanes2<f32>; 4],
    axes: [Lanes2<f32>; 2],
}

impl Regions {
    /// The image of one, and its half-axes.
    #[inline(always)]
    fn at(&self, lane: usize) -> (Footprint, [Vec2; 2]) {
        let Self { centre, half, corners: [a, b, c, d], axes: [x, y], .. } = self;
        let corners = [a.at(lane), b.at(lane), c.at(lane), d.at(lane)];
        (Footprint { centre: centre.at(lane), half: half.at(lane), corners }, [x.at(lane), y.at(lane)])
    }
}

impl View {
    /// [`View::receiver`] of every point, bit for bit, in a fraction of the time when there are many: `out[i]` is that of `at[i]`.
    ///
    /// # Panics
    /// When `at` and `out` are not of one length.
    pub fn receivers(&self, at: &[SurfacePoint], out: &mut [Result<Receiver, Place>]) {
        self.receivers_for(at, true, out);
    }

    /// [`View::receivers`] with [`Receiver::facing`] and [`Receiver::slope`] only if `tilted`. Without, it takes four fifths of the time, and both are NaN in some
    /// of the receivers or in all.
    ///
    /// # Panics
    /// When `at` and `out` are not of one length.
    pub fn receivers_for(&self, at: &[SurfacePoint], tilted: bool, out: &mut [Result<Receiver, Place>]) {
        assert_eq!(at.len(), out.len(), "as many receivers as points");
        vectorized!(_ => self.fill(at, tilted, out));
    }

    #[inline(always)]
    fn fill(&self, at: &[SurfacePoint], tilted: bool, out: &mut [Result<Receiver, Place>]) {
        let (points, rest) = at.as_chunks::<LANES>();
        let (seen, seen_rest) = out.as_chunks_mut::<LANES>();
        for (points, seen) in points.iter().zip(seen) {
            self.eight(points, tilted, seen);
        }
        for (point, seen) in rest.iter().zip(seen_rest) {
            *seen = self.receiver(point);
        }
    }

    #[inline(always)]
    fn eight(&self, at: &[SurfacePoint; LANES], tilted: bool, out: &mut [Result<Receiver, Place>; LANES]) {
        let eye = Lanes3::of(|i| at[i].position).turned(&self.world_to_eye).plus(&self.origin());
        let normal = Lanes3::of(|i| at[i].normal.as_dvec3()).turned(&self.world_to_eye);
        let (facing, slope) = if tilted { self.tilts(&eye, &normal) } else { ([f64::NAN; LANES], [f64::NAN; LANES]) };
        let (depth, texel_world) = (self.depths(&eye), self.texels_world(&eye));
        let texels = self.texels(&eye);
        let regions = self.regions(at, &eye);
        for i in 0..LANES {
            let own = eye.at(i);
            if let Err(place) = self.reached(-own.z) {
                out[i] = Err(place);
                continue;
            }
            let texel = texels.at(i);
            let (footprint, axes) = match &regions {
                Some(regions) if regions.whole[i] => regions.at(i),
                _ => {
                    let footprint = self.footprint(&at[i], own, texel.as_vec2());
                    (footprint, footprint.axes())
                }
            };
            out[i] = Ok(Receiver {
                kind: self.kind,
                footprint,
                texel,
                axes,
                cells: at[i].cells,
                depth: depth[i],
                texel_world: texel_world[i],
                facing: facing[i] as f32,
                slope: slope[i] as f32,
                object: at[i].object,
                eye: own,
                normal: normal.at(i),
            });
        }
    }

    /// The shift of world to eye space, for each.
    #[inline(always)]
    fn origin(&self) -> Lanes3 {
        Lanes3::of(|_| self.world_to_eye.w_axis.truncate())
    }

    /// [`View::eye_to_texel`] of each.
    #[inline(always)]
    fn texels(&self, eye: &Lanes3) -> Lanes2<f64> {
        let mut all = Lanes2 { x: [0.0; LANES], y: [0.0; LANES] };
        for i in 0..LANES {
            let texel = self.eye_to_texel(eye.at(i));
            (all.x[i], all.y[i]) = (texel.x, texel.y);
        }
        all
    }

    /// The images of the points' regions; `None` when none has an extent.
    #[inline(always)]
    fn regions(&self, at: &[SurfacePoint; LANES], eye: &Lanes3) -> Option<Regions> {
        if at.iter().all(|point| point.corner_offsets == [Vec3::ZERO; 4]) {
            return None;
        }
        let mut whole = [true; LANES];
        for i in 0..LANES {
            let [first, second, third, _] = at[i].corner_offsets;
            whole[i] = second != first || third != first;
        }
        let mut corners = [NOWHERE; 4];
        for (corner, images) in corners.iter_mut().enumerate() {
            let offset = Lanes3::of(
                #[inline(always)]
                |i| at[i].corner_offsets[corner].as_dvec3(),
            );
            let place = eye.plus(&offset.turned(&self.world_to_eye));
            if self.is_perspective() {
                for i in 0..LANES {
                    whole[i] &= -place.z[i] >= -eye.z[i] * (1.0 / 16.0);
                }
            }
            let texels = self.texels(&place);
            for i in 0..LANES {
                (images.x[i], images.y[i]) = (texels.x[i] as f32, texels.y[i] as f32);
            }
        }
        let most = self.size.as_vec2() * 0.25;
        let mut all = Regions { whole, centre: NOWHERE, half: NOWHERE, corners, axes: [NOWHERE; 2] };
        for i in 0..LANES {
            let footprint = Footprint::around(corners.each_ref().map(
                #[inline(always)]
                |corner| corner.at(i),
            ));
            let axes = footprint.axes();
            (all.centre.x[i], all.centre.y[i]) = (footprint.centre.x, footprint.centre.y);
            (all.half.x[i], all.half.y[i]) = (footprint.half.x, footprint.half.y);
            (all.axes[0].x[i], all.axes[0].y[i]) = (axes[0].x, axes[0].y);
            (all.axes[1].x[i], all.axes[1].y[i]) = (axes[1].x, axes[1].y);
            all.whole[i] &= footprint.half.cmple(most).all();
        }
        Some(all)
    }

    /// [`Receiver::facing`] and [`Receiver::slope`] of each, before they are rounded.
    #[inline(always)]
    fn tilts(&self, eye: &Lanes3, normal: &Lanes3) -> (Lanes, Lanes) {
        let mut toward = Lanes3 { x: [0.0; LANES], y: [0.0; LANES], z: [1.0; LANES] };
        let mut along = normal.z;
        let mut slope = [0.0; LANES];
        if self.is_perspective() {
            let mut ray = *eye;
            for i in 0..LANES {
                let zeta = -eye.z[i];
                (ray.x[i], ray.y[i], ray.z[i]) = (-eye.x[i] / zeta, -eye.y[i] / zeta, -eye.z[i] / zeta);
            }
            along = normal.dot(&ray);
            let squared = ray.dot(&ray);
            for i in 0..LANES {
                let shrink = 1.0 / squared[i].sqrt();
                (toward.x[i], toward.y[i], toward.z[i]) = (ray.x[i] * shrink, ray.y[i] * shrink, ray.z[i] * shrink);
            }
        }
        for i in 0..LANES {
            let tangent = (normal.x[i] * normal.x[i] + normal.y[i] * normal.y[i]).sqrt() / along[i].abs();
            slope[i] = if tangent.is_nan() { f64::INFINITY } else { tangent };
        }
        (normal.dot(&toward), slope)
    }

    /// [`View::depth`] of each.
    #[inline(always)]
    fn depths(&self, eye: &Lanes3) -> [f32; LANES] {
        let mut all = [0.0; LANES];
        match self.kind {
            Kind::Axial => {
                for i in 0..LANES {
                    all[i] = -eye.z[i] as f32;
                }
            }
            Kind::Screen | Kind::Radial => {
                for i in 0..LANES {
                    all[i] = self.depth(eye.at(i));
                }
            }
        }
        all
    }

    /// [`View::texel_world`] of each.
    #[inline(always)]
    fn texels_world(&self, eye: &Lanes3) -> [Vec2; LANES] {
        let size = self.size.as_dvec2();
        let mut all = [Vec2::ZERO; LANES];
        match self.projection {
            Projection::Perspective { k, .. } => {
                let below = k * size;
                for i in 0..LANES {
                    all[i] = (2.0 * -eye.z[i] / below).as_vec2();
                }
            }
            Projection::Orthographic { .. } => all = [self.texel_world(1.0).as_vec2(); LANES],
        }
        all
    }
}
