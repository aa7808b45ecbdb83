//! Scenes that are slices: solids pulled straight along z, with light and camera in the plane z = 0.

use super::masks::points_of;
use crate::figure::Context;
use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use std::sync::Arc;
use umbrage_bake::bake;
use umbrage_depth::{DepthMap, DepthRule, Tiled};
use umbrage_plane::{View, ViewError};
use umbrage_raster::Cull;
use umbrage_render::{Frame, Picture, Soup, picture};
use umbrage_report::diagram::{Diagram, Ink, Mark};
use umbrage_sample::Key;
use umbrage_scene::{Light, Material, Mesh, Object, Scene};
use umbrage_shadow::{Shadow, Unshadowed};

/// How far the solids reach to either side of the slice.
const REACH: f32 = 500.0;

/// Convex solids by their outlines, counter-clockwise, a light (0) and a camera.
pub struct Slice {
    pub scene: Scene,
    pub outlines: Vec<Vec<DVec2>>,
}

/// Corners of an axis-parallel rectangle.
pub fn rectangle(low: [f64; 2], high: [f64; 2]) -> Vec<DVec2> {
    [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]].map(DVec2::from).to_vec()
}

/// The same turned about its middle, degrees counter-clockwise.
pub fn turned(outline: &[DVec2], degrees: f64) -> Vec<DVec2> {
    let middle = outline.iter().sum::<DVec2>() / outline.len() as f64;
    let turn = DVec2::from_angle(degrees.to_radians());
    outline.iter().map(|corner| middle + turn.rotate(corner - middle)).collect()
}

/// A disc as a polygon.
pub fn disc(centre: [f64; 2], radius: f64) -> Vec<DVec2> {
    const CORNERS: u32 = 96;
    let corner = |i| DVec2::from_angle(f64::from(i) * std::f64::consts::TAU / f64::from(CORNERS)) * radius;
    (0..CORNERS).map(|i| DVec2::from(centre) + corner(i)).collect()
}

/// A point of the slice in the world.
pub fn world(at: DVec2) -> DVec3 {
    at.extend(0.0)
}

/// Parallel light from a direction in the slice, `half` world units to either side of a target. Maps are square and of an odd number of
/// rows, so that the middle one lies in the slice.
pub fn sun(to_light: DVec2, target: DVec2, half: f64, columns: u32) -> Result<View, ViewError> {
    let eye = world(target + to_light.normalize() * 300.0);
    View::orthographic(eye, world(target), DVec3::Z, half, 1.0, 600.0, UVec2::splat(columns | 1))
}

/// A lamp in the slice, as above.
pub fn lamp(eye: [f64; 2], target: [f64; 2], degrees: f64, columns: u32) -> Result<View, ViewError> {
    let size = UVec2::splat(columns | 1);
    View::perspective(world(eye.into()), world(target.into()), DVec3::Z, degrees.to_radians(), 1.0, 600.0, size)
}

/// A camera of one row in the slice, its pixels square.
pub fn eye(at: [f64; 2], target: [f64; 2], degrees: f64, columns: u32) -> Result<View, ViewError> {
    let row = 2.0 * ((0.5 * degrees.to_radians()).tan() / f64::from(columns)).atan();
    View::perspective(world(at.into()), world(target.into()), DVec3::Z, row, 1.0, 600.0, UVec2::new(columns, 1))
}

/// A solid of an outline.
fn pulled(outline: &[DVec2]) -> Mesh {
    let mut mesh = Mesh::default();
    let mut face = |corners: Vec<Vec3>| {
        let first = mesh.positions.len() as u32;
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
        let surface = mesh.surfaces.last().map_or(0, |last| last + 1);
        for second in 1..corners.len() as u32 - 1 {
            mesh.triangles.push([first, first + second, first + second + 1]);
            mesh.surfaces.push(surface);
        }
        mesh.normals.extend(vec![normal; corners.len()]);
        mesh.positions.extend(corners);
    };
    let at = |corner: &DVec2, z: f32| corner.as_vec2().extend(z);
    for (index, from) in outline.iter().enumerate() {
        let to = &outline[(index + 1) % outline.len()];
        face(vec![at(from, -REACH), at(to, -REACH), at(to, REACH), at(from, REACH)]);
    }
    face(outline.iter().map(|corner| at(corner, REACH)).collect());
    face(outline.iter().rev().map(|corner| at(corner, -REACH)).collect());
    mesh
}

impl Slice {
    /// Object ids are the outlines' places.
    pub fn new(name: &str, outlines: Vec<Vec<DVec2>>, light: &View, camera: &View) -> anyhow::Result<Self> {
        let material = Material::matt(Vec3::splat(0.6));
        let objects = outlines.iter().map(|outline| Object::solid("solid", pulled(outline), material)).collect();
        let mut lamp = Light::point("light", DVec3::Y, DVec3::ZERO, 60.0, 1.0, 2.0, UVec2::ONE)?;
        lamp.view = *light;
        let (ambient, background) = (Vec3::splat(0.2), Vec3::ZERO);
        let scene = Scene {
            name: name.into(),
            origin: DVec3::ZERO,
            objects,
            lights: vec![lamp],
            ambient,
            background,
            camera: *camera,
        };
        Ok(Self { scene, outlines })
    }

    /// The light.
    pub fn light(&self) -> &View {
        &self.scene.lights[0].view
    }

    /// Its map by a rule.
    pub fn bake(&self, rule: &impl DepthRule) -> Arc<Tiled> {
        bake(self.light(), Soup::casters(&self.scene, self.light()).triangles(), rule, Cull::None).map
    }

    /// The camera's samples with their shadows, each looked up as a point without extent.
    pub fn seen(&self, cx: &Context, shadow: &dyn Shadow) -> Picture {
        let mut seen = picture(&self.scene, &[&Unshadowed], &Frame { seed: cx.seed, ..Frame::CENTRES });
        let points = points_of(&seen);
        let mut answers = vec![0.0; points.len()];
        shadow.fractions(&points, Key::new(cx.seed, 0, 0), &mut answers);
        for (point, answer) in points.iter().zip(answers) {
            seen.shadow[0][point.region as usize] = answer;
        }
        seen
    }

    /// The outlines as areas.
    pub fn outlined(&self, mut diagram: Diagram) -> Diagram {
        for outline in &self.outlines {
            diagram = diagram.draw(Mark::Area, Ink::Faint, outline);
        }
        diagram
    }
}

/// The stored points of a map's row in the slice, from the left; NaN where nothing is stored.
pub fn stored(map: &Arc<Tiled>) -> Vec<DVec2> {
    let view = map.view();
    let row = view.size().y as i32 / 2;
    let at = |x: i32| {
        let texel = IVec2::new(x, row);
        let depth = f64::from(map.depth(texel));
        if depth.is_finite() { view.world_at(texel.as_dvec2() + 0.5, view.key(depth)).truncate() } else { DVec2::NAN }
    };
    (0..view.size().x as i32).map(at).collect()
}

/// A line through points in their order, cut where two lie farther apart than `reach` world units.
pub fn cut(points: &[DVec2], reach: f64) -> Vec<DVec2> {
    let mut line = Vec::with_capacity(points.len());
    for (index, point) in points.iter().enumerate() {
        if index > 0 && point.distance(points[index - 1]) > reach {
            line.push(DVec2::NAN);
        }
        line.push(*point);
    }
    line
}
