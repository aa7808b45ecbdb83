//! What is read, what is refused, and that what is written reads as the same.

mod engines;

use crate::engine::{Depth, EngineBias, OfEngine};
use crate::pattern::PatternName;
use crate::values::{DepthName, Rule, Values};
use crate::{Field, Kind, PresetName, Recipe, help, markdown};
use proptest::prelude::*;
use umbrage_plane::Bias;
use umbrage_sample::Jittered;
use umbrage_shadow::williams::{Dither, DitherLaw, Guard, Lookup};
use umbrage_shadow::{
    AnyDepth, BiasCone, Biased, MapRadius, NormalOffset, OffsetGrowth, Opacity, Radius, SlopeScaled, Softness, Spread,
};

fn read(text: &str) -> Values {
    text.parse::<Recipe>().unwrap().values
}

fn of_engine(bias: EngineBias) -> OfEngine {
    Values::of(PresetName::Woo92).of_engine(bias)
}

fn refused(text: &str) -> String {
    text.parse::<Recipe>().unwrap_err().to_string()
}

#[test]
fn r87_12_every_field_is_read() {
    let all =
        "reeves87,min-samples=32,samples=64,jitter=0.5,hard-cap=on,res-factor=2,min-size=1,bias=0.2..0.3t,spread=ramp";
    let values = read(all);
    let pattern = Jittered::default().with_num_samples(64).with_min_samples(32).with_jitter(0.5).with_hard_cap(true);
    let depth = Biased::default().with_low(Bias::Texels(0.2)).with_high(Bias::Texels(0.3)).with_spread(Spread::Ramp);
    assert_eq!((values.jittered, values.res_factor, values.min_size), (pattern, 2.0, 1.0));
    assert_eq!((values.depth, values.biased), (DepthName::Constant, depth));
    assert_eq!(values.compared(), Depth::Any(AnyDepth::Biased(depth)));
    let values = read("williams78,bias=3m,guard=2,dither=1,dither-law=uniforms,dither-depth=0.5");
    let dither = Dither::default().with_amplitude(1.0).with_law(DitherLaw::ThreeUniforms).with_depth(0.5);
    assert_eq!((values.biased.low, values.dither), (Bias::Map(3.0), dither));
    assert_eq!(values.lookup, Lookup::Bilinear(Guard::Steps(2.0)));
    let patterns = [
        ("jittered", PatternName::Jittered),
        ("table", PatternName::Table),
        ("uniform", PatternName::Uniform),
        ("gaussian", PatternName::Gaussian),
        ("inside", PatternName::Inside),
        ("warp", PatternName::Warp),
        ("every", PatternName::Every),
        ("tent", PatternName::Tent),
        ("centre", PatternName::Centre),
        ("disc", PatternName::Disc),
        ("castano5", PatternName::Castano5),
        ("castano7", PatternName::Castano7),
        ("area-tent", PatternName::AreaTent),
        ("vogel", PatternName::Vogel),
    ];
    for (name, pattern) in patterns {
        assert_eq!(read(&format!("reeves87,pattern={name}")).pattern, pattern);
    }
}

#[test]
fn what_cannot_be_meant_is_reported_by_field_and_value() {
    let unit = "a number from 0, or two as a..b with the smaller first, and one unit w, t, s or m";
    assert_eq!(refused("reeves87,bias=0.3w..0.4t"), format!("bias = \"0.3w..0.4t\": expected {unit}"));
    assert_eq!(refused("reeves87,bias=0.4..0.3"), format!("bias = \"0.4..0.3\": expected {unit}"));
    assert_eq!(refused("reeves87,samples=8,min-samples=9"), "min-samples = \"9\": expected at most samples");
    assert!(refused("reeves87,depth=plane,bias=0.1..0.2").starts_with("bias = "));
    assert!(refused("reeves87,depth=plane,bias=0,spread=ramp").starts_with("spread = "));
    assert_eq!(refused("reeves87,jitter=1.5"), "jitter = \"1.5\": expected a number from 0 to 1");
    assert_eq!(refused("williams78,dither=2.5"), "dither = \"2.5\": expected a number from 0 to 2");
    assert_eq!(refused("reeves87,sub-samples=9"), "sub-samples = \"9\": expected a whole number from 1 to 8");
    assert_eq!(refused("woo92,same=thing"), "same = \"thing\": expected depth, object or surface");
    assert!(refused("reeves86").contains("expected auto, williams78, reeves87"));
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
    assert_eq!(read("woo92").rule, Rule::Midpoint);
    assert_eq!(read("woo92").biased, Biased::constant(Bias::ZERO));
    assert_eq!(read("wang-molnar94").rule, Rule::BackFace);
    let mixed = read("burley,stored=midpoint,ratio=0.25,depth=cone,slope=1");
    assert_eq!((mixed.rule, mixed.midpoint.ratio), (Rule::Midpoint, 0.25));
    assert_eq!((mixed.depth, mixed.slope), (DepthName::Cone, 1.0));
    assert_eq!(read("woo92,depth=cone,pattern=disc").compared(), Depth::Any(BiasCone::default().into()));
}

