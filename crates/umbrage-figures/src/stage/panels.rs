//! Panels of a figure: the shadow alone, its error in colours, and windows enlarged.

use glam::{DVec2, IVec2, UVec2, Vec3};
use umbrage_oracle::heat;
use umbrage_render::{NOTHING, Picture};
use umbrage_report::{Made, Panel, Role};

/// The shadow component as it is displayed: light where lit.
pub fn shadow_panel(name: &str, caption: &str, picture: &Picture) -> Panel {
    shadow_image_panel(name, caption, picture.size, &picture.shadow[0])
}

/// The same of a bare shadow image.
pub fn shadow_image_panel(name: &str, caption: &str, size: UVec2, shadow: &[f32]) -> Panel {
    Panel::grey(name, caption, size, shadow.iter().map(|s| 1.0 - s).collect())
}

/// The truth's panel of a figure.
pub fn truth_panel(truth: &Picture) -> Panel {
    shadow_panel("truth", "Ray-traced truth", truth).role(Role::Truth)
}

/// A method's shadow with one parameter under it, and its error beside it.
pub fn shadow_and_error(
    made: &mut Made,
    (name, caption): (&str, &str),
    (parameter, value): (&str, &str),
    picture: &Picture,
    truth: &Picture,
) {
    made.panels.push(shadow_panel(name, caption, picture).with(parameter, value).against("truth"));
    let (own, exact) = (&picture.shadow[0], &truth.shadow[0]);
    made.panels.push(error_panel(
        &format!("{name}-error"),
        &format!("{caption}: minus truth"),
        picture.size,
        own,
        exact,
    ));
}

/// The picture with surfaces that face away from light 0 wholly in its shadow, as shading makes them whatever a map holds.
pub fn as_shaded(picture: &Picture) -> Picture {
    let mut shaded = picture.clone();
    for (i, shadow) in shaded.shadow[0].iter_mut().enumerate() {
        if picture.object[i] != NOTHING && picture.facing[0][i] <= 0.0 {
            *shadow = 1.0;
        }
    }
    shaded
}

/// Result minus truth as colours.
pub fn error_panel(name: &str, caption: &str, size: UVec2, result: &[f32], truth: &[f32]) -> Panel {
    let pixels = result.iter().zip(truth).map(|(r, t)| heat(r - t)).collect();
    Panel::rgb(name, caption, size, pixels).role(Role::Error)
}

/// A square window of a picture about a fraction of its size, enlarged.
pub fn zoomed(name: &str, caption: &str, picture: &Picture, centre: DVec2, part: u32) -> Panel {
    let (from, window, zoom) = window(picture.size, centre, part);
    let (size, shadow) = crop(picture.size, &picture.shadow[0], from, window);
    shadow_image_panel(name, caption, size, &shadow).zoom(zoom)
}

/// The same window of result minus truth as colours.
pub fn zoomed_error(name: &str, caption: &str, picture: &Picture, truth: &Picture, centre: DVec2, part: u32) -> Panel {
    let (from, window, zoom) = window(picture.size, centre, part);
    let (size, ours) = crop(picture.size, &picture.shadow[0], from, window);
    let (_, exact) = crop(truth.size, &truth.shadow[0], from, window);
    error_panel(name, caption, size, &ours, &exact).zoom(zoom)
}

/// The same window of a colour picture.
pub fn zoomed_colour(name: &str, caption: &str, size: UVec2, pixels: &[Vec3], centre: DVec2, part: u32) -> Panel {
    let (from, window, zoom) = window(size, centre, part);
    let (size, pixels) = crop(size, pixels, from, window);
    Panel::rgb(name, caption, size, pixels).zoom(zoom)
}

/// A colour picture with the outline of the window that [`zoomed`] enlarges drawn into it.
pub fn framed(name: &str, caption: &str, size: UVec2, pixels: &[Vec3], centre: DVec2, part: u32) -> Panel {
    const OUTLINE: Vec3 = Vec3::new(0.95, 0.35, 0.02);
    let (from, window, _) = window(size, centre, part);
    let (low, high) = (from.as_ivec2() - 1, (from + window).as_ivec2());
    let width = (size.x / 256).max(1) as i32;
    let pixel = |(index, pixel): (usize, &Vec3)| {
        let at = IVec2::new((index as u32 % size.x) as i32, (index as u32 / size.x) as i32);
        let inside = |by: i32| at.cmpgt(low - by).all() && at.cmplt(high + by).all();
        if inside(width) && !inside(0) { OUTLINE } else { *pixel }
    };
    Panel::rgb(name, caption, size, pixels.iter().enumerate().map(pixel).collect())
}

/// Corner and size of a square window about a fraction of a picture's size, and how often its pixels are repeated.
fn window(size: UVec2, centre: DVec2, part: u32) -> (UVec2, UVec2, u32) {
    let side = size.x / part;
    let from = (centre * size.as_dvec2()).as_uvec2().saturating_sub(UVec2::splat(side / 2));
    (from, UVec2::splat(side), (384 / side.max(1)).max(1))
}

/// Cuts a window out of an image; what lies outside is left out.
fn crop<T: Copy>(size: UVec2, image: &[T], from: UVec2, window: UVec2) -> (UVec2, Vec<T>) {
    let window = window.min(size.saturating_sub(from));
    let rows = (from.y..from.y + window.y)
        .flat_map(|y| (from.x..from.x + window.x).map(move |x| image[(y * size.x + x) as usize]));
    (window, rows.collect())
}

/// Linear grey for a colour picture's panel.
pub fn colour_panel(name: &str, caption: &str, size: UVec2, pixels: &[Vec3]) -> Panel {
    Panel::rgb(name, caption, size, pixels.to_vec())
}
