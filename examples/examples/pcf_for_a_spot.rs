//! Percentage-closer filtering for a spot light, over depths that your renderer made.
//!
//! Reeves, Salesin & Cook 1987: compare first, filter afterwards, and edges are smooth.

use glam::{DVec3, UVec2, Vec3};
use umbrage_depth::Raw;
use umbrage_plane::{SpotView, SurfacePoint, View};
use umbrage_sample::Key;
use umbrage_shadow::{Biased, Pcf, Shadow, ShadowMap};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A lamp 10 units above the floor that shines straight down, 60° wide. North, −z, is up on its map.
    let light = View::spot(SpotView {
        eye: DVec3::Y * 10.0,
        target: DVec3::ZERO,
        up: Some(DVec3::NEG_Z),
        full_angle_radians: 60f64.to_radians(),
        near: 1.0,
        far: 50.0,
        size: UVec2::splat(256),
    })?;
    // What it sees: a card 6 units below it over the western half, the floor elsewhere. Depths are axial, in world units.
    let depths = (0..256 * 256).map(|texel| if texel % 256 < 128 { 6.0 } else { 10.0 }).collect();
    // A bias of .05 units keeps the floor from shadowing itself; the filter reaches over twice the pixel's own footprint.
    let filter = Pcf::default().with_depth(Biased::world(0.05, 0.05)).with_res_factor(2.0);
    let shadow = ShadowMap { filter, map: Raw::new(light, depths)? };

    // A row of shaded squares across the card's edge, a tenth of a unit wide, one every .04 units; 1 is dark.
    let squares: Vec<SurfacePoint> = (-8..8)
        .map(|step: i32| {
            let corner = |x: f32, z: f32| Vec3::new(step as f32 * 0.04 + x, 0.0, z);
            let corners = [corner(-0.05, -0.05), corner(0.05, -0.05), corner(0.05, 0.05), corner(-0.05, 0.05)];
            SurfacePoint { region: step as u32, ..SurfacePoint::at(corner(0.0, 0.0), Vec3::Y).with_corners(corners) }
        })
        .collect();
    let mut dark = vec![0.0; squares.len()];
    shadow.fractions(&squares, Key::new(0, 0, 0), &mut dark);
    println!("west {dark:.2?} east");

    assert_eq!((dark[0], dark[15]), (1.0, 0.0));
    let between = dark.iter().filter(|dark| (0.05..0.95).contains(*dark)).count();
    assert!(between >= 3, "the edge is soft: {between} squares are in half shadow");
    // Outside its cone a spot light is dark by the view's rules, not by the map.
    let outside = shadow.fraction(&SurfacePoint::at(Vec3::new(9.0, 0.0, 0.0), Vec3::Y), Key::new(0, 0, 0));
    assert_eq!(outside, 1.0);
    Ok(())
}
