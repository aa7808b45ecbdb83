//! Points looked up in a map.

use crate::typed::{facets, run_with, text};

#[test]
fn lines_are_answered_in_their_order() {
    let map = facets("lookup-order");
    // More than one batch, a header, empty lines, and footprints.
    let mut input = String::from("x,y,z,nx,ny,nz,ux,uy,uz,vx,vy,vz\n\n");
    let mut expected = String::new();
    for k in 0..10_000 {
        let dark = k % 3 == 0;
        let place = if dark { "0 0 0" } else { "150, 0, 150" };
        let foot = if k % 2 == 0 { "" } else { " .1 0 0 0 0 .1" };
        input.extend([place, " 0 2.5 0", foot, "\r\n"]);
        expected += if dark { "1.000000000\n" } else { "0.000000000\n" };
    }
    let ran = run_with(&input, &["lookup", text(&map), "-q"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    assert!(ran.out == expected);
}

#[test]
fn a_bad_line_is_named_and_nothing_before_it_is_lost() {
    let map = facets("lookup-bad");
    let bad = [
        ("0 0 0 0 one 0", "ny is one: expected a finite number"),
        ("0 0 NaN 0 1 0", "z is NaN: expected a finite number"),
        ("0 0 inf 0 1 0", "z is inf: expected a finite number"),
        ("0 0 0 0 0 0", "nx ny nz is 0 0 0: expected a direction"),
        ("0 0 0 0 1", "there are 5 numbers: expected x y z nx ny nz, and perhaps ux uy uz vx vy vz"),
        ("1 2 3 4 5 6 7 8 9 10 11 12 13", "there are more than 12 numbers"),
    ];
    for (line, problem) in bad {
        let input = format!("0 0 0 0 1 0\n150 0 150 0 1 0\n{line}\n0 0 0 0 1 0\n");
        let ran = run_with(&input, &["lookup", text(&map), "-q"]);
        assert_eq!((ran.code, ran.out.as_str()), (1, "1.000000000\n0.000000000\n"), "{line}");
        assert_eq!(ran.err, format!("error: standard input: line 3: {problem}\n"));
        let ran = run_with(&input, &["lookup", text(&map), "-q", "--keep-going"]);
        assert_eq!((ran.code, ran.out.as_str()), (0, "1.000000000\n0.000000000\nNaN\n1.000000000\n"), "{line}");
    }
    let endless = format!("{}\n0 0 0 0 1 0\n", "1".repeat(100_000));
    let ran = run_with(&endless, &["lookup", text(&map), "-q"]);
    assert_eq!(ran.code, 1);
    assert!(ran.err.contains("line 1: it is longer than"), "{}", ran.err);
    let ran = run_with(&endless, &["lookup", text(&map), "-q", "--keep-going"]);
    assert_eq!((ran.code, ran.out.as_str()), (0, "NaN\n1.000000000\n"));
}
