//! Maps of several surfaces a texel, through every filter that compares (B06-11, V56, T-19).

use glam::{DVec3, IVec2, UVec2, Vec2, Vec3};
use std::borrow::Cow;
use umbrage_depth::{DepthMap, Step, Translucent};
use umbrage_plane::{Bias, DepthRange, Footprint, Kind, Receiver, Rules, SurfacePoint, TexelRect, View, cube_views};
use umbrage_sample::{Centre, EveryTexel, Key};
use umbrage_shadow::{
    Around, Biased, Counters, Filter, IntegerFirst, MapRadius, OnPlane, Pcf, Shadow, ShadowMap, Softness, VirtualWhen,
    presets,
};

const KEY: Key = Key::new(56, 0, 0);

/// The same surfaces in every texel of a part of a map, nearest first: depth and what each stops of red, green and blue.
#[derive(Clone, Debug)]
struct Layers {
    view: View,
    from_column: i32,
    surfaces: Vec<(f32, [f32; 3])>,
    coloured: bool,
}

impl DepthMap for Layers {
    fn view(&self) -> &View {
        &self.view
    }

    fn depth(&self, texel: IVec2) -> f32 {
        let inside = TexelRect::of_size(self.view.size()).contains(texel) && texel.x >= self.from_column;
        if inside { self.surfaces.first().map_or(f32::INFINITY, |(depth, _)| *depth) } else { f32::INFINITY }
    }

    /// Of opaque surfaces this would be a range to cull by: a filter that did would be wrong.
    fn range(&self, _rect: TexelRect) -> DepthRange {
        DepthRange { min: self.surfaces[0].0, max: self.surfaces[0].0 }
    }

    fn translucent(&self) -> Option<&dyn Translucent> {
        Some(self)
    }

    fn bytes(&self) -> usize {
        4 * self.surfaces.len()
    }

    fn allocated(&self) -> usize {
        self.bytes()
    }
}

impl Translucent for Layers {
    fn steps(&self, texel: IVec2) -> Cow<'_, [Step]> {
        if self.depth(texel) == f32::INFINITY {
            return Cow::Borrowed(&[]);
        }
        let mut passes = Vec3::ONE;
        let step = |(depth, stops): &(f32, [f32; 3])| {
            passes *= Vec3::ONE - Vec3::from(*stops);
            Step { depth: *depth, passes }
        };
        self.surfaces.iter().map(step).collect()
    }

    fn is_grey(&self) -> bool {
        !self.coloured
    }
}

/// At the origin, looking down −y, 90° wide.
fn lamp() -> View {
    let fov = 90f64.to_radians();
    View::perspective(DVec3::ZERO, DVec3::NEG_Y, DVec3::NEG_Z, fov, 0.1, 100.0, UVec2::splat(32)).unwrap()
}

/// V56: at 2 a surface of opacity .4, at 5 an opaque one.
fn v56(from_column: i32) -> Layers {
    Layers { view: lamp(), from_column, surfaces: vec![(2.0, [0.4; 3]), (5.0, [1.0; 3])], coloured: false }
}

fn at(view: &View, depth: f32, centre: Vec2, half: f32) -> Receiver {
    let world = view.world_at(centre.as_dvec2(), view.key(f64::from(depth)));
    let seen = view.receiver(&SurfacePoint::at(world.as_vec3(), Vec3::Y)).unwrap();
    Receiver { footprint: Footprint::boxed(centre, Vec2::splat(half)), depth, ..seen }
}

fn ask<F: Filter>(filter: &F, map: &impl DepthMap, receiver: &Receiver) -> (f32, Counters) {
    let mut counters = Counters::default();
    let found = ShadowMap { filter, map }.fraction_of_probed(receiver, KEY, &mut counters);
    (found, counters)
}

fn exact() -> Biased {
    Biased::constant(Bias::ZERO)
}

