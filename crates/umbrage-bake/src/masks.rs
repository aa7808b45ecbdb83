//! The masks and films of a bake, and the places at which they are evaluated.

use crate::caster::within;
use crate::mask::mix;
use crate::rays::{places, ray};
use crate::{Caster, Casting, Film, Mask, MaskPlace};
use glam::{DVec2, DVec3, IVec2, UVec2, Vec2, Vec3};
use std::fmt;
use umbrage_plane::{Facet, View};
use umbrage_raster::{BIN, Bins, Coverage, Geometry};

/// The masks of casters that are drawn: what a bake evaluates, and whoever draws with [`Bins`] directly.
///
/// ```
/// use glam::{DVec3, UVec2, Vec3};
/// use umbrage_bake::{Caster, MaskPlace, Masks};
/// use umbrage_plane::{TexelRect, View};
/// use umbrage_raster::{Bins, Cull, Triangle};
///
/// // Half of a triangle is not there.
/// let view = View::orthographic(DVec3::Z * 9.0, DVec3::ZERO, DVec3::Y, 16.0, 1.0, 20.0, UVec2::splat(32))?;
/// let half = |at: &MaskPlace| at.weights.x < 0.5;
/// let corners = [(-16.0, 0.0), (16.0, -16.0), (16.0, 16.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
/// let caster = Caster::from(Triangle::new(corners, 0, true)).with_mask(&half);
///
/// let mut masks = Masks::new(&view);
/// let triangles = [caster].map(|caster| masks.note(caster));
/// let bins = Bins::new(&view, TexelRect::of_size(view.size()), Cull::None, triangles);
/// let mut seen = [0; 32];
/// masks.tile(&bins, UVec2::ZERO, |_, coverage| seen = coverage.rows);
/// assert_eq!(seen[16], 0xffff_0000);
/// # Ok::<(), umbrage_plane::ViewError>(())
/// ```
pub struct Masks<'a> {
    /// Its texel positions are where masks are evaluated.
    view: View,
    masked: Vec<Masked<'a>>,
    /// From triangles to `masked`, as far as the last that has a mask or a film; [`UNMASKED`] for those that have neither.
    index: Vec<u32>,
    given: usize,
    /// How many casters were given and forgotten before the first of these.
    first: usize,
}

const UNMASKED: u32 = u32::MAX;

impl<'a> Masks<'a> {
    /// None yet; they will be evaluated at places of a view's map.
    pub fn new(view: &View) -> Self {
        Self { view: *view, masked: Vec::new(), index: Vec::new(), given: 0, first: 0 }
    }

    /// Forgets the casters that it was given, for bins that are [refilled](Bins::refill): the next caster's facet is the first of the bins again. Masks
    /// go on being called with [indices](MaskPlace::triangle) among all casters that were ever given.
    pub fn advance(&mut self) {
        self.first += self.given;
        self.masked.clear();
        self.index.clear();
        self.given = 0;
    }

    /// Takes a caster or a mesh of casters, in the order of the bins, and gives what the bins take.
    #[inline(always)]
    pub fn note(&mut self, casters: impl Into<Casting<'a>>) -> Geometry<'a> {
        match casters.into() {
            Casting::One(caster) => {
                if caster.is_masked() {
                    self.add(self.given, &caster);
                }
                self.given += 1;
                caster.triangle.into()
            }
            Casting::Mesh(mesh) => {
                if mesh.is_masked() {
                    (0..mesh.len()).for_each(|index| self.add(self.given + index, &mesh.caster(index)));
                }
                self.given += mesh.len();
                mesh.into_mesh().into()
            }
        }
    }

    /// Keeps a caster that has a mask or a film; `index` is the number of casters before it.
    #[cold]
    fn add(&mut self, index: usize, caster: &Caster<'a>) {
        self.index.resize(index, UNMASKED);
        self.index.push(self.masked.len() as u32);
        self.masked.push(Masked::new(&self.view, caster));
    }

    /// The mask of a facet that has one.
    #[inline(always)]
    pub(crate) fn of(&self, facet: &Facet) -> Option<&Masked<'a>> {
        self.known(facet).filter(|known| known.mask.is_some())
    }

