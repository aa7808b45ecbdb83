use crate::error::Fault;
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, UVec2};
use umbrage_plane::{Kind, Projection, View};

/// How far the axes and scales in a foreign file's matrices, which are f32 and were multiplied by others, may be off. It does
/// not depend on where the light stands.
const SLACK: f64 = 1e-3;

/// By what fraction of themselves the shifts in the two matrices may disagree: four roundings to f32 each. Far from the world's
/// origin that is many world units.
const ROUNDINGS: f64 = 1.0 / 2_097_152.0;

/// From our eye space (looking down −z) to OpenEXR's camera space (+z ahead), and back.
const EYE_TO_CAMERA: DMat4 = DMat4::from_diagonal(DVec4::new(1.0, 1.0, -1.0, 1.0));

/// From x_n, y_n in −1..1, y up, to (0, 0) upper left .. (1, 1) lower right.
fn screen_to_ndc() -> DMat4 {
    DMat4::from_translation(DVec3::new(0.5, 0.5, 0.0)) * DMat4::from_scale(DVec3::new(0.5, -0.5, 1.0))
}

/// `worldToCamera` and `worldToNDC`, for a map in the upper left of a display window. OpenEXR multiplies rows from the left, so columns become
/// rows by themselves.
pub(crate) fn of_view(view: &View, display: UVec2) -> [[f32; 16]; 2] {
    let camera = EYE_TO_CAMERA * view.world_to_eye();
    let share = view.size().as_dvec2() / display.as_dvec2();
    let ndc = DMat4::from_scale(share.extend(1.0)) * screen_to_ndc() * view.world_to_screen();
    [camera.as_mat4().to_cols_array(), ndc.as_mat4().to_cols_array()]
}

/// The view that a file's matrices and range describe.
pub(crate) fn to_view(
    world_to_camera: &[f64; 16],
    world_to_ndc: &[f64; 16],
    range: [Option<f64>; 2],
    size: UVec2,
) -> Result<View, Fault> {
    let camera = DMat4::from_cols_array(world_to_camera);
    // The axes alone: how large the shift is says nothing about them.
    let rotation = DMat3::from_mat4(camera);
    let last_row = camera.row(3);
    let is_rigid = (rotation * rotation.transpose()).abs_diff_eq(DMat3::IDENTITY, SLACK)
        && rotation.determinant() < 0.0
        && last_row.abs_diff_eq(DVec4::W, SLACK);
    if !is_rigid {
        let problem = "not a rigid transform into a left-handed camera space";
        return Err(Fault::new("worldToCamera", format!("{world_to_camera:?}"), problem));
    }
    let ndc = DMat4::from_cols_array(world_to_ndc);
    // Some programs write what goes from -1 to 1, y up. A centred projection is one of the two only.
    let projection =
        projection(ndc, camera).or_else(|| projection(screen_to_ndc() * ndc, camera)).ok_or_else(|| {
            let problem = "neither a centred perspective nor a centred parallel projection of worldToCamera";
            Fault::new("worldToNDC", format!("{world_to_ndc:?}"), problem)
        })?;
    let (near, far) = match range {
        [Some(near), Some(far)] => (near, far),
        [near, _] => depths_of(ndc, camera).ok_or_else(|| {
            let field = if near.is_some() { "far" } else { "near" };
            Fault::new(field, "missing", "a shadow map needs it, as worldToNDC does not map depths to 0 to 1")
        })?,
    };
    View::new(EYE_TO_CAMERA * straightened(camera), projection, near, far, size)
        .map(|view| view.with_kind(Kind::Axial))
        .map_err(|error| Fault::new("near, far", format!("{near}, {far}"), error))
}

/// A nearly rigid transform without the roundings of its f32 entries, as an exact one that has its eye where the file has it: about
/// there both agree, however far that is from the world's origin.
fn straightened(camera: DMat4) -> DMat4 {
    let rows = DMat3::from_mat4(camera).transpose();
    let ahead = rows.z_axis.normalize();
    let right = (rows.x_axis - ahead * rows.x_axis.dot(ahead)).normalize();
    // Left-handed: +z ahead.
    let up = right.cross(ahead);
    let rotation = DMat3::from_cols(right, up, ahead).transpose();
    let mut exact = DMat4::from_mat3(rotation);
    let eye = rows.transpose().inverse() * -camera.w_axis.truncate();
    exact.w_axis = -(rotation * eye).extend(-1.0);
    exact
}

/// One row of what takes camera space to NDC.
struct Row {
    along: DVec3,
    /// What the shifts of the two matrices leave of each other.
    rest: f64,
    /// By how much the roundings of the two may change that.
    rounding: f64,
}

/// The depths that become 0 and 1, if the third row is of that kind.
fn depths_of(ndc: DMat4, camera: DMat4) -> Option<(f64, f64)> {
    let to_ndc = ndc * camera.inverse();
    let (z, w) = (to_ndc.row(2), to_ndc.row(3));
    let perspective = w.z.abs() > w.w.abs();
    let scale = if perspective { w.z } else { w.w };
    let (a, b) = (z.z / scale, z.w / scale);
    let (near, far) = if perspective { (-b / a, b / (1.0 - a)) } else { (-b / a, (1.0 - b) / a) };
    (near.is_finite() && far.is_finite() && near < far && (near > 0.0 || !perspective)).then_some((near, far))
}

/// What takes camera space (+z ahead) to NDC: (a·x + z/2, z/2 − b·y)/z in perspective, (a·x + ½, ½ − b·y) in parallel.
fn projection(ndc: DMat4, camera: DMat4) -> Option<Projection> {
    let shift = camera.w_axis.truncate();
    let to_camera = DMat3::from_mat4(camera).transpose().inverse();
    let [x, y, w] = [0, 1, 3].map(|index| {
        let row = ndc.row(index);
        let along = to_camera * row.truncate();
        let rest = row.w - along.dot(shift);
        Row { along, rest, rounding: ROUNDINGS * (row.w.abs() + along.abs().dot(shift.abs())) }
    });
    let perspective = w.along.z.abs() > w.rest.abs() - w.rounding;
    // A matrix of homogeneous coordinates may be scaled as a whole.
    let scale = if perspective { w.along.z } else { w.rest };
    let middle = if perspective { DVec4::Z } else { DVec4::W };
    let close = |row: &Row, to: DVec4| {
        let off = (row.along.extend(row.rest) / scale - to).abs();
        let slack = DVec4::splat(SLACK * (1.0 + to.abs().max_element()));
        off.is_finite() && off.cmple(slack + DVec4::W * (row.rounding / scale).abs()).all()
    };
    let (a, b) = (x.along.x / scale, -y.along.y / scale);
    let fits = a > 0.0
        && b > 0.0
        && close(&w, middle)
        && close(&x, DVec4::X * a + middle * 0.5)
        && close(&y, DVec4::NEG_Y * b + middle * 0.5);
    let scales = DVec2::new(a, b) * 2.0;
    fits.then(|| if perspective { Projection::perspective(scales) } else { Projection::orthographic(1.0 / scales) })
}
