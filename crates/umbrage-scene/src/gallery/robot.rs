use super::SLAB_THICKNESS;
use super::sculpt::{Profile, ROUND, ball, drum, ring, turned};
use crate::{Light, Material, Mesh, Object, Patch, Scene, Shape};
use glam::{DVec3, Mat4, Quat, UVec2, Vec2, Vec3};
use umbrage_plane::View;

/// Handles of boxes with soft edges.
const BOXY: f32 = 0.86;

/// A waving robot on a floor before a wall, after Williams 1978, Figure 8: its shadow runs over the floor and climbs the
/// wall. Shell, joints, trim and eyes (objects 0 to 3) are closed solids of bicubic patches, [`patch_count`] of them
/// altogether (more than the paper's 350); floor and wall are objects 4 and 5.
///
/// The sun (light 0, casting) stands to the left before it; a dim fill (light 1) casts none. The floor is y = 0, the
/// wall z = −26; map and picture are 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
///
/// [`patch_count`]: super::patch_count
pub fn robot() -> Scene {
    let size = UVec2::splat(1024);
    let mut body = Body::default();
    body.trunk();
    body.head();
    body.leg(-1.0);
    body.leg(1.0);
    // One arm greets, the other one rests.
    let greeting = [Vec3::new(11.5, 40.0, 0.0), Vec3::new(21.0, 42.0, 3.0), Vec3::new(24.0, 53.0, 6.0)];
    body.arm(&greeting, Vec3::new(0.15, 1.0, 0.1));
    let resting = [Vec3::new(-11.5, 40.0, 0.0), Vec3::new(-18.0, 31.5, -1.0), Vec3::new(-19.0, 21.5, 5.0)];
    body.arm(&resting, Vec3::new(-0.1, -1.0, 0.25));

    let solid = |name: &str, patches: Vec<Patch>, diffuse: Vec3, specular: f32| Object {
        solid: true,
        passes: Vec3::ZERO,
        ..Object::two_sided(
            name,
            Shape::Patches(patches),
            Material { diffuse, specular: Vec3::splat(specular), shininess: 50.0 },
        )
    };
    let floor = Mesh::cuboid(Vec3::new(-200.0, -SLAB_THICKNESS, -28.0), Vec3::new(200.0, 0.0, 160.0));
    let wall = Mesh::cuboid(Vec3::new(-220.0, -6.0, -26.0 - SLAB_THICKNESS), Vec3::new(220.0, 160.0, -26.0));
    let sun =
        Light::directional("sun", DVec3::new(-0.80, 0.52, 0.76), DVec3::new(0.0, 28.0, 0.0), 52.0, 20.0, 600.0, size)
            .expect("a constant view is valid");
    let fill =
        Light::directional("fill", DVec3::new(0.9, 0.4, 0.7), DVec3::new(0.0, 28.0, 0.0), 52.0, 20.0, 600.0, size)
            .expect("a constant view is valid");
    let camera = View::perspective(
        DVec3::new(40.0, 44.0, 140.0),
        DVec3::new(16.0, 28.5, -8.0),
        DVec3::Y,
        35f64.to_radians(),
        20.0,
        500.0,
        size,
    )
    .expect("a constant view is valid");
    Scene {
        name: "robot".into(),
        origin: DVec3::ZERO,
        objects: vec![
            solid("shell", body.shell, Vec3::new(0.72, 0.30, 0.10), 0.35),
            solid("joints", body.joints, Vec3::new(0.10, 0.11, 0.13), 0.30),
            solid("trim", body.trim, Vec3::new(0.70, 0.66, 0.54), 0.35),
            solid("eyes", body.eyes, Vec3::new(0.08, 0.45, 0.55), 0.60),
            Object::solid("floor", floor, Material::matt(Vec3::new(0.52, 0.44, 0.36))),
            Object::solid("wall", wall, Material::matt(Vec3::new(0.36, 0.48, 0.54))),
        ],
        lights: vec![
            sun.coloured(Vec3::new(0.92, 0.87, 0.78)),
            Light { casts: false, ..fill.coloured(Vec3::new(0.12, 0.13, 0.17)) },
        ],
        ambient: Vec3::new(0.12, 0.13, 0.17),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera,
    }
}

/// The robot's patches by surface.
#[derive(Default)]
struct Body {
    shell: Vec<Patch>,
    joints: Vec<Patch>,
    trim: Vec<Patch>,
    eyes: Vec<Patch>,
}

