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
/// at. Pixels that are drawn are the same in both.
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
    let finish = |origin, gathered| (origin, finish_tile(scene, shadows, frame, &gathered, shaded));
    each_tile(scene, frame, !shaded, wanted, finish, |(origin, tile)| picture.place(origin, &tile));
    picture
}

/// What the camera sees of a scene, for several [pictures](picture) of it that differ in their shadows alone: its samples are taken once.
///
/// Some 150 bytes are kept for each region.
pub struct Sight {
    frame: Frame,
    /// The pixel at the upper left of each tile, and what is seen there.
    tiles: Vec<(UVec2, Gathered)>,
}

impl Sight {
    /// What [`picture`] would shade.
    pub fn new(scene: &Scene, frame: &Frame) -> Self {
        let mut tiles = Vec::new();
        each_tile(scene, frame, false, |_| true, |origin, gathered| (origin, gathered), |tile| tiles.push(tile));
        Self { frame: *frame, tiles }
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
        let finish = |gathered: &Gathered| finish_tile(scene, shadows, &self.frame, gathered, shaded);
        let mut picture = Picture::empty(scene, scene.camera.size());
        let done: Vec<TileOut> = self.tiles.par_iter().map(|(_, gathered)| finish(gathered)).collect();
        for ((origin, _), tile) in self.tiles.iter().zip(&done) {
            picture.place(*origin, tile);
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

/// A finished pixel of a tile.
struct Pixel {
    index: u32,
    colour: Vec3,
    covered: f32,
    /// The fraction of the samples that meet the object of the largest region.
    share: f32,
    best: f32,
    point: SurfacePoint,
    zeta: f32,
}

/// What one light's shadow says of a tile's regions.
struct Answer {
    fractions: Vec<f32>,
    /// None where nothing is shaded.
    passes: Vec<Vec3>,
}

/// A finished tile.
struct TileOut {
    /// Pixels across it.
    across: u32,
    pixels: Vec<Pixel>,
    /// Of each pixel, for each light: the fraction in shadow and the cosine to the light.
    lights: Vec<[f32; 2]>,
    fragments: u64,
    passing: u64,
    regions: u64,
}

fn finish_tile(scene: &Scene, shadows: &[&dyn Shadow], frame: &Frame, gathered: &Gathered, shaded: bool) -> TileOut {
    let Gathered { regions, fragments, passing } = gathered;
    let point = |region: &Region| {
        let normal = if frame.smooth { region.shading_normal } else { region.point.normal };
        SurfacePoint { normal, ..region.point }
    };
    let points: Vec<SurfacePoint> = regions.iter().map(point).collect();
    let passes = if shaded { vec![Vec3::ONE; points.len()] } else { Vec::new() };
    let lit = |_| Answer { fractions: vec![0.0; points.len()], passes: passes.clone() };
    let mut answers: Vec<Answer> = scene.lights.iter().map(lit).collect();
    for (light, (shadow, answer)) in shadows.iter().zip(&mut answers).enumerate() {
        if scene.lights[light].casts {
            let key = Key::new(frame.seed, frame.number, light as u32);
            shadow.fractions(&points, key, &mut answer.fractions);
            if shaded {
                shadow.transmittances(&points, key, &answer.fractions, &mut answer.passes);
            }
        }
    }
    let mut tile = TileOut {
        across: BIN / frame.axis_for(&scene.camera),
        pixels: Vec::new(),
        lights: Vec::new(),
        fragments: *fragments,
        passing: *passing,
        regions: regions.len() as u64,
    };
    let mut shading =
        Shading { scene, shaded, answers: &answers, arrives: vec![Vec3::ONE; answers.len()], objects: Vec::new() };
    let mut first = 0;
    for regions in regions.chunk_by(|a, b| a.pixel == b.pixel) {
        tile.pixels.push(shading.pixel(regions, first, &mut tile.lights));
        first += regions.len();
    }
    tile
}

/// Shades the pixels of a tile.
struct Shading<'a> {
    scene: &'a Scene,
    /// Whether anybody looks at its colour.
    shaded: bool,
    answers: &'a [Answer],
    /// Room for what of each light arrives at a region.
    arrives: Vec<Vec3>,
    /// Room for the objects that a pixel meets, each with its fraction of the samples.
    objects: Vec<(u32, f32)>,
}

impl Shading<'_> {
    /// The pixel of some regions, at least one, the first of which has the index `first` in the tile; adds what `lights` are to hold of it.
    fn pixel(&mut self, regions: &[Region], first: usize, lights: &mut Vec<[f32; 2]>) -> Pixel {
        let Self { scene, shaded, answers, arrives, objects } = self;
        let Region { pixel: index, point, zeta, .. } = regions[0];
        let mut pixel = Pixel { index, colour: Vec3::ZERO, covered: 0.0, share: 0.0, best: 0.0, point, zeta };
        objects.clear();
        let start = lights.len();
        lights.resize(start + answers.len(), [0.0; 2]);
        for (region, index) in regions.iter().zip(first..) {
            let receives = scene.objects[region.point.object as usize].receives;
            arrives.fill(Vec3::ONE);
            for (light, answer) in answers.iter().enumerate() {
                let [shadow, facing] = &mut lights[start + light];
                if receives {
                    if let Some(passes) = answer.passes.get(index) {
                        arrives[light] = *passes;
                    }
                    *shadow += answer.fractions[index] * region.share;
                }
                let toward = scene.lights[light].view.toward_eye(region.point.position);
                *facing += region.point.normal.dot(toward.as_vec3()) * region.share;
            }
            if *shaded {
                let toward_eye = scene.camera.toward_eye(region.point.position).as_vec3();
                pixel.colour += shade(scene, region, toward_eye, arrives) * region.share;
                pixel.covered += region.share;
            }
            let object = region.point.object;
            match objects.iter_mut().find(|(known, _)| *known == object) {
                Some((_, share)) => *share += region.share,
                None => objects.push((object, region.share)),
            }
            if region.share > pixel.best {
                pixel.best = region.share;
                pixel.point = region.point;
                pixel.zeta = region.zeta;
            }
        }
        pixel.share = objects.iter().find(|(object, _)| *object == pixel.point.object).map_or(0.0, |(_, share)| *share);
        pixel
    }
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

    /// `origin` is the tile's upper left pixel.
    fn place(&mut self, origin: UVec2, tile: &TileOut) {
        self.fragments += tile.fragments;
        self.passing += tile.passing;
        self.regions += tile.regions;
        let count = self.shadow.len();
        for (nth, pixel) in tile.pixels.iter().enumerate() {
            let at = origin + UVec2::new(pixel.index % tile.across, pixel.index / tile.across);
            let index = (at.y * self.size.x + at.x) as usize;
            self.colour[index] = self.colour[index] * (1.0 - pixel.covered) + pixel.colour;
            for (light, &[shadow, facing]) in tile.lights[nth * count..][..count].iter().enumerate() {
                self.shadow[light][index] = shadow;
                self.facing[light][index] = facing;
            }
            self.object[index] = pixel.point.object;
            self.share[index] = pixel.share;
            self.position[index] = pixel.point.position;
            self.normal[index] = pixel.point.normal;
            self.depth[index] = pixel.zeta;
        }
    }
}