#[test]
fn v56_b06_11_filters_average_what_passes_and_never_cull() {
    let map = v56(0);
    let plane = OnPlane::default();
    let narrow = Softness::Between { min: MapRadius::Texels(0.5), max: MapRadius::Texels(2.0) };
    let soft = presets::fernando(Bias::ZERO).filter.with_softness(narrow);
    for (depth, dark) in [(1.0, 0.0), (2.0, 0.0), (2.5, 0.4), (5.0, 0.4), (5f32.next_up(), 1.0), (50.0, 1.0)] {
        let receiver = at(&map.view, depth, Vec2::splat(16.3), 1.5);
        let close = |name: &str, (found, counters): (f32, Counters)| {
            assert!((found - dark).abs() < 1e-6, "{name} at {depth}: {found}, want {dark}");
            assert_eq!(counters.culled_lit + counters.culled_dark, 0, "{name}");
        };
        close("pcf", ask(&Pcf::default().with_depth(exact()), &map, &receiver));
        close(
            "every texel",
            ask(
                &Pcf::default().with_pattern(EveryTexel).with_depth(exact()).with_res_factor(1.0).with_min_size(0.0),
                &map,
                &receiver,
            ),
        );
        close("centre", ask(&presets::ordinary(Bias::ZERO).filter, &map, &receiver));
        for when in [VirtualWhen::Mixed, VirtualWhen::Always, VirtualWhen::Never] {
            close(
                "conditional",
                ask(&presets::wang_molnar94().filter.with_when(when).with_plane(plane), &map, &receiver),
            );
        }
        close("soft", ask(&soft, &map, &receiver));
    }
    // A bias moves what passes, as it moves comparisons.
    let biased = Pcf::default()
        .with_pattern(Centre)
        .with_depth(Biased::constant(Bias::World(0.5)))
        .with_res_factor(0.0)
        .with_min_size(0.0);
    for (depth, dark) in [(2.5, 0.0), (2.6, 0.4), (5.5, 0.4), (5.6, 1.0)] {
        let found = ask(&biased, &map, &at(&map.view, depth, Vec2::splat(16.3), 0.0)).0;
        assert!((found - dark).abs() < 1e-6, "{depth}: {found}");
    }
}

#[test]
fn t_19_occluders_are_found_by_the_nearest_surface_not_by_the_first_opaque_one() {
    // Burley's factor of a receiver at 10 is .8 for an occluder at 2 and .5 for one at 5: radii of 8 and of 5 texels of 10.
    let softness = Softness::Between { min: MapRadius::Texels(0.0), max: MapRadius::Texels(8.0) };
    let mut soft = presets::fernando(Bias::ZERO).filter.with_softness(softness);
    soft.search.num_samples = 1024;
    soft.blur.num_samples = 4096;
    let reaches = |columns: f32| ask(&soft, &v56(16), &at(&lamp(), 10.0, Vec2::new(16.0 - columns, 16.3), 0.0)).0;
    // 6.4 texels, not 4.
    assert!(reaches(5.5) > 0.0 && reaches(5.0) > 0.02, "{} {}", reaches(5.5), reaches(5.0));
    assert_eq!(reaches(7.0), 0.0);
    let plain = ask(&IntegerFirst::default(), &v56(0), &at(&lamp(), 3.0, Vec2::splat(16.3), 1.0)).0;
    assert!((plain - 0.4).abs() < 1e-6, "whole units first answer by what passes too: {plain}");
}

#[test]
fn c_10_places_outside_a_deep_map_answer_by_its_rules() {
    let share = |rules| {
        let map = Layers { view: lamp().with_rules(rules), ..v56(0) };
        let pcf = Pcf::default().with_pattern(EveryTexel).with_depth(exact()).with_res_factor(1.0).with_min_size(0.0);
        ask(&pcf, &map, &at(&map.view, 4.0, Vec2::new(32.0, 16.0), 2.0)).0
    };
    // Half outside, half behind the veil.
    for (rules, wanted) in [(Rules::OPEN, 0.2), (Rules::SPOT, 0.7), (Rules::AROUND, 0.2)] {
        assert!((share(rules) - wanted).abs() < 1e-6, "{}", share(rules));
    }
}