impl Body {
    fn trunk(&mut self) {
        let flat = |y: f32| Mat4::from_translation(Vec3::Y * y) * Mat4::from_scale(Vec3::new(1.0, 1.0, 0.74));
        self.shell.extend(turned(&drum(7.2, -3.0, 2.8, 2.2), 0.75, &flat(22.0)));
        for (index, radius) in [5.2f32, 5.6, 5.2].into_iter().enumerate() {
            self.joints.extend(turned(&ring(radius - 1.0, 1.0), ROUND, &flat(25.4 + 1.3 * index as f32)));
        }
        self.shell.extend(turned(&chest(), 0.78, &flat(28.0)));
        let front = |x: f32, y: f32, z: f32| facing(Vec3::new(x, y, z), Vec3::new(0.0, 0.06, 1.0));
        self.trim.extend(turned(&drum(3.1, -1.0, 1.0, 0.5), ROUND, &front(-2.4, 38.0, 6.9)));
        self.joints.extend(turned(&ring(3.1, 0.45), ROUND, &front(-2.4, 38.0, 7.8)));
        let needle =
            front(-2.4, 38.0, 8.0) * Mat4::from_rotation_y(0.6) * Mat4::from_translation(Vec3::new(0.0, 0.0, 1.0));
        self.joints.extend(turned(
            &drum(0.3, -0.3, 0.3, 0.1),
            BOXY,
            &(needle * Mat4::from_scale(Vec3::new(1.0, 1.0, 5.0))),
        ));
        for (index, y) in [40.0f32, 37.8, 35.6].into_iter().enumerate() {
            let patches = turned(&drum(0.8, -0.8, 0.9, 0.4), ROUND, &front(4.6, y, 6.6));
            if index == 1 { &mut self.eyes } else { &mut self.trim }.extend(patches);
        }
    }

    fn head(&mut self) {
        for index in 0..3u8 {
            let at = Mat4::from_translation(Vec3::Y * (43.6 + 1.1 * f32::from(index)));
            self.joints.extend(turned(&ring(2.0, 0.8), ROUND, &at));
        }
        let tilt = Mat4::from_translation(Vec3::Y * 46.6)
            * Mat4::from_quat(Quat::from_rotation_z(-0.10) * Quat::from_rotation_y(0.16));
        let skull = tilt * Mat4::from_scale(Vec3::new(1.0, 1.0, 0.80));
        self.shell.extend(turned(&drum(8.2, 0.0, 11.6, 2.6), BOXY, &skull));
        self.joints.extend(turned(&ring(3.4, 0.7), BOXY, &(tilt * Mat4::from_translation(Vec3::Y * 11.6))));
        for side in [-1.0, 1.0] {
            let at = |z: f32| tilt * facing(Vec3::new(3.3 * side, 7.0, z), Vec3::Z);
            self.trim.extend(turned(&ring(2.1, 0.55), ROUND, &at(6.7)));
            self.eyes.extend(turned(&ball(1.8), ROUND, &at(6.4)));
            self.joints.extend(turned(&drum(0.75, -0.4, 0.4, 0.2), ROUND, &at(8.0)));
            let ear = tilt * facing(Vec3::new(8.0 * side, 6.2, 0.0), Vec3::X * side);
            self.trim.extend(turned(&drum(2.3, -0.6, 0.8, 0.5), ROUND, &ear));
            self.joints.extend(turned(&drum(1.2, 0.5, 1.9, 0.5), ROUND, &ear));
        }
        // A mouth of five short bars, bent to a smile.
        for bar in -2..=2i8 {
            let bar = f32::from(bar);
            let at = tilt * Mat4::from_translation(Vec3::new(1.45 * bar, 2.3 + 0.16 * bar * bar, 6.5));
            self.trim.extend(turned(&drum(0.5, -0.9, 0.9, 0.35), BOXY, &at));
        }
        let stalk = tilt * Mat4::from_translation(Vec3::Y * 11.8);
        self.joints.extend(turned(&drum(0.42, 0.0, 5.4, 0.2), ROUND, &stalk));
        self.eyes.extend(turned(&ball(1.3), ROUND, &(stalk * Mat4::from_translation(Vec3::Y * 6.4))));
    }

    fn leg(&mut self, side: f32) {
        let [hip, knee, ankle] = [Vec3::new(4.2, 19.6, 0.0), Vec3::new(5.3, 11.6, 1.2), Vec3::new(5.8, 4.0, 0.0)]
            .map(|at| at * Vec3::new(side, 1.0, 1.0));
        self.joints.extend(turned(&ball(2.5), ROUND, &Mat4::from_translation(hip)));
        self.limb(hip, knee, 2.5);
        self.knob(knee, 2.1);
        self.limb(knee, ankle, 2.9);
        self.joints.extend(turned(&ring(1.8, 0.8), ROUND, &Mat4::from_translation(ankle - Vec3::Y * 0.4)));
        let sole = Mat4::from_translation(Vec3::new(ankle.x + 0.6 * side, 0.0, 2.2))
            * Mat4::from_rotation_y(0.14 * side)
            * Mat4::from_scale(Vec3::new(0.66, 1.0, 1.0));
        self.joints.extend(turned(&drum(6.0, 0.02, 1.3, 0.4), 0.72, &sole));
        self.shell.extend(turned(&shoe(), 0.72, &sole));
    }

