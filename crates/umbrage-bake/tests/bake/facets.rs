//! Maps of facets: the depths of any other map, and what refined texels and links see, against a plain builder.

use crate::pass1::{triangles, views};
use crate::shapes::{ball, cuboid, quad};
use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use umbrage_bake::{Caster, MaskPlace, Refinement, bake, bake_facets, bake_refined};
use umbrage_depth::{BackFace, DepthMap, FacetMap, FacetRule, FacetSource, First, Second, Tiled};
use umbrage_plane::{Affine, DepthRange, TexelRect, View};
use umbrage_raster::{Cull, Triangle};

/// Every look-up of a plain facet map is that of the map that pass 1 makes of the same triangles, bit for bit.
#[test]
fn plain_facet_maps_are_what_every_other_map_is() {
    fn compare<R: FacetRule>(view: &View, rule: &R, cull: Cull) {
        let (map, facets) = (bake(view, triangles(), rule, cull), bake_facets(view, triangles(), rule, cull));
        let (map, facets) = (map.map, facets.map);
        assert_eq!(facets.stored(), map.stored());
        let mut all: Option<DepthRange> = None;
        for texel in TexelRect::new(IVec2::splat(-2), view.size().as_ivec2() + 2).texels() {
            let (a, b) = (facets.depth(texel), map.depth(texel));
            assert_eq!(a.to_bits(), b.to_bits(), "{texel} of {view:?}: {a} instead of {b}");
            let one = DepthRange { min: b, max: b };
            all = Some(all.map_or(one, |all| all.union(one)));
        }
        let (range, all) = (facets.range(TexelRect::new(IVec2::splat(-2), view.size().as_ivec2() + 2)), all.unwrap());
        assert!(range.min <= all.min && range.max >= all.max, "{range:?} encloses {all:?}");
    }
    for view in views() {
        compare(&view, &First, Cull::None);
        compare(&view, &Second, Cull::None);
        compare(&view, &BackFace, Cull::Front);
        compare(&view, &First, Cull::Front);
    }
}

#[test]
fn large_facets_take_next_to_no_room() {
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 0.9, 2.0, 60.0, UVec2::splat(512)).unwrap();
    let boxes = cuboid(Vec3::new(-3.0, -3.0, -20.0), Vec3::new(2.0, 4.0, -15.0), 0, false);
    let wall = cuboid(Vec3::new(-30.0, -30.0, -50.0), Vec3::new(30.0, 30.0, -48.0), 1, false);
    let scene = || boxes.iter().chain(&wall).copied();
    let (plain, refined) =
        (bake_facets(&view, scene(), &First, Cull::None), bake_refined(&view, scene(), &Refinement::default()));
    let raw = 4 * 512 * 512;
    assert!(plain.map.allocated() * 20 < raw, "{} bytes", plain.map.allocated());
    assert!(refined.map.allocated() * 8 < raw, "{} bytes", refined.map.allocated());
    // Where facets are as small as texels, a depth each is what is kept.
    let many = || ball(Vec3::new(0.0, 0.0, -20.0), 8.0, 400, 0).into_iter().map(|(triangle, _)| triangle);
    let (plain, tiled) = (bake_facets(&view, many(), &First, Cull::None), bake(&view, many(), &First, Cull::None));
    assert!(plain.map.allocated() <= tiled.map.allocated() * 21 / 20, "{} bytes", plain.map.allocated());
    let refined = bake_refined(&view, many(), &Refinement::default());
    assert!(refined.map.allocated() <= 512 * 512 * 11, "{} bytes", refined.map.allocated());
}

/// Random numbers from a seed.
struct Random(u64);

impl Random {
    /// Within −½..½.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    }
}

