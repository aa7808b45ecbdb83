//! Faults of whole scenes, found without a place put by hand.

use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_oracle::judge::{Drawn, Judge, Score, Seen};
use umbrage_oracle::{AreaLight, Geometry, RayCast};
use umbrage_plane::{SurfacePoint, View};
use umbrage_recipe::{LightUse, Recipe};
use umbrage_sample::Key;
use umbrage_scene::{Light, Material, Mesh, Object, Scene, Shape, gallery};
use umbrage_shadow::Shadow;

/// What a camera sees by one ray through each pixel's centre.
struct Picture {
    scene: Scene,
    points: Vec<SurfacePoint>,
    position: Vec<DVec3>,
    normal: Vec<Vec3>,
    object: Vec<u32>,
    share: Vec<f32>,
    facing: Vec<f32>,
}

impl Picture {
    fn new(mut scene: Scene, size: u32, texels: u32) -> (Self, Geometry) {
        scene.camera = scene.camera.with_size(UVec2::splat(size)).expect("a camera");
        scene.lights[0].view = scene.lights[0].view.with_size(UVec2::splat(texels)).expect("a light");
        let geometry = Geometry::new(&scene, &scene.camera);
        let (camera, light) = (scene.camera, scene.lights[0].view);
        let pixels = (size * size) as usize;
        let mut seen = Self {
            scene,
            points: Vec::new(),
            position: vec![DVec3::NAN; pixels],
            normal: vec![Vec3::ZERO; pixels],
            object: vec![u32::MAX; pixels],
            share: vec![0.0; pixels],
            facing: vec![0.0; pixels],
        };
        for pixel in 0..pixels {
            let corner = DVec2::new((pixel as u32 % size).into(), (pixel as u32 / size).into());
            let (origin, direction) = camera.ray(corner + 0.5);
            let Some(hit) = geometry.first_hit(origin, direction) else { continue };
            let normal = (hit.normal * -1f64.copysign(hit.normal.dot(direction))).as_vec3();
            let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|by| {
                let (origin, direction) = camera.ray(corner + by);
                let along = (hit.position - origin).dot(hit.normal) / direction.dot(hit.normal);
                origin + direction * along
            });
            let point =
                SurfacePoint { object: hit.object, region: pixel as u32, ..SurfacePoint::at(hit.position, normal) };
            seen.points.push(point.with_corners(corners));
            (seen.position[pixel], seen.normal[pixel], seen.object[pixel]) = (hit.position, normal, hit.object);
            (seen.share[pixel], seen.facing[pixel]) =
                (1.0, normal.as_dvec3().dot(light.toward_eye(hit.position)) as f32);
        }
        (seen, geometry)
    }

    fn light(&self) -> View {
        self.scene.lights[0].view
    }

    fn image(&self, shadow: &dyn Shadow, seed: u32) -> Vec<f32> {
        let mut answers = vec![0.0; self.points.len()];
        shadow.fractions(&self.points, Key::new(seed, 0, 0), &mut answers);
        let mut image = vec![0.0; self.position.len()];
        for (point, answer) in self.points.iter().zip(answers) {
            image[point.region as usize] = answer;
        }
        image
    }

    fn by(&self, recipe: &Recipe) -> Box<dyn Shadow> {
        let triangles = |view: &View, _: u32| {
            let mut all = Vec::new();
            for (id, object) in self.scene.objects.iter().enumerate().filter(|(_, object)| object.casts) {
                let mesh = object.shape.mesh_for(view);
                for index in 0..mesh.triangles.len() {
                    let corners = mesh.corners(index).map(Vec3::as_dvec3);
                    let (object, sheet) = (id as u32, !object.is_solid());
                    all.push(umbrage_raster::Triangle { corners, object, sheet });
                }
            }
            all
        };
        recipe.shadow_of(&[self.light()], &LightUse::default(), triangles).expect("a shadow").shadow
    }

    fn judge<'a>(&'a self, geometry: &'a Geometry, rays: &'a dyn Shadow, truth: &'a [f32]) -> Judge<'a> {
        let Self { position, normal, object, share, facing, .. } = self;
        let seen = Seen { position, normal, object, share, facing };
        Judge::new((&self.scene.camera, &[self.light()]), geometry, (rays, truth), seen)
    }

    /// The scores of recipes.
    fn scores<const N: usize>(&self, geometry: &Geometry, recipes: [&str; N]) -> [Score; N] {
        let rays = RayCast::new(geometry, &self.light());
        let truth = self.image(&rays, 0);
        let judge = self.judge(geometry, &rays, &truth);
        recipes.map(|text| {
            let recipe: Recipe = text.parse().expect("a recipe");
            let shadow = self.by(&recipe);
            let (result, again) = (self.image(&*shadow, 0), self.image(&*shadow, 1));
            let unbiased = recipe.unbiased().map(|recipe| self.image(&*self.by(&recipe), 0));
            let unbiased = unbiased.as_deref();
            judge.score(&Drawn { result: &result, recipe: Some(&recipe), unbiased, again: &[&again] })
        })
    }
}

