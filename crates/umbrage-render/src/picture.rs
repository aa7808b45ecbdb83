use crate::Soup;
use crate::camera::{Gather, Gathered, Region};
use crate::shade::shade;
use glam::{DVec3, UVec2, Vec3};
use rayon::prelude::*;
use umbrage_bake::Masks;
use umbrage_plane::{Kind, Sampling, SurfacePoint, TexelRect, View};
use umbrage_raster::{BIN, Bins, Cull};
use umbrage_sample::Key;
use umbrage_scene::Scene;
use umbrage_shadow::Shadow;

/// How the camera's picture is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Visibility samples per pixel along each axis: 1, 2, 4 or 8 (other values count as the next lower of these). All samples of a
    /// picture are one grid of at most 32,768 per side: pictures too large for that are drawn with as many as fit.
    pub axis: u32,
    /// Samples jittered within their cells instead of at cell centres.
    pub stochastic: bool,
    /// Shades every sample by itself instead of once per surface and pixel: slow, and what truth is made with.
    pub every_sample: bool,
    /// Gives shadows the interpolated normal instead of the geometric one: the plane that Wang & Molnar fit where surfaces are shaded
    /// smoothly.
    pub smooth: bool,
    /// Seed of the camera's jitter and of the shadows' keys.
    pub seed: u32,
    /// Number of the frame (Reeves 1987): another frame, other random numbers. Keep it constant for static noise.
    pub number: u32,
}

impl Default for Frame {
    /// 16 stochastic samples per pixel, shaded once per surface.
    fn default() -> Self {
        Self { axis: 4, stochastic: true, every_sample: false, smooth: false, seed: 0, number: 0 }
    }
}

impl Frame {
    /// One sample at each pixel's centre.
    pub const CENTRES: Self =
        Self { axis: 1, stochastic: false, every_sample: false, smooth: false, seed: 0, number: 0 };

    /// The camera with this frame's samples as its texels.
    pub fn sample_view(&self, camera: &View) -> View {
        let axis = self.axis_for(camera);
        let sampling = if self.stochastic {
            Sampling::Jittered { seed: self.seed ^ self.number.rotate_left(16) }
        } else {
            Sampling::Centre
        };
        let view = camera.with_size(camera.size() * axis).unwrap_or(*camera);
        view.with_kind(Kind::Axial).with_sampling(sampling)
    }

    fn axis_for(&self, camera: &View) -> u32 {
        let fitting = (32_768 / camera.size().max_element()).min(8);
        1 << self.axis.clamp(1, fitting).ilog2()
    }
}

/// Tiles that are drawn before their pixels go into the picture, at least.
const TOGETHER: u32 = 256;

/// No object: the background.
pub const NOTHING: u32 = u32::MAX;

/// A finished picture and what is known about each pixel; all rows from the top, linear light.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels across and down.
    pub size: UVec2,
    /// Linear RGB.
    pub colour: Vec<Vec3>,
    /// Per light: the fraction in shadow, 0 where nothing is seen (the shadow component alone).
    pub shadow: Vec<Vec<f32>>,
    /// Per light: cosine between geometric normal and light, averaged over the pixel; 0 where nothing is seen.
    pub facing: Vec<Vec<f32>>,
    /// The object of the pixel's largest region, or [`NOTHING`].
    pub object: Vec<u32>,
    /// Fraction of the pixel's samples that meet that object.
    pub share: Vec<f32>,
    /// Position of that region, world space; NaN where nothing is seen.
    pub position: Vec<DVec3>,
    /// Geometric normal of that region; zero where nothing is seen.
    pub normal: Vec<Vec3>,
    /// Distance along the camera's axis of that region; +∞ where nothing is seen.
    pub depth: Vec<f32>,
    /// Samples generated, hidden ones included: the points that Williams' point-by-point mode transforms when it tests
    /// every one before it is shaded.
    pub fragments: u64,
    /// Those of them that were nearer than all before, in the scene's order: what that mode transforms when only points
    /// that pass the depth test are looked up. The picture is the same.
    pub passing: u64,
    /// Regions shaded: points transformed to each light.
    pub regions: u64,
}

/// Pass 2: the camera's picture of a scene, with `shadows[i]` deciding what of light i arrives (Reeves 1987).
///
/// Lights beyond the end of `shadows`, and those that do not cast ([`umbrage_scene::Light::casts`]), have no shadow.
pub fn picture(scene: &Scene, shadows: &[&dyn Shadow], frame: &Frame) -> Picture {
    picture_where(scene, shadows, frame, |_| true)
}

