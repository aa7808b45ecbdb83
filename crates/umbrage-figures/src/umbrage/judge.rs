//! The error of a recipe's picture against many rays, by which the default is judged.

use crate::figure::Context;
use crate::stage::many::Many;
use crate::stage::masks::value;
use crate::stage::set::Set;
use crate::stage::truths::Rays;
use std::sync::Arc;
use umbrage_depth::DepthMap;
use umbrage_oracle::{RayCast, metrics};
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, Picture};
use umbrage_scene::gallery::Make;

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
    pub set: Arc<Set>,
    many: Arc<Many>,
}

impl Judge {
    pub fn new(cx: &Context, make: Make, pixels: u32, texels: u32) -> Self {
        let set = Arc::new(Set::new(make(), pixels, texels));
        let seen = set.seen(Frame { seed: cx.seed, ..Frame::CENTRES }, Rays::Hard);
        let many =
            cx.truths.many.once(seen, || Many::new(&set.scene, &set.geometry(), cx.seed, cx.pick((8, 4), (4, 2))));
        Self { set, many }
    }

    /// The same truth for a map of another size.
    pub fn with_texels(&self, texels: u32) -> Self {
        let same = self.set.scene.lights[0].view.size().x == texels;
        let set = if same { self.set.clone() } else { self.set.with_texels(texels).into() };
        Self { set, many: self.many.clone() }
    }

    /// The picture that many rays see.
    pub fn truth(&self) -> &Picture {
        &self.many.picture
    }

    /// The picture by `axis` × `axis` exact rays per pixel, none of them truth's.
    pub fn rays(&self, cx: &Context, axis: u32) -> Picture {
        let geometry = self.set.geometry();
        let rays = RayCast::new(&geometry, &self.set.scene.lights[0].view);
        self.set.draw_rays(cx, &rays, &Frame { axis, every_sample: true, number: 1000, ..Frame::default() })
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
        let set = &self.set;
        let texels = f64::from(set.scene.lights[0].view.size().element_product());
        let recipe: Recipe = recipe.parse()?;
        let map = set.map_by(cx, &recipe.pass_1())?;
        let shadow = recipe.bind((*map).clone(), cx.storage)?;
        Ok((set.draw(cx, &*shadow, frame), (*map).clone().kept(cx.storage).allocated() as f64 / texels))
    }
}
