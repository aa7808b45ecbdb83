//! Faults in colours over truth.

use glam::Vec3;
use umbrage_oracle::judge::Where;

/// Colours of the faults, linear RGB, with their names and what the legend calls the colours. They are of different brightness, too.
pub const FAULTS: [(&str, &str, Vec3); 5] = [
    ("acne", "orange", Vec3::new(1.0, 0.3, 0.0)),
    ("detachment", "cyan", Vec3::new(0.0, 0.75, 1.0)),
    ("leak", "magenta", Vec3::new(0.9, 0.0, 0.6)),
    ("other false shadow", "brown", Vec3::new(0.25, 0.07, 0.01)),
    ("other false light", "blue", Vec3::new(0.02, 0.06, 0.5)),
];

/// The fault of each pixel, as its place in [`FAULTS`].
pub fn kinds(places: &Where) -> impl Iterator<Item = Option<usize>> + '_ {
    let marked = |mask: &Option<Vec<bool>>, pixel: usize| mask.as_ref().is_some_and(|mask| mask[pixel]);
    (0..places.acne.len()).map(move |pixel| {
        let faults = [
            places.acne[pixel],
            marked(&places.detachment, pixel),
            marked(&places.leak, pixel),
            places.false_shadow[pixel],
            places.false_light[pixel],
        ];
        faults.iter().position(|fault| *fault)
    })
}

/// Truth, 1 dark, in dim greys, with the faults in colours; what is not judged is darker.
pub fn all(places: &Where, judged: &[bool], truth: &[f32]) -> Vec<Vec3> {
    let pixel = |(pixel, fault): (usize, Option<usize>)| {
        fault.map_or_else(|| plain(judged[pixel], truth[pixel]), |fault| FAULTS[fault].2)
    };
    kinds(places).enumerate().map(pixel).collect()
}

/// The same with one fault alone, its pixels in a colour.
pub fn one(fault: &[bool], colour: Vec3, judged: &[bool], truth: &[f32]) -> Vec<Vec3> {
    let pixel = |pixel: usize| if fault[pixel] { colour } else { plain(judged[pixel], truth[pixel]) };
    (0..truth.len()).map(pixel).collect()
}

fn plain(judged: bool, truth: f32) -> Vec3 {
    let lit = 0.08 + 0.3 * (1.0 - truth.clamp(0.0, 1.0));
    Vec3::splat(if judged { lit } else { 0.4 * lit })
}
