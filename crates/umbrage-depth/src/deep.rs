use crate::translucent::transmittance;
use crate::{DepthMap, MapError, Step, Translucent, no_surface};
use glam::{DVec3, IVec2, Vec3};
use std::borrow::Cow;
use umbrage_plane::{TexelRect, View};

/// Several surfaces per texel, each letting part of the light through: a deep shadow map (Lokovic & Veach 2000, as Burley 2006 uses
/// it).
///
/// A texel's transmittance is 1 down to its first surface and steps down at each: a surface at a depth does not shadow that depth.
/// As a [`DepthMap`] it answers with the nearest surface, opaque or not; what passes is its [`Translucent`] half.
#[derive(Clone, Debug, PartialEq)]
pub struct DeepMap {
    view: View,
    epsilon: f32,
    /// Where each texel's steps begin, row by row; one entry more than texels.
    starts: Vec<usize>,
    steps: Vec<Step>,
    grey: bool,
}

impl DeepMap {
    /// From the steps of each texel of `view`, row by row, row 0 on top; none where there is no surface. They are kept as they are: see
    /// [`compress_steps`]. `epsilon` is how far they may stand from what they were made from, 0 for not at all.
    ///
    /// # Errors
    /// When texels are missing or left over, depths of a texel do not ascend, are not finite or reach 1e30, or what passes is outside 0..=1 or grows;
    /// and for an `epsilon` outside 0..1.
    pub fn new(view: View, epsilon: f32, texels: impl IntoIterator<Item = Vec<Step>>) -> Result<Self, MapError> {
        if !(0.0..1.0).contains(&epsilon) {
            return Err(MapError::Epsilon(epsilon));
        }
        let size = view.size();
        let (mut starts, mut all, mut grey) = (vec![0], Vec::new(), true);
        let mut texels = texels.into_iter();
        for (texel, steps) in TexelRect::of_size(size).texels().zip(texels.by_ref()) {
            let mut before = Step { depth: f32::NEG_INFINITY, passes: Vec3::ONE };
            for step in steps {
                let problem = if no_surface::kept(step.depth) == f32::INFINITY {
                    "a depth that is none"
                } else if step.depth <= before.depth {
                    "depths that do not ascend"
                } else if !(step.passes.cmpge(Vec3::ZERO) & step.passes.cmple(before.passes)).all() {
                    "a transmittance that grows, or is not within 0 and 1"
                } else {
                    grey &= step.passes == Vec3::splat(step.passes.x);
                    all.push(step);
                    before = step;
                    continue;
                };
                return Err(MapError::NotSteps { texel, problem });
            }
            starts.push(all.len());
        }
        let wanted = size.x as usize * size.y as usize;
        let found = starts.len() - 1 + texels.count();
        if found != wanted {
            return Err(MapError::Length { width: size.x, height: size.y, found });
        }
        Ok(Self { view, epsilon, starts, steps: all, grey })
    }

    /// How far a transmittance may stand from the one it was made from, in every channel and at every depth.
    pub fn epsilon(&self) -> f32 {
        self.epsilon
    }

    /// The surfaces of a texel, nearest first; none outside the map.
    #[inline(always)]
    pub fn steps(&self, texel: IVec2) -> &[Step] {
        let rect = TexelRect::of_size(self.view.size());
        if !rect.contains(texel) {
            return &[];
        }
        let index = texel.y as usize * rect.size().x as usize + texel.x as usize;
        &self.steps[self.starts[index]..self.starts[index + 1]]
    }

    /// Fraction of the light that passes all surfaces of a texel nearer than `depth`, linear RGB; all of it for NaN.
    #[inline(always)]
    pub fn transmittance(&self, texel: IVec2, depth: f32) -> Vec3 {
        transmittance(self.steps(texel), depth)
    }
}

impl DepthMap for DeepMap {
    fn view(&self) -> &View {
        &self.view
    }

    #[inline(always)]
    fn depth(&self, texel: IVec2) -> f32 {
        self.steps(texel).first().map_or(f32::INFINITY, |step| step.depth)
    }

    #[inline(always)]
    fn translucent(&self) -> Option<&dyn Translucent> {
        Some(self)
    }

    /// 16 per surface: its depth and three transmittances. The table that finds a texel's surfaces, 8 per texel, is left out as everywhere.
    fn bytes(&self) -> usize {
        size_of_val(self.steps.as_slice())
    }

    fn allocated(&self) -> usize {
        self.bytes() + size_of_val(self.starts.as_slice()) + size_of::<Self>()
    }
}

impl Translucent for DeepMap {
    #[inline(always)]
    fn steps(&self, texel: IVec2) -> Cow<'_, [Step]> {
        Cow::Borrowed(self.steps(texel))
    }

    fn is_grey(&self) -> bool {
        self.grey
    }

    #[inline(always)]
    fn transmittance(&self, texel: IVec2, depth: f32) -> Vec3 {
        self.transmittance(texel, depth)
    }
}

/// Fewer steps that stand nowhere farther than `epsilon` from the given ones, in any channel: each kept step stands for the longest
/// run of levels that one number is near enough to. No other choice of levels has fewer steps, since levels only fall.
///
/// The first surface keeps its depth and nothing is dark before it, so that searches find it where it was (Burley 2006). 0 loses nothing but steps at
/// which nothing changes. `steps` must be as in [`DeepMap::new`].
pub fn compress_steps(steps: &[Step], epsilon: f32) -> Vec<Step> {
    let mut kept: Vec<Step> = Vec::new();
    let mut start = 0;
    while start < steps.len() {
        let first = steps[start];
        let fits = |end: &usize| level(first.passes, steps[*end].passes, epsilon).is_some();
        let end = (start + 1..steps.len()).take_while(fits).last().unwrap_or(start);
        let (last, wanted) = (steps[end].passes, end + 1 == steps.len());
        // At the end the light that really is left, if it is near enough to the whole run: so what is opaque mostly stays so.
        let fall = first.passes.as_dvec3() - last.as_dvec3();
        let exact = wanted && fall.cmple(DVec3::splat(f64::from(epsilon))).all();
        let passes = if exact { last } else { level(first.passes, last, epsilon).unwrap_or(first.passes) };
        let unchanged = kept.last().is_some_and(|before| before.passes == passes);
        if !unchanged {
            kept.push(Step { depth: first.depth, passes });
        }
        start = end + 1;
    }
    kept
}

/// A level between `high` and `low` that is within `epsilon` of both, channel by channel, rounding included.
fn level(high: Vec3, low: Vec3, epsilon: f32) -> Option<Vec3> {
    let between = (high + low) * 0.5;
    let near = |level: Vec3| {
        let far = (high.as_dvec3() - level.as_dvec3()).abs().max((level.as_dvec3() - low.as_dvec3()).abs());
        far.max_element() <= f64::from(epsilon)
    };
    [between, high, low].into_iter().find(|level| near(*level))
}
