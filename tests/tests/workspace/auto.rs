//! The default over maps of facets: right at contacts, at tile and face borders and by the rules, and the same bits however points are batched.

use glam::{DVec3, UVec2, Vec3};
use umbrage_bake::{Refinement, bake_refined};
use umbrage_depth::{Map, Storage};
use umbrage_oracle::{AreaLight, Body, Face, Geometry, RayCast};
use umbrage_plane::{Cells, Kind, Rules, Sectors, SpotView, SurfacePoint, View, cube_views, sector_views};
use umbrage_raster::Triangle;
use umbrage_recipe::{LightUse, Recipe};
use umbrage_sample::Key;
use umbrage_shadow::{Around, Crossing, DualPlane, PlaceJudged, Probe, Shadow, ShadowMap};
use umbrage_tests::laws::Subject;

const KEY: Key = Key::new(5, 0, 0);

/// A closed box.
fn cuboid(low: DVec3, high: DVec3, object: u32) -> Vec<Triangle> {
    let corner = |index: usize| {
        DVec3::from_array(std::array::from_fn(|axis| if index >> axis & 1 == 1 { high[axis] } else { low[axis] }))
    };
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let face = |[a, b, c, d]: [usize; 4]| {
        let [a, b, c, d] = [a, b, c, d].map(corner);
        [[a, b, c], [a, c, d]].map(|corners| Triangle { corners, object, sheet: false })
    };
    faces.into_iter().flat_map(face).collect()
}

fn truth(triangles: &[Triangle], objects: usize) -> Geometry {
    let face = |triangle: &Triangle| Face {
        corners: triangle.corners.map(|DVec3 { x, y, z }| Vec3::new(x as f32, y as f32, z as f32)),
        object: triangle.object,
    };
    let body = Body { casts: true, solid: true, passes: Vec3::ZERO };
    Geometry::from_faces(triangles.iter().map(face).collect(), vec![body; objects])
}

/// Random points of the sides of axis-parallel boxes that are not inside another one, with a square region of half-width `half` about each.
fn points(boxes: &[(DVec3, DVec3)], count: u32, half: f64) -> Vec<SurfacePoint> {
    let point = |region: u32| {
        let (low, high) = boxes[region as usize % boxes.len()];
        let unit = |dimension| f64::from(KEY.unit(region, dimension));
        let side = (unit(0) * 6.0) as usize;
        let (axis, up) = (side / 2, side % 2 == 1);
        let mut at = low + (high - low) * DVec3::new(unit(1), unit(2), unit(3));
        at[axis] = if up { high[axis] } else { low[axis] };
        let normal = DVec3::AXES[axis] * if up { 1.0 } else { -1.0 };
        let (a, b) = (DVec3::AXES[(axis + 1) % 3] * half, DVec3::AXES[(axis + 2) % 3] * half);
        let corners = [at - a - b, at + a - b, at + a + b, at - a + b];
        SurfacePoint { region, object: region % boxes.len() as u32, ..SurfacePoint::at(at, normal.as_vec3()) }
            .with_corners(corners)
    };
    let hidden = |point: &SurfacePoint| {
        let others = boxes.iter().enumerate().filter(|(index, _)| *index != point.object as usize);
        others.into_iter().any(|(_, (low, high))| point.position.cmpgt(*low).all() && point.position.cmplt(*high).all())
    };
    (0..count).map(point).filter(|point| !hidden(point)).collect()
}

/// Points that face the light and whose answer is wrong by more than half where truth is one all around, by `margin`; and how many were judged.
fn wrong(ray: &RayCast<'_>, shadow: &dyn Shadow, light: DVec3, points: &[SurfacePoint], margin: f64) -> (usize, usize) {
    let mut found = vec![0.0; points.len()];
    shadow.fractions(points, KEY, &mut found);
    let (mut wrong, mut judged) = (0, 0);
    for (point, found) in points.iter().zip(found) {
        let facing = point.normal.as_dvec3().dot((light - point.position).normalize());
        let right = ray.at(point);
        let around = DVec3::AXES.iter().flat_map(|axis| [1.0, -1.0].map(|sign| *axis * sign * margin));
        let along = around.filter(|by| by.dot(point.normal.as_dvec3()) == 0.0);
        let mut same = along.map(|by| ray.at(&SurfacePoint { position: point.position + by, ..*point }) == right);
        if facing > 0.02 && same.all(|same| same) {
            judged += 1;
            wrong += usize::from((found - right).abs() > 0.5);
        }
    }
    (wrong, judged)
}

