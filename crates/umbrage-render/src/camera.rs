use crate::Soup;
use crate::weights::weights;
use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use umbrage_bake::Masks;
use umbrage_plane::{Cells, Facet, Facing, SurfacePoint, View};
use umbrage_raster::{BIN, Bins, each_fragment};

/// A piece of one surface within one pixel: what is shaded once (Reeves 1987).
pub(crate) struct Region {
    /// Where and how large it is; its normal is the geometric one on the visible side.
    pub point: SurfacePoint,
    /// Interpolated normal on the visible side.
    pub shading_normal: Vec3,
    /// What multiplies the diffuse colour, linear RGB.
    pub texture: Vec3,
    /// Fraction of the pixel's samples.
    pub share: f32,
    /// Index of the pixel within its tile.
    pub pixel: u32,
    /// Distance along the camera's axis.
    pub zeta: f32,
}

/// What the camera sees in a tile.
pub(crate) struct Gathered {
    /// In the order of their pixels.
    pub regions: Vec<Region>,
    /// Fragments met.
    pub fragments: u64,
    /// How many of them were nearer than all before.
    pub passing: u64,
}

/// One sample of a pixel: the key that won and the facet (index into the tile's list).
#[derive(Clone, Copy)]
struct Sample {
    key: f32,
    facet: u32,
}

const NONE: Sample = Sample { key: f32::INFINITY, facet: u32::MAX };

/// The camera's pass over one tile of samples: visible surfaces, gathered into regions pixel by pixel.
///
/// `view` is the camera with `axis` × `axis` texels per pixel.
pub(crate) struct Gather<'a> {
    pub soup: &'a Soup<'a>,
    pub bins: &'a Bins,
    pub masks: &'a Masks<'a>,
    pub view: &'a View,
    pub axis: u32,
    /// One region per sample instead of one per surface.
    pub every_sample: bool,
    /// Points without extent, texture and shading normal, for rays alone.
    pub points: bool,
    /// Pixels across the picture.
    pub width: u32,
}

