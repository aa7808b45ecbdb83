//! Every pattern once more, one tap at a time and without thought of speed. The kernels must agree bit for bit.

use glam::Vec2;
use umbrage_plane::Footprint;
use umbrage_sample::{
    AreaTent, Castano, Centre, Density, Disc, EveryTexel, Gaussian, InsideQuadReject, InsideQuadWarp, Jittered, Key,
    Pattern, Spiral, Table, Tap, Tent, Uniform, Vogel,
};

/// A pattern that has a naive twin.
pub trait Twin: Pattern {
    /// Index and tap, of those that take part.
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)>;
}

fn corners(region: &Footprint) -> (Vec2, Vec2) {
    let half = Vec2::new(region.half.x.max(0.0), region.half.y.max(0.0));
    (region.centre - half, region.centre + half)
}

fn tap(region: &Footprint, key: Key, index: u32, at: Vec2) -> (u32, Tap) {
    let (low, high) = corners(region);
    let at = Vec2::new(at.x.max(low.x).min(high.x), at.y.max(low.y).min(high.y));
    (index, Tap { at, u: key.unit(index, 2), weight: 1.0 })
}

impl Twin for Centre {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        vec![tap(region, key, 0, region.centre)]
    }
}

impl Twin for EveryTexel {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        let (low, high) = corners(region);
        let along = |low: f32, high: f32, centre: f32| {
            let around = low.floor() as i32 - 2..=high.floor() as i32 + 2;
            let inside: Vec<f32> = around.map(|i| i as f32 + 0.5).filter(|&x| low <= x && x < high).collect();
            if inside.is_empty() { vec![centre.floor() + 0.5] } else { inside }
        };
        let (columns, rows) = (along(low.x, high.x, region.centre.x), along(low.y, high.y, region.centre.y));
        let positions = rows.iter().flat_map(|&y| columns.iter().map(move |&x| Vec2::new(x, y)));
        positions.zip(0..).map(|(at, index)| tap(region, key, index, at)).collect()
    }
}

/// Every texel with the product of its weights along both axes: `side` of the distance from the centre and the half-extent.
fn weighed(region: &Footprint, key: Key, side: impl Fn(f32, f32) -> f32) -> Vec<(u32, Tap)> {
    let along = |at: f32, centre: f32, half: f32| if half > 0.5 { side((at - centre).abs(), half) } else { 1.0 };
    let weighed = |(index, tap): (u32, Tap)| {
        let weight = along(tap.at.x, region.centre.x, region.half.x) * along(tap.at.y, region.centre.y, region.half.y);
        (index, Tap { weight, ..tap })
    };
    EveryTexel.naive(region, key).into_iter().map(weighed).collect()
}

impl Twin for Tent {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        weighed(region, key, |away, half| (-(away / half) + 1.0).max(0.0))
    }
}

impl Twin for Castano {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        let ramp = |t: f32, end: f32| (-t + end).max(0.0);
        weighed(region, key, |away, half| {
            if *self == Self::Five {
                let t = away * (3.0 / half);
                ramp(t, 3.0) + ramp(t, 2.0) - ramp(t, 1.0)
            } else {
                let t = away * (4.0 / half);
                (ramp(t, 3.0) + ramp(t, 2.0) - ramp(t, 1.0)) * 3.0 + ramp(t, 4.0)
            }
        })
    }
}

impl Twin for AreaTent {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        weighed(region, key, |away, half| {
            let foot = half - 0.5;
            let area = |place: f32| {
                let place = place.max(-foot).min(foot);
                (place.abs() * -0.5 + foot) * place
            };
            (area(away + 0.5) - area(away - 0.5)).max(0.0)
        })
    }
}

impl Twin for Vogel {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        let n = self.num_samples;
        let start = if self.rotate { key.unit(0, 0) } else { 0.0 };
        let reach = Vec2::new((region.half.x - 1.0).max(0.0), (region.half.y - 1.0).max(0.0));
        let four = |k: u32| {
            let radius = ((k as f32 + 0.5) / n as f32).sqrt();
            let at = radius * turned(k as f32 * 0.381_966 + start) * reach + region.centre;
            let first = (at - 0.5).floor();
            let share = at - 0.5 - first;
            [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(right, below)| {
                let weight = |share: f32, beyond: f32| if beyond == 1.0 { share } else { -share + 1.0 };
                (first + Vec2::new(right, below) + 0.5, weight(share.x, right) * weight(share.y, below))
            })
        };
        let all = (0..n).flat_map(four).zip(0..);
        all.map(|((at, weight), index)| (index, Tap { weight, ..tap(region, key, index, at).1 })).collect()
    }
}

