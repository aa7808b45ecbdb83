//! The error of a recipe's picture against many rays, by which the default is judged.

use crate::figure::Context;
use crate::stage::masks::{shadow_grid, value};
use crate::stage::set::Set;
use std::sync::Arc;
use umbrage_oracle::{Geometry, RayCast, metrics};
use umbrage_plane::{Place, SurfacePoint, View};
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, Picture, picture_where};
use umbrage_sample::Key;
use umbrage_scene::gallery::Make;
use umbrage_shadow::{Shadow, same_length};

/// Surfaces whose cosine to the light is lower are not judged.
const FACING: f32 = 0.02;

/// A picture against many rays per pixel.
#[derive(Clone, Copy)]
pub(super) struct Error {
    /// Root mean square over pixels that see one surface, all of it facing the light.
    pub rms: f64,
    /// The same over all pixels whose surfaces face the light, including pixels that see several.
    pub several: f64,
    /// Fraction of the first pixels that are more than three pixels from truth's edges and wrong by more than a half.
    pub wrong: f64,
}

/// A scene, its truth, and which pixels are judged.
pub(super) struct Judge {
    pub set: Set,
    make: Make,
    pixels: u32,
    many: Arc<Many>,
}

/// Many rays per pixel, and which pixels are judged by them.
struct Many {
    picture: Picture,
    /// Pixels that see one surface, all of it facing the light.
    one: Vec<bool>,
    /// All pixels whose surfaces all face the light.
    several: Vec<bool>,
    /// Those of the first that are far from truth's edges.
    sure: Vec<bool>,
    noise: f64,
}

impl Judge {
    pub fn new(cx: &Context, make: Make, pixels: u32, texels: u32) -> Self {
        let set = Set::new(make(), pixels, texels);
        let many = Arc::new(Many::new(cx, &set));
        Self { set, make, pixels, many }
    }

    /// The same truth for a map of another size.
    pub fn with_texels(&self, texels: u32) -> Self {
        Self { set: Set::new((self.make)(), self.pixels, texels), many: self.many.clone(), ..*self }
    }

    /// The picture that many rays see.
    pub fn truth(&self) -> &Picture {
        &self.many.picture
    }

    /// The picture by `axis` × `axis` exact rays per pixel, none of them truth's.
    pub fn rays(&self, cx: &Context, axis: u32) -> Picture {
        let scene = &self.set.scene;
        let geometry = Geometry::new(scene, &scene.camera);
        let rays = RayCast::new(&geometry, &scene.lights[0].view);
        self.set.draw(cx, &rays, &Frame { axis, every_sample: true, number: 1000, ..Frame::default() })
    }

    /// Root mean square, over pixels of one surface, of the difference between the first half of truth's rays and the other half. By itself, each half is
    /// less exact than all of them.
    pub fn noise(&self) -> f64 {
        self.many.noise
    }

    pub fn error(&self, picture: &Picture) -> Error {
        let many = &*self.many;
        let (own, exact) = (&picture.shadow[0], &many.picture.shadow[0]);
        let sure = || (0..own.len()).filter(|&i| many.sure[i]);
        let wrong = sure().filter(|&i| (own[i] - exact[i]).abs() > 0.5).count();
        Error {
            rms: value(metrics::rms(own, exact, &many.one)),
            several: value(metrics::rms(own, exact, &many.several)),
            wrong: wrong as f64 / sure().count().max(1) as f64,
        }
    }

    /// Pixels of one surface, all of it facing the light.
    pub fn judged(&self) -> &[bool] {
        &self.many.one
    }

    /// Those of them that are more than three pixels from truth's edges.
    pub fn sure(&self) -> &[bool] {
        &self.many.sure
    }

    /// A recipe's picture, and all bytes of its map for each texel.
    pub fn by(&self, cx: &Context, recipe: &str, frame: &Frame) -> anyhow::Result<(Picture, f64)> {
        let light = self.set.light(cx, &recipe.parse::<Recipe>()?)?;
        let texels = f64::from(self.set.scene.lights[0].view.size().element_product());
        let bytes = light.maps.iter().map(|map| map.bytes).sum::<usize>() as f64 / texels;
        Ok((self.set.draw(cx, &*light.shadow, frame), bytes))
    }
}