/// [`picture`], of which only some pixels are drawn: those whose index, row · width + column, `wanted` accepts. The others are left as background that nobody looked
/// at. Pixels that are drawn are the same in both; samples are counted only in tiles that hold such pixels.
pub fn picture_where(
    scene: &Scene,
    shadows: &[&dyn Shadow],
    frame: &Frame,
    wanted: impl Fn(u32) -> bool + Sync,
) -> Picture {
    drawn(scene, shadows, frame, wanted, true)
}

/// [`picture_where`] for rays alone, in less time: shadows are given points without extent, which have geometric normals, and nothing is shaded. The
/// colour is the background's all over; all else is the same as there, by shadows that look at no extent.
pub fn rays_where(
    scene: &Scene,
    shadows: &[&dyn Shadow],
    frame: &Frame,
    wanted: impl Fn(u32) -> bool + Sync,
) -> Picture {
    drawn(scene, shadows, frame, wanted, false)
}

/// [`picture_where`] where it is `shaded`, and otherwise [`rays_where`].
fn drawn(
    scene: &Scene,
    shadows: &[&dyn Shadow],
    frame: &Frame,
    wanted: impl Fn(u32) -> bool + Sync,
    shaded: bool,
) -> Picture {
    let mut picture = Picture::empty(scene, scene.camera.size());
    let across = BIN / frame.axis_for(&scene.camera);
    let finish = |origin, gathered| {
        let tile = Place { origin, across };
        (tile, SeenTile::of(scene, &gathered), LitTile::of(scene, shadows, frame, &gathered, shaded))
    };
    each_tile(scene, frame, !shaded, wanted, finish, |(tile, seen, lit)| {
        picture.see(&tile, &seen);
        picture.light(&tile, &lit);
    });
    picture
}

/// What the camera sees of a scene, for several [pictures](picture) of it that differ in their shadows alone: its samples are taken once.
///
/// Some 150 bytes are kept for each region, and 70 for each pixel.
pub struct Sight {
    frame: Frame,
    /// What is seen in each tile.
    tiles: Vec<(Place, Gathered)>,
    /// All of a picture but shadows and shading.
    seen: Picture,
}

impl Sight {
    /// What [`picture`] would shade.
    pub fn new(scene: &Scene, frame: &Frame) -> Self {
        let mut seen = Picture::empty(scene, scene.camera.size());
        let mut tiles = Vec::new();
        let across = BIN / frame.axis_for(&scene.camera);
        let finish = |origin, gathered| (Place { origin, across }, SeenTile::of(scene, &gathered), gathered);
        each_tile(
            scene,
            frame,
            false,
            |_| true,
            finish,
            |(tile, pixels, gathered)| {
                seen.see(&tile, &pixels);
                tiles.push((tile, gathered));
            },
        );
        Self { frame: *frame, tiles, seen }
    }

    /// The same as [`picture`] of the scene and the frame that it was made with.
    pub fn picture(&self, scene: &Scene, shadows: &[&dyn Shadow]) -> Picture {
        self.drawn(scene, shadows, true)
    }

    /// The same without shading, in less time: the colour is the background's all over.
    pub fn shadows(&self, scene: &Scene, shadows: &[&dyn Shadow]) -> Picture {
        self.drawn(scene, shadows, false)
    }

    fn drawn(&self, scene: &Scene, shadows: &[&dyn Shadow], shaded: bool) -> Picture {
        let light = |(_, gathered): &(Place, Gathered)| LitTile::of(scene, shadows, &self.frame, gathered, shaded);
        let mut picture = self.seen.clone();
        let done: Vec<LitTile> = self.tiles.par_iter().map(light).collect();
        for ((tile, _), lit) in self.tiles.iter().zip(&done) {
            picture.light(tile, lit);
        }
        picture
    }
}