#[test]
fn b06_11_colours_reach_the_shading() {
    let stained = Layers { surfaces: vec![(2.0, [0.1, 0.6, 1.0])], coloured: true, ..v56(0) };
    let points = [-1.0f32, -10.0].map(|y| SurfacePoint::at(Vec3::new(0.1, y, 0.1), Vec3::Y));
    let pass = |map: Layers, wanted: [[f32; 3]; 2]| {
        let shadow = ShadowMap { filter: Pcf::default().with_depth(exact()), map };
        let (mut fractions, mut passes) = ([f32::NAN; 2], [Vec3::NAN; 2]);
        shadow.fractions(&points, KEY, &mut fractions);
        shadow.transmittances(&points, KEY, &fractions, &mut passes);
        for (found, wanted) in passes.iter().zip(wanted) {
            assert!(found.abs_diff_eq(wanted.into(), 1e-6), "{found}, want {wanted:?}");
        }
    };
    pass(stained, [[1.0; 3], [0.9, 0.4, 0.0]]);
    pass(v56(0), [[1.0; 3], [0.0; 3]]);
}

/// A cube whose maps all hold the same surfaces, as axial depths.
fn cube(surfaces: &[(f32, [f32; 3])], coloured: bool) -> Vec<Layers> {
    let views = cube_views(DVec3::ZERO, 0.1, 100.0, 32).unwrap();
    views
        .map(|view| Layers { view: view.with_kind(Kind::Axial), from_column: 0, surfaces: surfaces.to_vec(), coloured })
        .to_vec()
}

#[test]
fn b06_11_t_16_lights_in_all_directions_forward_what_passes_across_seams() {
    let pcf = Pcf::default().with_pattern(EveryTexel).with_depth(exact()).with_res_factor(0.0).with_min_size(3.0);
    let around = Around::new(pcf, cube(&[(2.0, [0.25; 3]), (5.0, [1.0; 3])], false)).unwrap();
    // Directly at a seam, and in the middle of a face: between the veil and the wall all texels pass three quarters.
    for direction in [Vec3::new(1.0, 0.99, 0.0), Vec3::new(1.0, 0.1, 0.1), Vec3::new(0.99, 1.0, 0.98)] {
        let found = around.fraction(&SurfacePoint::at(direction * 3.5, -direction.normalize()), KEY);
        assert!((found - 0.25).abs() < 1e-6, "{direction}: {found}");
    }
    let stained = Around::new(pcf, cube(&[(2.0, [0.1, 0.6, 1.0])], true)).unwrap();
    let point = SurfacePoint::at(Vec3::new(3.5, 3.4, 0.0), Vec3::NEG_X);
    let mut passes = [Vec3::NAN];
    stained.transmittances(&[point], KEY, &[stained.fraction(&point, KEY)], &mut passes);
    assert!(passes[0].abs_diff_eq(Vec3::new(0.9, 0.4, 0.0), 1e-6), "{}", passes[0]);
    // A pane before one face alone: the other faces have no colours, and pass all light alike.
    let mut maps = cube(&[(2.0, [0.5; 3])], false);
    maps[0] = Layers { surfaces: vec![(2.0, [0.1, 0.6, 1.0])], coloured: true, ..maps[0].clone() };
    let pane = Around::new(presets::ordinary(Bias::ZERO).filter, maps).unwrap();
    for (direction, wanted) in [(Vec3::X, Vec3::new(0.9, 0.4, 0.0)), (Vec3::Y, Vec3::splat(0.5))] {
        let point = SurfacePoint::at(direction * 3.5, -direction);
        pane.transmittances(&[point], KEY, &[pane.fraction(&point, KEY)], &mut passes);
        assert!(passes[0].abs_diff_eq(wanted, 1e-6), "{direction}: {}", passes[0]);
    }
}
