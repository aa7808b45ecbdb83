mod conditional;
mod depth;
mod reeves;
mod soft;
mod stored;
mod values;
mod williams;

use conditional::WangMolnar;
use reeves::Reeves;
use soft::Burley;
use std::str::FromStr;
use stored::{Rule, Stored};
use umbrage_depth::{Map, Storage};
use umbrage_plane::{Bias, View};
use umbrage_sample::EveryTexel;
use umbrage_scene::Scene;
use umbrage_shadow::{Filter, FilteredDepth, Shadow, ShadowMap, Williams, presets};

/// Puts a filter over a map in the storage that is asked for: where types end and the one dynamic seam begins.
pub fn bind<F: Filter + 'static>(filter: F, map: impl Into<Map>, storage: Storage) -> Box<dyn Shadow> {
    over(filter, map.into().kept(storage))
}

fn over<F: Filter + 'static>(filter: F, map: Map) -> Box<dyn Shadow> {
    Box::new(ShadowMap { filter, map })
}

/// Why a recipe's text cannot be used: one line that names the field and the value.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field} = {value:?}: expected {expected}")]
pub struct RecipeError {
    /// The field.
    pub field: String,
    /// What was written.
    pub value: String,
    /// What may be written.
    pub expected: &'static str,
}

impl RecipeError {
    /// The same, saying whose recipe it is.
    pub(crate) fn of_light(self, name: &str) -> Self {
        Self { field: format!("light {name:?}, {}", self.field), ..self }
    }

    fn value(field: &str, value: &str, expected: &'static str) -> Self {
        Self { field: field.into(), value: value.into(), expected }
    }
}

/// A shadow algorithm by name, as people write it: a preset and what differs from it, such as
/// `reeves87,samples=16,res-factor=3,bias=0.3..0.4`. Which surface is stored, where one looks and which depth is compared are chosen one by one:
/// `burley,stored=midpoint` and `woo92,depth=cone,pattern=disc` are recipes too.
///
/// | preset | stored | filter |
/// |---|---|---|
/// | `williams78` | first | point by point |
/// | `reeves87`, `reeves87-recommended` | first | percentage closer, biases of a range |
/// | `woo92` | midpoint | percentage closer, no bias |
/// | `wang-molnar94` | back-face | nearest four texels, tangent plane where they disagree |
/// | `burley` | first | soft, bias cone |
/// | `fernando` | first | soft, plain mean, constant bias |
/// | `ordinary` | first | depths filtered first: the control |
///
/// | field | of | values |
/// |---|---|---|
/// | `stored` | all | `first`, `second`, `back-face`, `normals` (back faces by interpolated normals), `midpoint`, `deep` |
/// | `ratio`, `merge` | midpoint | part of the way above 0 to 1; share of the distance within which surfaces are one |
/// | `same` | midpoint | `depth`, `object`, `surface`: which fragments are one; `surface` with several `sub-samples` |
/// | `epsilon` | deep | error bound from 0, below 1 |
/// | `sub-samples` | all | samples along a texel's side, 1 to 8: deep maps average them (4 unless told, powers of 2), others keep the nearest surfaces over them (1; not `normals`) |
/// | `pattern` | reeves87, woo92 | `jittered`, `uniform`, `gaussian`, `inside`, `warp`, `every`, `tent`, `centre`, `disc` |
/// | `samples`, `min-samples` | reeves87, woo92 | counts from 1, the second at most the first |
/// | `jitter` | reeves87, woo92 | part of a cell, 0 (a regular grid) to 1 |
/// | `hard-cap` | reeves87, woo92 | `on`, `off`: whether `samples` is never exceeded |
/// | `compare`, `unit` | reeves87, woo92 | `float`, `integer` (whole units first: `jittered`, a bias of 0); what is counted as one, map units |
/// | `res-factor`, `min-size` | reeves87, woo92, wang-molnar94; the first of ordinary too | numbers from 0 |
/// | `bias` | all | a number or, with `depth=constant`, a range `a..b`, then a unit: none or `w` world, `t` texels, `s` depth steps, `m` map units |
/// | `spread` | `depth=constant` | `random`, `ramp` |
/// | `depth` | reeves87, woo92, burley, fernando | `constant`, `plane`, `cone` |
/// | `slope`, `radius` | `depth=cone` | a number from 0; `texel-centre`, `nominal` |
/// | `slack`, `reach` | `depth=plane`, wang-molnar94 | roundings by which the plane is moved, 0 to 1; most that it may leave the receiver's own depth, map units |
/// | `nearby` | wang-molnar94 | `four`, `region`, `box3` .. `box9`; sets `res-factor` and `min-size` |
/// | `pattern` | wang-molnar94 | `every`, `tent` |
/// | `virtual` | wang-molnar94 | `mixed`, `always`, `never` |
/// | `min-cos` | wang-molnar94 | 0 to 1 |
/// | `backs` | wang-molnar94 | `shaded`, `dark` |
/// | `min`, `max` | burley, fernando | radii, then `t` texels, `w` world units, `%` of the map; none is texels |
/// | `light` | burley, fernando | radius of a disc light in world units (tangent of its angle if directional); instead of `min`, `max` |
/// | `nearest` | burley, fernando | with `light`: no occluder is nearer to the light, world units; the near plane unless told |
/// | `search`, `blur` | burley, fernando | numbers of taps from 1 |
/// | `rotate`, `half-offset`, `rescue` | burley, fernando | `on`, `off` |
/// | `falloff` | burley, fernando | `linear`, `smooth`, `square` (1 − .9·share²), `flat` (with an evenly spread search) |
/// | `shape`, `opacity-shape` | burley, fernando | exponents above 0 |
/// | `opacity`, `fade` | burley, fernando | `near..far`, each 0 to 1; world units above 0 |
/// | `lookup` | williams78 | `nearest`, `bilinear`, `faithful` |
/// | `guard` | williams78 | depth steps of difference up to which `bilinear` interpolates |
/// | `dither` | williams78 | full range in texels, 0 to 2 |
/// | `dither-law` | williams78 | `normal`, `uniforms` |
/// | `dither-depth` | williams78 | full range of a displacement in depth, map units, from 0 |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recipe {
    stored: Stored,
    method: Method,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Method {
    Williams(Williams),
    Reeves(Reeves),
    WangMolnar(WangMolnar),
    Burley(Burley),
    Ordinary(FilteredDepth),
}

