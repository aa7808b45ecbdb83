//! Eight triangles at once: what [`Making::add`] does for those that are not cut, step by step, over arrays of eight. A compiler
//! makes vector instructions of it, and the same bits.

#![expect(clippy::needless_range_loop, reason = "one index names a lane in several arrays")]

use crate::Triangle;
use crate::clip::{GUARD_TEXELS, NEAR_LIMIT};
use crate::mesh::IndexedMesh;
use crate::piece::{Owner, Patch};
use crate::setup::{FARTHEST, Making, Reach, STEP, Whole, nearer, rounded};
use crate::small::Small;
use glam::{DVec3, IVec2, Vec3};
use std::ops::Range;
use umbrage_plane::{Affine, Kind, LANES, Lanes, Lanes3, Sampling, View};

/// All bits set where something holds, which vector instructions compare to.
type Mask = [u64; LANES];

/// What a view makes of a corner of each of eight triangles.
struct Corners {
    eye: Lanes3,
    key: Lanes,
    /// Snapped.
    x: [i32; LANES],
    y: [i32; LANES],
    /// Where nothing about the corner is unusual.
    plain: Mask,
}

/// What a view makes of one corner that triangles share: a line of a processor's cache.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Corner {
    world: DVec3,
    eye: DVec3,
    key: f64,
    /// Snapped; [`UNUSUAL`] where something about the corner is.
    x: i32,
    y: i32,
}

/// No snapped coordinate is as large.
const UNUSUAL: i32 = i32::MIN;

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

/// The corners at consecutive positions of a mesh.
#[derive(Clone, Copy)]
pub(crate) struct Shared<'a> {
    /// The index of the first among all positions of the mesh.
    pub first: u32,
    pub corners: &'a [Corner],
}

/// The kinds of view whose triangles are set up eight at a time.
pub(crate) fn by_eights(view: &View) -> bool {
    match view.kind() {
        Kind::Axial | Kind::Radial => true,
        Kind::Screen => false,
    }
}

/// What a view makes of positions relative to an origin.
#[inline(always)]
pub(crate) fn project_all(view: &View, origin: DVec3, positions: &[Vec3], corners: &mut Vec<Corner>) {
    corners.clear();
    corners.reserve(positions.len());
    if view.is_perspective() {
        project_eights::<true>(view, origin, positions, corners);
    } else {
        project_eights::<false>(view, origin, positions, corners);
    }
}

/// `PERSPECTIVE` must say whether the view is one, here and below: each projection is compiled on its own, so that no loop branches on it.
#[inline(always)]
fn project_eights<const PERSPECTIVE: bool>(view: &View, origin: DVec3, positions: &[Vec3], corners: &mut Vec<Corner>) {
    if view.is_perspective() != PERSPECTIVE {
        return;
    }
    for positions in positions.chunks(LANES) {
        let mut eight = [positions[0]; LANES];
        eight[..positions.len()].copy_from_slice(positions);
        let world = Lanes3::of(|i| origin + eight[i].as_dvec3());
        let seen = project(view, &world);
        for i in 0..positions.len() {
            let x = if seen.plain[i] == 0 { UNUSUAL } else { seen.x[i] };
            corners.push(Corner { world: world.at(i), eye: seen.eye.at(i), key: seen.key[i], x, y: seen.y[i] });
        }
    }
}

