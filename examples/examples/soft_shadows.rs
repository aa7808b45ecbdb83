//! Soft shadows from one map, as wide as the lamp makes them (Burley 2006): the farther the card, the softer its edge.

use glam::{DVec3, UVec2, Vec3};
use umbrage_depth::Raw;
use umbrage_plane::{Rules, SurfacePoint, View};
use umbrage_sample::Key;
use umbrage_shadow::{Shadow, ShadowMap, Soft, Softness};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (eye, size) = (DVec3::Y * 10.0, UVec2::splat(512));
    let light = View::perspective(eye, DVec3::ZERO, DVec3::NEG_Z, 90f64.to_radians(), 1.0, 50.0, size)?;
    let light = light.with_rules(Rules::OPEN);
    // A lamp of radius .3; nothing comes nearer to it than 4 units, which keeps the search for occluders small.
    let softness = Softness::Light { radius: 0.3, nearest: 4.0 };
    let mut filter = Soft::default().with_softness(softness);
    // More taps than the paper's 32, for a picture without noise.
    (filter.search.num_samples, filter.blur.num_samples) = (256, 1024);

    let mut widths = Vec::new();
    for height in [2.0f32, 5.0] {
        // A card over the western half, `height` units above the floor.
        let depths = (0..512 * 512).map(|texel| if texel % 512 < 256 { 10.0 - height } else { 10.0 }).collect();
        let shadow = ShadowMap { filter, map: Raw::new(light, depths)? };
        let dark = |x: f32| shadow.fraction(&SurfacePoint::at(Vec3::new(x, 0.0, 0.0), Vec3::Y), Key::new(0, 0, 0));
        let row: String = (-20..20)
            .map(|step| [' ', '.', ':', '+', '*', '#'][(dark((step as f32 + 0.5) * 0.04) * 5.0).round() as usize])
            .collect();
        // From a tenth to nine tenths.
        let inside = (-200..200).filter(|step| (0.1..0.9).contains(&dark(*step as f32 * 0.005))).count();
        let width = inside as f32 * 0.005;
        println!("card {height} above the floor  [{row}]  edge {width:.2} units wide");
        widths.push(width);
    }
    // Similar triangles: the penumbra is as wide as the lamp, times the card's height over its distance from the lamp. A disc's
    // edge passes from a tenth to nine tenths in .687 of that.
    for (width, height) in widths.into_iter().zip([2.0f32, 5.0]) {
        let wanted = 0.6 * height / (10.0 - height) * 0.687;
        assert!((width / wanted - 1.0).abs() < 0.15, "{width} instead of {wanted}");
    }
    Ok(())
}