#[test]
fn biases_that_grow_with_the_slope_and_offsets_are_read() {
    let scaled = read("reeves87,depth=slope-scaled,bias=0.1t,slope-scale=2.5,clamp=3").compared();
    let wanted = SlopeScaled::default().with_constant(Bias::Texels(0.1)).with_slope(2.5).with_most(3.0);
    assert_eq!(scaled, Depth::Any(wanted.into()));
    let offset = read("burley,depth=normal-offset,bias=0,normal-offset=0.75,offset-growth=sine").compared();
    let wanted = NormalOffset::default().with_texels(0.75).with_growth(OffsetGrowth::Sine).with_bias(Bias::ZERO);
    assert_eq!(offset, Depth::Any(wanted.into()));
    assert_eq!(read("woo92,depth=godot").compared(), Depth::Engine(of_engine(EngineBias::Godot)));
    assert_eq!(refused("godot-pcf,bias=1t"), "bias = \"1t\": expected 0, with an engine's own bias as depth");
    assert_eq!(
        read("godot-pcf,depth=constant,bias=1t").compared(),
        Depth::Any(Biased::constant(Bias::Texels(1.0)).into())
    );
    let unbiased = |text: &str| text.parse::<Recipe>().unwrap().unbiased().map(|recipe| recipe.to_string());
    for (text, wanted) in [
        ("godot-pcf", Some("godot-pcf,depth=constant")),
        ("woo92,depth=normal-offset", Some("woo92,depth=normal-offset,normal-offset=0")),
        ("woo92,depth=slope-scaled,slope-scale=0", None),
        ("woo92,depth=slope-scaled,bias=1t,slope-scale=0", Some("woo92,depth=slope-scaled,slope-scale=0")),
        ("burley", Some("burley,slope=0")),
        ("woo92", None),
    ] {
        assert_eq!(unbiased(text).as_deref(), wanted, "{text}");
    }
}

#[test]
fn wm94_6_neighbourhoods_by_name() {
    for (text, wanted) in [("four", (0.0, 1.0)), ("region", (1.0, 1.0)), ("box3", (0.0, 1.5)), ("box9", (0.0, 4.5))] {
        let found = read(&format!("wang-molnar94,nearby={text}"));
        assert_eq!((found.res_factor, found.min_size), wanted, "{text}");
    }
    for text in ["box2", "box10", "box", "five"] {
        assert!(refused(&format!("wang-molnar94,nearby={text}")).starts_with("nearby = "), "{text}");
    }
}

#[test]
fn b06_every_field_is_read_and_what_contradicts_is_refused() {
    let all = "burley,min=1w,max=2%,search=16,blur=64,rotate=off,half-offset=on,rescue=on,falloff=smooth,shape=2,opacity=0.9..0.2,opacity-shape=0.5,fade=30,bias=0.1,radius=nominal";
    let found = read(all);
    let between = Softness::Between { min: MapRadius::World(1.0), max: MapRadius::Fraction(0.02) };
    assert_eq!((found.softness(), found.shape, found.rescue), (between, 2.0, true));
    assert_eq!((found.search.num_samples, found.blur.num_samples, found.blur.rotate), (16, 64, false));
    assert!(found.search.half_offset && found.blur.half_offset && !found.search.rotate);
    assert_eq!(found.opacity, Opacity::default().with_near(0.9).with_far(0.2).with_fade(30.0).with_gamma(0.5));
    let cone = BiasCone::default().with_base(0.1).with_radius(Radius::Nominal);
    assert_eq!(found.compared(), Depth::Any(cone.into()));
    let light = read("burley,light=2,nearest=5,depth=plane");
    assert_eq!(light.softness(), Softness::Light { radius: 2.0, nearest: 5.0 });
    assert_eq!(read("burley,depth=plane,nearest=5,light=2"), light, "in any order");
    assert!(refused("burley,light=2,max=3").starts_with("max = "));
    assert!(refused("burley,max=3,light=2").starts_with("max = "));
    assert!(refused("burley,min=9,max=3").starts_with("min = "));
    assert!(refused("burley,max=0.2").starts_with("min = "), "the preset's min is larger");
    assert!(refused("reeves87,sub-samples=9").starts_with("sub-samples = "));
    // Over several samples one surface has several depths.
    assert!(refused("woo92,sub-samples=2").starts_with("same = \"depth\": expected surface"));
    assert!(refused("burley,stored=midpoint,sub-samples=4,same=object").starts_with("same = \"object\""));
    assert!("woo92,sub-samples=2,same=surface".parse::<Recipe>().is_ok());
    assert!("woo92,sub-samples=1".parse::<Recipe>().is_ok());
    assert!(refused("burley,nearest=3").starts_with("nearest = "));
    assert!(refused("burley,bias=1t").starts_with("bias = "));
    assert!(refused("burley,opacity=1").starts_with("opacity = "));
    assert!(refused("woo92,ratio=0").starts_with("ratio = "));
    assert!(refused("reeves87,compare=integer").starts_with("compare = "));
    assert!("woo92,compare=integer".parse::<Recipe>().is_ok());
    assert!(refused("burley,pattern=disc").contains("fade"), "the fields that there are");
    assert_eq!("reeves87,stored=deep,epsilon=1".parse::<Recipe>().unwrap_err().field, "epsilon");
}

