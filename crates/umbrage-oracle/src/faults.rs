use crate::metrics::{
    Grid, Profile, both, contact_gap, contour, dark_mask, deviation, false_shadow, leak, lit_mask, offsets,
    penumbra_mask, rms,
};
use glam::{DVec2, Vec3};
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;
use umbrage_shadow::Shadow;

/// What a shadow image is judged by. All images are of one size.
#[derive(Clone, Copy, Debug)]
pub struct Evidence<'a> {
    /// The image to judge, 1 dark.
    pub result: Grid<'a>,
    /// The oracle's.
    pub truth: Grid<'a>,
    /// The result without its noise (many samples), for [`Faults::noise`]; `None`: truth.
    pub smooth: Option<Grid<'a>>,
    /// Cosine between geometric normal and light per pixel; 0 where nothing is seen.
    pub facing: &'a [f32],
    /// Width in pixels of what belongs to truth's edges: the filter's width. Acne and leaks are looked for farther
    /// away, edges nearer.
    pub border: usize,
    /// Where things stand on their shadows; may be empty.
    pub contacts: &'a [Contact],
}

/// A place at which a shadow should begin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Where the caster touches the receiver, pixels.
    pub foot: DVec2,
    /// Direction in which its shadow falls, pixels.
    pub toward: DVec2,
    /// World units of the receiver that a pixel's step in that direction spans.
    pub world_per_pixel: f64,
    /// World units that a texel of the map spans there.
    pub world_per_texel: f64,
}

/// One fault: how much of it, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// In the unit that [`Faults`] gives. `None` when the picture has no place for it (no lit pixel, no edge ..).
    pub value: Option<f64>,
    /// Per pixel, in the unit given there; 0 where there is none. [`heat`] makes colours of it.
    pub map: Vec<f32>,
}

/// The named faults of a shadow image.
#[derive(Clone, Debug, PartialEq)]
pub struct Faults {
    /// Shadow where truth is lit, away from its edges: mean, 0..1. Map: the shadow, 0..1.
    pub acne: Fault,
    /// Light where truth is dark, away from its edges: mean, 0..1. Map: minus the light, −1..0.
    pub leak: Fault,
    /// Lit gap between contacts and their shadows beyond truth's own: mean, world units. A shadow that is lost altogether
    /// counts with the way to the picture's border. Map: the gap in world units at each pixel of it.
    pub detachment: Fault,
    /// The same mean in texels of the map; `None` without a contact that has a shadow.
    pub detachment_texels: Option<f64>,
    /// Displacement of the ½-contour: mean, pixels, positive where the shadow is too small. Map: the same.
    pub edge_shift: Fault,
    /// Width between 10 % and 90 % beyond truth's own, pixels; negative when the edge is too sharp. Map: ±1 where only
    /// the result (+) or only truth (−) is between.
    pub penumbra_width: Fault,
    /// Root mean square deviation from the smooth reference inside its penumbra, 0..1. Map: signed.
    pub noise: Fault,
}

/// Finds the faults.
pub fn faults(evidence: &Evidence) -> Faults {
    let Evidence { result, truth, facing, border, .. } = *evidence;
    let lit = lit_mask(truth, facing, border, 0.05);
    let dark = dark_mask(truth, facing, border, 0.0);
    let smooth = evidence.smooth.unwrap_or(truth);
    let soft = penumbra_mask(smooth.values);
    let (detachment, detachment_texels) = detachment(evidence);
    Faults {
        acne: Fault { value: false_shadow(result.values, &lit), map: masked(&lit, |i| result.values[i]) },
        leak: Fault { value: leak(result.values, &dark), map: masked(&dark, |i| result.values[i] - 1.0) },
        detachment,
        detachment_texels,
        edge_shift: edge_shift(result, truth, border),
        penumbra_width: softness(result, truth),
        noise: Fault {
            value: rms(result.values, smooth.values, &soft),
            map: masked(&soft, |i| result.values[i] - smooth.values[i]),
        },
    }
}

fn masked(mask: &[bool], value: impl Fn(usize) -> f32) -> Vec<f32> {
    mask.iter().enumerate().map(|(index, &inside)| if inside { value(index) } else { 0.0 }).collect()
}

fn edge_shift(result: Grid, truth: Grid, border: usize) -> Fault {
    let reach = border.max(1) as f64;
    let mut map = vec![0.0; result.values.len()];
    let pieces = offsets(result, truth, reach);
    for piece in &pieces {
        map[pixel(result, piece.middle)] = piece.shift as f32;
    }
    Fault { value: deviation(&pieces).map(|deviation| deviation.mean), map }
}

fn pixel(image: Grid, at: DVec2) -> usize {
    at.y as usize * image.width + at.x as usize
}

/// Mean 10–90 % width of all edges of an image, pixels: the area between a tenth and nine tenths over the length of
/// the ½-contour. Edges that are sharper than a pixel count a pixel or less. `None` without a contour.
pub fn penumbra_width(image: Grid) -> Option<f64> {
    let length: f64 = contour(image, 0.5).iter().map(|[a, b]| a.distance(*b)).sum();
    let area = between(image).iter().filter(|&&inside| inside).count();
    (length > 0.0).then(|| area as f64 / length)
}

fn between(image: Grid) -> Vec<bool> {
    image.values.iter().map(|value| (0.1..=0.9).contains(value)).collect()
}

fn softness(result: Grid, truth: Grid) -> Fault {
    let (ours, theirs) = (between(result), between(truth));
    let common = both(&ours, &theirs);
    let signed = |i: usize| f32::from(u8::from(ours[i])) - f32::from(u8::from(theirs[i]));
    let map = common.iter().enumerate().map(|(i, &common)| if common { 0.0 } else { signed(i) }).collect();
    let value = penumbra_width(result).zip(penumbra_width(truth)).map(|(ours, theirs)| ours - theirs);
    Fault { value, map }
}

