use super::{Shadow, same_length};
use umbrage_depth::TagMap;
use umbrage_plane::{SurfacePoint, Verdict};
use umbrage_sample::Key;

/// The baseline by object tags: lit where the nearest object of the texel is the receiver's own, or there is none (Hourcade & Nicolas, as
/// Wang & Molnar 1994 tell it; WM94-16). 0 or 1.
///
/// An object never shadows itself, and where objects meet, texels of the one stand in false shadow of the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Tags(pub TagMap);

impl Shadow for Tags {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        same_length(at, out);
        let view = self.0.view();
        for (point, fraction) in at.iter().zip(out) {
            let place = match view.receiver(point) {
                Ok(seen) => {
                    let texel = seen.footprint.centre;
                    match view.rules().verdict(view.locate(texel)) {
                        Verdict::Compare => {
                            let other = self.0.id(texel.floor().as_ivec2()).is_some_and(|id| id != point.object);
                            *fraction = f32::from(u8::from(other));
                            continue;
                        }
                        settled => settled,
                    }
                }
                Err(place) => view.rules().verdict(place),
            };
            *fraction = f32::from(u8::from(place == Verdict::Shadowed));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, UVec2, Vec3};
    use umbrage_plane::{Rules, View};

    #[test]
    fn wm94_16_own_and_empty_texels_are_lit_others_dark_and_the_rules_answer_outside() {
        let view = View::orthographic(DVec3::Z * 9.0, DVec3::ZERO, DVec3::Y, 1.0, 1.0, 20.0, UVec2::new(3, 1));
        let view = view.unwrap().with_rules(Rules::SPOT);
        let tags = Tags(TagMap::new(view, [Some(4), None, Some(5)]));
        let ask = |x: f32| {
            let point = SurfacePoint { object: 4, ..SurfacePoint::at(Vec3::new(x, 0.0, 0.0), Vec3::Z) };
            tags.fraction(&point, Key::new(0, 0, 0))
        };
        assert_eq!([-2.0, 0.0, 2.0, 4.0].map(ask), [0.0, 0.0, 1.0, 1.0]);
    }
}
