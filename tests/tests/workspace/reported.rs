//! What people report about shadow maps and depth files, each situation rebuilt small, with the right answer beside what is found:
//! `cargo test -p umbrage-tests reported -- --nocapture` prints the table.

use glam::{DMat3, DVec3, UVec2, Vec3};
use std::fmt::Display;
use umbrage_depth::{Raw, Storage};
use umbrage_io::{DEFAULT_BUDGET, Paged, decode_shadow_map, encode_shadow_map, write_shadow_map};
use umbrage_oracle::{Geometry, RayCast, diagnose_recipe};
use umbrage_plane::{Kind, SurfacePoint, View, cube_views};
use umbrage_recipe::Recipe;
use umbrage_render::{exposed_map, light_map};
use umbrage_sample::Key;
use umbrage_scene::tree::{Cone, Tree};
use umbrage_scene::{Light, Material, Mesh, Object, Scene, Shape, gallery};
use umbrage_shadow::Shadow;

/// One row: where it belongs, what is rebuilt, and the right answer beside the one found.
struct Row {
    kind: &'static str,
    situation: String,
    right: String,
    found: String,
}

#[derive(Default)]
struct Table(Vec<Row>);

impl Table {
    fn row(&mut self, kind: &'static str, situation: impl Into<String>, right: impl Display, found: impl Display) {
        let (right, found) = (right.to_string(), found.to_string());
        self.0.push(Row { kind, situation: situation.into(), right, found });
    }
}

