//! Names of files.

#[path = "../../src/names.rs"]
mod names;

use names::{distinct, file, plain};
use std::path::Path;

#[test]
fn any_name_becomes_one_that_file_systems_take() {
    for (name, expected) in [
        ("Key Light", "Key_Light"),
        ("a/b\\c:d", "a_b_c_d"),
        ("../../etc/passwd", "_._.._etc_passwd"),
        (".hidden", "_hidden"),
        ("", "_"),
        ("Spot.001", "Spot.001"),
        ("Sonnenlicht-süd", "Sonnenlicht-s_d"),
    ] {
        assert_eq!(plain(name), expected);
    }
}

#[test]
fn equal_names_are_numbered() {
    let names = ["lamp", "Lamp", "lamp", "lamp-2", "LAMP"];
    assert_eq!(distinct(names), ["lamp", "Lamp-2", "lamp-3", "lamp-2-2", "LAMP-4"]);
}

#[test]
fn files_stay_in_their_folder() {
    let of = |light, parts: &[&str]| file(Path::new("out"), "../scene", light, parts, "png");
    assert_eq!(of(None, &[]), Path::new("out/_._scene.png"));
    assert_eq!(of(Some("key"), &["area"]), Path::new("out/_._scene.key.area.png"));
}
