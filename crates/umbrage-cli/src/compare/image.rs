//! A shadow image from another program.

use crate::memory::Need;
use crate::shell::Usage;
use anyhow::{Context, bail};
use glam::UVec2;
use std::path::Path;
use umbrage_io::{file_bytes, read_values};

/// The fraction in shadow of each pixel of an image, or with `invert` what it is the complement of.
///
/// # Errors
/// One line with the file: it cannot be read, has another size than truth, or pixels that are not numbers.
pub fn read(path: &Path, invert: bool, size: UVec2, need: &Need, max_memory: Option<u64>) -> anyhow::Result<Vec<f32>> {
    let shown = path.display();
    let need = Need { file_bytes: file_bytes(path)?, ..*need };
    need.check(max_memory).with_context(|| shown.to_string())?;
    let image = read_values(path, need.texels_left(max_memory))?;
    if image.size != size {
        let [width, height] = image.size.to_array();
        return Err(Usage(format!(
            "{shown}: the image has {width} x {height} pixels, truth has {} x {} (--size {width}x{height} makes them equal)",
            size.x, size.y
        ))
        .into());
    }
    let width = size.x as usize;
    if let Some(at) = image.values.iter().position(|value| !value.is_finite()) {
        bail!("{shown}: the pixel in column {}, row {} is {}", at % width, at / width, image.values[at]);
    }
    let mut values = image.values;
    if invert {
        for value in &mut values {
            *value = 1.0 - *value;
        }
    }
    Ok(values)
}