/// Boxes on a floor, touching it and each other, over many tiles of the map.
fn town() -> Vec<(DVec3, DVec3)> {
    let mut boxes = vec![(DVec3::new(-12.0, -1.0, -12.0), DVec3::new(12.0, 0.0, 12.0))];
    for i in 0..30u32 {
        let unit = |dimension| f64::from(KEY.unit(1000 + i, dimension));
        let low = DVec3::new(unit(0) * 18.0 - 10.0, 0.0, unit(1) * 18.0 - 10.0);
        boxes.push((low, low + DVec3::new(0.2 + unit(2) * 1.5, 0.3 + unit(3) * 3.0, 0.2 + unit(4) * 1.5)));
    }
    boxes
}

fn soup(boxes: &[(DVec3, DVec3)]) -> Vec<Triangle> {
    boxes.iter().zip(0..).flat_map(|((low, high), object)| cuboid(*low, *high, object)).collect()
}

#[test]
fn nothing_is_detached_or_leaks_at_contacts_in_any_kind_of_view() {
    let boxes = town();
    let triangles = soup(&boxes);
    let geometry = truth(&triangles, boxes.len());
    let size = UVec2::splat(512);
    let eye = DVec3::new(9.0, 14.0, 5.0);
    let spot = View::perspective(eye, DVec3::ZERO, DVec3::Z, 1.6, 2.0, 60.0, size).unwrap();
    let sun = View::orthographic(eye, DVec3::ZERO, DVec3::Z, 17.0, -20.0, 60.0, size).unwrap();
    for kind in [Kind::Axial, Kind::Radial, Kind::Screen] {
        for view in [spot, sun] {
            let view = view.with_kind(kind);
            let recipe: Recipe = "auto".parse().unwrap();
            let shadow = recipe.bind(recipe.bake(&view, triangles.iter().copied()), Storage::Tiled).unwrap();
            let ray = RayCast::new(&geometry, &view);
            let light = if view.is_perspective() { eye } else { eye * 1e6 };
            for half in [0.0, 0.02] {
                // A texel is about .06 wide.
                let (wrong, judged) = wrong(&ray, &*shadow, light, &points(&boxes, 20_000, half), 0.05);
                assert!(judged > 6000 && wrong * 2000 <= judged, "{wrong} of {judged}, {kind:?}, {half}");
            }
        }
    }
}

/// A room with boxes in it, about a lamp at 0.
fn room() -> Vec<(DVec3, DVec3)> {
    let mut boxes = Vec::new();
    for axis in DVec3::AXES {
        for side in [-1.0, 1.0] {
            let middle = axis * side * 10.5;
            let half = DVec3::splat(10.0) - axis * 9.5;
            boxes.push((middle - half, middle + half));
        }
    }
    for i in 0..40u32 {
        let unit = |dimension| f64::from(KEY.signed(2000 + i, dimension));
        let way = DVec3::new(unit(0), unit(1), unit(2)).normalize();
        let (middle, half) = (way * (3.0 + 3.0 * unit(3).abs()), 0.25 + 0.4 * unit(4).abs());
        boxes.push((middle - half, middle + half));
    }
    boxes
}

