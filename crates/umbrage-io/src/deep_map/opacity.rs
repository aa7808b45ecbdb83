use umbrage_depth::Step;

/// The opacities of a texel's surfaces, one after the other, as compositing wants them: each of its surface alone, what is in front of it
/// left out. That is 1 − V / V′, of the transmittance V behind it and V′ before it.
///
/// V′ is what the rounded opacities before it have left, not what was to be left: roundings do not add up.
#[derive(Debug)]
pub(super) struct Opacities {
    /// Accumulated from the rounded opacities: mean of the channels, red, green, blue.
    passed: [f64; 4],
}

impl Opacities {
    /// In front of the first surface.
    pub(super) fn start() -> Self {
        Self { passed: [1.0; 4] }
    }

    /// Of the next surface: to the mean of the channels, to red, to green and to blue, 0..=1. Behind a surface that is fully opaque
    /// all are 1.
    pub(super) fn next(&mut self, step: &Step) -> [f32; 4] {
        let [r, g, b] = step.passes.as_dvec3().to_array();
        let mut behind = [(r + g + b) / 3.0, r, g, b].into_iter();
        self.passed.each_mut().map(|passed| {
            let share = behind.next().filter(|_| *passed > 0.0).map_or(0.0, |behind| behind / *passed);
            let opacity = (1.0 - share).clamp(0.0, 1.0) as f32;
            *passed *= 1.0 - f64::from(opacity);
            opacity
        })
    }
}