#[test]
fn a_preset_is_written_as_its_name_and_knows_each_field_once() {
    for preset in PresetName::ALL {
        assert_eq!(Recipe::from(preset).to_string(), preset.name());
        assert_eq!(preset.name().parse(), Ok(Recipe::from(preset)));
        assert!(preset.expects().contains(&Recipe::from(preset).stored()), "{preset:?}");
        let mut names: Vec<_> = Field::of(preset).map(|field| field.name).collect();
        let settings = preset.engine().map_or(0, |engine| engine.about().settings.len());
        assert_eq!(help(preset).lines().count(), names.len() + settings);
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), Field::of(preset).count(), "{preset:?}");
        // A default that can be written reads as itself.
        for field in Field::of(preset) {
            let Some(default) = field.default(preset).filter(|value| value != "inf") else { continue };
            let mut values = Values::of(preset);
            assert!(field.read(&mut values, &default).is_ok(), "{preset:?}, {}={default}", field.name);
            assert_eq!(values, Values::of(preset), "{preset:?}, {}={default}", field.name);
        }
    }
}

#[test]
fn toml_is_refused_by_field_and_value() {
    let refused = |text: &str| Recipe::from_toml(text).unwrap_err().to_string();
    assert!(refused("samples = 3").starts_with("recipe = \"\": expected auto, williams78"));
    assert_eq!(refused("preset = 'woo92'\nsamples = 0"), "samples = \"0\": expected a whole number from 1 to 65536");
    assert_eq!(refused("preset = 'woo92'\nbias = [1, 2]"), "bias = \"[1, 2]\": expected a text, a number or a boolean");
    assert!(refused("preset = 'woo92'\nfade = 2").starts_with("field = \"fade\": expected stored, "));
    assert!(refused("preset == 1").ends_with("expected a TOML table"));
    let ordered = Recipe::from_toml("res-factor = 2.5\nnearby = 'box3'\npreset = 'wang-molnar94'").unwrap();
    assert_eq!(ordered, "wang-molnar94,nearby=box3,res-factor=2.5".parse().unwrap(), "fields of their own last");
}

/// `src/fields.md`, which the documentation of [`Recipe`] shows, is the table as it is now.
#[test]
fn the_documented_table_is_the_table_of_fields() {
    let table = markdown();
    assert!(include_str!("../fields.md") == table, "src/fields.md is out of date; it should read:\n{table}");
}

