//! An explanation in words and numbers.

use super::owners::Owners;
use super::region::Region;
use crate::bias::short;
use glam::DVec3;
use serde_json::{Value, json};
use std::fmt;
use umbrage_oracle::judge::Unjudged;
use umbrage_shadow::{Crossing, Explanation, PlaceJudged, Question, TapJudged, Vote};

/// Results that differ by no more than this agree.
const NEAR: f32 = 0.05;

/// The explanation of a pixel under a light.
pub struct Words<'a> {
    /// Column and row.
    pub at: [u32; 2],
    pub light: &'a str,
    pub recipe: String,
    /// The pixel as it is drawn.
    pub value: f32,
    /// The same by rays.
    pub truth: f32,
    /// Why the pixel is not judged, if it is not.
    pub unjudged: Option<Unjudged>,
    pub regions: Vec<Region>,
}

impl Words<'_> {
    pub fn json(&self) -> Value {
        json!({
            "light": self.light, "recipe": self.recipe, "pixel": self.at,
            "value": self.value, "truth": self.truth, "not_judged": self.unjudged.map(|why| why.to_string()),
            "surfaces": self.regions.iter().map(Region::json).collect::<Vec<_>>(),
        })
    }
}

impl fmt::Display for Words<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { at: [x, y], light, recipe, value, truth, unjudged, regions } = self;
        writeln!(f, "pixel {x},{y} under {light} by {recipe}: {value} in shadow; by rays {truth}")?;
        if regions.is_empty() {
            return writeln!(f, "nothing is seen there");
        }
        for region in regions {
            write!(f, "{region}")?;
            if unjudged.is_none() || region.overruled().is_some() {
                region.verdict(f)?;
            }
        }
        unjudged.map_or(Ok(()), |why| writeln!(f, "not judged, so no fault is named: {why}"))
    }
}

impl Region {
    fn json(&self) -> Value {
        let point = &self.asked.point;
        let vector = |v: DVec3| json!(v.to_array());
        json!({
            "object": self.object, "position": vector(point.position), "normal": vector(point.normal.as_dvec3()),
            "fraction": self.fraction, "truth": self.truth, "cosine": self.cosine,
            "fault": self.fault.as_ref().map(|fault| json!({ "name": fault.name(), "about": fault.to_string() })),
            "blockers": self.blockers.iter().map(|(object, distance)| json!({ "object": object, "distance": distance })).collect::<Vec<_>>(),
            "maps": self.maps.iter().map(|(explanation, owners)| map_json(explanation, owners)).collect::<Vec<_>>(),
        })
    }
}

impl Region {
    /// The last line: how the answer compares with truth.
    fn verdict(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(answer) = self.overruled() {
            return writeln!(
                f,
                "  dark, although the map says {answer}: it faces away from the light, whatever the map stores"
            );
        }
        let off = (self.fraction - self.truth).abs();
        match &self.fault {
            Some(fault) => writeln!(f, "  {fault}"),
            None if off <= NEAR => writeln!(f, "  correct: both agree"),
            None if (self.fraction > 0.5) == (self.truth > 0.5) => {
                writeln!(f, "  off by {off}, on the right side of a half: no fault by name")
            }
            None => writeln!(f, "  off by {off}, where the pixel's truth is neither lit nor dark: no fault by name"),
        }
    }
}

impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let point = &self.asked.point;
        writeln!(
            f,
            "sees {:?} at {}, normal {}: {} in shadow{}",
            self.object,
            place(point.position),
            place(point.normal.as_dvec3()),
            self.fraction,
            if self.overruled().is_some() { " by the map" } else { "" }
        )?;
        for (explanation, owners) in &self.maps {
            map(f, explanation, owners)?;
        }
        write!(f, "  by rays its middle is ")?;
        match (self.blockers.first(), self.truth) {
            (_, 0.0) => writeln!(f, "lit: nothing is between it and the light")?,
            (Some((object, distance)), truth) => {
                writeln!(
                    f,
                    "{truth} in shadow: {object:?} is between it and the light, {} world units away",
                    short(*distance)
                )?;
            }
            (None, truth) => writeln!(f, "{truth} in shadow: it faces away, or lies beyond where the light shines")?,
        }
        Ok(())
    }
}

/// Every tap of every look-up of a map.
fn map(f: &mut fmt::Formatter<'_>, explanation: &Explanation, owners: &Owners) -> fmt::Result {
    let size = explanation.view.size();
    match &explanation.receiver {
        Some(receiver) => {
            let texel = receiver.texel;
            writeln!(
                f,
                "  in the map of {} x {}: texel {:.2}, {:.2}; depth {}; N·L {}; slope {}; a texel is {} world units wide",
                size.x,
                size.y,
                texel.x,
                texel.y,
                receiver.depth,
                short(f64::from(receiver.facing)),
                short(f64::from(receiver.slope)),
                short(f64::from(receiver.texel_world.max_element()))
            )?;
        }
        None => writeln!(f, "  it has no place in the map of {} x {}", size.x, size.y)?,
    }
    if let Some(place) = explanation.placed {
        writeln!(f, "  its place settles the answer by the light's rules: {place:?}")?;
    }
    if let Some(dark) = explanation.culled {
        let verdict = if dark { "dark: all of it lies behind" } else { "lit: none of it lies behind" };
        writeln!(f, "  depth ranges alone settle the answer, {verdict} what the tiles under it store")?;
    }
    for (index, question) in explanation.questions.iter().enumerate() {
        let dark = question.taps.iter().filter(|tap| tap.dark > 0.5).count();
        let plane = if explanation.on_plane && index + 1 == explanation.questions.len() {
            ", on the tangent plane"
        } else {
            ""
        };
        writeln!(
            f,
            "  look-up {}{plane}: {} taps, {dark} of them dark; {} in shadow",
            index + 1,
            question.taps.len(),
            question.share()
        )?;
        writeln!(
            f,
            "    {:>17}  {:>12}  {:>12}  {:>10}  {:>8}  {:<5}  whose",
            "texel", "stored", "compared", "behind by", "weight", ""
        )?;
        for tap in &question.taps {
            write!(f, "    {}", tap_line(tap))?;
            writeln!(f, "  {}", whose(tap, owners))?;
        }
    }
    if !explanation.places.is_empty() {
        places(f, &explanation.places)?;
    }
    Ok(())
}

