//! What Wang & Molnar 1994 say of others: object tags (Hourcade & Nicolas), and wide filters that need a wide bias.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{acne, lit, of, shadow_grid, value};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel};
use crate::stage::set::Set;
use crate::stage::tilted_plane::{on_plane, tilted};
use glam::{DVec3, UVec2, Vec3};
use std::sync::Arc;
use umbrage_bake::bake_tags;
use umbrage_depth::{TagMap, Tiled};
use umbrage_oracle::{metrics, predict};
use umbrage_plane::{SurfacePoint, TexelRect, View, mix32};
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, Picture, Soup};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Panel, Role, Table};
use umbrage_sample::Key;
use umbrage_scene::{Light, Material, Mesh, Object, Scene, Shape, gallery};
use umbrage_shadow::Tags;

pub const TAGS: Figure = Figure {
    id: "WM94-tags",
    paper: Paper::WangMolnar94,
    title: "Object tags instead of depths",
    claim: "With one tag per polygon, edges between polygons are falsely dark; with one tag per object, no object can shadow itself.",
    look: "the dark lines along edges between polygons, and the missing shadow of an object on itself.",
    make: tags,
};

/// A ring that leans over a slab and shades its own far side, and a ball.
fn ring() -> anyhow::Result<Scene> {
    let grey = Material::matt(Vec3::new(0.54, 0.52, 0.48));
    let red = Material::plastic(Vec3::new(0.70, 0.14, 0.08));
    let blue = Material::plastic(Vec3::new(0.12, 0.26, 0.66));
    let objects = vec![
        Object::solid("slab", Mesh::cuboid(Vec3::new(-50.0, -10.0, -50.0), Vec3::new(50.0, 0.0, 50.0)), grey),
        Object::solid("ring", Mesh::torus(Vec3::new(-8.0, 20.0, 0.0), Vec3::new(1.0, 0.55, 0.3), 15.0, 5.0, 48), red),
        Object::solid("ball", Mesh::sphere(Vec3::new(24.0, 9.0, 16.0), 9.0, 24), blue),
    ];
    let lamp =
        Light::point("lamp", DVec3::new(-90.0, 90.0, 50.0), DVec3::new(0.0, 8.0, 0.0), 46.0, 40.0, 260.0, UVec2::ONE)?;
    let camera = View::perspective(
        DVec3::new(26.0, 52.0, 104.0),
        DVec3::new(2.0, 9.0, 0.0),
        DVec3::Y,
        42f64.to_radians(),
        10.0,
        400.0,
        UVec2::splat(512),
    )?;
    let (ambient, background) = (Vec3::splat(0.15), Vec3::new(0.02, 0.02, 0.03));
    Ok(Scene { name: "ring".into(), origin: DVec3::ZERO, objects, lights: vec![lamp], ambient, background, camera })
}

/// The same surfaces with each triangle an object of its own, and the object that each was part of.
fn split(scene: &Scene) -> (Scene, Vec<u32>) {
    let (mut objects, mut whole) = (Vec::new(), Vec::new());
    for (id, object) in scene.objects.iter().enumerate() {
        let mesh = object.shape.mesh_for(&scene.camera);
        for triangle in &mesh.triangles {
            let corner = |list: &[Vec3]| triangle.map(|index| list[index as usize]).to_vec();
            let piece = Mesh {
                positions: corner(&mesh.positions),
                normals: corner(&mesh.normals),
                triangles: vec![[0, 1, 2]],
                surfaces: vec![0],
                ..Mesh::default()
            };
            objects.push(Object { shape: Shape::Mesh(piece), ..object.clone() });
            whole.push(id as u32);
        }
    }
    (Scene { name: format!("{}, split", scene.name), objects, ..scene.clone() }, whole)
}

fn tagged(scene: &Scene) -> Tags {
    let light = scene.lights[0].view;
    Tags(bake_tags(&light, Soup::casters(scene, &light).triangles()))
}

