use crate::Soup;
use crate::weights::weights;
use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use umbrage_bake::Masks;
use umbrage_plane::{Cells, Facet, Facing, SurfacePoint, View};
use umbrage_raster::{BIN, Bins, each_fragment};

/// A piece of one surface within one pixel: what is shaded once (Reeves 1987). Its point stands beside it.
pub(crate) struct Region {
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
    /// Where each region is and how large; its normal is the geometric one on the visible side.
    pub points: Vec<SurfacePoint>,
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
        let (across, picture) = (BIN / self.axis, self.view.size() / self.axis);
        let pixel = |pixel: u32| {
            let corner = UVec2::new(pixel % across, pixel / across) * self.axis;
            let place = (origin.as_uvec2() + corner) / self.axis;
            let index = place.y * self.width + place.x;
            let drawn = place.cmplt(picture).all() && wanted(index);
            drawn.then_some(InTile { corner, pixel, name: index.wrapping_mul(64) })
        };
        let pixels: Vec<InTile> = (0..across * across).filter_map(pixel).collect();
        let mut gathered = Gathered { regions: Vec::new(), points: Vec::new(), fragments: 0, passing: 0 };
        if pixels.is_empty() {
            return gathered;
        }
        let mut facets: Vec<Facet> = Vec::new();
        let mut samples = vec![NONE; (BIN * BIN) as usize];
        // What is nearer than the camera's near plane is not seen.
        let nearest = self.view.key(self.view.near()) as f32;
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
            // Where each sample is a region by itself, samples need not be grouped by what they share.
            let surface = |facet| Surface::of(self.soup, facet);
            let surfaces = if self.every_sample { Vec::new() } else { facets.iter().map(surface).collect() };
            let tile = Tile { origin, samples, facets, surfaces };
            let mut room = Room::default();
            let least = if self.every_sample { self.axis * self.axis } else { 1 };
            gathered.regions.reserve(pixels.len() * least as usize);
            gathered.points.reserve(pixels.len() * least as usize);
            for pixel in &pixels {
                if self.every_sample {
                    self.samples(&tile, pixel, &mut room, &mut gathered);
                } else {
                    self.groups(&tile, pixel, &mut room, &mut gathered);
                }
            }
        }
        gathered
    }

    /// The samples of a pixel, each with the facet that it sees and its place in the pixel and in sample space.
    fn seen(&self, tile: &Tile, corner: UVec2) -> impl Iterator<Item = (u32, UVec2, DVec2)> {
        (0..self.axis * self.axis).filter_map(move |i| {
            let cell = UVec2::new(i % self.axis, i / self.axis);
            let at = corner + cell;
            let facet = tile.samples[(at.y * BIN + at.x) as usize].facet;
            let place = || self.view.sampling().position(tile.origin + at.as_ivec2());
            (facet != NONE.facet).then(|| (facet, cell, place()))
        })
    }

    /// Each sample of a pixel as a region.
    fn samples(&self, tile: &Tile, pixel: &InTile, room: &mut Room, gathered: &mut Gathered) {
        let share = 1.0 / (self.axis * self.axis) as f32;
        for (index, (facet, _, position)) in self.seen(tile, pixel.corner).enumerate() {
            let (mut region, mut point) = self.region(tile, facet, room, position, position);
            if !self.points {
                region.texture = self.texture(std::iter::once((facet, position)), 1, &tile.facets);
            }
            (point.region, point.cells) = (pixel.name.wrapping_add(index as u32), Cells::ALL);
            (region.share, region.pixel) = (share, pixel.pixel);
            gathered.regions.push(region);
            gathered.points.push(point);
        }
    }

    /// Each surface that a pixel sees as a region.
    fn groups(&self, tile: &Tile, pixel: &InTile, room: &mut Room, gathered: &mut Gathered) {
        let (mut groups, mut members) = (std::mem::take(&mut room.groups), std::mem::take(&mut room.members));
        groups.clear();
        members.clear();
        for (facet, cell, position) in self.seen(tile, pixel.corner) {
            let surface = tile.surfaces[facet as usize];
            let group = groups.iter().position(|group| group.surface == surface).unwrap_or_else(|| {
                groups.push(Group { surface, cells: Cells::NONE, count: 0 });
                groups.len() - 1
            });
            groups[group].cells = groups[group].cells.with(cell.x, cell.y, self.axis);
            groups[group].count += 1;
            members.push(Member { group, position, facet });
        }
        let middle = (tile.origin.as_dvec2() + pixel.corner.as_dvec2()) + f64::from(self.axis) * 0.5;
        let all = self.axis * self.axis;
        for (index, &Group { cells, count, .. }) in groups.iter().enumerate() {
            let members = || members.iter().filter(|member| member.group == index);
            let centre = if count == all {
                middle
            } else {
                members().map(|member| member.position).sum::<DVec2>() / f64::from(count)
            };
            let nearest = members().min_by(|a, b| {
                let distance = |member: &Member| member.position.distance_squared(centre);
                distance(a).total_cmp(&distance(b))
            });
            let Some(&Member { position, facet, .. }) = nearest else { continue };
            let (mut region, mut point) = self.region(tile, facet, room, centre, position);
            if !self.points {
                let members = members().map(|member| (member.facet, member.position));
                region.texture = self.texture(members, count, &tile.facets);
            }
            (point.region, point.cells) = (pixel.name.wrapping_add(index as u32), cells);
            (region.share, region.pixel) = (count as f32 / all as f32, pixel.pixel);
            gathered.regions.push(region);
            gathered.points.push(point);
        }
        (room.groups, room.members) = (groups, members);
    }

    /// The mean of the texture and the corners' colours over the `count` samples of a group: a pixel may see many texels.
    fn texture(&self, members: impl Iterator<Item = (u32, DVec2)>, count: u32, facets: &[Facet]) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for (facet, position) in members {
            let facet = &facets[facet as usize];
            // They are of one object: all are plain or none.
            if self.soup.is_plain(facet.triangle) {
                return Vec3::ONE;
            }
            let at = self.view.world_at(position, facet.plane.at(position));
            sum += self.soup.colour(facet.triangle, at);
        }
        sum / count as f32
    }

    /// The region around `centre` (sample space) on a facet's plane; `sample` is where that facet was surely hit.
    fn region(&self, tile: &Tile, facet: u32, room: &mut Room, centre: DVec2, sample: DVec2) -> (Region, SurfacePoint) {
        let index = facet;
        let facet = &tile.facets[index as usize];
        room.side.take_if(|(known, _)| *known != index);
        let (_, side) = room.side.get_or_insert_with(|| (index, Side::of(self.soup, facet)));
        let hit = facet.plane.at(sample);
        let spread = if self.view.is_perspective() { 0.5 * hit.abs() } else { f64::INFINITY };
        let extrapolated = facet.plane.at(centre);
        let (centre, key) = if (extrapolated - hit).abs() <= spread { (centre, extrapolated) } else { (sample, hit) };
        let position = self.view.world_at(centre, key);
        let &mut Side { ref triangle, ref normals, normal, sign } = side;
        let point = SurfacePoint { object: facet.object, ..SurfacePoint::at(position, normal) };
        let zeta = if self.view.is_perspective() { -1.0 / key } else { key } as f32;
        let region = Region { shading_normal: normal, texture: Vec3::ONE, share: 0.0, pixel: 0, zeta };
        if self.points {
            return (region, point);
        }
        let shading_normal = interpolate(position, *triangle, *normals) * sign;
        (Region { shading_normal, ..region }, point.with_corners(self.corners(facet, centre, key)))
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
    /// What each facet is part of, where samples are grouped by it.
    surfaces: Vec<Surface>,
}

