//! Which pixels are not judged, and why.

use super::{FACING, Judge, Seen};
use glam::{DVec3, Vec3};
use std::fmt;
use umbrage_plane::SurfacePoint;

/// Why a pixel is not judged. Displays as the end of a sentence about the pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unjudged {
    /// It sees nothing.
    Nothing,
    /// It sees more than one object, or an object and what is behind all.
    Surfaces,
    /// Its cosine with the light is not above [`FACING`].
    FacesAway {
        /// That cosine: the pixel's mean, or that of its largest surface.
        cosine: f32,
    },
    /// It sees one object at several angles to the light.
    Crease,
    /// Its surface is edge-on to the camera.
    EdgeOn,
    /// Part of it, or all, lies outside the light's map or its cone.
    Outside,
}

impl fmt::Display for Unjudged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => write!(f, "it sees nothing"),
            Self::Surfaces => write!(f, "it sees several surfaces"),
            Self::FacesAway { cosine } if *cosine <= 0.0 => {
                write!(f, "it faces away from the light, N·L {cosine:.3}")
            }
            Self::FacesAway { cosine } => {
                write!(f, "it is almost edge-on to the light, N·L {cosine:.3}, which is not above {FACING}")
            }
            Self::Crease => write!(f, "it sees a crease, whose sides face the light differently"),
            Self::EdgeOn => write!(f, "its surface is edge-on to the camera"),
            Self::Outside => write!(f, "it is not all inside the light's cone and map"),
        }
    }
}

impl Judge<'_> {
    /// Why a pixel is not judged, the first reason of several; `None` where it is judged.
    ///
    /// # Panics
    /// If the index is past the last pixel.
    pub fn unjudged(&self, pixel: usize) -> Option<Unjudged> {
        let Seen { position, normal, share, facing, .. } = self.seen;
        if share[pixel] != 1.0 {
            return Some(if position[pixel].is_nan() { Unjudged::Nothing } else { Unjudged::Surfaces });
        }
        if facing[pixel] <= FACING {
            return Some(Unjudged::FacesAway { cosine: facing[pixel] });
        }
        let Some(point) = self.point(pixel) else { return Some(Unjudged::EdgeOn) };
        let Some((view, receiver)) = self.received(&point) else { return Some(Unjudged::Outside) };
        let cosine = normal[pixel].as_dvec3().dot(view.toward_eye(point.position)) as f32;
        if cosine <= FACING || receiver.facing <= 0.0 {
            return Some(Unjudged::FacesAway { cosine });
        }
        // A crease of one thing is two surfaces.
        if (cosine - facing[pixel]).abs() > FACING {
            return Some(Unjudged::Crease);
        }
        let is_inside = |corner: &DVec3| {
            self.received(&SurfacePoint { position: *corner, corner_offsets: [Vec3::ZERO; 4], ..point }).is_some()
        };
        (!point.corners().iter().all(is_inside)).then_some(Unjudged::Outside)
    }
}
