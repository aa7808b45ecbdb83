//! Meshes with indices: the same bits as their triangles one by one, however corners are shared.

use crate::oracle::Camera;
use glam::{DVec3, IVec2, UVec2, Vec3};
use umbrage_plane::{Kind, Sampling, TexelRect, View};
use umbrage_raster::{Bins, Coverage, Cull, Geometry, IndexedMesh, Triangle};

/// A waving sheet of `across` × `down` cells, its vertices row by row, with what is unusual in it: vertices behind the eye, far beside the map,
/// not finite, and triangles without area, with a vertex that does not exist.
fn sheet(across: u32, down: u32, unusual: bool) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let mut positions = Vec::new();
    for (y, x) in (0..=down).flat_map(|y| (0..=across).map(move |x| (y, x))) {
        let (u, v) = (x as f32 / across as f32 - 0.5, y as f32 / down as f32 - 0.5);
        positions.push(Vec3::new(16.0 * u, 10.0 * v, (13.0 * u).sin() + (17.0 * v * u).cos()));
    }
    if unusual {
        for (index, position) in positions.iter_mut().enumerate().step_by(97) {
            match index % 5 {
                0 => position.z = 50.0,
                1 => position.x = 1e7,
                2 => position.y = f32::NAN,
                3 => position.z = f32::INFINITY,
                _ => position.x = 1e31,
            }
        }
    }
    let mut triangles = Vec::new();
    for (y, x) in (0..down).flat_map(|y| (0..across).map(move |x| (y, x))) {
        let at = |x: u32, y: u32| y * (across + 1) + x;
        triangles.extend([[at(x, y), at(x + 1, y + 1), at(x + 1, y)], [at(x, y), at(x, y + 1), at(x + 1, y + 1)]]);
    }
    if unusual {
        triangles.iter_mut().step_by(311).for_each(|triangle| triangle[1] = triangle[2]);
    }
    (positions, triangles)
}

fn views() -> Vec<View> {
    let eye = DVec3::new(1.0, 2.0, 12.0);
    let view = |perspective: bool| {
        let half = if perspective { 0.3 } else { 5.0 };
        Camera::new(eye, DVec3::ZERO, half, perspective, UVec2::new(193, 131)).view(1.0, 100.0)
    };
    vec![
        view(true),
        view(false),
        view(true).with_sampling(Sampling::Jittered { seed: 7 }),
        view(true).with_kind(Kind::Screen),
        view(false).with_kind(Kind::Radial),
    ]
}

/// What a tile shows.
fn tiles(bins: &Bins) -> Vec<Vec<(u32, Coverage)>> {
    let tiles = bins.tiles();
    let tile = |tile: UVec2| {
        let mut shown = Vec::new();
        bins.tile(tile, |facet, coverage| shown.push((facet.triangle, *coverage)));
        shown
    };
    (0..tiles.y).flat_map(|y| (0..tiles.x).map(move |x| UVec2::new(x, y))).map(tile).collect()
}

fn assert_same(name: &str, found: &Bins, wanted: &Bins) {
    assert_eq!(found.stats(), wanted.stats(), "{name}");
    assert!(found.facets().eq(wanted.facets()), "{name}");
    assert!(tiles(found) == tiles(wanted), "{name}");
}

fn whole(view: &View, geometry: Vec<Geometry<'_>>) -> Bins {
    Bins::new(view, TexelRect::of_size(view.size()), Cull::None, geometry)
}