/// Whether a field is known; its value is kept then.
type Set = Result<bool, RecipeError>;

const PRESETS: &str = "williams78, reeves87, reeves87-recommended, woo92, wang-molnar94, burley, fernando or ordinary";

impl FromStr for Recipe {
    type Err = RecipeError;
    fn from_str(text: &str) -> Result<Self, RecipeError> {
        let mut parts = text.split(',').map(str::trim);
        let name = parts.next().unwrap_or_default();
        let (rule, method) = match name {
            "williams78" => (Rule::First, Method::Williams(presets::williams78().filter)),
            "reeves87" => (Rule::First, Method::Reeves(Reeves::new(presets::reeves87().filter))),
            "reeves87-recommended" => {
                (Rule::First, Method::Reeves(Reeves::new(presets::reeves87_recommended().filter)))
            }
            "woo92" => (Rule::Midpoint, Method::Reeves(Reeves::new(presets::woo92().filter))),
            "wang-molnar94" => (Rule::BackFace, Method::WangMolnar(WangMolnar::default())),
            "burley" => (Rule::First, Method::Burley(Burley::cone())),
            "fernando" => (Rule::First, Method::Burley(Burley::fernando())),
            "ordinary" => {
                let ordinary =
                    FilteredDepth::default().with_pattern(EveryTexel).with_bias(Bias::ZERO).with_res_factor(1.0);
                (Rule::First, Method::Ordinary(ordinary))
            }
            _ => return Err(RecipeError::value("recipe", name, PRESETS)),
        };
        let mut recipe = Self { stored: Stored::new(rule), method };
        for part in parts {
            let (field, value) = part.split_once('=').ok_or_else(|| RecipeError::value(part, "", "field=value"))?;
            if !recipe.stored.set(field, value)? && !recipe.method.set(field, value)? {
                return Err(RecipeError::value("field", field, recipe.method.fields()));
            }
        }
        recipe.method.check()?;
        Ok(recipe)
    }
}

impl Recipe {
    /// Pass 1: the map that this recipe wants of a light's view.
    pub fn bake(&self, scene: &Scene, view: &View) -> Map {
        self.bake_moments(&[scene], view)
    }

    /// The same over an exposure, `moments` being the scene at evenly spread times (EXT-2): deep maps hold the mean of them, of maps of one
    /// surface each texel sees one of them. An empty map of none.
    pub fn bake_moments(&self, moments: &[&Scene], view: &View) -> Map {
        self.stored.bake(moments, view)
    }

    /// The algorithm over a map.
    pub fn bind(&self, map: impl Into<Map>, storage: Storage) -> Box<dyn Shadow> {
        let map = map.into().kept(storage);
        match self.method {
            Method::Williams(williams) => over(williams, map),
            Method::Ordinary(ordinary) => over(ordinary, map),
            Method::Reeves(reeves) => reeves.bind(map),
            Method::WangMolnar(wang_molnar) => wang_molnar.bind(map),
            Method::Burley(burley) => burley.bind(map),
        }
    }
}