/// Ordinary triangles, slivers, one drawn twice, mirrored windings, a T-junction and one edge-on.
fn soup(seed: u64) -> Vec<Triangle> {
    let mut random = Random(2 * seed + 1);
    let mut soup = Vec::new();
    for object in 0..18 {
        let mut corner = |size: f64| DVec3::new(random.next(), random.next(), random.next()) * size;
        let middle = corner(9.0) + DVec3::NEG_Z * 20.0;
        let (a, b, c) = (middle + corner(7.0), middle + corner(7.0), middle + corner(7.0));
        let corners = match object % 6 {
            0 => [a, b, (a + b) * 0.5 + corner(0.1)],
            1 => [a, c, b],
            2 => {
                let half = (a + b) * 0.5;
                soup.push(Triangle { corners: [a, half, c], object, sheet: true });
                [half, b, c]
            }
            3 => {
                soup.push(Triangle { corners: [a, b, c], object, sheet: true });
                [a, b, c]
            }
            // Through the light: edge-on.
            4 => [a, b, (a + b) * 0.7],
            _ => [a, b, c],
        };
        soup.push(Triangle { corners, object, sheet: true });
    }
    soup.extend(quad(
        [(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)].map(|(x, y)| Vec3::new(x, y, -30.0)),
        99,
        true,
    ));
    soup
}

/// Whether anything of a triangle, of which its index is given, is at a place of the world.
type Holes = dyn Fn(usize, DVec3) -> bool + Sync;

/// A triangle on the map as nobody snapped it.
struct Seen<'a> {
    corners: [DVec2; 3],
    /// `None` where it is edge-on: then it says nothing of use at a sample.
    plane: Option<Affine>,
    /// Whether anything of it is at a place of the map; `None` where it has no holes.
    there: Option<Box<dyn Fn(DVec2) -> bool + 'a>>,
}

