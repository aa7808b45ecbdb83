//! Rows of pictures with their shadows beside the same pictures without (Reeves 1987, Table 1): what shadows add to all else that a
//! renderer does.

use super::rows::{Goal, Row, Settings};
use crate::timing::{medians, processor_seconds};
use glam::UVec2;
use std::hint::black_box;
use umbrage_depth::Storage;
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, bind_lights, light_maps, picture};
use umbrage_scene::gallery::{self, Make};
use umbrage_shadow::Shadow;

/// The scenes that stand for the paper's four.
const SCENES: [(&str, Make); 4] = [
    ("sphere", gallery::sphere_plane),
    ("coloured lights", gallery::three_lights),
    ("desk lamps", gallery::desk_lamps),
    ("bicycle shop", gallery::bicycle_shop),
];

/// The pictures, and what of each is pass 1.
pub fn shadowed(settings: Settings) -> Vec<Row> {
    SCENES.into_iter().flat_map(|(name, scene)| of(settings, name, scene)).collect()
}

fn of(settings: Settings, name: &str, make: Make) -> [Row; 2] {
    let mut scene = make();
    // The paper leaves the plane below its spheres out of the maps.
    for object in scene.objects.iter_mut().filter(|object| object.name == "slab") {
        object.casts = false;
    }
    let side = settings.picture();
    scene.camera = scene.camera.with_size(UVec2::splat(side)).expect("a size that cameras have");
    for light in scene.lights.iter_mut().filter(|_| settings.quick) {
        light.view = light.view.with_size(UVec2::splat(side)).expect("a size that maps have");
    }
    let (scene, frame) = (&scene, Frame::default());
    let recipe: Recipe = "reeves87".parse().expect("a preset");
    let maps = || light_maps(scene, &recipe).expect("maps of every light");
    let taken = medians(
        settings.rounds(),
        processor_seconds,
        &mut [
            &mut || drop(black_box(picture(scene, &[], &frame))),
            &mut || {
                let maps = maps();
                let shadows = bind_lights(scene, &maps, &recipe, Storage::Tiled).expect("a filter that suits the maps");
                let known: Vec<&dyn Shadow> = shadows.iter().map(AsRef::as_ref).collect();
                drop(black_box(picture(scene, &known, &frame)));
            },
            &mut || drop(black_box(maps())),
        ],
    );
    let lights = match scene.lights.iter().filter(|light| light.casts).count() {
        1 => "1 light".to_owned(),
        casting => format!("{casting} lights"),
    };
    let row = |what: &str, ours: f64, peer: &str, theirs: f64, goal| Row {
        group: "pictures",
        what: format!("{name} {what}, {lights} at {side}²"),
        unit: "ms",
        ours: ours * 1e3,
        peer: peer.into(),
        theirs: theirs * 1e3,
        goal: settings.always(goal),
    };
    [
        row("with shadows", taken[1], "without", taken[0], Goal::Within(1.2)),
        row("maps alone", taken[2], "with shadows", taken[1], Goal::Free),
    ]
}