impl Twin for Spiral {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        let n = self.num_samples;
        let start = if self.rotate { key.unit(0, 0) } else { 0.0 };
        let at = |k: u32| {
            let radius = match self.density {
                Density::Uniform => ((k as f32 + 0.5) / n as f32).sqrt(),
                Density::Centred => k as f32 / n as f32,
            };
            radius * turned(k as f32 * 0.381_966 + start) * region.half + region.centre
        };
        (0..n).map(|k| tap(region, key, k, at(k))).collect()
    }
}

impl Twin for Uniform {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        let (low, high) = corners(region);
        let at = |k| Vec2::new(key.unit(k, 0), key.unit(k, 1)) * (high - low) + low;
        (0..self.num_samples).map(|k| tap(region, key, k, at(k))).collect()
    }
}

impl Twin for Gaussian {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        let deviate = |unit: f32| {
            let v = unit * 2.0 - 1.0;
            let t = v * v;
            let above = ((t * -0.085_932_486 + 0.886_458) * t - 1.944_997_5) * t + 1.196_290_9;
            let below = ((t * -0.175_305_12 + 1.065_494_3) * t - 1.864_279_6) * t + 1.0;
            v * (above / below)
        };
        let at = |k| Vec2::new(deviate(key.unit(k, 0)), deviate(key.unit(k, 1))) * (region.half * 0.5) + region.centre;
        (0..self.num_samples).map(|k| tap(region, key, k, at(k))).collect()
    }
}

/// R87-13 step 4 word for word.
pub fn counts(pattern: &Jittered, half: Vec2) -> (u32, u32) {
    let (a, b) = (half.x, half.y);
    let (n, m) = (pattern.num_samples as f32, pattern.min_samples as f32);
    let (ns, nt) = if a == 0.0 && b == 0.0 {
        return (1, 1);
    } else if 4.0 * a * b < n {
        ((2.0 * a + 0.5).floor().clamp(m, n), (2.0 * b + 0.5).floor().clamp(m, n))
    } else {
        let enough = |k: &u32| b * n >= (*k as f32 - 0.5) * (*k as f32 - 0.5) * a;
        let nt = ((1..=10_000).filter(enough).count() as f32).clamp(m, n);
        ((n / nt + 0.5).floor().clamp(m, n), nt)
    };
    let (ns, nt) = (ns as u32, nt as u32);
    if pattern.hard_cap && ns * nt > pattern.num_samples {
        if ns > nt { (pattern.num_samples / nt, nt) } else { (ns, pattern.num_samples / ns) }
    } else {
        (ns, nt)
    }
}

fn cells(pattern: &Jittered, (ns, nt): (u32, u32), key: Key) -> impl Iterator<Item = (u32, Vec2)> {
    let jitter = pattern.jitter;
    let places = (0..nt).flat_map(move |j| (0..ns).map(move |i| Vec2::new(i as f32, j as f32)));
    (0..).zip(places).map(move |(k, cell)| (k, cell + 0.5 + (Vec2::new(key.unit(k, 0), key.unit(k, 1)) - 0.5) * jitter))
}

impl Twin for Jittered {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        let (low, high) = corners(region);
        let (ns, nt) = counts(self, region.half);
        let size = (high - low) / Vec2::new(ns as f32, nt as f32);
        cells(self, (ns, nt), key).map(|(k, place)| tap(region, key, k, place * size + low)).collect()
    }
}

impl Twin for Table {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        let (low, high) = corners(region);
        let (ns, nt) = counts(&self.0, region.half);
        let size = (high - low) / Vec2::new(ns as f32, nt as f32);
        let drawn = |k: u32, dim: u32| {
            let hash = key.bits(k / 16 * 16, 0);
            let stored = Key::new(0, 0, 0).bits(hash % 64 * 16 + k % 16, dim);
            let moved = stored.wrapping_add(hash.wrapping_mul([1, 0x9E37_79B9, 0x85EB_CA6B][dim as usize]));
            (moved >> 8) as f32 * 0.5f32.powi(24)
        };
        let place = |k: u32| {
            let cell = Vec2::new((k % ns) as f32, (k / ns) as f32);
            cell + 0.5 + (Vec2::new(drawn(k, 0), drawn(k, 1)) - 0.5) * self.0.jitter
        };
        let at = |k: u32| {
            let (k, tap) = tap(region, key, k, place(k) * size + low);
            (k, Tap { u: drawn(k, 2), ..tap })
        };
        (0..ns * nt).map(at).collect()
    }
}

