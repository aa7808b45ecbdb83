use super::SLAB_THICKNESS;
use super::bicycle::{Bicycle, WHEEL, bicycle, wheel};
use super::workshop::{BACK, HALF_WIDTH, HEIGHT, OPEN, beams, bench, shelves, window_bars, window_wall};
use crate::{Light, Material, Mesh, Object, Scene};
use glam::{DMat4, DVec3, UVec2, Vec3};
use umbrage_plane::View;

/// A dim bicycle shop at night, after Reeves, Salesin & Cook 1987, Figure 14: bicycles with all their spokes,
/// shelves, a bench and loose wheels that fill much of both maps.
///
/// Seven lights, of which the first two cast, with maps of 1024 × 1024: a pendant over the middle (light 0) and the moon
/// through the barred window in the left wall (light 1). Lights 2 to 6 are dim fills. Everything receives but the pendant's
/// bulb, and all but that, floor, ceiling, back wall and right wall casts. Objects are found by name: `floor`, `back wall`, `window wall`, `right wall` and `ceiling` are the room;
/// each bicycle is a `frame`, a `rubber` and a `metal` object with its number. The floor is y = 0; the picture is 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn bicycle_shop() -> Scene {
    let mut objects = room();
    for (number, stand) in STANDS.iter().enumerate() {
        let placed = stand.placed();
        let Bicycle { frame, rubber, metal } = bicycle(stand.drop_bars);
        let mut add = |part: &str, mesh: Mesh, material: Material| {
            objects.push(Object::solid(&format!("bicycle {number} {part}"), mesh.transformed(&placed), material));
        };
        add("frame", frame, gloss(stand.colour));
        add("rubber", rubber, Material { diffuse: Vec3::splat(0.045), specular: Vec3::splat(0.06), shininess: 12.0 });
        add("metal", metal, STEEL);
    }
    furniture(&mut objects);
    let camera = View::perspective(
        DVec3::new(36.0, 35.0, 110.0),
        DVec3::new(-7.0, 21.0, -8.0),
        DVec3::Y,
        41f64.to_radians(),
        20.0,
        400.0,
        UVec2::splat(1024),
    )
    .expect("a constant view is valid");
    Scene {
        name: "bicycle-shop".into(),
        origin: DVec3::ZERO,
        objects,
        lights: lights(),
        ambient: Vec3::new(0.020, 0.022, 0.034),
        background: Vec3::new(0.003, 0.004, 0.008),
        camera,
    }
}

const STEEL: Material = Material { diffuse: Vec3::new(0.42, 0.43, 0.45), specular: Vec3::splat(0.55), shininess: 40.0 };

/// Where the pendant's light is.
const PENDANT: DVec3 = DVec3::new(4.0, 45.0, -11.0);

const fn gloss(diffuse: Vec3) -> Material {
    Material { diffuse, specular: Vec3::splat(0.40), shininess: 70.0 }
}

/// How a bicycle stands: turned about the vertical, then leaning to its right (radians), at a place.
struct Stand {
    at: DVec3,
    heading: f64,
    lean: f64,
    /// Turned about its length: upside down under repair, or upright.
    upturned: bool,
    colour: Vec3,
    drop_bars: bool,
}

impl Stand {
    fn placed(&self) -> DMat4 {
        let turned =
            DMat4::from_translation(self.at) * DMat4::from_rotation_y(self.heading) * DMat4::from_rotation_x(self.lean);
        if self.upturned { turned * DMat4::from_rotation_x(std::f64::consts::PI) } else { turned }
    }
}

