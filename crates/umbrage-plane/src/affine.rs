use crate::TexelRect;
use glam::{DVec2, IVec2};

/// What the numbers in a map mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Kind {
    /// ζ: distance along the view's axis, in world units. What a view stores unless its range is narrow ([`Kind::of_range`]).
    #[default]
    Axial,
    /// Post-projective depth z_s: 0 at the near plane, 1 at the far plane (Williams 1978, Wang & Molnar 1994).
    Screen,
    /// Euclidean distance from the light, in world units (cube and latitude-longitude maps).
    Radial,
}

impl Kind {
    /// What a view stores whose caller has not chosen: [`Kind::Axial`], unless the range is so narrow and so far away that a float of
    /// axial distance has lost more than four of its 24 bits to the distance, which is where the range is less than a sixteenth of the
    /// larger distance. Then it is [`Kind::Screen`], whose numbers begin at the near plane.
    ///
    /// Distance from the near plane in world units would be no better: from near n to far f, floats of axial distance have steps
    /// of f·2⁻²⁴ at the far plane, of screen depth (f − n)·f/n·2⁻²⁴, of distance from the near plane (f − n)·2⁻²⁴. The best of
    /// the first two is never more than twice the last.
    #[must_use]
    pub fn of_range(near: f64, far: f64) -> Self {
        if near.abs().max(far.abs()) > 16.0 * (far - near) { Self::Screen } else { Self::Axial }
    }
}

/// A plane's key as an affine function of texel coordinates: `key(x, y) = c + dx·x + dy·y`.
///
/// Keys are −1/ζ (perspective) or ζ (orthographic), and z_s in views of [`Kind::Screen`], so they grow away from the light. Kept in
/// f64 and rounded once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// Key at texel position (0, 0), the map's upper left corner.
    pub c: f64,
    /// Change of key per texel to the right.
    pub dx: f64,
    /// Change of key per texel downward.
    pub dy: f64,
}

impl Affine {
    /// The same key everywhere.
    pub const fn constant(key: f64) -> Self {
        Self { c: key, dx: 0.0, dy: 0.0 }
    }

    /// The key at a texel position, unrounded. The one formula by which every key in Umbrage is made; `dx` and `dy` are the forward
    /// differences of the papers, which are not accumulated here, so that no place depends on the way to it.
    #[inline(always)]
    pub fn at(&self, texel: DVec2) -> f64 {
        (self.c + self.dy * texel.y) + self.dx * texel.x
    }
}

/// Turns keys into the depths that a map stores.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decode {
    pub(crate) kind: Kind,
    pub(crate) perspective: bool,
    pub(crate) near: f64,
    pub(crate) far: f64,
    /// Ray tangents at texel (0, 0) and their change per texel, for radial depth. Orthographic views: unused.
    pub(crate) tangent0: DVec2,
    pub(crate) tangent_step: DVec2,
}

impl Decode {
    /// Calls `work` with the same. It is compiled apart for each of the two kinds of axial depth: loops over texels in it do not branch on
    /// the kind there, and become vector instructions.
    #[inline(always)]
    pub fn in_loops<T>(&self, work: impl FnOnce(&Self) -> T) -> T {
        match (self.kind, self.perspective) {
            (Kind::Axial, true) => work(&Self { kind: Kind::Axial, perspective: true, ..*self }),
            (Kind::Axial, false) => work(&Self { kind: Kind::Axial, perspective: false, ..*self }),
            _ => work(self),
        }
    }

    /// The stored depth of a key at a texel position. A perspective plane behind its own horizon is at +∞.
    ///
    /// `+∞` keys (nothing there) stay `+∞`.
    #[inline(always)]
    pub fn depth(&self, key: f32, texel: DVec2) -> f32 {
        match self.kind {
            // The key is the depth. Zero has one sign, so that the order in which equal keys arrive cannot be seen in a map's bits.
            Kind::Screen if self.beyond_horizon(key) => f32::INFINITY,
            Kind::Screen => key + 0.0,
            Kind::Axial | Kind::Radial => self.depth_of_zeta(self.zeta(key), texel),
        }
    }

    /// The axial distance of a key, in world units; +∞ for keys of +∞ and behind a perspective plane's horizon.
    #[inline(always)]
    pub fn zeta(&self, key: f32) -> f64 {
        if self.beyond_horizon(key) { f64::INFINITY } else { self.zeta_of(f64::from(key)) }
    }

    /// Whether a key belongs to nothing in front of the light: +∞, or −1/ζ ≥ 0 (z_s ≥ f/(f − n)) in perspective.
    #[inline(always)]
    fn beyond_horizon(&self, key: f32) -> bool {
        let horizon = if self.kind == Kind::Screen { self.far / (self.far - self.near) } else { 0.0 };
        key == f32::INFINITY || (self.perspective && f64::from(key) >= horizon)
    }

    /// The axial distance of a key before any horizon.
    #[inline(always)]
    pub(crate) fn zeta_of(&self, key: f64) -> f64 {
        let (n, f) = (self.near, self.far);
        match (self.kind, self.perspective) {
            (Kind::Screen, true) => f * n / (f - key * (f - n)),
            (Kind::Screen, false) => n + key * (f - n),
            (_, true) => -1.0 / key,
            // Zero has one sign here too.
            (_, false) => key + 0.0,
        }
    }

