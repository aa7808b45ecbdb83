use crate::Casting;
use crate::masks::Masks;
use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use rayon::prelude::*;
use std::cmp::Ordering;
use umbrage_depth::{DeepMap, MapError, Step, compress_steps};
use umbrage_plane::{Facet, TexelRect, View};
use umbrage_raster::{BIN, Bins, Cull, Stats, each_fragment};

/// How a deep map is made (Burley 2006).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deep {
    epsilon: f32,
    axis: u32,
}

impl Deep {
    /// The stored transmittance stands nowhere farther than `epsilon` from the gathered one; 0 keeps all. `axis` × `axis` samples per texel are
    /// averaged: 1, 2, 4 or 8 along each side, others count as the next lower of these.
    ///
    /// # Errors
    /// For an `epsilon` outside 0..1.
    pub fn new(epsilon: f32, axis: u32) -> Result<Self, MapError> {
        let valid = (0.0..1.0).contains(&epsilon);
        if valid { Ok(Self { epsilon, axis: 1 << axis.clamp(1, 8).ilog2() }) } else { Err(MapError::Epsilon(epsilon)) }
    }

    /// How far a stored transmittance may stand from the gathered one.
    #[must_use]
    pub fn epsilon(&self) -> f32 {
        self.epsilon
    }

    /// Samples along each side of a texel.
    #[must_use]
    pub fn axis(&self) -> u32 {
        self.axis
    }

    /// The same with another bound on the error of the stored transmittance.
    ///
    /// # Errors
    /// For an `epsilon` outside 0..1.
    pub fn with_epsilon(self, epsilon: f32) -> Result<Self, MapError> {
        Self::new(epsilon, self.axis)
    }

    /// The same with `axis` × `axis` samples per texel, as in [`Deep::new`].
    #[must_use]
    pub fn with_axis(self, axis: u32) -> Self {
        Self { axis: 1 << axis.clamp(1, 8).ilog2(), ..self }
    }
}

impl Default for Deep {
    /// 4 × 4 samples, to 1 %.
    fn default() -> Self {
        Self { epsilon: 0.01, axis: 4 }
    }
}

/// Samples of a tile.
const CELLS: usize = (BIN * BIN) as usize;

/// A surface that a sample meets.
#[derive(Clone, Copy)]
struct Fragment {
    /// Index of the sample in its tile.
    cell: u16,
    key: f32,
    object: u32,
    /// What passes it: the index of its triangle, or beyond all of them that of what a film lets pass here.
    light: u32,
}

/// The triangles of one moment, and what passes each of them.
struct Moment<'a> {
    bins: Bins,
    passes: Vec<Vec3>,
    masks: Masks<'a>,
}

/// A deep map, and what became of the triangles of all moments.
#[derive(Clone, Debug)]
pub struct BakedDeep {
    /// The map.
    pub map: DeepMap,
    /// What the rasteriser did with the triangles, summed over the moments.
    pub stats: Stats,
}

/// Pass 1 of deep maps: a texel's transmittance is the mean over its samples and over the moments of an exposure of what all surfaces
/// before a depth let through together ([`Caster::passes`](crate::Caster::passes), [`Caster::film`](crate::Caster::film)).
///
/// `moments` are the triangles at evenly spread times, one of them for what is at rest; none gives an empty map. What is nearer than the near plane stands at it. The result
/// does not depend on the number of threads. Maps too large for the samples, which are one grid of at most 32,768 per side, get as many as fit.
#[expect(clippy::missing_panics_doc, reason = "a view has at most 32,768 texels per side, and as many samples as fit")]
pub fn bake_deep<'a, M>(view: &View, moments: impl IntoIterator<Item = M>, deep: &Deep) -> BakedDeep
where
    M: IntoIterator<Item: Into<Casting<'a>>>,
{
    let fitting = 32_768 / view.size().max_element();
    let axis = deep.axis.min(1 << fitting.max(1).ilog2());
    let fine = view.with_size(view.size() * axis).expect("as many samples as fit");
    let moments: Vec<Moment<'a>> = moments.into_iter().map(|casters| Moment::new(&fine, casters)).collect();
    let size = fine.size();
    let grid = size.map(|side| side.div_ceil(BIN));
    let side = BIN / axis;
    let slot = |cell: u32| {
        let (texel, within) = (UVec2::new(cell % BIN, cell / BIN) / axis, UVec2::new(cell % BIN, cell / BIN) % axis);
        ((texel.y * side + texel.x) * axis * axis + within.y * axis + within.x) as u16
    };
    let slots = (0..CELLS as u32).map(slot).collect();
    let gather = Gather { fine: &fine, moments: &moments, axis, epsilon: deep.epsilon, slots };
    let tiles: Vec<Vec<Vec<Step>>> = (0..grid.x * grid.y)
        .into_par_iter()
        .map(|index| gather.tile(UVec2::new(index % grid.x, index / grid.x)))
        .collect();
    let steps = TexelRect::of_size(view.size()).texels().map(|texel| {
        let (tile, at) = (texel.as_uvec2() / side, texel.as_uvec2() % side);
        let tile = &tiles[(tile.y * grid.x + tile.x) as usize];
        tile.get((at.y * side + at.x) as usize).cloned().unwrap_or_default()
    });
    let map = DeepMap::new(*view, deep.epsilon, steps).expect("steps were made in order");
    let mut stats = Stats::default();
    for moment in &moments {
        stats += moment.bins.stats();
    }
    BakedDeep { map, stats }
}

