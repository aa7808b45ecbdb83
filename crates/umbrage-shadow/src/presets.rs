//! Each paper as one short choice of parts, with the surface that its map must store.
//!
//! ```
//! use glam::{DVec3, UVec2};
//! use umbrage_depth::{Raw, Stored};
//! use umbrage_plane::View;
//! use umbrage_shadow::presets;
//!
//! let lamp = View::perspective(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, 1.0, 1.0, 100.0, UVec2::splat(4))?;
//! let nearest = Raw::new(lamp, vec![5.0; 16])?;
//! // Without a bias, half of every lit surface would lie in its own shadow.
//! let refused = presets::woo92().over(nearest.clone()).unwrap_err();
//! assert_eq!(refused.to_string(), "woo92 expects a map of midpoints, but this one stores nearest surfaces");
//! // A map of midpoints is accepted, and so is any map where the mixture is wanted explicitly.
//! assert!(presets::woo92().over(nearest.clone().with_stored(Stored::Midpoint)).is_ok());
//! let mixture = presets::woo92().over_any(nearest);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::williams::Williams;
use crate::{Biased, Conditional, DualPlane, Filter, FromMoments, OccluderFalloff, Pcf, ShadowMap, Soft};
use umbrage_depth::{DepthMap, Stored};
use umbrage_plane::Bias;
use umbrage_sample::{Centre, Density, Disc, Jittered};

/// A paper's filter, and the surface that its map must store for its comparison to be right.
///
/// The filter alone, `filter`, accepts any map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset<F> {
    /// The paper, as recipes name it.
    pub name: &'static str,
    /// The filter over the map.
    pub filter: F,
    /// The surfaces of which the map must store one. Never empty.
    pub expects: &'static [Stored],
}

/// A preset was given a map that stores a different surface from its paper's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{preset} expects a map of {expected}, but this one stores {found}")]
pub struct StoredError {
    /// The preset.
    pub preset: &'static str,
    /// What the paper stores.
    pub expected: Stored,
    /// What the map stores.
    pub found: Stored,
}

impl<F: Filter> Preset<F> {
    /// The paper's shadows from a map.
    ///
    /// # Errors
    /// [`StoredError`], when the map stores a surface that the paper's comparison is not made for.
    pub fn over<M: DepthMap>(self, map: M) -> Result<ShadowMap<F, M>, StoredError> {
        self.check(map.stored())?;
        Ok(self.over_any(map))
    }

    /// The filter over a map, whatever surface the map stores.
    pub fn over_any<M: DepthMap>(self, map: M) -> ShadowMap<F, M> {
        ShadowMap { filter: self.filter, map }
    }

    /// Checks that a map which stores this surface is one that the paper's comparison is made for.
    ///
    /// # Errors
    /// [`StoredError`], when it is not.
    pub fn check(&self, found: Stored) -> Result<(), StoredError> {
        if self.expects.contains(&found) {
            return Ok(());
        }
        Err(StoredError { preset: self.name, expected: self.expects[0], found })
    }
}

/// Umbrage's own and the default: two planes instead of a bias, over a map of facets.
///
/// Nothing needs to be set for a scene. The map must hold facets ([`FacetMap`](umbrage_depth::FacetMap)); over other maps only the receiver's plane is
/// compared.
pub fn auto() -> Preset<DualPlane> {
    Preset { name: "auto", filter: DualPlane::default(), expects: &[Stored::First] }
}

/// Williams 1978: nearest texel, no dither, two quanta of 16-bit depth.
///
/// The bias is a fraction of the range from near to far plane in screen depth, two steps of 16 bits, whatever kind of depth the map
/// stores: it grows with the square of the distance, and suits a range that closely encloses the scene. The historical size is 512² in both
/// views. Edges are as coarse as the map's texels.
pub fn williams78() -> Preset<Williams> {
    Preset { name: "williams78", filter: Williams::default(), expects: &[Stored::First] }
}

/// Reeves, Salesin & Cook 1987 as their listing sets the parameters (Fig. 4).
///
/// The bias, drawn from .3 to .4, is in world units, for scenes of about 100 units: multiply it by the size of yours. It is larger
/// than some gaps at contacts, where light leaks, and too small for the steep texels of a low light.
pub fn reeves87() -> Preset<Pcf> {
    Preset { name: "reeves87", filter: Pcf::default(), expects: &[Stored::First] }
}

/// Reeves' advice in the text: at least two samples on each axis, from at least four texels. The bias is that of [`reeves87`].
pub fn reeves87_recommended() -> Preset<Pcf> {
    let filter = Pcf::default().with_pattern(Jittered::default().with_min_samples(2)).with_min_size(1.0);
    Preset { name: "reeves87-recommended", filter, expects: &[Stored::First] }
}

/// The ordinary depth buffer of Reeves' Figure 6a: one sample at the centre, no jitter, nearest texel.
pub fn ordinary(bias: Bias) -> Preset<Pcf<Centre>> {
    let one = Pcf::default().with_pattern(Centre).with_depth(Biased::constant(bias));
    Preset { name: "ordinary", filter: one.with_res_factor(0.0).with_min_size(0.0), expects: &[Stored::First] }
}