/// The sign of the area, of convex quadrilaterals.
fn side([a, b, c, d]: [Vec2; 4]) -> Option<f32> {
    let area = (c - a).perp_dot(d - b);
    let turn = |p: Vec2, q: Vec2, r: Vec2| (q - p).perp_dot(r - q) * area.signum();
    let convex = turn(a, b, c) >= 0.0 && turn(b, c, d) >= 0.0 && turn(c, d, a) >= 0.0 && turn(d, a, b) >= 0.0;
    (convex && area != 0.0).then_some(area.signum())
}

impl Twin for InsideQuadReject {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        let all = self.0.naive(region, key);
        let Some(side) = side(region.corners) else { return all };
        let behind_no_edge = |at: Vec2| {
            (0..4).all(|k| {
                let edge = region.corners[(k + 1) % 4] - region.corners[k];
                let inward = Vec2::new(-edge.y, edge.x) * side;
                let from = at - region.corners[k];
                from.x * inward.x + from.y * inward.y >= 0.0
            })
        };
        let last = all.len() as u32;
        let inside: Vec<_> = all.into_iter().filter(|(_, tap)| behind_no_edge(tap.at)).collect();
        if !inside.is_empty() {
            return inside;
        }
        let [a, b, c, d] = region.corners;
        let [a, b, c, d] = [a, b, c, d].map(glam::DVec2::from);
        let (first, second) = ((b - a).perp_dot(c - a), (c - a).perp_dot(d - a));
        let middle = (a + c + (b * first + d * second) / (first + second)) * (1.0 / 3.0);
        vec![tap(region, key, last.next_multiple_of(16), middle.as_vec2())]
    }
}

impl Twin for InsideQuadWarp {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        if side(region.corners).is_none() {
            return self.0.naive(region, key);
        }
        let [a, b, c, d] = region.corners;
        let (across, down, twist) = (b - a, d - a, a - b + c - d);
        let jacobian = [across.perp_dot(down), across.perp_dot(twist), twist.perp_dot(down)];
        let mean = jacobian[0] + 0.5 * (jacobian[1] + jacobian[2]);
        let [j0, js, jt] = jacobian.map(|term| term / mean);
        let half = 0.5 * Vec2::new((across + 0.5 * twist).length(), (down + 0.5 * twist).length());
        let (ns, nt) = counts(&self.0, half);
        let size = 1.0 / Vec2::new(ns as f32, nt as f32);
        let warped = |(k, place): (u32, Vec2)| {
            let Vec2 { x: s, y: t } = place * size;
            let at = s * (t * twist + across) + t * down + a;
            let weight = (s * js + t * jt + j0).max(0.0);
            let (k, tap) = tap(region, key, k, at);
            (k, Tap { weight, ..tap })
        };
        cells(&self.0, (ns, nt), key).map(warped).collect()
    }
}

/// Cosine and sine by the kernel's polynomials.
fn turned(turns: f32) -> Vec2 {
    let quarters = (turns * 4.0 + 0.5).floor();
    let angle = (turns - quarters * 0.25) * std::f32::consts::TAU;
    let t = angle * angle;
    let sin = (((t * (1.0 / 362_880.0) - 1.0 / 5_040.0) * t + 1.0 / 120.0) * t - 1.0 / 6.0) * t * angle + angle;
    let cos = (((t * (1.0 / 40_320.0) - 1.0 / 720.0) * t + 1.0 / 24.0) * t - 0.5) * t + 1.0;
    match quarters as u32 % 4 {
        0 => Vec2::new(cos, sin),
        1 => Vec2::new(-sin, cos),
        2 => Vec2::new(-cos, -sin),
        _ => Vec2::new(sin, -cos),
    }
}

impl Twin for Disc {
    fn naive(&self, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
        let n = self.num_samples as f32;
        let start = if self.rotate { key.unit(0, 0) } else { 0.0 };
        let mirrored = |i: u32| (0..24).map(|bit| (i >> bit & 1) as f32 * 0.5f32.powi(bit + 1)).sum::<f32>();
        let at = |i: u32| {
            let y = mirrored(i) + if self.half_offset { 0.5 / n } else { 0.0 };
            let radius = if self.density == Density::Uniform { y.sqrt() } else { y };
            radius * turned(i as f32 / n + start) * region.half + region.centre
        };
        (0..self.num_samples).map(|i| tap(region, key, i, at(i))).collect()
    }
}