    /// An arm through shoulder, elbow and wrist, and its hand, fingers along `reach`.
    fn arm(&mut self, [shoulder, elbow, wrist]: &[Vec3; 3], reach: Vec3) {
        self.joints.extend(turned(&ball(2.9), ROUND, &Mat4::from_translation(*shoulder)));
        self.limb(*shoulder, *elbow, 2.0);
        self.knob(*elbow, 1.9);
        self.limb(*elbow, *wrist, 2.3);
        let reach = reach.normalize();
        self.joints.extend(turned(&ring(1.2, 0.6), ROUND, &(facing(*wrist, reach))));
        let hand = facing(*wrist, reach);
        let length = elbow.distance(*wrist);
        self.joints.extend(turned(
            &drum(1.15, 0.8 * length, length + 0.5, 0.4),
            ROUND,
            &facing(*elbow, *wrist - *elbow),
        ));
        let palm = hand * Mat4::from_scale(Vec3::new(1.0, 1.0, 0.55));
        self.trim.extend(turned(&drum(2.6, 0.4, 4.4, 1.2), 0.75, &palm));
        for (x, lean) in [(-1.8, -0.22), (0.0, 0.0), (1.8, 0.22)] {
            self.finger(&(hand * Mat4::from_translation(Vec3::new(x, 4.2, 0.0)) * Mat4::from_rotation_z(-lean)));
        }
        let inward = -wrist.x.signum() * facing(*wrist, reach).transform_vector3(Vec3::X).x.signum();
        let thumb = Mat4::from_translation(Vec3::new(2.2 * inward, 1.6, 0.4)) * Mat4::from_rotation_z(-0.9 * inward);
        self.finger(&(hand * thumb));
    }

    fn finger(&mut self, at: &Mat4) {
        let bent = *at * Mat4::from_translation(Vec3::Y * 2.3) * Mat4::from_rotation_x(0.35);
        self.trim.extend(turned(&drum(0.75, -0.2, 2.0, 0.4), ROUND, at));
        self.joints.extend(turned(&ball(0.7), ROUND, &bent));
        self.trim.extend(turned(&drum(0.7, 0.3, 2.2, 0.6), ROUND, &bent));
    }

    /// A swelling limb between two joints.
    fn limb(&mut self, from: Vec3, to: Vec3, radius: f32) {
        let length = from.distance(to);
        let at = facing(from, to - from);
        self.shell.extend(turned(&drum(radius, 0.16 * length, 0.86 * length, 0.9), ROUND, &at));
        let cuff = at * Mat4::from_translation(Vec3::Y * (0.74 * length));
        self.trim.extend(turned(&ring(radius, 0.4), ROUND, &cuff));
    }

    /// A hinge, its pin to the front and back.
    fn knob(&mut self, at: Vec3, radius: f32) {
        self.joints.extend(turned(&ball(radius), ROUND, &Mat4::from_translation(at)));
        self.trim.extend(turned(&drum(0.55 * radius, -radius * 1.12, radius * 1.12, 0.3), ROUND, &facing(at, Vec3::Z)));
    }
}

/// Wide at the shoulders, narrow at the waist.
fn chest() -> Profile {
    let points = [
        (0.0, 0.0),
        (2.4, 0.0),
        (4.4, 0.0),
        (6.4, 0.0),
        (8.2, 0.0),
        (8.2, 1.6),
        (8.6, 3.4),
        (9.0, 6.0),
        (10.4, 8.0),
        (10.4, 11.0),
        (10.4, 13.6),
        (9.0, 15.0),
        (6.4, 15.0),
        (4.4, 15.0),
        (2.4, 15.0),
        (0.0, 15.0),
    ];
    points.map(Vec2::from).to_vec()
}

/// A toecap over a sole.
fn shoe() -> Profile {
    [
        (0.0, 1.1),
        (2.0, 1.1),
        (4.0, 1.1),
        (5.6, 1.1),
        (5.6, 2.4),
        (4.4, 3.6),
        (2.8, 3.8),
        (2.0, 3.9),
        (1.0, 3.9),
        (0.0, 3.9),
    ]
    .map(Vec2::from)
    .to_vec()
}

/// A place at `at` whose y points along `axis`; its z stays as near the world's as it can.
fn facing(at: Vec3, axis: Vec3) -> Mat4 {
    Mat4::from_translation(at) * Mat4::from_quat(Quat::from_rotation_arc(Vec3::Y, axis.normalize()))
}
