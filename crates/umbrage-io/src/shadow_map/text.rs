use crate::error::Fault;
use glam::{DMat4, DVec2, UVec2};
use std::fmt::Write;
use umbrage_depth::Stored;
use umbrage_plane::{Kind, Projection, Rules, Sampling, TexelRect, Verdict, View};

/// The first line of the text that holds a view.
const SIGNATURE: &str = "umbrage view 1";

/// The attribute that holds it.
const FIELD: &str = "comments";

/// What our files name as the software that made them.
pub(crate) const SOFTWARE: &str = "umbrage";

/// What the text says of a map before its digest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Head<'a> {
    pub view: &'a View,
    /// Which surface the depths belong to.
    pub stored: Stored,
    /// Cosine of half the angle of the light's cone, where the map is one of several that have none of their own.
    pub light_cone: Option<f64>,
}

/// A map's head as lines of `name=value`. Numbers are the shortest decimals that give the same f64 again.
fn of_head(head: Head<'_>) -> String {
    let Head { view, stored, light_cone } = head;
    let numbers = |numbers: &[f64]| numbers.iter().map(|n| format!("{n:?}")).collect::<Vec<_>>().join(" ");
    let (projection, scale) = match view.projection() {
        Projection::Perspective { k, .. } => ("perspective", k),
        Projection::Orthographic { half, .. } => ("orthographic", half),
    };
    let kind = match view.kind() {
        Kind::Axial => "axial",
        Kind::Screen => "screen",
        Kind::Radial => "radial",
    };
    let sampling = match view.sampling() {
        Sampling::Centre => "centre".into(),
        Sampling::Jittered { seed } => format!("jittered {seed}"),
    };
    let Rules { behind, outside, beyond_cone, near, far } = *view.rules();
    let rules = [behind, outside, beyond_cone, near, far].map(verdict_name).join(" ");
    let mut text = format!("{SIGNATURE}\n");
    let mut line = |name: &str, value: &str| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name}={value}");
    };
    line("world_to_eye", &numbers(&view.world_to_eye().to_cols_array()));
    line(projection, &numbers(&scale.to_array()));
    // A view about its axis is written as it was before there were others, so that old readers read it.
    let shift = view.projection().shift();
    if shift != DVec2::ZERO {
        line("shift", &numbers(&shift.to_array()));
    }
    line("near", &numbers(&[view.near()]));
    line("far", &numbers(&[view.far()]));
    line("size", &format!("{} {}", view.size().x, view.size().y));
    line("kind", kind);
    line("sampling", &sampling);
    line("rules", &rules);
    if let Some(cos_half) = view.cone() {
        line("cone_cos", &numbers(&[cos_half]));
    }
    // Nearest surfaces are what a file without this line holds.
    if stored != Stored::First {
        line("stored", stored.name());
    }
    if let Some(cos_half) = light_cone {
        line("light_cone_cos", &numbers(&[cos_half]));
    }
    text
}

/// What a file says of its map, in our text or otherwise.
pub(crate) struct Description {
    pub view: View,
    pub stored: Stored,
    /// As in [`Head`].
    pub light_cone: Option<f64>,
    /// The rectangle outside of which no surface was seen, whatever a tool that padded the file has put there.
    pub window: TexelRect,
    /// Of the head and the depths; only our text has one.
    pub digest: Option<u64>,
}

/// The text of a map: its head, the rectangle that is written of it unless it is the whole map, and the digest of head and depths.
pub(crate) fn of_map(head: Head<'_>, window: TexelRect, depths: impl IntoIterator<Item = f32>) -> String {
    with_digest(head, window, digest(head, depths.into_iter().map(f32::to_bits)))
}

/// [`of_map`] with a digest that is known. Its length does not depend on the digest.
pub(crate) fn with_digest(head: Head<'_>, window: TexelRect, digest: u64) -> String {
    let TexelRect { min, max } = window;
    let cropped = window != TexelRect::of_size(head.view.size());
    let window = if cropped { format!("window={} {} {} {}\n", min.x, min.y, max.x, max.y) } else { String::new() };
    format!("{}{window}digest={digest:016x}\n", of_head(head))
}

/// A number that depends on every bit of a head and its depths, or what else is kept of it in words of 32 bits.
pub(crate) fn digest(head: Head<'_>, words: impl IntoIterator<Item = u32>) -> u64 {
    let mut digest = Digest::of(head);
    digest.add(words);
    digest.0
}

/// A [`digest`] as it grows: 64-bit FNV-1a over the words' little-endian bytes, so that a damaged file is not taken for another map. It is
/// no seal: whoever wants to can compute it.
pub(crate) struct Digest(pub u64);

impl Digest {
    /// Of a head alone.
    pub fn of(head: Head<'_>) -> Self {
        Self(of_head(head).bytes().fold(0xCBF2_9CE4_8422_2325, Self::fold))
    }

    /// Goes on with further words.
    pub fn add(&mut self, words: impl IntoIterator<Item = u32>) {
        self.0 = words.into_iter().flat_map(u32::to_le_bytes).fold(self.0, Self::fold);
    }

    fn fold(hash: u64, byte: u8) -> u64 {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
    }
}

/// What a text says of a map, or `None` when the text is somebody else's.
pub(crate) fn to_view(text: &str) -> Option<Result<Description, Fault>> {
    let lines = text.strip_prefix(SIGNATURE)?.strip_prefix('\n')?;
    Some(parse(lines))
}

