//! `extras` of lights: the window of their shadow map, and their size.

use crate::GltfError;
use crate::json::At;
use umbrage_plane::Verdict;

/// What `extras.shadow` fixes of a light's map.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Window {
    /// `{"type": "perspective", "near": n, "far": f}`.
    Perspective {
        near: f64,
        far: f64,
        /// `"outside": "lit"` or `"dark"`: the light has no cone, and this is what lies beyond its map.
        outside: Option<Verdict>,
    },
    /// `{"type": "orthographic", "half": h, "near": n, "far": f}`.
    Orthographic { half: f64, near: f64, far: f64 },
}

/// A member of the extras of a light's node, else of the light itself.
pub(crate) fn extra<'a>(node: &At<'a>, light: &At<'a>, name: &str) -> Option<At<'a>> {
    let of = |at: &At<'a>| at.get("extras").filter(|extras| extras.value.get(name).is_some());
    of(node).or_else(|| of(light))
}

/// The window of a light's map; `needed` is the type that fits the light, which is `kind` in words.
pub(crate) fn window(node: &At, light: &At, needed: &str, kind: &str) -> Result<Option<Window>, GltfError> {
    let Some(extras) = extra(node, light, "shadow") else { return Ok(None) };
    let shadow = extras.get("shadow").filter(|shadow| shadow.value.is_object());
    let shadow = shadow.ok_or_else(|| extras.wrong("shadow", "an object"))?;
    if shadow.text("type")? != Some(needed) {
        return Err(shadow.wrong("type", format!("{needed:?}, since the light is {kind}")));
    }
    let number =
        |name: &str, fits: &dyn Fn(f64) -> bool, expected: &str| shadow.number_in(name, f64::NAN, fits, expected);
    if needed == "orthographic" {
        let half = number("half", &|half| half > 0.0, "world units above 0")?;
        let near = number("near", &|near| !near.is_nan(), "world units")?;
        let far = number("far", &|far| far > near, "world units above near")?;
        return Ok(Some(Window::Orthographic { half, near, far }));
    }
    let near = number("near", &|near| near > 0.0, "world units above 0")?;
    let far = number("far", &|far| far > near, "world units above near")?;
    let outside = match shadow.text("outside")? {
        None => None,
        Some("lit") => Some(Verdict::Lit),
        Some("dark") => Some(Verdict::Shadowed),
        Some(_) => return Err(shadow.wrong("outside", "lit or dark")),
    };
    Ok(Some(Window::Perspective { near, far, outside }))
}

/// The size of a light's body: `extras.radius` in world units of lamps, `extras.angle` in radians of suns; 0 without.
pub(crate) fn size(node: &At, light: &At, sun: bool) -> Result<f64, GltfError> {
    let (own, other) = if sun { ("angle", "radius") } else { ("radius", "angle") };
    if let Some(extras) = extra(node, light, other) {
        let expected =
            if sun { "no radius: a sun has extras.angle, in radians" } else { "no angle: only suns have one" };
        return Err(extras.wrong(other, expected));
    }
    let Some(extras) = extra(node, light, own) else { return Ok(0.0) };
    if sun {
        let fits = |angle: f64| (0.0..std::f64::consts::FRAC_PI_2).contains(&angle);
        return extras.number_in(own, f64::NAN, fits, "radians from 0 to below pi/2");
    }
    extras.number_in(own, f64::NAN, |radius| radius >= 0.0, "world units from 0")
}