/// What a plain test sees at a place of the map: the nearest key, or `None` where an edge is within `margin` texels, so that snapping decides.
fn nearest(seen: &[Seen<'_>], at: DVec2, margin: f64) -> Option<f64> {
    let mut nearest = f64::INFINITY;
    for Seen { corners: [a, b, c], plane, there } in seen {
        let along = |a: DVec2, b: DVec2| {
            let (edge, from) = (b - a, at - a);
            let t = (from.dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
            (from - edge * t).length()
        };
        if along(*a, *b).min(along(*b, *c)).min(along(*c, *a)) < margin {
            return None;
        }
        let side = |a: &DVec2, b: &DVec2| (*b - *a).perp_dot(at - *a);
        let sides = [side(a, b), side(b, c), side(c, a)];
        if sides.iter().all(|side| *side > 0.0) || sides.iter().all(|side| *side < 0.0) {
            let key = plane.as_ref()?.at(at);
            if key < nearest {
                let is_there = there.as_ref().is_none_or(|there| there(at));
                // The edge of a hole is an edge too.
                let near = [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y].map(|way| at + way * margin);
                if there.as_ref().is_some_and(|there| near.iter().any(|near| there(*near) != is_there)) {
                    return None;
                }
                nearest = if is_there { key } else { nearest };
            }
        }
    }
    Some(nearest)
}

fn seen<'a>(view: &'a View, triangles: &[Triangle], there: Option<&'a Holes>) -> Vec<Seen<'a>> {
    let one = |(index, triangle): (usize, &Triangle)| {
        let eye = triangle.corners.map(|corner| view.world_to_eye().transform_point3(corner));
        let normal = (eye[1] - eye[0]).cross(eye[2] - eye[0]);
        let plane = view.affine(eye[0], normal).filter(|plane| plane.dx.abs() + plane.dy.abs() < 0.05);
        let there = plane.zip(there).map(|(plane, there)| -> Box<dyn Fn(DVec2) -> bool> {
            Box::new(move |at: DVec2| there(index, view.world_at(at, plane.at(at))))
        });
        Seen { corners: eye.map(|at| view.eye_to_texel(at)), plane, there }
    };
    triangles.iter().enumerate().map(one).collect()
}

#[test]
fn refined_texels_see_what_a_plain_test_of_each_sample_sees() {
    let [asked, refined, links] = check_refined(None);
    assert!(asked > 30_000 && refined > 5000 && links > 500, "{asked} samples, {refined} refined, {links} links");
}

/// Two triangles of three have holes: where the world is striped.
#[test]
fn refined_texels_see_through_holes_what_a_plain_test_of_each_sample_sees() {
    let stripes =
        |index: usize, at: DVec3| index.is_multiple_of(3) || (0.25 * (at.x + 0.3 * at.y)).rem_euclid(1.0) < 0.6;
    let [asked, refined, links] = check_refined(Some(&stripes));
    assert!(asked > 100_000 && refined > 10_000 && links > 1000, "{asked} samples, {refined} refined, {links} links");
}

/// Two walls, one nearer than the other, leave a slit between two columns of samples, and many surfaces lie behind them.
#[test]
fn what_lies_behind_all_samples_is_seen_through_a_slit_between_them() {
    let view = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 16.0, 1.0, 60.0, UVec2::splat(32)).unwrap();
    let wall = |left: f32, right: f32, z: f32, object| {
        quad(
            [(left, -16.0), (right, -16.0), (right, 16.0), (left, 16.0)].map(|(x, y)| Vec3::new(x, y, z)),
            object,
            true,
        )
    };
    // Of four samples of a texel the second and the third lie at 96/256 and 160/256 of it.
    let (from, to) = (100.0 / 256.0, 120.0 / 256.0);
    let walls: Vec<Triangle> = wall(-16.0, from, -5.0, 0).into_iter().chain(wall(to, 16.0, -8.0, 1)).collect();
    let behind: Vec<Triangle> = (2..10).flat_map(|object| wall(-16.0, 16.0, -30.0 - object as f32, object)).collect();
    let all: Vec<Triangle> = walls.iter().chain(&behind).copied().collect();
    let crossings = [&walls, &all].map(|triangles| {
        let map = bake_refined(&view, triangles.iter().copied(), &Refinement::default()).map;
        (0..128).map(|y| map.link(IVec2::new(65, y), false).unwrap()).collect::<Vec<f64>>()
    });
    // With nothing behind it, nothing in the slit counts as another surface: the link ends where the second wall begins.
    for (crossings, expected) in crossings.iter().zip([(120.0 - 96.0) / 64.0, (100.0 - 96.0) / 64.0]) {
        assert!(crossings.iter().all(|crossing| (crossing - expected).abs() < 1.0 / 16.0), "{expected}: {crossings:?}");
    }
}

/// How many samples, refined ones and links were found to be right.
fn check_refined(holes: Option<&Holes>) -> [u32; 3] {
    let (mut asked, mut refined, mut links) = (0, 0, 0);
    for (seed, fine, slots) in [(1, 4, 16), (2, 4, 16), (3, 2, 32), (4, 8, 8), (5, 4, 4)] {
        let soup = soup(seed);
        // Large enough for the samples to stay within a map's bytes.
        let size = UVec2::new(70, 45) * if fine == 8 { 3 } else { 1 };
        let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 0.6, 2.0, 60.0, size).unwrap();
        let refinement = Refinement::default().with_fine(fine).with_slots(slots);
        let mask = |at: &MaskPlace| {
            let corners = soup[at.triangle as usize].corners;
            assert_eq!(at.object, soup[at.triangle as usize].object);
            let place = corners[0] * at.weights.x + corners[1] * at.weights.y + corners[2] * at.weights.z;
            holes.is_none_or(|there| there(at.triangle as usize, place))
        };
        let caster = |(index, triangle): (usize, &Triangle)| {
            let caster = Caster::from(*triangle);
            if holes.is_some() && !index.is_multiple_of(3) { caster.with_mask(&mask) } else { caster }
        };
        let map = bake_refined(&view, soup.iter().enumerate().map(caster), &refinement).map;
        assert!(map.bytes() < size.element_product() as usize * 9, "{} bytes", map.bytes());
        let seen = seen(&view, &soup, holes);
        let edge_on = seen.iter().filter(|seen| seen.plane.is_none()).count();
        assert!(edge_on < 8, "{edge_on} of {} triangles", soup.len());
        let side = f64::from(fine);
        let grid = TexelRect::of_size(size * fine);
        let allowed = |key: f64| view.key_width(key);
        for at in grid.texels() {
            let place = (at.as_dvec2() + 0.5) / side;
            let Some(key) = nearest(&seen, place, 0.03) else { continue };
            let sample = map.sample(at);
            let found = sample.plane.at(place);
            asked += 1;
            if sample.side < 1.0 {
                refined += 1;
                let same = found == key || (found - key).abs() <= 1e-4 * allowed(key.min(found));
                assert!(same, "seed {seed}, sample {at}: {found} instead of {key}");
            } else if found != key {
                // One plane does for the texel and what lies just beyond it.
                let off = (found - key).abs() / allowed(key.min(found));
                assert!(off <= 0.5 + 1e-3, "seed {seed}, texel of {at}: {off} of a texel's width off");
            }
            let texel = at / fine as i32;
            for (next, down) in [(IVec2::X, false), (IVec2::Y, true)] {
                let beyond = at + next;
                let crosses = beyond / fine as i32 != texel && grid.contains(beyond);
                let beyond_place = (beyond.as_dvec2() + 0.5) / side;
                if crosses
                    && sample.side == 1.0
                    && let Some(key) = nearest(&seen, beyond_place, 0.03)
                {
                    let found = sample.plane.at(beyond_place);
                    let off = if found == key { 0.0 } else { (found - key).abs() / allowed(key.min(found)) };
                    assert!(off <= 0.5 + 1e-3, "seed {seed}, beyond the texel of {at}: {off}");
                }
                if let Some(crossing) = map.link(at, down) {
                    links += u32::from(check_link(&map, &seen, at, next, crossing, seed));
                }
            }
        }
    }
    [asked, refined, links]
}