/// Woo 1992: the listing of 1987 without any bias, over a map of midpoints.
///
/// It is meant for a spot light with [`Rules::SPOT`](umbrage_plane::Rules::SPOT), which are Woo's rule of the cone; the paper's map is 256²
/// under 75°. Solids thinner than a texel's own step of depth shadow themselves, and so does anything with another surface close
/// behind it: a rug on a floor, a floor that is drawn twice, boxes that touch along a seam.
pub fn woo92() -> Preset<Pcf> {
    let filter = Pcf::default().with_depth(Biased::constant(Bias::ZERO));
    Preset { name: "woo92", filter, expects: &[Stored::Midpoint] }
}

/// Wang & Molnar 1994: the nearest four texels of a map of second surfaces, the tangent plane where they disagree, no bias.
///
/// It needs closed solids, or sheets that are flagged as such. Back faces are second surfaces where solids do not overlap.
pub fn wang_molnar94() -> Preset<Conditional> {
    Preset { name: "wang-molnar94", filter: Conditional::default(), expects: &[Stored::BackFace, Stored::Second] }
}

/// Burley 2006: soft shadows from one map with the bias cone.
///
/// The cone's slope of 2 is free of false shadow up to a tilt of 63.4° between surface and light; steeper surfaces shadow themselves. Its
/// bias grows with the distance of a tap, so that wide filters lose low occluders.
pub fn burley() -> Preset<Soft> {
    Preset { name: "burley", filter: Soft::default(), expects: &[Stored::First] }
}

/// Fernando 2005, as Burley describes it: search taps spread evenly, their plain mean, a constant bias.
pub fn fernando(bias: Bias) -> Preset<Soft<Biased>> {
    let search = Disc::default().with_density(Density::Uniform);
    let soft = Soft::default().with_search(search).with_falloff(OccluderFalloff::Flat);
    Preset { name: "fernando", filter: soft.with_depth(Biased::constant(bias)), expects: &[Stored::First] }
}

/// Donnelly & Lauritzen 2006: variance shadow maps, with a fifth of the visibility cut off against light bleeding (Lauritzen 2007, GPU Gems 3, ch. 8).
///
/// The map is a [`MomentMap`](umbrage_depth::MomentMap) of [`Moments::Variance`](umbrage_depth::Moments::Variance), as the following presets' maps are of
/// the moments that they name; over a map without moments the four nearest texels are compared. Where a surface lies behind two others at different depths,
/// light
/// bleeds through in proportion to how much the nearer ones vary.
///
/// ```
/// use glam::{DVec3, UVec2, Vec3};
/// use umbrage_depth::{MomentMap, Moments, Raw};
/// use umbrage_plane::{SurfacePoint, View};
/// use umbrage_sample::Key;
/// use umbrage_shadow::{Shadow, presets};
///
/// let lamp = View::perspective(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, 1.0, 1.0, 100.0, UVec2::splat(64))?;
/// let depths = (0..64 * 64).map(|i| if i % 64 < 32 { 5.0 } else { 10.0 }).collect();
/// let map = MomentMap::of(&Raw::new(lamp, depths)?, Moments::Variance, 2.0);
/// let shadow = presets::vsm().over(map)?;
/// let at = |x| shadow.fraction(&SurfacePoint::at(Vec3::new(x, 0.0, 0.0), Vec3::Y), Key::new(0, 0, 0));
/// // Dark behind the near half, lit beside it, and a soft edge about four texels wide between them.
/// assert_eq!((at(-3.0), at(3.0)), (1.0, 0.0));
/// assert!(at(-0.1) > at(0.1) && at(0.1) > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn vsm() -> Preset<FromMoments> {
    moments("vsm", FromMoments::default().with_bleeding(0.2))
}

/// Annen, Mertens, Seidel, Flerackers & Kautz 2008: exponential shadow maps, over [`Moments::ESM`](umbrage_depth::Moments::ESM).
///
/// Shadows fade toward their casters: what lies closer behind them than a few times the depth range over the sharpness is partly lit.
pub fn esm() -> Preset<FromMoments> {
    moments("esm", FromMoments::default().with_bleeding(0.0))
}

/// Lauritzen & McCool 2008: variance shadow maps of an exponential of the depth, over [`Moments::EVSM2`](umbrage_depth::Moments::EVSM2).
///
/// Light bleeds only near the casters, as with [`esm`], and where those vary, as with [`vsm`].
pub fn evsm2() -> Preset<FromMoments> {
    moments("evsm2", FromMoments::default().with_bleeding(0.1))
}

/// The same with a second exponential, the better of both bounds, over [`Moments::EVSM4`](umbrage_depth::Moments::EVSM4).
///
/// The second one makes tilted planes shadow themselves, which a bias of one depth step prevents.
pub fn evsm4() -> Preset<FromMoments> {
    moments("evsm4", FromMoments::default().with_bleeding(0.1).with_bias(Bias::Steps(1.0)))
}

/// Peters & Klein 2015: moment shadow maps with four moments, over [`Moments::Four`](umbrage_depth::Moments::Four), with a fiftieth of the visibility cut off.
///
/// The sharpest of them: it distinguishes three surfaces over one another. Tilted planes would therefore shadow themselves nearly as with
/// percentage-closer filtering without a bias, which a bias of two depth steps prevents for regions of a few texels.
pub fn msm() -> Preset<FromMoments> {
    moments("msm", FromMoments::default().with_bleeding(0.02).with_bias(Bias::Steps(2.0)))
}

fn moments(name: &'static str, filter: FromMoments) -> Preset<FromMoments> {
    Preset { name, filter, expects: &[Stored::First] }
}