impl Making<'_> {
    /// [`Making::add`] of each triangle.
    #[inline(always)]
    pub fn add_all(&mut self, triangles: &[Triangle]) {
        let view = self.setup.view;
        let (eights, rest) = if by_eights(&view) { triangles.as_chunks::<LANES>() } else { (&[][..], triangles) };
        if view.is_perspective() {
            self.add_eights::<true>(&view, eights);
        } else {
            self.add_eights::<false>(&view, eights);
        }
        for triangle in rest {
            self.add(triangle);
        }
    }

    /// [`Making::add`] of some triangles of a mesh by their indices, whole eights of them, whose corners are shared.
    #[inline(always)]
    pub fn add_shared(&mut self, mesh: &IndexedMesh<'_>, triangles: Range<usize>, shared: Shared<'_>) {
        let view = self.setup.view;
        if view.is_perspective() {
            self.add_shared_eights::<true>(&view, mesh, triangles, shared);
        } else {
            self.add_shared_eights::<false>(&view, mesh, triangles, shared);
        }
    }

    #[inline(always)]
    fn add_eights<const PERSPECTIVE: bool>(&mut self, view: &View, eights: &[[Triangle; LANES]]) {
        if view.is_perspective() != PERSPECTIVE {
            return;
        }
        for eight in eights {
            let corner = |corner: usize| Lanes3::of(|i| eight[i].corners[corner]);
            let world = [corner(0), corner(1), corner(2)];
            let seen = seen(
                view,
                &world,
                #[inline(always)]
                |corner| project(view, &world[corner]),
            );
            self.add_seen(&seen, |i| eight[i].owner(), |i| eight[i]);
        }
    }

    #[inline(always)]
    fn add_shared_eights<const PERSPECTIVE: bool>(
        &mut self,
        view: &View,
        mesh: &IndexedMesh<'_>,
        triangles: Range<usize>,
        shared: Shared<'_>,
    ) {
        if view.is_perspective() != PERSPECTIVE {
            return;
        }
        let owner = mesh.owner();
        let first = triangles.start;
        for (number, eight) in mesh.indices()[triangles].as_chunks::<LANES>().0.iter().enumerate() {
            let [a, b, c] =
                [shared.eight(|i| eight[i][0]), shared.eight(|i| eight[i][1]), shared.eight(|i| eight[i][2])];
            let world = [Lanes3::of(|i| a[i].world), Lanes3::of(|i| b[i].world), Lanes3::of(|i| c[i].world)];
            let corners = [a, b, c];
            let seen = seen(
                view,
                &world,
                #[inline(always)]
                |corner| Corners::of(&corners[corner]),
            );
            self.add_seen(&seen, |_| owner, |i| mesh.triangle(first + number * LANES + i));
        }
    }

    /// Takes eight more triangles.
    #[inline(always)]
    fn add_seen(&mut self, seen: &Seen, owner: impl Fn(usize) -> Owner, triangle: impl Fn(usize) -> Triangle) {
        let small = self.small(seen);
        for lane in 0..LANES {
            if seen.plain[lane] == 0 {
                self.add(&triangle(lane));
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
                self.add_small(owner(lane), &whole, Patch(small.patch[lane]), small.home[lane]);
            } else {
                self.add_whole(owner(lane), &whole);
            }
        }
    }

    #[inline(always)]
    fn small(&self, seen: &Seen) -> Smalls {
        let mut small = Smalls { holds: [0; LANES], home: [0; LANES], patch: [0; LANES] };
        if matches!(self.setup.reach, Reach::Samples(Sampling::Centre)) {
            let (window, tiles, x, y) = (self.setup.window, self.setup.tiles().x, &seen.x, &seen.y);
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

impl Shared<'_> {
    /// One corner of each of eight triangles, by indices into the mesh's positions.
    #[inline(always)]
    fn eight(&self, index: impl Fn(usize) -> u32) -> [&Corner; LANES] {
        let mut eight = [&self.corners[0]; LANES];
        for i in 0..LANES {
            eight[i] = &self.corners[(index(i) - self.first) as usize];
        }
        eight
    }
}

impl Corners {
    /// Of corners that triangles share.
    #[inline(always)]
    fn of(eight: &[&Corner; LANES]) -> Self {
        let (mut x, mut y, mut plain) = ([0; LANES], [0; LANES], [u64::MAX; LANES]);
        let mut key = [0.0; LANES];
        let eye = Lanes3::of(|i| eight[i].eye);
        for i in 0..LANES {
            (key[i], x[i], y[i]) = (eight[i].key, eight[i].x, eight[i].y);
        }
        narrow(&mut plain, |i| x[i] != UNUSUAL);
        Self { eye, key, x, y, plain }
    }
}

/// What a view makes of a corner of each of eight triangles.
#[inline(always)]
fn project(view: &View, world: &Lanes3) -> Corners {
    let to_eye = view.world_to_eye();
    let limit = if view.is_perspective() { view.near() * NEAR_LIMIT } else { f64::NEG_INFINITY };
    let mut plain = [u64::MAX; LANES];
    narrow(&mut plain, |i| world.x[i].abs() < FARTHEST);
    narrow(&mut plain, |i| world.y[i].abs() < FARTHEST);
    narrow(&mut plain, |i| world.z[i].abs() < FARTHEST);
    let eye = Lanes3::of(|i| to_eye.transform_point3(world.at(i)));
    // Where x or y of the eye are not finite, their texel is not inside.
    narrow(&mut plain, |i| -eye.z[i] >= limit);
    narrow(&mut plain, |i| -eye.z[i] < f64::INFINITY);
    let texels = Lanes3::of(|i| view.eye_to_texel(eye.at(i)).extend(view.key(-eye.z[i])));
    narrow(&mut plain, |i| texels.x[i].abs() <= GUARD_TEXELS);
    narrow(&mut plain, |i| texels.y[i].abs() <= GUARD_TEXELS);
    let (mut x, mut y) = ([0; LANES], [0; LANES]);
    for i in 0..LANES {
        x[i] = rounded(texels.x[i]);
        y[i] = rounded(texels.y[i]);
    }
    Corners { eye, key: texels.z, x, y, plain }
}

/// What a view makes of eight triangles, by their corners in world space; `corners` are what it makes of each of the three.
#[inline(always)]
fn seen(view: &View, world: &[Lanes3; 3], corners: impl Fn(usize) -> Corners) -> Seen {
    let (to_eye, near) = (view.world_to_eye(), view.near());
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
        let seen = corners(corner);
        for i in 0..LANES {
            plain[i] &= seen.plain[i];
        }
        widen(&mut before_near, |i| -seen.eye.z[i] < near);
        (x[corner], y[corner]) = (seen.x, seen.y);
        for i in 0..LANES {
            let key = seen.key[i];
            least[i] = if key < least[i] { key } else { least[i] };
            greatest[i] = if key > greatest[i] { key } else { greatest[i] };
        }
        through = if corner == 0 { seen.eye } else { Lanes3::of(|i| nearer(through.at(i), seen.eye.at(i))) };
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