fn recipe(text: &str) -> Recipe {
    text.parse().unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn matt(name: &str, mesh: Mesh, solid: bool) -> Object {
    let object = Object::solid(name, mesh, Material::matt(Vec3::ONE));
    if solid { object } else { Object::two_sided(name, object.shape, object.material) }
}

/// A sheet y = `height`, `half` to each side of the axis.
fn sheet(name: &str, half: f32, height: f32) -> Object {
    let corners = [(-half, half), (half, half), (half, -half), (-half, -half)];
    matt(name, Mesh::sheet(corners.map(|(x, z)| Vec3::new(x, height, z)), 1), false)
}

fn cuboid(name: &str, low: [f32; 3], high: [f32; 3]) -> Object {
    matt(name, Mesh::cuboid(Vec3::from(low), Vec3::from(high)), true)
}

fn scene(objects: Vec<Object>, view: &View) -> Scene {
    let mut scene = gallery::sphere_plane();
    (scene.objects, scene.origin) = (objects, DVec3::ZERO);
    scene.lights.truncate(1);
    scene.lights[0] = Light { view: *view, tree: None, ..scene.lights[0].clone() };
    scene
}

fn sun(toward: DVec3, half: f64, side: u32) -> View {
    let eye = toward.normalize() * 40.0;
    let up = if toward.x == 0.0 && toward.z == 0.0 { DVec3::X } else { DVec3::Y };
    View::orthographic(eye, DVec3::ZERO, up, half, 1.0, 100.0, UVec2::splat(side)).expect("a sun")
}

/// Points of the plane y = `height`, off every seam and texel border.
fn ground(half: f64, height: f64) -> Vec<SurfacePoint> {
    let at = |index: u32, axis: u32| f64::from(Key::new(7, 0, 0).signed(index, axis)) * half;
    let point = |index: u32| SurfacePoint {
        region: index,
        ..SurfacePoint::at(DVec3::new(at(index, 0), height, at(index, 1)), Vec3::Y)
    };
    (0..6400).map(point).collect()
}

fn asked(shadow: &dyn Shadow, points: &[SurfacePoint]) -> Vec<f32> {
    let mut fractions = vec![0.0; points.len()];
    shadow.fractions(points, Key::new(3, 0, 0), &mut fractions);
    fractions
}

fn mapped(scene: &Scene, text: &str) -> Box<dyn Shadow> {
    let recipe = recipe(text);
    recipe.bind(light_map(&recipe, scene, &scene.lights[0].view), Storage::Tiled).expect("its own map")
}

/// False shadow and false light of a recipe, in % of the points whose surroundings, `margin` to each side, truth finds all lit or all dark.
fn faults(scene: &Scene, text: &str, points: &[SurfacePoint], margin: f64) -> (f64, f64) {
    let light = &scene.lights[0].view;
    let geometry = Geometry::new(scene, light);
    let truth = RayCast::new(&geometry, light);
    let found = asked(&*mapped(scene, text), points);
    let (mut judged, mut shadow, mut lit) = (0, 0, 0);
    for (point, found) in points.iter().zip(found) {
        let right = truth.at(point);
        let around = [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z].map(|way| {
            truth.at(&SurfacePoint {
                region: point.region,
                ..SurfacePoint::at(point.position + way * margin, point.normal)
            })
        });
        if around.iter().any(|other| *other != right) {
            continue;
        }
        judged += 1;
        shadow += usize::from(right < 0.05 && found > 0.5);
        lit += usize::from(right > 0.95 && found < 0.5);
    }
    let percent = |count: usize| (1000.0 * count as f64 / f64::from(judged.max(1))).round() / 10.0;
    (percent(shadow), percent(lit))
}

fn warnings(scene: &Scene, text: &str) -> Vec<String> {
    let found = diagnose_recipe(scene, &scene.lights[0], &recipe(text));
    let mut names: Vec<_> =
        found.iter().map(|found| format!("{found:?}").split(' ').next().unwrap_or_default().to_string()).collect();
    names.dedup();
    names
}

fn warned(scene: &Scene, text: &str, name: &str) -> String {
    let all = warnings(scene, text);
    if all.iter().any(|found| found == name) { name.into() } else { format!("{all:?}") }
}

const NONE: &str = "0 and 0 % false";

fn percent((shadow, lit): (f64, f64)) -> String {
    format!("{shadow} and {lit} % false")
}

/// Truth far away, beside something large, and with the light in a surface.
fn truth(table: &mut Table) {
    for away in [0.0f32, 4_194_304.0] {
        for large in [false, true] {
            let mut objects = vec![cuboid("box", [away - 0.5, 0.0, -0.5], [away + 0.5, 1.0, 0.5])];
            if large {
                objects.push(sheet("large", 1e7, -1e6));
            }
            let view = sun(DVec3::new(1.0, 0.25, 0.0), 9.0, 64);
            let scene = scene(objects, &view);
            let geometry = Geometry::new(&scene, &view);
            let ray = RayCast::everywhere(&geometry, DVec3::new(1.0, 0.25, 0.0).extend(0.0));
            let at = |x: f32| ray.at(&SurfacePoint::at(DVec3::new(f64::from(away + x), 0.0, 0.0), Vec3::Y));
            let beside = if large { ", beside a sheet of 10⁷ units" } else { "" };
            table.row(
                "1 truth",
                format!("a box at x = {away}{beside}: behind it, before it"),
                "1 0",
                format!("{} {}", at(-1.5), at(1.5)),
            );
        }
    }
    let walls: Vec<_> =
        (0..24).map(|i| SurfacePoint::at(DVec3::new(5.0, -1.0 - f64::from(i) / 10.0, 0.3), Vec3::NEG_X)).collect();
    let views = cube_views(DVec3::ZERO, 0.1, 99.0, 64).expect("a cube");
    let held = scene(vec![sheet("sheet", 9.0, 0.0)], &views[0]);
    let geometry = Geometry::new(&held, &views[0]);
    let ray = RayCast::everywhere(&geometry, DVec3::ZERO.extend(1.0));
    let dark = |fractions: Vec<f32>| fractions.iter().filter(|dark| **dark > 0.0).count();
    table.row("2 light in a surface", "truth on a wall of 24 points, dark", 0, dark(asked(&ray, &walls)));
    for text in ["auto", "reeves87", "woo92", "wang-molnar94"] {
        table.row(
            "2 light in a surface",
            format!("{text} on the same wall, dark"),
            0,
            dark(asked(&*mapped(&held, text), &walls)),
        );
    }
}

/// Framing, and what it must not change.
fn framing(table: &mut Table) {
    let bar = || vec![cuboid("bar", [-6.0, 0.0, -0.5], [6.0, 1.0, 0.5])];
    let camera = View::perspective(DVec3::new(3.0, 20.0, 9.0), DVec3::ZERO, DVec3::Y, 1.2, 0.1, 99.0, UVec2::splat(8));
    for (name, perspective) in [("sun", false), ("spot", true)] {
        let size = UVec2::new(256, 512);
        let (eye, at, up) = (DVec3::Y * 20.0, DVec3::ZERO, DVec3::NEG_Z);
        let view = if perspective {
            View::perspective(eye, at, up, 1.0, 0.1, 99.0, size)
        } else {
            View::orthographic(eye, at, up, 9.0, 0.1, 99.0, size)
        };
        let mut scene = scene(bar(), &view.expect("a view"));
        scene.camera = camera.expect("a camera");
        let framed = scene.framed(&scene.lights[0]).expect("framed").view;
        let outside = scene.casters_outside(&framed).len();
        let seen =
            scene.hull(&scene.objects[0]).map(|at| framed.eye_to_texel(framed.world_to_eye().transform_point3(at)));
        let (low, high) = seen.fold((f64::INFINITY, 0.0f64), |(low, high), at| (low.min(at.x), high.max(at.x)));
        let wide = (high - low) / f64::from(size.x) > 0.95;
        table.row(
            "3 framing",
            format!("a bar under a {name} with 256 × 512 texels: casters outside, width used"),
            "0, over 95 %",
            format!("{outside}, {} 95 %", if wide { "over" } else { "under" }),
        );
    }
    let mut aimed = scene(
        bar(),
        &View::perspective(DVec3::Y * 20.0, DVec3::X * 4.0, DVec3::NEG_Z, 1.0, 0.1, 99.0, UVec2::splat(64))
            .expect("a spot"),
    );
    aimed.camera = camera.expect("a camera");
    let cone = Cone { inner_deg: 6.0, outer_deg: 28.0 };
    let light = aimed.lights[0].clone().with_tree(Tree::Cone(cone));
    let framed = aimed.framed(&light).expect("framed");
    let apart = (0..100).filter(|i| {
        let at = DVec3::new(f64::from(i % 10) - 5.0, 1.0, f64::from(i / 10) * 0.1);
        light.arriving(at, Vec3::ONE).0 != framed.arriving(at, Vec3::ONE).0
    });
    table.row("4 framing", "a spot with a falling-off cone: points of 100 whose light changes", 0, apart.count());
}

/// Suns that stand elsewhere along their axis.
fn parallel(table: &mut Table) {
    for text in ["auto", "reeves87", "woo92", "wang-molnar94", "burley", "burley,light=0.05", "fernando", "williams78"]
    {
        let answers = |back: f64| {
            let view = View::orthographic(
                DVec3::new(1.0, 2.0, 0.5) * (10.0 + back),
                DVec3::new(1.0, 2.0, 0.5) * -1e3,
                DVec3::Z,
                4.0,
                (4.0 + back) * 5.25f64.sqrt(),
                (16.0 + back) * 5.25f64.sqrt(),
                UVec2::splat(256),
            );
            let scene = scene(
                vec![sheet("floor", 3.0, 0.0), cuboid("box", [-0.5, 0.5, -0.5], [0.5, 1.5, 0.5])],
                &view.expect("a sun"),
            );
            asked(&*mapped(&scene, text), &ground(2.5, 0.0))
        };
        let here = answers(0.0);
        let apart = [-10.5, -16.0, 48.0]
            .into_iter()
            .map(|back| answers(back).iter().zip(&here).filter(|(a, b)| (**a - **b).abs() > 0.13).count());
        // A sample on a silhouette may fall to either side.
        let most = apart.max().unwrap_or(0);
        table.row("5 parallel light", format!("{text}: of 6,400 points, over 1 % change when the eye slides"), "no", {
            if most > 64 { format!("{most}") } else { "no".into() }
        });
    }
}

/// Ranges that floats are too coarse for.
fn resolution(table: &mut Table) {
    let objects = || vec![sheet("floor", 9.0, 0.0), cuboid("box", [-1.0, 1.0, -1.0], [1.0, 2.0, 1.0])];
    let far = |kind: Option<Kind>| {
        let eye = DVec3::new(0.6, 1.0, 0.3) * 1e7;
        let distance = eye.length();
        let view =
            View::perspective(eye, DVec3::ZERO, DVec3::X, 2e-6, distance - 20.0, distance + 20.0, UVec2::splat(512));
        let view = view.expect("a spot");
        scene(objects(), &kind.map_or(view, |kind| view.with_kind(kind)))
    };
    for text in ["auto", "reeves87,bias=0.1", "woo92", "wang-molnar94"] {
        let (scene, points) = (far(None), ground(4.0, 0.0));
        table.row(
            "6 resolution",
            format!("{text}, from 10⁷ units away through a range of 40"),
            NONE,
            percent(faults(&scene, text, &points, 0.3)),
        );
        table.row(
            "6 resolution",
            format!("{text}, the same in axial depth"),
            "CoarseDepth",
            warned(&far(Some(Kind::Axial)), text, "CoarseDepth"),
        );
    }
    let near = |kind: Option<Kind>| {
        let view =
            View::perspective(DVec3::new(4.0, 30.0, 2.0), DVec3::ZERO, DVec3::X, 0.6, 1e-4, 1e6, UVec2::splat(512));
        let view = view.expect("a spot");
        scene(objects(), &kind.map_or(view, |kind| view.with_kind(kind)))
    };
    table.row(
        "6 resolution",
        "reeves87,bias=0.1, near 10⁻⁴ and far 10⁶",
        NONE,
        percent(faults(&near(None), "reeves87,bias=0.1", &ground(4.0, 0.0), 0.3)),
    );
    table.row(
        "6 resolution",
        "the same in screen depth",
        "CoarseDepth",
        warned(&near(Some(Kind::Screen)), "reeves87,bias=0.1", "CoarseDepth"),
    );
}

/// Regions in perspective, and biases in other units.
fn places_and_biases(table: &mut Table) {
    let view = View::perspective(
        DVec3::new(7.0, 9.0, 3.0),
        DVec3::ZERO,
        DVec3::Z,
        70f64.to_radians(),
        1.0,
        60.0,
        UVec2::splat(512),
    );
    let empty = scene(vec![sheet("floor", 9.0, 0.0)], &view.expect("a spot"));
    for side in [0.15, 0.3, 0.6] {
        let squares: Vec<_> = ground(4.0, 0.0)
            .into_iter()
            .map(|point| {
                let corner = |x: f64, z: f64| point.position + DVec3::new(x, 0.0, z) * (0.5 * side);
                point.with_corners([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)])
            })
            .collect();
        let dark = asked(&*mapped(&empty, "wang-molnar94"), &squares).iter().filter(|dark| **dark > 0.0).count();
        table.row(
            "7 point and footprint",
            format!("wang-molnar94, empty sheet, squares of {side}: dark of 6,400"),
            0,
            dark,
        );
    }
    let box_over = |scale: f64, kind: Kind| {
        let view =
            View::perspective(DVec3::new(4.0, 9.0, 2.0), DVec3::ZERO, DVec3::Z, 0.7, 5.0, 20.0, UVec2::splat(512));
        let objects = vec![sheet("floor", 4.0, 0.0), cuboid("box", [-1.0, 0.5, -1.0], [1.0, 1.5, 1.0])];
        scene(objects, &view.expect("a spot").with_kind(kind)).scaled(scale).expect("another size")
    };
    table.row(
        "8 bias",
        "reeves87, a scene times 10⁻⁴",
        "LargeBias",
        warned(&box_over(1e-4, Kind::Axial), "reeves87", "LargeBias"),
    );
    for scale in [1.0, 1e-6] {
        for kind in [Kind::Axial, Kind::Radial, Kind::Screen] {
            let points: Vec<_> = ground(2.0, 0.0)
                .into_iter()
                .map(|point| SurfacePoint { position: point.position * scale, ..point })
                .collect();
            let scene = box_over(scale, kind);
            let (shadow, lit) = faults(&scene, "williams78,bias=0.01m", &points, 0.1 * scale);
            let found = if shadow + lit <= 0.3 { "at most 0.3 % false".into() } else { percent((shadow, lit)) };
            table.row(
                "8 bias",
                format!("williams78,bias=0.01m over a map of {kind:?} depth, size {scale}"),
                "at most 0.3 % false",
                found,
            );
        }
    }
}

