//! Virtual samples: where they lie, what their depths are, and where there are none (WM94-7 to WM94-12, V58).

use super::{KEY, lamp, map, probed, sheet, sun};
use glam::{DVec2, DVec3, IVec2, UVec2, Vec2, Vec3};
use umbrage_depth::{DepthMap, Raw};
use umbrage_plane::{Footprint, Kind, Receiver, Sampling, SurfacePoint, TexelRect, View};
use umbrage_shadow::as_printed::{Division, percent_illumination};
use umbrage_shadow::{Conditional, OnPlane, VirtualWhen, presets};

/// A random plane through a random point under the light, its normal of |cosine| `least..most`; unrounded, and as a rounded surface point gives it.
pub(super) fn random_plane(view: &View, i: u32, least: f64, most: f64) -> Option<(Receiver, Receiver)> {
    let draw = |dim| f64::from(KEY.unit(i, dim));
    let at = DVec2::new(draw(0), draw(1)) * view.size().as_dvec2();
    let zeta = 4.0 + 26.0 * draw(2);
    let world = view.world_at(at, view.key(zeta));
    let signed = |dim| f64::from(KEY.signed(i, dim));
    // Near a given cosine, so that steep ones are met as often as flat ones.
    let toward = view.toward_eye(world);
    let across = DVec3::new(signed(3), signed(4), signed(5)).cross(toward).try_normalize()?;
    let cosine = least + (most - least) * draw(6);
    let normal = toward * cosine + across * (1.0 - cosine * cosine).sqrt();
    let rounded = view.receiver(&SurfacePoint::at(world.as_vec3(), normal.as_vec3())).ok()?;
    let eye = view.world_to_eye().transform_point3(world);
    let normal = view.world_to_eye().transform_vector3(normal);
    Some((Receiver { eye, normal, depth: view.depth(eye), ..rounded }, rounded))
}

#[test]
fn wm94_7_t_11_virtual_samples_lie_where_the_map_was_sampled() {
    let view = lamp(64).with_sampling(Sampling::Jittered { seed: 3 });
    let nearest = presets::wang_molnar94().filter;
    let around = nearest.with_min_size(1.5);
    let (mut four, mut nine, mut elsewhere, mut asked) = (0, 0, 0, 0);
    for i in 0..400 {
        let Some((exact, receiver)) = random_plane(&view, i, 0.2, 0.9) else { continue };
        let stored = sheet(&view, &exact);
        let (fraction, counters) = probed(&around, &stored, &receiver);
        nine += u32::from(fraction > 0.0);
        asked += counters.virtual_sampled;
        // The same numbers taken for samples at centres.
        let centred = Raw::new(view.with_sampling(Sampling::Centre), stored.depths().to_vec()).unwrap();
        elsewhere += u32::from(probed(&around, &centred, &receiver).0 > 0.0);
        // The samples of the nearest four texels need not surround the point: then all of the sheet's may be nearer, and no plane is compared.
        let (fraction, counters) = probed(&nearest, &stored, &receiver);
        assert!(fraction == 0.0 || (fraction == 1.0 && counters.virtual_sampled == 0), "{i}: {fraction}");
        four += u32::from(fraction > 0.0);
    }
    println!("dark: {nine} by nine texels, {four} by four, {elsewhere} with samples taken for centred; {asked} asked");
    assert!(asked > 300, "{asked}");
    assert_eq!(nine, 0, "of {asked}");
    assert!(elsewhere > 100, "{elsewhere}");
    assert!((1..40).contains(&four), "{four}");
}

