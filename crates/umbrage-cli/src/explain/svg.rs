//! The texels around a receiver, with its footprint and the places that were looked up.

use super::owners::Owners;
use glam::{IVec2, Vec2};
use std::fmt::Write;
use umbrage_plane::TexelRect;
use umbrage_shadow::Explanation;

/// Side of a texel, and of the border.
const TEXEL: f32 = 48.0;
const BORDER: f32 = 24.0;
/// Most texels across.
const MOST: i32 = 33;

/// The texels that were read, and one around them; `None` where none was.
pub fn window(explanation: &Explanation) -> Option<TexelRect> {
    let taps = explanation.questions.iter().flat_map(|question| &question.taps).map(|tap| tap.at);
    let places = explanation.places.iter().map(|place| place.at.as_vec2());
    let asked = taps.chain(places).filter(|at| at.is_finite()).map(|at| at.floor().as_ivec2());
    let receiver = explanation.receiver.as_ref()?;
    let own = receiver.texel.floor().as_ivec2();
    let corners = receiver.footprint.corners.into_iter().filter(|at| at.is_finite());
    let asked = asked.chain(corners.map(|at| at.floor().as_ivec2()));
    let (low, high) = asked.fold((own, own), |(low, high), texel| (low.min(texel), high.max(texel)));
    let (low, high) = (low.max(own - MOST / 2), high.min(own + MOST / 2));
    Some(TexelRect::new(low - 1, high + 2))
}

/// The picture.
pub fn drawn(explanation: &Explanation, owners: &Owners) -> Option<String> {
    let window = window(explanation)?;
    let receiver = explanation.receiver.as_ref()?;
    let size = window.size().as_vec2() * TEXEL + 2.0 * BORDER;
    let place = |at: Vec2| (at - window.min.as_vec2()) * TEXEL + BORDER;
    let mut body = String::new();
    for texel in window.texels() {
        let at = place(texel.as_vec2());
        let owner = owners.nearest(texel);
        let own = owner.is_some_and(|owner| owner.object == receiver.object);
        let (ink, name) = match owner {
            None => ("#ffffff", String::from("nothing")),
            Some(owner) if own => ("#dbe7f5", format!("{}, facet {}", owners.name(owner.object), owner.facet)),
            Some(owner) => ("#f3dcc8", format!("{}, facet {}", owners.name(owner.object), owner.facet)),
        };
        let _ = writeln!(
            body,
            "<rect x=\"{}\" y=\"{}\" width=\"{TEXEL}\" height=\"{TEXEL}\" fill=\"{ink}\" stroke=\"#999\"><title>{}, {}: {}</title></rect>",
            at.x,
            at.y,
            texel.x,
            texel.y,
            escaped(&name)
        );
    }
    for texel in stored(explanation) {
        let at = place(texel.0.as_vec2());
        let _ =
            writeln!(body, "<text x=\"{}\" y=\"{}\" fill=\"#555\">{}</text>", at.x + 3.0, at.y + TEXEL - 5.0, texel.1);
    }
    let corners = receiver.footprint.corners.map(|corner| {
        let at = place(corner);
        format!("{:.1},{:.1}", at.x, at.y)
    });
    let _ = writeln!(
        body,
        "<polygon points=\"{}\" fill=\"#3b78c2\" fill-opacity=\".15\" stroke=\"#3b78c2\" stroke-width=\"2\"/>",
        corners.join(" ")
    );
    let taps = explanation.questions.last().map_or(&[][..], |question| &question.taps);
    let dots = taps.iter().map(|tap| (tap.at, tap.dark));
    let dots = dots.chain(explanation.places.iter().map(|place| (place.at.as_vec2(), f32::from(u8::from(place.dark)))));
    for (at, dark) in dots.filter(|(at, _)| at.is_finite()) {
        let at = place(at);
        let ink = if dark > 0.5 { "#111" } else { "#f6c945" };
        let _ =
            writeln!(body, "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"5\" fill=\"{ink}\" stroke=\"#111\"/>", at.x, at.y);
    }
    let at = place(receiver.texel.as_vec2());
    let _ = writeln!(
        body,
        "<path d=\"M{0:.1} {1:.1}m-8 0h16m-8 -8v16\" stroke=\"#c0271d\" stroke-width=\"2\" fill=\"none\"/>",
        at.x, at.y
    );
    let legend = "Blue texels see the receiver's own object, orange ones another; the blue outline is the region, the cross its point, dots are taps: black \
        ones dark, yellow ones lit.";
    let width = size.x.max(640.0);
    let height = size.y + 48.0;
    let mut text = String::new();
    for (row, line) in (0u8..).zip(wrapped(legend, (width / 6.6) as usize)) {
        let _ = writeln!(
            text,
            "<text x=\"{BORDER}\" y=\"{}\" font-size=\"12\">{line}</text>",
            size.y + 10.0 + 16.0 * f32::from(row)
        );
    }
    Some(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"The texels around a receiver\" \
         font-family=\"system-ui, sans-serif\" font-size=\"9\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{body}{text}</svg>\n"
    ))
}

/// The depth that each texel that was read stores, once.
fn stored(explanation: &Explanation) -> Vec<(IVec2, String)> {
    let mut known: Vec<(IVec2, String)> = Vec::new();
    for tap in explanation.questions.iter().flat_map(|question| &question.taps) {
        let texel = tap.at.floor().as_ivec2();
        if known.iter().all(|(other, _)| *other != texel)
            && window(explanation).is_some_and(|window| window.contains(texel))
        {
            known.push((texel, crate::bias::short(f64::from(tap.stored))));
        }
    }
    known
}

/// Lines of at most this many characters.
fn wrapped(text: &str, most: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let last = lines.last_mut().filter(|line| line.is_empty() || line.len() + 1 + word.len() <= most);
        match last {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) => {
                line.push(' ');
                line.push_str(word);
            }
            None => lines.push(word.into()),
        }
    }
    lines
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