/// Sheets on sheets, what is drawn twice, and boxes that touch.
fn stacks(table: &mut Table) {
    let view = sun(DVec3::new(1.0, 1.0, 0.0), 12.0, 512);
    let rug = scene(vec![sheet("floor", 6.0, 0.0), sheet("rug", 6.0, 0.001)], &view);
    table.row("9 stacks", "woo92, a rug 1 mm over a floor", "Stacked", warned(&rug, "woo92", "Stacked"));
    table.row(
        "9 stacks",
        "wang-molnar94, the same rug: on it",
        NONE,
        percent(faults(&rug, "wang-molnar94", &ground(5.0, f64::from(0.001f32)), 0.1)),
    );
    let twice = scene(vec![sheet("floor", 6.0, 0.0), sheet("again", 6.0, 0.0)], &view);
    table.row("9 stacks", "woo92, a floor drawn twice", NONE, percent(faults(&twice, "woo92", &ground(5.0, 0.0), 0.1)));
    table.row("9 stacks", "woo92, a floor drawn twice: warnings", "[]", format!("{:?}", warnings(&twice, "woo92")));
    for text in ["woo92,same=object", "woo92,same=surface,sub-samples=2"] {
        table.row("9 stacks", format!("{text}, a floor drawn twice"), "Stacked", warned(&twice, text, "Stacked"));
    }
    let boxes = || ["box", "again"].map(|name| cuboid(name, [-2.0, -1.0, -2.0], [2.0, 0.0, 2.0])).to_vec();
    table.row(
        "9 stacks",
        "woo92,same=object, a box drawn twice",
        "Stacked",
        warned(&scene(boxes(), &view), "woo92,same=object", "Stacked"),
    );
    let flush = (0..36).map(|i| {
        let (x, z) = ((i % 6) as f32 * 2.0 - 6.0, (i / 6) as f32 * 2.0 - 6.0);
        cuboid(&format!("tile {i}"), [x, -1.0, z], [x + 2.0, 0.0, z + 2.0])
    });
    let flush = scene(flush.collect(), &view);
    table.row("9 stacks", "woo92, a floor of 36 flush boxes", "Stacked", warned(&flush, "woo92", "Stacked"));
    table.row(
        "9 stacks",
        "reeves87,bias=3t, the same floor",
        NONE,
        percent(faults(&flush, "reeves87,bias=3t", &ground(5.0, 0.0), 0.1)),
    );
    let refused = "woo92,sub-samples=2".parse::<Recipe>().expect_err("refused").to_string();
    table.row(
        "9 stacks",
        "woo92,sub-samples=2",
        "same refused",
        format!("{} refused", refused.split(' ').next().unwrap_or("")),
    );
}

