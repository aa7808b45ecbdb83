use glam::{DMat4, DVec3, DVec4, Vec3};

/// A bicubic Bézier patch by its 16 control points (Williams 1978). Other bases are converted: [`Patch::from_basis`].
///
/// The outside is where S_u × S_v points: with u to the right and v up, the side that faces the reader.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Control points, relative to the scene's origin; rows along v, u along each row.
    pub control: [[Vec3; 4]; 4],
}

/// What 16 control points mean: the matrix M of S(u, v) = U·M·G·Mᵀ·V, with U = (u³, u², u, 1) (Williams 1978). The rows of G run along u,
/// those of `control` along v: `G[i][j]` is `control[j][i]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// Bézier: the corners are on the surface.
    Bezier,
    /// Uniform cubic B-spline.
    BSpline,
    /// Catmull-Rom: the four inner points are corners of the surface.
    CatmullRom,
    /// The coefficients themselves, highest power first.
    Power,
}

impl Basis {
    /// M, so that a curve is (u³, u², u, 1)·M·(p₀, p₁, p₂, p₃)ᵀ.
    pub fn matrix(self) -> DMat4 {
        let rows = |scale: f64, rows: [[f64; 4]; 4]| DMat4::from_cols_array_2d(&rows).transpose() * scale;
        match self {
            Self::Bezier => {
                rows(1.0, [[-1.0, 3.0, -3.0, 1.0], [3.0, -6.0, 3.0, 0.0], [-3.0, 3.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]])
            }
            Self::BSpline => rows(
                1.0 / 6.0,
                [[-1.0, 3.0, -3.0, 1.0], [3.0, -6.0, 3.0, 0.0], [-3.0, 0.0, 3.0, 0.0], [1.0, 4.0, 1.0, 0.0]],
            ),
            Self::CatmullRom => {
                rows(0.5, [[-1.0, 3.0, -3.0, 1.0], [2.0, -5.0, 4.0, -1.0], [-1.0, 0.0, 1.0, 0.0], [0.0, 2.0, 0.0, 0.0]])
            }
            Self::Power => DMat4::IDENTITY,
        }
    }

    /// S(u, v) of control points in this basis (rows along v), by the formula as it stands. `u`, `v` in 0..=1.
    pub fn position(self, control: &[[Vec3; 4]; 4], u: f64, v: f64) -> DVec3 {
        let weights = |t: f64| self.matrix().transpose() * DVec4::new(t * t * t, t * t, t, 1.0);
        blend(control, weights(u), weights(v))
    }
}

impl Patch {
    /// From control points in any basis.
    ///
    /// The result equals the original to rounding: each Bézier point is computed in f64 and rounded once.
    pub fn from_basis(basis: Basis, control: [[Vec3; 4]; 4]) -> Self {
        if basis == Basis::Bezier {
            return Self { control };
        }
        let convert = (Basis::Bezier.matrix().inverse() * basis.matrix()).transpose();
        let row = |index: usize| convert.col(index);
        Self { control: std::array::from_fn(|v| std::array::from_fn(|u| blend(&control, row(u), row(v)).as_vec3())) }
    }

    /// The same patch with every control point moved. Exact for affine maps; one that mirrors turns the patch inside out.
    #[must_use]
    pub fn mapped(&self, map: impl Fn(Vec3) -> Vec3) -> Self {
        Self { control: self.control.map(|row| row.map(&map)) }
    }

    /// S(u, v) in world space, `u`, `v` in 0..=1. Corners are exact.
    pub fn position(&self, u: f64, v: f64) -> DVec3 {
        blend(&self.control, bernstein(u), bernstein(v))
    }

    /// Unit normal S_u × S_v. Where that vanishes (a corner or border that is drawn together to a point) it is the
    /// normal a little further inside; +z when there is none either.
    pub fn normal(&self, u: f64, v: f64) -> DVec3 {
        [0.0, 1.0 / 4096.0, 1.0 / 256.0, 1.0 / 16.0]
            .into_iter()
            .find_map(|inward| self.normal_at(u + (0.5 - u) * inward, v + (0.5 - v) * inward))
            .unwrap_or(DVec3::Z)
    }

    fn normal_at(&self, u: f64, v: f64) -> Option<DVec3> {
        self.cut(u).normal(v, self.least_normal())
    }

    /// Below this length S_u × S_v is rounding, which leaves of a direction only noise.
    pub(crate) fn least_normal(&self) -> f64 {
        let extent = self.control.iter().flatten().fold(0f32, |most, at| most.max((at - self.control[0][0]).length()));
        f64::from(extent).powi(2) * 1e-9
    }

    /// Cut along v.
    pub(crate) fn cut(&self, u: f64) -> Cut {
        Cut { position: rows(&self.control, bernstein(u)), slope: rows(&self.control, slope(u)) }
    }
}

/// What a patch is at one u, by control points along v.
pub(crate) struct Cut {
    position: [DVec3; 4],
    /// Its derivative by u.
    slope: [DVec3; 4],
}

impl Cut {
    /// [`Patch::position`].
    pub fn position(&self, v: f64) -> DVec3 {
        column(&self.position, bernstein(v))
    }

    /// [`Patch::normal`], `None` where S_u × S_v is not longer than `least`.
    pub fn normal(&self, v: f64, least: f64) -> Option<DVec3> {
        let along_u = column(&self.slope, bernstein(v));
        let along_v = column(&self.position, slope(v));
        let normal = along_u.cross(along_v);
        (normal.length() > least).then(|| normal.normalize())
    }
}

/// The point of a cubic Bézier curve at `t` in 0..=1; exact at both ends.
pub(crate) fn on_curve(control: &[Vec3; 4], t: f64) -> DVec3 {
    mix(control, bernstein(t))
}

fn blend(control: &[[Vec3; 4]; 4], along_u: DVec4, along_v: DVec4) -> DVec3 {
    column(&rows(control, along_u), along_v)
}

fn rows(control: &[[Vec3; 4]; 4], along_u: DVec4) -> [DVec3; 4] {
    control.map(|row| mix(&row, along_u))
}

fn column(rows: &[DVec3; 4], along_v: DVec4) -> DVec3 {
    rows[0] * along_v.x + rows[1] * along_v.y + rows[2] * along_v.z + rows[3] * along_v.w
}

fn mix(control: &[Vec3; 4], weights: DVec4) -> DVec3 {
    let [a, b, c, d] = control.map(Vec3::as_dvec3);
    a * weights.x + b * weights.y + c * weights.z + d * weights.w
}

fn bernstein(t: f64) -> DVec4 {
    let s = 1.0 - t;
    DVec4::new(s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t)
}

/// The derivative of [`bernstein`].
fn slope(t: f64) -> DVec4 {
    let s = 1.0 - t;
    DVec4::new(-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t)
}
