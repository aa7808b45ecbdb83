use crate::Soup;
use crate::camera::{Gather, Region};
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
    let axis = frame.axis_for(&scene.camera);
    let view = frame.sample_view(&scene.camera);
    let soup = Soup::all(scene, &scene.camera);
    let mut masks = Masks::new(&view);
    let triangles = soup.casting().map(|caster| masks.note(caster));
    let bins = Bins::new(&view, TexelRect::of_size(view.size()), Cull::None, triangles);
    let size = scene.camera.size();
    let (every_sample, width) = (frame.every_sample, size.x);
    let gather = Gather { soup: &soup, bins: &bins, masks: &masks, view: &view, axis, every_sample, width };
    let tiles = bins.tiles();
    let mut picture = Picture::empty(scene, size);
    // A pixel that is finished takes several times as much as what the picture keeps of it.
    let (count, together) = (tiles.x * tiles.y, TOGETHER.max(16 * rayon::current_num_threads() as u32));
    for first in (0..count).step_by(together as usize) {
        let done: Vec<(UVec2, TileOut)> = (first..count.min(first + together))
            .into_par_iter()
            .map(|index| {
                let tile = UVec2::new(index % tiles.x, index / tiles.x);
                (tile * (BIN / axis), finish_tile(scene, shadows, frame, gather.tile(tile, &wanted)))
            })
            .collect();
        for (origin, tile) in done {
            picture.place(origin, BIN / axis, &tile);
        }
    }
    picture
}

struct Pixel {
    index: u32,
    colour: Vec3,
    covered: f32,
    shadow: Vec<f32>,
    facing: Vec<f32>,
    /// Objects met, each with its fraction of the samples.
    objects: Vec<(u32, f32)>,
    best: f32,
    point: SurfacePoint,
    zeta: f32,
}

/// What one light's shadow says of a tile's regions.
#[derive(Clone)]
struct Answer {
    fractions: Vec<f32>,
    passes: Vec<Vec3>,
}

impl Answer {
    fn lit(regions: usize) -> Self {
        Self { fractions: vec![0.0; regions], passes: vec![Vec3::ONE; regions] }
    }
}

struct TileOut {
    pixels: Vec<Pixel>,
    fragments: u64,
    passing: u64,
    regions: u64,
}

fn finish_tile(
    scene: &Scene,
    shadows: &[&dyn Shadow],
    frame: &Frame,
    (regions, fragments, passing): (Vec<Region>, u64, u64),
) -> TileOut {
    let point = |region: &Region| {
        let normal = if frame.smooth { region.shading_normal } else { region.point.normal };
        SurfacePoint { normal, ..region.point }
    };
    let points: Vec<SurfacePoint> = regions.iter().map(point).collect();
    let mut answers: Vec<Answer> = vec![Answer::lit(points.len()); scene.lights.len()];
    for (light, (shadow, answer)) in shadows.iter().zip(&mut answers).enumerate() {
        if scene.lights[light].casts {
            let key = Key::new(frame.seed, frame.number, light as u32);
            shadow.fractions(&points, key, &mut answer.fractions);
            shadow.transmittances(&points, key, &answer.fractions, &mut answer.passes);
        }
    }
    let mut pixels: Vec<Pixel> = Vec::new();
    let lights = scene.lights.len();
    for (index, region) in regions.iter().enumerate() {
        if pixels.last().is_none_or(|pixel| pixel.index != region.pixel) {
            pixels.push(Pixel::new(region, lights));
        }
        if let Some(pixel) = pixels.last_mut() {
            pixel.add(scene, region, &answers, index);
        }
    }
    TileOut { pixels, fragments, passing, regions: regions.len() as u64 }
}

impl Pixel {
    fn new(region: &Region, lights: usize) -> Self {
        Self {
            index: region.pixel,
            colour: Vec3::ZERO,
            covered: 0.0,
            shadow: vec![0.0; lights],
            facing: vec![0.0; lights],
            objects: Vec::new(),
            best: 0.0,
            point: region.point,
            zeta: region.zeta,
        }
    }

    fn add(&mut self, scene: &Scene, region: &Region, answers: &[Answer], index: usize) {
        let receives = scene.objects[region.point.object as usize].receives;
        let mut arrives = vec![Vec3::ONE; answers.len()];
        for (light, answer) in answers.iter().enumerate() {
            if receives {
                arrives[light] = answer.passes[index];
                self.shadow[light] += answer.fractions[index] * region.share;
            }
            let toward = scene.lights[light].view.toward_eye(region.point.position);
            self.facing[light] += region.point.normal.dot(toward.as_vec3()) * region.share;
        }
        let toward_eye = scene.camera.toward_eye(region.point.position).as_vec3();
        self.colour += shade(scene, region, toward_eye, &arrives) * region.share;
        self.covered += region.share;
        let object = region.point.object;
        match self.objects.iter_mut().find(|(known, _)| *known == object) {
            Some((_, share)) => *share += region.share,
            None => self.objects.push((object, region.share)),
        }
        if region.share > self.best {
            self.best = region.share;
            self.point = region.point;
            self.zeta = region.zeta;
        }
    }

    /// The fraction of the samples that meet the object of the largest region.
    fn share(&self) -> f32 {
        self.objects.iter().find(|(object, _)| *object == self.point.object).map_or(0.0, |(_, share)| *share)
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

    fn place(&mut self, origin: UVec2, across: u32, tile: &TileOut) {
        self.fragments += tile.fragments;
        self.passing += tile.passing;
        self.regions += tile.regions;
        for pixel in &tile.pixels {
            let at = origin + UVec2::new(pixel.index % across, pixel.index / across);
            let index = (at.y * self.size.x + at.x) as usize;
            self.colour[index] = self.colour[index] * (1.0 - pixel.covered) + pixel.colour;
            for light in 0..self.shadow.len() {
                self.shadow[light][index] = pixel.shadow[light];
                self.facing[light][index] = pixel.facing[light];
            }
            self.object[index] = pixel.point.object;
            self.share[index] = pixel.share();
            self.position[index] = pixel.point.position;
            self.normal[index] = pixel.point.normal;
            self.depth[index] = pixel.zeta;
        }
    }
}
