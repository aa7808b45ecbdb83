//! What a recipe bakes, and over which maps it may be put.

use glam::{DVec3, IVec2, UVec2, Vec3};
use umbrage_bake::{Caster, MaskPlace};
use umbrage_depth::{DepthMap, Map, Raw, Storage, Stored};
use umbrage_plane::{SpotView, SurfacePoint, View};
use umbrage_raster::Triangle;
use umbrage_recipe::{Keeps, LightShadow, LightUse, PresetName, Recipe};
use umbrage_sample::Key;
use umbrage_shadow::Shadow;

fn lamp() -> View {
    View::orthographic(DVec3::Z * 20.0, DVec3::ZERO, DVec3::Y, 8.0, 1.0, 40.0, UVec2::splat(64)).unwrap()
}

/// A board above a floor: both closed enough to have a second surface under each texel of the board.
fn boards() -> Vec<Triangle> {
    let level = |height: f32, half: f32, object: u32, up: bool| {
        let [a, b, c, d] =
            [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| Vec3::new(x, y, height));
        let faces = if up { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
        faces.map(|corners| Triangle::new(corners, object, false))
    };
    let levels =
        [level(5.0, 3.0, 0, true), level(4.0, 3.0, 0, false), level(0.0, 8.0, 1, true), level(-1.0, 8.0, 1, false)];
    levels.concat()
}

fn recipe(text: &str) -> Recipe {
    text.parse().unwrap()
}

fn at(shadow: &dyn Shadow, x: f32, height: f32) -> f32 {
    shadow.fraction(&SurfacePoint::at(Vec3::new(x, 0.1, height), Vec3::Z), Key::new(0, 0, 0))
}

#[test]
fn every_preset_bakes_the_map_it_expects_and_shadows_by_it() {
    for preset in PresetName::ALL {
        let recipe = Recipe::from(preset);
        let map = recipe.bake(&lamp(), boards());
        assert!(recipe.expects().contains(&map.stored()), "{preset:?}");
        for storage in [Storage::Raw, Storage::Bbox, Storage::Tiled] {
            let shadow = recipe.bind(map.clone(), storage).unwrap();
            let (under, beside) = (at(&*shadow, 0.1, 0.0), at(&*shadow, 6.1, 0.0));
            // What three.js keeps in 16 bits is off by up to 2⁻¹³ of the range between a quarter and a half of it: the floor shadows itself by what
            // the inequality says of that, 1 − (1e-7/(1e-7 + 2⁻²⁶) − 0.3)/0.65.
            let rounding = if preset == PresetName::ThreeVsm { 0.1227 } else { 0.0 };
            assert!(under == 1.0 && (0.0..=rounding).contains(&beside), "{preset:?}: {under} and {beside}");
        }
    }
}

/// All of a light by a recipe, over the boards at rest.
fn light(text: &str, views: &[View], with: &LightUse<'_>) -> Result<LightShadow, String> {
    recipe(text).shadow_of(views, with, |_, _| boards()).map_err(|error| error.to_string())
}

#[test]
fn a_light_with_a_size_has_a_map_for_each_of_its_points() {
    let none = LightUse::default();
    let sized = light("auto,light=0.5,maps=9", &[lamp()], &none).unwrap();
    assert_eq!(sized.maps.iter().filter(|map| map.keeps == Keeps::Facets).count(), 9);
    assert!(sized.to_string().starts_with("9 maps of facets, "), "{sized}");
    assert_eq!(light("burley,light=0.5", &[lamp()], &none).unwrap().maps.len(), 1);
    // Well under the board, well beside it, and where the lamp's middle is just hidden.
    let shadow = &*sized.shadow;
    assert_eq!((at(shadow, 0.1, 0.0), at(shadow, 6.1, 0.0)), (1.0, 0.0));
    let row: Vec<f32> = (0..200).map(|i| at(shadow, 2.0 + i as f32 * 0.03, 0.0)).collect();
    assert!(row.windows(2).all(|pair| pair[1] <= pair[0] + 1e-6), "lighter toward the side");
    let levels = row.iter().filter(|dark| **dark > 0.0 && **dark < 1.0).count();
    assert!(levels > 3, "a penumbra: {row:?}");
    let one = recipe("auto,light=0.5").bake(&lamp(), boards());
    let refused = recipe("auto,light=0.5").bind(one, Storage::Tiled).err().map(|error| error.to_string());
    assert!(refused.unwrap().starts_with("light = \"0.5\": expected none over one map"));
    let hard = light("auto", &[lamp()], &none).unwrap();
    assert_eq!((at(&*hard.shadow, 0.1, 0.0), hard.maps.len(), hard.maps[0].view), (1.0, 1, lamp()));
}

#[test]
fn a_light_has_as_many_points_as_its_penumbra_is_wide() {
    // The board is 5 above the floor, and a texel a quarter wide: the penumbra of a tangent r is 40 r texels.
    let count =
        |radius: f32| light(&format!("auto,light={radius}"), &[lamp()], &LightUse::default()).unwrap().maps.len();
    assert_eq!([0.001, 0.5, 1.2, 3.0, 90.0].map(count), [16, 32, 64, 64, 64]);
    // Where only the board itself is looked at, there is none.
    let board = [DVec3::new(0.0, 0.0, 5.0)];
    let with = LightUse { receivers: Some(&board), ..LightUse::default() };
    assert_eq!(light("auto,light=3", &[lamp()], &with).unwrap().maps.len(), 16);
}

#[test]
fn a_fitted_window_needs_to_know_what_will_be_asked() {
    let refused = light("woo92,window=fitted", &[lamp()], &LightUse::default()).unwrap_err();
    assert_eq!(refused, "window = \"fitted\": expected given, where it is not known which points will be looked up");
    let points = [(2.0, -1.0), (4.0, -1.0), (4.0, 1.0), (2.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
    let with = LightUse { receivers: Some(&points), ..LightUse::default() };
    for text in ["auto,window=fitted", "woo92,window=fitted", "auto,window=fitted,light=0.1,maps=3"] {
        let fitted = light(text, &[lamp()], &with).unwrap();
        assert_eq!((at(&*fitted.shadow, 2.5, 0.0), at(&*fitted.shadow, 3.8, 0.0)), (1.0, 0.0), "{text}");
        for map in &fitted.maps {
            assert!(map.view.texel_world(1.0).max_element() < 0.06, "{text}: {}", map.view.texel_world(1.0));
        }
    }
}

#[test]
fn of_several_moments_a_light_is_the_mean() {
    let moved = |_: &View, moment: u32| -> Vec<Triangle> {
        let by = DVec3::X * (f64::from(moment) * 1.0);
        boards().into_iter().map(|one| Triangle { corners: one.corners.map(|at| at + by), ..one }).collect()
    };
    let with = LightUse { moments: 4, ..LightUse::default() };
    let light = recipe("auto").shadow_of(&[lamp()], &with, moved).unwrap();
    // The board's right side stands at 3, 4, 5 and 6.
    let row = [2.5, 3.5, 4.5, 5.5, 6.5].map(|x| at(&*light.shadow, x, 0.0));
    assert_eq!((row, light.maps.len()), ([1.0, 0.75, 0.5, 0.25, 0.0], 4));
}

#[test]
fn casters_that_let_light_pass_are_kept_in_a_map_of_their_own() {
    let glass = |_: &View, _: u32| {
        let caster = |triangle: Triangle| {
            let clear = if triangle.object == 0 { Vec3::new(0.5, 0.25, 0.0) } else { Vec3::ZERO };
            Caster::from(triangle).with_passes(clear)
        };
        boards().into_iter().map(caster).collect::<Vec<_>>()
    };
    let light = recipe("auto").shadow_of(&[lamp()], &LightUse::default(), glass).unwrap();
    assert_eq!(light.maps.iter().map(|map| map.keeps).collect::<Vec<_>>(), [Keeps::Facets, Keeps::Deep]);
    assert!(light.to_string().starts_with("1 map of facets, 1 map of all surfaces, for casters that let light pass, "));
    let point =
        [SurfacePoint::at(Vec3::new(0.1, 0.1, 0.0), Vec3::Z), SurfacePoint::at(Vec3::new(5.1, 0.1, 0.0), Vec3::Z)];
    let (mut dark, mut passes) = ([0.0; 2], [Vec3::ONE; 2]);
    light.shadow.fractions(&point, Key::new(0, 0, 0), &mut dark);
    light.shadow.transmittances(&point, Key::new(0, 0, 0), &dark, &mut passes);
    // Two faces of the board, one after the other.
    assert!(passes[0].abs_diff_eq(Vec3::new(0.25, 0.0625, 0.0), 0.02), "{}", passes[0]);
    assert_eq!((passes[1], dark[1]), (Vec3::ONE, 0.0));
    // Every triangle is counted once, and masks are evaluated for the triangles that they belong to.
    assert_eq!((light.stats.given, light.stats.zero_area), (8, 0));
    let floor = |at: &MaskPlace| {
        assert!((4..8).contains(&at.triangle) && at.object == 1, "{at:?}");
        true
    };
    let masked = |view: &View, moment: u32| {
        glass(view, moment)
            .into_iter()
            .map(|one| if one.triangle.object == 1 { one.with_mask(&floor) } else { one })
            .collect::<Vec<_>>()
    };
    let same = recipe("auto").shadow_of(&[lamp()], &LightUse::default(), masked).unwrap();
    assert_eq!(at(&*same.shadow, 5.1, -2.0), 1.0);
    // Under the floor, which is opaque.
    assert_eq!(at(&*light.shadow, 5.1, -2.0), 1.0);
}

#[test]
fn a_wide_spot_has_several_maps_that_are_one_light() {
    // 150 degrees, straight down from 2 over a plane.
    let spot = View::spot(SpotView {
        eye: DVec3::Z * 2.0,
        target: DVec3::ZERO,
        full_angle_radians: 150f64.to_radians(),
        near: 0.1,
        far: 100.0,
        size: UVec2::splat(128),
        ..SpotView::default()
    })
    .unwrap();
    // The same as wide as can be, although no one map could hold it.
    let half_space = spot.with_cone(Some(0.0)).unwrap();
    let pole = |_: &View, _: u32| -> Vec<Triangle> {
        let corner = |x: f32, z: f32| Vec3::new(3.0, x, z);
        [
            [corner(-0.5, 0.0), corner(0.5, 0.0), corner(0.5, 1.0)],
            [corner(-0.5, 0.0), corner(0.5, 1.0), corner(-0.5, 1.0)],
        ]
        .map(|corners| Triangle::new(corners, 0, true))
        .to_vec()
    };
    for (view, reach) in [(spot, 2.0 * 75f64.to_radians().tan()), (half_space, f64::INFINITY)] {
        let light = recipe("auto").shadow_of(&[view], &LightUse::default(), pole).unwrap();
        assert_eq!(light.maps.len(), 5);
        let texels: u32 = light.maps.iter().map(|map| map.view.size().element_product()).sum();
        assert!(texels.abs_diff(128 * 128) < 128 * 4, "{texels}");
        // The pole's shadow goes from 3 to 6; the cone's rim is where its reach is.
        for (x, want) in
            [(0.5f32, 0.0), (2.9, 0.0), (3.1, 1.0), (5.8, 1.0), (6.2, 0.0), (7.3, 0.0), (7.6, 0.0), (40.0, 0.0)]
        {
            let want = if f64::from(x) > reach { 1.0 } else { want };
            let found = light.shadow.fraction(&SurfacePoint::at(Vec3::new(x, 0.1, 0.0), Vec3::Z), Key::new(0, 0, 0));
            assert_eq!(found, want, "at {x} of a cone that reaches {reach}");
        }
        if reach.is_finite() {
            // Half of it beyond the rim.
            let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
            let corners = corners.map(|(x, y)| DVec3::new(reach + x, y, 0.0));
            let rim = SurfacePoint::at(DVec3::X * reach, Vec3::Z).with_corners(corners);
            let found = light.shadow.fraction(&rim, Key::new(0, 0, 0));
            assert!((found - 0.5).abs() < 0.1, "{found} at the rim");
        }
        let above = SurfacePoint::at(Vec3::new(1.0, 0.0, 2.5), Vec3::NEG_Z);
        assert_eq!(light.shadow.fraction(&above, Key::new(0, 0, 0)), 1.0, "behind it nothing is lit");
    }
    for recipe in ["auto", "woo92"] {
        assert_eq!(light(recipe, &[spot, spot], &LightUse::default()).unwrap().maps.len(), 2);
        assert!(light(recipe, &[], &LightUse::default()).unwrap_err().starts_with("views = \"none\""));
        assert!(light(recipe, &[lamp(), lamp()], &LightUse::default()).unwrap_err().contains("is not in perspective"));
    }
}

#[test]
fn what_is_baked_records_the_surface_that_stored_names() {
    let of = |text: &str| recipe(text).bake(&lamp(), boards()).stored();
    assert_eq!(of("burley,stored=second"), Stored::Second);
    assert_eq!(of("burley,stored=back-face"), Stored::BackFace);
    assert_eq!(of("burley,stored=normals"), Stored::BackFace);
    assert_eq!(of("burley,stored=midpoint,sub-samples=2,same=surface"), Stored::Midpoint);
    assert_eq!(of("burley,stored=deep"), Stored::First);
    assert_eq!(recipe("woo92").bake_moments(&lamp(), [boards(), boards()]).stored(), Stored::Midpoint);
    let none: [Vec<Triangle>; 0] = [];
    let empty = recipe("woo92").bake_moments(&lamp(), none);
    assert_eq!((empty.stored(), empty.bytes()), (Stored::Midpoint, 0));
}

#[test]
fn recipes_of_one_pass_1_bake_one_map() {
    let presets = PresetName::ALL.map(|preset| preset.name().to_owned());
    let stored = ["first", "second", "back-face", "midpoint", "deep", "normals"];
    let stored = stored.map(|stored| format!("burley,stored={stored}"));
    let finer =
        ["auto,fine=2,slots=4", "auto,fine=1", "woo92,same=surface,sub-samples=2", "burley,stored=deep,epsilon=0.1"];
    let texts = presets.into_iter().chain(stored).chain(finer.map(str::to_owned));
    let made: Vec<(String, Recipe, Vec<f32>, usize)> = texts
        .map(|text| {
            let recipe = recipe(&text);
            let [own, same] = [recipe, recipe.pass_1()].map(|recipe| recipe.bake(&lamp(), boards()));
            let [own, same] = [own, same].map(|map| {
                let texels = (0..64 * 64).map(|i| map.depth(IVec2::new(i % 64, i / 64)));
                (texels.collect::<Vec<f32>>(), map.allocated())
            });
            assert_eq!(own, same, "{text}");
            (text, recipe.pass_1(), own.0, own.1)
        })
        .collect();
    for (text, pass_1, ..) in &made {
        assert_eq!(*pass_1, pass_1.pass_1(), "{text}");
    }
    // One preset alone compares each of these, all the others nearest surfaces.
    let of = |name: &str| made.iter().find(|(text, ..)| text == name).map(|(_, pass_1, ..)| *pass_1);
    for (text, like) in [("burley", "reeves87"), ("vsm", "reeves87"), ("burley,stored=midpoint", "woo92")] {
        assert_eq!(of(text), of(like), "{text}");
    }
    for text in ["auto", "auto,fine=2,slots=4", "woo92", "burley,stored=second", "burley,stored=deep"] {
        assert_ne!(of(text), of("reeves87"), "{text}");
    }
}

#[test]
fn a_preset_over_another_surface_is_refused_unless_it_is_meant() {
    let first = recipe("reeves87").bake(&lamp(), boards());
    let refused = |text: &str, map: &Map| recipe(text).bind(map, Storage::Tiled).err().map(|error| error.to_string());
    let error = refused("woo92", &first).unwrap();
    assert!(error.starts_with("map = \"first\": expected midpoint, as woo92 needs it"), "{error}");
    assert!(refused("wang-molnar94", &first).unwrap().contains("expected back-face or second, as wang-molnar94"));
    assert_eq!(refused("woo92,stored=first", &first), None);
    let error = refused("auto", &first).unwrap();
    assert!(error.starts_with("map = \"first\": expected a map of facets, as auto bakes it"), "{error}");
    assert_eq!(refused("reeves87", &recipe("auto").bake(&lamp(), boards())), None, "facets are nearest surfaces");
    let midpoints = recipe("woo92").bake(&lamp(), boards());
    assert!(refused("reeves87", &midpoints).unwrap().contains("\"midpoint\""));
    assert_eq!(refused("reeves87,stored=midpoint", &midpoints), None);
    assert!(refused("woo92,stored=first", &midpoints).unwrap().contains("as the recipe's stored= needs it"));
    let second = recipe("burley,stored=second").bake(&lamp(), boards());
    assert_eq!(refused("wang-molnar94", &second), None, "the paper finds them either way");
    // The caller may say so instead.
    let mixed = recipe("woo92").bind_any(&first, Storage::Tiled);
    assert_eq!(at(&*mixed, 0.1, 0.0), 1.0);
    // Maps that are made by hand record first surfaces.
    let raw = Raw::new(lamp(), vec![5.0; 64 * 64]).unwrap();
    assert!(recipe("woo92").bind(raw.clone(), Storage::Raw).is_err());
    assert!(recipe("reeves87").bind(raw, Storage::Raw).is_ok());
}

#[test]
fn deep_recipes_take_opacity_and_colour_and_normals_take_normals() {
    let tinted = boards().into_iter().map(|triangle| {
        let caster = Caster::from(triangle);
        if triangle.object == 0 { caster.with_opacity(0.5) } else { caster }
    });
    let deep = recipe("reeves87,stored=deep,epsilon=0,bias=0.1");
    let shadow = deep.bind(deep.bake(&lamp(), tinted), Storage::Tiled).unwrap();
    assert!((at(&*shadow, 0.1, 0.0) - 0.75).abs() < 1e-6, "two surfaces that each stop half");
    let by_normals = recipe("wang-molnar94,stored=normals");
    let turned = boards().into_iter().map(|triangle| Caster::from(triangle).with_normals([Vec3::NEG_Z; 3]));
    let map = by_normals.bake(&lamp(), turned);
    assert_eq!(map.depth(IVec2::splat(32)), 15.0, "all face away, so that the nearest counts");
}

/// The board's right half is cut out, whatever is stored: the texel there sees what it would see without the board.
#[test]
fn every_recipe_sees_through_what_a_mask_leaves_out() {
    let boards = boards();
    let mask = |at: &MaskPlace| {
        let [a, b, c] = boards[at.triangle as usize].corners;
        a.x * at.weights.x + b.x * at.weights.y + c.x * at.weights.z < 0.0
    };
    let of = |masked: bool| {
        boards.iter().map(move |triangle| (triangle, masked && triangle.object == 0)).map(|(triangle, masked)| {
            let caster = Caster::from(*triangle);
            if masked { caster.with_mask(&mask) } else { caster }
        })
    };
    let bare = || boards.iter().filter(|triangle| triangle.object == 1).copied();
    let presets = PresetName::ALL.map(|preset| preset.name().to_owned());
    let stored = ["first", "second", "back-face", "midpoint", "deep", "normals"]
        .map(|stored| format!("reeves87,stored={stored}"));
    let finer = ["woo92,same=surface,sub-samples=2", "reeves87,stored=deep,sub-samples=2"].map(str::to_owned);
    for text in presets.iter().chain(&stored).chain(&finer) {
        let recipe = recipe(text);
        let [masked, whole] = [true, false].map(|masked| recipe.bake(&lamp(), of(masked)));
        let without = recipe.bake(&lamp(), bare());
        let [left, right] = [25, 38].map(|x| IVec2::new(x, 32));
        assert_eq!((masked.depth(left), masked.depth(right)), (whole.depth(left), without.depth(right)), "{text}");
        assert_ne!(whole.depth(right), without.depth(right), "{text}");
    }
}

#[test]
fn what_became_of_the_triangles_reaches_the_caller() {
    // A lamp in a closed shell whose walls are nearer than 1/1024 of the near distance below the lamp, a triangle without
    // area, one that is not finite, one far aside.
    let lamp = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 2.0, 10.0, 100.0, UVec2::splat(64)).unwrap();
    let triangle = |corners: [[f32; 3]; 3]| Triangle::new(corners.map(Vec3::from), 0, false);
    let shell = triangle([[-1.0, -0.001, -0.005], [1.0, -0.001, -0.005], [0.0, -0.001, -40.0]]);
    let flat = triangle([[0.0, 0.0, -20.0]; 3]);
    let broken = triangle([[f32::NAN, 0.0, -20.0], [1.0, 0.0, -20.0], [0.0, 1.0, -20.0]]);
    let aside = triangle([[500.0, 0.0, -20.0], [501.0, 0.0, -20.0], [500.0, 1.0, -20.0]]);
    let whole = triangle([[-5.0, -5.0, -20.0], [5.0, -5.0, -20.0], [0.0, 5.0, -20.0]]);
    for text in ["reeves87", "woo92", "wang-molnar94,stored=second", "burley,stored=deep", "burley,stored=normals"] {
        let moment = [shell, flat, broken, aside, whole];
        let (map, stats) = recipe(text).bake_counted(&lamp, [moment]);
        assert_eq!((stats.given, stats.not_finite, stats.zero_area, stats.outside), (5, 1, 1, 1), "{text}: {stats}");
        assert_eq!((stats.kept(), stats.too_near, stats.before_near), (2, 1, 1), "{text}: {stats}");
        assert_eq!(map.view(), &lamp, "{text}");
        let twice = recipe(text).bake_counted(&lamp, [moment, moment]).1;
        assert_eq!((twice.given, twice.too_near), (10, 2), "{text}: every moment counts");
        let line = stats.to_string();
        assert!(
            line.starts_with("5 triangles, 2 drawn; 1 skipped") && line.ends_with("bring the near plane nearer"),
            "{line}"
        );
    }
}
