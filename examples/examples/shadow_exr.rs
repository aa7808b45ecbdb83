//! A shadow map written to an EXR file, as other tools read it, and read again.

use glam::{DVec3, UVec2, Vec3};
use umbrage_depth::{DepthMap, Stored, Tiled};
use umbrage_io::{read_shadow_map, write_shadow_map};
use umbrage_plane::{SurfacePoint, View};
use umbrage_sample::Key;
use umbrage_shadow::{Shadow, presets};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 10⁶ units from the world's origin, where f32 has steps of a sixteenth.
    let far = DVec3::new(1e6, 0.0, -1e6);
    let eye = far + DVec3::Y * 10.0;
    let light = View::perspective(eye, far, DVec3::NEG_Z, 90f64.to_radians(), 1.0, 50.0, UVec2::splat(64))?;
    // Midpoints between a card's two sides over half of the map, nothing elsewhere.
    let depths = (0..64 * 64).map(|texel| if texel % 64 < 32 { 6.5 } else { f32::INFINITY }).collect();
    let map = umbrage_depth::Raw::new(light, depths)?.with_stored(Stored::Midpoint);

    let path = std::env::temp_dir().join(format!("umbrage-example-{}.exr", std::process::id()));
    write_shadow_map(&path, &map)?;
    println!("{} bytes in the file, {} of depths", std::fs::metadata(&path)?.len(), map.bytes());
    let read = read_shadow_map(&path)?;
    std::fs::remove_file(&path)?;

    // View, depths and what they mean come back bit for bit; storages are chosen afterwards.
    assert_eq!(read, map);
    let shadow = presets::woo92().over(Tiled::from(&read))?;
    let dark = |x: f64| shadow.fraction(&SurfacePoint::at(far + DVec3::X * x, Vec3::Y), Key::new(0, 0, 0));
    println!("under the card {}, beside it {}", dark(-3.0), dark(3.0));
    assert_eq!([dark(-3.0), dark(3.0)], [1.0, 0.0]);
    Ok(())
}
