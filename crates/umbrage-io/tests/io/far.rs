//! Views far from the world's origin, in our own files and in those of others.

use crate::shadow_maps::foreign;
use crate::{map, spot, sun, views};
use ::exr::prelude as exr;
use glam::{DMat4, DVec3, Mat4, UVec2};
use umbrage_depth::{DeepMap, DepthMap, Step};
use umbrage_io::{DEFAULT_BUDGET, decode_deep_map, decode_shadow_map, encode_deep_map, encode_shadow_map};
use umbrage_plane::{Projection, TexelRect, View};

/// From the origin to a hundred times farther than scenes need, off the grid of f32 and of every power of two.
const OFFSETS: [DVec3; 5] = [
    DVec3::ZERO,
    DVec3::new(1000.1, -299.7, 700.3),
    DVec3::new(1_000_000.1, -299_999.7, 700_000.3),
    DVec3::new(-3e7 + 0.1, 1e8 + 0.7, 2e7 / 3.0),
    DVec3::new(0.1, -0.7, 1e8 / 3.0),
];

fn bits(view: &View) -> [u64; 16] {
    view.world_to_eye().to_cols_array().map(f64::to_bits)
}

#[test]
fn our_own_files_keep_every_bit_of_a_view_however_far() {
    for by in OFFSETS {
        for view in views(UVec2::new(37, 61)) {
            let view = view.moved(by).expect("finite");
            let written = map(&view);
            let read = decode_shadow_map(&encode_shadow_map(&written).expect("written"), DEFAULT_BUDGET).expect("read");
            assert_eq!((read.view(), bits(read.view())), (&view, bits(&view)), "{by}");
            assert_eq!(read, written, "{by}");
        }
        let view = spot(UVec2::new(7, 5)).moved(by).expect("finite");
        let step = |depth: f32| Step { depth, passes: glam::Vec3::splat(1.0 / depth) };
        let texels = TexelRect::of_size(view.size()).texels().map(|at| vec![step((at.x + 9 * at.y + 2) as f32)]);
        let written = DeepMap::new(view, 0.0, texels).expect("in order");
        let read = decode_deep_map(&encode_deep_map(&written).expect("written"), DEFAULT_BUDGET).expect("read");
        assert_eq!((read.view(), bits(read.view())), (&view, bits(&view)), "{by}");
    }
}

/// The file's own numbers: `worldToCamera` in f64, turned to look down −z.
fn as_written(bytes: &[u8]) -> DMat4 {
    let meta = exr::MetaData::read_from_buffered(bytes, true).expect("a header");
    let camera = meta.headers[0].own_attributes.world_to_camera.expect("a matrix");
    DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0)) * Mat4::from_cols_array(&camera).as_dmat4()
}

fn scales(view: &View) -> glam::DVec2 {
    match view.projection() {
        Projection::Perspective { k, .. } => k,
        Projection::Orthographic { half, .. } => half,
    }
}

#[test]
fn files_of_others_are_read_as_exactly_far_from_the_origin_as_near_it() {
    for by in OFFSETS {
        for near in [spot(UVec2::new(45, 33)), sun(UVec2::new(45, 33))] {
            let view = near.moved(by).expect("finite");
            let bytes = foreign(&view, exr::Blocks::ScanLines, exr::Compression::ZIP16);
            let read = decode_shadow_map(&bytes, DEFAULT_BUDGET).expect("read");
            let (found, written) = (*read.view(), as_written(&bytes));
            assert_eq!(found.is_perspective(), view.is_perspective(), "{by}");
            assert!((scales(&found) / scales(&view) - 1.0).length() < 1e-5, "{by}");
            // Around the eye the view says what the file's numbers say; only they themselves are rounder the farther it is.
            let eye = found.eye_to_world().w_axis.truncate();
            for step in [DVec3::ZERO, DVec3::new(90.0, -20.0, -60.0), DVec3::new(-200.0, 100.0, 3.0)] {
                let (ours, theirs) = (found.world_to_eye(), written);
                let off = ours.transform_point3(eye + step) - theirs.transform_point3(eye + step);
                assert!(off.length() < 3e-5, "{by} {step}: {off}");
            }
            let true_eye = view.eye_to_world().w_axis.truncate();
            let ulp = f64::from(f32::EPSILON) * (100.0 + by.length());
            assert!(eye.distance(true_eye) < 2.0 * ulp, "{by}: {eye} is not {true_eye}");
        }
    }
}

#[test]
fn numbers_that_files_of_others_hold_exactly_are_read_exactly() {
    let size = UVec2::splat(16);
    for far in [0.0, 1024.0, 1_048_576.0, 16_777_216.0] {
        let eye = DVec3::new(far, -far, 0.5 * far);
        for (ahead, up) in [(DVec3::NEG_Z, DVec3::Y), (DVec3::X, DVec3::Y), (DVec3::NEG_Y, DVec3::Z)] {
            let lamp = View::perspective(eye, eye + ahead, up, std::f64::consts::FRAC_PI_2, 1.0, 64.0, size);
            let sun = View::orthographic(eye, eye + ahead, up, 8.0, 1.0, 64.0, size);
            for view in [lamp.expect("valid"), sun.expect("valid")] {
                let bytes = foreign(&view, exr::Blocks::ScanLines, exr::Compression::ZIP16);
                let found = *decode_shadow_map(&bytes, DEFAULT_BUDGET).expect("read").view();
                assert_eq!(found.world_to_eye(), view.world_to_eye(), "{far} {ahead}");
                assert!((scales(&found) - scales(&view)).length() < 1e-5, "{far} {ahead}");
            }
        }
    }
}