/// The worst that pictures can say: all is lit, and without a bias all would be dark.
#[test]
fn a_bias_detaches_nothing_that_is_farther_away_than_it_reaches() {
    let (picture, geometry) = Picture::new(gallery::table(), 96, 256);
    let rays = RayCast::new(&geometry, &picture.light());
    let truth = picture.image(&rays, 0);
    let judge = picture.judge(&geometry, &rays, &truth);
    let (lit, dark) = (vec![0.0; truth.len()], vec![1.0; truth.len()]);
    let score = |text: &str| {
        let recipe: Recipe = text.parse().expect("a recipe");
        judge.score(&Drawn { result: &lit, recipe: Some(&recipe), unbiased: Some(&dark), again: &[] })
    };
    for text in
        ["auto", "woo92", "reeves87,bias=0", "burley,slope=0", "reeves87,depth=normal-offset,normal-offset=0,bias=0"]
    {
        let score = score(text);
        assert!(score.false_light > Some(0.02) && score.detachment == Some(0.0), "{text}: {:?}", score.detachment);
        assert!(score.leak > Some(0.0) && score.detached.is_none(), "{text}: {:?}", score.leak);
    }
    let shares = ["0.1", "60", "400", "4000"].map(|bias| {
        let score = score(&format!("reeves87,bias={bias},res-factor=1"));
        score.detachment.expect("a recipe")
    });
    assert!(shares.is_sorted() && shares[0] < 0.25 * shares[3] && shares[3] > 0.01, "{shares:?}");
}

#[test]
fn truth_has_no_fault() {
    let (picture, geometry) = Picture::new(gallery::table(), 96, 256);
    let rays = RayCast::new(&geometry, &picture.light());
    let truth = picture.image(&rays, 0);
    let judge = picture.judge(&geometry, &rays, &truth);
    let recipe = Recipe::default();
    let drawn = Drawn { result: &truth, recipe: Some(&recipe), unbiased: None, again: &[&truth] };
    for score in [judge.score(&drawn), judge.score(&Drawn::foreign(&truth))] {
        assert!(score.judged > 3000, "{}", score.judged);
        let none = [score.rms, score.false_shadow, score.false_light, score.acne];
        assert_eq!(none, [Some(0.0); 4]);
        assert_eq!(score.displacement, Some(DVec2::ZERO));
        let shift = score.edge_shift.expect("edges");
        assert!(shift.absolute == 0.0 && shift.mean == 0.0 && shift.length > 50.0, "{shift:?}");
        assert_eq!((score.penumbra_ratio, score.detached), (None, None));
    }
    let score = judge.score(&drawn);
    assert_eq!((score.detachment, score.leak, score.noise), (Some(0.0), Some(0.0), Some(0.0)));
    let foreign = judge.score(&Drawn::foreign(&truth));
    assert_eq!((foreign.detachment, foreign.leak, foreign.noise), (None, None, None));
}

#[test]
fn a_shifted_copy_is_displaced() {
    let (picture, geometry) = Picture::new(gallery::table(), 128, 256);
    let rays = RayCast::new(&geometry, &picture.light());
    let truth = picture.image(&rays, 0);
    let judge = picture.judge(&geometry, &rays, &truth);
    for (x, y) in [(2, 1), (-3, 0), (0, -2)] {
        let copy = (0..truth.len() as i32).map(|pixel| {
            let (from_x, from_y) = ((pixel % 128 - x).clamp(0, 127), (pixel / 128 - y).clamp(0, 127));
            truth[(from_y * 128 + from_x) as usize]
        });
        let copy: Vec<f32> = copy.collect();
        let moved = judge.score(&Drawn::foreign(&copy)).displacement.expect("edges");
        assert!((moved - DVec2::new(x.into(), y.into())).abs().max_element() < 0.1, "{moved} for {x}, {y}");
    }
}