/// Coarse texels, cut shells, and damaged files.
fn maps_and_files(table: &mut Table) {
    let view =
        View::perspective(DVec3::Y * 9.0, DVec3::ZERO, DVec3::X, 179.9f64.to_radians(), 0.1, 60.0, UVec2::splat(1024));
    let wide = scene(
        vec![sheet("floor", 9.0, 0.0), cuboid("box", [-0.5, 1.0, -0.5], [0.5, 2.0, 0.5])],
        &view.expect("a spot"),
    );
    table.row(
        "10 coarse texels",
        "reeves87, a spot of 179.9° at 1024²",
        "CoarseTexels",
        warned(&wide, "reeves87", "CoarseTexels"),
    );

    let lamp =
        View::perspective(DVec3::Y * 9.0, DVec3::ZERO, DVec3::X, 1.0, 1.0, 60.0, UVec2::splat(64)).expect("a lamp");
    let foreign = |depths: Vec<f32>| {
        let mut bytes = encode_shadow_map(&Raw::new(lamp, depths).expect("a map")).expect("written");
        // Without our name, text and digest it is another maker's.
        for word in ["umbrage view 1", "\0umbrage", "digest="] {
            let at = bytes.windows(word.len()).position(|bytes| bytes == word.as_bytes());
            if let Some(at) = at {
                let first = word.bytes().position(|byte| byte == b'u').unwrap_or(0);
                bytes[at + first] = b'U';
            }
        }
        bytes
    };
    let read = |depth: f32| {
        let mut depths = vec![8.5; 64 * 64];
        depths[70] = depth;
        match decode_shadow_map(&foreign(depths), DEFAULT_BUDGET) {
            Ok(map) => format!("read as {}", map.depths()[70]),
            Err(fault) => format!("{} is {}", fault.field, fault.value),
        }
    };
    for depth in [0.0f32, -1.0] {
        table.row(
            "11 files",
            format!("{depth} as background in another maker's file"),
            format!("channel Z at texel 6, 1 is {depth}"),
            read(depth),
        );
    }
    table.row("11 files", "a surface at the near plane in another maker's file", "read as 1", read(1.0));
    let path = std::path::PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("reported.exr");
    let depths: Vec<f32> = (0..2048 * 2048).map(|i| 2.0 + (i % 977) as f32).collect();
    let large = Raw::new(lamp.with_size(UVec2::splat(2048)).expect("larger"), depths).expect("a map");
    write_shadow_map(&path, &large).expect("written");
    let (paged, handle) = Paged::open(&path, 16).expect("opened");
    let right = (0..4000u32).filter(|i| {
        let at = glam::IVec2::new((i * 37 % 2048) as i32, (i * 91 % 2048) as i32);
        umbrage_depth::DepthMap::depth(&paged, at) == umbrage_depth::DepthMap::depth(&large, at)
    });
    table.row("11 files", "2048² by pages, 16 of them: look-ups of 4,000 that are right, pages kept", "4000, 16", {
        format!("{}, {}", right.count(), handle.resident_pages())
    });
    let _ = std::fs::remove_file(&path);

    for (half, cut) in [(0.3f32, false), (5e-4, true)] {
        let shell = cuboid("bulb", [-half, 9.0 - half, -half], [half, 9.0 + half, half]);
        let inside = scene(vec![sheet("floor", 9.0, 0.0), shell], &lamp);
        let found = diagnose_recipe(&inside, &inside.lights[0], &recipe("reeves87"));
        let said =
            found.iter().map(ToString::to_string).find(|line| line.contains("stands inside")).unwrap_or_default();
        let said = if said.contains("cuts a hole") {
            "cut"
        } else if said.is_empty() {
            "nothing"
        } else {
            "whole"
        };
        let (_, stats) = exposed_map(&recipe("reeves87"), &[&inside], &lamp);
        table.row(
            "12 triangles",
            format!("a lamp in a closed shell of {half}: the shell, triangles cut off"),
            format!("{}, {cut}", if cut { "cut" } else { "whole" }),
            format!("{said}, {}", stats.too_near > 0),
        );
    }
}