/// Whether an attribute's text, perhaps damaged, is our software's name or contains the first line or the digest of [`of_map`].
pub(crate) fn is_ours(text: &[u8]) -> bool {
    let marks = [SIGNATURE, "\ndigest="].map(str::as_bytes);
    text == SOFTWARE.as_bytes() || marks.iter().any(|mark| text.windows(mark.len()).any(|part| part == *mark))
}

fn parse(lines: &str) -> Result<Description, Fault> {
    let line = |name: &str| value(lines, name).map(str::to_owned);
    let need = |name: &str| line(name).ok_or_else(|| fault(name, "missing", "a view needs it"));
    let one = |name: &str| Ok::<f64, Fault>(numbers::<1>(name, &need(name)?)?[0]);
    let matrix = DMat4::from_cols_array(&numbers("world_to_eye", &need("world_to_eye")?)?);
    let shift = line("shift").map(|shift| numbers("shift", &shift)).transpose()?;
    let shift = shift.map_or(DVec2::ZERO, DVec2::from_array);
    let projection = if let Some(k) = line("perspective") {
        Projection::Perspective { k: DVec2::from_array(numbers("perspective", &k)?), shift }
    } else {
        Projection::Orthographic { half: DVec2::from_array(numbers("orthographic", &need("orthographic")?)?), shift }
    };
    let size = need("size")?;
    let sides = size.split_once(' ').and_then(|(x, y)| Some(UVec2::new(x.parse().ok()?, y.parse().ok()?)));
    let sides = sides.ok_or_else(|| fault("size", &size, "not two whole numbers"))?;
    let view = View::new(matrix, projection, one("near")?, one("far")?, sides)
        .map_err(|error| fault("view", "unusable", &error.to_string()))?;
    let cosine = |name: &str| line(name).map(|cone| numbers(name, &cone).map(|[cosine]: [f64; 1]| cosine)).transpose();
    let (cone, light_cone) = (cosine("cone_cos")?, cosine("light_cone_cos")?);
    // Whoever looks the map up puts the cone over its view.
    view.with_cone(light_cone)
        .map_err(|error| fault("light_cone_cos", &format!("{light_cone:?}"), &error.to_string()))?;
    let view = view.with_kind(kind(&need("kind")?)?).with_sampling(sampling(&need("sampling")?)?);
    let view = view.with_rules(rules(&need("rules")?)?);
    let view = view.with_cone(cone).map_err(|error| fault("cone_cos", &format!("{cone:?}"), &error.to_string()))?;
    let digest = need("digest")?;
    let number = u64::from_str_radix(&digest, 16).map_err(|error| fault("digest", &digest, &error.to_string()))?;
    let stored = line("stored").map_or(Ok(Stored::First), |name| {
        Stored::named(&name).ok_or_else(|| fault("stored", &name, "not first, second, back-face, midpoint or other"))
    })?;
    let window = line("window").map(|window| numbers::<4>("window", &window)).transpose()?;
    let window = window.map_or(TexelRect::of_size(view.size()), |[left, top, right, bottom]| {
        TexelRect::new(DVec2::new(left, top).as_ivec2(), DVec2::new(right, bottom).as_ivec2())
    });
    Ok(Description { view, stored, light_cone, window, digest: Some(number) })
}

/// What a line `name=value` of a text says.
pub(crate) fn value<'a>(lines: &'a str, name: &str) -> Option<&'a str> {
    lines.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix('='))
}

fn numbers<const N: usize>(name: &str, text: &str) -> Result<[f64; N], Fault> {
    let parsed: Vec<f64> = text.split(' ').map_while(|number| number.parse().ok()).collect();
    let all = text.split(' ').count() == parsed.len();
    parsed.try_into().ok().filter(|_| all).ok_or_else(|| fault(name, text, &format!("not {N} numbers")))
}

fn kind(text: &str) -> Result<Kind, Fault> {
    match text {
        "axial" => Ok(Kind::Axial),
        "screen" => Ok(Kind::Screen),
        "radial" => Ok(Kind::Radial),
        _ => Err(fault("kind", text, "not axial, screen or radial")),
    }
}

fn sampling(text: &str) -> Result<Sampling, Fault> {
    if text == "centre" {
        return Ok(Sampling::Centre);
    }
    let seed = text.strip_prefix("jittered ").and_then(|seed| seed.parse().ok());
    seed.map(|seed| Sampling::Jittered { seed })
        .ok_or_else(|| fault("sampling", text, "neither centre nor jittered with a seed"))
}

fn rules(text: &str) -> Result<Rules, Fault> {
    let verdict = |name: &str| VERDICTS.into_iter().find(|verdict| verdict_name(*verdict) == name);
    let verdicts: Option<Vec<Verdict>> = text.split(' ').map(verdict).collect();
    match verdicts.as_deref() {
        Some(&[behind, outside, beyond_cone, near, far]) => Ok(Rules { behind, outside, beyond_cone, near, far }),
        _ => Err(fault("rules", text, "not five of lit, shadowed, compare")),
    }
}

const VERDICTS: [Verdict; 3] = [Verdict::Lit, Verdict::Shadowed, Verdict::Compare];

fn verdict_name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Lit => "lit",
        Verdict::Shadowed => "shadowed",
        Verdict::Compare => "compare",
    }
}

fn fault(name: &str, value: &str, problem: &str) -> Fault {
    Fault::new(format!("{FIELD}: {name}"), value, problem)
}