/// Gathers what the camera sees of each tile, `finish`es many tiles at once, given the pixel at a tile's upper left and what is seen, and lets `take` have what
/// came of them, in their order. What is gathered are `points` or regions.
fn each_tile<T: Send>(
    scene: &Scene,
    frame: &Frame,
    points: bool,
    wanted: impl Fn(u32) -> bool + Sync,
    finish: impl Fn(UVec2, Gathered) -> T + Sync,
    mut take: impl FnMut(T),
) {
    let axis = frame.axis_for(&scene.camera);
    let view = frame.sample_view(&scene.camera);
    let soup = Soup::all(scene, &scene.camera);
    let mut masks = Masks::new(&view);
    let triangles = soup.casting().map(|caster| masks.note(caster));
    let bins = Bins::new(&view, TexelRect::of_size(view.size()), Cull::None, triangles);
    let (every_sample, width) = (frame.every_sample, scene.camera.size().x);
    let gather = Gather { soup: &soup, bins: &bins, masks: &masks, view: &view, axis, every_sample, points, width };
    let tiles = bins.tiles();
    // A pixel that is finished takes several times as much as what the picture keeps of it.
    let (count, together) = (tiles.x * tiles.y, TOGETHER.max(16 * rayon::current_num_threads() as u32));
    for first in (0..count).step_by(together as usize) {
        let done: Vec<T> = (first..count.min(first + together))
            .into_par_iter()
            .map(|index| {
                let tile = UVec2::new(index % tiles.x, index / tiles.x);
                finish(tile * (BIN / axis), gather.tile(tile, &wanted))
            })
            .collect();
        done.into_iter().for_each(&mut take);
    }
}

/// Where a tile's pixels are.
struct Place {
    /// The pixel at the upper left.
    origin: UVec2,
    /// Pixels across it.
    across: u32,
}

impl Place {
    /// The index in the picture of a tile's pixel.
    fn index(&self, pixel: u32, width: u32) -> usize {
        let at = self.origin + UVec2::new(pixel % self.across, pixel / self.across);
        (at.y * width + at.x) as usize
    }
}

/// What is seen in a pixel of a tile, whatever its shadows.
struct SeenPixel {
    index: u32,
    /// The fraction of the samples that meet the object of the largest region.
    share: f32,
    best: f32,
    point: SurfacePoint,
    zeta: f32,
}

/// What is seen in a tile, whatever its shadows.
struct SeenTile {
    pixels: Vec<SeenPixel>,
    /// Of each pixel, for each light: the cosine to the light.
    facing: Vec<f32>,
    fragments: u64,
    passing: u64,
    regions: u64,
}

impl SeenTile {
    fn of(scene: &Scene, gathered: &Gathered) -> Self {
        let Gathered { regions, points, fragments, passing } = gathered;
        let (fragments, passing) = (*fragments, *passing);
        let (pixels, facing) = (Vec::new(), Vec::new());
        let mut tile = Self { pixels, facing, fragments, passing, regions: regions.len() as u64 };
        let mut objects = Vec::new();
        let mut first = 0;
        for regions in regions.chunk_by(|a, b| a.pixel == b.pixel) {
            tile.add(scene, regions, &points[first..first + regions.len()], &mut objects);
            first += regions.len();
        }
        tile
    }

    /// The pixel of some regions, at least one. `objects` is room for the objects that it meets, each with its fraction of the samples.
    fn add(&mut self, scene: &Scene, regions: &[Region], points: &[SurfacePoint], objects: &mut Vec<(u32, f32)>) {
        let Region { pixel: index, zeta, .. } = regions[0];
        let mut pixel = SeenPixel { index, share: 0.0, best: 0.0, point: points[0], zeta };
        objects.clear();
        let start = self.facing.len();
        self.facing.resize(start + scene.lights.len(), 0.0);
        for (region, point) in regions.iter().zip(points) {
            for (light, facing) in scene.lights.iter().zip(&mut self.facing[start..]) {
                let toward = light.view.toward_eye(point.position);
                *facing += point.normal.dot(toward.as_vec3()) * region.share;
            }
            match objects.iter_mut().find(|(known, _)| *known == point.object) {
                Some((_, share)) => *share += region.share,
                None => objects.push((point.object, region.share)),
            }
            if region.share > pixel.best {
                (pixel.best, pixel.point, pixel.zeta) = (region.share, *point, region.zeta);
            }
        }
        pixel.share = objects.iter().find(|(object, _)| *object == pixel.point.object).map_or(0.0, |(_, share)| *share);
        self.pixels.push(pixel);
    }
}

/// What one light's shadow says of a tile's regions.
struct Answer {
    fractions: Vec<f32>,
    /// None where nothing is shaded.
    passes: Vec<Vec3>,
}

/// A tile's pixels as its lights make them.
struct LitTile {
    /// The index of each within the tile.
    pixels: Vec<u32>,
    /// Of each pixel, for each light: the fraction in shadow.
    shadow: Vec<f32>,
    /// Of each pixel its light, and how much of it the surfaces cover that send it. None where nothing is shaded.
    colour: Vec<(Vec3, f32)>,
}

