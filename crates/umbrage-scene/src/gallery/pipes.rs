use super::SLAB_THICKNESS;
use super::views::{camera, lamp};
use crate::{Material, Mesh, Object, Scene};
use glam::{DVec3, IVec3, UVec2, Vec3};
use std::f32::consts::FRAC_PI_2;
use umbrage_plane::mix32;

/// Places of the lattice that pipes run through, along x, y and z.
const PLACES: IVec3 = IVec3::new(12, 8, 5);
/// From one place to the next, world units.
const STEP: f32 = 8.5;
/// Radius of a pipe, of its bends and of its collars, world units.
const PIPE: f32 = 1.9;
/// Radius of a bend's middle line, world units.
const BEND: f32 = 3.4;
/// Radius of the collars, world units.
const COLLAR: f32 = 2.5;
/// Triangles around a pipe, by two.
const AROUND: u32 = 14;

/// A thicket of shiny pipes before a wall, after Wang & Molnar 1994, Figure 13: dense, curved and closed.
///
/// Objects: the floor (0), whose top is y = 0, the wall (1), then a pipe each, with its collars; [`pipe_segments`]
/// says of how many straight pieces they are. Pipes walk a lattice by a fixed rule, never two through one place;
/// collars surround and caps close them. Light 0 is at upper left before them, with a map of 512 × 512; the picture is
/// 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn pipes() -> Scene {
    const PAINTS: [Vec3; 7] = [
        Vec3::new(0.62, 0.10, 0.07),
        Vec3::new(0.72, 0.48, 0.10),
        Vec3::new(0.12, 0.42, 0.18),
        Vec3::new(0.10, 0.24, 0.58),
        Vec3::new(0.62, 0.34, 0.16),
        Vec3::new(0.55, 0.57, 0.60),
        Vec3::new(0.14, 0.46, 0.50),
    ];
    let back = 0.5 * STEP * PLACES.z as f32 + 4.0;
    let floor = Mesh::cuboid(Vec3::new(-66.0, -SLAB_THICKNESS, -back - 2.0), Vec3::new(66.0, 0.0, back + 14.0));
    let wall = Mesh::cuboid(Vec3::new(-65.0, -2.0, -back - SLAB_THICKNESS), Vec3::new(65.0, 84.0, -back));
    let mut objects = vec![
        Object::solid("floor", floor, Material::matt(Vec3::new(0.42, 0.42, 0.44))),
        Object::solid("wall", wall, Material::matt(Vec3::new(0.52, 0.50, 0.46))),
    ];
    for (number, corners) in runs().iter().enumerate() {
        let diffuse = PAINTS[number % PAINTS.len()];
        let gloss = Material { diffuse, specular: Vec3::splat(0.5), shininess: 70.0 };
        objects.push(Object::solid(&format!("pipe {number}"), pipe(corners), gloss));
    }
    Scene {
        name: "pipes".into(),
        origin: DVec3::ZERO,
        objects,
        lights: vec![lamp(DVec3::new(-70.0, 125.0, 130.0), DVec3::new(0.0, 32.0, 0.0), 44.0, [70.0, 320.0], 512)],
        ambient: Vec3::splat(0.12),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera: camera([24.0, 52.0, 150.0], [0.0, 35.0, 0.0], 43.0, [20.0, 400.0], UVec2::splat(1024)),
    }
}

/// How many straight pieces of pipe [`pipes`] has; at every joint of two is a bend.
pub fn pipe_segments() -> usize {
    runs().iter().map(|corners| corners.len() - 1).sum()
}

/// One pipe through its corners: straight pieces, quarter circles at bends, a collar round the middle of each long
/// piece and at both ends.
fn pipe(corners: &[IVec3]) -> Mesh {
    let at = |place: IVec3| (place.as_vec3() - 0.5 * (PLACES.as_vec3() - 1.0)).with_y(place.y as f32 + 0.6) * STEP;
    let unit = |from: IVec3, to: IVec3| (to - from).signum().as_vec3();
    let mut path = vec![at(corners[0])];
    for bend in corners.windows(3) {
        let (arrives, leaves) = (unit(bend[0], bend[1]), unit(bend[1], bend[2]));
        let middle = at(bend[1]) + (leaves - arrives) * BEND;
        path.extend((0..=4u8).map(|part| {
            let (sin, cos) = (FRAC_PI_2 * f32::from(part) / 4.0).sin_cos();
            middle + (arrives * sin - leaves * cos) * BEND
        }));
    }
    path.push(at(corners[corners.len() - 1]));
    let mut mesh = Mesh::tube(&path, PIPE, AROUND);
    let mut collar = |middle: Vec3, along: Vec3| {
        mesh.append(&Mesh::cylinder(middle - along * 0.9, middle + along * 0.9, COLLAR, AROUND));
    };
    for piece in corners.windows(2) {
        let (from, to) = (at(piece[0]), at(piece[1]));
        if from.distance(to) > 1.5 * STEP {
            collar((from + to) * 0.5, unit(piece[0], piece[1]));
        }
    }
    for [end, next] in [[corners[0], corners[1]], [corners[corners.len() - 1], corners[corners.len() - 2]]] {
        collar(at(end), unit(end, next));
    }
    mesh
}

/// The corners of every pipe, ends included: walks that keep off one another's places.
fn runs() -> Vec<Vec<IVec3>> {
    const SIDES: [IVec3; 6] = [IVec3::X, IVec3::NEG_X, IVec3::Y, IVec3::NEG_Y, IVec3::Z, IVec3::NEG_Z];
    let mut drawn = 0u32;
    let mut pick = |below: usize| {
        drawn += 1;
        mix32(drawn) as usize % below
    };
    let index = |place: IVec3| (place.x + PLACES.x * (place.y + PLACES.y * place.z)) as usize;
    let inside = |place: IVec3| place.cmpge(IVec3::ZERO).all() && place.cmplt(PLACES).all();
    let mut taken = vec![false; PLACES.element_product() as usize];
    let mut runs = Vec::new();
    for _ in 0..160 {
        let mut at = IVec3::new(pick(12) as i32, pick(8) as i32, pick(5) as i32);
        let mut ahead = SIDES[pick(6)];
        if taken[index(at)] {
            continue;
        }
        let mut walk = vec![at];
        while walk.len() < 26 {
            let free = |side: IVec3| inside(at + side) && !taken[index(at + side)] && !walk.contains(&(at + side));
            let turns: Vec<IVec3> = SIDES.into_iter().filter(|side| free(*side)).collect();
            if turns.is_empty() {
                break;
            }
            if pick(5) < 2 || !free(ahead) {
                ahead = turns[pick(turns.len())];
            }
            at += ahead;
            walk.push(at);
        }
        if walk.len() >= 4 {
            for place in &walk {
                taken[index(*place)] = true;
            }
            let turns = walk.windows(3).filter(|step| step[1] - step[0] != step[2] - step[1]).map(|step| step[1]);
            runs.push([walk[0]].into_iter().chain(turns).chain(walk.last().copied()).collect());
        }
    }
    runs
}
