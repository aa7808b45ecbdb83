//! Cameras, and a sensible one for a scene without.

use crate::error::quoted;
use crate::file::File;
use crate::json::At;
use crate::nodes::Nodes;
use crate::note::Level;
use crate::sight::{Sight, Things};
use crate::{GltfError, ReadOptions};
use glam::{DVec2, DVec3, UVec2};
use umbrage_plane::{Projection, View};

/// Rows of a picture whose size nobody gave.
const ROWS: u32 = 512;
/// Most columns of it.
const MOST: f64 = 32_768.0;

/// The camera that was chosen, the scene's first one, or one that sees all.
pub(crate) fn camera(file: &File, nodes: &Nodes, things: &Things, options: &ReadOptions) -> Result<View, GltfError> {
    let count = file.count("cameras")?;
    let mut names = Vec::new();
    for &number in &nodes.shown {
        let node = &nodes.all[number];
        let Some(camera) = node.at.index("camera", count, "cameras")? else { continue };
        let camera = file.member("cameras", camera)?;
        let own = [node.at.name(), camera.name()];
        if options.camera.as_deref().is_none_or(|wanted| own.contains(&Some(wanted))) {
            return of_file(&camera, Sight::of(node.world, &node.at.path)?, things, options.size);
        }
        names.extend(own.into_iter().flatten().next().map(quoted));
    }
    if let Some(wanted) = &options.camera {
        names.truncate(8);
        let expected = if names.is_empty() {
            "no name, since none has one".into()
        } else {
            format!("one of {}", names.join(", "))
        };
        return Err(GltfError::field("cameras", quoted(wanted), expected));
    }
    file.note(Level::Always, "the scene has no camera: one that looks down on all of it was added");
    three_quarter(things, options.size)
}

fn of_file(camera: &At, sight: Sight, things: &Things, size: Option<UVec2>) -> Result<View, GltfError> {
    const POSITIVE: &str = "a number above 0";
    let part = |name: &str| camera.get(name).ok_or_else(|| camera.wrong(name, "an object"));
    let needed = |at: &At, name: &str| at.number_in(name, f64::NAN, |number| number > 0.0, POSITIVE);
    let made = |at: &At, projection, near, far, size| {
        View::new(sight.world_to_eye(), projection, near, far, size)
            .map_err(|fault| GltfError::View { path: at.path.clone(), fault })
    };
    match camera.text("type")? {
        Some("perspective") => {
            let at = part("perspective")?;
            let aspect = at.number_in("aspectRatio", 1.0, |aspect| aspect > 0.0, POSITIVE)?;
            let size = size.unwrap_or_else(|| UVec2::new(columns(aspect), ROWS));
            let half_turn = "radians above 0 and below pi";
            let yfov = at.number_in("yfov", f64::NAN, |yfov| yfov > 0.0 && yfov < std::f64::consts::PI, half_turn)?;
            let near = needed(&at, "znear")?;
            let far = match at.number("zfar")? {
                Some(_) => at.number_in("zfar", 0.0, |far| far > near, "a number above znear")?,
                // Nothing lies behind the last point of the scene.
                None => (-things.in_sight(&sight)[0].z * 1.01).max(near * 2.0),
            };
            let k = 1.0 / (0.5 * yfov).tan();
            let aspect = f64::from(size.x) / f64::from(size.y);
            made(&at, Projection::perspective(DVec2::new(k / aspect, k)), near, far, size)
        }
        Some("orthographic") => {
            let at = part("orthographic")?;
            let high = needed(&at, "ymag")?;
            let size = match size {
                Some(size) => size,
                None => UVec2::new(columns(needed(&at, "xmag")? / high), ROWS),
            };
            let near = at.number_in("znear", f64::NAN, |near| near >= 0.0, "a number from 0")?;
            let far = at.number_in("zfar", f64::NAN, |far| far > near, "a number above znear")?;
            let wide = high * f64::from(size.x) / f64::from(size.y);
            made(&at, Projection::orthographic(DVec2::new(wide, high)), near, far, size)
        }
        _ => Err(camera.wrong("type", "perspective or orthographic")),
    }
}

fn columns(aspect: f64) -> u32 {
    (f64::from(ROWS) * aspect).round().clamp(1.0, MOST) as u32
}

/// From above, the right and the front, so far away that the ball about the scene's box fits.
fn three_quarter(things: &Things, size: Option<UVec2>) -> Result<View, GltfError> {
    const FIELD: f64 = 40.0;
    let size = size.unwrap_or(UVec2::splat(ROWS));
    let aspect = f64::from(size.x) / f64::from(size.y.max(1));
    let k = 1.0 / (0.5 * FIELD.to_radians()).tan();
    let k = if aspect < 1.0 { DVec2::new(k, k * aspect) } else { DVec2::new(k / aspect, k) };
    // The sine of half the narrower field.
    let sine = 1.0 / 1.0_f64.hypot(k.max_element());
    let (radius, toward) = (things.radius(), DVec3::new(0.6, 0.5, 1.0).normalize());
    let away = 1.02 * radius / sine;
    let sight = Sight::looking(things.middle() + toward * away, toward, DVec3::Y);
    let sight = sight.ok_or_else(|| GltfError::field("cameras", "nothing", "a scene of finite extent"))?;
    View::new(sight.world_to_eye(), Projection::perspective(k), (away - radius) * 0.5, away + 1.5 * radius, size)
        .map_err(|fault| GltfError::View { path: "cameras".into(), fault })
}