/// Tags as colours that distinguish neighbours.
fn tag_panel(name: &str, caption: &str, map: &TagMap) -> Panel {
    let colour = |id: u32| {
        let bits = mix32(id.wrapping_mul(0x9e37_79b9) ^ 0x51);
        let channel = |shift: u32| 0.12 + 0.75 * f32::from((bits >> shift) as u8) / 255.0;
        Vec3::new(channel(0), channel(8), channel(16))
    };
    let size = map.view().size();
    let pixels = TexelRect::of_size(size).texels().map(|texel| map.id(texel).map_or(Vec3::ZERO, colour)).collect();
    Panel::rgb(name, caption, size, pixels).role(Role::Map)
}

/// Pixels, seen one by one, beside a neighbour of another triangle of the same object.
fn beside_edges(pieces: &Picture, whole: &[u32]) -> Vec<bool> {
    let width = pieces.size.x as usize;
    let of = |piece: u32| whole.get(piece as usize);
    let edge = |i: usize, j: usize| {
        let (a, b) = (pieces.object[i], pieces.object[j]);
        a != b && of(a).is_some() && of(a) == of(b)
    };
    let mut mask = vec![false; pieces.object.len()];
    for i in 0..mask.len() {
        for j in [i + 1, i + width] {
            if j < mask.len() && (j != i + 1 || j % width != 0) && edge(i, j) {
                (mask[i], mask[j]) = (true, true);
            }
        }
    }
    metrics::grown(&mask, width, 1)
}

fn tags(cx: &Context) -> anyhow::Result<Made> {
    const RING: u32 = 1;
    let set = Set::new(ring()?, cx.pick(512, 256), cx.pick(512, 256));
    let (pieces, whole) = split(&set.scene);
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let (objects, polygons) = (tagged(&set.scene), tagged(&pieces));
    let by_object = set.draw(cx, &objects, &Frame::CENTRES);
    let of_pieces = Set::of(pieces);
    let by_polygon = of_pieces.draw(cx, &polygons, &Frame::CENTRES);
    let by_second = set.by(cx, "wang-molnar94", &Frame::CENTRES)?;
    let border = cx.pick(4, 3);
    let light = set.scene.lights[0].view;
    // A texel at a silhouette may keep what stands behind it.
    let far = metrics::silhouette_distance(&light, &set.scene, &truth.position, 4.0);
    let clear: Vec<bool> = far.iter().map(|&texels| texels > 1.0).collect();
    let lit_pixels = metrics::both(&lit(&truth, border, |_| true), &clear);
    let edges = metrics::both(&beside_edges(&by_polygon, &whole), &lit_pixels);
    let inner: Vec<bool> = lit_pixels.iter().zip(&edges).map(|(lit, edge)| *lit && !edge).collect();
    let false_on = |picture: &Picture, mask: &[bool]| value(metrics::false_shadow(&picture.shadow[0], mask));
    // Where the ring stands in its own light, by truth: dark, turned to the light, and the ring nearest to it.
    let dark = metrics::dark_mask(shadow_grid(&truth), &truth.facing[0], border, 0.05);
    let own = |i: usize| {
        let seen = light.receiver(&SurfacePoint::at(truth.position[i], truth.normal[i]));
        seen.is_ok_and(|seen| objects.0.id(seen.footprint.centre.floor().as_ivec2()) == Some(RING))
    };
    let ring = metrics::both(&dark, &of(&truth, |id| id == RING));
    let own: Vec<bool> = (0..ring.len()).map(|i| ring[i] && own(i)).collect();
    let kept = |picture: &Picture| value(metrics::mean(&picture.shadow[0], &own));
    let count = |mask: &[bool]| mask.iter().filter(|inside| **inside).count() as f64;
    let slab = metrics::both(&lit_pixels, &of(&truth, |id| id != RING));
    Ok(Made {
        panels: vec![
            shadow_panel("by-polygon", "One tag per polygon", &by_polygon).with("map", light.size().x).against("truth"),
            shadow_panel("by-object", "One tag per object", &by_object).with("map", light.size().x).against("truth"),
            shadow_panel("second", "Second depths, no bias", &by_second).with("map", light.size().x).against("truth"),
            truth_panel(&truth),
            error_panel("error-polygon", "One tag per polygon, minus truth", truth.size, &by_polygon.shadow[0], &truth.shadow[0]),
            error_panel("error-object", "One tag per object, minus truth", truth.size, &by_object.shadow[0], &truth.shadow[0]),
            tag_panel("map-polygon", "The map with one tag per polygon", &polygons.0),
            tag_panel("map-object", "The map with one tag per object", &objects.0),
        ],
        measures: vec![
            Measure::at_least("a tag a polygon: false shadow beside polygons' edges", false_on(&by_polygon, &edges), "share", 0.1),
            Measure::at_most("a tag a polygon: false shadow elsewhere", false_on(&by_polygon, &inner), "share", 0.01),
            Measure::exactly("a tag an object: false shadow of what is lit, off silhouettes", false_on(&by_object, &lit_pixels), "share", 0.0),
            Measure::info("lit pixels beside polygons' edges", count(&edges), "px"),
            Measure::info("lit pixels off the ring", count(&slab), "px"),
            Measure::at_least("pixels in which the ring shadows itself, by rays", count(&own), "px", cx.pick(500.0, 50.0)),
            Measure::exactly("of that shadow a tag an object finds", kept(&by_object), "share", 0.0),
            Measure::at_least("of that shadow second depths find", kept(&by_second), "share", 0.98).full_size(cx.quick),
        ],
        note: "Tags need no bias, but hold no distance. With one tag for the whole ring, the ring is lit wherever it is itself the nearest surface to the \
            light."
            .into(),
        ..Made::default()
    })
}

