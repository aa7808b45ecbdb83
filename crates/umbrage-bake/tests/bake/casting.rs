//! Meshes of casters: every kind of map is the same bits as of the casters one by one.

use glam::{DVec3, UVec2, Vec2, Vec3};
use std::convert::Infallible;
use umbrage_bake::{
    Caster, CasterMesh, Casting, Deep, Film, Mask, MaskPlace, Refinement, Streaming, bake, bake_by_normals, bake_deep,
    bake_facets, bake_multi, bake_refined, bake_streamed, bake_tags,
};
use umbrage_depth::{BackFace, First, Midpoint, Tiled};
use umbrage_plane::View;
use umbrage_raster::{Cull, IndexedMesh, Triangle};

/// A waving sheet of `side`² cells with normals and places in a texture.
struct Sheet {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    triangles: Vec<[u32; 3]>,
}

impl Sheet {
    fn new(side: u32) -> Self {
        let mut sheet = Self { positions: vec![], normals: vec![], uvs: vec![], triangles: vec![] };
        for (y, x) in (0..=side).flat_map(|y| (0..=side).map(move |x| (y, x))) {
            let uv = Vec2::new(x as f32, y as f32) / side as f32;
            sheet.positions.push((uv - 0.5).extend(0.2 * (9.0 * uv.x).sin() + 0.1 * (31.0 * uv.y).cos()) * 6.0);
            sheet.normals.push(Vec3::new((9.0 * uv.x).cos(), (31.0 * uv.y).sin(), 0.3));
            sheet.uvs.push(uv);
        }
        for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
            let at = |x: u32, y: u32| y * (side + 1) + x;
            sheet.triangles.push([at(x, y), at(x + 1, y), at(x + 1, y + 1)]);
            sheet.triangles.push([at(x, y), at(x + 1, y + 1), at(x, y + 1)]);
        }
        sheet
    }

    fn mesh(&self, object: u32) -> CasterMesh<'_> {
        let mesh = IndexedMesh::new(DVec3::Z, &self.positions[..], &self.triangles[..], object, object == 0);
        CasterMesh::from(mesh).with_normals(&self.normals[..]).with_uvs(&self.uvs[..])
    }
}

/// A mesh with holes and one without, a lone caster before each of them.
fn list<'a>(sheet: &'a Sheet, mask: Mask<'a>, film: Film<'a>) -> Vec<Casting<'a>> {
    let lone = |z: f32| Triangle::new([Vec2::ZERO, Vec2::X, Vec2::Y].map(|at| (at * 9.0 - 4.0).extend(z)), 7, true);
    let glass = sheet.mesh(1).with_passes(Vec3::new(0.5, 0.25, 0.75));
    let film = sheet.mesh(2).with_film(film);
    vec![lone(-2.0).into(), sheet.mesh(0).with_mask(mask).into(), lone(3.0).into(), glass.into(), film.into()]
}

/// The casters one by one.
fn apart<'a>(list: &[Casting<'a>]) -> Vec<Caster<'a>> {
    list.iter().flat_map(Casting::casters).collect()
}

fn views() -> [View; 2] {
    let eye = DVec3::new(1.0, 2.0, 12.0);
    [
        View::perspective(eye, DVec3::ZERO, DVec3::Y, 0.6, 1.0, 40.0, UVec2::new(97, 80)).unwrap(),
        View::orthographic(eye, DVec3::ZERO, DVec3::Y, 4.0, 1.0, 40.0, UVec2::splat(70)).unwrap(),
    ]
}

/// Holes by the triangle's index, so that they move when it is wrong.
fn holes(at: &MaskPlace) -> bool {
    at.triangle % 5 != 3 && (at.uv.x * 23.0).fract() < 0.8
}

fn tinted(at: &MaskPlace) -> Vec3 {
    at.uv.as_vec2().extend((at.triangle % 3) as f32 / 3.0)
}