impl Method {
    fn set(&mut self, field: &str, value: &str) -> Set {
        match self {
            Self::Williams(williams) => williams::set(williams, field, value),
            Self::Reeves(reeves) => reeves.set(field, value),
            Self::WangMolnar(wang_molnar) => wang_molnar.set(field, value),
            Self::Burley(burley) => burley.set(field, value),
            Self::Ordinary(ordinary) => set_ordinary(ordinary, field, value),
        }
    }

    fn check(&self) -> Result<(), RecipeError> {
        match self {
            Self::Reeves(reeves) => reeves.check(),
            Self::Burley(burley) => burley.check(),
            Self::Williams(_) | Self::WangMolnar(_) | Self::Ordinary(_) => Ok(()),
        }
    }

    fn fields(&self) -> &'static str {
        match self {
            Self::Williams(_) => williams::FIELDS,
            Self::Reeves(_) => reeves::FIELDS,
            Self::WangMolnar(_) => conditional::FIELDS,
            Self::Burley(_) => soft::FIELDS,
            Self::Ordinary(_) => "stored, ratio, merge, same, epsilon, sub-samples, bias or res-factor",
        }
    }
}

fn set_ordinary(ordinary: &mut FilteredDepth, field: &str, value: &str) -> Set {
    match field {
        "bias" => ordinary.bias = values::bias(field, value)?,
        "res-factor" => ordinary.res_factor = values::number(field, value)?,
        _ => return Ok(false),
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use depth::{Choice, Depth};
    use umbrage_sample::Jittered;
    use umbrage_shadow::williams::{Dither, DitherLaw, Guard, Lookup};
    use umbrage_shadow::{Biased, MapRadius, Opacity, Pcf, Radius, Softness, Spread};

    fn reeves(text: &str) -> Reeves {
        let Method::Reeves(reeves) = text.parse::<Recipe>().unwrap().method else { panic!("{text}") };
        reeves
    }

    fn refused(text: &str) -> String {
        text.parse::<Recipe>().unwrap_err().to_string()
    }

    #[test]
    fn r87_12_every_field_is_read() {
        let all = "reeves87,min-samples=32,samples=64,jitter=0.5,hard-cap=on,res-factor=2,min-size=1,bias=0.2..0.3t,spread=ramp";
        let reeves = reeves(all);
        let pattern =
            Jittered::default().with_num_samples(64).with_min_samples(32).with_jitter(0.5).with_hard_cap(true);
        let depth =
            Biased::default().with_low(Bias::Texels(0.2)).with_high(Bias::Texels(0.3)).with_spread(Spread::Ramp);
        assert_eq!(
            reeves.pcf,
            Pcf::default().with_pattern(pattern).with_depth(Biased::default()).with_res_factor(2.0).with_min_size(1.0)
        );
        assert_eq!(reeves.depth, Depth::new(Choice::Constant, depth));
        let all = "williams78,bias=3m,guard=2,dither=1,dither-law=uniforms,dither-depth=0.5";
        let dither = Dither::default().with_amplitude(1.0).with_law(DitherLaw::ThreeUniforms).with_depth(0.5);
        let lookup = Lookup::Bilinear(Guard::Steps(2.0));
        let williams = Williams::default().with_bias(Bias::Map(3.0)).with_lookup(lookup).with_dither(dither);
        assert_eq!(all.parse::<Recipe>().unwrap().method, Method::Williams(williams));
        for (name, pattern) in reeves::PATTERNS {
            assert_eq!(self::reeves(&format!("reeves87,pattern={name}")).pattern, *pattern);
        }
    }

    #[test]
    fn what_cannot_be_meant_is_told_by_field_and_value() {
        let unit = "two numbers from 0, the smaller first, and one unit w, t, s or m";
        assert_eq!(refused("reeves87,bias=0.3w..0.4t"), format!("bias = \"0.3w..0.4t\": expected {unit}"));
        assert_eq!(refused("reeves87,bias=0.4..0.3"), format!("bias = \"0.4..0.3\": expected {unit}"));
        assert_eq!(refused("reeves87,samples=8,min-samples=9"), "min-samples = \"9\": expected at most samples");
        assert!(refused("reeves87,depth=plane,bias=0.1..0.2").starts_with("bias = "));
        assert!(refused("reeves87,depth=plane,bias=0,spread=ramp").starts_with("spread = "));
        assert_eq!(refused("reeves87,jitter=1.5"), "jitter = \"1.5\": expected a number from 0 to 1");
        assert_eq!(refused("williams78,dither=2.5"), "dither = \"2.5\": expected a number from 0 to 2");
        assert!(refused("reeves86").contains("expected williams78, reeves87"));
        for text in [
            "reeves87,samples=0",
            "reeves87,samples",
            "reeves87,bias=NaN",
            "ordinary,spread=ramp",
            "williams78,bias=-1",
            "",
        ] {
            assert!(!refused(text).contains('\n'), "{text}");
        }
    }

    #[test]
    fn presets_choose_what_is_stored_and_how_it_is_asked() {
        let of = |text: &str| text.parse::<Recipe>().unwrap();
        assert_eq!(of("woo92").stored.rule, Rule::Midpoint);
        assert_eq!(reeves("woo92").depth.biased, Biased::constant(Bias::ZERO));
        assert_eq!(of("wang-molnar94").stored.rule, Rule::BackFace);
        let mixed = of("burley,stored=midpoint,ratio=0.25,depth=cone,slope=1");
        assert_eq!((mixed.stored.rule, mixed.stored.midpoint.ratio), (Rule::Midpoint, 0.25));
        let Method::Burley(burley) = mixed.method else { panic!("burley") };
        assert_eq!((burley.depth.choice, burley.depth.slope), (Choice::Cone, 1.0));
        assert_eq!(reeves("woo92,depth=cone,pattern=disc").depth.cone(), umbrage_shadow::BiasCone::default());
    }

    #[test]
    fn wm94_6_neighbourhoods_by_name() {
        for (text, wanted) in [("four", (0.0, 1.0)), ("region", (1.0, 1.0)), ("box3", (0.0, 1.5)), ("box9", (0.0, 4.5))]
        {
            let recipe: Recipe = format!("wang-molnar94,nearby={text}").parse().unwrap();
            let Method::WangMolnar(found) = recipe.method else { panic!("wang-molnar94") };
            assert_eq!((found.filter.res_factor, found.filter.min_size), wanted, "{text}");
        }
        for text in ["box2", "box10", "box", "five"] {
            assert!(refused(&format!("wang-molnar94,nearby={text}")).starts_with("nearby = "), "{text}");
        }
    }

    #[test]
    fn b06_every_field_is_read_and_what_contradicts_is_refused() {
        let all = "burley,min=1w,max=2%,search=16,blur=64,rotate=off,half-offset=on,rescue=on,falloff=smooth,shape=2,opacity=0.9..0.2,opacity-shape=0.5,fade=30,bias=0.1,radius=nominal";
        let Method::Burley(found) = all.parse::<Recipe>().unwrap().method else { panic!("burley") };
        let soft = found.soft;
        let between = Softness::Between { min: MapRadius::World(1.0), max: MapRadius::Fraction(0.02) };
        assert_eq!((found.softness(), soft.radius_gamma, soft.rescue), (between, 2.0, true));
        assert_eq!((soft.search.num_samples, soft.blur.num_samples, soft.blur.rotate), (16, 64, false));
        assert_eq!(soft.opacity, Opacity::default().with_near(0.9).with_far(0.2).with_fade(30.0).with_gamma(0.5));
        assert_eq!((found.depth.cone().base, found.depth.cone().radius), (0.1, Radius::Nominal));
        let light: Recipe = "burley,light=2,nearest=5,depth=plane".parse().unwrap();
        let Method::Burley(found) = light.method else { panic!("burley") };
        assert_eq!(found.softness(), Softness::Light { radius: 2.0, nearest: 5.0 });
        assert_eq!("burley,depth=plane,nearest=5,light=2".parse(), Ok(light), "in any order");
        assert!(refused("burley,light=2,max=3").starts_with("max = "));
        assert!(refused("burley,max=3,light=2").starts_with("max = "));
        assert!(refused("burley,min=9,max=3").starts_with("min = "));
        assert!(refused("burley,max=0.2").starts_with("min = "), "the preset's min is larger");
        assert!(refused("reeves87,sub-samples=9").starts_with("sub-samples = "));
        assert!(refused("burley,nearest=3").starts_with("nearest = "));
        assert!(refused("burley,bias=1t").starts_with("bias = "));
        assert!(refused("burley,opacity=1").starts_with("opacity = "));
        assert!(refused("woo92,ratio=0").starts_with("ratio = "));
        assert!(refused("reeves87,compare=integer").starts_with("compare = "));
        assert!("woo92,compare=integer".parse::<Recipe>().is_ok());
        assert!(refused("burley,pattern=disc").contains("fade"), "the fields that there are");
    }
}
