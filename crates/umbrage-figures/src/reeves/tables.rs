//! Reeves, Salesin & Cook 1987, Tables 1 and 2: what shadows cost in time and in memory.

use crate::figure::{Context, Figure, Paper};
use crate::stage::lights::Stage;
use glam::{DVec2, UVec2, Vec3};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;
use umbrage_depth::{Bbox, DepthMap, Map, Raw, Tiled};
use umbrage_plane::{SurfacePoint, TexelRect, View};
use umbrage_render::{Frame, bind_lights, light_map, light_maps, picture};
use umbrage_report::{Made, Measure, Panel, Role, Table};
use umbrage_sample::Key;
use umbrage_scene::Scene;
use umbrage_scene::gallery::{self, Make};
use umbrage_shadow::Shadow;

/// Our scene for each of the paper's four: its name here, the scene, casting lights, and from the paper the per cent of Table 1 and the
/// MB of Table 2 (raw, box, tiles).
struct Row {
    name: &'static str,
    scene: fn() -> Scene,
    casting: usize,
    percent: f64,
    megabytes: [f64; 3],
}

/// The sphere scenes of the paper leave the plane out of the maps.
fn without_slab(mut scene: Scene) -> Scene {
    for object in scene.objects.iter_mut().filter(|object| object.name == "slab") {
        object.casts = false;
    }
    scene
}

const ROWS: [Row; 4] = [
    Row {
        name: "sphere",
        scene: || without_slab(gallery::sphere_plane()),
        casting: 1,
        percent: 37.3,
        megabytes: [4.0, 0.4, 0.4],
    },
    Row {
        name: "coloured lights",
        scene: || without_slab(gallery::three_lights()),
        casting: 3,
        percent: 47.6,
        megabytes: [12.0, 2.6, 2.9],
    },
    Row { name: "desk lamps", scene: gallery::desk_lamps, casting: 3, percent: 50.9, megabytes: [24.0, 13.0, 3.7] },
    Row { name: "bicycle shop", scene: gallery::bicycle_shop, casting: 2, percent: 48.4, megabytes: [8.0, 5.6, 4.2] },
];

pub const T1: Figure = Figure {
    id: "R87-T1",
    paper: Paper::Reeves87,
    title: "Time, with and without shadows",
    claim: "Shadows add to the picture's time far less than one more picture per light.",
    look: "the measures: how much longer the picture takes with its shadows.",
    make: times,
};

/// Remembers the regions that are looked up in it.
#[derive(Default)]
struct Regions(Mutex<Vec<SurfacePoint>>);

impl Shadow for Regions {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        if let Ok(mut known) = self.0.lock() {
            known.extend_from_slice(at);
        }
        out.fill(0.0);
    }
}

/// A light's shadow that takes the time of its own look-ups.
struct Clocked<'a> {
    shadow: &'a dyn Shadow,
    nanoseconds: AtomicU64,
    receivers: AtomicU64,
}

impl<'a> Clocked<'a> {
    fn new(shadow: &'a dyn Shadow) -> Self {
        Self { shadow, nanoseconds: AtomicU64::new(0), receivers: AtomicU64::new(0) }
    }

    fn clock(&self, work: impl FnOnce()) {
        let start = Instant::now();
        work();
        let spent = u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX);
        self.nanoseconds.fetch_add(spent, Ordering::Relaxed);
    }
}

impl Shadow for Clocked<'_> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        self.clock(|| self.shadow.fractions(at, key, out));
        self.receivers.fetch_add(at.len() as u64, Ordering::Relaxed);
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        self.clock(|| self.shadow.transmittances(at, key, fractions, out));
    }
}

/// Pass 2 in seconds, and what of them was spent in look-ups: taken within the same picture, so that they are a part of it.
#[derive(Clone, Copy)]
struct Pass2 {
    whole: f64,
    look_ups: f64,
    /// Regions times casting lights.
    receivers: u64,
}