#[test]
fn a_mesh_of_casters_is_its_casters_in_every_kind_of_map() {
    // Of several blocks, and no whole number of them.
    let sheet = Sheet::new(37);
    let casting = list(&sheet, &holes, &tinted);
    let casters = apart(&casting);
    assert_eq!(casters.len(), 2 + 3 * 2 * 37 * 37);
    assert!(casters.iter().filter(|caster| caster.normals.is_some()).count() == casters.len() - 2);
    let (meshes, apart) = (|| casting.iter().cloned(), || casters.iter().copied());
    for view in views() {
        let (one, other) = (bake(&view, meshes(), &First, Cull::None), bake(&view, apart(), &First, Cull::None));
        assert!(one.map == other.map && one.stats == other.stats && one.fragments == other.fragments);
        assert!(one.stats.kept() > 1000, "{}", one.stats);
        let midpoint = Midpoint::default();
        assert!(bake(&view, meshes(), &midpoint, Cull::None).map == bake(&view, apart(), &midpoint, Cull::None).map);
        let multi = |baked: Result<umbrage_bake::Baked, _>| baked.unwrap().map;
        assert!(
            multi(bake_multi(&view, meshes(), &First, Cull::None, 2))
                == multi(bake_multi(&view, apart(), &First, Cull::None, 2))
        );
        assert!(bake_by_normals(&view, meshes(), &BackFace).map == bake_by_normals(&view, apart(), &BackFace).map);
        assert!(bake_tags(&view, meshes()) == bake_tags(&view, apart()));
        let (one, other) =
            (bake_facets(&view, meshes(), &First, Cull::None), bake_facets(&view, apart(), &First, Cull::None));
        assert!(one.map == other.map && one.stats == other.stats);
        let refinement = Refinement::default();
        assert!(bake_refined(&view, meshes(), &refinement).map == bake_refined(&view, apart(), &refinement).map);
        let deep = Deep::default();
        let (one, other) = (bake_deep(&view, [meshes()], &deep), bake_deep(&view, [apart()], &deep));
        assert!(one.map == other.map && one.stats == other.stats);
    }
}

#[test]
fn chunks_end_within_meshes_and_forget_nothing() {
    // More triangles than are drawn at once.
    let sheet = Sheet::new(190);
    let casting = list(&sheet, &holes, &tinted);
    let casters = apart(&casting);
    assert!(casters.len() > 3 << 16);
    let view = views()[0];
    let wanted = bake(&view, casters.iter().copied(), &First, Cull::None);
    let found = bake(&view, casting.iter().cloned(), &First, Cull::None);
    assert!(found.map == wanted.map && found.stats == wanted.stats && found.fragments == wanted.fragments);
    for (triangles, chunks) in [(70_001, 4), (1 << 20, 1)] {
        let streaming = Streaming { map_bytes: 1 << 30, triangles };
        let mut tiles = Vec::new();
        let Ok(streamed) = bake_streamed(
            &view,
            || casting.iter().cloned(),
            &First,
            Cull::None,
            streaming,
            |row| {
                tiles.extend(row);
                Ok::<(), Infallible>(())
            },
        );
        assert_eq!((streamed.chunks, streamed.stats), (chunks, wanted.stats));
        assert_eq!(Tiled::from_tiles(view, tiles), *wanted.map);
    }
}

#[test]
fn a_caster_of_a_mesh_has_what_its_corners_have() {
    let sheet = Sheet::new(2);
    let mesh = sheet.mesh(4).with_passes(Vec3::splat(0.5)).with_mask(&holes).with_film(&tinted);
    let corners = sheet.triangles[3].map(|corner| corner as usize);
    let triangle = Triangle::new(corners.map(|corner| DVec3::Z + sheet.positions[corner].as_dvec3()), 4, false);
    let wanted = Caster::from(triangle)
        .with_passes(Vec3::splat(0.5))
        .with_normals(corners.map(|corner| sheet.normals[corner]))
        .with_uvs(corners.map(|corner| sheet.uvs[corner]))
        .with_mask(&holes)
        .with_film(&tinted);
    assert_eq!(mesh.caster(3), wanted);
    // Positions without a normal or a place in the texture make a flat triangle, and one that lies at (0, 0).
    let mesh = mesh.with_normals(&sheet.normals[..1]).with_uvs(&sheet.uvs[..1]);
    assert_eq!(mesh.caster(3).normals, None);
    assert_eq!(mesh.caster(0).uvs, [sheet.uvs[0], Vec2::ZERO, Vec2::ZERO]);
    let casting = Casting::from(mesh);
    assert!(casting.is_transparent() && casting.count() == 8 && casting.triangles().nth(3) == Some(triangle));
    assert!(!Casting::from(triangle).is_transparent() && Casting::from(triangle).count() == 1);
}
