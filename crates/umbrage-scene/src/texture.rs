use glam::{DVec2, UVec2, Vec4};
use std::fmt;
use std::sync::LazyLock;

/// An image that lies on a surface: linear RGB, and alpha, by a place (u, v) in it.
///
/// (0, 0) is the upper left corner of the image and (1, 1) its lower right one, as in glTF; what lies outside is for [`Wrap`] to
/// say. Colours are decoded before they are mixed, and alpha is not multiplied into them.
///
/// ```
/// use glam::{DVec2, UVec2, Vec4};
/// use umbrage_scene::{Interpolation, Texture, Wrap};
///
/// // A white texel beside a black one that is not there.
/// let texture = Texture::srgb(UVec2::new(2, 1), vec![[255; 4], [0; 4]])?;
/// assert_eq!(texture.sample(DVec2::new(0.5, 0.5)), Vec4::splat(0.5));
/// let hard = texture.with_interpolation(Interpolation::Nearest).with_wrap([Wrap::Clamp; 2]);
/// assert_eq!([-7.0, 0.4, 0.6, 7.0].map(|u| hard.sample(DVec2::new(u, 0.5)).w), [1.0, 1.0, 0.0, 0.0]);
/// # Ok::<(), umbrage_scene::TextureError>(())
/// ```
#[derive(Clone, PartialEq)]
pub struct Texture {
    size: UVec2,
    texels: Texels,
    wrap: [Wrap; 2],
    interpolation: Interpolation,
}

/// A quarter of the memory for what comes from files of 8 bits.
#[derive(Clone, PartialEq)]
enum Texels {
    Srgb(Vec<[u8; 4]>),
    Linear(Vec<Vec4>),
}

/// What a texture is outside of 0..1 along one of its axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The same again and again.
    #[default]
    Repeat,
    /// The same again and again, every other time mirrored.
    Mirror,
    /// As its nearest texel within.
    Clamp,
}

/// What a texture is between the centres of its texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// As the nearest of them.
    Nearest,
    /// A mean of the four around, by their nearness along each axis.
    #[default]
    Bilinear,
}

/// Why an image cannot be a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TextureError {
    /// A side of 0 texels.
    #[error("a texture of {0} x {1} texels is empty")]
    Empty(u32, u32),
    /// Not one value for each texel.
    #[error("a texture of {} x {} texels has {texels} of them", size[0], size[1])]
    Length {
        /// Texels across and down.
        size: [u32; 2],
        /// Number of texels given.
        texels: usize,
    },
    /// A channel is NaN or infinite.
    #[error("texel {texel} has a channel that is not finite")]
    NotFinite {
        /// Index of the texel, row by row.
        texel: usize,
    },
}

impl Texture {
    /// From 8 bits a channel, rows from the top: colour as sRGB, as files have it, and alpha linear. Repeats, and is bilinear between
    /// its texels, unless set otherwise.
    ///
    /// # Errors
    /// [`TextureError`], unless there is one texel for each place of `size`, and at least one.
    pub fn srgb(size: UVec2, texels: Vec<[u8; 4]>) -> Result<Self, TextureError> {
        Self::new(size, texels.len(), Texels::Srgb(texels))
    }

    /// From linear RGB and alpha, rows from the top. Repeats, and is bilinear between its texels, unless set otherwise.
    ///
    /// # Errors
    /// [`TextureError`], unless there is one texel for each place of `size`, and at least one, and all are finite.
    pub fn linear(size: UVec2, texels: Vec<Vec4>) -> Result<Self, TextureError> {
        if let Some(texel) = texels.iter().position(|texel| !texel.is_finite()) {
            return Err(TextureError::NotFinite { texel });
        }
        Self::new(size, texels.len(), Texels::Linear(texels))
    }

