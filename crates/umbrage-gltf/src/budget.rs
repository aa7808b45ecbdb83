use crate::GltfError;
use std::cell::Cell;

/// Bytes per vertex of a mesh that was read, or of a place where it stands: positions and normals, and what is made on the way.
pub(crate) const VERTEX: u64 = 96;
/// Bytes per triangle: its corners, its surface, and what is made to find its neighbours.
pub(crate) const TRIANGLE: u64 = 112;
/// Bytes per object, beside its triangles.
pub(crate) const OBJECT: u64 = 512;

/// What may be allocated. What is charged is never given back: it bounds the work too.
#[derive(Debug)]
pub(crate) struct Budget {
    most: u64,
    left: Cell<u64>,
}

impl Budget {
    pub fn new(most: u64) -> Self {
        Self { most, left: Cell::new(most) }
    }

    /// Takes `count` times `each` bytes, before they are allocated.
    pub fn charge(&self, path: &str, count: u64, each: u64) -> Result<(), GltfError> {
        let (bytes, left) = (count.saturating_mul(each), self.left.get());
        match left.checked_sub(bytes) {
            Some(rest) => {
                self.left.set(rest);
                Ok(())
            }
            None => Err(GltfError::Budget { path: path.to_owned(), bytes, left, most: self.most }),
        }
    }
}
