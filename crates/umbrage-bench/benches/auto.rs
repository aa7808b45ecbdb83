//! The default beside the papers' methods, over every light of the gallery: look-ups beside those of `woo92`, bakes beside a second-depth map's.
//!
//! A table instead of criterion's groups: what is promised is a ratio over many scenes. Each number is a median of five; look-ups are of the
//! points that the scene's camera sees at 512 × 512, maps have 512 × 512 texels. Run it with `RAYON_NUM_THREADS=1` to compare one thread with one.
use glam::UVec2;
use std::hint::black_box;
use std::sync::Mutex;
use std::time::Instant;
use umbrage_depth::Storage;
use umbrage_plane::SurfacePoint;
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, light_shadow, picture};
use umbrage_sample::Key;
use umbrage_scene::gallery;
use umbrage_shadow::Shadow;

const TIMES: usize = 5;

/// Keeps the points that it is given.
struct Seen(Mutex<Vec<SurfacePoint>>);

impl Shadow for Seen {
    fn fractions(&self, points: &[SurfacePoint], _: Key, out: &mut [f32]) {
        out.fill(0.0);
        self.0.lock().expect("no panic elsewhere").extend_from_slice(points);
    }
}

/// Median seconds of two ways to do something, in turn.
fn seconds(mut ways: [&mut dyn FnMut(); 2]) -> [f64; 2] {
    let mut taken = [[0.0; TIMES]; 2];
    for time in 0..TIMES {
        for (way, taken) in ways.iter_mut().zip(&mut taken) {
            let start = Instant::now();
            way();
            taken[time] = start.elapsed().as_secs_f64();
        }
    }
    taken.map(|mut taken| {
        taken.sort_by(f64::total_cmp);
        taken[TIMES / 2]
    })
}

fn main() {
    let recipe = |text: &str| text.parse::<Recipe>().expect("a recipe");
    let (woo, second, auto) = (recipe("woo92"), recipe("wang-molnar94"), recipe("auto"));
    println!("scene               woo92    auto  ratio      second    auto  ratio");
    println!("                    ns per look-up                ms per bake");
    let (mut ratios, mut sums, mut lights) = ([0.0; 2], [[0.0; 2]; 2], 0.0);
    for (name, make) in gallery::ALL {
        let scene = make();
        for light in scene.lights.iter().filter(|light| light.casts) {
            let mut one = scene.clone();
            one.camera = one.camera.with_size(UVec2::splat(512)).expect("a valid size");
            one.lights = vec![light.clone()];
            let view = light.view.with_size(UVec2::splat(512)).expect("a valid size");
            let seen = Seen(Mutex::default());
            picture(&one, &[&seen], &Frame::CENTRES);
            let points = seen.0.into_inner().expect("no panic elsewhere");
            let made = |recipe: &Recipe| light_shadow(recipe, &[&one], &view, Storage::Tiled).expect("a shadow");
            let shadows = [&woo, &auto].map(made);
            let [mut a, mut b] = shadows.each_ref().map(|made| {
                let (points, mut out) = (&points, vec![0.0; points.len()]);
                move || made.shadow.fractions(black_box(points), Key::new(1, 0, 0), &mut out)
            });
            let look = seconds([&mut a, &mut b]).map(|seconds| seconds * 1e9 / points.len() as f64);
            let bake = seconds([&mut || drop(black_box(made(&second))), &mut || drop(black_box(made(&auto)))]);
            let bake = bake.map(|seconds| seconds * 1e3);
            for (k, [than, own]) in [look, bake].into_iter().enumerate() {
                ratios[k] += own / than;
                sums[k] = [sums[k][0] + than, sums[k][1] + own];
            }
            lights += 1.0;
            let [[a, b], [c, d]] = [look, bake];
            println!("{name:18}{a:7.0} {b:7.0}  {:5.2}     {c:7.2} {d:7.2}  {:5.2}", b / a, d / c);
        }
    }
    for (what, (ratio, [than, own])) in ["look-ups", "bakes"].into_iter().zip(ratios.into_iter().zip(sums)) {
        println!("{what}: mean of ratios {:.2}, ratio of means {:.2}", ratio / lights, own / than);
    }
}
