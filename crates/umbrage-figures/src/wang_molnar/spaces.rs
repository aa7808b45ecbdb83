//! Wang & Molnar 1994, Figure 11: the coordinate systems of camera, light and world.

use super::planes::{POINT, lamp};
use crate::figure::{Context, Figure, Paper};
use crate::stage::slices::{self, Slice, disc, rectangle};
use glam::{DMat4, DVec2, DVec3, DVec4, UVec2};
use umbrage_plane::{Kind, View};
use umbrage_report::diagram::{Diagram, Ink, Mark};
use umbrage_report::{Made, Measure};
use umbrage_sample::Key;
use umbrage_scene::gallery;

pub const F11: Figure = Figure {
    id: "WM94-F11",
    paper: Paper::WangMolnar94,
    title: "Coordinate systems",
    claim: "Four matrices lead from the world to either eye space and either screen space, and back without loss.",
    look: "the measures: each round trip ends where it began, up to rounding.",
    make: spaces,
};

/// The matrices of one view: world to eye, eye to screen.
fn matrices(view: &View) -> (DMat4, DMat4) {
    let eye = view.world_to_eye();
    (eye, view.world_to_screen() * eye.inverse())
}

/// Largest errors of a way there and back, over random points that both views see.
#[derive(Default)]
struct Trips {
    eye: f64,
    screen: f64,
    light_screen: f64,
    between: f64,
    texel: f64,
    plane: f64,
    depth: f64,
    points: u32,
}

fn trips(camera: &View, light: &View, key: Key, tries: u32, size: f64) -> Trips {
    let ((m_c, m_pc), (m_l, m_pl)) = (matrices(camera), matrices(light));
    let (to_c, to_l) = (m_pc * m_c, m_pl * m_l);
    let between = to_l * to_c.inverse();
    let mut worst = Trips::default();
    for i in 0..tries {
        let place = |dim| f64::from(key.signed(i, dim));
        let p = DVec3::new(place(0), place(1), place(2)) * size;
        let normal = DVec3::new(place(3), place(4), place(5)).normalize_or(DVec3::Y);
        let (in_c, in_l) = (to_c.project_point3(p), to_l.project_point3(p));
        if [in_c, in_l].iter().any(|at| at.truncate().abs().max_element() > 1.0 || !(0.0..=1.0).contains(&at.z)) {
            continue;
        }
        worst.points += 1;
        let grow = |worst: &mut f64, error: f64| *worst = worst.max(error);
        grow(&mut worst.eye, m_c.inverse().transform_point3(m_c.transform_point3(p)).distance(p));
        grow(&mut worst.screen, to_c.inverse().project_point3(in_c).distance(p));
        grow(&mut worst.light_screen, to_l.inverse().project_point3(in_l).distance(p));
        grow(&mut worst.between, between.inverse().project_point3(between.project_point3(in_c)).distance(in_c));
        let zeta = -m_l.transform_point3(p).z;
        let texel = light.eye_to_texel(m_l.transform_point3(p));
        grow(&mut worst.texel, light.world_at(texel, light.key(zeta)).distance(p));
        if normal.dot(light.toward_eye(p)).abs() > 0.1 {
            let t_w = normal.extend(-normal.dot(p));
            let t_l: DVec4 = to_l.inverse().transpose() * t_w;
            grow(&mut worst.plane, (t_l.dot(in_l.extend(1.0)) / t_l.length()).abs());
            // The paper's linear expression against ours, a texel aside.
            let beside = texel + DVec2::ONE;
            let screen = DVec2::new(2.0, -2.0) * beside / light.size().as_dvec2() + DVec2::new(-1.0, 1.0);
            let listed = -(t_l.x * screen.x + t_l.y * screen.y + t_l.w) / t_l.z;
            let plane = light.with_kind(Kind::Screen).affine(m_l.transform_point3(p), m_l.transform_vector3(normal));
            grow(&mut worst.depth, plane.map_or(f64::NAN, |plane| (plane.at(beside) - listed).abs()));
        }
    }
    worst
}

fn spaces(cx: &Context) -> anyhow::Result<Made> {
    let scene = gallery::sphere_plane();
    let tries = cx.pick(200_000, 20_000);
    let found = trips(&scene.camera, &scene.lights[0].view, Key::new(cx.seed, 0, 0), tries, 60.0);
    // V35 and V38.
    let light = lamp(Kind::Screen)?;
    let ahead = DVec3::new(0.0, 5.0, 10.0) + DVec3::new(0.0, -0.4, -1.0);
    let eye = DVec3::new(0.0, 5.0, 10.0);
    let camera = View::perspective(eye, ahead, DVec3::Y, 60f64.to_radians(), 1.0, 100.0, UVec2::splat(64))?;
    let in_c = camera.world_to_screen().project_point3(POINT);
    let wanted = DVec3::new(0.255_544_631_6, 0.142_360_340_3, 0.935_586_483_9);
    let in_l = (light.world_to_screen() * camera.world_to_screen().inverse()).project_point3(in_c);
    let v35 = DVec3::new(2.0 / 9.0, 1.0 / 3.0, 0.897_867_564_534);
    let trip = |name: &str, error: f64, unit: &str| Measure::at_most(name, error, unit, 1e-9);
    Ok(Made {
        plots: vec![("frames".into(), frames()?), ("matrices".into(), graph())],
        measures: vec![
            trip("world, camera eye, world", found.eye, "world units"),
            trip("world, camera screen, world", found.screen, "world units"),
            trip("world, light screen, world", found.light_screen, "world units"),
            trip("camera screen, light screen, camera screen", found.between, "screen units"),
            trip("world, map texel and depth, world", found.texel, "world units"),
            trip("point off its plane in light screen space", found.plane, "screen units"),
            trip("the paper's virtual depth less ours", found.depth, "z_s"),
            Measure::at_least("random points that both views see", f64::from(found.points), "points", 1000.0),
            trip("V38: camera screen less its digits", (in_c - wanted).abs().max_element(), "screen units"),
            trip("V38: light screen less V35", (in_l - v35).abs().max_element(), "screen units"),
        ],
        note: "M_C is `View::world_to_eye` of the camera and M_PC M_C its `View::world_to_screen`; M_L and M_PL likewise of the light: eye and light are one \
            type."
            .into(),
        ..Made::default()
    })
}

