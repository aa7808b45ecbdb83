//! Receivers in batches are the receivers one by one, bit for bit.

use glam::{DVec3, IVec2, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_plane::{Kind, Place, Receiver, Rules, SurfacePoint, TexelRect, View};

/// Every bit of a receiver; one pattern stands for all NaNs.
fn bits(seen: &Result<Receiver, Place>) -> Result<Vec<u64>, Place> {
    let Receiver { kind, footprint, texel, axes, cells, depth, texel_world, facing, slope, object, eye, normal } =
        (*seen)?;
    let singles =
        [vec![footprint.centre, footprint.half, texel_world], footprint.corners.to_vec(), axes.to_vec()].concat();
    let singles = singles.into_iter().flat_map(|at| at.to_array()).chain([depth, facing, slope]);
    let doubles = [texel.to_array().to_vec(), eye.to_array().to_vec(), normal.to_array().to_vec()].concat();
    let single = |x: f32| if x.is_nan() { u64::MAX } else { u64::from(x.to_bits()) };
    let double = |x: f64| if x.is_nan() { u64::MAX } else { x.to_bits() };
    let whole = u64::from(cells.is_whole());
    let rest = [u64::from(object), kind as u64, whole];
    Ok(singles.map(single).chain(doubles.into_iter().map(double)).chain(rest).collect())
}

fn views() -> Vec<View> {
    let (eye, size) = (DVec3::new(3.0, 10.0, -2.0), UVec2::new(96, 64));
    let window = TexelRect::new(IVec2::new(-7, 20), IVec2::new(64, 61));
    let spot = View::perspective(eye, DVec3::ZERO, DVec3::Z, 1.2, 4.0, 14.0, size).unwrap();
    let sun = View::orthographic(eye, DVec3::ZERO, DVec3::Z, 7.0, 4.0, 14.0, size).unwrap();
    let shapes = [spot, sun, spot.window(window).unwrap(), sun.window(window).unwrap()];
    let kinds = |view: View| [Kind::Axial, Kind::Screen, Kind::Radial].map(|kind| view.with_kind(kind));
    let rules = |view: View| [Rules::OPEN, Rules::VOLUME].map(|rules| view.with_rules(rules));
    shapes.into_iter().flat_map(kinds).flat_map(rules).collect()
}

/// A coordinate: mostly ordinary, sometimes one of those that go wrong.
fn coordinate(reach: f32) -> impl Strategy<Value = f32> {
    prop_oneof![
        20 => -reach..reach,
        1 => prop::sample::select(vec![0.0, -0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e-40, 3e38]),
    ]
}

fn vector(reach: f32) -> impl Strategy<Value = Vec3> {
    [coordinate(reach), coordinate(reach), coordinate(reach)].prop_map(Vec3::from_array)
}

fn point() -> impl Strategy<Value = SurfacePoint> {
    let size = prop::sample::select(vec![0.0f32, 0.01, 1.0, 30.0]);
    (vector(16.0), vector(1.0), [vector(1.0), vector(1.0), vector(1.0), vector(1.0)], size, any::<u32>()).prop_map(
        |(position, normal, offsets, size, object)| {
            // A region of size 0 is a point, whatever its offsets were.
            let offset = |offset: Vec3| if size == 0.0 { Vec3::ZERO } else { offset * size };
            SurfacePoint { corner_offsets: offsets.map(offset), object, ..SurfacePoint::at(position, normal) }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn batches_are_the_receivers_one_by_one(points in prop::collection::vec(point(), 0..40)) {
        for view in views() {
            let mut together = vec![Err(Place::Outside); points.len()];
            view.receivers(&points, &mut together);
            for (point, together) in points.iter().zip(&together) {
                prop_assert_eq!(bits(together), bits(&view.receiver(point)), "{:?} in {:?}", point, view);
            }
            let mut upright = vec![Err(Place::Outside); points.len()];
            view.receivers_for(&points, false, &mut upright);
            for (upright, together) in upright.iter().zip(&together) {
                let tilted = |seen: Receiver| together.map_or(seen, |Receiver { facing, slope, .. }| Receiver { facing, slope, ..seen });
                prop_assert_eq!(bits(&upright.map(tilted)), bits(together), "without tilt, in {:?}", view);
            }
        }
    }
}

#[test]
fn every_place_is_met_in_a_batch() {
    use Place::{Behind, Far, Inside, Near};
    let spot = views()[1];
    assert_eq!(*spot.rules(), Rules::VOLUME);
    let at = |along: f64| SurfacePoint::at(DVec3::new(3.0, 10.0, -2.0) + spot.ahead() * along, Vec3::Y);
    let points = [9.0, -1.0, 1.0, 30.0, 9.0, 0.0, f64::NAN, 13.0].map(at);
    let mut seen = [Err(Place::Outside); 8];
    spot.receivers(&points, &mut seen);
    let places = seen.map(|seen| seen.map_or_else(|place| place, |_| Inside));
    assert_eq!(places, [Inside, Behind, Near, Far, Inside, Behind, Behind, Inside]);
}

#[test]
#[should_panic(expected = "as many receivers as points")]
fn lengths_that_differ_are_refused() {
    views()[0].receivers(&[], &mut [Err(Place::Outside)]);
}
