//! Situations of lights: where they stand, how their maps are framed, how finely these resolve, and what bias is given.

use super::Table;
use super::stage::{NONE, asked, cuboid, faults, ground, mapped, percent, scene, sheet, sun, warned};
use glam::{DVec3, UVec2, Vec3};
use umbrage_oracle::{Geometry, RayCast};
use umbrage_plane::{Kind, SurfacePoint, View, cube_views};
use umbrage_scene::tree::{Cone, Tree};

/// Truth far away, beside something large, and with the light in a surface.
pub(super) fn truth(table: &mut Table) {
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
pub(super) fn framing(table: &mut Table) {
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
pub(super) fn parallel(table: &mut Table) {
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
pub(super) fn resolution(table: &mut Table) {
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
pub(super) fn places_and_biases(table: &mut Table) {
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