impl Gather<'_> {
    /// The regions of a tile in pixel order, for the pixels that are `wanted`.
    pub fn tile(&self, tile: UVec2, wanted: impl Fn(u32) -> bool) -> Gathered {
        let origin = (tile * BIN).as_ivec2();
        let mut facets: Vec<Facet> = Vec::new();
        let mut samples = vec![NONE; (BIN * BIN) as usize];
        // What is nearer than the camera's near plane is not seen.
        let nearest = self.view.key(self.view.near()) as f32;
        let mut gathered = Gathered { regions: Vec::new(), fragments: 0, passing: 0 };
        self.masks.tile(self.bins, tile, |facet, coverage| {
            let index = facets.len() as u32;
            facets.push(*facet);
            each_fragment(self.view, origin, facet, coverage, |cell, _, key| {
                if key < nearest {
                    return;
                }
                gathered.fragments += 1;
                // Facets come in the order of their triangles: at equal keys the first stays.
                if key < samples[cell].key {
                    gathered.passing += 1;
                    samples[cell] = Sample { key, facet: index };
                }
            });
        });
        if !facets.is_empty() {
            let surfaces = facets.iter().map(|facet| Surface::of(self.soup, facet)).collect();
            let tile = Tile { origin, samples, facets, surfaces };
            let (across, picture) = (BIN / self.axis, self.view.size() / self.axis);
            let mut room = Room::default();
            let least = if self.every_sample { BIN * BIN } else { across * across };
            gathered.regions.reserve(least as usize);
            for pixel in 0..across * across {
                let corner = UVec2::new(pixel % across, pixel / across) * self.axis;
                let place = (origin.as_uvec2() + corner) / self.axis;
                if place.cmplt(picture).all() && wanted(place.y * self.width + place.x) {
                    self.pixel(&tile, corner, pixel, &mut room, &mut gathered.regions);
                }
            }
        }
        gathered
    }

    fn pixel(&self, tile: &Tile, corner: UVec2, pixel: u32, room: &mut Room, regions: &mut Vec<Region>) {
        let origin = tile.origin;
        let Room { groups, members } = room;
        groups.clear();
        members.clear();
        for i in 0..self.axis * self.axis {
            let cell = UVec2::new(i % self.axis, i / self.axis);
            let at = corner + cell;
            let facet = tile.samples[(at.y * BIN + at.x) as usize].facet;
            let Some(&surface) = tile.surfaces.get(facet as usize) else { continue };
            let position = self.view.sampling().position(origin + at.as_ivec2());
            let known = if self.every_sample { None } else { groups.iter().position(|group| group.surface == surface) };
            let group = known.unwrap_or_else(|| {
                groups.push(Group { surface, cells: Cells::NONE, count: 0 });
                groups.len() - 1
            });
            groups[group].cells = groups[group].cells.with(cell.x, cell.y, self.axis);
            groups[group].count += 1;
            members.push(Member { group, position, facet });
        }
        let middle = (origin.as_dvec2() + corner.as_dvec2()) + f64::from(self.axis) * 0.5;
        let place = (origin / self.axis as i32).as_uvec2() + corner / self.axis;
        let name = (place.y * self.width + place.x).wrapping_mul(64);
        let all = self.axis * self.axis;
        for (index, &Group { surface, cells, count }) in groups.iter().enumerate() {
            // Of samples that are regions by themselves, each is the only one of its group.
            let members = if self.every_sample { &members[index..=index] } else { &members[..] };
            let members = || members.iter().filter(|member| member.group == index);
            let centre = if count == all && !self.every_sample {
                middle
            } else {
                members().map(|member| member.position).sum::<DVec2>() / f64::from(count)
            };
            let nearest = members().min_by(|a, b| {
                let distance = |member: &Member| member.position.distance_squared(centre);
                distance(a).total_cmp(&distance(b))
            });
            if let Some(&Member { position, facet, .. }) = nearest {
                regions.push(self.region(&tile.facets[facet as usize], surface.front, centre, position));
                let Some(region) = regions.last_mut() else { continue };
                region.point.region = name.wrapping_add(index as u32);
                region.point.cells = if self.every_sample { Cells::ALL } else { cells };
                if !self.points {
                    region.texture = self.texture(members(), count, &tile.facets);
                }
                region.share = count as f32 / all as f32;
                region.pixel = pixel;
            }
        }
    }

    /// The mean of the texture and the corners' colours over the `count` samples of a group: a pixel may see many texels.
    fn texture<'m>(&self, members: impl Iterator<Item = &'m Member>, count: u32, facets: &[Facet]) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for member in members {
            let facet = &facets[member.facet as usize];
            // They are of one object: all are plain or none.
            if self.soup.is_plain(facet.triangle) {
                return Vec3::ONE;
            }
            let at = self.view.world_at(member.position, facet.plane.at(member.position));
            sum += self.soup.colour(facet.triangle, at);
        }
        sum / count as f32
    }

    /// The region around `centre` (sample space) on a facet's plane; `sample` is where that facet was surely hit.
    fn region(&self, facet: &Facet, front: bool, centre: DVec2, sample: DVec2) -> Region {
        let hit = facet.plane.at(sample);
        let spread = if self.view.is_perspective() { 0.5 * hit.abs() } else { f64::INFINITY };
        let extrapolated = facet.plane.at(centre);
        let (centre, key) = if (extrapolated - hit).abs() <= spread { (centre, extrapolated) } else { (sample, hit) };
        let position = self.view.world_at(centre, key);
        let (triangle, normals) = self.soup.corners(facet.triangle);
        let side = if front { 1.0 } else { -1.0 };
        let [a, b, c] = triangle;
        let normal = (b - a).cross(c - a).normalize_or(DVec3::Z) * side;
        let point = SurfacePoint { object: facet.object, ..SurfacePoint::at(position, normal.as_vec3()) };
        let zeta = if self.view.is_perspective() { -1.0 / key } else { key } as f32;
        let region = Region { point, shading_normal: point.normal, texture: Vec3::ONE, share: 0.0, pixel: 0, zeta };
        if self.points {
            return region;
        }
        Region {
            point: point.with_corners(self.corners(facet, centre, key)),
            shading_normal: interpolate(position, triangle, normals) * side as f32,
            ..region
        }
    }

    /// The corners of the pixel about a place on a facet's plane (sample space) that has the depth `key`.
    fn corners(&self, facet: &Facet, centre: DVec2, key: f64) -> [DVec3; 4] {
        let reach = if self.view.is_perspective() { 0.75 * key.abs() } else { f64::INFINITY };
        let half = f64::from(self.axis) * 0.5;
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
            let corner = centre + DVec2::new(x, y) * half;
            self.view.world_at(corner, facet.plane.at(corner).clamp(key - reach, key + reach))
        })
    }
}

/// What the samples of a tile see.
struct Tile {
    /// Its upper left sample.
    origin: IVec2,
    samples: Vec<Sample>,
    facets: Vec<Facet>,
    /// What each facet is part of.
    surfaces: Vec<Surface>,
}

/// Room for one pixel after another.
#[derive(Default)]
struct Room {
    groups: Vec<Group>,
    members: Vec<Member>,
}

/// Samples of a pixel that are shaded together.
struct Group {
    surface: Surface,
    /// Where in the pixel they are.
    cells: Cells,
    /// How many they are.
    count: u32,
}

/// A sample of a group: where it is, and the facet that it sees.
struct Member {
    group: usize,
    position: DVec2,
    facet: u32,
}

/// What samples have in common that are shaded together.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Surface {
    object: u32,
    piece: u32,
    front: bool,
}

impl Surface {
    fn of(soup: &Soup, facet: &Facet) -> Self {
        Self { object: facet.object, piece: soup.surface(facet.triangle), front: facet.facing == Facing::Front }
    }
}

/// The shading normal at a point of a triangle's plane; barycentric weights are clamped to the triangle.
fn interpolate(at: DVec3, triangle: [DVec3; 3], [a, b, c]: [Vec3; 3]) -> Vec3 {
    let Some(weights) = weights(at, triangle) else { return a };
    (a.as_dvec3() * weights.x + b.as_dvec3() * weights.y + c.as_dvec3() * weights.z).as_vec3().normalize_or(a)
}
