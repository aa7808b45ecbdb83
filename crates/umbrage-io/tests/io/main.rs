//! Files in and out of `umbrage-io`.

mod any_map;
mod cube;
mod deep_hostile;
mod deep_maps;
mod facets;
mod far;
mod files;
mod hostile;
mod maps;
mod paged;
mod paged_faults;
mod pictures;
mod rows;
mod shadow_maps;
mod volumes;

use glam::{DVec3, IVec2, UVec2};
use std::path::PathBuf;
use umbrage_depth::Raw;
use umbrage_plane::{Kind, Rules, Sampling, TexelRect, View};

/// An empty folder of this test's own.
fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("io").join(test);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).expect("left by an earlier run");
    }
    std::fs::create_dir_all(&folder).expect("a place for test files");
    folder
}

fn spot(size: UVec2) -> View {
    let (eye, target) = (DVec3::new(-70.1, 25.3, 70.7), DVec3::new(0.1, 0.2, 12.0));
    let view = View::perspective(eye, target, DVec3::Y, 50f64.to_radians(), 20.1, 220.3, size).expect("valid");
    view.with_rules(Rules::SPOT).with_cone(Some(25f64.to_radians().cos())).unwrap()
}

fn sun(size: UVec2) -> View {
    let (eye, target) = (DVec3::new(3.0, 30.0, 1.0 / 3.0), DVec3::new(0.7, 0.0, 0.1));
    View::orthographic(eye, target, DVec3::Z, 20.3, -1.5, 50.0, size).expect("valid")
}

/// As large a part of the plane that a view shows, but off its axis.
fn windowed(view: &View) -> View {
    let corner = IVec2::new(3, -5);
    view.window(TexelRect::new(corner, corner + view.size().as_ivec2())).expect("valid")
}

/// Every kind of view that a file must keep.
fn views(size: UVec2) -> Vec<View> {
    [Kind::Axial, Kind::Screen, Kind::Radial]
        .into_iter()
        .flat_map(|kind| {
            [
                spot(size).with_kind(kind),
                sun(size).with_kind(kind).with_sampling(Sampling::Jittered { seed: 0xFEED_BEEF }),
                spot(size).with_kind(kind).with_rules(Rules::VOLUME).with_cone(None).unwrap(),
                windowed(&spot(size)).with_kind(kind),
                windowed(&sun(size)).with_kind(kind),
            ]
        })
        .collect()
}

/// A map with a surface inside the box from a third to five sixths, of irregular depths with holes.
fn map(view: &View) -> Raw {
    let size = view.size();
    let depth = |index: u32| {
        let (x, y) = (index % size.x, index / size.x);
        let boxed = x >= size.x / 3 && y >= size.y / 3 && x * 6 < size.x * 5 && y * 6 < size.y * 5;
        let hole = index % 7 == 3 && size.x > 1;
        if boxed && !hole { 1.0 / 3.0 + (index as f32).sqrt() * 10.1 } else { f32::INFINITY }
    };
    Raw::new(*view, (0..size.x * size.y).map(depth).collect()).expect("one depth per texel")
}
