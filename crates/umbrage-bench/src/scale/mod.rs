//! How time and memory grow: pass 1 with its triangles, maps and pictures with their sides.
//!
//! Each point is measured in a process of its own, so that the memory that is reported is the point's alone. Times are wall time of all
//! threads.

mod maps;
mod pictures;
mod quantity;
mod triangles;

pub use quantity::Quantity;

use umbrage_io::peak_memory;

/// What grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Series {
    /// Triangles that stream into a map of 1024² texels.
    Triangles,
    /// The side of a map of the bicycle shop that is baked to disk, and through whose pages a picture is drawn.
    Maps,
    /// The side of a picture of the bicycle shop.
    Pictures,
}

impl Series {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Triangles, Self::Maps, Self::Pictures];

    /// Its name on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Triangles => "triangles",
            Self::Maps => "maps",
            Self::Pictures => "pictures",
        }
    }

    /// The series of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|series| series.name() == name)
    }

    /// Its sizes, ascending: numbers of triangles, or sides in texels or pixels.
    pub fn sizes(self, quick: bool) -> Vec<u32> {
        match (self, quick) {
            (Self::Triangles, true) => vec![1_000, 100_000],
            (Self::Triangles, false) => (3..=8).map(|decade| 10u32.pow(decade)).collect(),
            (Self::Maps | Self::Pictures, true) => vec![64, 256],
            (Self::Maps, false) => (8..=15).map(|side| 1 << side).collect(),
            (Self::Pictures, false) => (8..=13).map(|side| 1 << side).collect(),
        }
    }

    /// Measures one point in this process.
    ///
    /// # Errors
    /// A file that cannot be written or read.
    ///
    /// # Panics
    /// When a result is not what it must be, or the size is not one of a map.
    pub fn measure(self, size: u32) -> Result<Vec<Quantity>, Box<dyn std::error::Error>> {
        let mut measured = match self {
            Self::Triangles => triangles::measure(size),
            Self::Maps => maps::measure(size)?,
            Self::Pictures => pictures::measure(size),
        };
        if let Some(bytes) = peak_memory() {
            measured.push(Quantity { what: "peak memory", unit: "MiB", value: bytes as f64 / 1_048_576.0 });
        }
        Ok(measured)
    }
}