/// Both views over one slice, with their axes.
fn frames() -> anyhow::Result<String> {
    let (light_at, eye_at) = (DVec2::new(-26.0, 30.0), DVec2::new(30.0, 22.0));
    let light = slices::lamp(light_at.into(), [0.0, 2.0], 44.0, 9)?;
    let camera = slices::eye(eye_at.into(), [0.0, 3.0], 40.0, 9)?;
    let slice = Slice::new(
        "frames",
        vec![rectangle([-40.0, -4.0], [40.0, 0.0]), rectangle([-10.0, 0.0], [-3.0, 9.0]), disc([8.0, 5.0], 5.0)],
        &light,
        &camera,
    )?;
    let mut diagram = slice.outlined(Diagram::new(
        "Camera, light and world in one slice",
        DVec2::new(-42.0, -6.0),
        DVec2::new(44.0, 40.0),
    ));
    for (name, view, ink, half) in [("camera", camera, Ink::Series(0), 20f64), ("light", light, Ink::Series(1), 22.0)] {
        let origin = view.light().truncate().truncate();
        let ahead = view.ahead().truncate();
        let ray = |turn: f64, far: f64| origin + DVec2::from_angle(turn.to_radians()).rotate(ahead) * far;
        let (near, far) = (8.0 / half.to_radians().cos(), 60.0);
        diagram = diagram
            .draw(Mark::Line(1.2), ink, &[ray(half, far), origin, ray(-half, far)])
            .draw(Mark::Line(2.4), ink, &[ray(half, near), ray(-half, near)])
            .arrow(ink, origin, origin - ahead * 7.0)
            .arrow(ink, origin, origin - ahead.perp() * 7.0)
            .text(ink, origin - ahead * 9.0, "z")
            .text(ink, origin - ahead.perp() * 9.0, "x")
            .draw(Mark::Dots(4.0), ink, &[origin])
            .key(Mark::Line(2.4), ink, &format!("{name}: eye at the dot, screen across"));
    }
    let diagram = diagram
        .arrow(Ink::Plain, DVec2::ZERO, DVec2::X * 8.0)
        .arrow(Ink::Plain, DVec2::ZERO, DVec2::Y * 8.0)
        .text(Ink::Plain, DVec2::new(8.0, -2.0), "x")
        .text(Ink::Plain, DVec2::new(0.0, 9.8), "y")
        .key(Mark::Line(1.8), Ink::Plain, "world; the y axis of both eyes points out of the page");
    Ok(diagram.svg())
}

/// Which matrix leads where.
fn graph() -> String {
    let boxes = [
        (DVec2::new(50.0, 46.0), "World", Ink::Plain),
        (DVec2::new(20.0, 26.0), "Camera eye", Ink::Series(0)),
        (DVec2::new(20.0, 6.0), "Camera screen", Ink::Series(0)),
        (DVec2::new(80.0, 26.0), "Light eye", Ink::Series(1)),
        (DVec2::new(80.0, 6.0), "Light screen", Ink::Series(1)),
    ];
    let mut diagram = Diagram::new("From space to space", DVec2::new(0.0, -5.0), DVec2::new(100.0, 53.0));
    for (at, name, ink) in boxes {
        let half = DVec2::new(14.0, 4.0);
        let outline = rectangle((at - half).into(), (at + half).into());
        diagram = diagram.draw(Mark::Area, ink, &outline).text(Ink::Plain, at, name);
    }
    let arrow = |diagram: Diagram, ink, from: [f64; 2], to: [f64; 2]| diagram.arrow(ink, from.into(), to.into());
    let (camera, light) = (Ink::Series(0), Ink::Series(1));
    diagram = arrow(diagram, camera, [42.0, 41.5], [25.0, 30.8]);
    diagram = arrow(diagram, camera, [20.0, 21.5], [20.0, 10.8]);
    diagram = arrow(diagram, light, [58.0, 41.5], [75.0, 30.8]);
    diagram = arrow(diagram, light, [80.0, 21.5], [80.0, 10.8]);
    diagram = arrow(diagram, Ink::Plain, [34.5, 6.0], [65.5, 6.0]);
    diagram
        .text_to(camera, DVec2::new(31.0, 37.8), "M_C")
        .text_from(camera, DVec2::new(22.0, 16.0), "M_PC, then ÷ w")
        .text_from(light, DVec2::new(69.0, 37.8), "M_L")
        .text_to(light, DVec2::new(78.0, 16.0), "M_PL, then ÷ w")
        .text(Ink::Plain, DVec2::new(50.0, 9.0), "(M_PL M_L)(M_PC M_C)⁻¹")
        .text(Ink::Plain, DVec2::new(50.0, -1.6), "a point by a matrix, a plane by its inverse transposed")
        .svg()
}