/// A lamp among boxes in a room: its six maps answer as one, at the seams too.
#[test]
fn the_six_maps_of_a_lamp_are_one_light() {
    let boxes = room();
    let triangles = soup(&boxes);
    let geometry = truth(&triangles, boxes.len());
    let ray = RayCast::everywhere(&geometry, DVec3::ZERO.extend(1.0));
    let views = cube_views(DVec3::ZERO, 0.1, 40.0, 512).unwrap();
    let maps = views.map(|view| bake_refined(&view, triangles.iter().copied(), &Refinement::default()).map);
    let lamp = Around::new(DualPlane::default(), maps.to_vec()).unwrap();
    // The same with each of the maps fitted to what is looked up: what lies about the seam between two of them.
    let part = DVec3::new(1.0, 1.0, 0.2).normalize();
    let toward = |point: &SurfacePoint| point.position.normalize().dot(part) > 0.88;
    let asked: Vec<SurfacePoint> = points(&boxes, 500_000, 0.04).into_iter().filter(toward).collect();
    let seen: Vec<DVec3> = asked.iter().flat_map(SurfacePoint::corners).collect();
    let with = LightUse { receivers: Some(&seen), ..LightUse::default() };
    let recipe: Recipe = "auto,window=fitted".parse().unwrap();
    let fitted = recipe.shadow_of(&views, &with, |_, _| triangles.iter().copied()).unwrap();
    assert!(fitted.maps.iter().zip(&views).filter(|(map, view)| map.view != **view).count() >= 2);
    let (few, judged) = wrong(&ray, &*fitted.shadow, DVec3::ZERO, &asked, 0.08);
    assert!(judged > 2000 && few * 2000 <= judged, "{few} of {judged}, fitted");
    for half in [0.0, 0.04] {
        let all = points(&boxes, 30_000, half);
        let (few, judged) = wrong(&ray, &lamp, DVec3::ZERO, &all, 0.08);
        assert!(judged > 8000 && few * 2000 <= judged, "{few} of {judged}, {half}");
        // Within a texel or so of the seams between faces.
        let at_seam = |point: &&SurfacePoint| {
            let mut sides = point.position.abs().to_array();
            sides.sort_by(f64::total_cmp);
            sides[1] > 0.985 * sides[2]
        };
        let seams: Vec<SurfacePoint> = points(&boxes, 400_000, half).iter().filter(at_seam).copied().collect();
        let (few, judged) = wrong(&ray, &lamp, DVec3::ZERO, &seams, 0.08);
        assert!(judged > 500 && few * 400 <= judged, "{few} of {judged} at seams, {half}");
    }
}

/// With a size it is a sphere, whose disc every point of the room sees.
#[test]
fn a_lamp_with_a_size_is_as_soft_as_rays_to_its_sphere() {
    const RADIUS: f64 = 0.5;
    let boxes = room();
    let triangles = soup(&boxes);
    let geometry = truth(&triangles, boxes.len());
    let rays = AreaLight::new(RayCast::everywhere(&geometry, DVec3::ZERO.extend(1.0)), RADIUS);
    let views = cube_views(DVec3::ZERO, 0.1, 40.0, 128).unwrap();
    let recipe: Recipe = format!("auto,light={RADIUS},maps=32").parse().unwrap();
    let lamp = recipe.shadow_of(&views, &LightUse::default(), |_, _| triangles.iter().copied()).unwrap();
    assert_eq!(lamp.maps.len(), 6 * 32);
    let asked = points(&boxes, 4000, 0.02);
    let facing = |point: &&SurfacePoint| point.normal.as_dvec3().dot(-point.position.normalize()) > 0.1;
    let asked: Vec<SurfacePoint> = asked.iter().filter(facing).copied().collect();
    let (mut found, mut right) = (vec![0.0; asked.len()], vec![0.0; asked.len()]);
    lamp.shadow.fractions(&asked, KEY, &mut found);
    rays.fractions(&asked, KEY, &mut right);
    let soft = right.iter().filter(|right| (0.05..0.95).contains(*right)).count();
    let squares: f32 = found.iter().zip(&right).map(|(found, right)| (found - right).powi(2)).sum();
    let rms = (squares / asked.len() as f32).sqrt();
    assert!(soft * 20 > asked.len() && rms < 0.03, "{rms} over {}, of which {soft} are in penumbrae", asked.len());
}

/// The sectors about a mast among boxes answer as one light, where two of them meet too.
#[test]
fn sectors_meet_without_a_seam() {
    let eye = DVec3::new(0.3, 2.0, -0.2);
    let boxes: Vec<_> = town().into_iter().skip(1).collect();
    let triangles = soup(&boxes);
    let geometry = truth(&triangles, boxes.len());
    let ray = RayCast::everywhere(&geometry, eye.extend(1.0));
    for (count, margin) in [(3, 0.0), (6, 0.0), (6, 0.02)] {
        let sectors = Sectors { count, margin, tan_elevation: 2.0, size: UVec2::splat(512) };
        let views =
            sector_views(eye, 0.05, 40.0, &sectors).unwrap().into_iter().map(|view| view.with_rules(Rules::AROUND));
        let maps: Vec<_> =
            views.map(|view| bake_refined(&view, triangles.iter().copied(), &Refinement::default()).map).collect();
        let mast = Around::new(DualPlane::default(), maps).unwrap();
        let seen = |point: &&SurfacePoint| {
            let from = point.position - eye;
            from.y.abs() < 1.8 * from.x.hypot(from.z) && from.length() > 0.5
        };
        let turn = std::f64::consts::TAU / f64::from(count);
        let at_seam = |point: &&SurfacePoint| {
            let from = point.position - eye;
            // Sectors look along multiples of a turn and meet halfway between.
            let within = (f64::atan2(-from.z, from.x) / turn).rem_euclid(1.0);
            (within - 0.5).abs() * turn < 0.02
        };
        for half in [0.0, 0.02] {
            let all: Vec<SurfacePoint> = points(&boxes, 20_000, half).iter().filter(seen).copied().collect();
            let (few, judged) = wrong(&ray, &mast, eye, &all, 0.06);
            assert!(judged > 2000 && few * 1000 <= judged, "{few} of {judged}, {count} sectors, {half}");
            let seams: Vec<SurfacePoint> =
                points(&boxes, 600_000, half).iter().filter(seen).filter(at_seam).copied().collect();
            let (few, judged) = wrong(&ray, &mast, eye, &seams, 0.06);
            assert!(judged > 500 && few * 200 <= judged, "{few} of {judged} at seams, {count} sectors, {half}");
        }
    }
}

