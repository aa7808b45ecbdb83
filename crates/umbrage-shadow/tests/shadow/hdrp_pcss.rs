//! Soft shadows as Unity's HDRP has them, held against its shaders and what their numbers are made of, in their own terms: reversed depth from 0 to 1, an atlas of
//! 4096 texels, fractions of it.

use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_depth::Raw;
use umbrage_plane::{Bias, Kind, Receiver, SurfacePoint, View, mix32};
use umbrage_sample::Key;
use umbrage_shadow::{Biased, HdrpPcss, ShadowMap};

const KEY: Key = Key::new(21, 0, 0);
const ATLAS: f64 = 4096.0;

/// A light's map as the shaders see it.
struct Light {
    view: View,
    raw: Raw,
}

impl Light {
    /// Axial depths by texel; +∞ where nothing is.
    fn new(view: &View, depth: impl Fn(u32, u32) -> f64) -> Self {
        let size = view.size();
        let texels = (0..size.element_product()).map(|i| depth(i % size.x, i / size.x));
        let stored = texels.map(|zeta| match view.kind() {
            Kind::Screen if zeta < f64::INFINITY => view.key(zeta) as f32,
            _ => zeta as f32,
        });
        Self { view: *view, raw: Raw::new(*view, stored.collect()).unwrap() }
    }

    /// Depth from 1 at the near plane to 0 at the far one.
    fn device(&self, zeta: f64) -> f64 {
        let (n, f) = (self.view.near(), self.view.far());
        if zeta == f64::INFINITY {
            0.0
        } else if self.view.is_perspective() {
            n * (f - zeta) / (zeta * (f - n))
        } else {
            (f - zeta) / (f - n)
        }
    }

    /// The texel of the atlas, whose first texels are the map.
    fn texel(&self, x: f64, y: f64) -> f64 {
        let last = self.view.size().as_dvec2() - 1.0;
        let at = DVec2::new(x, y).floor().clamp(DVec2::ZERO, last).as_uvec2();
        let stored = self.raw.depths()[(at.y * self.view.size().x + at.x) as usize];
        let zeta = match self.view.kind() {
            Kind::Screen if stored < f32::INFINITY => {
                let (n, f, s) = (self.view.near(), self.view.far(), f64::from(stored));
                if self.view.is_perspective() { f * n / (f - s * (f - n)) } else { n + s * (f - n) }
            }
            _ => f64::from(stored),
        };
        self.device(zeta)
    }

    /// `SAMPLE_TEXTURE2D_LOD` by the point sampler.
    fn point(&self, uv: DVec2) -> f64 {
        self.texel(uv.x * ATLAS, uv.y * ATLAS)
    }

    /// `SAMPLE_TEXTURE2D_SHADOW` by the linear comparison sampler: 1 is light.
    fn compared(&self, uv: DVec2, z: f64) -> f64 {
        let at = uv * ATLAS - 0.5;
        let (corner, share) = (at.floor(), at - at.floor());
        let lit = |x: f64, y: f64| f64::from(u8::from(z >= self.texel(corner.x + x, corner.y + y)));
        let [above, below] = [0.0, 1.0].map(|y| lit(0.0, y) * (1.0 - share.x) + lit(1.0, y) * share.x);
        above * (1.0 - share.y) + below * share.y
    }

    /// Texels of the map as fractions of the atlas.
    fn scale(&self) -> f64 {
        f64::from(self.view.size().x) / ATLAS
    }
}

/// `fibonacciSpiralDirection` by the recipe that is printed above it.
fn direction(i: u32) -> DVec2 {
    let turns = f64::from(i) * (std::f64::consts::PI * (3.0 - 5.0f64.sqrt()) / std::f64::consts::TAU);
    DVec2::from_angle((turns - turns.floor()) * std::f64::consts::TAU)
}