#[test]
fn v36_wm94_8_wm94_9_forward_differences_are_direct_evaluation() {
    let view = lamp(64).with_kind(Kind::Screen);
    let point = SurfacePoint::at(Vec3::new(2.0, 1.0, -3.0), Vec3::new(0.2, 1.0, 0.3).normalize());
    let plane = view.receiver(&point).unwrap().plane(&view);
    assert!((plane.key.dx - 0.000_664_540_14).abs() < 1e-9 && (plane.key.dy - 0.000_996_810_21).abs() < 1e-9);
    for (column, row, wanted) in
        [(38, 20, 0.896_630_781_5f64), (39, 20, 0.897_295_321_6), (39, 21, 0.898_292_131_8), (47, 21, 0.903_608_453_0)]
    {
        let found = f64::from(plane.at(view.sampling().position(IVec2::new(column, row))));
        assert!((found - wanted).abs() < 1e-7, "({column}, {row}): {found}");
    }
    // One evaluation and additions in f32 over a window of 16 × 16, row by row.
    let start = IVec2::new(32, 16);
    let mut worst = 0f32;
    let mut first = plane.at(view.sampling().position(start));
    for row in 0..16 {
        let mut depth = first;
        for column in 0..16 {
            let direct = plane.at(view.sampling().position(start + IVec2::new(column, row)));
            worst = worst.max((depth - direct).abs());
            depth += plane.key.dx as f32;
        }
        first += plane.key.dy as f32;
    }
    assert!(worst <= 1e-6, "{worst:e}");
}

/// The largest deviation of z_s over the nearest four texels: of the listing's own arithmetic in f32 from f64, and of our samples of
/// a rounded surface point from the exact plane.
fn deviations(view: &View, least: f64, most: f64) -> (f64, f64) {
    let (mut listing, mut ours) = (0f64, 0f64);
    for i in 0..20_000 {
        let Some((exact, rounded)) = random_plane(view, i, least, most) else { continue };
        let plane = exact.plane(view);
        let f32s = view.world_to_screen().inverse().transpose().as_mat4();
        let world = view.world_to_eye().inverse();
        let normal = world.transform_vector3(exact.normal).as_vec3();
        let tangent = normal.extend(-normal.dot(world.transform_point3(exact.eye).as_vec3()));
        let t = f32s * tangent;
        for texel in TexelRect::around(exact.footprint.centre - 0.5, Vec2::splat(0.5)).texels() {
            let at = view.sampling().position(texel);
            let direct = plane.key.at(at);
            // Beyond the horizon no depth exists to deviate from; and nothing is compared far outside the range.
            if !(0.0..=1.0).contains(&direct) {
                continue;
            }
            let size = view.size().as_vec2();
            let (x, y) = (2.0 * at.x as f32 / size.x - 1.0, 1.0 - 2.0 * at.y as f32 / size.y);
            let single = -(t.x * x + t.y * y + t.w) / t.z;
            listing = listing.max((f64::from(single) - direct).abs());
            ours = ours.max((f64::from(rounded.plane(view).at(at)) - direct).abs());
        }
    }
    (listing, ours)
}

#[test]
fn v58_virtual_depths_in_f32_against_f64() {
    // The second is V43's light.
    let sun =
        View::orthographic(DVec3::Y * 30.0, DVec3::ZERO, DVec3::NEG_Z, 20.0, 0.0, 50.0, UVec2::splat(64)).unwrap();
    for (name, view) in [("perspective", lamp(64)), ("orthographic", sun)] {
        let view = view.with_kind(Kind::Screen);
        let (listing, ours) = deviations(&view, 0.1, 1.0);
        let (steep_listing, steep_ours) = deviations(&view, 0.002, 0.1);
        println!("{name}: |N·L| ≥ .1 {listing:.2e} {ours:.2e}; below {steep_listing:.2e} {steep_ours:.2e}");
        assert!(listing <= 9e-7 && ours <= 9e-7, "{name}: {listing:e} {ours:e}");
        assert!(steep_listing <= 2.1e-4 && steep_ours <= 2.1e-4, "{name}: {steep_listing:e} {steep_ours:e}");
    }
}

fn always() -> Conditional {
    presets::wang_molnar94().filter.with_when(VirtualWhen::Always)
}