impl Pass2 {
    fn of(scene: &Scene, shadows: &[Box<dyn Shadow + '_>], casting: &[bool], frame: &Frame) -> Self {
        let clocked: Vec<Clocked> = shadows.iter().map(|shadow| Clocked::new(shadow.as_ref())).collect();
        let known: Vec<&dyn Shadow> = clocked.iter().map(|shadow| shadow as &dyn Shadow).collect();
        let whole = timed(|| picture(scene, &known, frame)).1;
        let (mut nanoseconds, mut receivers) = (0, 0);
        for (light, _) in clocked.iter().zip(casting).filter(|(_, casts)| **casts) {
            nanoseconds += light.nanoseconds.load(Ordering::Relaxed);
            receivers += light.receivers.load(Ordering::Relaxed);
        }
        Self { whole, look_ups: nanoseconds as f64 * 1e-9, receivers }
    }
}

/// Seconds of one scene on one thread.
struct Times {
    plain: f64,
    pass_1: f64,
    pass_2: Pass2,
    /// A region to a light's space, alone and with nothing else in the caches.
    transform: f64,
}

impl Times {
    fn total(&self) -> f64 {
        self.pass_1 + self.pass_2.whole
    }

    fn percent(&self) -> f64 {
        100.0 * (self.total() - self.plain) / self.plain
    }

    /// What the total is made of, in per cent: pass 1, look-ups, and the picture they are made for.
    ///
    /// Each is a time taken within the two passes. The picture without shadows is another run, whose noise would make any
    /// part that is the difference from it come out negative at times.
    fn breakdown(&self) -> [f64; 3] {
        let Pass2 { whole, look_ups, .. } = self.pass_2;
        [self.pass_1, look_ups, whole - look_ups].map(|part| 100.0 * part / self.total())
    }
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let done = work();
    (done, start.elapsed().as_secs_f64())
}

/// What is measured, by its seconds the better of two where it is measured `again`.
fn better<T>(again: bool, seconds: impl Fn(&T) -> f64, measure: impl Fn() -> T) -> T {
    let one = measure();
    if !again {
        return one;
    }
    let other = measure();
    if seconds(&other) < seconds(&one) { other } else { one }
}

fn measure(cx: &Context, stage: &Stage) -> anyhow::Result<Times> {
    let frame = Frame { seed: cx.seed, ..Frame::default() };
    let scene = &stage.scene;
    // The better of two, as other work may be going on, after one to warm up. A quick run judges no times.
    let again = !cx.quick;
    if again {
        picture(scene, &[], &frame);
    }
    let plain = better(again, |one: &f64| *one, || timed(|| picture(scene, &[], &frame)).1);
    let recipe = "reeves87".parse()?;
    let (maps, pass_1) = timed(|| light_maps(scene, &recipe));
    let maps = maps?;
    // The listing as it is printed, corrected: what the paper's table is about.
    let shadows = bind_lights(scene, &maps, &recipe, cx.storage)?;
    let casting: Vec<bool> = maps.iter().map(Option::is_some).collect();
    let pass_2 = better(again, |one: &Pass2| one.whole, || Pass2::of(scene, &shadows, &casting, &frame));
    Ok(Times { plain, pass_1, pass_2, transform: transform(scene, &frame, maps.iter().flatten().map(DepthMap::view))? })
}

/// Seconds for each region of the picture and light: nothing but the way to the lights' spaces.
fn transform<'a>(scene: &Scene, frame: &Frame, views: impl Iterator<Item = &'a View>) -> anyhow::Result<f64> {
    let asked = Regions::default();
    let mut known: Vec<&dyn Shadow> = vec![&asked];
    known.truncate(scene.lights.len());
    let mut first = scene.clone();
    first.lights[0].casts = true;
    picture(&first, &known, frame);
    let points = asked.0.into_inner().map_err(|_| anyhow::anyhow!("a worker stopped"))?;
    let (mut seconds, mut receivers) = (0.0, 0);
    for view in views {
        // The sum keeps the compiler from leaving the work out.
        let (sum, spent) = timed(|| {
            points.iter().filter_map(|at| view.receiver(at).ok()).map(|r| f64::from(r.footprint.half.x)).sum::<f64>()
        });
        anyhow::ensure!(sum.is_finite(), "a footprint is not finite");
        seconds += spent;
        receivers += points.len();
    }
    Ok(seconds / receivers as f64)
}

