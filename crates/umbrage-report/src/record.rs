//! What is kept of a finished figure: what `figure.json`, `report.json` and the gallery are written from.
//!
//! A record holds no time and nothing of the machine, the threads or the storage: it is the same bytes on every run.

use crate::made::{Made, Verdict};
use crate::measure::{Bound, Kind, Measure};
use crate::panel::Role;
use crate::text::{file_stem, rounded, short};
use serde::{Deserialize, Serialize};

/// Digits of a value in records: more than any bound needs, fewer than another machine's mathematics would change.
const DIGITS: usize = 9;

/// What a figure is called before it is made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Heading {
    /// Unique in its run; the name of its folder, so Latin letters, digits and hyphens only.
    pub id: String,
    /// What it stands under in the gallery, as authors and year. Figures of one paper follow one another.
    pub paper: String,
    /// A few words.
    pub title: String,
    /// What it must show: the paper's claim, in a sentence.
    pub claim: String,
    /// What to look at, in a sentence; empty where nothing need be said.
    pub look: String,
}

/// All figures of a run, in the order of the gallery.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Report {
    /// The figures.
    pub figures: Vec<FigureRecord>,
}

/// A finished figure.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FigureRecord {
    /// Row id of the catalogue.
    pub id: String,
    /// Authors and year.
    pub paper: String,
    /// A few words.
    pub title: String,
    /// What it must show: the paper's claim, in a sentence.
    pub claim: String,
    /// What to look at, in a sentence; absent where nothing need be said.
    #[serde(skip_serializing_if = "String::is_empty", default)]
    pub look: String,
    /// Pictures, in order.
    pub panels: Vec<PanelRecord>,
    /// Plots: file stems of the SVG files.
    pub plots: Vec<String>,
    /// Tables.
    pub tables: Vec<TableRecord>,
    /// Tables of the run that made it: file stems of JSON files in its folder.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub run_tables: Vec<String>,
    /// Numbers with their bounds.
    pub measures: Vec<MeasureRecord>,
    /// The judgement.
    pub verdict: Verdict,
    /// A remark; empty where there is none.
    pub note: String,
    /// The measured cause of the bounds that are missed.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub caveat: Option<String>,
    /// How the run that made it differs from the run that wrote the report; absent where it does not.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub earlier: Option<String>,
}

/// A picture of a figure.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PanelRecord {
    /// Name, unique in its figure.
    pub name: String,
    /// The PNG file, from the folder of the report.
    pub file: String,
    /// What is seen.
    pub caption: String,
    /// What it is for.
    pub role: Role,
    /// Columns and rows of the file, after replication.
    pub size: [u32; 2],
    /// How often each pixel is repeated along each axis.
    pub zoom: u32,
    /// Parameters as name and value.
    pub parameters: Vec<(String, String)>,
    /// The panel that it is compared with.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub against: Option<String>,
}

/// A table of a figure.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TableRecord {
    /// Name, unique in its figure.
    pub name: String,
    /// Column heads.
    pub head: Vec<String>,
    /// Rows.
    pub rows: Vec<Vec<String>>,
}

/// A number with its bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasureRecord {
    /// What is measured.
    pub name: String,
    /// The value to nine digits; `null` for NaN and ∞.
    pub value: Option<f64>,
    /// Its unit.
    pub unit: String,
    /// What it must be.
    pub bound: Bound,
    /// Whether the exact value meets the bound; `null` where none is judged.
    pub pass: Option<bool>,
    /// How value and bound read; absent for numbers.
    #[serde(skip_serializing_if = "is_number", default)]
    pub kind: Kind,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference")]
fn is_number(kind: &Kind) -> bool {
    *kind == Kind::Number
}

impl MeasureRecord {
    /// The word for a value that answers a question; `None` where it reads as a number.
    pub fn word(&self) -> Option<&'static str> {
        self.value.and_then(|value| self.kind.word(value))
    }

    /// The bound for people; empty where there is none.
    pub fn bound_text(&self) -> String {
        self.bound.text(self.kind)
    }

    /// The value for people, without its unit: four digits, and more where four would seem to contradict the judgement.
    pub fn value_text(&self) -> String {
        let Some(value) = self.value else { return "not a number".into() };
        if let Some(word) = self.word() {
            return word.into();
        }
        let agrees = |digits: &usize| {
            let seen = Measure::new("", rounded(value, *digits), "", self.bound.clone());
            seen.pass() == self.pass
        };
        short(value, (4..DIGITS).find(agrees).unwrap_or(DIGITS))
    }
}

impl From<&Measure> for MeasureRecord {
    fn from(measure: &Measure) -> Self {
        Self {
            name: measure.name.clone(),
            value: measure.value.is_finite().then(|| rounded(measure.value, DIGITS)),
            unit: measure.unit.clone(),
            bound: measure.bound.clone(),
            pass: measure.pass(),
            kind: measure.kind,
        }
    }
}

