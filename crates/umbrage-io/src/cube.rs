use glam::{DVec2, DVec3};
use umbrage_plane::cube_face;

/// The face and (s, t) of OpenGL's cube maps for a direction, any length but 0 (V49). Its faces stand in our order, +X, −X, +Y, −Y, +Z,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn v49_our_faces_and_opengl_s_are_mirror_images() {
        let (face, st) = opengl_cube_face(DVec3::new(1.0, 0.2, -0.3));
        assert_eq!(face, 0);
        assert!(st.abs_diff_eq(DVec2::new(0.65, 0.4), 1e-12), "{st}");
        for (x, y, z) in [(0.3, 0.2, 1.0), (-1.0, 0.4, 0.1), (0.1, -0.2, -1.0), (1.0, 0.9, -0.8)] {
            let direction = DVec3::new(x, y, z);
            let ((face, ours), (same, theirs)) = (cube_face(direction), opengl_cube_face(direction));
            assert_eq!(face, same);
            assert!(theirs.abs_diff_eq(DVec2::new(1.0 - ours.x, ours.y), 1e-12), "{direction}");
        }
        // Top and bottom: t grows toward +z on +Y, toward −z on −Y.
        assert!(
            opengl_cube_face(DVec3::new(0.0, 1.0, 0.5)).1.y > 0.5
                && opengl_cube_face(DVec3::new(0.0, -1.0, 0.5)).1.y < 0.5
        );
    }
}
