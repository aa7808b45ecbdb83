//! The page of a comparison: results beside truth, heat maps, and the numbers.

use super::table;
use crate::paint::{self, FAULTS};
use crate::scores::{Limits, NUMBERS, Row, SHOWN};
use glam::UVec2;
use std::path::{Path, PathBuf};
use umbrage_oracle::heat;
use umbrage_report::{Heading, Made, Measure, Panel, Role, Table, Words, show};

/// Truth of a light.
pub struct Truth {
    pub light: String,
    /// The fraction in shadow of each pixel.
    pub shadow: Vec<f32>,
    /// Which pixels are judged.
    pub judged: Vec<bool>,
}

/// Writes the page and all that it shows into a folder, and returns the names of the files to look at.
///
/// # Errors
/// A file that cannot be written.
pub fn write(
    out: &Path,
    scene: &str,
    size: UVec2,
    truths: &[Truth],
    rows: &[Row],
    limits: Option<&Limits>,
) -> anyhow::Result<Vec<PathBuf>> {
    let figures: Vec<(Heading, Made)> = truths.iter().map(|truth| figure(scene, size, truth, rows, limits)).collect();
    let words = Words {
        title: format!("Umbrage: {scene}"),
        heading: format!("Shadows of {scene}"),
        lead: "Each result is compared with ray-traced truth, and every fault is named.".into(),
        questions: Vec::new(),
    };
    let report = show(out, &words, &figures)?;
    let panels = report.figures.iter().flat_map(|figure| &figure.panels).map(|panel| out.join(&panel.file));
    Ok(std::iter::once(out.join("index.html")).chain(panels).collect())
}

fn figure(scene: &str, size: UVec2, truth: &Truth, rows: &[Row], limits: Option<&Limits>) -> (Heading, Made) {
    let heading = Heading {
        id: format!("light-{}", truth.light),
        paper: scene.into(),
        title: format!("Under {}", truth.light),
        claim: String::new(),
        look: String::new(),
    };
    let own: Vec<&Row> = rows.iter().filter(|row| row.light == truth.light).collect();
    let mut made = Made::default();
    let judged = truth.judged.iter().filter(|judged| **judged).count();
    for (index, row) in own.iter().enumerate() {
        // Two recipes may differ in signs alone, which names of files leave out.
        let size_of = row.made.as_ref().map(|made| format!(" {}", made.map_size)).unwrap_or_default();
        let name = format!("{} {}{size_of}", index + 1, row.what);
        let caption = match &row.made {
            Some(made) => format!("{}, {} texels", row.what, made.map_size),
            None => row.what.clone(),
        };
        let mut result = shadow(&name, &caption, size, &row.shadow).against("truth");
        let mut faults = Panel::rgb(
            &format!("{name} faults"),
            &format!("{caption}: faults"),
            size,
            paint::all(&row.score.places, &truth.judged, &truth.shadow),
        );
        faults = faults.role(Role::Error);
        for number in &NUMBERS[..SHOWN] {
            let Some(value) = (number.of)(row) else { continue };
            let text = number.text(value);
            match FAULTS.iter().find(|fault| fault.0 == number.name) {
                Some((_, colour, _)) => faults = faults.with(number.head, format!("{text}, {colour}")),
                None => result = result.with(number.head, text),
            }
        }
        for (at, (name, colour, _)) in FAULTS.iter().enumerate().skip(3) {
            let count = paint::kinds(&row.score.places).filter(|kind| *kind == Some(at)).count();
            let share = NUMBERS[1].text(count as f64 / judged.max(1) as f64);
            faults = faults.with(name, format!("{share}, {colour}"));
        }
        let differences = row.shadow.iter().zip(&truth.shadow).map(|(own, truth)| heat(own - truth)).collect();
        let error = Panel::rgb(&format!("{name} error"), &format!("{caption}: minus truth"), size, differences);
        let error = error.role(Role::Error).with("too dark", "orange").with("too light", "blue");
        made.panels.extend([result, faults, error]);
        made.measures.extend(limits.into_iter().flat_map(|limits| limits.of(row)).map(|limited| {
            let scale = if limited.number.is_share { 100.0 } else { 1.0 };
            let unit = if limited.number.is_share { "%" } else { "" };
            let name = format!("{caption}: {}", limited.number.head);
            Measure::at_most(&name, limited.value * scale, unit, limited.most * scale)
        }));
    }
    let panel = shadow("truth", "Ray-traced truth", size, &truth.shadow).role(Role::Truth);
    made.panels.push(panel.with("judged pixels", judged));
    let (head, rows) = table::table(own.iter().copied());
    made.tables.push(Table { name: "faults".into(), head, rows });
    let (head, rows) = table::further(own.iter().copied());
    made.tables.push(Table { name: "further".into(), head, rows });
    made.note = "Percentages are of the judged pixels: those that see one surface, inside the light's map and its cone, that faces the light. Pixels that are \
                 not judged are darker in the maps of faults."
        .into();
    (heading, made)
}

/// A shadow as it is displayed: light where lit.
fn shadow(name: &str, caption: &str, size: UVec2, shadow: &[f32]) -> Panel {
    Panel::grey(name, caption, size, shadow.iter().map(|shadow| 1.0 - shadow).collect())
}