    /// What is known of a facet with a mask or a film.
    #[inline(always)]
    fn known(&self, facet: &Facet) -> Option<&Masked<'a>> {
        self.masked.get(*self.index.get(facet.triangle as usize)? as usize)
    }

    /// What the film of a facet lets pass, as a function of the place of the map, in texels; `None` for a facet without a film.
    pub(crate) fn film(&self, facet: &Facet) -> Option<impl Fn(DVec2) -> Vec3 + use<'_, 'a>> {
        let known = self.known(facet)?;
        let (film, facet) = (known.film?, *facet);
        Some(move |at| within(film(&self.place(known, &facet, at))))
    }

    /// [`Bins::tile`] of bins of the same view, without the samples where masks say that nothing is there.
    #[inline(always)]
    pub fn tile(&self, bins: &Bins, tile: UVec2, mut sink: impl FnMut(&Facet, &Coverage)) {
        bins.tile(
            tile,
            #[inline(always)]
            |facet, coverage| {
                let cut;
                let coverage = match self.of(facet) {
                    None => coverage,
                    Some(masked) => {
                        cut = self.cut(masked, facet, (tile * BIN).as_ivec2(), coverage);
                        // Who has no sample touches no tile.
                        if cut.rows == [0; 32] {
                            return;
                        }
                        &cut
                    }
                };
                sink(facet, coverage);
            },
        );
    }

    /// A coverage, as far as a mask leaves it.
    #[cold]
    fn cut(&self, masked: &Masked<'_>, facet: &Facet, origin: IVec2, coverage: &Coverage) -> Coverage {
        let mut cut = *coverage;
        for (y, row) in (0..).zip(&mut cut.rows) {
            let mut bits = *row;
            while bits != 0 {
                let x = bits.trailing_zeros();
                bits &= bits - 1;
                let at = self.view.sampling().position(origin + IVec2::new(x as i32, y));
                *row &= !(u32::from(!self.is_there(masked, facet, at)) << x);
            }
        }
        cut
    }

    /// Whether anything of a facet is at a place of the map, in texels.
    pub(crate) fn is_there(&self, masked: &Masked<'_>, facet: &Facet, at: DVec2) -> bool {
        masked.mask.is_none_or(|mask| mask(&self.place(masked, facet, at)))
    }

    /// The place of a facet that is seen at a place of the map, in texels.
    fn place(&self, masked: &Masked<'_>, facet: &Facet, at: DVec2) -> MaskPlace {
        let weights = masked.weights(ray(&self.view, at));
        let triangle = (self.first as u32).wrapping_add(facet.triangle);
        MaskPlace { triangle, object: facet.object, weights, uv: mix(masked.uvs, weights) }
    }
}

impl fmt::Debug for Masks<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Masks").field("given", &self.given).field("masked", &self.masked.len()).finish_non_exhaustive()
    }
}

/// A mask or a film or both, and what gives the weights of their triangle's corners.
pub(crate) struct Masked<'a> {
    mask: Option<Mask<'a>>,
    film: Option<Film<'a>>,
    uvs: [Vec2; 3],
    /// The weights of the second and the third corner at a ray are its products with these, over its product with `whole`.
    second: DVec3,
    third: DVec3,
    whole: DVec3,
}

impl<'a> Masked<'a> {
    fn new(view: &View, &Caster { triangle, uvs, mask, film, .. }: &Caster<'a>) -> Self {
        let eye = triangle.corners.map(|corner| view.world_to_eye().transform_point3(corner));
        // Differences are taken before the turn: those of a scene far from the origin lose nothing in it.
        let edge = |corner: usize| {
            let edge = view.world_to_eye().transform_vector3(triangle.corners[corner] - triangle.corners[0]);
            if view.is_perspective() { edge } else { DVec3::new(edge.x, edge.y, 0.0) }
        };
        let (first, b, c) = (places(view, eye)[0], edge(1), edge(2));
        // Cramer's rule: the ray r meets first + s·b + t·c where s = r·(first × c) / r·(c × b) and t = r·(b × first) / r·(c × b).
        Self { mask, film, uvs, second: first.cross(c), third: b.cross(first), whole: c.cross(b) }
    }

    fn weights(&self, ray: DVec3) -> DVec3 {
        let whole = self.whole.dot(ray);
        let (second, third) = (self.second.dot(ray) / whole, self.third.dot(ray) / whole);
        // `max` first: it turns NaN into 0.
        let inside = DVec3::new(1.0 - second - third, second, third).max(DVec3::ZERO).min(DVec3::ONE);
        let sum = inside.element_sum();
        if sum > 0.0 { inside / sum } else { DVec3::splat(1.0 / 3.0) }
    }
}
