//! Eight triangles at once: what [`Making::add`] does for those that are not cut, step by step, over arrays of eight. A compiler
//! makes vector instructions of it, and the same bits.

#![expect(clippy::needless_range_loop, reason = "one index names a lane in several arrays")]

use crate::Triangle;
use crate::clip::{GUARD_TEXELS, NEAR_LIMIT};
use crate::piece::Patch;
use crate::setup::{FARTHEST, Making, Reach, STEP, Whole, nearer, rounded};
use crate::small::Small;
use glam::{DVec3, IVec2};
use umbrage_plane::{Affine, Kind, LANES, Lanes3, Sampling, View};

/// All bits set where something holds, which vector instructions compare to.
type Mask = [u64; LANES];

/// What a view makes of eight triangles.
struct Seen {
    /// Where nothing about the triangle is unusual, so that the other fields hold what [`Making::add`] would find.
    plain: Mask,
    before_near: Mask,
    /// Snapped corners, coordinate by coordinate.
    x: [[i32; LANES]; 3],
    y: [[i32; LANES]; 3],
    /// Twice the area.
    area: [i64; LANES],
    /// The planes' c, dx and dy.
    plane: Lanes3,
}

impl Making<'_> {
    /// [`Making::add`] of each triangle.
    #[expect(clippy::match_same_arms, reason = "compiled once for each projection, on which no loop then branches")]
    #[inline(always)]
    pub fn add_all(&mut self, triangles: &[Triangle]) {
        let view = self.setup.view;
        match (view.is_perspective(), view.kind()) {
            (true, Kind::Axial | Kind::Radial) => self.add_eights(&view, triangles),
            (false, Kind::Axial | Kind::Radial) => self.add_eights(&view, triangles),
            (_, Kind::Screen) => {
                for triangle in triangles {
                    self.add(triangle);
                }
            }
        }
    }

    #[inline(always)]
    fn add_eights(&mut self, view: &View, triangles: &[Triangle]) {
        let (eights, rest) = triangles.as_chunks::<LANES>();
        for eight in eights {
            let seen = seen(view, eight);
            let small = self.small(&seen);
            for (lane, triangle) in eight.iter().enumerate() {
                if seen.plain[lane] == 0 {
                    self.add(triangle);
                    continue;
                }
                let corner = |corner: usize| IVec2::new(seen.x[corner][lane], seen.y[corner][lane]);
                let whole = Whole {
                    corners: [corner(0), corner(1), corner(2)],
                    area: seen.area[lane],
                    plane: Affine { c: seen.plane.x[lane], dx: seen.plane.y[lane], dy: seen.plane.z[lane] },
                    before_near: seen.before_near[lane] != 0,
                };
                if small.holds[lane] != 0 {
                    self.add_small(triangle, &whole, Patch(small.patch[lane]), small.home[lane]);
                } else {
                    self.add_whole(triangle, &whole);
                }
            }
        }
        for triangle in rest {
            self.add(triangle);
        }
    }

    #[inline(always)]
    fn small(&self, seen: &Seen) -> Smalls {
        let mut small = Smalls { holds: [0; LANES], home: [0; LANES], patch: [0; LANES] };
        if matches!(self.setup.reach, Reach::Samples(Sampling::Centre)) {
            let (window, tiles, x, y) = (self.setup.window, self.setup.tiles_across(), &seen.x, &seen.y);
            for i in 0..LANES {
                let one = Small::of([x[0][i], x[1][i], x[2][i]], [y[0][i], y[1][i], y[2][i]], window, tiles);
                (small.holds[i], small.home[i], small.patch[i]) = (one.holds, one.home, one.patch.0);
            }
        }
        small
    }
}

/// [`Small`] of eight triangles.
struct Smalls {
    holds: [u32; LANES],
    home: [u32; LANES],
    patch: [u32; LANES],
}

/// Keeps a mask where something else holds as well.
#[inline(always)]
fn narrow(mask: &mut Mask, holds: impl Fn(usize) -> bool) {
    for i in 0..LANES {
        mask[i] &= if holds(i) { u64::MAX } else { 0 };
    }
}

