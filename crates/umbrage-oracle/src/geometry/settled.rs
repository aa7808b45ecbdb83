//! Points that lie beside their own facet by no more than roundings, moved onto it.

use super::Geometry;
use crate::place::Place;
use glam::DVec3;
use obvhs::bvh2::node::Bvh2Node;
use umbrage_plane::SurfacePoint;

/// A facet near a place.
struct Near {
    face: u32,
    /// Its point nearest to the place, relative to the geometry's origin, and how far that is.
    at: DVec3,
    distance: f64,
}

/// The box of a facet with an area.
struct Boxed {
    leaf: u32,
    face: u32,
    first: DVec3,
    last: DVec3,
    /// Its longest side.
    size: f64,
}

impl Boxed {
    /// How far off the facet a point counts as on it, given the largest coordinate about the geometry's origin.
    fn reach(&self, about: f64) -> f64 {
        ROUNDED * (about + self.size)
    }

    /// Whether all places between two are farther off the box than [`Boxed::reach`], by more than anything is rounded by: they are farther off the
    /// facet as well. As in [`Geometry::is_about`], what is true of all is true of each.
    fn is_off(&self, low: DVec3, high: DVec3, about: f64) -> bool {
        (self.first - high).max(low - self.last).max_element() > self.reach(about) * (1.0 + 1e-6)
    }
}

/// What rounding to f32 leaves between a point and a surface that both were on, as a fraction of coordinates and sizes: half a unit in the last place of each of
/// three coordinates.
const ROUNDED: f64 = 1.0 / (1u64 << 23) as f64;

impl Geometry {
    /// A point moved onto its own facet when it lies off it by no more than the rounding of f32 of its coordinates about the
    /// origin and of the facet's size. So are points that came from f32, and those that a picture takes beside an edge on the
    /// plane of the next facet. A point that is farther off every facet of its object stays where it is.
    ///
    /// Of the facets within that reach its own is the one with its normal, and the nearest of several such. Where its object has
    /// none there, a point of f32 numbers is taken to lie on any facet with its normal: not everybody names objects.
    pub(crate) fn settled(&self, point: &SurfacePoint) -> Place {
        self.all_settled(std::iter::once(point)).next().unwrap_or_else(|| self.place(point.position))
    }

