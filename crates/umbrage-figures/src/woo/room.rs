//! Woo 1992, Figures 2 and 3: a room under a wide spot, by biases and by midpoints.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{acne, leak};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel};
use crate::stage::set::Set;
use crate::stage::sphere_plane::false_shadow;
use std::sync::Arc;
use umbrage_bake::bake;
use umbrage_depth::{Midpoint, Tiled};
use umbrage_raster::Cull;
use umbrage_render::{Frame, Picture, Soup};
use umbrage_report::{Made, Measure, Panel};
use umbrage_scene::gallery;

/// The paper's old algorithm, and its own.
const OLD: &str = "reeves87,bias=0.2..0.4";
const NEW: &str = "woo92";

/// The room and the sphere before its slab, each at 256², with what the old rule and the new make of them.
pub struct Pair {
    pub room: Set,
    slab: Set,
}

impl Pair {
    pub fn new(cx: &Context) -> Self {
        let pixels = cx.pick(512, 256);
        Self {
            room: Set::new(gallery::spot_room(), pixels, 256).in_colour(),
            slab: Set::new(gallery::sphere_plane(), pixels, 256),
        }
    }
}

/// Border of the masks, in pixels: a region of ResFactor 3 and two texels of a 256² map.
fn border(cx: &Context) -> usize {
    cx.pick(12, 6)
}

pub const F2: Figure = Figure {
    id: "W92-F2",
    paper: Paper::Woo92,
    title: "A 256² map under a 75° spot, biases of .2 to .4",
    claim: "With a map of this size the old algorithm leaves surfaces noisy.",
    look: "the noise on walls and floor, compared with truth.",
    make: old,
};

fn old(cx: &Context) -> anyhow::Result<Made> {
    let Pair { room, slab } = Pair::new(cx);
    let (by_old, by_new) = (room.by(cx, OLD, &Frame::CENTRES)?, room.by(cx, NEW, &Frame::CENTRES)?);
    let (points, truth) = (room.truth_points(cx, &Frame::CENTRES), room.truth(cx));
    let (old, new) = (acne(&by_old, &points, border(cx), |_| true), acne(&by_new, &points, border(cx), |_| true));
    let slab_points = slab.truth_points(cx, &Frame::CENTRES);
    let on_slab = |recipe: &str| -> anyhow::Result<(f64, f64)> {
        Ok(false_shadow(&slab.by(cx, recipe, &Frame::CENTRES)?, &slab_points, border(cx)))
    };
    let (slab_old, slab_new) = (on_slab(OLD)?, on_slab(NEW)?);
    Ok(Made {
        panels: vec![
            Panel::rgb("full", "Old algorithm", by_old.size, by_old.colour.clone())
                .with("map", "256²")
                .with("bias", "0.2–0.4"),
            shadow_panel("shadow", "Its shadow alone", &by_old).against("truth"),
            truth_panel(&truth),
            error_panel("error", "Minus truth", truth.size, &by_old.shadow[0], &truth.shadow[0]),
        ],
        measures: vec![
            Measure::info("room: false shadow (M2)", old, "share"),
            Measure::at_least("the same over that of W92-F3", old / new, "ratio", 5.0),
            Measure::info("slab of SC-B: false shadow", slab_old.0, "share"),
            Measure::info("sphere of SC-B: false shadow", slab_old.1, "share"),
            Measure::at_least(
                "slab: that less five times that of midpoints",
                slab_old.0 - 5.0 * slab_new.0,
                "share",
                1e-4,
            ),
            Measure::at_least(
                "sphere: that less five times that of midpoints",
                slab_old.1 - 5.0 * slab_new.1,
                "share",
                1e-4,
            ),
        ],
        ..Made::default()
    })
}

pub const F3: Figure = Figure {
    id: "W92-F3",
    paper: Paper::Woo92,
    title: "The same room by midpoints, without a bias",
    claim: "Midpoints are clean at 256², cleaner than the old algorithm at 1024².",
    look: "the same walls and floor, clean at the same size; and the slab in the last picture, on which midpoints fail.",
    make: midpoints,
};