fn tap_line(tap: &TapJudged) -> String {
    let verdict = match tap.dark {
        0.0 => "lit".into(),
        1.0 => "dark".into(),
        part => format!("{part:.3}"),
    };
    let at = format!("{:.2}, {:.2}", tap.at.x, tap.at.y);
    let TapJudged { stored, compared, weight, .. } = tap;
    format!(
        "{at:>17}  {stored:>12}  {compared:>12}  {:>10}  {weight:>8.4}  {verdict:<5}",
        short(f64::from(compared - stored))
    )
}

fn whose(tap: &TapJudged, owners: &Owners) -> String {
    if tap.ruled.is_some() {
        return "outside: the light's rules".into();
    }
    match owners.at(tap.at.floor().as_ivec2(), tap.stored) {
        Some(owner) => format!("{:?}, facet {}", owners.name(owner.object), owner.facet),
        None => "nothing".into(),
    }
}

/// Places over a map of facets. Those around which all samples agree are counted together.
fn places(f: &mut fmt::Formatter<'_>, places: &[PlaceJudged]) -> fmt::Result {
    let dark = places.iter().filter(|place| place.dark).count();
    writeln!(f, "  {} places of the region, {dark} of them dark", places.len())?;
    let unanimous =
        |place: &&PlaceJudged| place.ruled.is_none() && place.votes.iter().all(|vote| vote.dark == place.votes[0].dark);
    for dark in [false, true] {
        let all: Vec<&PlaceJudged> =
            places.iter().filter(unanimous).filter(|place| place.votes[0].dark == dark).collect();
        if all.is_empty() {
            continue;
        }
        let behind = all.iter().flat_map(|place| &place.votes).map(behind);
        let (least, most) =
            behind.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), by| (low.min(by), high.max(by)));
        let verdict = if dark { "dark" } else { "lit" };
        writeln!(
            f,
            "    {} are {verdict}: all samples around them agree; behind by {} to {}",
            all.len(),
            world(least),
            world(most)
        )?;
    }
    for place in places.iter().filter(|place| !unanimous(place)) {
        let at = format!("{:.2}, {:.2}", place.at.x, place.at.y);
        let verdict = if place.dark { "dark" } else { "lit" };
        if place.ruled.is_some() {
            writeln!(f, "    {at}: {verdict} by the light's rules")?;
            continue;
        }
        let votes = place
            .votes
            .iter()
            .map(|vote| format!("{} {}", if vote.dark { "dark" } else { "lit" }, world(behind(vote))));
        let links = place.crossings.iter().filter(|crossing| matches!(crossing, Some(Crossing::Link(_)))).count();
        let edge = if links > 0 { "the map's links" } else { "where the planes cross" };
        writeln!(
            f,
            "    {at}: {verdict}; samples {}; the edge between them by {edge}",
            votes.collect::<Vec<_>>().join(", ")
        )?;
    }
    Ok(())
}

/// How far the receiver lies behind a sample's facet by both tests.
fn behind(vote: &Vote) -> f64 {
    vote.at_sample.min(vote.at_place)
}

fn world(behind: f64) -> String {
    if behind == f64::NEG_INFINITY { "nothing there".into() } else { format!("{} world units", short(behind)) }
}

fn map_json(explanation: &Explanation, owners: &Owners) -> Value {
    let receiver = explanation.receiver.as_ref().map(|receiver| {
        json!({
            "texel": receiver.texel.to_array(), "depth": receiver.depth, "facing": receiver.facing, "slope": receiver.slope,
            "texel_world": receiver.texel_world.to_array(),
            "region": receiver.footprint.corners.map(|corner| corner.to_array()),
        })
    });
    json!({
        "map_size": explanation.view.size().to_array(),
        "receiver": receiver,
        "placed": explanation.placed.map(|place| format!("{place:?}")),
        "culled": explanation.culled.map(|dark| if dark { "dark" } else { "lit" }),
        "on_plane": explanation.on_plane,
        "texels": explanation.texels,
        "fraction": explanation.fraction,
        "questions": explanation.questions.iter().map(|question| question_json(question, owners)).collect::<Vec<_>>(),
        "places": explanation.places.iter().map(|place| json!({ "at": place.at.to_array(), "dark": place.dark })).collect::<Vec<_>>(),
    })
}

fn question_json(question: &Question, owners: &Owners) -> Value {
    let taps = question.taps.iter().map(|tap| {
        let owner = owners.at(tap.at.floor().as_ivec2(), tap.stored);
        json!({
            "at": tap.at.to_array(), "compared": tap.compared, "weight": tap.weight, "dark": tap.dark, "ruled": tap.ruled,
            // JSON has no ∞: nothing is stored there.
            "stored": tap.stored.is_finite().then_some(tap.stored),
            "facet": owner.map(|owner| owner.facet), "object": owner.map(|owner| owners.name(owner.object)),
        })
    });
    json!({ "share": question.share(), "taps": taps.collect::<Vec<_>>() })
}

fn place(at: DVec3) -> String {
    let [x, y, z] = at.to_array().map(|value| format!("{value:.4}"));
    format!("({x}, {y}, {z})")
}
