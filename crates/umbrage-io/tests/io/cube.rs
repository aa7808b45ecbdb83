//! Faces of cube maps, ours and OpenGL's.

use glam::{DVec2, DVec3};
use umbrage_io::opengl_cube_face;
use umbrage_plane::cube_face;

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
        opengl_cube_face(DVec3::new(0.0, 1.0, 0.5)).1.y > 0.5 && opengl_cube_face(DVec3::new(0.0, -1.0, 0.5)).1.y < 0.5
    );
}
