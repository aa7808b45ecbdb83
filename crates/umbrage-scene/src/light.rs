use crate::tree::{Emission, Sight, Tree};
use glam::{DVec3, UVec2, Vec3};
use umbrage_plane::{Rules, SpotView, View, ViewError, up_for};

/// A light: where it stands and what it sees, its colour, whether it casts shadows.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Name for people.
    pub name: String,
    /// Placement, frustum, map size, cone and the answers outside.
    pub view: View,
    /// Linear RGB radiance factor; a shadow scales each channel (Reeves 1987).
    pub colour: Vec3,
    /// Whether it has a shadow map.
    pub casts: bool,
    /// What it sends where, beyond its colour (Reeves 1987); `None` sends its colour everywhere it reaches, times what passes.
    pub tree: Option<Tree>,
}

impl Light {
    /// A light at infinity, in the direction `to_light` (any length but 0). Its map is `half_extent` world units high to
    /// either side of `target`; the target lies midway between the near and far planes, `near` < `far` in world units.
    /// Outside the map it is lit (Williams 1978).
    ///
    /// White and casting; the map's up is +y, or +z where the light shines along y.
    ///
    /// # Errors
    /// As [`View::orthographic`].
    pub fn directional(
        name: &str,
        to_light: DVec3,
        target: DVec3,
        half_extent: f64,
        near: f64,
        far: f64,
        size: UVec2,
    ) -> Result<Self, ViewError> {
        let eye = target + to_light.normalize_or_zero() * (0.5 * (near + far));
        // The sum may round to the target itself or lie beyond it; only the direction of view counts here.
        let ahead = eye - to_light.normalize_or_zero();
        let view = View::orthographic(eye, ahead, up_for(to_light), half_extent, near, far, size)?;
        Ok(Self::new(name, &view.with_rules(Rules::OPEN)))
    }

    /// A spot light: nothing leaves it outside a cone of `full_angle_deg` degrees (below 180), whose edge touches the sides of
    /// a square map. Outside the cone and behind the light all is dark (Woo 1992).
    ///
    /// White and casting; the map's up is +y, or +z where the light shines along y.
    ///
    /// # Errors
    /// As [`View::perspective`].
    pub fn spot(
        name: &str,
        position: DVec3,
        target: DVec3,
        full_angle_deg: f64,
        near: f64,
        far: f64,
        size: UVec2,
    ) -> Result<Self, ViewError> {
        let full_angle_radians = full_angle_deg.to_radians();
        let view = View::spot(SpotView { eye: position, target, up: None, full_angle_radians, near, far, size })?;
        Ok(Self::new(name, &view))
    }

    /// A point light that shines everywhere but whose one map sees only a frustum of `fov_deg` degrees toward `target`. What
    /// lies outside the map is lit (Reeves 1987).
    ///
    /// White and casting; the map's up is +y, or +z where the light shines along y.
    ///
    /// # Errors
    /// As [`View::perspective`].
    pub fn point(
        name: &str,
        position: DVec3,
        target: DVec3,
        fov_deg: f64,
        near: f64,
        far: f64,
        size: UVec2,
    ) -> Result<Self, ViewError> {
        let up = up_for(target - position);
        let view = View::perspective(position, target, up, fov_deg.to_radians(), near, far, size)?;
        Ok(Self::new(name, &view.with_rules(Rules::OPEN)))
    }

    fn new(name: &str, view: &View) -> Self {
        Self { name: name.into(), view: *view, colour: Vec3::ONE, casts: true, tree: None }
    }

    /// The same light in another colour, linear RGB.
    #[must_use]
    pub fn coloured(mut self, colour: Vec3) -> Self {
        self.colour = colour;
        self
    }

    /// The same light shining by a tree; it casts when the tree has a shadow node (Reeves 1987).
    #[must_use]
    pub fn with_tree(mut self, tree: Tree) -> Self {
        self.casts = tree.recipe().is_some();
        self.tree = Some(tree);
        self
    }

    /// As [`Light::incident`], where `transmittance` of the light passes whatever stands between (1 lit, 0 in shadow).
    pub fn arriving(&self, world: DVec3, transmittance: Vec3) -> (Vec3, Vec3) {
        let (toward, light) = self.reaching(world);
        let light = match &self.tree {
            None => light * transmittance,
            Some(tree) if light != Vec3::ZERO => light * tree.light(&self.sight(world, transmittance)),
            Some(_) => light,
        };
        (toward, light)
    }

    fn sight(&self, world: DVec3, transmittance: Vec3) -> Sight {
        let ahead = self.view.ahead();
        let from_light = world - self.view.light().truncate();
        let (distance, cos_axis) = if self.view.is_perspective() {
            (from_light.length(), ahead.dot(from_light.normalize_or_zero()))
        } else {
            (f64::INFINITY, 1.0)
        };
        Sight { distance: distance as f32, cos_axis: cos_axis as f32, transmittance }
    }

    /// Unit direction from a world point to the light and the light arriving there unshadowed (no distance falloff but the tree's;
    /// zero behind a spot and outside its cone, and at the light's own place, where there is no direction either).
    ///
    /// A light with a cone in its view is a spot.
    pub fn incident(&self, world: DVec3) -> (Vec3, Vec3) {
        self.arriving(world, Vec3::ONE)
    }

    /// The direction, and the light's colour where it reaches.
    fn reaching(&self, world: DVec3) -> (Vec3, Vec3) {
        let toward = self.view.toward_eye(world);
        let arrives = toward != DVec3::ZERO && self.reaches(world);
        (toward.as_vec3(), if arrives { self.colour } else { Vec3::ZERO })
    }

    fn reaches(&self, world: DVec3) -> bool {
        match self.view.cone() {
            Some(cos_half) if self.view.is_perspective() => {
                let eye = self.view.world_to_eye().transform_point3(world);
                -eye.z > 0.0 && eye.length_squared() * (cos_half * cos_half) <= eye.z * eye.z
            }
            _ => true,
        }
    }
}