impl<'a> Moment<'a> {
    fn new(fine: &View, casters: impl IntoIterator<Item: Into<Casting<'a>>>) -> Self {
        let (mut passes, mut masks) = (Vec::new(), Masks::new(fine));
        let geometry = casters.into_iter().map(|casting| {
            let casting: Casting<'a> = casting.into();
            match &casting {
                Casting::One(caster) => passes.push(caster.passing()),
                Casting::Mesh(mesh) => passes.extend(std::iter::repeat_n(mesh.passing(), mesh.len())),
            }
            masks.note(casting)
        });
        let bins = Bins::new(fine, TexelRect::of_size(fine.size()), Cull::None, geometry);
        Self { bins, passes, masks }
    }
}

/// What the samples of a tile meet at one moment.
struct Met<'a> {
    moment: &'a Moment<'a>,
    /// Sample by sample in the order of [`Gather::slots`], and from the light outward.
    fragments: Vec<Fragment>,
    /// For each sample, the number of fragments of it and of those before it.
    ends: Vec<u32>,
    /// What films let pass, where fragments meet them.
    filmed: Vec<Vec3>,
}

impl Met<'_> {
    /// What passes a fragment.
    fn passes(&self, fragment: &Fragment) -> DVec3 {
        passing(self.moment, &self.filmed, fragment)
    }
}

/// What passes a fragment, where films of the tile let `filmed` pass.
fn passing(moment: &Moment<'_>, filmed: &[Vec3], fragment: &Fragment) -> DVec3 {
    let light = fragment.light as usize;
    moment.passes.get(light).unwrap_or_else(|| &filmed[light - moment.passes.len()]).as_dvec3()
}

struct Gather<'a> {
    fine: &'a View,
    moments: &'a [Moment<'a>],
    axis: u32,
    epsilon: f32,
    /// The place of each sample of a tile, given row by row, among all of them texel by texel.
    slots: Vec<u16>,
}

