//! What the kept pictures and numbers are compared by.

use glam::{UVec2, Vec3};
use umbrage_figures::catalogue;
use umbrage_figures::goldens::{PICTURES, numbers_differ, picture_differs};

#[test]
fn every_picture_of_the_readme_belongs_to_a_figure() {
    for picture in PICTURES {
        assert!(catalogue::figures().any(|figure| figure.id == picture.figure), "{}", picture.figure);
    }
}

#[test]
fn pictures_may_differ_by_little_in_many_pixels_and_by_much_in_few() {
    let png = |pixels: &[Vec3]| umbrage_io::encode_png(UVec2::new(100, 100), pixels).unwrap();
    let plain = vec![Vec3::splat(0.5); 10_000];
    let lighter = vec![Vec3::splat(0.505); 10_000];
    let mut spotted = plain.clone();
    spotted[..10].fill(Vec3::ONE);
    assert_eq!(picture_differs(&png(&plain), &png(&lighter)), None);
    assert_eq!(picture_differs(&png(&plain), &png(&spotted)), None);
    spotted[10] = Vec3::ONE;
    assert_eq!(picture_differs(&png(&plain), &png(&spotted)).unwrap(), "11 pixels differ by more than 3 codes");
    let small = umbrage_io::encode_png(UVec2::new(1, 1), &[Vec3::ONE]).unwrap();
    assert_eq!(picture_differs(&small, &png(&plain)).unwrap(), "is 1 × 1, but the code makes 100 × 100");
    assert!(picture_differs(b"no picture", &small).is_some());
}

#[test]
fn numbers_that_move_come_or_go_are_reported() {
    let head = "figure,measure,value,unit\n";
    let kept = format!("{head}R87-F7,\"noise, rms\",0.5,share\nR87-F7,old,1,\nW78-F1,discs,4,\nX-1,gone,1,\n");
    let made = format!("{head}R87-F7,\"noise, rms\",0.6,share\nR87-F7,new,1,\n");
    let expected = [
        "R87-F7,\"noise, rms\" [share] is 0.5, but the code makes 0.6",
        "does not hold R87-F7,new []",
        "the code no longer makes R87-F7,old []",
        "the code no longer makes X-1,gone []",
    ];
    assert_eq!(numbers_differ(&kept, &made), expected);
    assert_eq!(numbers_differ(&kept.replace("0.5", "0.6003"), &made).len(), 3, "within the tolerance");
}