/// `SampleShadow_PCSS` with what `GetNonDirectionalSoftness` gives for a shape radius. `at` is in texels of the map.
fn lamp(light: &Light, shape_radius: f64, at: DVec2, zeta: f64, (search, filter): (u32, u32)) -> f64 {
    let x = shape_radius;
    let resolution = f64::from(light.view.size().x);
    let fitted = 0.024_034_61 + 3.452_916 * x - 1.362_672 * x * x + 0.670_011_5 * x.powi(3) + 0.215_947_4 * x.powi(4);
    let mut softness = fitted / 100.0 * (resolution / 512.0);
    let most = 0.04 * (resolution / 512.0);
    let (coord, z) = (at / ATLAS, light.device(zeta));
    let sample = |i: u32, n: u32, radius: f64| {
        direction(i) * (radius * (f64::from(i) / f64::from(n) + 0.5 / f64::from(n)).sqrt())
    };
    let area = (softness + 0.000_001).min(most);
    let blockers: Vec<f64> =
        (0..search).map(|i| light.point(coord + sample(i, search, area))).filter(|depth| *depth > z).collect();
    let average = if blockers.is_empty() { 0.0 } else { blockers.iter().sum::<f64>() / blockers.len() as f64 };
    let (n, f) = (light.view.near(), light.view.far());
    let dist = (1.0 / ((f - n) / (n * f) * average + 1.0 / f)).min(7.5);
    let scale = 3.298_300_241 - 2.001_364_639 * dist + 0.496_731_142_7 * dist.powi(2) - 0.054_640_584_55 * dist.powi(3)
        + 0.002_197_4 * dist.powi(4);
    softness = (softness * scale).min(most);
    let least = 0.1 * 0.001;
    let size = if blockers.is_empty() { least } else { (softness * ((z - average) / average).abs()).max(least) };
    (0..filter).map(|i| light.compared(coord + sample(i, filter, size), z)).sum::<f64>() / f64::from(filter)
}

/// `SampleShadow_PCSS_Directional` with what `SetDirectionalRequestSettings` gives for an angular diameter in degrees.
fn sun(light: &Light, diameter: f64, at: DVec2, zeta: f64, (search, filter): (u32, u32)) -> f64 {
    let tangent = |degrees: f64| (0.5 * degrees.to_radians()).tan();
    let range = light.view.far() - light.view.near();
    // m00 and m22 of the device projection.
    let (m00, m22) = (2.0 / (light.view.texel_world(zeta).x * f64::from(light.view.size().x)), 1.0 / range);
    let to_radial = m00 / m22;
    let depth_to_radial = tangent(diameter) * to_radial;
    let most_distance = 0.56 / (2.0 * tangent(diameter)) * m22;
    let least = 1.5 / f64::from(light.view.size().x);
    let cone = 1.0 / (tangent(diameter.max(12.0)) * to_radial);
    let (coord, z) = (at / ATLAS, light.device(zeta));
    let size = ((1.0 - z).min(most_distance) * depth_to_radial).max(least);
    let blockers: Vec<f64> = (0..search)
        .filter_map(|i| {
            let share = (f64::from(i) / f64::from(search)).powf(0.5 * 2.0);
            let blocker = light.point(coord + direction(i) * share * size * light.scale());
            (blocker > z + size * share * cone).then_some(blocker)
        })
        .collect();
    if blockers.is_empty() {
        return 1.0;
    }
    let average = blockers.iter().sum::<f64>() / blockers.len() as f64;
    let distance = ((average - z).abs() * 0.9).min(most_distance);
    let size = distance * depth_to_radial;
    let offset = (0.5 * m22).min(distance * 0.25);
    let sum: f64 = (0..filter)
        .map(|i| {
            let share = (f64::from(i) / f64::from(filter) + 0.5 / f64::from(filter)).sqrt();
            let uv = coord + direction(i) * share * size.max(least) * light.scale();
            light.compared(uv, z + (size * share * cone).min(offset))
        })
        .sum();
    sum / f64::from(filter)
}

/// A receiver that faces the light at a place of the map. Its footprint is wide, and must not count.
fn receiver(view: &View, at: DVec2, zeta: f64) -> Receiver {
    let world = view.world_at(at, view.key(zeta));
    let beside = |x: f64, y: f64| view.world_at(at + DVec2::new(x, y) * 5.0, view.key(zeta)).as_vec3();
    let corners = [beside(-1.0, -1.0), beside(1.0, -1.0), beside(1.0, 1.0), beside(-1.0, 1.0)];
    let point = SurfacePoint::at(world, (-view.ahead()).as_vec3()).with_corners(corners);
    view.receiver(&point).unwrap()
}

