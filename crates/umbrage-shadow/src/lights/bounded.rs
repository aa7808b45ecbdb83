use super::{Shadow, same_length};
use crate::Explanation;
use crate::settled::answer;
use glam::{DVec3, Vec3};
use umbrage_plane::{SurfacePoint, View};
use umbrage_sample::Key;

/// Places along each side of a region at whose middle the light ends.
const ACROSS: u32 = 4;

/// A light whose own view determines where it ends, whatever its maps are: area lights, whose maps are made from several points of them
/// ([`View::over_disc`]), and spots that are too wide for one map ([`View::faces_ahead`]).
///
/// Where a place lies behind the light, outside its map or beyond its cone, the view's rules decide; a region on that border is judged at 16 places.
pub struct Bounded<'a> {
    /// The light as a whole.
    pub view: View,
    /// Whether its cone alone bounds it, and not its map.
    pub by_cone: bool,
    /// The shadow inside.
    pub shadow: Box<dyn Shadow + 'a>,
}

impl Bounded<'_> {
    /// The result at a place in the world, where the light as a whole determines it.
    fn at(&self, point: &SurfacePoint, place: DVec3) -> Option<f32> {
        let rules = self.view.rules();
        let verdict = if self.by_cone && self.view.beyond_cone(place) {
            rules.beyond_cone
        } else {
            match self.view.receiver(&SurfacePoint::at(place, point.normal)) {
                Ok(_) if self.by_cone => return None,
                Ok(receiver) => rules.verdict(self.view.locate(receiver.texel.as_vec2())),
                Err(place) => rules.verdict(place),
            }
        };
        answer(verdict)
    }

    /// The fraction of a region that the light as a whole settles, and the fraction of the region that is dark by that.
    fn settled(&self, point: &SurfacePoint) -> (f32, f32) {
        let [a, b, c, d] = point.corners();
        let share = |answers: &[Option<f32>]| {
            let settled = answers.iter().flatten();
            let of = 1.0 / answers.len() as f32;
            (settled.clone().count() as f32 * of, settled.sum::<f32>() * of)
        };
        let first = [point.position, a, b, c, d].map(|place| self.at(point, place));
        if first == [first[0]; 5] {
            return share(&first[..1]);
        }
        let step = |i: u32| f64::from(2 * i + 1) / f64::from(2 * ACROSS);
        let place = |i: u32| a.lerp(b, step(i % ACROSS)).lerp(d.lerp(c, step(i % ACROSS)), step(i / ACROSS));
        let all: Vec<Option<f32>> = (0..ACROSS * ACROSS).map(|i| self.at(point, place(i))).collect();
        share(&all)
    }
}

impl Shadow for Bounded<'_> {
    fn explain(&self, at: &SurfacePoint, key: Key) -> Vec<Explanation> {
        self.shadow.explain(at, key)
    }

    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        self.shadow.fractions(at, key, out);
        for (point, fraction) in at.iter().zip(out) {
            let (settled, dark) = self.settled(point);
            *fraction = dark + (1.0 - settled) * *fraction;
        }
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        same_length(at, fractions);
        // What passes by colour is computed from the inner fractions, not from those that include the border.
        let mut inner = vec![0.0; at.len()];
        self.shadow.fractions(at, key, &mut inner);
        self.shadow.transmittances(at, key, &inner, out);
        for (point, passes) in at.iter().zip(out) {
            let (settled, dark) = self.settled(point);
            *passes = Vec3::splat(settled - dark) + (1.0 - settled) * *passes;
        }
    }
}

impl std::fmt::Debug for Bounded<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Bounded").field("view", &self.view).field("by_cone", &self.by_cone).finish_non_exhaustive()
    }
}