impl FigureRecord {
    /// The record of a figure just made.
    pub fn new(heading: &Heading, made: &Made) -> Self {
        let panels = made.panels.iter().map(|panel| PanelRecord {
            name: panel.name.clone(),
            file: format!("{}/{}.png", heading.id, file_stem(&panel.name)),
            caption: panel.caption.clone(),
            role: panel.role,
            size: (panel.size * panel.zoom).to_array(),
            zoom: panel.zoom,
            parameters: panel.parameters.clone(),
            against: panel.against.clone(),
        });
        let tables = made.tables.iter().map(|table| TableRecord {
            name: table.name.clone(),
            head: table.head.clone(),
            rows: table.rows.clone(),
        });
        let verdict = made.verdict();
        Self {
            id: heading.id.clone(),
            paper: heading.paper.clone(),
            title: heading.title.clone(),
            claim: heading.claim.clone(),
            look: heading.look.clone(),
            panels: panels.collect(),
            plots: made.plots.iter().map(|(name, _)| file_stem(name)).collect(),
            tables: tables.collect(),
            run_tables: made.run_tables.iter().map(|table| file_stem(&table.name)).collect(),
            measures: made.measures.iter().map(MeasureRecord::from).collect(),
            verdict,
            note: made.note.clone(),
            // A cause of misses says nothing where nothing is missed.
            caveat: made.caveat.clone().filter(|_| verdict == Verdict::Caveat),
            earlier: None,
        }
    }
}

impl Report {
    /// The text of `report.json`.
    ///
    /// # Errors
    /// When the record cannot be put into JSON, which no value of these types is known to cause.
    pub fn json(&self) -> anyhow::Result<String> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// How many figures have this verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.figures.iter().filter(|figure| figure.verdict == verdict).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heading() -> Heading {
        Heading { id: "T-1".into(), paper: "Umbrage".into(), title: "t".into(), claim: "c".into(), look: String::new() }
    }

    #[test]
    fn what_is_not_a_number_is_null_and_meets_no_bound() {
        let made = Made {
            measures: vec![Measure::at_most("m", f64::NAN, "px", 1.0), Measure::info("i", f64::INFINITY, "")],
            ..Made::default()
        };
        let record = FigureRecord::new(&heading(), &made);
        assert_eq!(record.verdict, Verdict::Missed);
        let text = serde_json::to_string(&record.measures).unwrap();
        let expected = r#"[{"name":"m","value":null,"unit":"px","bound":{"at_most":1.0},"pass":false},{"name":"i","value":null,"unit":"","bound":"info","pass":null}]"#;
        assert_eq!(text, expected);
        let back: Vec<MeasureRecord> = serde_json::from_str(&text).unwrap();
        assert_eq!(back, record.measures);
    }

    #[test]
    fn a_value_is_shown_with_the_digits_that_its_bound_needs() {
        let text = |measure: Measure| MeasureRecord::from(&measure).value_text();
        assert_eq!(text(Measure::info("m", 0.123_456_789, "")), "0.1235");
        assert_eq!(text(Measure::within("m", 22.944_444_4, "", 22.944_44, 22.944_45)), "22.94444");
        assert_eq!(text(Measure::at_most("m", 0.030_001, "", 0.03)), "0.030001");
        assert_eq!(text(Measure::at_most("m", f64::NAN, "", 0.03)), "not a number");
        assert_eq!(text(Measure::yes("m", true)), "yes");
    }

    #[test]
    fn a_caveat_explains_a_miss_and_is_silent_without_one() {
        let missed = vec![Measure::at_least("m", 0.5, "", 1.0)];
        let caveat = Some("because".to_string());
        let explained = Made { measures: missed.clone(), caveat: caveat.clone(), ..Made::default() };
        assert_eq!(FigureRecord::new(&heading(), &explained).verdict, Verdict::Caveat);
        assert_eq!(FigureRecord::new(&heading(), &explained).caveat, caveat);
        let unexplained = Made { measures: missed, ..Made::default() };
        assert_eq!(FigureRecord::new(&heading(), &unexplained).verdict, Verdict::Missed);
        let met = Made { measures: vec![Measure::at_least("m", 1.0, "", 1.0)], caveat, ..Made::default() };
        assert_eq!(FigureRecord::new(&heading(), &met).verdict, Verdict::Reproduced);
        assert_eq!(FigureRecord::new(&heading(), &met).caveat, None);
    }

    #[test]
    fn x8_the_report_keeps_the_order_of_its_keys() {
        let record = FigureRecord::new(&heading(), &Made::default());
        let json = Report { figures: vec![record] }.json().unwrap();
        let keys =
            ["\"id\"", "\"paper\"", "\"title\"", "\"claim\"", "\"panels\"", "\"measures\"", "\"verdict\"", "\"note\""];
        let places: Vec<usize> = keys.iter().map(|key| json.find(key).unwrap()).collect();
        assert!(places.is_sorted(), "{json}");
    }
}
