use glam::{DVec2, IVec2, UVec2};

/// Where inside a texel its one sample of the scene is taken (Reeves 1987, §3.1).
///
/// Offsets are in 1/256 of a texel, so that rasteriser, tangent plane and bias cone name the same place exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Sampling {
    /// At the centre: *regular* sampling, what Reeves' team used and the default.
    #[default]
    Centre,
    /// At a place drawn once per texel from `seed`: *stochastic* sampling. Reproducible from the texel alone.
    Jittered {
        /// Chooses one of 2³² sets of offsets.
        seed: u32,
    },
}

impl Sampling {
    /// The sample's offset from the texel's upper left corner, in 1/256 texel, each in 0..256.
    #[inline(always)]
    pub fn offset_256(self, texel: IVec2) -> UVec2 {
        match self {
            Self::Centre => UVec2::splat(128),
            Self::Jittered { seed } => {
                let column = mix32(mix32(seed).wrapping_add((texel.x as u32).wrapping_mul(0x85EB_CA6B)));
                let bits = mix32(column.wrapping_add((texel.y as u32).wrapping_mul(0x9E37_79B9)));
                UVec2::new(bits & 255, (bits >> 8) & 255)
            }
        }
    }

    /// The sample's position in texel space.
    #[inline(always)]
    pub fn position(self, texel: IVec2) -> DVec2 {
        texel.as_dvec2() + self.offset_256(texel).as_dvec2() * (1.0 / 256.0)
    }

    /// [`Sampling::position`] of sixteen texels, by their columns and rows: all x, all y.
    #[inline(always)]
    pub fn positions(self, columns: &[i32; 16], rows: &[i32; 16]) -> [[f64; 16]; 2] {
        let (mut x, mut y) = ([0.0; 16], [0.0; 16]);
        match self {
            Self::Centre => {
                for i in 0..16 {
                    (x[i], y[i]) = (f64::from(columns[i]) + 0.5, f64::from(rows[i]) + 0.5);
                }
            }
            Self::Jittered { .. } => {
                for i in 0..16 {
                    (x[i], y[i]) = self.position(IVec2::new(columns[i], rows[i])).into();
                }
            }
        }
        [x, y]
    }
}

/// A 32-bit mixing function with full avalanche (the `lowbias32` constants found by Chris Wellons' search).
///
/// All of Umbrage's per-texel and per-sample randomness is this function of an index; it is part of the bits of every picture.
#[inline(always)]
pub const fn mix32(mut bits: u32) -> u32 {
    bits ^= bits >> 16;
    bits = bits.wrapping_mul(0x7FEB_352D);
    bits ^= bits >> 15;
    bits = bits.wrapping_mul(0x846C_A68B);
    bits ^ (bits >> 16)
}
