//! WM94-18, D-10: is there a bias that does?
use std::f64::consts::FRAC_PI_2;
use umbrage_depth::Stored;
use umbrage_oracle::predict::{expected_contact_gap, no_bias_works};
use umbrage_oracle::{BiasCase, BiasSearch, BiasWindow};

/// V57's floor: 1000 world units over a map of `side` texels.
fn case(side: u32, elevation_deg: f64, thickness: f64, radius: f64) -> BiasCase {
    let elevation = elevation_deg.to_radians();
    let (texel_world, slope) = (1000.0 / f64::from(side), 1.0 / elevation.tan());
    BiasCase { texel_world, radius, slope, thickness, elevation, stored: Stored::First }
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-6, "{a} is not {b}");
}

#[test]
fn v57_d_10_contact_gaps() {
    let elevation = 45f64.to_radians();
    for (stored, wide, narrow) in [
        (Stored::First, 6.606_602, 0.0),
        (Stored::Midpoint, 8.606_602, 1.535_534),
        (Stored::Second, 10.606_602, 3.535_534),
    ] {
        near(expected_contact_gap(15.0, 4.0, elevation, stored), wide);
        near(expected_contact_gap(5.0, 4.0, elevation, stored), narrow);
    }
}

#[test]
fn v57_d_10_windows() {
    for (side, thickness, radius, need, allow) in [
        (512, 1.0, 0.0, 1.691_456, 1.154_701),
        (2048, 1.0, 0.0, 0.422_864, 1.154_701),
        (512, 4.0, 3.0, 11.840_191, 4.618_802),
    ] {
        let case = case(side, 30.0, thickness, radius);
        let window = case.window();
        near(window.acne_free.unwrap(), need);
        near(window.keeps_contact.unwrap(), allow);
        assert_eq!(window.works(), need <= allow);
        assert_eq!(window.works(), !no_bias_works(case.texel_world, radius, thickness, case.elevation));
        // The window says where the gap begins.
        near(expected_contact_gap(allow, thickness, case.elevation, Stored::First), 0.0);
        assert!(expected_contact_gap(allow + 0.1, thickness, case.elevation, Stored::First) > 0.0);
    }
}

#[test]
fn d_10_inverse_gives_the_smallest_map_that_works() {
    for stored in [Stored::First, Stored::Midpoint, Stored::Second] {
        for (thickness, radius) in [(1.0, 0.0), (4.0, 3.0), (0.3, 1.0)] {
            let at = |side| BiasCase { stored, ..case(side, 30.0, thickness, radius) };
            let side = at(512).side_needed(512).unwrap();
            assert!(at(side).window().works(), "{stored:?} {thickness} {radius}: {side}");
            assert!(!at(side - 1).window().works(), "{stored:?} {thickness} {radius}: {side}");
            near(at(100).widest_texel(), at(900).widest_texel());
        }
    }
    // 512 · 1.691456 / 1.154701 = 750.
    assert_eq!(case(512, 30.0, 1.0, 0.0).side_needed(512), Some(750));
    assert_eq!(case(512, 30.0, 0.0, 0.0).side_needed(512), None, "nothing holds a sheet's contact");
}

#[test]
fn wm94_17_second_surfaces_need_no_bias_where_parts_are_thicker_than_a_step() {
    let thick = BiasCase { stored: Stored::Second, ..case(512, 30.0, 2.0, 0.0) };
    assert_eq!(thick.window(), BiasWindow { acne_free: Some(0.0), keeps_contact: Some(0.0) });
    let thin = BiasCase { thickness: 1.0, ..thick };
    assert!(!thin.window().works());
    near(thin.window().acne_free.unwrap(), 0.691_456);
}