impl LitTile {
    fn of(scene: &Scene, shadows: &[&dyn Shadow], frame: &Frame, gathered: &Gathered, shaded: bool) -> Self {
        let Gathered { regions, points, .. } = gathered;
        let answers = answers(scene, shadows, frame, gathered, shaded);
        let mut tile = Self { pixels: Vec::new(), shadow: Vec::new(), colour: Vec::new() };
        let mut arrives = vec![Vec3::ONE; answers.len()];
        let mut first = 0;
        for regions in regions.chunk_by(|a, b| a.pixel == b.pixel) {
            let start = tile.shadow.len();
            tile.shadow.resize(start + answers.len(), 0.0);
            let mut colour = (Vec3::ZERO, 0.0);
            for (region, index) in regions.iter().zip(first..) {
                let point = &points[index];
                let receives = scene.objects[point.object as usize].receives;
                arrives.fill(Vec3::ONE);
                for (light, answer) in answers.iter().enumerate().filter(|_| receives) {
                    if let Some(passes) = answer.passes.get(index) {
                        arrives[light] = *passes;
                    }
                    tile.shadow[start + light] += answer.fractions[index] * region.share;
                }
                if shaded {
                    let toward_eye = scene.camera.toward_eye(point.position).as_vec3();
                    colour.0 += shade(scene, (region, point), toward_eye, &arrives) * region.share;
                    colour.1 += region.share;
                }
            }
            tile.pixels.push(regions[0].pixel);
            if shaded {
                tile.colour.push(colour);
            }
            first += regions.len();
        }
        tile
    }
}

/// What each light's shadow says of a tile's regions.
fn answers(
    scene: &Scene,
    shadows: &[&dyn Shadow],
    frame: &Frame,
    Gathered { regions, points, .. }: &Gathered,
    shaded: bool,
) -> Vec<Answer> {
    let smooth: Vec<SurfacePoint>;
    let points = if frame.smooth {
        let smoothed =
            |(region, point): (&Region, &SurfacePoint)| SurfacePoint { normal: region.shading_normal, ..*point };
        smooth = regions.iter().zip(points).map(smoothed).collect();
        &smooth
    } else {
        points
    };
    let passes = if shaded { vec![Vec3::ONE; points.len()] } else { Vec::new() };
    let lit = |_| Answer { fractions: vec![0.0; points.len()], passes: passes.clone() };
    let mut answers: Vec<Answer> = scene.lights.iter().map(lit).collect();
    for (light, (shadow, answer)) in shadows.iter().zip(&mut answers).enumerate() {
        if scene.lights[light].casts {
            let key = Key::new(frame.seed, frame.number, light as u32);
            shadow.fractions(points, key, &mut answer.fractions);
            if shaded {
                shadow.transmittances(points, key, &answer.fractions, &mut answer.passes);
            }
        }
    }
    answers
}

impl Picture {
    fn empty(scene: &Scene, size: UVec2) -> Self {
        let pixels = size.x as usize * size.y as usize;
        let lights = scene.lights.len();
        Self {
            size,
            colour: vec![scene.background; pixels],
            shadow: vec![vec![0.0; pixels]; lights],
            facing: vec![vec![0.0; pixels]; lights],
            object: vec![NOTHING; pixels],
            share: vec![0.0; pixels],
            position: vec![DVec3::NAN; pixels],
            normal: vec![Vec3::ZERO; pixels],
            depth: vec![f32::INFINITY; pixels],
            fragments: 0,
            passing: 0,
            regions: 0,
        }
    }

    /// Takes what is seen in a tile.
    fn see(&mut self, tile: &Place, seen: &SeenTile) {
        self.fragments += seen.fragments;
        self.passing += seen.passing;
        self.regions += seen.regions;
        let count = self.facing.len();
        for (nth, pixel) in seen.pixels.iter().enumerate() {
            let index = tile.index(pixel.index, self.size.x);
            for (facing, cosine) in self.facing.iter_mut().zip(&seen.facing[nth * count..]) {
                facing[index] = *cosine;
            }
            self.object[index] = pixel.point.object;
            self.share[index] = pixel.share;
            self.position[index] = pixel.point.position;
            self.normal[index] = pixel.point.normal;
            self.depth[index] = pixel.zeta;
        }
    }

    /// Takes what the lights make of a tile.
    fn light(&mut self, tile: &Place, lit: &LitTile) {
        let count = self.shadow.len();
        for (nth, pixel) in lit.pixels.iter().enumerate() {
            let index = tile.index(*pixel, self.size.x);
            for (shadow, fraction) in self.shadow.iter_mut().zip(&lit.shadow[nth * count..]) {
                shadow[index] = *fraction;
            }
            if let Some((colour, covered)) = lit.colour.get(nth) {
                self.colour[index] = self.colour[index] * (1.0 - covered) + *colour;
            }
        }
    }
}
