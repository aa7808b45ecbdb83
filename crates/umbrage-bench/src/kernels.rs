//! The six hottest loops, each alone behind [`measured`], so that a profiler can count what is inside it and nothing else.

use crate::in_pool;
use crate::look_ups::{closer, on_plane, ready};
use crate::meshes::{grid, layers, straight};
use crate::raster::{first, refined};
use crate::scene::{Scene, Segments};
use std::hint::black_box;
use umbrage_depth::Raw;
use umbrage_plane::{Place, TexelRect, vectorized};
use umbrage_raster::{Bins, Cull};
use umbrage_shadow::{DualPlane, Filter, ShadowMap, Simd};

/// Side of the kernels' maps, texels.
const SIDE: u32 = 512;
/// Of a picture of as many pixels, one of so many is looked up.
const STEP: usize = 16;

/// Their names.
pub const NAMES: [&str; 6] = ["transform", "pcf-raw", "auto", "bins-tiny", "tiles-layers", "pcf-plane-raw"];

/// Runs a kernel once, in a thread of its own pool; nothing where there is none of that name. The number of elements: receivers,
/// triangles or texels.
pub fn run(name: &str) -> Option<usize> {
    in_pool(1, || {
        Some(match name {
            "transform" => transform(),
            "pcf-raw" => look_up(|view, mesh| (closer(view), Raw::copy_of(&first(view, mesh).map))),
            "pcf-plane-raw" => look_up(|view, mesh| (on_plane(view), Raw::copy_of(&first(view, mesh).map))),
            "auto" => look_up(|view, mesh| (DualPlane::default(), refined(view, mesh).map)),
            "bins-tiny" => {
                let (view, mesh) = (straight(SIDE), grid(200, 282, SIDE));
                let window = TexelRect::of_size(view.size());
                measured(&mut || drop(black_box(Bins::new(&view, window, Cull::None, mesh.indexed()))));
                mesh.triangles.len()
            }
            "tiles-layers" => {
                let (view, mesh) = (straight(SIDE), layers(8));
                measured(&mut || drop(black_box(first(&view, &mesh))));
                SIDE as usize * SIDE as usize * 8
            }
            _ => return None,
        })
    })
}

/// Points of the world as the light sees them.
fn transform() -> usize {
    let (scene, view) = (Scene::sparse(Segments::SMALL, SIDE, STEP), Scene::view(SIDE));
    let mut seen = vec![Err(Place::Behind); scene.points.len()];
    measured(&mut || view.receivers(black_box(&scene.points), &mut seen));
    assert!(seen.iter().all(Result::is_ok), "all points lie before the light");
    seen.len()
}

/// A filter over a map, asked about receivers that are in the light's space.
fn look_up<F: Filter, M: umbrage_depth::DepthMap>(
    make: impl Fn(&umbrage_plane::View, &crate::meshes::Mesh) -> (F, M),
) -> usize {
    let (scene, view) = (Scene::sparse(Segments::SMALL, SIDE, STEP), Scene::view(SIDE));
    let (filter, map) = make(&view, &scene.mesh);
    let (shadow, receivers) = (ShadowMap { filter, map }, scene.receivers(&view));
    let mut out = vec![f32::NAN; receivers.len()];
    measured(&mut || ready(&shadow, black_box(&receivers), &mut out));
    assert!(out.iter().all(|fraction| (0.0..=1.0).contains(fraction)), "fractions");
    out.len()
}

/// What profilers look for.
#[inline(never)]
pub fn measured(kernel: &mut dyn FnMut()) {
    kernel();
}

/// The set of instructions that kernels are run with.
pub fn instruction_set() -> &'static str {
    fn name<S: Simd>(_: S) -> &'static str {
        std::any::type_name::<S>().rsplit("::").next().unwrap_or("")
    }
    vectorized!(simd => name(simd))
}