impl Gather<'_> {
    /// The compressed steps of the texels of one tile of samples, row by row; none at all where nothing is seen.
    fn tile(&self, tile: UVec2) -> Vec<Vec<Step>> {
        let origin = (tile * BIN).as_ivec2();
        let met: Vec<Met<'_>> = self.moments.iter().filter_map(|moment| self.met(moment, tile)).collect();
        if met.is_empty() {
            return Vec::new();
        }
        let of_texel = (self.axis * self.axis) as usize;
        let samples = of_texel as f64 * self.moments.len() as f64;
        let mut falls = Vec::new();
        let texel = |texel: usize| {
            falls.clear();
            for met in &met {
                for sample in texel * of_texel..(texel + 1) * of_texel {
                    let first = if sample == 0 { 0 } else { met.ends[sample - 1] };
                    let fragments = &met.fragments[first as usize..met.ends[sample] as usize];
                    if let Some(Fragment { cell, .. }) = fragments.first() {
                        let surfaces = fragments.iter().map(|fragment| (fragment.key, met.passes(fragment)));
                        self.add(surfaces, self.at(origin, (*cell).into()), &mut falls);
                    }
                }
            }
            compress_steps(&steps(&mut falls, samples), self.epsilon)
        };
        (0..CELLS / of_texel).map(texel).collect()
    }

    /// What the samples of a tile meet at a moment; `None` where that is nothing.
    fn met<'m>(&self, moment: &'m Moment<'m>, tile: UVec2) -> Option<Met<'m>> {
        let origin = (tile * BIN).as_ivec2();
        let (mut found, mut filmed) = (Vec::new(), Vec::new());
        let mut ends = vec![0; CELLS];
        moment.masks.tile(&moment.bins, tile, |facet, coverage| {
            let film = moment.masks.film(facet);
            each_fragment(self.fine, origin, facet, coverage, |cell, _, key| {
                if !key.is_nan() {
                    let Facet { object, triangle: mut light, .. } = *facet;
                    if let Some(film) = &film {
                        light = (moment.passes.len() + filmed.len()) as u32;
                        filmed.push(film(self.at(origin, cell as u32)));
                    }
                    ends[usize::from(self.slots[cell])] += 1;
                    found.push(Fragment { cell: cell as u16, key, object, light });
                }
            });
        });
        let nothing = *found.first()?;
        // Each fragment is put where its sample's begin, which moves that place to where they end.
        let mut first = 0;
        for end in &mut ends {
            first += std::mem::replace(end, first);
        }
        let mut fragments = vec![nothing; found.len()];
        for fragment in found {
            let place = &mut ends[usize::from(self.slots[usize::from(fragment.cell)])];
            fragments[*place as usize] = fragment;
            *place += 1;
        }
        // Ids, then what passes, make one order of equal keys.
        for sample in fragments.chunk_by_mut(|a, b| a.cell == b.cell) {
            sample.sort_unstable_by(|a, b| {
                let by_light = || compare(passing(moment, &filmed, a), passing(moment, &filmed, b));
                a.key.total_cmp(&b.key).then(a.object.cmp(&b.object)).then_with(by_light)
            });
        }
        Some(Met { moment, fragments, ends, filmed })
    }

    /// Where a sample of the tile at `origin` is, in samples.
    fn at(&self, origin: IVec2, cell: u32) -> DVec2 {
        self.fine.sampling().position(origin + UVec2::new(cell % BIN, cell / BIN).as_ivec2())
    }

    /// What the light loses at each surface of one sample, of which the keys are known and what passes them.
    fn add(&self, surfaces: impl Iterator<Item = (f32, DVec3)>, at: DVec2, falls: &mut Vec<(f32, DVec3)>) {
        let decode = self.fine.decode();
        let nearest = decode.depth(self.fine.key(self.fine.near()) as f32, at);
        let mut light = DVec3::ONE;
        for (key, passes) in surfaces {
            let depth = decode.depth(key, at).max(nearest);
            // Depths from 1e30 on are none (C-5).
            if light == DVec3::ZERO || depth >= 1e30 {
                break;
            }
            falls.push((depth, light - light * passes));
            light *= passes;
        }
    }
}

/// The steps of a texel from what each of its samples loses at which depth.
fn steps(falls: &mut [(f32, DVec3)], samples: f64) -> Vec<Step> {
    // One order whatever the samples came in, so that sums round alike.
    falls.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then_with(|| compare(a.1, b.1)));
    let (mut lost, mut before) = (DVec3::ZERO, Vec3::ONE);
    let mut steps = Vec::new();
    for level in falls.chunk_by(|a, b| a.0 == b.0) {
        lost += level.iter().map(|fall| fall.1).sum::<DVec3>();
        let left = DVec3::ONE - lost / samples;
        // What is left of rounding is not light.
        let passes = left.map(|light| if light < 1e-9 { 0.0 } else { light }).as_vec3().min(before);
        steps.push(Step { depth: level[0].0, passes });
        before = passes;
    }
    steps
}

/// One order of light, channel by channel.
fn compare(a: DVec3, b: DVec3) -> Ordering {
    let channel = |i: usize| a[i].total_cmp(&b[i]);
    channel(0).then(channel(1)).then(channel(2))
}