/// Ordinary scenes that trip other programs.
fn meshes(table: &mut Table) {
    let light = |toward: DVec3| sun(toward, 6.0, 512);
    let over = |mesh: Mesh, view: View| scene(vec![sheet("floor", 5.0, 0.0), matt("thing", mesh, true)], &view);
    let turned = |by: DMat3| {
        let mut mesh = Mesh::cuboid(Vec3::new(-1.0, 1.0, -1.0), Vec3::new(1.0, 2.0, 1.0));
        for at in &mut mesh.positions {
            *at = (by * at.as_dvec3()).as_vec3();
        }
        if by.determinant() < 0.0 {
            for corners in &mut mesh.triangles {
                corners.swap(1, 2);
            }
        }
        mesh
    };
    let shear = DMat3::from_cols(DVec3::X, DVec3::new(0.4, 1.0, 0.0), DVec3::new(0.0, 0.0, 1.2));
    let ways = [
        ("a mirrored box", turned(DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0))), DVec3::new(1.0, 2.0, 0.5)),
        ("a sheared box", turned(shear), DVec3::new(1.0, 2.0, 0.5)),
        ("light straight down", turned(DMat3::IDENTITY), DVec3::Y),
    ];
    for (what, mesh, toward) in ways {
        for text in ["auto", "reeves87,bias=3t", "woo92", "wang-molnar94", "burley,bias=0.02,min=1t,max=1t"] {
            let scene = over(mesh.clone(), light(toward));
            table.row("others", format!("{what}, {text}"), NONE, percent(faults(&scene, text, &ground(4.5, 0.0), 0.2)));
        }
    }
    let mut broken = turned(DMat3::IDENTITY);
    let first = broken.positions.len() as u32;
    broken.positions.extend([Vec3::NAN, Vec3::ZERO, Vec3::X, Vec3::splat(0.5)]);
    broken.normals.extend([Vec3::Y; 4]);
    let surfaces = broken.surfaces[0];
    for corners in [[first, first + 1, first + 2], [first + 3; 3]] {
        broken.triangles.push(corners);
        broken.surfaces.push(surfaces);
    }
    let scene_of = |shape: Mesh| {
        let mut scene = over(turned(DMat3::IDENTITY), light(DVec3::new(1.0, 2.0, 0.5)));
        scene.objects[1].shape = Shape::Mesh(shape);
        scene
    };
    let (whole, damaged) = (scene_of(turned(DMat3::IDENTITY)), scene_of(broken));
    let answers = |scene: &Scene| asked(&*mapped(scene, "reeves87,bias=3t"), &ground(4.5, 0.0));
    table.row(
        "others",
        "NaN and degenerate triangles beside a box: the same answers",
        true,
        answers(&whole) == answers(&damaged),
    );
    let spot =
        View::perspective(DVec3::Y * 6.0, DVec3::ZERO, DVec3::X, 1.0, 0.5, 60.0, UVec2::new(320, 512)).expect("a spot");
    let behind = scene(vec![sheet("floor", 5.0, 0.0), cuboid("above", [-2.0, 7.0, -2.0], [2.0, 8.0, 2.0])], &spot);
    for text in ["auto", "reeves87", "woo92", "burley"] {
        table.row(
            "others",
            format!("a box behind a spot, map of 320 × 512, {text}"),
            NONE,
            percent(faults(&behind, text, &ground(1.5, 0.0), 0.1)),
        );
    }
    let room = scene(
        vec![
            sheet("floor", 5.0, 0.0),
            cuboid("left", [-3.0, 0.0, -2.0], [0.0, 2.0, 2.0]),
            cuboid("right", [0.0, 0.0, -2.0], [3.0, 2.0, 2.0]),
        ],
        &light(DVec3::new(0.3, 1.0, 0.2)),
    );
    // The ground under the boxes is nothing that anybody sees.
    let mut seen = ground(4.5, 0.0);
    seen.retain(|point| point.position.x.abs() > 3.0 || point.position.z.abs() > 2.0);
    for text in ["auto", "reeves87,bias=3t", "woo92"] {
        table.row(
            "others",
            format!("the seam between two boxes on a floor, {text}"),
            NONE,
            percent(faults(&room, text, &seen, 0.2)),
        );
    }
}

#[test]
fn every_reported_situation_has_its_right_answer() {
    let mut table = Table::default();
    for part in [truth, framing, parallel, resolution, places_and_biases, stacks, maps_and_files, meshes] {
        part(&mut table);
    }
    let mut wrong = Vec::new();
    for Row { kind, situation, right, found } in &table.0 {
        let verdict = if right == found { "ok" } else { "WRONG" };
        println!("| {kind} | {situation} | {right} | {found} | {verdict} |");
        if right != found {
            wrong.push(format!("{situation}: {found} instead of {right}"));
        }
    }
    assert!(table.0.len() > 60 && wrong.is_empty(), "{} of {} rows:\n{}", wrong.len(), table.0.len(), wrong.join("\n"));
}