#[test]
fn under_the_zenith_any_bias_does() {
    let zenith = BiasCase { slope: 0.0, elevation: FRAC_PI_2, ..case(512, 30.0, 1.0, 2.0) };
    assert_eq!(zenith.window(), BiasWindow { acne_free: Some(0.0), keeps_contact: Some(f64::INFINITY) });
    assert_eq!((zenith.widest_texel(), zenith.side_needed(512)), (f64::INFINITY, Some(1)));
}

#[test]
fn wm94_18_says_it_in_one_line() {
    assert_eq!(
        case(512, 30.0, 1.0, 0.0).window().to_string(),
        "false shadow ends at a bias of 1.6915 world units, contact holds up to 1.1547 world units: no bias works"
    );
    assert_eq!(
        BiasWindow { acne_free: Some(0.5), keeps_contact: Some(f64::INFINITY) }.to_string(),
        "false shadow ends at a bias of 0.5000 world units, contact holds at any: a bias works"
    );
    assert_eq!(
        BiasWindow { acne_free: None, keeps_contact: None }.to_string(),
        "false shadow ends at no bias, contact holds at none: no bias works"
    );
}

const TRY: BiasSearch = BiasSearch { range: (0.0, 40.0), sweep: 17, halvings: 20, most_acne: 0.01, most_gap: 0.5 };

#[test]
fn wm94_18_search_finds_what_is_predicted() {
    for side in [512, 2048] {
        let case = case(side, 30.0, 1.0, 0.0);
        let predicted = case.window();
        let measure = |bias: f64| {
            let acne = umbrage_oracle::predict::false_shadow_share(case.texel_world * case.slope, 0.0, (bias, bias));
            (acne, expected_contact_gap(bias, 1.0, case.elevation, Stored::First))
        };
        let found = BiasSearch { most_acne: 0.0, most_gap: 0.0, ..TRY }.run(measure);
        near_by(found.acne_free.unwrap(), predicted.acne_free.unwrap());
        near_by(found.keeps_contact.unwrap(), predicted.keeps_contact.unwrap());
        assert_eq!(found.works(), predicted.works());
        // What is answered was measured and is fine.
        assert_eq!(measure(found.acne_free.unwrap()).0, 0.0);
        assert_eq!(measure(found.keeps_contact.unwrap()).1, 0.0);
    }
}

fn near_by(found: f64, predicted: f64) {
    assert!((found - predicted).abs() < 40.0 / 16.0 / 1e6 + 1e-9, "{found} is not {predicted}");
}

#[test]
fn wm94_18_search_says_when_none_exists_and_when_all_do() {
    let never = TRY.run(|_| (1.0, 9.0));
    assert_eq!(never, BiasWindow { acne_free: None, keeps_contact: None });
    assert!(!never.works());
    let always = TRY.run(|_| (0.0, 0.0));
    assert_eq!(always, BiasWindow { acne_free: Some(0.0), keeps_contact: Some(40.0) });
    assert!(always.works());
    assert_eq!(TRY.run(|_| (f64::NAN, f64::NAN)), never, "NaN is no answer");
    let last = TRY.run(|bias| (if bias < 40.0 { 1.0 } else { 0.0 }, if bias > 0.0 { 1.0 } else { 0.0 }));
    assert!(last.acne_free.unwrap() > 39.99 && last.keeps_contact.unwrap() < 0.01);
}

#[test]
fn wm94_18_search_is_not_fooled_by_a_relapse() {
    // Free of acne at 5 by chance, again dark in 10..12; a gap that closes again.
    let measure = |bias: f64| {
        let acne = if bias < 4.0 || (10.0..12.0).contains(&bias) { 1.0 } else { 0.0 };
        (acne, if (20.0..24.0).contains(&bias) || bias > 30.0 { 3.0 } else { 0.0 })
    };
    let mut asked = 0;
    let found = TRY.run(|bias| {
        asked += 1;
        measure(bias)
    });
    near_by(found.acne_free.unwrap(), 12.0);
    near_by(found.keeps_contact.unwrap(), 20.0);
    assert_eq!(asked, TRY.sweep + 2 * TRY.halvings);
}
