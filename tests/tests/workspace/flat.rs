//! Planes: one with nothing over it is lit: whatever looks around the receiver looks around the point whose depth it compares.

use glam::{DQuat, DVec2, DVec3, UVec2, Vec3};
use umbrage_depth::Storage;
use umbrage_plane::{Kind, SurfacePoint, View, cube_views};
use umbrage_raster::Triangle;
use umbrage_recipe::Recipe;
use umbrage_sample::Key;

/// A square sheet about the origin, `half` to each side, with its normal.
struct Sheet {
    right: DVec3,
    ahead: DVec3,
    half: f64,
}

impl Sheet {
    /// Tilted from the ground, degrees about an axis in it.
    fn tilted(degrees: f64, about: f64) -> Self {
        let turn = DQuat::from_rotation_y(about) * DQuat::from_rotation_z(degrees.to_radians());
        Self { right: turn * DVec3::X, ahead: turn * DVec3::Z, half: 40.0 }
    }

    fn normal(&self) -> Vec3 {
        self.ahead.cross(self.right).as_vec3().normalize()
    }

    fn at(&self, place: DVec2) -> DVec3 {
        self.right * place.x + self.ahead * place.y
    }

    fn triangles(&self) -> [Triangle; 2] {
        let corner = |x: f64, y: f64| self.at(DVec2::new(x, y) * self.half);
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
        [[a, b, c], [a, c, d]].map(|corners| Triangle { corners, object: 0, sheet: true })
    }

    /// Regions of a side, over the middle of the sheet.
    fn regions(&self, side: f64) -> Vec<SurfacePoint> {
        let region = |index: u32| {
            let middle = (DVec2::new(f64::from(index % 20), f64::from(index / 20)) - 9.63) * 0.21;
            let corner = |x: f64, y: f64| self.at(middle + DVec2::new(x, y) * (0.5 * side));
            let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
            SurfacePoint { region: index, ..SurfacePoint::at(self.at(middle), self.normal()).with_corners(corners) }
        };
        (0..400).map(region).collect()
    }
}

/// Lights of either projection, from straight above to aslant.
fn views(size: UVec2) -> Vec<View> {
    let spot =
        |eye: DVec3, degrees: f64| View::perspective(eye, DVec3::ZERO, DVec3::Z, degrees.to_radians(), 1.0, 60.0, size);
    let sun = |eye: DVec3| View::orthographic(eye, DVec3::ZERO, DVec3::Z, 8.0, 1.0, 60.0, size);
    [
        spot(DVec3::new(7.0, 9.0, 3.0), 70.0),
        spot(DVec3::new(-1.0, 12.0, 0.5), 100.0),
        spot(DVec3::new(9.0, 7.0, -4.0), 30.0),
        sun(DVec3::new(7.0, 9.0, 3.0)),
        sun(DVec3::new(0.1, 20.0, 0.0)),
    ]
    .map(Result::unwrap)
    .to_vec()
}

/// The fraction of a tilted sheet's regions that a recipe darkens at all, at most over all views, kinds and tilts that it is held to.
fn worst(recipe: &str, kinds: &[Kind], steepest: f64) -> f64 {
    let recipe: Recipe = recipe.parse().unwrap();
    let mut worst = 0.0f64;
    for view in views(UVec2::splat(512)) {
        for &kind in kinds {
            let view = view.with_kind(kind);
            for (degrees, about) in [(0.0, 0.0), (15.0, 1.0), (30.0, 2.5), (50.0, 4.0)] {
                let sheet = Sheet::tilted(degrees, about);
                let slope = view
                    .receiver(&SurfacePoint::at(Vec3::ZERO, sheet.normal()))
                    .map_or(f32::INFINITY, |seen| seen.slope);
                if f64::from(slope) > steepest {
                    continue;
                }
                let shadow = recipe.bind(recipe.bake(&view, sheet.triangles()), Storage::Tiled).unwrap();
                for side in [0.0, 0.15, 0.3, 0.6] {
                    let regions = sheet.regions(side);
                    let mut dark = vec![0.0; regions.len()];
                    shadow.fractions(&regions, Key::new(3, 0, 0), &mut dark);
                    let share = dark.iter().filter(|dark| **dark > 0.0).count() as f64 / dark.len() as f64;
                    worst = worst.max(share);
                }
            }
        }
    }
    worst
}

const ALL: [Kind; 3] = [Kind::Axial, Kind::Radial, Kind::Screen];

#[test]
fn an_empty_plane_is_lit_by_every_preset_within_its_limits() {
    // No bias, and no limit but planes that are all but edge-on.
    assert_eq!(worst("wang-molnar94", &ALL, 10.0), 0.0);
    assert_eq!(worst("woo92", &ALL, 10.0), 0.0);
    assert_eq!(worst("auto", &ALL, 10.0), 0.0);
    assert_eq!(worst("auto,fine=1", &ALL, 10.0), 0.0);
    assert_eq!(worst("reeves87,depth=plane,bias=0.01", &[Kind::Axial, Kind::Radial], 10.0), 0.0);
    // Burley's cone is free of false shadow up to a slope of 2.
    assert_eq!(worst("burley", &ALL, 1.9), 0.0);
    // A constant bias holds as far as the plane rises over what is looked at.
    for recipe in ["reeves87,bias=4", "ordinary,bias=4", "fernando,bias=4", "williams78,bias=0.2"] {
        assert_eq!(worst(recipe, &ALL, 1.9), 0.0, "{recipe}");
    }
}

/// As truth has it: a surface that holds the light blocks none of it, on either side. It is edge-on from the light and covers no texel.
#[test]
fn a_sheet_that_holds_the_light_leaves_maps_empty() {
    for (degrees, about) in [(0.0, 0.0), (90.0, 0.0)] {
        let sheet = Sheet::tilted(degrees, about);
        for view in cube_views(DVec3::ZERO, 0.1, 99.0, 64).unwrap() {
            for text in ["reeves87", "wang-molnar94,stored=second", "woo92", "auto"] {
                let recipe: Recipe = text.parse().unwrap();
                let (map, stats) = recipe.bake_counted(&view, [sheet.triangles()]);
                let shadow = recipe.bind(map, Storage::Tiled).unwrap();
                for at in [DVec3::new(4.0, 2.0, -3.0), DVec3::new(-3.0, -4.0, 2.0), DVec3::new(0.2, -5.0, 0.3)] {
                    let point = SurfacePoint::at(at, (-at).normalize().as_vec3());
                    assert_eq!(shadow.fraction(&point, Key::new(1, 0, 0)), 0.0, "{text} {at} {stats}");
                }
            }
        }
    }
}
