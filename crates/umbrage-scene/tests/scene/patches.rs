use glam::{DVec2, DVec3, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_plane::View;
use umbrage_scene::{Basis, MOST_PIECES, Mesh, Patch, dice, utah_teapot};

const BASES: [Basis; 4] = [Basis::Bezier, Basis::BSpline, Basis::CatmullRom, Basis::Power];

fn bump() -> Patch {
    let mut control: [[Vec3; 4]; 4] =
        std::array::from_fn(|v| std::array::from_fn(|u| Vec3::new(u as f32, v as f32, 0.0)));
    for (v, u) in [(1, 1), (1, 2), (2, 1), (2, 2)] {
        control[v][u].z = 1.0;
    }
    Patch { control }
}

fn from_above(size: u32) -> View {
    View::perspective(
        DVec3::new(0.5, 0.4, 12.0),
        DVec3::ZERO,
        DVec3::Y,
        45f64.to_radians(),
        1.0,
        100.0,
        UVec2::splat(size),
    )
    .expect("a valid view")
}

fn points() -> impl Strategy<Value = [[Vec3; 4]; 4]> {
    let point = (-2f32..2.0, -2f32..2.0, -2f32..2.0).prop_map(|(x, y, z)| Vec3::new(x, y, z));
    proptest::array::uniform4(proptest::array::uniform4(point))
}

#[test]
fn v48_bump_at_its_middle() {
    assert_eq!(bump().position(0.5, 0.5).z, 0.5625);
    assert!((Basis::Bezier.position(&bump().control, 0.5, 0.5) - DVec3::new(1.5, 1.5, 0.5625)).length() < 1e-15);
    assert!((bump().normal(0.5, 0.5) - DVec3::Z).length() < 1e-15);
    assert!(bump().normal(0.1, 0.5).x < 0.0, "the bump rises toward its middle");
}

#[test]
fn w78_23_bases_of_known_curves() {
    let ramp =
        |scale: f32| std::array::from_fn(|v| std::array::from_fn(|u| Vec3::new(u as f32, v as f32, 0.0) * scale));
    // Evenly spaced points: the middle third of the line for the two bases that pass on the first and last point.
    for basis in [Basis::BSpline, Basis::CatmullRom] {
        assert!((basis.position(&ramp(3.0), 0.25, 0.5) - DVec3::new(3.75, 4.5, 0.0)).length() < 1e-12);
    }
    assert!((Basis::Bezier.position(&ramp(1.0), 0.25, 0.5) - DVec3::new(0.75, 1.5, 0.0)).length() < 1e-12);
    let mut coefficients = [[Vec3::ZERO; 4]; 4];
    coefficients[1][2] = Vec3::new(2.0, 0.0, 1.0);
    assert_eq!(Basis::Power.position(&coefficients, 0.5, 0.25), DVec3::new(2.0, 0.0, 1.0) * 0.5 * 0.0625);
}

#[test]
fn w78_23_normal_at_corners_drawn_together() {
    let mut cone = bump();
    cone.control[0] = [Vec3::new(1.5, 0.0, 0.0); 4];
    for u in [0.0, 0.3, 1.0] {
        assert!((cone.normal(u, 0.0).length() - 1.0).abs() < 1e-12);
        assert!(cone.normal(u, 0.0).dot(cone.normal(u, 0.02)) > 0.99);
    }
    for patch in &utah_teapot()[20..24] {
        assert!((patch.normal(0.4, 0.0) - DVec3::Z).length() < 0.01, "the knob's top is level");
    }
    for patch in &utah_teapot()[28..] {
        assert!((patch.normal(0.4, 0.0) - DVec3::NEG_Z).length() < 0.01, "the bottom's middle is level");
    }
    let nothing = Patch { control: [[Vec3::ONE; 4]; 4] };
    assert_eq!(nothing.normal(0.5, 0.5), DVec3::Z);
}

#[test]
fn the_teapot_as_published() {
    let pot = utah_teapot();
    assert_eq!(pot.len(), 32);
    let mesh = dice(&pot, &from_above(256));
    assert_eq!(mesh.check(), Ok(()));
    let (low, high) = mesh.bounds().expect("it has vertices");
    assert_eq!((low.y, high.y, low.z, high.z), (-2.0, 2.0, 0.0, 3.15));
    assert!((low.x + 3.0).abs() < 0.02 && high.x > 3.3 && high.x < 3.45, "handle {low}, spout {high}");
}

/// The rim's inner circle is the only border of rim, body and bottom; nothing else of the pot holds together with them.
#[test]
fn the_teapot_is_open_where_its_lid_rests() {
    let pot = utah_teapot();
    let vessel: Vec<Patch> = pot.iter().take(12).chain(&pot[28..]).copied().collect();
    let mesh = dice(&vessel, &from_above(128));
    let open = boundary(&mesh);
    assert!(!open.is_empty());
    let on_inner_rim = |at: &Vec3| at.z == 2.4 && (1.39..1.41).contains(&at.truncate().length());
    assert!(open.iter().flatten().all(on_inner_rim));
    assert_eq!(open.len() % 4, 0);
    assert!(!dice(&pot[20..28], &from_above(64)).is_closed());
    assert!(!dice(&pot, &from_above(64)).is_closed());
}

#[test]
fn w78_23_no_piece_larger_than_a_texel() {
    let pot = utah_teapot();
    let skew =
        View::orthographic(DVec3::new(5.0, -8.0, 9.0), DVec3::ZERO, DVec3::Z, 4.0, 0.0, 40.0, UVec2::new(160, 120))
            .expect("a valid view");
    for view in [from_above(200), skew] {
        let mesh = dice(&pot, &view);
        let longest = longest_side(&mesh, &view);
        assert!(longest <= 1.0, "{longest}");
        assert!(longest > 0.5, "pieces are needlessly small: {longest}");
    }
}

#[test]
fn w78_23_pieces_are_capped_behind_the_eye_and_for_huge_maps() {
    let inside = View::perspective(DVec3::new(1.5, 1.5, 0.3), DVec3::ZERO, DVec3::Y, 1.0, 0.1, 10.0, UVec2::splat(64))
        .expect("a valid view");
    for (view, side) in [(inside, 256), (from_above(32_768), MOST_PIECES)] {
        assert_eq!(dice(&[bump()], &view).triangles.len(), 2 * (side * side) as usize);
    }
}

#[test]
fn w78_23_what_a_view_does_not_see_is_hardly_cut_and_what_is_large_is_cut_to_texels() {
    let away = View::perspective(
        DVec3::new(1.5, 1.5, 9.0),
        DVec3::new(1.5, 1.5, 99.0),
        DVec3::Y,
        1.0,
        0.1,
        10.0,
        UVec2::splat(64),
    );
    assert_eq!(dice(&[bump()], &away.expect("a valid view")).triangles.len(), 2);
    let beside = View::orthographic(
        DVec3::new(20.0, 0.0, 9.0),
        DVec3::new(20.0, 0.0, 0.0),
        DVec3::Y,
        2.0,
        0.1,
        10.0,
        UVec2::splat(64),
    );
    assert_eq!(dice(&[bump()], &beside.expect("a valid view")).triangles.len(), 2);
    // Some 600 texels across: every piece's sides are within a texel.
    let view = from_above(700);
    let mesh = dice(&[bump()], &view);
    assert!(mesh.triangles.len() > 2 * 300 * 300);
    let texel = |at: Vec3| view.eye_to_texel(view.world_to_eye().transform_point3(at.as_dvec3()));
    let longest = (0..mesh.triangles.len()).map(|triangle| {
        let [a, b, _] = mesh.corners(triangle);
        texel(a).distance(texel(b))
    });
    assert!(longest.fold(0.0, f64::max) < 1.0 + std::f64::consts::SQRT_2);
}

#[test]
fn one_patch_is_one_surface_and_poles_lose_their_empty_triangles() {
    let mesh = dice(&utah_teapot(), &from_above(64));
    assert_eq!(mesh.surfaces.iter().max(), Some(&31));
    let areas = (0..mesh.triangles.len()).map(|triangle| {
        let [a, b, c] = mesh.corners(triangle);
        (a != b) && (b != c) && (c != a)
    });
    assert!(areas.into_iter().all(|distinct| distinct));
}

/// Edges by position that only one triangle has.
fn boundary(mesh: &Mesh) -> Vec<[Vec3; 2]> {
    let bits = |at: Vec3| at.to_array().map(f32::to_bits);
    let mut edges: Vec<_> = (0..mesh.triangles.len())
        .flat_map(|triangle| {
            let [a, b, c] = mesh.corners(triangle).map(bits);
            [[a, b], [b, c], [c, a]]
        })
        .map(|[a, b]| if a < b { [a, b] } else { [b, a] })
        .collect();
    edges.sort_unstable();
    let alone = edges.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).map(|same| same[0]);
    alone.map(|edge| edge.map(|at| Vec3::from_array(at.map(f32::from_bits)))).collect()
}

