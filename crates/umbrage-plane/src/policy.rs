/// Where a point or a sample lies as seen from a light: the six cases that the papers conflate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Behind a perspective light: ζ ≤ 0.
    Behind,
    /// In front, but outside the map's rectangle.
    Outside,
    /// Inside the rectangle, outside a spot light's cone.
    BeyondCone,
    /// Inside, nearer than the near plane.
    Near,
    /// Inside, farther than the far plane.
    Far,
    /// Inside the map, the cone and the depth range.
    Inside,
}

/// What to answer for a place without a look-up, or that a look-up answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Fraction in shadow 0.
    Lit,
    /// Fraction in shadow 1.
    Shadowed,
    /// Compare with what the map stores; outside the map that is +∞.
    Compare,
}

/// The verdict for each case of [`Place`]; part of a [`View`](crate::View).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    /// Behind the light.
    pub behind: Verdict,
    /// Outside the map's rectangle.
    pub outside: Verdict,
    /// Inside the rectangle, outside the cone.
    pub beyond_cone: Verdict,
    /// Nearer than the near plane.
    pub near: Verdict,
    /// Beyond the far plane.
    pub far: Verdict,
}

impl Rules {
    /// Lights without an edge of their own: what lies outside the map is lit (Reeves 1987, §3.2).
    pub const OPEN: Self = Self {
        behind: Verdict::Lit,
        outside: Verdict::Lit,
        beyond_cone: Verdict::Lit,
        near: Verdict::Compare,
        far: Verdict::Compare,
    };
    /// Spot lights: they emit nothing outside their cone, so everything there is in shadow (Woo 1992).
    pub const SPOT: Self = Self {
        behind: Verdict::Shadowed,
        outside: Verdict::Shadowed,
        beyond_cone: Verdict::Shadowed,
        near: Verdict::Compare,
        far: Verdict::Compare,
    };
    /// One of several views around a light: what lies outside is compared, because a neighbour answers there (Reeves 1987).
    pub const AROUND: Self = Self {
        behind: Verdict::Lit,
        outside: Verdict::Compare,
        beyond_cone: Verdict::Compare,
        near: Verdict::Compare,
        far: Verdict::Compare,
    };
    /// Williams' strict volume: everything outside the light's viewing volume is lit (Williams 1978).
    pub const VOLUME: Self = Self {
        behind: Verdict::Lit,
        outside: Verdict::Lit,
        beyond_cone: Verdict::Lit,
        near: Verdict::Lit,
        far: Verdict::Lit,
    };

    /// The verdict for a place; [`Place::Inside`] is always compared.
    #[inline(always)]
    pub const fn verdict(&self, place: Place) -> Verdict {
        match place {
            Place::Behind => self.behind,
            Place::Outside => self.outside,
            Place::BeyondCone => self.beyond_cone,
            Place::Near => self.near,
            Place::Far => self.far,
            Place::Inside => Verdict::Compare,
        }
    }
}

impl Default for Rules {
    fn default() -> Self {
        Self::OPEN
    }
}