fn unit(seed: u32) -> f64 {
    f64::from(mix32(seed)) / 4_294_967_296.0
}

/// A map of patches at several heights over a floor, one in three of them a hole down to it.
fn patches(view: &View, floor: f64) -> Light {
    Light::new(view, |x, y| {
        let patch = mix32((x / 6) << 16 | (y / 5));
        if patch.is_multiple_of(3) { floor } else { floor * (0.25 + 0.7 * unit(patch)) }
    })
}

fn parallel(kind: Kind) -> View {
    let view = View::orthographic(DVec3::Y * 70.0, DVec3::ZERO, DVec3::NEG_Z, 2.0, 2.0, 90.0, UVec2::splat(96));
    view.unwrap().with_kind(kind)
}

fn spot(kind: Kind) -> View {
    let view = View::perspective(DVec3::Y * 9.0, DVec3::ZERO, DVec3::NEG_Z, 0.8, 0.5, 14.0, UVec2::splat(160));
    view.unwrap().with_kind(kind)
}

/// How often results are apart from the shader's, in 2000; and how often they are partly lit.
fn apart(light: &Light, filter: HdrpPcss, floor: f64, shader: impl Fn(DVec2) -> f64) -> (u32, u32) {
    let size = f64::from(light.view.size().x);
    let (mut apart, mut partly) = (0, 0);
    for i in 0..2000 {
        let at = DVec2::new(0.3 + 0.4 * unit(2 * i + 9), 0.3 + 0.4 * unit(2 * i + 10)) * size;
        let wanted = 1.0 - shader(at);
        let seen = receiver(&light.view, at, floor);
        let found = f64::from(ShadowMap { filter, map: &light.raw }.fraction_of(&seen, KEY));
        partly += u32::from(wanted > 0.0 && wanted < 1.0);
        // A sample that is just between two texels may read either: angles of dozens of turns are rounded to 10⁻⁵ radians, and there are up to 97 samples.
        apart += u32::from((found - wanted).abs() > 1e-3);
    }
    (apart, partly)
}

#[test]
fn parallel_light_is_filtered_as_by_the_shader() {
    for kind in [Kind::Axial, Kind::Screen] {
        for (diameter, counts) in [(0.5, (24, 16)), (0.2, (24, 16)), (3.0, (64, 33)), (15.0, (7, 1))] {
            let light = patches(&parallel(kind), 68.0);
            let filter = HdrpPcss::default().with_diameter(diameter as f32).with_rotate(false);
            let filter = filter.with_search(counts.0).with_blur(counts.1);
            // A little in front of the floor, which rounds.
            let zeta = 67.99;
            let (apart, partly) = apart(&light, filter, zeta, |at| sun(&light, diameter, at, zeta, counts));
            assert!(apart < 40 && partly > 300, "{kind:?}, {diameter}: {apart} apart, {partly} partly lit");
        }
    }
}

#[test]
fn a_lamp_is_filtered_as_by_the_shader() {
    for kind in [Kind::Axial, Kind::Screen] {
        for (radius, counts) in [(0.025, (24, 16)), (0.0, (24, 16)), (0.3, (64, 33)), (0.8, (7, 4))] {
            let light = patches(&spot(kind), 9.0);
            let filter = HdrpPcss::default().with_radius(radius as f32).with_rotate(false);
            let filter = filter.with_search(counts.0).with_blur(counts.1);
            let zeta = 8.99;
            let (apart, partly) = apart(&light, filter, zeta, |at| lamp(&light, radius, at, zeta, counts));
            assert!(apart < 40 && partly > 300, "{kind:?}, {radius}: {apart} apart, {partly} partly lit");
        }
    }
}

