use crate::error::Fault;
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, Mat4, UVec2};
use umbrage_plane::{Projection, View};

/// How far a foreign file's matrices, which are f32 and were multiplied by others, may be off.
const SLACK: f64 = 1e-3;

/// From our eye space (looking down −z) to OpenEXR's camera space (+z ahead), and back.
const EYE_TO_CAMERA: DMat4 = DMat4::from_diagonal(DVec4::new(1.0, 1.0, -1.0, 1.0));

/// From x_n, y_n in −1..1, y up, to (0, 0) upper left .. (1, 1) lower right.
fn screen_to_ndc() -> DMat4 {
    DMat4::from_translation(DVec3::new(0.5, 0.5, 0.0)) * DMat4::from_scale(DVec3::new(0.5, -0.5, 1.0))
}

/// `worldToCamera` and `worldToNDC`. OpenEXR multiplies rows from the left, so columns become rows by themselves.
pub(crate) fn of_view(view: &View) -> [[f32; 16]; 2] {
    let camera = EYE_TO_CAMERA * view.world_to_eye();
    let ndc = screen_to_ndc() * view.world_to_screen();
    [camera.as_mat4().to_cols_array(), ndc.as_mat4().to_cols_array()]
}

/// The view that a file's matrices and range describe.
pub(crate) fn to_view(
    world_to_camera: &[f32; 16],
    world_to_ndc: &[f32; 16],
    near: f32,
    far: f32,
    size: UVec2,
) -> Result<View, Fault> {
    let camera = Mat4::from_cols_array(world_to_camera).as_dmat4();
    let rotation = DMat3::from_mat4(camera);
    let last_row = camera.row(3);
    let is_rigid = (rotation * rotation.transpose()).abs_diff_eq(DMat3::IDENTITY, SLACK)
        && rotation.determinant() < 0.0
        && last_row.abs_diff_eq(DVec4::W, SLACK);
    if !is_rigid {
        let problem = "not a rigid transform into a left-handed camera space";
        return Err(Fault::new("worldToCamera", format!("{world_to_camera:?}"), problem));
    }
    let ndc = Mat4::from_cols_array(world_to_ndc).as_dmat4();
    let projection = projection(ndc * camera.inverse()).ok_or_else(|| {
        let problem = "neither a centred perspective nor a centred parallel projection of worldToCamera";
        Fault::new("worldToNDC", format!("{world_to_ndc:?}"), problem)
    })?;
    View::new(EYE_TO_CAMERA * straightened(camera), projection, f64::from(near), f64::from(far), size)
        .map_err(|error| Fault::new("near, far", format!("{near}, {far}"), error))
}

/// A nearly rigid transform without the roundings of its f32 entries, as an exact one.
fn straightened(camera: DMat4) -> DMat4 {
    let rows = DMat3::from_mat4(camera).transpose();
    let ahead = rows.z_axis.normalize();
    let right = (rows.x_axis - ahead * rows.x_axis.dot(ahead)).normalize();
    // Left-handed: +z ahead.
    let up = right.cross(ahead);
    let rotation = DMat3::from_cols(right, up, ahead).transpose();
    let mut exact = DMat4::from_mat3(rotation);
    exact.w_axis = camera.w_axis.truncate().extend(1.0);
    exact
}

/// What takes camera space (+z ahead) to NDC: (a·x + z/2, z/2 − b·y)/z in perspective, (a·x + ½, ½ − b·y) in parallel.
fn projection(camera_to_ndc: DMat4) -> Option<Projection> {
    let [x, y, w] = [0, 1, 3].map(|row| camera_to_ndc.row(row));
    let perspective = w.z.abs() > w.w.abs();
    // A matrix of homogeneous coordinates may be scaled as a whole.
    let scale = if perspective { w.z } else { w.w };
    let [x, y, w] = [x, y, w].map(|row| row / scale);
    let middle = if perspective { DVec4::Z } else { DVec4::W };
    let close = |a: DVec4, b: DVec4| a.is_finite() && a.abs_diff_eq(b, SLACK * (1.0 + b.abs().max_element()));
    let (a, b) = (x.x, -y.y);
    let fits = a > 0.0
        && b > 0.0
        && close(w, middle)
        && close(x, DVec4::X * a + middle * 0.5)
        && close(y, DVec4::NEG_Y * b + middle * 0.5);
    let scales = DVec2::new(a, b) * 2.0;
    fits.then(|| {
        if perspective {
            Projection::Perspective { k: scales }
        } else {
            Projection::Orthographic { half: 1.0 / scales }
        }
    })
}
