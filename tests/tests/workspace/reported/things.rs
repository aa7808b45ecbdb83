//! Situations of casters and files: stacked sheets, maps of other makers, unusual meshes.

use super::Table;
use super::stage::{
    NONE, asked, cuboid, faults, ground, mapped, matt, percent, recipe, scene, sheet, sun, warned, warnings,
};
use glam::{DMat3, DVec3, UVec2, Vec3};
use umbrage_depth::Raw;
use umbrage_io::{DEFAULT_BUDGET, Paged, decode_shadow_map, encode_shadow_map, write_shadow_map};
use umbrage_oracle::diagnose_recipe;
use umbrage_plane::View;
use umbrage_recipe::Recipe;
use umbrage_render::exposed_map;
use umbrage_scene::{Mesh, Scene, Shape};

/// Sheets on sheets, what is drawn twice, and boxes that touch.
pub(super) fn stacks(table: &mut Table) {
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
pub(super) fn maps_and_files(table: &mut Table) {
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
pub(super) fn meshes(table: &mut Table) {
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