const STANDS: [Stand; 7] = [
    // Under the pendant, wheels up.
    Stand {
        at: DVec3::new(2.0, 20.7, 8.0),
        heading: 0.42,
        lean: 0.0,
        upturned: true,
        colour: Vec3::new(0.62, 0.06, 0.05),
        drop_bars: false,
    },
    // A row along the window.
    Stand {
        at: DVec3::new(-44.0, 0.0, 22.0),
        heading: 0.95,
        lean: 0.10,
        upturned: false,
        colour: Vec3::new(0.05, 0.25, 0.50),
        drop_bars: true,
    },
    Stand {
        at: DVec3::new(-43.0, 0.0, 4.0),
        heading: 0.80,
        lean: 0.10,
        upturned: false,
        colour: Vec3::new(0.60, 0.42, 0.06),
        drop_bars: false,
    },
    Stand {
        at: DVec3::new(-42.0, 0.0, -14.0),
        heading: 0.72,
        lean: 0.10,
        upturned: false,
        colour: Vec3::new(0.08, 0.34, 0.16),
        drop_bars: true,
    },
    // To the right, on their way out.
    Stand {
        at: DVec3::new(42.0, 0.0, 12.0),
        heading: 2.35,
        lean: -0.08,
        upturned: false,
        colour: Vec3::new(0.48, 0.46, 0.40),
        drop_bars: false,
    },
    Stand {
        at: DVec3::new(44.0, 0.0, -8.0),
        heading: 2.15,
        lean: -0.08,
        upturned: false,
        colour: Vec3::new(0.40, 0.10, 0.32),
        drop_bars: true,
    },
    // On the back wall, above the bench.
    Stand {
        at: DVec3::new(-31.0, 37.0, -BACK as f64 + 5.8),
        heading: 0.0,
        lean: 0.0,
        upturned: false,
        colour: Vec3::new(0.10, 0.42, 0.44),
        drop_bars: true,
    },
];

fn room() -> Vec<Object> {
    let slab = |low: Vec3, high: Vec3| Mesh::cuboid(low, high);
    let t = SLAB_THICKNESS;
    let floor = slab(Vec3::new(-HALF_WIDTH - 3.0, -t, -BACK - 3.0), Vec3::new(HALF_WIDTH + 3.0, 0.0, OPEN + 30.0));
    let back = slab(Vec3::new(-HALF_WIDTH - 3.5, -1.0, -BACK - t), Vec3::new(HALF_WIDTH + 3.5, HEIGHT + 1.0, -BACK));
    let right = slab(Vec3::new(HALF_WIDTH, -1.5, -BACK - 2.0), Vec3::new(HALF_WIDTH + t, HEIGHT + 1.5, OPEN));
    let ceiling =
        slab(Vec3::new(-HALF_WIDTH - 2.5, HEIGHT, -BACK - 1.0), Vec3::new(HALF_WIDTH + 2.5, HEIGHT + t, OPEN));
    let plaster = Material::matt(Vec3::new(0.42, 0.38, 0.32));
    let timber = Material::matt(Vec3::new(0.22, 0.14, 0.08));
    // What has nothing behind it in the room throws no shadow there, and stays out of the maps (R87-5).
    let backdrop =
        |name: &str, mesh: Mesh, material: Material| Object { casts: false, ..Object::solid(name, mesh, material) };
    vec![
        backdrop(
            "floor",
            floor,
            Material { diffuse: Vec3::new(0.30, 0.27, 0.24), specular: Vec3::splat(0.04), shininess: 20.0 },
        ),
        backdrop("back wall", back, plaster),
        Object::solid("window wall", window_wall(), plaster),
        backdrop("right wall", right, plaster),
        backdrop("ceiling", ceiling, Material::matt(Vec3::new(0.30, 0.27, 0.23))),
        Object::solid("beams", beams(), timber),
        Object::solid("window bars", window_bars(), timber),
    ]
}

fn furniture(objects: &mut Vec<Object>) {
    let timber = Material::matt(Vec3::new(0.30, 0.18, 0.09));
    let store = shelves(8.0);
    let [cartons, crates] = store.boxes;
    let [red, blue] = store.tins;
    let (bench, tools) = bench(-52.0);
    let (tyres, rims) = loose_wheels();
    let (shade, bulb) = pendant();
    let rubber = Material { diffuse: Vec3::splat(0.045), specular: Vec3::splat(0.06), shininess: 12.0 };
    objects.extend([
        Object::solid("shelves", store.wood, timber),
        Object::solid("cartons", cartons, Material::matt(Vec3::new(0.42, 0.30, 0.17))),
        Object::solid("crates", crates, Material::matt(Vec3::new(0.20, 0.26, 0.22))),
        Object::solid("red tins", red, gloss(Vec3::new(0.50, 0.09, 0.06))),
        Object::solid("blue tins", blue, gloss(Vec3::new(0.10, 0.24, 0.42))),
        Object::solid("bench", bench, timber),
        Object::solid("tools", tools, STEEL),
        Object::solid("pegs", pegs(), timber),
        Object::solid("loose tyres", tyres, rubber),
        Object::solid("loose rims", rims, STEEL),
        Object::solid("pendant", shade, gloss(Vec3::new(0.10, 0.22, 0.16))),
        Object {
            casts: false,
            receives: false,
            ..Object::solid("bulb", bulb, Material::matt(Vec3::new(1.0, 1.0, 0.95)))
        },
    ]);
}

