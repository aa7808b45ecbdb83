//! Maps of the bicycle shop that are never held as a whole: baked to disk in bands, looked up page by page.

use super::quantity::Quantity;
use glam::UVec2;
use umbrage_bake::{Streaming, bake_streamed};
use umbrage_depth::First;
use umbrage_io::{Paged, create_folder, file_bytes, remove_folder, write_shadow_map_by_rows};
use umbrage_plane::Bias;
use umbrage_raster::Cull;
use umbrage_render::{Frame, Soup, picture};
use umbrage_scene::gallery::bicycle_shop;
use umbrage_shadow::{Biased, Pcf, ShadowMap};

/// Bytes for the part of the map that is drawn, and for triangles.
const BUDGET: usize = 512 << 20;
/// Pages that are kept: 256 MiB of 64×64 texels.
const PAGES: usize = 1 << 14;
/// Side of the picture, pixels.
const PICTURE: u32 = 1024;
/// World units, the shop being about 100 wide.
const BIAS: f32 = 0.2;

pub(super) fn measure(side: u32) -> Result<Vec<Quantity>, Box<dyn std::error::Error>> {
    let mut scene = bicycle_shop();
    scene.camera = scene.camera.with_size(UVec2::splat(PICTURE))?;
    let view = scene.lights[0].view.with_size(UVec2::splat(side))?;
    let folder = std::env::temp_dir().join(format!("umbrage-scale-{}", std::process::id()));
    create_folder(&folder)?;
    let path = folder.join("map.exr");
    let soup = Soup::casters(&scene, &view);
    let (bake, written) = Quantity::timed("bake to disk", || {
        write_shadow_map_by_rows(&path, "pendant", &view, umbrage_depth::Stored::First, |rows| {
            bake_streamed(
                &view,
                || soup.triangles(),
                &First,
                Cull::None,
                Streaming::within(BUDGET),
                |row| rows.push(&row),
            )
        })
    });
    let measured = written.and_then(|_| {
        let file = Quantity { what: "file", unit: "MiB", value: file_bytes(&path)? as f64 / 1_048_576.0 };
        let (map, handle) = Paged::open(&path, PAGES)?;
        let shadow = ShadowMap { filter: Pcf::default().with_depth(Biased::constant(Bias::World(BIAS))), map };
        let (look, seen) =
            Quantity::timed("picture through its pages", || picture(&scene, &[&shadow], &Frame::CENTRES));
        assert!(handle.error().is_none(), "{:?}", handle.error());
        let dark = seen.shadow[0].iter().map(|dark| f64::from(*dark)).sum::<f64>() / seen.shadow[0].len() as f64;
        assert!((0.02..0.9).contains(&dark), "{dark} of the picture is in shadow");
        Ok(vec![bake, look, file])
    });
    remove_folder(&folder)?;
    Ok(measured?)
}