    fn new(size: UVec2, length: usize, texels: Texels) -> Result<Self, TextureError> {
        if size.min_element() == 0 {
            return Err(TextureError::Empty(size.x, size.y));
        }
        if u64::from(size.x) * u64::from(size.y) != length as u64 {
            return Err(TextureError::Length { size: size.to_array(), texels: length });
        }
        Ok(Self { size, texels, wrap: [Wrap::default(); 2], interpolation: Interpolation::default() })
    }

    /// The same with other rules for what lies outside of it: along u, and along v.
    #[must_use]
    pub fn with_wrap(self, wrap: [Wrap; 2]) -> Self {
        Self { wrap, ..self }
    }

    /// The same with another rule for what lies between its texels.
    #[must_use]
    pub fn with_interpolation(self, interpolation: Interpolation) -> Self {
        Self { interpolation, ..self }
    }

    /// Texels across and down.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// The least alpha of its texels: nothing of it has less.
    pub fn least_alpha(&self) -> f32 {
        let alpha = |least: f32, alpha: f32| least.min(alpha);
        match &self.texels {
            Texels::Linear(texels) => texels.iter().map(|texel| texel.w).fold(f32::INFINITY, alpha),
            Texels::Srgb(texels) => texels.iter().map(|texel| f32::from(texel[3]) / 255.0).fold(f32::INFINITY, alpha),
        }
    }

    /// Linear RGB and alpha at a place in the texture. A place that is not finite counts as (0, 0).
    pub fn sample(&self, uv: DVec2) -> Vec4 {
        let place = uv * self.size.as_dvec2();
        let place = if place.is_finite() { place } else { DVec2::ZERO };
        match self.interpolation {
            Interpolation::Nearest => self.texel(whole(place.floor())),
            Interpolation::Bilinear => {
                let place = place - 0.5;
                let corner = place.floor();
                let (part, [x, y]) = ((place - corner).as_vec2(), whole(corner));
                let (right, down) = (x.saturating_add(1), y.saturating_add(1));
                let above = between(self.texel([x, y]), self.texel([right, y]), part.x);
                let below = between(self.texel([x, down]), self.texel([right, down]), part.x);
                between(above, below, part.y)
            }
        }
    }

    /// The texel of a column and a row, which may lie outside.
    fn texel(&self, [x, y]: [i64; 2]) -> Vec4 {
        let (x, y) = (self.wrap[0].index(x, self.size.x), self.wrap[1].index(y, self.size.y));
        let index = y * self.size.x as usize + x;
        match &self.texels {
            Texels::Linear(texels) => texels[index],
            Texels::Srgb(texels) => {
                let [r, g, b, alpha] = texels[index];
                let [r, g, b] = [r, g, b].map(|channel| DECODED[usize::from(channel)]);
                Vec4::new(r, g, b, f32::from(alpha) / 255.0)
            }
        }
    }
}

/// Without its texels.
impl fmt::Debug for Texture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Texture")
            .field("size", &self.size)
            .field("wrap", &self.wrap)
            .field("interpolation", &self.interpolation)
            .finish_non_exhaustive()
    }
}

impl Wrap {
    /// Which of `count` texels a place of the axis sees.
    fn index(self, at: i64, count: u32) -> usize {
        let count = i64::from(count);
        let index = match self {
            Self::Repeat => at.rem_euclid(count),
            Self::Mirror => {
                let twice = at.rem_euclid(2 * count);
                twice.min(2 * count - 1 - twice)
            }
            Self::Clamp => at.clamp(0, count - 1),
        };
        index as usize
    }
}

/// Places too far away for an integer are the farthest that there are.
fn whole(place: DVec2) -> [i64; 2] {
    place.to_array().map(|axis| axis as i64)
}

/// From a to b. Where both are the same it is what they are, to the bit: an alpha test may compare with just that.
fn between(a: Vec4, b: Vec4, part: f32) -> Vec4 {
    a + (b - a) * part
}

/// Linear light of each value of an sRGB channel (IEC 61966-2-1).
static DECODED: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|value| {
        let value = value as f64 / 255.0;
        let linear = if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) };
        linear as f32
    })
});
