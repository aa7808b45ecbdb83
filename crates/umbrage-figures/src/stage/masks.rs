//! Where a picture is measured: masks over its pixels, its pixels as points, and the faults over them.

use umbrage_oracle::metrics::{self, Grid};
use umbrage_plane::SurfacePoint;
use umbrage_render::{NOTHING, Picture};

/// Pixels of one surface where metric M2 looks: wholly lit in truth, `border` pixels away from any shadow, facing the
/// light by more than .05, and of an object that `keep` accepts.
pub fn lit(truth: &Picture, border: usize, keep: impl Fn(u32) -> bool) -> Vec<bool> {
    let lit = metrics::lit_mask(shadow_grid(truth), &truth.facing[0], border, 0.05);
    metrics::both(&lit, &of(truth, keep))
}

/// False shadow over what `keep` accepts (M2), `border` pixels away from truth's shadows.
pub fn acne(picture: &Picture, truth: &Picture, border: usize, keep: impl Fn(u32) -> bool) -> f64 {
    value(metrics::false_shadow(&picture.shadow[0], &lit(truth, border, keep)))
}

/// Light where truth is shadowed, on surfaces that face the light by more than .05 (M8), `border` pixels away from truth's light.
pub fn leak(picture: &Picture, truth: &Picture, border: usize) -> f64 {
    let dark = metrics::dark_mask(shadow_grid(truth), &truth.facing[0], border, 0.05);
    value(metrics::leak(&picture.shadow[0], &metrics::both(&dark, &of(truth, |_| true))))
}

/// The fraction of the same pixels that are lit by more than `most`: how widely false light spreads, however faint it is.
pub fn leak_area(picture: &Picture, truth: &Picture, border: usize, most: f32) -> f64 {
    let dark = metrics::dark_mask(shadow_grid(truth), &truth.facing[0], border, 0.05);
    let dark = metrics::both(&dark, &of(truth, |_| true));
    let lights: Vec<f32> =
        picture.shadow[0].iter().zip(&dark).filter(|(_, dark)| **dark).map(|(s, _)| 1.0 - s).collect();
    let lit = lights.iter().filter(|light| **light > most).count();
    // NaN where no pixel is dark.
    lit as f64 / lights.len() as f64
}

/// What a picture's pixels see, as points; a pixel that sees nothing is left out.
pub fn points_of(picture: &Picture) -> Vec<SurfacePoint> {
    let seen = (0..picture.object.len()).filter(|&i| picture.object[i] != NOTHING);
    seen.map(|i| {
        let point = SurfacePoint::at(picture.position[i], picture.normal[i]);
        SurfacePoint { region: i as u32, object: picture.object[i], ..point }
    })
    .collect()
}

/// Pixels wholly covered by an object that `keep` accepts.
pub fn of(picture: &Picture, keep: impl Fn(u32) -> bool) -> Vec<bool> {
    picture.object.iter().zip(&picture.share).map(|(&object, &share)| share == 1.0 && keep(object)).collect()
}

/// The shadow of light 0 as a metric's image.
pub fn shadow_grid(picture: &Picture) -> Grid<'_> {
    Grid::new(&picture.shadow[0], picture.size.x as usize)
}

/// A measure's value, NaN where there was nothing to measure: NaN meets no bound.
pub fn value(measured: Option<f64>) -> f64 {
    measured.unwrap_or(f64::NAN)
}
