//! One line of points.

use glam::{DVec3, Vec3};
use std::fmt;
use umbrage_plane::SurfacePoint;

/// The names of the numbers of a line.
const FIELDS: [&str; 12] = ["x", "y", "z", "nx", "ny", "nz", "ux", "uy", "uz", "vx", "vy", "vz"];

/// Why a line is not a point.
#[derive(Debug, PartialEq, Eq)]
pub struct Fault(String);

impl Fault {
    pub fn length() -> Self {
        Self("it is longer than twelve numbers can be".into())
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| c == ',' || c.is_whitespace()).filter(|word| !word.is_empty())
}

/// Whether a line names its columns: it begins with a word that is not a number.
pub fn is_header(line: &str) -> bool {
    words(line).next().is_some_and(|word| {
        word.trim_matches('"').starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && word.parse::<f64>().is_err()
    })
}

/// The point of a line, whose randomness is that of a region; `None` for an empty line.
pub fn point(line: &str, region: u32) -> Result<Option<SurfacePoint>, Fault> {
    let mut numbers = [0.0; 12];
    let mut count = 0;
    for word in words(line) {
        let Some(field) = FIELDS.get(count) else {
            return Err(Fault(format!("there are more than {} numbers", FIELDS.len())));
        };
        let number = word.parse().ok().filter(|number: &f64| number.is_finite());
        let shown: String = word.escape_debug().take(40).collect();
        numbers[count] = number.ok_or_else(|| Fault(format!("{field} is {shown}: expected a finite number")))?;
        count += 1;
    }
    if count == 0 {
        return Ok(None);
    }
    if count != 6 && count != 12 {
        return Err(Fault(format!(
            "there are {count} numbers: expected x y z nx ny nz, and perhaps ux uy uz vx vy vz"
        )));
    }
    let vector = |first: usize| DVec3::from_slice(&numbers[first..first + 3]);
    let (position, normal) = (vector(0), vector(3).normalize_or_zero().as_vec3());
    if normal == Vec3::ZERO {
        return Err(Fault("nx ny nz is 0 0 0: expected a direction".into()));
    }
    let (u, v) = (0.5 * vector(6), 0.5 * vector(9));
    let corners = [position - u - v, position + u - v, position + u + v, position - u + v];
    Ok(Some(SurfacePoint { region, ..SurfacePoint::at(position, normal).with_corners(corners) }))
}