pub const PCF_BIAS: Figure = Figure {
    id: "WM94-pcfbias",
    paper: Paper::WangMolnar94,
    title: "A wider filter needs a larger bias",
    claim: "The smallest bias without false shadow grows in proportion to the filter's half-width.",
    look: "the wide filter's stripes at a bias that is enough for the narrow one.",
    make: pcf_bias,
};

/// What the smallest bias may leave (M2).
const CLEAN: f64 = 1e-3;

/// Mean false shadow over places of a plane tilted by `normal`, under a filter of `radius` texels and a bias in world units.
fn false_shadow(cx: &Context, map: &Arc<Tiled>, normal: DVec3, radius: f64, bias: f64) -> anyhow::Result<f64> {
    let points = cx.pick(6000, 1500);
    let recipe: Recipe = format!("reeves87,samples=64,res-factor=0,min-size={radius},bias={bias}").parse()?;
    let shadow = recipe.bind(map, cx.storage)?;
    let key = Key::new(cx.seed, 0, 0);
    let place = |i, axis| f64::from(key.signed(i, axis)) * 7.0;
    let receivers: Vec<SurfacePoint> = (0..points)
        .map(|i| SurfacePoint {
            region: i,
            ..SurfacePoint::at(on_plane(normal, place(i, 0), place(i, 1)), normal.as_vec3())
        })
        .collect();
    let mut shares = vec![0.0; receivers.len()];
    shadow.fractions(&receivers, key, &mut shares);
    Ok(shares.iter().map(|&share| f64::from(share)).sum::<f64>() / f64::from(points))
}

/// The smallest bias that leaves less than [`CLEAN`], to a hundredth of a depth step.
fn smallest(cx: &Context, map: &Arc<Tiled>, normal: DVec3, radius: f64, step: f64) -> anyhow::Result<f64> {
    let (mut low, mut high) = (0.0, (radius + 1.0) * step);
    while high - low > 0.01 * step {
        let middle = f64::midpoint(low, high);
        if false_shadow(cx, map, normal, radius, middle)? < CLEAN { high = middle } else { low = middle }
    }
    Ok(high)
}