    /// The stored depth of an axial distance at a texel position, rounded once; +∞ stays +∞.
    #[inline(always)]
    pub fn depth_of_zeta(&self, zeta: f64, texel: DVec2) -> f32 {
        if zeta == f64::INFINITY {
            return f32::INFINITY;
        }
        match self.kind {
            Kind::Axial => zeta as f32,
            Kind::Screen => self.screen(zeta) as f32,
            Kind::Radial => (zeta * self.slant(texel)) as f32,
        }
    }

    /// The axial distance of a stored depth at a texel position, in world units; +∞ stays +∞.
    #[inline(always)]
    pub fn zeta_of_depth(&self, depth: f32, texel: DVec2) -> f64 {
        match self.kind {
            Kind::Axial => f64::from(depth),
            Kind::Screen => self.zeta(depth),
            Kind::Radial => f64::from(depth) / self.slant(texel),
        }
    }

    /// z_s of an axial distance.
    #[inline(always)]
    pub(crate) fn screen(&self, zeta: f64) -> f64 {
        if self.perspective {
            self.far * (zeta - self.near) / (zeta * (self.far - self.near))
        } else {
            (zeta - self.near) / (self.far - self.near)
        }
    }

    /// Euclidean over axial distance at a texel position; 1 in an orthographic view.
    #[inline(always)]
    pub(crate) fn slant(&self, texel: DVec2) -> f64 {
        if self.perspective { (1.0 + (self.tangent0 + self.tangent_step * texel).length_squared()).sqrt() } else { 1.0 }
    }
}

/// The smallest and largest depth that something may have; `min > max` never occurs, NaN neither.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthRange {
    /// No depth is smaller.
    pub min: f32,
    /// No depth is larger; +∞ when a texel without a surface is among them.
    pub max: f32,
}

impl DepthRange {
    /// Says nothing: −∞ to +∞.
    pub const UNKNOWN: Self = Self { min: f32::NEG_INFINITY, max: f32::INFINITY };
    /// No surface anywhere: +∞ to +∞.
    pub const NOTHING: Self = Self { min: f32::INFINITY, max: f32::INFINITY };

    /// The range around both.
    #[inline(always)]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }
}

/// A plane as a depth over texels: what a receiver's tangent plane is, and what a rasterised triangle is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthPlane {
    /// The plane's key.
    pub key: Affine,
    /// How the key becomes a depth.
    pub decode: Decode,
}

impl DepthPlane {
    /// The plane's depth at a texel position: the bits that rasterising the same plane stores there.
    #[inline(always)]
    pub fn at(&self, texel: DVec2) -> f32 {
        self.decode.depth(self.key.at(texel) as f32, texel)
    }

    /// [`DepthPlane::at`] of sixteen positions, given as all x and all y.
    #[inline(always)]
    pub fn at_all(&self, [x, y]: &[[f64; 16]; 2]) -> [f32; 16] {
        let mut depths = [0.0; 16];
        self.decode.in_loops(
            #[inline(always)]
            |decode| {
                for i in 0..16 {
                    let at = DVec2::new(x[i], y[i]);
                    depths[i] = decode.depth(self.key.at(at) as f32, at);
                }
            },
        );
        depths
    }

    /// Depths along a row, a texel apart from `from` on, by forward differences: one evaluation, then an addition each (Wang & Molnar
    /// 1994). Within the rounding of so many additions of [`DepthPlane::at`], which everything in Umbrage uses, because sums depend on
    /// where they began. Endless.
    pub fn row(&self, from: DVec2) -> impl Iterator<Item = f32> + '_ {
        let start = self.key.at(from);
        let keys = std::iter::successors(Some(start), |key| Some(key + self.key.dx));
        keys.zip(0u32..).map(move |(key, step)| {
            let place = DVec2::new(from.x + f64::from(step), from.y);
            self.decode.depth(key as f32, place)
        })
    }

    /// Encloses the plane's depth over all positions inside the texels of `rect`. [`DepthRange::UNKNOWN`] for radial depth.
    pub fn bounds(&self, rect: TexelRect) -> DepthRange {
        if self.decode.kind == Kind::Radial || rect.is_empty() {
            return DepthRange::UNKNOWN;
        }
        let (low, high) = (rect.min.as_dvec2(), rect.max.as_dvec2());
        let corners = [low, DVec2::new(high.x, low.y), DVec2::new(low.x, high.y), high].map(|corner| self.at(corner));
        // A corner's depth may be one rounding below its neighbourhood's: step outward so that the range encloses.
        let (mut min, mut max) = (corners[0], corners[0]);
        for depth in corners {
            min = min.min(depth);
            max = max.max(depth);
        }
        DepthRange { min: min.next_down().next_down(), max: max.next_up().next_up() }
    }
}

/// Which side of a surface a view sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// The outside: counter-clockwise as seen from the view.
    Front,
    /// The inside.
    Back,
}

/// One flat piece of surface as a view's texels see it: what the rasteriser hands to a depth rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet {
    /// Key of the piece's plane.
    pub plane: Affine,
    /// Which side is seen.
    pub facing: Facing,
    /// Index of the triangle in the order it was given, 0-based.
    pub triangle: u32,
    /// Id of the object it belongs to.
    pub object: u32,
    /// True for open, two-sided surfaces; false for the boundary of a solid.
    pub sheet: bool,
}

impl Facet {
    /// The rounded key at the sample position of `texel`.
    #[inline(always)]
    pub fn key(&self, sampling: crate::Sampling, texel: IVec2) -> f32 {
        self.plane.at(sampling.position(texel)) as f32
    }
}
