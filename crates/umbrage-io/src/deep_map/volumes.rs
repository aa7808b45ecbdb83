//! Samples of other makers, surfaces and volumes, as the steps of a map.

use glam::{DVec3, Vec3};
use umbrage_depth::Step;

/// How far the steps of a volume may stand from what it lets through, in any channel and at any depth.
pub(super) const VOLUME_BOUND: f32 = 1.0 / 2048.0;

/// What lets part of the light through between two depths, evenly; where the two are one, a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Volume {
    /// Where it begins.
    pub front: f32,
    /// Where it ends, at `front` or behind it; finite.
    pub back: f32,
    /// Fraction of the light that passes all of it, 0..=1.
    pub passes: Vec3,
}

impl Volume {
    fn is_surface(&self) -> bool {
        self.front == self.back
    }

    /// What passes where the light has just gone in: nothing of a colour of which nothing passes the whole, and all of the others.
    fn enters(&self) -> DVec3 {
        let passes = self.passes.as_dvec3();
        if self.is_surface() { passes } else { DVec3::select(passes.cmpeq(DVec3::ZERO), DVec3::ZERO, DVec3::ONE) }
    }

    /// By how much the logarithm of what passes falls with depth.
    fn fades(&self) -> DVec3 {
        let passes = self.passes.as_dvec3();
        let thickness = f64::from(self.back) - f64::from(self.front);
        DVec3::select(passes.cmpeq(DVec3::ZERO), DVec3::ZERO, passes.map(f64::ln) / thickness)
    }
}

/// Samples in any order as steps, and whether these are near to them only; surfaces at one depth are one step.
pub(super) fn in_order(mut volumes: Vec<Volume>) -> (Vec<Step>, bool) {
    volumes.sort_by(|a, b| a.front.total_cmp(&b.front));
    let mut steps: Vec<Step> = Vec::with_capacity(volumes.len());
    if volumes.iter().all(Volume::is_surface) {
        let mut passes = Vec3::ONE;
        for surface in volumes {
            passes *= surface.passes;
            match steps.last_mut() {
                Some(last) if last.depth == surface.front => last.passes = passes,
                _ => steps.push(Step { depth: surface.front, passes }),
            }
        }
        return (steps, false);
    }
    let mut places: Vec<f32> = volumes.iter().flat_map(|volume| [volume.front, volume.back]).collect();
    places.sort_by(f32::total_cmp);
    places.dedup();
    let rates = rates(&places, &volumes);
    let (mut passes, mut left) = (DVec3::ONE, volumes.iter().peekable());
    for (index, front) in places.iter().copied().enumerate() {
        while let Some(volume) = left.next_if(|volume| volume.front <= front) {
            passes *= volume.enters();
        }
        let Some(back) = places.get(index + 1).copied() else {
            push(&mut steps, front, passes.as_vec3());
            break;
        };
        let to = |depth: f32| passes * ((f64::from(depth) - f64::from(front)) * rates[index]).exp();
        fade(&mut steps, [front, back], &|depth| to(depth).as_vec3());
        passes = to(back);
    }
    (steps, true)
}

/// By how much the logarithm of what passes falls with depth, from each place to the next: the sum over all volumes there. A sum for each node of
/// a binary tree over the places, so that many volumes over one another take no longer than as many side by side.
fn rates(places: &[f32], volumes: &[Volume]) -> Vec<DVec3> {
    let count = places.len();
    let mut tree = vec![DVec3::ZERO; 2 * count];
    let place = |depth: f32| count + places.partition_point(|place| *place < depth);
    for volume in volumes.iter().filter(|volume| !volume.is_surface()) {
        let (mut first, mut end, rate) = (place(volume.front), place(volume.back), volume.fades());
        while first < end {
            if first % 2 == 1 {
                tree[first] += rate;
                first += 1;
            }
            if end % 2 == 1 {
                end -= 1;
                tree[end] += rate;
            }
            (first, end) = (first / 2, end / 2);
        }
    }
    let above = |leaf: usize| std::iter::successors(Some(leaf), |node| (*node > 1).then_some(node / 2));
    (count..2 * count).map(|leaf| above(leaf).map(|node| tree[node]).sum()).collect()
}

/// Steps for light that fades between two depths, none where it does not.
fn fade(steps: &mut Vec<Step>, [front, back]: [f32; 2], passes: &dyn Fn(f32) -> Vec3) {
    let mut rest = vec![back];
    let mut from = front;
    while let Some(to) = rest.last().copied() {
        let (high, low) = (passes(from), passes(to));
        let middle = f32::midpoint(from, to);
        let is_near = (high - low).max_element() <= 2.0 * VOLUME_BOUND;
        // Where floats end, so does the thickness of what is left.
        if is_near || middle <= from || middle >= to {
            push(steps, from, (high + low) * 0.5);
            from = to;
            rest.pop();
        } else {
            rest.push(middle);
        }
    }
}

/// Adds what is left behind a depth, which cannot be more than was left before it.
fn push(steps: &mut Vec<Step>, depth: f32, passes: Vec3) {
    match steps.last_mut() {
        Some(last) if last.depth == depth => last.passes = passes.min(last.passes),
        Some(last) => {
            let passes = passes.min(last.passes);
            if passes != last.passes {
                steps.push(Step { depth, passes });
            }
        }
        None => steps.push(Step { depth, passes }),
    }
}