/// Spots up to a half space, close over the ground.
#[test]
fn spots_as_wide_as_a_half_space_are_one_light() {
    let eye = DVec3::new(0.3, 4.5, -0.2);
    let boxes = town();
    let triangles = soup(&boxes);
    let geometry = truth(&triangles, boxes.len());
    let spot = SpotView { eye, target: DVec3::new(0.9, 0.0, 0.4), near: 0.05, far: 60.0, ..SpotView::default() };
    for (degrees, cos) in [(142.0f64, None), (170.0, None), (178.0, None), (178.0, Some(0.0))] {
        let size = UVec2::splat(1024);
        let view = View::spot(SpotView { full_angle_radians: degrees.to_radians(), size, ..spot }).unwrap();
        let view = if cos.is_some() { view.with_cone(cos).unwrap() } else { view };
        let casters = |_: &View, _: u32| triangles.iter().copied();
        let light = Recipe::default().shadow_of(&[view], &LightUse::default(), casters).unwrap();
        let ray = RayCast::everywhere(&geometry, eye.extend(1.0));
        let inside = |point: &&SurfacePoint| {
            let from = (point.position - eye).normalize();
            view.ahead().dot(from) > view.cone().unwrap() + 0.01
        };
        for half in [0.0, 0.02] {
            let all: Vec<SurfacePoint> = points(&boxes, 30_000, half).iter().filter(inside).copied().collect();
            let (few, judged) = wrong(&ray, &*light.shadow, eye, &all, 0.06);
            assert!(judged > 4000 && few * 1000 <= judged, "{few} of {judged}, {degrees} degrees, {half}");
        }
    }
}

#[test]
fn the_same_bits_one_by_one_together_and_without_wide_instructions() {
    let boxes = town();
    let view = View::perspective(DVec3::new(9.0, 14.0, 5.0), DVec3::ZERO, DVec3::Z, 1.6, 2.0, 60.0, UVec2::splat(256));
    let view = view.unwrap().with_rules(Rules::SPOT).with_cone(Some(0.8)).unwrap();
    let recipe: Recipe = "auto".parse().unwrap();
    let map: Map = recipe.bake(&view, soup(&boxes));
    let subject = Subject::new("auto", DualPlane::default());
    let shadow = subject.over(&map);
    for half in [0.0, 0.05, 0.9] {
        let points = points(&boxes, 3000, half);
        let mut together = vec![0.0; points.len()];
        let counters = subject.counted(&map, &points, &mut together);
        assert!(half > 0.0 || counters.placed > 0, "some lie outside the cone");
        for (point, fraction) in points.iter().zip(&together) {
            assert!((0.0..=1.0).contains(fraction));
            assert_eq!(shadow.fraction(point, KEY).to_bits(), fraction.to_bits());
            let key = KEY.region(point.region);
            if let Ok(receiver) = view.receiver(point) {
                assert_eq!(subject.of_baseline(&map, &receiver, key).to_bits(), fraction.to_bits());
            }
        }
    }
}