/// A pixel of a tile.
struct InTile {
    /// Its upper left sample, from the tile's.
    corner: UVec2,
    /// Its index within the tile.
    pixel: u32,
    /// What its regions are numbered from.
    name: u32,
}

/// Room for one pixel after another.
#[derive(Default)]
struct Room {
    groups: Vec<Group>,
    members: Vec<Member>,
    /// The facet that was seen last: it is often that of the next sample, too.
    side: Option<(u32, Side)>,
}

/// The side of a facet that is seen.
#[derive(Clone, Copy)]
struct Side {
    /// The triangle's corners in world space, and their shading normals.
    triangle: [DVec3; 3],
    normals: [Vec3; 3],
    /// The geometric normal on this side.
    normal: Vec3,
    /// 1 in front, where normals are the mesh's own, −1 behind.
    sign: f32,
}

impl Side {
    fn of(soup: &Soup, facet: &Facet) -> Self {
        let (triangle, normals) = soup.corners(facet.triangle);
        let sign = if facet.facing == Facing::Front { 1.0 } else { -1.0 };
        let [a, b, c] = triangle;
        let normal = ((b - a).cross(c - a).normalize_or(DVec3::Z) * sign).as_vec3();
        Self { triangle, normals, normal, sign: sign as f32 }
    }
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