#[test]
fn a_bias_trades_acne_for_detachment() {
    let (picture, geometry) = Picture::new(gallery::table(), 128, 512);
    let [none, auto] = picture.scores(&geometry, ["reeves87,bias=0", "auto"]);
    assert!(none.acne.is_some_and(|acne| acne > 0.05), "{:?}", none.acne);
    assert_eq!((none.detachment, none.detached), (Some(0.0), None), "there is no bias to blame");
    assert!(none.noise.is_some_and(|noise| noise > 0.01), "{:?}", none.noise);
    let faults = [auto.acne, auto.detachment, auto.leak];
    assert!(faults.iter().all(|fault| fault.is_some_and(|fault| fault < 1e-3)), "{faults:?}");
    assert_eq!(auto.noise, Some(0.0));

    // The same table from nearby.
    let (picture, geometry) = Picture::new(gallery::table_close_up(), 128, 512);
    let recipes = ["reeves87,bias=0", "reeves87,bias=15", "reeves87,bias=25", "auto"];
    let [none, small, large, auto] = picture.scores(&geometry, recipes);
    assert!(none.acne.is_some_and(|acne| acne > 0.05), "{:?}", none.acne);
    for (score, least, bias) in [(&small, 1e-3, 15.0), (&large, 5e-3, 25.0)] {
        assert!(score.detachment.is_some_and(|share| share > least), "{bias}: {:?}", score.detachment);
        assert!(score.acne.is_some_and(|acne| acne < 1e-3), "{bias}: {:?}", score.acne);
        let size = score.detached.expect("a size");
        // A blocker that is farther away than the bias is still found behind it; a texel's slope adds to it.
        assert!(size.mean > 0.0 && size.mean < 2.0 * bias && size.most >= size.mean, "{bias}: {size:?}");
    }
    assert!(large.detachment > small.detachment);
    let faults = [auto.acne, auto.detachment, auto.leak];
    assert!(faults.iter().all(|fault| fault.is_some_and(|fault| fault < 1e-3)), "{faults:?}");
}

/// Two sheets over one another in the light's way, so far apart.
fn two_sheets(gap: f32, eye: DVec3) -> Scene {
    let sheet = |half: f32, y: f32| {
        let corners = [[-half, half], [half, half], [half, -half], [-half, -half]];
        Shape::Mesh(Mesh::sheet(corners.map(|[x, z]| Vec3::new(x, y, z)), 1))
    };
    let grey = Material::matt(Vec3::splat(0.6));
    let mut scene = gallery::table();
    let size = UVec2::splat(64);
    scene.camera = View::perspective(eye, DVec3::Y * -0.8, DVec3::Y, 0.7, 0.1, 100.0, size).expect("a camera");
    scene.lights = vec![Light::point("lamp", DVec3::Y * 20.0, DVec3::ZERO, 30.0, 1.0, 100.0, size).expect("a light")];
    scene.objects =
        vec![Object::two_sided("under", sheet(3.0, 0.0), grey), Object::two_sided("over", sheet(2.0, gap), grey)];
    scene
}

/// From where one looks in between two sheets.
const BESIDE: DVec3 = DVec3::new(0.0, 0.3, 12.0);

#[test]
fn sheets_closer_than_the_bias_are_detached_by_their_distance() {
    let gap = 0.5;
    let (picture, geometry) = Picture::new(two_sheets(gap, BESIDE), 64, 256);
    let [far, near] = picture.scores(&geometry, ["reeves87,bias=1", "reeves87,bias=0.25"]);
    // Without the bias the lower sheet would be dark.
    let size = far.detached.expect("a detachment");
    assert!(far.detachment.is_some_and(|share| share > 0.1), "{:?}", far.detachment);
    assert!((size.mean - f64::from(gap)).abs() < 0.01 && size.most < 0.52, "{size:?}");
    assert!((size.texels - size.mean / picture.light().texel_world(20.0).max_element()).abs() < 0.05 * size.texels);
    assert_eq!(far.leak, Some(0.0));
    assert_eq!((near.detachment, near.leak), (Some(0.0), Some(0.0)), "a smaller bias does no harm");
}

#[test]
fn light_through_what_maps_do_not_hold_leaks() {
    let mut scene = two_sheets(3.0, DVec3::new(0.0, 2.0, 12.0));
    scene.objects[1].casts = false;
    let (picture, geometry) = Picture::new(scene, 64, 256);
    let recipes = ["wang-molnar94", "auto"];
    for (recipe, score) in recipes.iter().zip(picture.scores(&geometry, recipes)) {
        // No bias is to blame: it is as light without one.
        let found = (score.false_light, score.leak, score.detachment, score.rms, score.judged);
        assert!(score.leak.is_some_and(|share| share > 0.1), "{recipe}: {found:?}");
        assert_eq!((score.detachment, score.detached), (Some(0.0), None));
        let marked = score.places.leak.expect("a mask").into_iter().filter(|leak| *leak).count();
        assert_eq!(score.leak, Some(marked as f64 / score.judged as f64));
    }
}

#[test]
fn soft_edges_are_compared_by_width() {
    let (picture, geometry) = Picture::new(two_sheets(1.5, DVec3::new(0.0, 10.0, 12.0)), 96, 256);
    let disc = |radius| AreaLight::new(RayCast::new(&geometry, &picture.light()), radius);
    let rays = disc(4.0);
    let truth = picture.image(&rays, 0);
    let judge = picture.judge(&geometry, &rays, &truth);
    let ratio = |radius| judge.score(&Drawn::foreign(&picture.image(&disc(radius), 0))).penumbra_ratio.expect("soft");
    assert!((ratio(4.0) - 1.0).abs() < 1e-9);
    assert!((ratio(2.0) - 0.5).abs() < 0.15, "{}", ratio(2.0));
}
