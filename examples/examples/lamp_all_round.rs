//! A lamp that shines all round: six maps, one for each face of a cube, looked up as one light.

use glam::{DVec3, Vec3};
use umbrage_bake::bake;
use umbrage_depth::First;
use umbrage_plane::{Bias, SurfacePoint, cube_views};
use umbrage_raster::{Cull, Triangle};
use umbrage_sample::Key;
use umbrage_shadow::{Around, Biased, Pcf, Shadow};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Two sheets face the lamp in the middle: a large one 2 units to the east, a small one 2 units above.
    let sheet = |corners: [(f32, f32, f32); 4], object| {
        let [a, b, c, d] = corners.map(|(x, y, z)| Vec3::new(x, y, z));
        [Triangle::new([a, b, c], object, true), Triangle::new([a, c, d], object, true)]
    };
    let east = sheet([(2.0, -3.0, -3.0), (2.0, 3.0, -3.0), (2.0, 3.0, 3.0), (2.0, -3.0, 3.0)], 0);
    let above = sheet([(-1.0, 2.0, -1.0), (1.0, 2.0, -1.0), (1.0, 2.0, 1.0), (-1.0, 2.0, 1.0)], 1);

    // Faces store Euclidean distance, so that a depth means the same on every face and filters cross the seams.
    let maps = cube_views(DVec3::ZERO, 0.1, 100.0, 128)?
        .map(|view| bake(&view, east.into_iter().chain(above), &First, Cull::None).map);
    let filter = Pcf::default().with_depth(Biased::constant(Bias::Texels(1.5)));
    let lamp = Around::new(filter, maps.to_vec())?;
    println!("six maps keep {} bytes of depths", lamp.bytes());

    let cases = [
        ("behind the large sheet", Vec3::new(5.0, 0.3, 0.2), 1.0),
        ("across the seam of two faces", Vec3::new(5.0, 5.2, 0.2), 1.0),
        ("above the small sheet", Vec3::new(0.2, 5.0, 0.3), 1.0),
        ("in the west, where nothing is", Vec3::new(-5.0, 0.3, 0.2), 0.0),
        ("before the large sheet", Vec3::new(1.0, 0.3, 0.2), 0.0),
    ];
    for (name, position, wanted) in cases {
        // Each point faces the lamp.
        let dark = lamp.fraction(&SurfacePoint::at(position, -position.normalize()), Key::new(0, 0, 0));
        println!("{name:30} {dark:.2}");
        assert_eq!(dark, wanted, "{name}");
    }
    Ok(())
}
