//! Pictures by rays, and their judgements of recipes, kept for as long as they may be needed again.

use glam::UVec2;
use umbrage_oracle::judge::Score;
use umbrage_plane::{SurfacePoint, View};
use umbrage_recipe::Recipe;
use umbrage_render::Picture;
use umbrage_sample::Key;
use umbrage_shadow::Shadow;
use umbrage_view::Stop;

use crate::stage::Stage;
use glam::Vec3;

/// Most truths that are kept.
const MOST: usize = 2;

/// What truth depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct TruthKey {
    /// The lit picture, not the shadow of one light.
    lit: bool,
    camera: View,
    lights: Vec<View>,
    samples: u32,
}

impl TruthKey {
    pub fn new(stage: &Stage, lit: bool, samples: u32) -> Self {
        // Rays know nothing of a map's texels.
        let one = |view: &View| view.with_size(UVec2::ONE).unwrap_or(*view);
        let lights = stage.scene.lights.iter().map(|light| one(&light.view)).collect();
        Self { lit, camera: stage.scene.camera, lights, samples }
    }
}

/// What a judgement depends on besides its truth.
pub type JudgedKey = (TruthKey, Recipe, u32);

/// A recipe's shadow compared with truth.
pub struct Judged {
    pub score: Score,
    pub pixels: Vec<bool>,
    /// The fraction in shadow by the recipe's maps.
    pub result: Vec<f32>,
    pub truth: Vec<f32>,
}

/// What is kept, the last first.
pub struct Kept<K, T>(Vec<(K, T)>);

impl<K: PartialEq, T> Kept<K, T> {
    pub fn new() -> Self {
        Self(Vec::new())
    }

    /// What was kept under a key, or what is made for it; of `most` others the oldest is dropped.
    ///
    /// # Errors
    /// What `make` returned.
    pub fn or_make<E>(&mut self, key: K, most: usize, make: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
        if let Some(at) = self.0.iter().position(|(known, _)| *known == key) {
            self.0[..=at].rotate_right(1);
        } else {
            let made = make()?;
            self.0.truncate(most.saturating_sub(1));
            self.0.insert(0, (key, made));
        }
        Ok(&self.0[0].1)
    }
}

/// Truths by what they depend on.
pub type Truths = Kept<TruthKey, Picture>;

impl Truths {
    /// # Errors
    /// What `make` returned.
    pub fn get<E>(&mut self, key: TruthKey, make: impl FnOnce() -> Result<Picture, E>) -> Result<&Picture, E> {
        self.or_make(key, MOST, make)
    }
}

/// A shadow that does no more work once nobody waits for it.
pub struct Until<'a> {
    pub shadow: &'a dyn Shadow,
    pub stop: &'a Stop,
}

impl Shadow for Until<'_> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        if self.stop.is_set() {
            out.fill(0.0);
        } else {
            self.shadow.fractions(at, key, out);
        }
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        if !self.stop.is_set() {
            self.shadow.transmittances(at, key, fractions, out);
        }
    }
}
