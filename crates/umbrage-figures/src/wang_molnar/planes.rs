//! Wang & Molnar 1994, Figure 8: virtual samples on the tangent plane.

use crate::figure::{Context, Figure, Paper};
use crate::stage::slices::{self, Slice, disc, rectangle, stored, turned};
use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use umbrage_bake::bake;
use umbrage_depth::{DepthMap, First, Second};
use umbrage_plane::{DepthPlane, Kind, Receiver, SurfacePoint, TexelRect, View};
use umbrage_raster::{Bins, Cull, Triangle};
use umbrage_report::diagram::{Diagram, Ink, Mark};
use umbrage_report::{Made, Measure, Table};
use umbrage_sample::Key;

pub const F8: Figure = Figure {
    id: "WM94-F8",
    paper: Paper::WangMolnar94,
    title: "Virtual samples on the tangent plane",
    claim: "The plane through a point can be evaluated at the map's own samples; for a flat surface its depth there is exact.",
    look: "the samples on the tangent plane: they lie on the surface exactly where the map has its own.",
    make: virtual_samples,
};

/// The light of V35: at (0, 10, 0), looking down −y, 90° wide.
pub fn lamp(kind: Kind) -> anyhow::Result<View> {
    let fov = 90f64.to_radians();
    let view = View::perspective(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, fov, 1.0, 100.0, UVec2::splat(64))?;
    Ok(view.with_kind(kind))
}

/// Point and normal of V35 (not unit).
pub const POINT: DVec3 = DVec3::new(2.0, 1.0, -3.0);
/// See [`POINT`].
const NORMAL: DVec3 = DVec3::new(0.2, 1.0, 0.3);

/// Texel, z_s and ζ of V36.
const V36: [([i32; 2], f64, f64); 5] = [
    ([38, 20], 0.896_630_781_5, 8.901_903_367_5),
    ([39, 20], 0.897_295_321_6, 8.954_344_624_4),
    ([39, 21], 0.898_292_131_8, 9.034_175_334_3),
    ([40, 21], 0.898_956_672_0, 9.088_191_330_3),
    ([47, 21], 0.903_608_453_0, 9.485_179_407_2),
];

/// A plane's depth at a texel's centre: z_s in a screen map, ζ in an axial one; f64, unrounded.
fn depth_at(view: &View, point: DVec3, normal: DVec3, texel: IVec2) -> f64 {
    let eye = view.world_to_eye();
    let plane = view.affine(eye.transform_point3(point), eye.transform_vector3(normal));
    let key = plane.map_or(f64::NAN, |plane| plane.at(texel.as_dvec2() + 0.5));
    if view.kind() == Kind::Screen { key } else { -1.0 / key }
}

fn ulps(a: f32, b: f32) -> f64 {
    if a == b { 0.0 } else { f64::from(a.to_bits().abs_diff(b.to_bits())) }
}

/// How far virtual samples lie from what pass 1 stores of the same plane: with the raster's own plane and with a point and normal
/// rounded to f32, both in ulp, and the latter as a fraction of the tolerance of WM94-12.
#[derive(Clone, Copy, Default)]
struct Apart {
    own: f64,
    rounded: f64,
    of_tolerance: f64,
    compared: u32,
}

/// A triangle that covers all of a plane that the view sees, and a point of it at a texel position.
fn triangle(view: &View, key: Key, i: u32) -> Option<[Vec3; 3]> {
    let place = |dim| f64::from(key.signed(i, dim));
    let through = DVec3::new(place(0) * 3.0, 1.0 + 2.0 * place(1), place(2) * 3.0);
    let normal = DVec3::new(place(3), place(4), place(5)).try_normalize()?;
    if normal.dot(view.toward_eye(through)).abs() < 0.1 {
        return None;
    }
    let across = normal.any_orthonormal_vector() * 6.0;
    let along = normal.cross(across);
    Some([through - across - along, through + across - along, through + along * 1.7].map(DVec3::as_vec3))
}