/// What the bicycle on the wall hangs from, by its top tube.
fn pegs() -> Mesh {
    let mut mesh = Mesh::default();
    for (x, y) in [(-33.2, 52.52), (-24.8, 53.04)] {
        let at = |out: f32, up: f32| Vec3::new(x, y + up, -BACK + out);
        mesh.append(&Mesh::tube(&[at(-0.5, -0.15), at(6.2, 0.0), at(7.4, 0.9)], 0.4, 16));
    }
    mesh
}

/// Wheels that hang on the right wall and lean at the foot of the shelves.
fn loose_wheels() -> (Mesh, Mesh) {
    let (tyre, rim) = wheel();
    let (mut tyres, mut rims) = (Mesh::default(), Mesh::default());
    let mut add = |place: &DMat4| {
        tyres.append(&tyre.clone().transformed(place));
        rims.append(&rim.clone().transformed(place));
    };
    for number in 0..4u8 {
        let at = DVec3::new(f64::from(HALF_WIDTH) - 1.3, 40.0, -34.0 + 17.0 * f64::from(number));
        add(&(DMat4::from_translation(at)
            * DMat4::from_rotation_y(1.57)
            * DMat4::from_rotation_z(0.3 * f64::from(number))));
    }
    for (x, turn) in [(-4.0, 0.0), (-1.5, 0.5)] {
        let at = DVec3::new(x, f64::from(WHEEL) * 0.97, -f64::from(BACK) + 5.0 + turn * 3.0);
        add(&(DMat4::from_translation(at) * DMat4::from_rotation_x(-0.24) * DMat4::from_rotation_z(turn)));
    }
    (tyres, rims)
}

/// The pendant: shade, cord and socket, and a bulb whose shading normals point inward, glass that is lit from within.
fn pendant() -> (Mesh, Mesh) {
    // Down is the axis: from the cap to the rim and back along the inside.
    const SHADE: [(f32, f32); 12] = [
        (0.0, -4.0),
        (1.2, -4.0),
        (1.5, -2.0),
        (2.6, -0.8),
        (4.8, 0.8),
        (7.2, 2.8),
        (8.8, 5.0),
        (8.4, 5.0),
        (6.8, 3.1),
        (4.5, 1.3),
        (2.2, -0.3),
        (0.0, -0.4),
    ];
    let at = PENDANT.as_vec3();
    let mut shade = Mesh::lathe(at, Vec3::NEG_Y, &SHADE, 96);
    shade.append(&Mesh::tube(&[at + Vec3::Y * 3.9, Vec3::new(at.x, HEIGHT + 0.5, at.z)], 0.18, 12));
    let mut bulb = Mesh::sphere(at - Vec3::Y * 1.9, 1.85, 48);
    for normal in &mut bulb.normals {
        *normal = -*normal;
    }
    (shade, bulb)
}

fn lights() -> Vec<Light> {
    let map = UVec2::splat(1024);
    let pendant = Light::spot("pendant", PENDANT, PENDANT - DVec3::Y, 124.0, 1.0, 200.0, map);
    let moon =
        Light::spot("moon", DVec3::new(-190.0, 112.0, -36.0), DVec3::new(-64.0, 34.0, -7.0), 33.0, 80.0, 420.0, map);
    let fill = |name: &str, at: DVec3, colour: Vec3| {
        let light = Light::point(name, at, DVec3::new(0.0, 20.0, 0.0), 80.0, 5.0, 400.0, map);
        Light { casts: false, ..light.expect("a constant view is valid").coloured(colour) }
    };
    vec![
        pendant.expect("a constant view is valid").coloured(Vec3::new(0.74, 0.59, 0.37)),
        moon.expect("a constant view is valid").coloured(Vec3::new(0.34, 0.46, 0.72)),
        fill("street", DVec3::new(-60.0, 50.0, 140.0), Vec3::new(0.020, 0.028, 0.048)),
        fill("doorway", DVec3::new(90.0, 40.0, 120.0), Vec3::new(0.030, 0.022, 0.014)),
        fill("floor glow", DVec3::new(2.0, 2.0, 40.0), Vec3::new(0.040, 0.030, 0.018)),
        fill("window glow", DVec3::new(-58.0, 34.0, -7.0), Vec3::new(0.016, 0.024, 0.042)),
        fill("stove", DVec3::new(56.0, 6.0, -30.0), Vec3::new(0.040, 0.018, 0.008)),
    ]
}
