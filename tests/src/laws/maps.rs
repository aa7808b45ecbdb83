//! Laws over maps of a real scene and receivers of all kinds.

use super::subject::{Found, KEY, Subject, check, same, size};
use glam::{DVec3, UVec2, Vec2};
use std::sync::{Arc, LazyLock};
use umbrage_bake::bake;
use umbrage_depth::{DepthMap, First, Map, Storage, Tiled};
use umbrage_plane::{Footprint, Kind, Receiver, Sampling, SurfacePoint};
use umbrage_raster::Cull;
use umbrage_render::Soup;
use umbrage_scene::gallery;

/// The sphere over its plane as a light sees it, in a map whose sides are not whole numbers of tiles.
///
/// # Panics
/// Never: the size is valid.
pub fn baked(kind: Kind, sampling: Sampling) -> Arc<Tiled> {
    let mut scene = gallery::sphere_plane();
    let view = scene.lights[0].view.with_size(UVec2::new(211, 157)).expect("a valid size");
    let view = view.with_kind(kind).with_sampling(sampling);
    scene.objects[1].casts = kind != Kind::Radial;
    bake(&view, Soup::casters(&scene, &view).triangles(), &First, Cull::None).map
}

/// One map of each kind of depth and each way to place samples.
static MAPS: LazyLock<[Arc<Tiled>; 4]> = LazyLock::new(|| {
    [
        (Kind::Axial, Sampling::Centre),
        (Kind::Axial, Sampling::Jittered { seed: 9 }),
        (Kind::Screen, Sampling::Centre),
        (Kind::Radial, Sampling::Centre),
    ]
    .map(|(kind, sampling)| baked(kind, sampling))
});

/// Receivers all over the map and a little beyond, most of them near the stored depth; quadrilateral footprints of all sizes.
pub fn receivers(map: &impl DepthMap, count: u32) -> Vec<Receiver> {
    let view = map.view();
    (0..count)
        .filter_map(|i| {
            let draw = |dim| KEY.unit(i, dim);
            let at = Vec2::new(draw(0), draw(1)) * (size(map) + 12.0) - 6.0;
            let stored = f64::from(map.depth(at.floor().as_ivec2()));
            let near = if stored.is_finite() && view.kind() == Kind::Axial { stored } else { 105.0 };
            let zeta = near * (1.0 + 0.02 * f64::from(KEY.signed(i, 2)));
            let world = view.world_at(at.as_dvec2(), view.key(zeta));
            let normal = DVec3::new(f64::from(draw(3)) - 0.5, f64::from(draw(4)) - 0.5, 1.0).normalize();
            let seen = view.receiver(&SurfacePoint::at(world.as_vec3(), normal.as_vec3())).ok()?;
            let half = (draw(5) * 7.0).exp2() * 0.25;
            let corners = [(-1.0, -0.3), (0.4, -1.0), (1.0, 0.5), (-0.2, 1.0)];
            let footprint = Footprint::around(corners.map(|(x, y)| seen.footprint.centre + Vec2::new(x, y) * half));
            Some(Receiver { footprint, ..seen })
        })
        .collect()
}

/// Raw, bounding box, tiles; the machine's instructions and the least that every machine has.
pub fn storages(subject: &Subject) -> Found {
    for tiled in &*MAPS {
        let map = Map::from(tiled);
        let kept = [Storage::Raw, Storage::Bbox, Storage::Tiled].map(|storage| subject.kept(map.clone().kept(storage)));
        let map = subject.kept(map);
        for (i, receiver) in receivers(tiled, 2000).iter().enumerate() {
            let key = KEY.region(i as u32);
            let [raw, boxed, tiled] = kept.each_ref().map(|map| subject.of(map, receiver, key));
            same("receiver", i, &[raw, boxed, tiled, subject.of_baseline(&map, receiver, key)])?;
        }
    }
    Ok(())
}

/// Whatever the footprint: a point, a line, wider than the map; whatever the slope, edge-on included.
pub fn bounded(subject: &Subject) -> Found {
    let map = subject.kept(Map::from(&MAPS[0]));
    for (i, receiver) in receivers(&map, 300).into_iter().enumerate() {
        let centre = receiver.footprint.centre;
        let halves = [Vec2::ZERO, Vec2::new(3.0, 0.0), Vec2::new(0.0, 1e-20), size(&map) * 4.0];
        for half in halves {
            let edge_on = Receiver { facing: 0.0, slope: f32::INFINITY, normal: DVec3::X, ..receiver };
            for seen in [receiver, edge_on] {
                let seen = Receiver { footprint: Footprint::boxed(centre, half), ..seen };
                let found = subject.of(&map, &seen, KEY.region(i as u32));
                check((0.0..=1.0).contains(&found), || format!("{found} for a footprint of {half} to each side"))?;
            }
        }
    }
    Ok(())
}
