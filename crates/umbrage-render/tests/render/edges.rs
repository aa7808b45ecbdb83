//! Edges of shadow images made smooth (W78-16).

use glam::UVec2;
use umbrage_render::post::dequantise_edges;

fn image(rows: &[&str]) -> (UVec2, Vec<f32>) {
    let size = UVec2::new(rows[0].len() as u32, rows.len() as u32);
    (size, rows.iter().flat_map(|row| row.bytes().map(|b| if b == b'#' { 1.0 } else { 0.0 })).collect())
}

#[test]
fn w78_16_window_zero_changes_nothing() {
    let (size, before) = image(&["....", ".##.", ".#.#", "...."]);
    assert_eq!(dequantise_edges(size, &before, 0), before);
    let (size, holed) = image(&["#####", "#...#", "#.#.#", "#...#", "#####"]);
    assert_eq!(dequantise_edges(size, &holed, 0), holed);
}

#[test]
fn w78_16_isolated_pixels_nearly_vanish_and_staircases_turn_grey() {
    let (size, dot) = image(&[".....", ".....", "..#..", ".....", "....."]);
    assert!(dequantise_edges(size, &dot, 2).iter().sum::<f32>() <= 0.0625);
    let rows: Vec<String> = (0..16).map(|y| (0..16).map(|x| if x < y { '#' } else { '.' }).collect()).collect();
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let (size, stairs) = image(&rows);
    let smooth = dequantise_edges(size, &stairs, 2);
    let grey = smooth.iter().filter(|v| **v > 0.0 && **v < 1.0).count();
    assert!(grey > 12, "{grey} grey pixels");
    // The border's own cracks stay where they are.
    assert_eq!(smooth[8 * 16], 1.0);
}