fn apart(view: &View, key: Key, planes: u32) -> Apart {
    let mut worst = Apart::default();
    for i in 0..planes {
        let Some(corners) = triangle(view, key, i) else { continue };
        let sheet = Triangle::new(corners, 0, true);
        let window = TexelRect::of_size(view.size());
        let Some(facet) = Bins::new(view, window, Cull::None, [sheet]).facet(0) else { continue };
        let map = bake(view, [sheet], &First, Cull::None).map;
        let drawn = DepthPlane { key: facet.plane, decode: view.decode() };
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a).normalize();
        for texel in window.texels() {
            let depth = map.depth(texel);
            if !depth.is_finite() {
                continue;
            }
            let at = view.sampling().position(texel);
            worst.own = worst.own.max(ulps(drawn.at(at), depth));
            worst.compared += 1;
            // A camera's sample two texels away, as shading hands it over.
            let beside = at + DVec2::new(1.3, -0.6);
            let world = view.world_at(beside, facet.plane.at(beside));
            let point = SurfacePoint::at(world.as_vec3(), normal.as_vec3());
            let Ok(seen) = view.receiver(&point) else { continue };
            let found = seen.plane(view).at(at);
            if !(0.0..=100.0).contains(&found) {
                continue;
            }
            worst.rounded = worst.rounded.max(ulps(found, depth));
            worst.of_tolerance = worst.of_tolerance.max(f64::from((found - depth).abs() / tolerance(view, &seen)));
        }
    }
    worst
}

/// What WM94-12 allows: 4·10⁻⁶ of z_s, 10⁻⁶ of ζ, over |N·L|.
fn tolerance(view: &View, seen: &Receiver) -> f32 {
    let rounding = if view.kind() == Kind::Screen { 4e-6 } else { 1e-6 * seen.depth };
    rounding / seen.facing.abs()
}

fn virtual_samples(cx: &Context) -> anyhow::Result<Made> {
    let (screen, axial) = (lamp(Kind::Screen)?, lamp(Kind::Axial)?);
    let mut worst = [0.0f64; 2];
    let mut rows = Vec::new();
    for (texel, z_s, zeta) in V36 {
        let found = [&screen, &axial].map(|view| depth_at(view, POINT, NORMAL, texel.into()));
        worst = [worst[0].max((found[0] - z_s).abs()), worst[1].max((found[1] - zeta).abs())];
        let texel = format!("({}, {})", texel[0], texel[1]);
        rows.push(vec![
            texel,
            format!("{:.10}", found[0]),
            format!("{z_s:.10}"),
            format!("{:.10}", found[1]),
            format!("{zeta:.10}"),
        ]);
    }
    let at = |x, y| depth_at(&screen, POINT, NORMAL, IVec2::new(x, y));
    let steps = [at(40, 21) - at(39, 21), at(39, 21) - at(39, 20)];
    let planes = cx.pick(400, 60);
    let key = Key::new(cx.seed, 0, 0);
    let (in_screen, in_axial) = (apart(&screen, key, planes), apart(&axial, key, planes));
    let (diagram, bent) = tangent()?;
    let head = ["texel", "z_s", "V36", "ζ", "V36 "].map(String::from).to_vec();
    Ok(Made {
        plots: vec![("plane".into(), diagram)],
        tables: vec![Table { name: "V36".into(), head, rows }],
        measures: vec![
            Measure::at_most("z_s: largest difference from V36's ten digits", worst[0], "z_s", 5.1e-11),
            Measure::at_most("ζ: largest difference from V36's ten digits", worst[1], "world units", 5.1e-11),
            Measure::at_most("step of z_s to the right less V36's", (steps[0] - 6.645_401_4e-4).abs(), "z_s", 6e-12),
            Measure::at_most("step of z_s downward less V36's", (steps[1] - 9.968_102_1e-4).abs(), "z_s", 6e-12),
            Measure::exactly("random planes, ζ: virtual sample less stored depth", in_axial.own, "ulp", 0.0),
            Measure::exactly("random planes, z_s: virtual sample less stored depth", in_screen.own, "ulp", 0.0),
            Measure::info("depths compared", f64::from(in_axial.compared + in_screen.compared), "texels"),
            Measure::info("the same from a point and normal rounded to f32, ζ", in_axial.rounded, "ulp"),
            Measure::info("the same from a point and normal rounded to f32, z_s", in_screen.rounded, "ulp"),
            Measure::at_most("rounded, ζ: of the tolerance for planar sheets", in_axial.of_tolerance, "share", 1.0),
            Measure::at_most("rounded, z_s: of the tolerance for planar sheets", in_screen.of_tolerance, "share", 1.0),
            Measure::exactly("flat surface as drawn: virtual samples off the surface", bent[1], "world units", 0.0),
            Measure::at_least("round surface as drawn: virtual samples off the surface", bent[0], "world units", 0.01),
        ],
        note: "Planes and maps share one formula, so that the raster's own plane gives the stored bits. On a round surface the tangent plane lies nearer to the \
            \
            \
            \
            \
            \
            \
            light than the surface."
            .into(),
        ..Made::default()
    })
}

