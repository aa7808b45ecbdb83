//! Names of the maps around one light.

/// Behind a light's name and a dot: the six maps around a light that shines in all directions, as [`cube_views`](umbrage_plane::cube_views)
/// has their views.
pub const CUBE_FACES: [&str; 6] = ["+x", "-x", "+y", "-y", "+z", "-z"];

/// The same of the five maps of a spot that is too wide for one, as [`View::faces_ahead`](umbrage_plane::View::faces_ahead) has their views.
pub const FACES_AHEAD: [&str; 5] = ["ahead", "right", "left", "up", "down"];

/// The light that a map is of, by the map's name: what comes before one of [`CUBE_FACES`] or [`FACES_AHEAD`], or else the whole name.
///
/// ```
/// assert_eq!(umbrage_io::light_of("lamp.+x"), "lamp");
/// assert_eq!(umbrage_io::light_of("lamp.001"), "lamp.001");
/// ```
pub fn light_of(map: &str) -> &str {
    match map.rsplit_once('.') {
        Some((light, face)) if CUBE_FACES.contains(&face) || FACES_AHEAD.contains(&face) => light,
        _ => map,
    }
}
