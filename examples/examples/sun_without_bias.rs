//! A sun without any bias, in the two ways that need none: second surfaces (Wang & Molnar 1994) and midpoints (Woo 1992).

use glam::{DVec3, UVec2, Vec3};
use umbrage_bake::bake;
use umbrage_depth::{BackFace, DepthMap, Midpoint};
use umbrage_plane::{SurfacePoint, View};
use umbrage_raster::{Cull, Triangle};
use umbrage_sample::Key;
use umbrage_shadow::{Shadow, presets};

/// A box as twelve triangles, counter-clockwise from outside.
fn cuboid(low: Vec3, high: Vec3, object: u32) -> Vec<Triangle> {
    let corner = |i: usize| {
        let side = |bit: usize, low: f32, high: f32| if i >> bit & 1 == 1 { high } else { low };
        Vec3::new(side(0, low.x, high.x), side(1, low.y, high.y), side(2, low.z, high.z))
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    halves.map(|half| Triangle::new(half.map(corner), object, false)).collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A slab of ground, and a block that stands on it. Both are closed solids: second surfaces need that.
    let mut scene = cuboid(Vec3::new(-8.0, -1.0, -8.0), Vec3::new(8.0, 0.0, 8.0), 0);
    scene.extend(cuboid(Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 3.0, 1.0), 1));
    // The sun stands 45° high in the east; its map holds the scene's bounds.
    let bounds = [DVec3::new(-8.0, -1.0, -8.0), DVec3::new(8.0, 3.0, 8.0)];
    let sun = View::directional(DVec3::new(1.0, 1.0, 0.0), bounds, UVec2::splat(256))?;

    // Back faces are second surfaces where solids do not overlap: cull the front faces.
    let backs = bake(&sun, scene.iter().copied(), &BackFace, Cull::Front).map;
    let second = presets::wang_molnar94().over(backs)?;
    let middles = bake(&sun, scene.iter().copied(), &Midpoint::default(), Cull::None).map;
    println!("the map of midpoints takes {} bytes", middles.bytes());
    let midpoint = presets::woo92().over(middles)?;

    let places = [
        ("in the open", 5.0),
        ("beside the block, toward the sun", 1.05),
        ("behind the block", -2.5),
        ("at its foot", -1.01),
    ];
    for (place, x) in places {
        let point = SurfacePoint::at(Vec3::new(x, 0.0, 0.2), Vec3::Y);
        let both = [second.fraction(&point, Key::new(0, 0, 0)), midpoint.fraction(&point, Key::new(0, 0, 0))];
        println!("{place:32}  second surfaces {:.2}  midpoints {:.2}", both[0], both[1]);
        let wanted = if x < 0.0 { 1.0 } else { 0.0 };
        assert_eq!(both, [wanted; 2], "{place}");
    }

    // A paper's preset over a map of another surface is a mistake that would show only as noise: it is refused.
    let nearest = bake(&sun, scene, &umbrage_depth::First, Cull::None).map;
    let refused = presets::woo92().over(nearest).expect_err("a map of nearest surfaces");
    println!("{refused}");
    Ok(())
}