/// The triangles one by one.
fn apart(geometry: &[Geometry<'_>]) -> Vec<Geometry<'static>> {
    let mut triangles = Vec::new();
    for geometry in geometry {
        match geometry {
            Geometry::Triangle(triangle) => triangles.push(Geometry::Triangle(*triangle)),
            Geometry::Mesh(mesh) => triangles.extend(mesh.triangles().map(Geometry::from)),
        }
    }
    triangles
}

#[test]
fn a_mesh_is_its_triangles_whatever_is_shared_and_by_any_thread() {
    let origin = DVec3::new(1e5, -2e5, 3e5);
    let lone = Triangle::new([Vec3::ZERO, Vec3::X, Vec3::Y], 3, true);
    for (across, down, unusual) in [(1, 1, false), (32, 16, false), (61, 90, true), (3000, 3, true)] {
        let (positions, triangles) = sheet(across, down, unusual);
        // In an order in which neighbours lie far apart, and each with corners of its own.
        let far: Vec<[u32; 3]> = (0..triangles.len()).map(|index| triangles[index * 7919 % triangles.len()]).collect();
        let own: Vec<Vec3> = triangles.iter().flatten().map(|corner| positions[*corner as usize]).collect();
        let of_own: Vec<[u32; 3]> = (0..triangles.len() as u32).map(|index| [0, 1, 2].map(|i| 3 * index + i)).collect();
        let mut beyond = triangles.clone();
        beyond.iter_mut().step_by(1777).for_each(|triangle| triangle[2] = u32::MAX);
        let mesh = |triangles| IndexedMesh::new(DVec3::ZERO, &positions[..], triangles, 5, false);
        let meshes = [
            ("shared", mesh(&triangles[..])),
            ("far apart", mesh(&far[..])),
            ("beyond", mesh(&beyond[..])),
            ("own", IndexedMesh::new(DVec3::ZERO, &own[..], &of_own[..], 5, false)),
        ];
        for view in views() {
            for (name, mesh) in &meshes {
                let name = &format!("{name}, {across} × {down}, {view:?}");
                // The first begins with a block of its own, the second within one.
                let list = vec![mesh.clone().into(), lone.into(), mesh.clone().into()];
                let wanted = whole(&view, apart(&list));
                for threads in [1, 3] {
                    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                    assert_same(name, &pool.install(|| whole(&view, list.clone())), &wanted);
                }
            }
        }
        // Far from the origin positions are relative to one that is not.
        let view = Camera::new(origin + DVec3::Z * 9.0, origin, 0.5, true, UVec2::splat(160)).view(1.0, 100.0);
        let there = IndexedMesh::new(origin, &positions[..], &triangles[..], 5, true);
        let list = vec![there.into()];
        let bins = whole(&view, list.clone());
        assert_same("origin", &bins, &whole(&view, apart(&list)));
        assert!(bins.stats().kept() > 0 && bins.facets().all(|facet| facet.object == 5 && facet.sheet));
    }
}

#[test]
fn what_is_unusual_in_a_mesh_is_counted() {
    let (positions, mut triangles) = sheet(61, 90, true);
    triangles[4000][0] = 1_000_000;
    let mesh = IndexedMesh::new(DVec3::ZERO, positions, triangles, 0, false);
    let stats = whole(&views()[0], vec![mesh.into()]).stats();
    assert_eq!(stats.given, 2 * 61 * 90);
    for (name, count) in [
        ("not finite", stats.not_finite),
        ("no area", stats.zero_area),
        ("clipped", stats.clipped),
        ("outside", stats.outside),
    ] {
        assert!(count > 10, "{name}: {count}");
    }
    assert!(stats.kept() > 5_000);
}

#[test]
fn parts_of_a_mesh_follow_one_another() {
    let (positions, triangles) = sheet(61, 40, false);
    let mesh = IndexedMesh::new(DVec3::X, positions, triangles, 2, true);
    let (mut rest, mut parts) = (mesh.clone(), Vec::new());
    for count in [0, 1, 1023, 1025, 2000, usize::MAX] {
        parts.push(rest.split_to(count));
    }
    assert!(rest.is_empty() && rest.split_to(3).is_empty());
    assert_eq!(parts.iter().map(IndexedMesh::len).collect::<Vec<_>>(), [0, 1, 1023, 1025, 2000, 831]);
    assert!(parts.iter().flat_map(IndexedMesh::triangles).eq(mesh.triangles()));
    assert_eq!(parts[2].indices(), &mesh.indices()[1..1024]);
    let view = views()[0];
    let parts = parts.into_iter().map(Geometry::from).collect();
    assert_same("parts", &whole(&view, parts), &whole(&view, vec![mesh.into()]));
}

#[test]
fn bins_are_refilled_with_meshes_and_triangles_in_turn() {
    let (positions, triangles) = sheet(80, 100, true);
    let mesh = IndexedMesh::new(DVec3::ZERO, positions, triangles, 1, false);
    let view = views()[0];
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut refilled = whole(&view, Vec::new());
            for count in [9000, 0, 2500, 1024, 3] {
                let part = mesh.clone().split_to(count);
                let wanted = whole(&view, apart(&[part.clone().into()]));
                refilled.refill(part.triangles());
                assert_same("triangles", &refilled, &wanted);
                refilled.refill([part]);
                assert_same("a mesh", &refilled, &wanted);
            }
        });
    }
}

#[test]
fn what_is_gathered_is_the_same_from_the_lists_of_several_threads() {
    // Blocks enough for three threads to make lists of their own.
    let (positions, triangles) = sheet(120, 140, false);
    let mesh = IndexedMesh::new(DVec3::ZERO, positions, triangles, 1, false);
    let view = views()[0];
    let made = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Bins::for_spans(&view, TexelRect::of_size(view.size()), Cull::None, [mesh.clone()]))
    };
    let (one, several) = (made(1), made(3));
    // A tile, a part of one, parts of four, and all of the map, in 1/256 texel.
    for (from, to) in [(32, 64), (40, 47), (30, 70), (0, 131)] {
        let region = TexelRect::new(IVec2::splat(from * 256), IVec2::splat(to * 256));
        let (wanted, found) = (one.gathered(region), several.gathered(region));
        assert!(wanted.len() > 20 && found.len() == wanted.len(), "{region:?}: {} facets", wanted.len());
        assert!((0..wanted.len() as u32).all(|number| found.facet(number) == wanted.facet(number)), "{region:?}");
    }
    assert_eq!(several.reaching(UVec2::ONE), one.reaching(UVec2::ONE));
    assert_eq!(several.is_empty_tile(UVec2::ONE), one.is_empty_tile(UVec2::ONE));
}