/// Extends a mask to where something else holds.
#[inline(always)]
fn widen(mask: &mut Mask, holds: impl Fn(usize) -> bool) {
    for i in 0..LANES {
        mask[i] |= if holds(i) { u64::MAX } else { 0 };
    }
}

#[inline(always)]
fn seen(view: &View, triangles: &[Triangle; LANES]) -> Seen {
    let to_eye = view.world_to_eye();
    let near = view.near();
    let limit = if view.is_perspective() { near * NEAR_LIMIT } else { f64::NEG_INFINITY };
    let corner = |corner: usize| Lanes3::of(|i| triangles[i].corners[corner]);
    let world = [corner(0), corner(1), corner(2)];
    let ab = Lanes3::of(|i| world[1].at(i) - world[0].at(i));
    let ac = Lanes3::of(|i| world[2].at(i) - world[0].at(i));
    let normal = Lanes3::of(|i| ab.at(i).cross(ac.at(i)));
    let mut plain = [0; LANES];
    widen(&mut plain, |i| normal.x[i] != 0.0);
    widen(&mut plain, |i| normal.y[i] != 0.0);
    widen(&mut plain, |i| normal.z[i] != 0.0);
    let mut before_near = [0; LANES];
    let (mut x, mut y) = ([[0; LANES]; 3], [[0; LANES]; 3]);
    let (mut least, mut greatest) = ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    let mut through = world[0];
    for corner in 0..3 {
        let place = &world[corner];
        narrow(&mut plain, |i| place.x[i].abs() < FARTHEST);
        narrow(&mut plain, |i| place.y[i].abs() < FARTHEST);
        narrow(&mut plain, |i| place.z[i].abs() < FARTHEST);
        let eye = Lanes3::of(|i| to_eye.transform_point3(place.at(i)));
        // Where x or y of the eye are not finite, their texel is not inside.
        narrow(&mut plain, |i| -eye.z[i] >= limit);
        narrow(&mut plain, |i| -eye.z[i] < f64::INFINITY);
        widen(&mut before_near, |i| -eye.z[i] < near);
        let texels = Lanes3::of(|i| view.eye_to_texel(eye.at(i)).extend(view.key(-eye.z[i])));
        narrow(&mut plain, |i| texels.x[i].abs() <= GUARD_TEXELS);
        narrow(&mut plain, |i| texels.y[i].abs() <= GUARD_TEXELS);
        for i in 0..LANES {
            x[corner][i] = rounded(texels.x[i]);
            y[corner][i] = rounded(texels.y[i]);
        }
        for i in 0..LANES {
            let key = texels.z[i];
            least[i] = if key < least[i] { key } else { least[i] };
            greatest[i] = if key > greatest[i] { key } else { greatest[i] };
        }
        through = if corner == 0 { eye } else { Lanes3::of(|i| nearer(through.at(i), eye.at(i))) };
    }
    let ab = Lanes3::of(|i| to_eye.transform_vector3(ab.at(i)));
    let ac = Lanes3::of(|i| to_eye.transform_vector3(ac.at(i)));
    let normal = Lanes3::of(|i| ab.at(i).cross(ac.at(i)));
    let plane = Lanes3::of(|i| {
        let Affine { c, dx, dy } = view.plane(through.at(i), normal.at(i));
        DVec3::new(c, dx, dy)
    });
    narrow(&mut plain, |i| plane.x[i].abs() < f64::INFINITY);
    narrow(&mut plain, |i| {
        let step = (plane.y[i].abs() + plane.z[i].abs()) * STEP;
        step <= (greatest[i] - least[i]).min(f64::MAX)
    });
    let mut area = [0; LANES];
    for i in 0..LANES {
        // What is not plain may be anywhere.
        let along = |all: &[[i32; LANES]; 3], corner: usize| i64::from(all[corner][i].wrapping_sub(all[0][i]));
        let (bx, by, cx, cy) = (along(&x, 1), along(&y, 1), along(&x, 2), along(&y, 2));
        area[i] = (bx * cy).wrapping_sub(by * cx);
    }
    Seen { plain, before_near, x, y, area, plane }
}
