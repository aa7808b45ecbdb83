use super::{Shadow, same_length};
use umbrage_depth::TagMap;
use umbrage_plane::{SurfacePoint, Verdict};
use umbrage_sample::Key;

/// The baseline by object tags: lit where the nearest object of the texel is the receiver's own, or there is none (Hourcade & Nicolas, as
/// Wang & Molnar 1994 describe it). 0 or 1.
///
/// An object never shadows itself, and where objects meet, each casts false shadow on texels of the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Tags(pub TagMap);

impl Shadow for Tags {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        same_length(at, out);
        let view = self.0.view();
        for (point, fraction) in at.iter().zip(out) {
            let place = match view.receiver(point) {
                Ok(seen) => {
                    let texel = seen.texel.as_vec2();
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