#[test]
fn v41_wm94_10_edge_on_planes_fall_back_and_horizons_are_infinitely_far_d_5() {
    let view = lamp(64);
    let half_dark = map(&view, |texel| if texel.x < 32 { 5.0 } else { f32::INFINITY });
    // x = 0 contains the light: plain comparison, whatever is set.
    let point = SurfacePoint::at(Vec3::new(0.0, 1.0, -3.0), Vec3::X);
    let edge_on = view.receiver(&point).unwrap();
    assert!(edge_on.facing.abs() < 1e-6);
    let (fraction, counters) = probed(&always(), &half_dark, &edge_on);
    assert_eq!((fraction, counters.virtual_sampled), (0.5, 0));
    // Its threshold is a parameter.
    let steep =
        view.receiver(&SurfacePoint::at(Vec3::new(1.0, 1.0, -3.0), Vec3::new(0.995, 0.1, 0.0).normalize())).unwrap();
    for min_cos in [0.5 * steep.facing.abs(), 2.0 * steep.facing.abs()] {
        let (_, counters) = probed(&always().with_min_cos(min_cos), &half_dark, &steep);
        assert_eq!(counters.virtual_sampled == 1, min_cos < steep.facing.abs());
    }
    // The plane of V41 has its horizon at x_n = .2 of the map: beyond it lies behind everything that is stored, in front of nothing.
    let wall =
        view.receiver(&SurfacePoint::at(Vec3::new(-2.0, 0.0, 0.0), Vec3::new(1.0, 0.05, 0.0).normalize())).unwrap();
    let plane = wall.plane(&view);
    let at = |x_n: f64| plane.at(DVec2::new((x_n + 1.0) * 32.0, 32.0));
    let near = |found: f32, wanted: f64| (f64::from(found) * wanted - 1.0).abs() < 1e-5;
    assert!(near(at(-0.5), 0.22) && near(at(0.0), 0.02), "{} {}", at(-0.5), at(0.0));
    assert_eq!(at(0.5), f32::INFINITY);
    let beyond = Vec2::new(48.0, 32.0);
    let past = Receiver { footprint: Footprint::point(beyond), texel: beyond.as_dvec2(), ..wall };
    for (stored, wanted) in [(99.0, 1.0), (f32::INFINITY, 0.0)] {
        assert_eq!(probed(&always(), &map(&view, |_| stored), &past).0, wanted, "{stored}");
    }
    // A reach keeps the plane near the receiver: 10 ± 1.
    let plane = presets::wang_molnar94().filter.plane.with_reach(1.0);
    for (stored, wanted) in [(10.5, 1.0), (11.5, 0.0)] {
        assert_eq!(probed(&always().with_plane(plane), &map(&view, |_| stored), &past).0, wanted, "{stored}");
    }
}

/// Of planes that are their own second surface: how many are tested, virtual samples taken, darkened by default, without slack, and as printed.
fn sheets(view: &View) -> [u32; 5] {
    let mut found = [0; 5];
    for i in 0..3000 {
        let Some((exact, receiver)) = random_plane(view, i, 0.05, 1.0) else { continue };
        let stored = sheet(view, &exact);
        let strictly = presets::wang_molnar94().filter.with_plane(OnPlane::default());
        let (fraction, counters) = probed(&presets::wang_molnar94().filter, &stored, &receiver);
        let nearby: Vec<IVec2> =
            TexelRect::around(receiver.footprint.centre - 0.5, Vec2::splat(0.5)).texels().take(4).collect();
        let second: Vec<f32> = nearby.iter().map(|&texel| stored.depth(texel)).collect();
        let samples: Vec<f32> =
            nearby.iter().map(|&texel| receiver.plane(view).at(view.sampling().position(texel))).collect();
        let printed = percent_illumination(receiver.depth, &second, &samples, Division::Float);
        for (count, more) in found.iter_mut().zip([
            true,
            counters.virtual_sampled == 1,
            fraction > 0.0,
            probed(&strictly, &stored, &receiver).0 > 0.0,
            printed < 1.0,
        ]) {
            *count += u32::from(more);
        }
    }
    found
}

#[test]
fn wm94_12_t_10_planar_sheets_are_their_own_second_surface() {
    for (name, view) in [("perspective", lamp(64)), ("orthographic", sun(64))] {
        for kind in [Kind::Axial, Kind::Screen] {
            let [all, asked, dark, strict, printed] = sheets(&view.with_kind(kind));
            println!(
                "{name} {kind:?}: of {all} sheets {asked} asked, {dark} dark, {strict} without slack, {printed} as printed"
            );
            assert!(all > 2000 && asked > all / 2, "{name} {kind:?}: {all} {asked}");
            assert_eq!(dark, 0, "{name} {kind:?}");
            assert!(strict > 0, "{name} {kind:?}");
            assert!(printed > strict && printed > all / 2, "{name} {kind:?}: {printed}");
        }
    }
}
