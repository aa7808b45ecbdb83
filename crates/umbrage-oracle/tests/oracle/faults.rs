//! Each named fault is found where it was put, and no other.
use glam::DVec2;
use umbrage_oracle::metrics::Grid;
use umbrage_oracle::{Contact, Evidence, Faults, faults, heat, penumbra_width};

const SIDE: usize = 64;

/// The shadow of a block on the right half: a ramp `width` pixels wide about column `edge`.
fn shadow(edge: f64, width: f64) -> Vec<f32> {
    let pixels = (0..SIDE * SIDE).map(|i| (i % SIDE) as f64 + 0.5);
    pixels.map(|x| ((x - edge) / width + 0.5).clamp(0.0, 1.0) as f32).collect()
}

fn judged(result: &[f32], truth: &[f32]) -> Faults {
    let contacts =
        [Contact { foot: DVec2::new(28.0, 10.0), toward: DVec2::X, world_per_pixel: 0.5, world_per_texel: 0.25 }];
    faults(&Evidence {
        result: Grid::new(result, SIDE),
        truth: Grid::new(truth, SIDE),
        smooth: None,
        facing: &[0.7; SIDE * SIDE],
        border: 6,
        contacts: &contacts,
    })
}

fn zero_but(faults: &Faults, name: &str) {
    for (fault, value) in [
        ("acne", &faults.acne),
        ("leak", &faults.leak),
        ("detachment", &faults.detachment),
        ("edge_shift", &faults.edge_shift),
        ("penumbra_width", &faults.penumbra_width),
        ("noise", &faults.noise),
    ] {
        assert_eq!(value.map.len(), SIDE * SIDE);
        if !name.contains(fault) {
            let amount = value.value.expect("everything can be measured here");
            assert!(amount.abs() < 1e-6, "{fault} is {amount}");
            assert!(value.map.iter().all(|value| value.abs() < 1e-6), "{fault}'s map is not empty");
        }
    }
}

#[test]
fn truth_has_no_fault() {
    let truth = shadow(32.0, 5.0);
    zero_but(&judged(&truth, &truth), "");
}

#[test]
fn acne_and_leaks() {
    let truth = shadow(32.0, 5.0);
    let mut result = truth.clone();
    result[5 * SIDE + 3] = 1.0;
    let found = judged(&result, &truth);
    assert!(found.acne.value.unwrap() > 0.0);
    assert_eq!(found.acne.map[5 * SIDE + 3], 1.0);
    zero_but(&found, "acne penumbra_width");

    let mut result = truth.clone();
    result[5 * SIDE + 60] = 0.25;
    let found = judged(&result, &truth);
    assert!(found.leak.value.unwrap() > 0.0);
    assert_eq!(found.leak.map[5 * SIDE + 60], -0.75);
    zero_but(&found, "leak penumbra_width");
}

#[test]
fn m4_m7_shifted_edges() {
    let truth = shadow(32.0, 5.0);
    for shift in [2.0, -1.5] {
        let found = judged(&shadow(32.0 + shift, 5.0), &truth);
        assert!((found.edge_shift.value.unwrap() - shift).abs() < 1e-3, "{shift}");
        let world = found.detachment.value.unwrap();
        assert!((world - 0.5 * shift.max(0.0)).abs() < 1e-2, "{world}");
        assert_eq!(found.detachment_texels.unwrap(), world * 4.0);
        zero_but(&found, "edge_shift detachment penumbra_width noise");
    }
}

#[test]
fn m1_softness() {
    let truth = shadow(32.0, 5.0);
    let found = judged(&shadow(32.0, 10.0), &truth);
    assert!((found.penumbra_width.value.unwrap() - 4.0).abs() < 0.2);
    assert!((penumbra_width(Grid::new(&truth, SIDE)).unwrap() - 4.0).abs() < 0.2);
    assert_eq!(penumbra_width(Grid::new(&[0.0; 16], 4)), None);
    zero_but(&found, "penumbra_width noise");
}

#[test]
fn m6_noise() {
    let truth = shadow(32.0, 8.0);
    let mut result = truth.clone();
    let mut soft = 0;
    for (i, value) in result.iter_mut().enumerate() {
        if *value > 0.0 && *value < 1.0 {
            *value += if (i / SIDE + i).is_multiple_of(2) { 0.05 } else { -0.05 };
            soft += 1;
        }
    }
    assert!(soft > SIDE * 6);
    let found = judged(&result, &truth);
    assert!((found.noise.value.unwrap() - 0.05).abs() < 1e-6);
}

#[test]
fn nothing_to_measure() {
    let found = judged(&[0.0; SIDE * SIDE], &[0.0; SIDE * SIDE]);
    assert_eq!(found.acne.value, Some(0.0));
    assert_eq!(found.detachment_texels, None);
    for fault in [found.leak, found.detachment, found.edge_shift, found.penumbra_width, found.noise] {
        assert_eq!(fault.value, None);
    }
}

#[test]
fn heat_tells_sign_and_size() {
    assert!(heat(1.0).x > heat(1.0).z && heat(-1.0).z > heat(-1.0).x);
    assert_eq!((heat(7.0), heat(-7.0)), (heat(1.0), heat(-1.0)));
    assert_eq!(heat(0.0), heat(-0.0));
    let brightness = |value: f32| heat(value).dot(glam::Vec3::new(0.2126, 0.7152, 0.0722));
    for step in 0..20 {
        let (less, more) = (step as f32 / 20.0, (step + 1) as f32 / 20.0);
        assert!(brightness(more) > brightness(less), "too dark at {more}");
        assert!(brightness(-more) > brightness(-less), "too light at {more}");
    }
    assert_ne!(heat(f32::NAN), heat(0.0));
}

#[test]
fn m7_a_lost_shadow_is_the_worst_detachment() {
    let truth = shadow(32.0, 5.0);
    let lost = judged(&[0.0; SIDE * SIDE], &truth).detachment.value.unwrap();
    let moved = judged(&shadow(40.0, 5.0), &truth).detachment.value.unwrap();
    // From the edge to the border, half a world unit a pixel.
    assert!(lost > moved && (lost - 0.5 * (SIDE as f64 - 32.0)).abs() < 0.5, "{lost} {moved}");
}