/// Whatever the rules leave to the map is looked up in it, however far outside it lies.
#[test]
fn nothing_is_seen_far_outside_the_map() {
    let compare = Rules { outside: umbrage_plane::Verdict::Compare, ..Rules::VOLUME };
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.0, 20.0, UVec2::splat(64)).unwrap();
    let view = view.with_rules(compare);
    let recipe: Recipe = "auto".parse().unwrap();
    let wall = cuboid(DVec3::new(-9.0, -9.0, -6.0), DVec3::new(9.0, 9.0, -5.0), 0);
    let shadow = recipe.bind(recipe.bake(&view, wall), Storage::Tiled).unwrap();
    for zeta in [1e-300, 1e-12, 1e-9, 1e-6, 1e-3, 1.0] {
        for half in [0.0, 0.3, 40.0] {
            let corner = |x: f64, y: f64| DVec3::new(5.0 + x * half, y * half, -zeta);
            let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
            let point = SurfacePoint::at(DVec3::new(5.0, 0.0, -zeta), Vec3::Z).with_corners(corners);
            assert_eq!(shadow.fraction(&point, KEY), 0.0, "{zeta} {half}");
        }
    }
}

#[test]
fn a_region_is_asked_where_it_is_its_surface() {
    let size = UVec2::splat(64);
    let sun = View::orthographic(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, 4.0, 1.0, 20.0, size).unwrap();
    // A shadow edge along x = 0: dark to the right.
    let casters = cuboid(DVec3::new(0.0, 2.0, -9.0), DVec3::new(9.0, 3.0, 9.0), 0);
    let shadow =
        ShadowMap { filter: DualPlane::default(), map: bake_refined(&sun, casters, &Refinement::default()).map };
    let whole = |x: f64| {
        let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|(u, z)| DVec3::new(x + u, 0.0, z));
        SurfacePoint::at(DVec3::new(x, 0.0, 0.0), Vec3::Y).with_corners(corners)
    };
    // An edge is placed to within 1/64 of the region's width, a sixteenth of a cell.
    assert!((shadow.fraction(&whole(0.0), KEY) - 0.5).abs() <= 1.0 / 64.0);
    for i in -20..=20 {
        let at = f64::from(i) * 0.03;
        let exact = (at + 0.5).clamp(0.0, 1.0) as f32;
        assert!((shadow.fraction(&whole(at), KEY) - exact).abs() <= 1.0 / 64.0, "{at}");
    }
    // A pixel about x = 0 of which the surface has some columns of four, at ±3/8 and ±1/8: the point is at their mean.
    for (columns, want) in
        [(vec![0], 0.0), (vec![0, 1], 0.0), (vec![3], 1.0), (vec![0, 3], 0.5), (vec![0, 1, 2], 1.0 / 3.0)]
    {
        let cells = columns.iter().flat_map(|x| (0..4).map(move |y| (*x, y)));
        let cells = cells.fold(Cells::NONE, |cells, (x, y)| cells.with(x, y, 4));
        let part = SurfacePoint { cells, ..whole(0.5 * cells.centroid().x) };
        for across in [4, 8] {
            let filter = DualPlane::default().with_across(across);
            let found = ShadowMap { filter, map: shadow.map.clone() }.fraction(&part, KEY);
            assert!((found - want).abs() <= 1.0 / 16.0, "{columns:?}: {found}, not {want}, of {across} places");
        }
    }
}

/// Keeps what it is told.
#[derive(Default)]
struct Told(Vec<PlaceJudged>);

impl Probe for Told {
    const EXPLAINS: bool = true;

    fn judged(&mut self, place: &PlaceJudged) {
        self.0.push(place.clone());
    }
}