/// The shader's numbers once more where the answer is known: an edge whose penumbra is as wide as its formula says.
#[test]
fn a_penumbra_is_as_wide_as_twice_the_disc() {
    // A board 40 units above the floor, half of the map: 0.9 · 40 · 2 tan 0.25° = 0.314 units to each side, of texels of 4/96.
    let light = Light::new(&parallel(Kind::Axial), |x, _| if x < 48 { 28.0 } else { 68.0 });
    let filter = HdrpPcss::default().with_search(64).with_blur(64);
    let at = |x: f64| {
        let seen = receiver(&light.view, DVec2::new(48.0 + x, 48.0), 67.9);
        ShadowMap { filter, map: &light.raw }.fraction_of(&seen, KEY)
    };
    let radius = 0.9 * 39.9 * 2.0 * 0.25f64.to_radians().tan() * 96.0 / 4.0;
    assert!((7.0..8.0).contains(&radius));
    assert_eq!((at(-radius - 1.0), at(radius + 1.0)), (1.0, 0.0));
    assert!(at(-radius + 1.0) < 1.0 && at(radius - 1.0) > 0.0);
    assert!((at(0.0) - 0.5).abs() < 0.05, "{}", at(0.0));
}

#[test]
fn what_slopes_toward_the_sun_is_lit_up_to_its_cone_and_a_moved_receiver_is_found() {
    // A plane of a slope of 3 in the map, less than the cone's 4.76.
    let view = parallel(Kind::Axial);
    let texel = view.texel_world(50.0).x;
    let slope = |steep: f64| Light::new(&view, |x, _| 50.0 + steep * texel * (f64::from(x) + 0.5 - 48.0));
    for (steep, lit) in [(3.0, true), (9.0, false)] {
        let light = slope(steep);
        let at = DVec2::new(47.7, 48.2);
        let world = view.world_at(at, view.key(50.0 + steep * texel * (at.x - 48.0)));
        let seen = view.receiver(&SurfacePoint::at(world, Vec3::Y)).unwrap();
        // As far as the disc's own texels reach.
        let bias = |texels: f64| Biased::constant(Bias::World((texels * steep * texel) as f32));
        let dark = |filter: HdrpPcss| ShadowMap { filter, map: &light.raw }.fraction_of(&seen, KEY);
        let found = dark(HdrpPcss::default().with_depth(bias(1.0)));
        assert_eq!(found == 0.0, lit, "{steep}: {found}");
    }
}

#[test]
fn slope_biases_grow_with_what_a_lamp_s_map_makes_of_its_size() {
    let filter = HdrpPcss::default();
    let of = |size: u32| spot(Kind::Axial).with_size(UVec2::splat(size)).unwrap();
    assert_eq!((filter.slope_bias(&of(512)), filter.slope_bias(&of(4096))), (1.0, 1.0));
    // 0.00109516 · 16 = 0.0175226 is more than 0.01: 5 + 13 · 0.0175226 · 20.
    assert!((filter.slope_bias(&of(8192)) - 9.55588 / 5.0).abs() < 1e-4, "{}", filter.slope_bias(&of(8192)));
    assert_eq!(filter.with_radius(2.0).slope_bias(&of(4096)), 18.0 / 5.0);
    assert_eq!(filter.with_radius(2.0).slope_bias(&parallel(Kind::Axial)), 1.0);
}

#[test]
fn nothing_is_looked_up_farther_than_the_widest() {
    for (view, zetas) in [(parallel(Kind::Axial), [3.0, 30.0, 88.0]), (spot(Kind::Axial), [0.6, 3.0, 13.0])] {
        for zeta in zetas {
            for size in [0.0, 0.5, 2.0] {
                let filter = HdrpPcss::default().with_diameter(size).with_radius(size);
                let seen = receiver(&view, view.size().as_dvec2() * 0.5 + 0.3, zeta);
                let widest = filter.widest(&view, &seen).min(view.size().as_vec2() * 0.25);
                for near in [0.0, 0.3, 0.9, 0.999] {
                    let blocker = view.near() + (zeta - view.near()) * near;
                    // What is stored beyond the widest box changes nothing.
                    let light = |beyond: f64| {
                        Light::new(&view, |x, y| {
                            let away = (DVec2::new(f64::from(x), f64::from(y)) + 0.5 - seen.texel).abs().as_vec2();
                            let inside = away.cmple(widest + 0.5).all();
                            if !inside {
                                beyond
                            } else if x % 5 < 2 {
                                blocker
                            } else {
                                zeta + 1.0
                            }
                        })
                    };
                    let dark = |beyond: f64| ShadowMap { filter, map: light(beyond).raw }.fraction_of(&seen, KEY);
                    assert_eq!(dark(view.near()), dark(view.far()), "{zeta}, {size}, {near}");
                }
            }
        }
    }
}
