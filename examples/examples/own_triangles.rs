//! A map from your own triangles, and the same depths from your own ray hits.

use glam::{DVec3, IVec2, UVec2, Vec3};
use umbrage_bake::bake;
use umbrage_depth::{DepthMap, DepthRule, First, Hit, Midpoint};
use umbrage_plane::{Bias, SurfacePoint, View};
use umbrage_raster::{Cull, Triangle};
use umbrage_sample::Key;
use umbrage_shadow::{Biased, Pcf, Shadow, ShadowMap};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // An indexed mesh, as renderers have it: a pyramid, counter-clockwise from outside.
    let positions = [(-1.0, 1.0, -1.0), (1.0, 1.0, -1.0), (1.0, 1.0, 1.0), (-1.0, 1.0, 1.0), (0.0, 2.0, 0.0)];
    let positions = positions.map(|(x, y, z)| Vec3::new(x, y, z));
    let indices = [[4, 1, 0], [4, 2, 1], [4, 3, 2], [4, 0, 3], [0, 1, 2], [0, 2, 3]];
    let triangles = indices.map(|corners| Triangle::new(corners.map(|vertex: usize| positions[vertex]), 7, false));

    let (eye, size) = (DVec3::Y * 6.0, UVec2::splat(128));
    let light = View::perspective(eye, DVec3::ZERO, DVec3::NEG_Z, 60f64.to_radians(), 1.0, 20.0, size)?;
    let baked = bake(&light, triangles, &First, Cull::None);
    println!("{} triangles, {} texels covered, {} bytes", baked.stats.kept(), baked.fragments, baked.map.bytes());

    // A map made by your own ray caster holds the same depths: `View::ray` gives each texel's ray, and a depth rule turns its
    // hits into what the rasteriser would have stored.
    let texel = IVec2::new(70, 60);
    let (origin, direction) = light.ray(light.sampling().position(texel));
    let hits: Vec<Hit> = triangles.iter().filter_map(|triangle| hit(&light, triangle, origin, direction)).collect();
    let by_rays = First.of(&light, texel, hits.iter().copied());
    println!("texel {texel}: rays {by_rays:.4}, raster {:.4}", baked.map.depth(texel));
    assert_eq!(hits.len(), 2, "in through a side, out through the base");
    assert!((by_rays - baked.map.depth(texel)).abs() < 1e-3, "the raster snaps corners to 1/256 texel");
    println!("its midpoint would be {:.4}", Midpoint::default().of(&light, texel, hits));

    let filter = Pcf::default().with_depth(Biased::constant(Bias::Texels(1.0)));
    let shadow = ShadowMap { filter, map: baked.map };
    let dark = |x: f32| shadow.fraction(&SurfacePoint::at(Vec3::new(x, 0.0, 0.0), Vec3::Y), Key::new(0, 0, 0));
    assert_eq!([dark(0.0), dark(0.9), dark(2.0)], [1.0, 1.0, 0.0]);
    Ok(())
}

/// Where a ray meets a triangle (Möller & Trumbore 1997).
fn hit(light: &View, triangle: &Triangle, origin: DVec3, direction: DVec3) -> Option<Hit> {
    let [a, b, c] = triangle.corners;
    let (across, down, from) = (b - a, c - a, origin - a);
    let normal = direction.cross(down);
    let determinant = across.dot(normal);
    let (u, v) = (from.dot(normal) / determinant, direction.dot(from.cross(across)) / determinant);
    let distance = down.dot(from.cross(across)) / determinant;
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0;
    inside.then(|| Hit::at(light, origin + direction * distance, across.cross(down)))
}