fn pcf_bias(cx: &Context) -> anyhow::Result<Made> {
    let radii: &[f64] = if cx.quick { &[1.0, 4.0, 8.0] } else { &[0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0] };
    let slope = 60f64.to_radians().tan();
    let (mut measures, mut rows) = (Vec::new(), Vec::new());
    let mut plot = Plot::new(
        "False shadow below 0.001 on a plane tilted 60°",
        Axis::linear("half-width of the filter, texels"),
        Axis::linear("smallest bias, world units"),
    );
    for (name, azimuth) in
        [("slope along an axis", 0.0f64), ("slope at 30° to it", 30.0), ("slope along the diagonal", 45.0)]
    {
        let (sin, cos) = azimuth.to_radians().sin_cos();
        let normal = DVec3::new(-slope * cos, -slope * sin, 1.0).normalize();
        let (view, map) = tilted(normal)?;
        let step = view.texel_world(200.0).x * slope;
        let both = step * (sin + cos);
        let found: Vec<(f64, f64)> = radii
            .iter()
            .map(|&radius| Ok((radius, smallest(cx, &map, normal, radius, both)?)))
            .collect::<anyhow::Result<_>>()?;
        for (radius, bias) in &found {
            let limit = predict::acne_free_bias(step * cos, step * sin, *radius);
            rows.push(vec![name.into(), radius.to_string(), format!("{bias:.4}"), format!("{limit:.4}")]);
        }
        let fit = metrics::linear_fit(&found);
        let (grows, straight) = fit.map_or((f64::NAN, f64::NAN), |fit| (fit.slope / both, fit.r2));
        measures.push(Measure::within(&format!("{name}: bias a texel over g₁ + g₂"), grows, "ratio", 0.85, 1.15));
        measures.push(Measure::at_least(&format!("{name}: R² of the straight line"), straight, "", 0.99));
        let limit = |radius: &f64| (*radius, predict::acne_free_bias(step * cos, step * sin, *radius));
        plot = plot
            .add(Series::line(&format!("{name}, limit of D-9"), radii.iter().map(limit).collect()))
            .add(Series::dots(&format!("{name}, measured"), found));
    }
    let head = ["plane", "half-width, texels", "smallest bias", "limit of D-9"].map(String::from).to_vec();
    let set = Set::new(gallery::sphere_plane(), cx.pick(512, 256), cx.pick(512, 256));
    let by = |recipe: &str| set.by(cx, recipe, &Frame::CENTRES);
    let narrow = by("reeves87,res-factor=0,min-size=1,bias=0.5")?;
    let wide = by("reeves87,res-factor=0,min-size=6,bias=0.5")?;
    let plane = by("reeves87,res-factor=0,min-size=6,depth=plane,bias=0.02")?;
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let found = [&narrow, &wide, &plane].map(|picture| acne(picture, &truth, cx.pick(12, 8), |_| true));
    measures.extend([
        Measure::at_most("sphere and plane, bias 0.5, half-width 1: false shadow", found[0], "share", 0.01)
            .full_size(cx.quick),
        Measure::at_least("the same, half-width 6", found[1], "share", 0.05).full_size(cx.quick),
        Measure::info("the same on the tangent plane, bias 0.02", found[2], "share"),
    ]);
    Ok(Made {
        panels: vec![
            shadow_panel("narrow", "Half-width 1 texel", &narrow).with("bias", "0.5").against("truth"),
            shadow_panel("wide", "Half-width 6 texels, the same bias", &wide).with("bias", "0.5").against("truth"),
            shadow_panel("tangent", "Half-width 6 texels on the tangent plane", &plane)
                .with("bias", "0.02")
                .against("truth"),
            truth_panel(&truth),
            error_panel("error-narrow", "Half-width 1, minus truth", truth.size, &narrow.shadow[0], &truth.shadow[0]),
            error_panel("error-wide", "Half-width 6, minus truth", truth.size, &wide.shadow[0], &truth.shadow[0]),
        ],
        plots: vec![("bias".into(), plot.svg())],
        tables: vec![Table { name: "bias".into(), head, rows }],
        measures,
        note: "The measured lines lie a little below the limit, because a thousandth of the samples may still be dark."
            .into(),
        ..Made::default()
    })
}
