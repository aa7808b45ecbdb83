//! How much memory a command may use, and how much it will: a formula that a user can compute.

use anyhow::bail;
use glam::UVec2;
use umbrage_io::machine_memory;

const MIB: u64 = 1 << 20;
const GIB: u64 = 1 << 30;

/// What every command may take.
const BASE: u64 = 64 * MIB;
/// Bytes for each byte of a file that is read.
const PER_FILE_BYTE: u64 = 8;
/// Bytes for each sample of a picture, and for each of its pixels.
const PER_SAMPLE: u64 = 64;
const PER_PIXEL: u64 = 512;
/// Bytes for each triangle: about 100 are taken by maps, and 350 by rays.
const PER_TRIANGLE: u64 = 512;
/// Bytes for each texel of each map.
const PER_TEXEL: u64 = 64;
/// Bytes for each texel of the finished maps of an area light; only one of them at a time is being made.
const PER_KEPT_TEXEL: u64 = 16;

/// Bytes for each pixel of each result that is kept beside truth.
const PER_RESULT_PIXEL: u64 = 128;

/// What a command is about to hold.
#[derive(Clone, Copy, Debug, Default)]
pub struct Need {
    pub file_bytes: u64,
    pub picture: UVec2,
    pub samples: u32,
    pub triangles: u64,
    pub texels: u64,
    /// Texels of all maps of an area light.
    pub kept_texels: u64,
    /// Pictures of results that are kept beside truth.
    pub results: u64,
}

impl Need {
    /// 64 MiB + 8 × the file + 512 bytes for each pixel + 64 for each sample + 512 for each triangle + 64 for each texel of a map
    /// + 16 for each texel of all maps of an area light + 128 for each pixel of each result that is kept beside truth.
    pub fn bytes(&self) -> u64 {
        let pixels = u64::from(self.picture.x) * u64::from(self.picture.y);
        let picture = pixels.saturating_mul(PER_PIXEL + PER_SAMPLE * u64::from(self.samples));
        BASE.saturating_add(self.file_bytes.saturating_mul(PER_FILE_BYTE))
            .saturating_add(picture)
            .saturating_add(self.triangles.saturating_mul(PER_TRIANGLE))
            .saturating_add(self.texels.saturating_mul(PER_TEXEL))
            .saturating_add(self.kept_texels.saturating_mul(PER_KEPT_TEXEL))
            .saturating_add(pixels.saturating_mul(PER_RESULT_PIXEL).saturating_mul(self.results))
    }

    /// Bytes that may be held beside all this.
    pub fn left(&self, most: Option<u64>) -> u64 {
        most.unwrap_or_else(default).saturating_sub(self.bytes())
    }

    /// Texels of a map, or pixels of an image, that may be held beside all this.
    pub fn texels_left(&self, most: Option<u64>) -> u64 {
        self.left(most) / PER_TEXEL
    }

    /// Succeeds if this much may be held.
    ///
    /// # Errors
    /// One line that names both numbers.
    pub fn check(&self, most: Option<u64>) -> anyhow::Result<()> {
        let (needed, most) = (self.bytes(), most.unwrap_or_else(default));
        if needed > most {
            bail!("memory: {} MiB may be needed, more than --max-memory {} MiB", needed.div_ceil(MIB), most / MIB);
        }
        Ok(())
    }
}

/// 4 GiB, or half of the machine's memory where that is less.
pub fn default() -> u64 {
    machine_memory().map_or(4 * GIB, |total| (total / 2).min(4 * GIB))
}

/// A number of bytes, with a unit or without.
pub fn parse(text: &str) -> Result<u64, String> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = match text[digits.len()..].to_ascii_lowercase().as_str() {
        "" | "b" => 1,
        "k" | "kb" | "kib" => 1 << 10,
        "m" | "mb" | "mib" => MIB,
        "g" | "gb" | "gib" => GIB,
        _ => return Err("expected a number of bytes, or one with KiB, MiB or GiB".into()),
    };
    let number = digits.trim().parse::<u64>().ok().and_then(|number| number.checked_mul(unit));
    number.ok_or_else(|| "expected a whole number of bytes, or one with KiB, MiB or GiB".into())
}