/// A round and a flat solid in a slice, each with a sample and its virtual samples; and how far these lie off the surface at most.
fn tangent() -> anyhow::Result<(String, [f64; 2])> {
    let (centre, radius) = (DVec2::new(-8.0, -3.0), 12.0);
    let board = turned(&rectangle([10.0, -4.0], [30.0, 3.0]), 24.0);
    let light = slices::sun(DVec2::Y, DVec2::new(9.0, 0.0), 30.0, 31)?;
    let slice = Slice::new(
        "tangent",
        vec![disc(centre.into(), radius), board.clone()],
        &light,
        &slices::eye([60.0, 40.0], [0.0, 0.0], 40.0, 9)?,
    )?;
    let map = slice.bake(&Second);
    let first = slice.bake(&First);
    let texel = 60.0 / f64::from(light.size().x);
    let columns: Vec<f64> = stored(&map).iter().enumerate().map(|(i, _)| -21.0 + (i as f64 + 0.5) * texel).collect();
    let mut diagram = slice.outlined(Diagram::new(
        "One row of a real map of second surfaces",
        DVec2::new(-22.0, -18.0),
        DVec2::new(34.0, 20.0),
    ));
    diagram = diagram.pieces(0.8, Ink::Faint, columns.iter().map(|&x| [DVec2::new(x, -18.0), DVec2::new(x, 20.0)]));
    let top = (board[2] + board[3]) * 0.5;
    let along = DVec2::from_angle(24f64.to_radians());
    let round = centre + DVec2::from_angle(0.78) * radius;
    let samples = [(round, (round - centre).normalize()), (top + along * 1.1, along.perp())];
    let mut off = [0.0f64; 2];
    for (index, (at, normal)) in samples.into_iter().enumerate() {
        let point = SurfacePoint::at(slices::world(at).as_vec3(), slices::world(normal).as_vec3());
        let seen = light.receiver(&point).map_err(|place| anyhow::anyhow!("the sample is {place:?}"))?;
        let plane = seen.plane(&light);
        let column = seen.footprint.centre.x.floor() as i32;
        let row = light.size().y as i32 / 2;
        let near: Vec<IVec2> = (-2..=2).map(|step| IVec2::new(column + step, row)).collect();
        let virtual_at = |texel: &IVec2| {
            let position = texel.as_dvec2() + 0.5;
            light.world_at(position, plane.key.at(position)).truncate()
        };
        let places: Vec<DVec2> = near.iter().map(virtual_at).collect();
        for texel in &near[1..4] {
            let gap = f64::from((plane.at(texel.as_dvec2() + 0.5) - first.depth(*texel)).abs());
            // Depths near 300 are rounded to 3·10⁻⁵.
            off[index] = off[index].max(if gap < 1e-4 { 0.0 } else { gap });
        }
        let tangent = normal.perp() * 8.0;
        diagram = diagram
            .draw(Mark::Dashes, Ink::Series(3), &[at - tangent, at + tangent])
            .draw(Mark::Dots(4.5), Ink::Series(1), &places)
            .draw(Mark::Rings(6.0), Ink::Plain, &[at])
            .draw(Mark::Dots(2.0), Ink::Plain, &[at]);
    }
    let diagram = diagram
        .key(Mark::Rings(6.0), Ink::Plain, "camera's sample")
        .key(Mark::Dashes, Ink::Series(3), "its tangent plane")
        .key(Mark::Dots(4.5), Ink::Series(1), "virtual samples")
        .named(Mark::Dots(4.0), Ink::Series(2), &stored(&map), "second surfaces that the map stores")
        .arrow(Ink::Plain, DVec2::new(-20.6, 19.0), DVec2::new(-20.6, 13.0))
        .text_from(Ink::Plain, DVec2::new(-19.8, 17.5), "light");
    Ok((diagram.svg(), off))
}