/// Values of a kind, valid ones alone.
fn value(kind: Kind) -> BoxedStrategy<String> {
    let number = || prop_oneof![0f32..3.0, 0f32..1e9, Just(0.0), Just(1e-30), Just(0.1), Just(f32::MAX)];
    let share = || prop_oneof![0f32..=1.0, Just(0.0), Just(1.0), Just(1e-20)];
    let positive = || number().prop_map(|number| number.max(1e-30));
    let text = |number: f32| number.to_string();
    match kind {
        Kind::Words(words) => proptest::sample::select(words).prop_map(String::from).boxed(),
        Kind::Switch => proptest::sample::select(&["on", "off"][..]).prop_map(String::from).boxed(),
        Kind::Whole(most) => (1..=most).prop_map(|number| number.to_string()).boxed(),
        Kind::Number => number().prop_map(text).boxed(),
        Kind::Positive => positive().prop_map(text).boxed(),
        Kind::UpTo(most) => share().prop_map(move |share| (share * most).to_string()).boxed(),
        Kind::BelowOne => (0f32..1.0).prop_map(text).boxed(),
        Kind::Ratio => share().prop_map(|share| share.max(1e-30).to_string()).boxed(),
        Kind::Bias => (number(), "[wtsm]?").prop_map(|(number, unit)| format!("{number}{unit}")).boxed(),
        Kind::BiasRange => (number(), number(), "[wtsm]?", any::<bool>())
            .prop_map(|(a, b, unit, one)| {
                let (low, high) = (a.min(b), a.max(b));
                if one { format!("{low}{unit}") } else { format!("{low}..{high}{unit}") }
            })
            .boxed(),
        Kind::Radius => (number(), "[wt%]?").prop_map(|(number, unit)| format!("{number}{unit}")).boxed(),
        Kind::Pair => (share(), share()).prop_map(|(near, far)| format!("{near}..{far}")).boxed(),
    }
}

/// A preset with up to eight of its fields.
fn recipes() -> impl Strategy<Value = String> {
    let with_fields = |preset: PresetName| {
        let fields: Vec<&'static Field> = Field::of(preset).collect();
        let field = proptest::sample::select(fields)
            .prop_flat_map(|field| value(field.kind).prop_map(|value| format!(",{}={value}", field.name)));
        proptest::collection::vec(field, 0..8).prop_map(move |fields| preset.name().to_string() + &fields.concat())
    };
    proptest::sample::select(&PresetName::ALL[..]).prop_flat_map(with_fields)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4096))]

    #[test]
    fn what_is_written_reads_as_the_same_recipe(text in recipes()) {
        // Some fields contradict each other; no value alone is refused.
        let recipe = match text.parse::<Recipe>() {
            Ok(recipe) => recipe,
            Err(error) => {
                let contradicting = ["same", "slots", "min-samples", "compare", "bias", "spread", "min", "max", "nearest"];
                prop_assert!(contradicting.contains(&error.field.as_str()), "{}: {}", text, error);
                return Ok(());
            }
        };
        let written = recipe.to_string();
        prop_assert_eq!(written.parse::<Recipe>(), Ok(recipe), "{} as {}", &text, &written);
        prop_assert_eq!(Recipe::from_toml(&recipe.to_toml()), Ok(recipe), "{} as {}", &text, recipe.to_toml());
        // Only what differs is written.
        let fields = written.split(',').skip(1).count();
        prop_assert!(fields <= text.split(',').skip(1).count() + 2, "{} as {}", text, written);
    }
}

#[test]
fn renderman_s_parameters_are_fields() {
    let read =
        |text: &str| Recipe::from_rsl(text, 512).map(|recipe| recipe.to_string()).map_err(|error| error.to_string());
    for (text, expected) in [
        ("", "reeves87,res-factor=1"),
        ("samples=16", "reeves87,res-factor=1"),
        ("swidth=2, twidth=2, minsamples=3", "reeves87,min-samples=3,res-factor=2"),
        ("bias=0.5", "reeves87,res-factor=1,bias=0.5"),
        ("bias0=0.1,bias1=0.2", "reeves87,res-factor=1,bias=0.1..0.2"),
        ("bias1=0.2", "reeves87,res-factor=1,bias=0.2"),
        ("blur=0.125", "reeves87,res-factor=1,min-size=32"),
        ("depthfilter=\"midpoint\",midpointratio=0.25", "woo92,ratio=0.25,res-factor=1"),
    ] {
        assert_eq!(read(text).as_deref(), Ok(expected), "{text}");
    }
    for (text, expected) in [
        ("samples", "samples = \"\": expected field=value"),
        ("blurr=1", "parameter = \"blurr\": expected samples, minsamples, "),
        ("blur=-1", "blur = \"-1\": expected a finite number from 0"),
        ("blur=1,blur=2", "blur = \"2\": expected one value"),
        ("swidth=1,twidth=2", "twidth = \"2\": expected 1, as swidth"),
        ("bias=1,bias0=2", "bias = \"1\": expected none beside bias0 and bias1"),
        ("depthfilter=average", "depthfilter = \"average\": expected min or midpoint"),
        ("samples=0", "samples = \"0\": expected a whole number"),
    ] {
        let error = read(text).expect_err(text);
        assert!(error.starts_with(expected), "{text}: {error}");
    }
}