fn times(cx: &Context) -> anyhow::Result<Made> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut made = Made::default();
    let mut rows = Vec::new();
    for row in &ROWS {
        let stage = Stage::new((row.scene)(), cx.pick(1024, 192), cx.pick(1, 4))?;
        let casting = stage.maps.iter().flatten().count();
        let measured = pool.install(|| measure(cx, &stage))?;
        let Pass2 { whole, look_ups, receivers } = measured.pass_2;
        for (name, seconds) in [
            ("without shadows", measured.plain),
            ("pass 1", measured.pass_1),
            ("pass 2", whole),
            ("look-ups of pass 2", look_ups),
        ] {
            made.timings.push((format!("{}: {name}", row.name), seconds));
        }
        let numbers = [casting.to_string(), format!("{:.2}", measured.plain), format!("{:.0}", 1e3 * measured.pass_1)];
        let sums = [whole, measured.total()].map(|seconds| format!("{seconds:.2}"));
        let percents = [measured.percent(), row.percent].into_iter().chain(measured.breakdown());
        let per_receiver =
            [look_ups / receivers as f64, measured.transform].map(|seconds| format!("{:.0}", 1e9 * seconds));
        rows.push(
            std::iter::once(row.name.to_string())
                .chain(numbers)
                .chain(sums)
                .chain(percents.map(|percent| format!("{percent:.1}")))
                .chain(per_receiver)
                .collect(),
        );
        made.measures.push(Measure::exactly(
            &format!("{}: casting lights", row.name),
            casting as f64,
            "lights",
            row.casting as f64,
        ));
        // Seconds stay out of the report, and yes or no out of quick runs, where they are a matter of chance.
        let judged = [
            ("total below a picture more for each light", measured.total() < (1 + casting) as f64 * measured.plain),
            ("total at most twice the picture without shadows", measured.total() <= 2.0 * measured.plain),
            ("pass 1 of a light below the picture", measured.pass_1 < casting as f64 * measured.plain),
        ];
        for (what, yes) in judged.into_iter().filter(|_| !cx.quick) {
            made.measures.push(Measure::yes(&format!("{}: {what}", row.name), yes));
        }
    }
    let head = [
        "scene",
        "lights",
        "plain, s",
        "pass 1, ms",
        "pass 2, s",
        "total, s",
        "more, %",
        "paper: more, %",
        "of the total: pass 1, %",
        "look-ups, %",
        "the picture itself, %",
        "look-up, ns per receiver",
        "transform alone, ns per receiver",
    ];
    made.run_tables.push(Table { name: "table-1".into(), head: head.map(String::from).to_vec(), rows });
    made.note = "All times are for one thread. Seconds are those of this run on this machine, and appear only in the last table and \
                 in timings.json; a quick run does not judge them. The look-ups are timed within pass 2, so that pass 1, the look-ups and the picture itself \
                 add up to the total."
        .into();
    Ok(made)
}

pub const T2: Figure = Figure {
    id: "R87-T2",
    paper: Paper::Reeves87,
    title: "Storage of depth maps",
    claim: "A bounding box saves memory; tiles save more in scattered scenes, but can also take more.",
    look: "the tables: where tiles take more bytes than the plain map, and where they take a fraction.",
    make: storage,
};