#[test]
fn a_probe_is_told_why_each_place_is_lit_or_dark() {
    let boxes = town();
    let triangles = soup(&boxes);
    let eye = DVec3::new(9.0, 14.0, 5.0);
    let view = View::perspective(eye, DVec3::ZERO, DVec3::Z, 1.0, 2.0, 60.0, UVec2::splat(256)).unwrap();
    let bake = |view: &View| bake_refined(view, triangles.iter().copied(), &Refinement::default()).map;
    let spot = ShadowMap { filter: DualPlane::default(), map: bake(&view) };
    let lamp =
        Around::new(DualPlane::default(), cube_views(eye, 2.0, 60.0, 512).unwrap().map(|face| bake(&face)).to_vec());
    let lamp = lamp.unwrap();
    let (mut links, mut planes, mut halfway, mut mixed) = (0, 0, 0, 0);
    for point in points(&boxes, 6000, 0.05) {
        for around in [false, true] {
            let (mut told, mut out) = (Told::default(), [0.0]);
            let at = std::slice::from_ref(&point);
            if around {
                lamp.fractions_probed(at, KEY, &mut out, &mut told);
            } else {
                spot.fractions_probed(at, KEY, &mut out, &mut told);
            }
            let dark = told.0.iter().filter(|place| place.dark).count();
            // The first four are the region's corners, which say how lines are laid and do not count.
            let counted = told.0[4..].iter().filter(|place| place.dark).count();
            match out[0] {
                0.0 => assert_eq!(counted, 0),
                1.0 => assert_eq!(counted, told.0.len() - 4),
                _ => assert!(dark > 0 && dark < told.0.len(), "{dark} of {} for {}", told.0.len(), out[0]),
            }
            for place in &told.0 {
                for vote in &place.votes {
                    assert_eq!(vote.dark, vote.at_sample > vote.passed && vote.at_place > vote.passed, "{vote:?}");
                }
                let votes = place.votes.map(|vote| vote.dark);
                if let Some(ruled) = place.ruled {
                    assert_eq!(place.dark, ruled);
                } else if votes == [votes[0]; 4] {
                    assert_eq!(place.dark, votes[0]);
                } else {
                    mixed += 1;
                }
                for (crossing, (from, to)) in place.crossings.iter().zip([(0, 1), (2, 3), (0, 2), (1, 3)]) {
                    assert_eq!(crossing.is_some(), votes[from] != votes[to]);
                    assert!(crossing.is_none_or(|crossing| (0.0..=1.0).contains(&crossing.place())));
                    match crossing {
                        Some(Crossing::Link(_)) => links += 1,
                        Some(Crossing::Planes(_)) => planes += 1,
                        Some(Crossing::Halfway) => halfway += 1,
                        None => {}
                    }
                }
            }
        }
    }
    assert!(mixed > 1000 && links > 500 && planes > 0 && halfway > 500, "{mixed} mixed, {links} {planes} {halfway}");
    // A board 2 over a floor that is 10 from a sun: as much behind the board as it is far from it.
    let sun = View::orthographic(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, 4.0, 1.0, 20.0, UVec2::splat(64)).unwrap();
    let board =
        bake_refined(&sun, cuboid(DVec3::new(-1.0, 1.5, -1.0), DVec3::new(1.0, 2.0, 1.0), 0), &Refinement::default());
    let shadow = ShadowMap { filter: DualPlane::default(), map: board.map };
    let (mut told, mut out) = (Told::default(), [0.0]);
    shadow.fractions_probed(&[SurfacePoint::at(Vec3::new(0.3, 0.0, 0.2), Vec3::Y)], KEY, &mut out, &mut told);
    let vote = &told.0[0].votes[0];
    assert_eq!((told.0.len(), vote.at_sample, vote.at_place, out[0]), (1, 2.0, 2.0, 1.0));
    // Half a texel of 1/8.
    assert!((vote.passed - 0.0625).abs() < 1e-6, "{}", vote.passed);
}

#[test]
fn rules_are_asked_at_each_place_of_a_region() {
    // A region across the border of an empty map: half of it outside, where all is dark.
    let view = View::orthographic(DVec3::Y * 9.0, DVec3::ZERO, DVec3::Z, 4.0, 1.0, 20.0, UVec2::splat(64)).unwrap();
    let recipe: Recipe = "auto".parse().unwrap();
    let floor = cuboid(DVec3::new(-9.0, -1.0, -9.0), DVec3::new(9.0, 0.0, 9.0), 0);
    for (rules, wanted) in [(Rules::SPOT, 0.5), (Rules::OPEN, 0.0)] {
        let view = view.with_rules(rules);
        let shadow = recipe.bind(recipe.bake(&view, floor.iter().copied()), Storage::Raw).unwrap();
        let corner = |x: f64, z: f64| DVec3::new(4.0 + x * 0.3, 0.0, z * 0.3);
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        let across = SurfacePoint::at(DVec3::X * 4.0, Vec3::Y).with_corners(corners);
        // An edge is placed to within 1/64 of the region.
        assert!((shadow.fraction(&across, KEY) - wanted).abs() <= 1.0 / 64.0, "{rules:?}");
        let far = SurfacePoint::at(DVec3::X * 7.0, Vec3::Y);
        assert_eq!(shadow.fraction(&far, KEY), 2.0 * wanted, "{rules:?}");
    }
}