fn midpoints(cx: &Context) -> anyhow::Result<Made> {
    let Pair { room, slab } = Pair::new(cx);
    let (points, truth) = (room.truth_points(cx, &Frame::CENTRES), room.truth(cx));
    let by_new = room.by(cx, NEW, &Frame::CENTRES)?;
    let by_old = room.by(cx, OLD, &Frame::CENTRES)?;
    let large = Set::new(gallery::spot_room(), cx.pick(512, 256), 1024).by(cx, OLD, &Frame::CENTRES)?;
    let m2 = |picture: &Picture| acne(picture, &points, border(cx), |_| true);
    let m8 = |picture: &Picture| leak(picture, &points, 0);
    let slab_points = slab.truth_points(cx, &Frame::CENTRES);
    let on_slab = false_shadow(&slab.by(cx, NEW, &Frame::CENTRES)?, &slab_points, border(cx));
    let mut made = Made {
        panels: vec![
            Panel::rgb("full", "Midpoints", by_new.size, by_new.colour.clone())
                .with("map", "256²")
                .with("bias", "none"),
            shadow_panel("shadow", "Its shadow alone", &by_new).against("truth"),
            truth_panel(&truth),
            error_panel("error", "Minus truth", truth.size, &by_new.shadow[0], &truth.shadow[0]),
        ],
        measures: vec![
            Measure::at_most("room: false shadow away from silhouettes (M2)", m2(&by_new), "share", 0.005),
            Measure::info("room: old algorithm at 256²", m2(&by_old), "share"),
            Measure::at_most("less the old algorithm's at 1024²", m2(&by_new) - m2(&large), "share", -1e-4),
            Measure::at_most("room: leak beyond the old algorithm's (M8)", m8(&by_new) - m8(&by_old), "share", 0.005),
            Measure::at_most("slab of SC-B: false shadow", on_slab.0, "share", 0.005),
            Measure::at_most("sphere of SC-B: false shadow", on_slab.1, "share", 0.005),
        ],
        ..Made::default()
    };
    let (seen, false_new, false_old) = thin(cx)?;
    let caption = "Where it fails: a slab thinner than a texel's depth step";
    made.panels.push(shadow_panel("thin", caption, &seen).with("map", "256²").with("thickness", "0.4"));
    made.measures.push(Measure::at_least("thin slab: false shadow of midpoints", false_new, "share", 0.02));
    made.measures.push(Measure::info("thin slab: the old algorithm with a bias of 3 to 4 texels", false_old, "share"));
    made.note = "Midpoints fail where two surfaces are so close together that half their distance is less than a texel's depth step: the thin \
                 slab shadows itself in stripes."
        .into();
    Ok(made)
}

/// A slab .4 thick on which depth changes by more than half of that from texel to texel: the picture, and false shadow on the slab by
/// midpoints and by the old algorithm.
fn thin(cx: &Context) -> anyhow::Result<(Picture, f64, f64)> {
    const SLAB: u32 = 0;
    let set = Set::new(gallery::thin_slab(), cx.pick(512, 256), 256);
    let points = set.truth_points(cx, &Frame::CENTRES);
    let (new, old) = (set.by(cx, NEW, &Frame::CENTRES)?, set.by(cx, "reeves87,bias=3..4t", &Frame::CENTRES)?);
    let on_slab = |picture: &Picture| acne(picture, &points, border(cx), |id| id == SLAB);
    let found = (on_slab(&new), on_slab(&old));
    Ok((new, found.0, found.1))
}

/// Midpoints from light 0, in the size of its map.
pub fn middle_map(set: &Set) -> Arc<Tiled> {
    let view = set.scene.lights[0].view;
    bake(&view, Soup::casters(&set.scene, &view).triangles(), &Midpoint::default(), Cull::None).map
}