fn storage(cx: &Context) -> anyhow::Result<Made> {
    let mut made = Made::default();
    let mut rows = Vec::new();
    // Compact: about alike. Scattered: tiles win. Everywhere: between.
    let bounds = [(0.85, 1.25), (0.85, 1.25), (0.0, 0.5), (0.5, 0.95)];
    for (row, (low, high)) in ROWS.iter().zip(bounds) {
        let stage = Stage::new((row.scene)(), 64, 1)?;
        let maps: Vec<&Map> = stage.maps.iter().flatten().collect();
        let raws: Vec<Raw> = maps.iter().map(|map| Raw::copy_of(*map)).collect();
        let sum =
            |bytes: &dyn Fn(usize) -> usize| (0..maps.len()).map(bytes).sum::<usize>() as f64 / f64::from(1 << 20);
        let found = [sum(&|i| raws[i].bytes()), sum(&|i| Bbox::from(&raws[i]).bytes()), sum(&|i| maps[i].bytes())];
        let facets = maps.iter().map(|map| facets_of(&stage.scene, map.view())).collect::<anyhow::Result<Vec<_>>>()?;
        let facets = sum(&|i| facets[i].allocated());
        for (whose, values, facets) in [("", found, format!("{facets:.2}")), ("paper: ", row.megabytes, String::new())]
        {
            let cells = values.iter().map(|mb| format!("{mb:.2}")).chain([facets]);
            rows.push(std::iter::once(format!("{whose}{}", row.name)).chain(cells).collect());
        }
        made.measures.push(Measure::exactly(&format!("{}: raw (V26)", row.name), found[0], "MB", row.megabytes[0]));
        let ratio = format!("{}: tiles over box", row.name);
        made.measures.push(Measure::within(&ratio, found[2] / found[1], "ratio", low, high));
        let largest = (0..maps.len()).max_by_key(|&i| raws[i].depths().len()).unwrap_or(0);
        let view = raws[largest].view();
        let (size, grey) = halved(view.size(), &umbrage_io::depth_view(&raws[largest]), cx.pick(512, 256));
        made.panels.push(
            Panel::grey(row.name, &format!("{}: a light's map", row.name), size, grey)
                .with("map", format!("{}²", view.size().x))
                .role(Role::Map),
        );
    }
    let head = ["scene", "raw MB", "box MB", "32² tiles MB", "facets MB"].map(String::from).to_vec();
    made.tables.push(Table { name: "megabytes".into(), head, rows });
    planar(&mut made)?;
    let view = gallery::sphere_plane().lights[0].view.with_size(UVec2::splat(1024))?;
    let filled = |inside: &dyn Fn(glam::IVec2) -> bool| -> anyhow::Result<Raw> {
        let depth = |t| if inside(t) { 1.0 } else { f32::INFINITY };
        Ok(Raw::new(view, TexelRect::of_size(view.size()).texels().map(depth).collect())?)
    };
    let rectangle = filled(&|t| (100..=131).contains(&t.x) && (200..=231).contains(&t.y))?;
    let disc = filled(&|t| (t.as_dvec2() + 0.5).distance(DVec2::splat(512.0)) < 160.0)?;
    made.measures.extend([
        Measure::exactly("32² rectangle: box (V27)", Bbox::from(&rectangle).bytes() as f64, "bytes", 4096.0),
        Measure::exactly("32² rectangle: tiles (V27)", Tiled::from(&rectangle).bytes() as f64, "bytes", 16_384.0),
        Measure::exactly("disc of radius 160: box (V28)", Bbox::from(&disc).bytes() as f64, "bytes", 409_600.0),
        Measure::exactly("disc of radius 160: tiles (V28)", Tiled::from(&disc).bytes() as f64, "bytes", 88.0 * 4096.0),
    ]);
    Ok(made)
}

/// Scenes of flat surfaces, and by what factor a map of their facets must be smaller than raw depths: for the boxes, under a light perpendicular to the
/// ground, by as much as a file can compress them.
const PLANAR: [(&str, Make, f64); 5] = [
    ("box, slab", gallery::box_plane, 5.0),
    ("contact box", gallery::contact_box, 5.0),
    ("table", gallery::table, 5.0),
    ("spot room", gallery::spot_room, 5.0),
    ("overlapping boxes", gallery::overlapping_boxes, 40.0),
];

/// A map of the facet that each texel sees in place of its distance: the same depths, bit for bit.
fn facets_of(scene: &Scene, view: &View) -> anyhow::Result<Map> {
    Ok(light_map(&"auto,fine=1".parse()?, scene, view))
}

/// What facets save where they are larger than a few texels.
fn planar(made: &mut Made) -> anyhow::Result<()> {
    let mut rows = Vec::new();
    for (name, make, least) in PLANAR {
        let scene = make();
        let view = scene.lights[0].view.with_size(UVec2::splat(1024))?;
        let facets = facets_of(&scene, &view)?;
        let raw = Raw::copy_of(&facets);
        let zip = umbrage_io::encode_shadow_map(&raw)?.len() as f64;
        let (all, whole) = (facets.allocated() as f64, raw.allocated() as f64);
        let kilobytes = |bytes: f64| format!("{:.0}", bytes / 1024.0);
        rows.push(vec![name.into(), kilobytes(whole), kilobytes(zip), kilobytes(all), format!("{:.1}", whole / all)]);
        let measure = format!("{name}, 1024²: raw depths over facets");
        made.measures.push(Measure::at_least(&measure, whole / all, "times", least));
        let measure = format!("{name}, 1024²: facets over a file of depths, ZIP");
        made.measures.push(Measure::at_most(&measure, all / zip, "times", 1.0));
    }
    let head = ["1024²", "raw KB", "EXR, ZIP KB", "facets KB", "raw over facets"].map(String::from).to_vec();
    made.tables.push(Table { name: "facets".into(), head, rows });
    Ok(())
}

/// Every n-th pixel, so that a picture is no more than `most` across.
fn halved(size: UVec2, grey: &[f32], most: u32) -> (UVec2, Vec<f32>) {
    let step = size.x.div_ceil(most);
    let small = size / step;
    let texels = TexelRect::of_size(small).texels().map(|at| at.as_uvec2() * step);
    (small, texels.map(|at| grey[(at.y * size.x + at.x) as usize]).collect())
}