/// A link's place against the first of 256 places on the way where the surface is nearer to the other sample's plane. Returns whether that place is
/// beyond doubt.
fn check_link(map: &FacetMap, seen: &[Seen<'_>], at: IVec2, next: IVec2, crossing: f64, seed: u64) -> bool {
    let side = f64::from(map.fine());
    let place = |t: f64| (at.as_dvec2() + 0.5 + next.as_dvec2() * t) / side;
    let (a, b) = (map.sample(at).plane, map.sample(at + next).plane);
    let off = |plane: &Affine, at: DVec2, key: f64| {
        let own = plane.at(at);
        if own == key { 0.0 } else { (own - key).abs() }
    };
    let own = |t: f64| nearest(seen, place(t), 0.0).is_some_and(|key| off(&a, place(t), key) <= off(&b, place(t), key));
    // Snapping moves edges by half of 1/256 texel; where they run along the link, by more along it.
    let steps: Vec<bool> = (0..=256).map(|i| own(f64::from(i) / 256.0)).collect();
    let changes = steps.windows(2).filter(|pair| pair[0] != pair[1]).count();
    let right = steps.iter().position(|own| !own).unwrap_or(256) as f64 / 256.0;
    // One edge, well between the samples, that crosses the link rather than runs along it.
    let beside = |t: f64| {
        let across = DVec2::new(f64::from(next.y), f64::from(next.x)) * (0.02 / side);
        let key = |at: DVec2| nearest(seen, at, 0.0).is_some_and(|key| off(&a, at, key) <= off(&b, at, key));
        key(place(t) + across) == key(place(t) - across)
    };
    let clear = changes == 1 && (0.1..0.9).contains(&right) && beside(right - 0.08) && beside(right + 0.08);
    if clear {
        // Half a slot is what a count of slots leaves open; a slot in all, and snapping.
        let slot = 1.0 / f64::from(map.slots());
        let error = (crossing - right).abs();
        assert!(
            error <= slot + side * 2.0 / 256.0,
            "seed {seed}, link from {at} by {next}: {crossing} instead of {right}"
        );
    }
    clear
}

#[test]
fn no_number_of_threads_changes_a_bit() {
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 0.6, 2.0, 60.0, UVec2::new(130, 97)).unwrap();
    let make = || bake_refined(&view, soup(7), &Refinement::default()).map;
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(make);
    let many = rayon::ThreadPoolBuilder::new().num_threads(5).build().unwrap().install(make);
    assert_eq!(alone, many);
    assert!(alone.refined() > 100);
    let tiled: Tiled = Tiled::copy_of(alone.as_ref());
    assert!(tiled.tile_count() > 0);
}
