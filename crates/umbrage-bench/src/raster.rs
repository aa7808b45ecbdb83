//! Pass 1 over the meshes, and what of it there is to check.

use crate::meshes::{Mesh, grid, layers, reversed, scattered, straight};
use crate::peers::software::Software;
use crate::scene::{Scene, Segments};
use umbrage_bake::{Baked, BakedFacets, Refinement, bake, bake_facets, bake_refined};
use umbrage_depth::{First, Midpoint, Raw, Second};
use umbrage_plane::{TexelRect, View};
use umbrage_raster::{Bins, Cull, Triangle};

/// A mesh, the view that draws it, and how much is drawn.
#[derive(Debug)]
pub struct Workload {
    /// Its name, as in ids.
    pub name: &'static str,
    /// Side of the map, texels.
    pub side: u32,
    /// The view.
    pub view: View,
    /// What is drawn.
    pub mesh: Mesh,
    /// Texels that must be covered.
    pub covered: Covered,
}

/// How many texels a mesh covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Covered {
    /// Exactly so many.
    Exactly(usize),
    /// At least so many.
    AtLeast(usize),
}

impl Workload {
    fn new(name: &'static str, side: u32, view: &View, mesh: Mesh, covered: Covered) -> Self {
        Self { name, side, view: *view, mesh, covered }
    }

    fn straight(name: &'static str, side: u32, mesh: Mesh, covered: Covered) -> Self {
        Self::new(name, side, &straight(side), mesh, covered)
    }

    /// Set up and sorted into tiles in chunks as [`bake`] takes them, and nothing drawn; the last chunk.
    pub fn binned(&self) -> Bins {
        let nothing: [Triangle; 0] = [];
        let mut bins = Bins::new(&self.view, TexelRect::of_size(self.view.size()), Cull::None, nothing);
        let most = (16 * bins.tiles().element_product() as usize).max(1 << 16);
        for mut mesh in self.mesh.indexed() {
            while !mesh.is_empty() {
                bins.refill([mesh.split_to(most)]);
            }
        }
        bins
    }

    /// Eight layers, the farthest first.
    pub fn back_to_front(side: u32) -> Self {
        Self::straight("layers-back-to-front", side, layers(8), Covered::Exactly(texels(side)))
    }

    /// Eight layers, the nearest first.
    pub fn front_to_back(side: u32) -> Self {
        Self::straight("layers-front-to-back", side, reversed(&layers(8)), Covered::Exactly(texels(side)))
    }

    /// So many triangles of 100 texels.
    pub fn hundred(count: u32, side: u32) -> Self {
        // Where all lie apart they cover 100 each.
        let apart = (count as usize * 100).min(texels(side));
        Self::straight("100-texel-triangles", side, scattered(count, side), Covered::AtLeast(apart / 2))
    }

    /// `2 · cells²` triangles of about a texel.
    pub fn tiny(cells: u32, side: u32) -> Self {
        // Even, so that as much lies on either side of the middle.
        let across = ((2 * cells * cells) as f32).sqrt().round() as u32 & !1;
        let mesh = grid(cells, across.min(side), side);
        Self::straight("1-texel-grid", side, mesh, Covered::Exactly(texels(across.min(side))))
    }

    /// A knot on its ground.
    pub fn knot(name: &'static str, segments: Segments, side: u32) -> Self {
        let mesh = crate::meshes::knot_on_ground(segments.0, segments.1);
        Self::new(name, side, &Scene::view(side), mesh, Covered::Exactly(texels(side)))
    }

    /// Pass 1 by the nearest surface.
    pub fn first(&self) -> Baked {
        first(&self.view, &self.mesh)
    }

    /// Draws it once by ours, and checks what was drawn.
    ///
    /// # Panics
    /// When another number of texels is covered than should be.
    pub fn checked(&self) -> Baked {
        let baked = self.first();
        let covered = Raw::copy_of(&baked.map).depths().iter().filter(|depth| depth.is_finite()).count();
        let right = match self.covered {
            Covered::Exactly(wanted) => covered == wanted,
            Covered::AtLeast(wanted) => covered >= wanted,
        };
        assert!(right, "{} at {}: {covered} texels, but {:?} should be covered", self.name, self.side, self.covered);
        baked
    }

    /// Checks that a peer drew what ours did: it may leave cracks and round otherwise, but hardly anywhere.
    ///
    /// # Panics
    /// When it drew something else.
    pub fn assert_drawn(&self, baked: &Baked, software: &Software) {
        let map = Raw::copy_of(&baked.map);
        let covered = map.depths().iter().filter(|depth| depth.is_finite()).count();
        let alike = map.depths().iter().zip(software.keys()).filter(|(depth, key)| {
            let theirs = -1.0 / **key;
            depth.is_finite() && theirs.is_finite() && (**depth - theirs).abs() < 2e-3 * **depth
        });
        let alike = alike.count();
        assert!(alike * 100 > covered * 97, "{}: euc draws {alike} of {covered} texels as ours does", self.name);
    }

    /// Layers of a buffer in which a minimum is taken as often as there are fragments, rounded up.
    pub fn limit_layers(&self, baked: &Baked) -> u32 {
        baked.fragments.div_ceil(u64::from(self.side) * u64::from(self.side)) as u32
    }
}

fn texels(side: u32) -> usize {
    side as usize * side as usize
}

/// Pass 1 by the nearest surface.
pub fn first(view: &View, mesh: &Mesh) -> Baked {
    bake(view, mesh.indexed(), &First, Cull::None)
}

/// The same of triangles that share nothing.
pub fn first_one_by_one(view: &View, triangles: &[Triangle]) -> Baked {
    bake(view, triangles.iter().copied(), &First, Cull::None)
}

/// Pass 1 by the second surface.
pub fn second(view: &View, mesh: &Mesh) -> Baked {
    bake(view, mesh.indexed(), &Second, Cull::None)
}

/// Pass 1 by midpoints.
pub fn midpoint(view: &View, mesh: &Mesh) -> Baked {
    bake(view, mesh.indexed(), &Midpoint::default(), Cull::None)
}

/// Pass 1 of facets, one for each texel.
pub fn facets(view: &View, mesh: &Mesh) -> BakedFacets {
    bake_facets(view, mesh.indexed(), &First, Cull::None)
}

/// Pass 1 of facets as `auto` wants it.
pub fn refined(view: &View, mesh: &Mesh) -> BakedFacets {
    bake_refined(view, mesh.indexed(), &Refinement::default())
}
