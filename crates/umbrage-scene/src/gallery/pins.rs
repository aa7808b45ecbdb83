//! A bowling ball and ten pins by frame.

use crate::Mesh;
use glam::{DMat4, DQuat, DVec3, Vec3};
use std::f64::consts::FRAC_PI_2;

/// The pin of the rules, (radius, height) in inches from the middle of its foot.
const PROFILE: [(f32, f32); 17] = [
    (0.0, 0.0),
    (1.015, 0.0),
    (1.415, 0.75),
    (1.955, 2.25),
    (2.255, 3.375),
    (2.385, 4.5),
    (2.28, 5.875),
    (1.85, 7.25),
    (1.235, 8.625),
    (0.985, 9.375),
    (0.90, 10.0),
    (0.935, 10.875),
    (1.045, 11.75),
    (1.205, 12.625),
    (1.275, 13.5),
    (0.85, 14.65),
    (0.0, 15.0),
];
/// Middle of a pin's weight above its foot, about which it turns.
const WEIGHT: f64 = 5.8;
/// Between neighbouring pins, middle to middle.
const SPACING: f64 = 12.0;
/// Radius of the ball.
const RADIUS: f32 = 4.25;
/// When the ball meets the head pin, frames.
const CONTACT: f64 = 8.0;
/// Frames that a pin is off the deck.
const FLIGHT: f64 = 9.0;

/// How a pin goes when it is hit.
struct Throw {
    /// Bearing of its way, from +x toward +z, radians.
    bearing: f64,
    /// Length of its way in the end, world units.
    way: f64,
    /// How fast it tips over, radians per frame, until it lies.
    tip: f64,
    /// How high it hops, world units.
    hop: f64,
    /// Bearing that its head tips toward.
    head: f64,
}

const fn throw(bearing: f64, way: f64, tip: f64, hop: f64, head: f64) -> Throw {
    Throw { bearing, way, tip, hop, head }
}

/// By number from the head pin, rows from left to right as the bowler sees them. `None` stays. Found by trying ways at
/// random until no two pins met in any frame.
const THROWS: [Option<Throw>; 10] = [
    Some(throw(-1.18, 7.09, 0.4, 12.83, 2.39)),
    Some(throw(-1.09, 7.52, 0.18, 9.07, 2.23)),
    Some(throw(-0.69, 7.06, 0.35, 6.32, 0.0)),
    Some(throw(-1.43, 11.89, 0.43, 11.04, -1.25)),
    Some(throw(-0.62, 19.49, 0.29, 8.58, 0.22)),
    Some(throw(-1.19, 28.32, 0.16, 7.17, -1.1)),
    None,
    Some(throw(-2.18, 29.19, 0.43, 5.82, 0.53)),
    Some(throw(-1.46, 7.52, 0.28, 7.94, -0.53)),
    Some(throw(-1.61, 23.9, 0.35, 3.26, -0.64)),
];

/// Where the ball's middle is.
fn ball_at(frame: f64) -> DVec3 {
    let (before, after) = (frame.min(CONTACT) / CONTACT, (frame - CONTACT).max(0.0));
    DVec3::new(-5.0 + 3.0 * before + 0.2 * after, f64::from(RADIUS), 46.0 - 39.0 * before - 3.6 * after)
}

/// The ball, turned as it rolls.
pub(super) fn ball(frame: f32) -> Mesh {
    let at = ball_at(f64::from(frame));
    let rolled = DMat4::from_rotation_x((at.z - 46.0) / f64::from(RADIUS));
    Mesh::sphere(Vec3::ZERO, RADIUS, 64).transformed(&(DMat4::from_translation(at) * rolled))
}

/// Pin `number`, 1 to 10: its body and its two stripes, a little proud of it.
pub(super) fn pin(number: u32, frame: f32) -> [Mesh; 2] {
    let body = Mesh::lathe(Vec3::ZERO, Vec3::Y, &PROFILE, 40);
    let stripe = |low: f32, high: f32, radius: f32| {
        let profile = [(0.8, low), (radius, low), (radius, high), (0.8, high)];
        Mesh::lathe(Vec3::ZERO, Vec3::Y, &profile, 40)
    };
    let mut stripes = stripe(9.5, 9.95, 0.99);
    stripes.append(&stripe(10.35, 10.8, 0.96));
    let place = place(number, f64::from(frame));
    [body.transformed(&place), stripes.transformed(&place)]
}

/// From a pin about the origin to where it is.
fn place(number: u32, frame: f64) -> DMat4 {
    let row = (0..4u32).rev().find(|row| number > row * (row + 1) / 2).unwrap_or(0);
    let column = number - 1 - row * (row + 1) / 2;
    let spot = DVec3::new(
        (f64::from(column) - 0.5 * f64::from(row)) * SPACING,
        0.0,
        -f64::from(row) * SPACING * 0.75f64.sqrt(),
    );
    // The blow runs through the pins at five units per frame.
    let hit = CONTACT + (spot.distance(DVec3::new(-2.0, 0.0, 7.0)) - 7.0).max(0.0) / 5.0;
    let since = frame - hit;
    let Some(throw) = THROWS.get(number as usize - 1).and_then(Option::as_ref).filter(|_| since > 0.0) else {
        return DMat4::from_translation(spot);
    };
    let along = |bearing: f64| DVec3::new(bearing.cos(), 0.0, bearing.sin());
    let angle = (throw.tip * since).min(FRAC_PI_2);
    let turned = DQuat::from_axis_angle(DVec3::Y.cross(along(throw.head)), angle);
    // The lowest point of the tilted profile touches the deck when the pin does not fly.
    let lowest = PROFILE.iter().fold(f64::INFINITY, |low, &(radius, height)| {
        low.min((f64::from(height) - WEIGHT) * angle.cos() - f64::from(radius) * angle.sin())
    });
    let flight = (since / FLIGHT).min(1.0);
    let slid = throw.way * (1.0 - (-since / 7.0).exp());
    let weight = spot + along(throw.bearing) * slid + DVec3::Y * (4.0 * throw.hop * flight * (1.0 - flight) - lowest);
    DMat4::from_translation(weight) * DMat4::from_quat(turned) * DMat4::from_translation(DVec3::NEG_Y * WEIGHT)
}