impl Many {
    /// 16 rays for each pixel, and 256 stratified ones for those whose 16, or whose surfaces, do not agree with each other and with those of the
    /// pixels within two; 32 of 16 in a quick run.
    fn new(cx: &Context, set: &Set) -> Self {
        let mut scene = set.scene.clone();
        let light = scene.lights[0].clone();
        scene.lights = vec![light.clone(), light.clone()];
        let geometry = Geometry::new(&scene, &scene.camera);
        let (rays, facing) = (RayCast::new(&geometry, &light.view), FacesLight(&light.view));
        let draw = |axis: u32, number: u32, wanted: &(dyn Fn(u32) -> bool + Sync)| {
            let frame = Frame { axis, every_sample: true, seed: cx.seed, number, ..Frame::default() };
            picture_where(&scene, &[&rays, &facing], &frame, wanted)
        };
        let mut truth = draw(4, 0, &|_| true);
        let some = |part: f32| part > 0.0 && part < 1.0;
        let differs = |i: usize| some(truth.shadow[0][i]) || some(truth.shadow[1][i]) || some(truth.share[i]);
        let mixed: Vec<bool> = (0..truth.share.len()).map(differs).collect();
        let edges = metrics::edge_mask(shadow_grid(&truth), 2);
        let near = metrics::grown(&mixed, truth.size.x as usize, 2);
        let asked: Vec<bool> = near.into_iter().zip(edges).map(|(near, edge)| near || edge).collect();
        let again = |number| draw(cx.pick(8, 4), number, &|pixel| asked[pixel as usize]);
        let pictures: Vec<Picture> = (1..=cx.pick(4, 2)).map(again).collect();
        let all = pictures.len() as f32;
        let half = |pictures: &[Picture], i: usize| {
            pictures.iter().map(|picture| picture.shadow[0][i]).sum::<f32>() / pictures.len() as f32
        };
        let (first, second) = pictures.split_at(pictures.len() / 2);
        let mut halves = [truth.shadow[0].clone(), truth.shadow[0].clone()];
        for i in (0..asked.len()).filter(|&i| asked[i]) {
            (halves[0][i], halves[1][i]) = (half(first, i), half(second, i));
            truth.shadow[0][i] = half(&pictures, i);
            truth.facing[0][i] = pictures.iter().map(|picture| picture.facing[0][i]).sum::<f32>() / all;
            let least = |of: fn(&Picture) -> &Vec<f32>| pictures.iter().map(|one| of(one)[i]).fold(1.0, f32::min);
            truth.shadow[1][i] = least(|picture| &picture.shadow[1]);
            truth.share[i] = least(|picture| &picture.share);
        }
        let several: Vec<bool> = truth.shadow[1].iter().map(|faces| *faces == 1.0).collect();
        truth.shadow.truncate(1);
        // A crease of one thing is two surfaces.
        let centre = set.plain(cx, &Frame::CENTRES);
        let flat = |i: usize| truth.share[i] == 1.0 && (truth.facing[0][i] - centre.facing[0][i]).abs() < FACING;
        let one: Vec<bool> = (0..several.len()).map(|i| several[i] && flat(i)).collect();
        let lit = metrics::lit_mask(shadow_grid(&truth), &truth.facing[0], 3, FACING);
        let dark = metrics::dark_mask(shadow_grid(&truth), &truth.facing[0], 3, FACING);
        let far: Vec<bool> = lit.iter().zip(&dark).map(|(lit, dark)| *lit || *dark).collect();
        let sure = metrics::both(&far, &one);
        let noise = value(metrics::rms(&halves[0], &halves[1], &one));
        Self { picture: truth, one, several, sure, noise }
    }
}

/// No shadow: whether a point faces a light and lies in its map and its cone, 1 where it does.
struct FacesLight<'a>(&'a View);

impl Shadow for FacesLight<'_> {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        same_length(at, out);
        for (point, faces) in at.iter().zip(out) {
            let seen = self.0.receiver(point).is_ok_and(|receiver| {
                receiver.facing >= FACING && self.0.locate(receiver.texel.as_vec2()) == Place::Inside
            });
            *faces = f32::from(u8::from(seen));
        }
    }
}