/// The fault in world units, and its mean in texels.
fn detachment(evidence: &Evidence) -> (Fault, Option<f64>) {
    let mut map = vec![0.0; evidence.result.values.len()];
    let (mut gaps, mut texels) = (Vec::new(), Vec::new());
    for contact in evidence.contacts {
        let own = contact_gap(evidence.truth, contact.foot, contact.toward);
        let gap = contact_gap(evidence.result, contact.foot, contact.toward);
        if let Some(own) = own {
            let gap = gap.unwrap_or_else(|| way_out(evidence.result, contact));
            let world = (gap - own).max(0.0) * contact.world_per_pixel;
            gaps.push(world);
            texels.push(world / contact.world_per_texel);
            let direction = contact.toward.normalize_or_zero();
            let mut along = own;
            while along < gap {
                map[pixel(evidence.result, contact.foot + direction * along)] = world as f32;
                along += 0.5;
            }
        }
    }
    let mean = |values: &[f64]| (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64);
    (Fault { value: mean(&gaps), map }, mean(&texels))
}

/// Pixels from a contact to the picture's border along its shadow.
fn way_out(image: Grid, contact: &Contact) -> f64 {
    let (foot, direction) = (contact.foot, contact.toward.normalize_or_zero());
    let inside = |at: DVec2| at.cmpge(DVec2::ZERO).all() && at.x < image.width as f64 && at.y < image.height() as f64;
    let steps = (image.width + image.height()) as u32 * 2;
    (0..=steps)
        .map(|step| f64::from(step) * 0.5)
        .take_while(|&way| inside(foot + direction * way))
        .last()
        .unwrap_or(0.0)
}

/// The contact gap without a picture: the distance in world units from `foot` along `direction` (in its plane, need not be unit) to
/// the first point that is at least half in shadow, sampled every `step` and halved down to a 64th of it.
///
/// Each point is a region of its own, with the footprint of `foot` carried along. 0 when `foot` itself is in shadow;
/// `None` when there is no shadow within `limit`.
pub fn gap_on_surface(
    shadow: &dyn Shadow,
    foot: &SurfacePoint,
    direction: Vec3,
    step: f32,
    limit: f32,
    key: Key,
) -> Option<f32> {
    let direction = direction.try_normalize()?;
    let dark = |distance: f32, region: u32| shadow.fraction(&carried(foot, direction * distance, region), key) >= 0.5;
    let steps = (limit / step).clamp(0.0, 1e7) as u32;
    let first = (0..=steps).find(|&index| dark(index as f32 * step, index))?;
    let (mut low, mut high) = (first.saturating_sub(1) as f32 * step, first as f32 * step);
    for halving in 0..6 {
        let middle = 0.5 * (low + high);
        if dark(middle, steps + 1 + halving) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(if first == 0 { 0.0 } else { high })
}

/// The profile of an edge without a picture: the shadow along a line of a surface, `half_width` world units to either side of `middle` toward
/// `into_shadow` (in the surface's plane, need not be unit), sampled at `points` places evenly, both ends included.
///
/// Distances are world units from `middle`, positive toward `into_shadow`. Each point is a region of its own, with the
/// footprint of `middle` carried along. Empty when there is no direction, or fewer than 2 points. [`Profile::width`]
/// is the penumbra's 10–90 % width in world units.
pub fn profile_on_surface(
    shadow: &dyn Shadow,
    middle: &SurfacePoint,
    into_shadow: Vec3,
    half_width: f32,
    points: u32,
    key: Key,
) -> Profile {
    let Some(direction) = into_shadow.try_normalize().filter(|_| points >= 2) else { return Profile::default() };
    let distance = |index: u32| f64::from(half_width) * (2.0 * f64::from(index) / f64::from(points - 1) - 1.0);
    let places: Vec<SurfacePoint> =
        (0..points).map(|index| carried(middle, direction * distance(index) as f32, index)).collect();
    let mut dark = vec![0.0; places.len()];
    shadow.fractions(&places, key, &mut dark);
    Profile { points: (0..points).zip(dark).map(|(index, dark)| (distance(index), f64::from(dark))).collect() }
}

/// A region moved over its surface, under the name of another.
fn carried(foot: &SurfacePoint, way: Vec3, region: u32) -> SurfacePoint {
    SurfacePoint { position: foot.position + way.as_dvec3(), region: foot.region.wrapping_add(region), ..*foot }
}

/// Linear RGB of a signed error in −1..1 (clamped), for heat maps: result minus truth.
///
/// No error is a mid grey that stands on white and on black paper alike; too dark goes through orange to a light
/// yellow, too light through blue to a light cyan, so that size shows without hue as well. NaN is magenta.
pub fn heat(value: f32) -> Vec3 {
    const NONE: Vec3 = Vec3::new(0.13, 0.13, 0.13);
    const DARK: [Vec3; 2] = [Vec3::new(0.85, 0.16, 0.02), Vec3::new(1.0, 0.82, 0.3)];
    const LIGHT: [Vec3; 2] = [Vec3::new(0.02, 0.2, 0.85), Vec3::new(0.35, 0.9, 1.0)];
    if value.is_nan() {
        return Vec3::new(1.0, 0.0, 1.0);
    }
    let [middle, end] = if value > 0.0 { DARK } else { LIGHT };
    let size = value.abs().min(1.0);
    if size < 0.5 { NONE.lerp(middle, size * 2.0) } else { middle.lerp(end, size * 2.0 - 1.0) }
}