/// The triangles of one surface.
fn part(mesh: &Mesh, surface: u32) -> Mesh {
    let own = (0..mesh.triangles.len()).filter(|triangle| mesh.surfaces[*triangle] == surface);
    Mesh { triangles: own.map(|triangle| mesh.triangles[triangle]).collect(), ..mesh.clone() }
}

/// The longest side of a diced cell, in texels: edges of two triangles of which neither is a diagonal.
fn longest_side(mesh: &Mesh, view: &View) -> f64 {
    let texel = |at: Vec3| view.eye_to_texel(view.world_to_eye().transform_point3(at.as_dvec3()));
    let length = |a: DVec2, b: DVec2| a.distance(b);
    let sides = (0..mesh.triangles.len()).map(|triangle| {
        let [a, b, c] = mesh.corners(triangle).map(texel);
        // The longest of three may be a cell's diagonal; the other two never both are.
        let mut sides = [length(a, b), length(b, c), length(c, a)];
        sides.sort_by(f64::total_cmp);
        sides[1]
    });
    sides.fold(0.0, f64::max)
}

proptest! {
    #[test]
    fn w78_23_every_basis_becomes_bezier(control in points(), u in 0f64..=1.0, v in 0f64..=1.0) {
        for basis in BASES {
            let patch = Patch::from_basis(basis, control);
            let off = patch.position(u, v) - basis.position(&control, u, v);
            prop_assert!(off.length() < 2e-5, "{basis:?} {off}");
        }
    }

    #[test]
    fn normals_are_the_derivatives_cross_product(control in points(), u in 0.1f64..0.9, v in 0.1f64..0.9) {
        let patch = Patch { control };
        let h = 1e-5;
        let along_u = patch.position(u + h, v) - patch.position(u - h, v);
        let along_v = patch.position(u, v + h) - patch.position(u, v - h);
        let cross = along_u.cross(along_v) / (4.0 * h * h);
        prop_assume!(cross.length() > 0.01);
        prop_assert!((cross.normalize() - patch.normal(u, v)).length() < 1e-4);
    }

    /// Two patches that share a border in any of eight relative positions meet without a gap.
    #[test]
    fn diced_neighbours_are_watertight(left in points(), mut right in points(), position in 0usize..8, size in 4u32..48) {
        for (row, shared) in right.iter_mut().zip(left) {
            row[0] = shared[3];
        }
        if position & 1 != 0 {
            right.reverse();
        }
        if position & 2 != 0 {
            for row in &mut right {
                row.reverse();
            }
        }
        if position & 4 != 0 {
            right = std::array::from_fn(|i| std::array::from_fn(|j| right[j][i]));
        }
        let whole = dice(&[Patch { control: left }, Patch { control: right }], &from_above(size));
        let sides = [0, 1].map(|surface| part(&whole, surface));
        let [of_left, of_right] = sides.each_ref().map(boundary);
        let shared = of_left.iter().filter(|edge| of_right.contains(edge)).count();
        for (side, open) in sides.iter().zip([of_left.len(), of_right.len()]) {
            // 2·a·b triangles and 2·(a + b) border edges; the neighbour must have one whole side of them.
            prop_assert_eq!(shared * (open / 2 - shared), side.triangles.len() / 2);
        }
    }
}
