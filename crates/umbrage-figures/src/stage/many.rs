//! Many rays per pixel, which pictures are judged by.

use super::masks::{shadow_grid, value};
use super::without_map;
use glam::Vec3;
use umbrage_oracle::{Geometry, RayCast, metrics};
use umbrage_plane::{Place, SurfacePoint, View};
use umbrage_render::{Frame, Picture, rays_where};
use umbrage_sample::Key;
use umbrage_scene::Scene;
use umbrage_shadow::{Shadow, same_length};

/// Surfaces whose cosine to the light is lower are not judged.
const FACING: f32 = 0.02;

/// Many rays per pixel, and which pixels are judged by them.
#[derive(Debug)]
pub(crate) struct Many {
    pub picture: Picture,
    /// Pixels that see one surface, all of it facing the light.
    pub one: Vec<bool>,
    /// All pixels whose surfaces all face the light.
    pub several: Vec<bool>,
    /// Those of the first that are far from truth's edges.
    pub sure: Vec<bool>,
    /// Root mean square, over pixels of one surface, of the difference between the first half of the rays and the other half.
    pub noise: f64,
}

impl Many {
    /// 16 rays for each pixel, and more stratified ones for those whose 16, or whose surfaces, do not agree with each other and with those of the
    /// pixels within two: `across` × `across` of them in each of `pictures`.
    pub fn new(scene: &Scene, geometry: &Geometry, seed: u32, (across, pictures): (u32, u32)) -> Self {
        let centre = rays_where(scene, &[], &Frame { seed, ..Frame::CENTRES }, |_| true);
        let mut scene = scene.clone();
        let light = without_map(&scene.lights[0].view);
        scene.lights = vec![scene.lights[0].clone(), scene.lights[0].clone()];
        let (rays, facing) = (RayCast::new(geometry, &light), FacesLight(&light));
        let draw = |axis: u32, number: u32, wanted: &(dyn Fn(u32) -> bool + Sync)| {
            let frame = Frame { axis, every_sample: true, seed, number, ..Frame::default() };
            rays_where(&scene, &[&rays, &facing], &frame, wanted)
        };
        let mut truth = draw(4, 0, &|_| true);
        let some = |part: f32| part > 0.0 && part < 1.0;
        let differs = |i: usize| some(truth.shadow[0][i]) || some(truth.shadow[1][i]) || some(truth.share[i]);
        let mixed: Vec<bool> = (0..truth.share.len()).map(differs).collect();
        let edges = metrics::edge_mask(shadow_grid(&truth), 2);
        let near = metrics::grown(&mixed, truth.size.x as usize, 2);
        let asked: Vec<bool> = near.into_iter().zip(edges).map(|(near, edge)| near || edge).collect();
        let again = |number| draw(across, number, &|pixel| asked[pixel as usize]);
        let pictures: Vec<Picture> = (1..=pictures).map(again).collect();
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
            // Of no extent: its middle alone counts.
            let point = SurfacePoint { corner_offsets: [Vec3::ZERO; 4], ..*point };
            let seen = self.0.receiver(&point).is_ok_and(|receiver| {
                receiver.facing >= FACING && self.0.locate(receiver.texel.as_vec2()) == Place::Inside
            });
            *faces = f32::from(u8::from(seen));
        }
    }
}
