use glam::DVec3;

/// Things that are worked on together.
pub const LANES: usize = 8;

/// A number of each of [`LANES`] things. Loops over such arrays, with the operations of the way that takes one thing at a time and in its
/// order, become vector instructions and give the same bits.
pub type Lanes = [f64; LANES];

/// A vector of each of [`LANES`] things, coordinate by coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes3 {
    /// Their x.
    pub x: Lanes,
    /// Their y.
    pub y: Lanes,
    /// Their z.
    pub z: Lanes,
}

impl Lanes3 {
    /// Of the vectors that `each` gives for 0 to [`LANES`] − 1.
    #[inline(always)]
    pub fn of(each: impl Fn(usize) -> DVec3) -> Self {
        let mut all = Self { x: [0.0; LANES], y: [0.0; LANES], z: [0.0; LANES] };
        for i in 0..LANES {
            let one = each(i);
            (all.x[i], all.y[i], all.z[i]) = (one.x, one.y, one.z);
        }
        all
    }

    /// The vector of one. Panics from [`LANES`] on.
    #[inline(always)]
    pub fn at(&self, lane: usize) -> DVec3 {
        DVec3::new(self.x[lane], self.y[lane], self.z[lane])
    }
}