    /// [`Geometry::settled`] of points that lie near each other, in their order.
    pub(crate) fn all_settled<'p>(
        &self,
        points: impl Iterator<Item = &'p SurfacePoint> + Clone,
    ) -> impl Iterator<Item = Place> {
        // Where there are more about all points, each had better look for its own.
        const MOST: usize = 32;
        let (none, all) = (DVec3::splat(f64::NEG_INFINITY), DVec3::splat(f64::INFINITY));
        let places = points.clone().map(|point| point.position - self.origin).filter(|at| at.is_finite());
        let (low, high) = places.fold((all, none), |(low, high), at| (low.min(at), high.max(at)));
        let (mut leaves, mut about, mut facets) = (Vec::new(), Vec::new(), Vec::new());
        self.leaves_about(0, low, high, MOST, &mut leaves);
        let apart = leaves.len() > MOST;
        if !apart {
            self.boxes_about(&leaves, low, high, &mut about);
        }
        points.map(move |point| {
            let place = self.place(point.position);
            if apart {
                leaves.clear();
                about.clear();
                self.leaves_about(0, place.at, place.at, usize::MAX, &mut leaves);
                self.boxes_about(&leaves, place.at, place.at, &mut about);
            }
            self.settled_among(&about, point, place, &mut facets)
        })
    }

    /// [`Geometry::settled`], given the point's place, the boxes of all facets that may be near it, and room for the facets.
    fn settled_among(&self, about: &[Boxed], point: &SurfacePoint, place: Place, facets: &mut Vec<Near>) -> Place {
        facets.clear();
        self.facets_about(about, place.at, Some(point.object), facets);
        let single = |at: DVec3| at.as_vec3().as_dvec3() == at;
        if facets.is_empty() && (single(point.position) || single(place.at)) {
            self.facets_about(about, place.at, None, facets);
            let normal = point.normal.as_dvec3();
            facets.retain(|facet| self.triangles[facet.face as usize].normal.cross(normal).length() < 1e-3);
        }
        let turned = |facet: &Near| self.triangles[facet.face as usize].normal.cross(point.normal.as_dvec3()).length();
        let least = facets.iter().map(turned).fold(f64::INFINITY, f64::min);
        // Normals are f32 numbers.
        let own = facets.iter().filter(|facet| turned(facet) <= least + 1e-6);
        match own.min_by(|a, b| a.distance.total_cmp(&b.distance)) {
            Some(own) if own.distance > place.rounding => Place { at: own.at, ..place },
            _ => place,
        }
    }

    /// The same as a place of the world.
    pub(crate) fn on_facet(&self, point: &SurfacePoint) -> DVec3 {
        self.origin + self.settled(point).at
    }

    /// Whether a box is near enough to the places between two for something in it to be so for [`Geometry::settled`]. Its arithmetic is monotonous, also where
    /// it rounds: what is false for a box is false for all boxes in it and for all places between.
    fn is_about(node: &Bvh2Node, low: DVec3, high: DVec3) -> bool {
        let about = low.abs().max(high.abs()).max_element();
        let (first, last) = (node.aabb().min.as_dvec3(), node.aabb().max.as_dvec3());
        (first - high).max(low - last).max_element() <= ROUNDED * (about + (last - first).max_element())
    }

    /// The leaves at and below a node that are near enough to places between two; when they are more than `most`, some of them, but more than `most`.
    fn leaves_about(&self, index: u32, low: DVec3, high: DVec3, most: usize, found: &mut Vec<u32>) {
        let Some(node) = self.tree.nodes.get(index as usize) else { return };
        if found.len() > most || !Self::is_about(node, low, high) {
            return;
        }
        if node.is_leaf() {
            found.push(index);
        } else {
            self.leaves_about(node.first_index, low, high, most, found);
            self.leaves_about(node.first_index + 1, low, high, most, found);
        }
    }

    /// The boxes of the facets in some leaves that may be near enough for [`Geometry::settled`] to a place between two.
    fn boxes_about(&self, leaves: &[u32], low: DVec3, high: DVec3, found: &mut Vec<Boxed>) {
        let about = low.abs().max(high.abs()).max_element();
        for &leaf in leaves {
            let node = &self.tree.nodes[leaf as usize];
            let first = node.first_index as usize;
            for &face in &self.tree.primitive_indices[first..first + node.prim_count as usize] {
                let triangle = &self.triangles[face as usize];
                let (first, last) = triangle.bounds();
                let boxed = Boxed { leaf, face, first, last, size: (last - first).max_element() };
                if triangle.normal != DVec3::ZERO && !boxed.is_off(low, high, about) {
                    found.push(boxed);
                }
            }
        }
    }

    /// The facets of an object, or of any, of some boxes that are near enough to a place for [`Geometry::settled`].
    fn facets_about(&self, boxes: &[Boxed], place: DVec3, object: Option<u32>, found: &mut Vec<Near>) {
        let about = place.abs().max_element();
        for of_leaf in boxes.chunk_by(|a, b| a.leaf == b.leaf) {
            if !Self::is_about(&self.tree.nodes[of_leaf[0].leaf as usize], place, place) {
                continue;
            }
            for boxed in of_leaf.iter().filter(|boxed| !boxed.is_off(place, place, about)) {
                let face = boxed.face;
                if object.is_some_and(|object| self.faces[face as usize].object != object) {
                    continue;
                }
                let at = self.triangles[face as usize].nearest(place);
                let distance = at.distance(place);
                if distance <= boxed.reach(about) {
                    found.push(Near { face, at, distance });
                }
            }
        }
    }
}
