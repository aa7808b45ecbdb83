use glam::{DVec2, DVec3};
use umbrage_plane::cube_face;

/// The face and (s, t) of OpenGL's cube maps for a direction, any length but 0. Its faces stand in our order, +X, −X, +Y, −Y, +Z,
/// −Z, but are seen from outside: mirrored. s and t are in 0..=1; t goes down as ours does.
pub fn opengl_cube_face(direction: DVec3) -> (usize, DVec2) {
    let (face, _) = cube_face(direction);
    let DVec3 { x, y, z } = direction;
    let (s, t, major) = match face {
        0 => (-z, -y, x),
        1 => (z, -y, -x),
        2 => (x, z, y),
        3 => (x, -z, -y),
        4 => (x, -y, z),
        _ => (-x, -y, -z),
    };
    (face, (DVec2::new(s, t) / major + 1.0) * 0.5)
}
