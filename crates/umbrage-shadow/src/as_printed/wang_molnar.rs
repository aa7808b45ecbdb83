//! Wang & Molnar 1994, Fig. 10.

/// How the listing's last line divides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Division {
    /// As fractions, which is what the paper means.
    Float,
    /// As the C of the listing reads: whole numbers, so that whatever is not wholly lit is dark.
    Integer,
}

/// The fraction of a pixel that is *illuminated*, 1 is lit: the listing returns the complement of a shadow.
///
/// `second` holds the nearby samples of the depth map, +∞ for none, and `virtual_samples` the depths of the tangent plane at the same places;
/// the shorter of both counts, and without any the pixel is dark. The counter begins at 0, as it must have; virtual samples are compared by the
/// printed `<`, so that a flat sheet shadows itself; there is no bias, and no rule for edge-on planes. The listing
/// leaves open where the counts come from, how many samples are near and what lies outside the map.
pub fn percent_illumination(camera: f32, second: &[f32], virtual_samples: &[f32], division: Division) -> f32 {
    let samples = second.len().min(virtual_samples.len());
    let lit = second[..samples].iter().filter(|&&second| camera <= second).count();
    if lit == 0 {
        return 0.0;
    }
    if lit == samples {
        return 1.0;
    }
    let lit = virtual_samples.iter().zip(second).filter(|(at, second)| at < second).count();
    match division {
        Division::Float => lit as f32 / samples as f32,
        Division::Integer => (lit / samples) as f32,
    }
}
