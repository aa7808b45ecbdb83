//! Keyed randomness (C-9): streams are apart, uniform, and the same for one sample as for sixteen.

use rand::Rng;
use umbrage_sample::Key;

const KEY: Key = Key::new(1987, 0, 0);

#[test]
fn c_9_streams_of_lights_frames_and_seeds_are_apart() {
    let keys =
        [Key::new(0, 0, 0), Key::new(1, 0, 0), Key::new(0, 1, 0), Key::new(0, 0, 1), Key::new(0, 0, 0).region(0)];
    for (i, a) in keys.iter().enumerate() {
        for b in &keys[..i] {
            assert_ne!(a.bits(0, 0), b.bits(0, 0));
        }
    }
    // 2¹⁶ regions: a share of equal first numbers that 32 independent bits would give (0.5 expected).
    let mut first: Vec<u32> = (0..1 << 16).map(|region| keys[0].region(region).bits(0, 0)).collect();
    first.sort_unstable();
    let equal = first.windows(2).filter(|pair| pair[0] == pair[1]).count();
    assert!(equal <= 5, "{equal} regions share their first number");
}

/// Bits of a byte are spread over 256 values: χ² of 255 degrees of freedom stays below its mean plus five deviations.
#[test]
fn c_9_dimensions_are_uniform() {
    for dim in 0..8 {
        let mut held = [0f64; 256];
        for region in 0..1 << 12 {
            for sample in 0..16 {
                held[(KEY.region(region).bits(sample, dim) >> 24) as usize] += 1.0;
            }
        }
        let chi_squared: f64 = held.iter().map(|count| (count - 256.0).powi(2) / 256.0).sum();
        assert!(chi_squared < 255.0 + 5.0 * 510f64.sqrt(), "dimension {dim}: {chi_squared}");
    }
}

#[test]
fn c_9_numbers_keep_to_their_intervals() {
    for sample in 0..10_000 {
        let (unit, signed) = (KEY.unit(sample, 0), KEY.signed(sample, 0));
        assert!((0.0..1.0).contains(&unit) && (-1.0..1.0).contains(&signed));
        assert_eq!(signed, unit * 2.0 - 1.0);
    }
}

#[test]
fn c_9_streams_are_named_by_their_key() {
    let draw = |key: Key| key.rng().next_u64();
    assert_eq!(draw(KEY), draw(Key::new(1987, 0, 0)));
    assert_ne!(draw(KEY), draw(KEY.region(0)));
}
