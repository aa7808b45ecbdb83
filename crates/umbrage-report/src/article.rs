//! A figure on the page: its pictures, plots, tables and measures.

use crate::made::{Table, Verdict};
use crate::measure::Bound;
use crate::panel::Role;
use crate::record::{FigureRecord, MeasureRecord, PanelRecord};
use crate::text::{escape, html as set, proper};
use std::collections::BTreeMap;
use std::fmt::Write;

/// What the page holds beside the report, by figure id and name.
#[derive(Default)]
pub struct Beside {
    /// SVG texts.
    pub plots: BTreeMap<(String, String), String>,
    /// Tables of the run alone.
    pub tables: BTreeMap<(String, String), Table>,
}

/// The texts of several items, one behind the other.
pub fn joined<T>(items: impl IntoIterator<Item = T>, each: impl Fn(T) -> String) -> String {
    items.into_iter().fold(String::new(), |text, item| text + &each(item))
}

/// The class of elements that are coloured by a verdict.
pub fn class(verdict: Verdict) -> String {
    format!("v-{}", verdict.word().replace(' ', "-"))
}

/// A verdict as a word in its colour.
pub fn badge(verdict: Verdict) -> String {
    format!("<span class=\"badge {}\">{}</span>", class(verdict), verdict.word())
}

/// A value with its unit, as HTML.
pub fn value(measure: &MeasureRecord) -> String {
    let value = set(&measure.value_text());
    if measure.unit.is_empty() || measure.value.is_none() || measure.word().is_some() {
        return value;
    }
    format!("{value} <span class=\"unit\">{}</span>", set(&measure.unit))
}

/// Whether a measure's bound is met, as a sign with a name.
pub fn mark(measure: &MeasureRecord) -> &'static str {
    match measure.pass {
        Some(true) => "<span class=\"mark met\" role=\"img\" aria-label=\"met\">✓</span>",
        Some(false) => "<span class=\"mark unmet\" role=\"img\" aria-label=\"not met\">✗</span>",
        None if matches!(measure.bound, Bound::NotJudged(_)) => {
            "<span class=\"mark unjudged\" role=\"img\" aria-label=\"not judged\">–</span>"
        }
        None => "<span class=\"mark\"></span>",
    }
}

/// All of a figure.
pub fn article(figure: &FigureRecord, beside: &Beside) -> String {
    let id = escape(&figure.id);
    let line = |class: &str, label: &str, text: &str| match set(text) {
        none if none.is_empty() => none,
        text => format!("<p class=\"{class}\"><span>{label}</span> {text}</p>"),
    };
    let claim = line("claim", "Must show", &figure.claim)
        + &line("claim", "Look at", &figure.look)
        + &line("claim", "Measured", &measured(&figure.measures));
    let mut text = format!(
        "<article id=\"{id}\"><header><p class=\"line\"><a href=\"#{id}\" class=\"id\">{id}</a>{}</p><h3>{}</h3>{claim}</header>\n",
        badge(figure.verdict),
        set(&figure.title),
    );
    if let Some(earlier) = &figure.earlier {
        let _ = writeln!(text, "<p class=\"earlier\"><b>Kept from an earlier run</b>, {}.</p>", set(earlier));
    }
    if let Some(caveat) = &figure.caveat {
        let _ = writeln!(text, "<p class=\"caveat\"><b>Caveat.</b> {}</p>", set(caveat));
    }
    let (wipe, measures) = (wipe(figure), measures(&figure.measures));
    let panels = match joined(&figure.panels, panel) {
        none if none.is_empty() => none,
        panels => format!("<div class=\"panels\">{panels}</div>\n"),
    };
    // Numbers stand beside a wipe; without one the pictures come first.
    if wipe.is_empty() {
        let _ = writeln!(text, "{panels}<div class=\"plate\">{measures}</div>");
    } else {
        let both = if measures.is_empty() { "" } else { " both" };
        let _ = writeln!(text, "<div class=\"plate{both}\">{wipe}{measures}</div>\n{panels}");
    }
    if !figure.plots.is_empty() {
        let svgs = figure.plots.iter().filter_map(|name| beside.plots.get(&(figure.id.clone(), name.clone())));
        let plots = joined(svgs, |svg| format!("<div class=\"plot\">{svg}</div>"));
        let _ = writeln!(text, "<div class=\"plots\">{plots}</div>");
    }
    text.extend(figure.tables.iter().map(|one| table(&one.head, &one.rows, "")));
    let of_run = figure.run_tables.iter().filter_map(|name| beside.tables.get(&(figure.id.clone(), name.clone())));
    text.extend(of_run.map(|one| table(&one.head, &one.rows, "<caption>Of the run that made this figure</caption>")));
    if !figure.note.is_empty() {
        let _ = writeln!(text, "<p class=\"note\">{}</p>", set(&figure.note));
    }
    text + "</article>\n"
}

/// What was measured, in a sentence: how many bounds are met, and one of the values, of a bound that is not met where there is one.
fn measured(measures: &[MeasureRecord]) -> String {
    let judged: Vec<&MeasureRecord> = measures.iter().filter(|measure| measure.pass.is_some()).collect();
    let Some(one) = judged.iter().find(|measure| measure.pass == Some(false)).or(judged.first()) else {
        return String::new();
    };
    let met = judged.iter().filter(|measure| measure.pass == Some(true)).count();
    let unit = if one.unit.is_empty() || one.word().is_some() { String::new() } else { format!(" {}", one.unit) };
    let first = format!("{}: {}{unit} ({})", one.name, one.value_text(), one.bound_text());
    match (met, judged.len()) {
        (1, 1) => format!("{first}."),
        (_, 1) => format!("{first}, which is not met."),
        (met, all) if met == all => format!("{first}, and {} more, all met.", all - 1),
        (met, all) => format!("{first}, which is not met; {met} of {all} bounds are."),
    }
}

/// The slider between each result and the panel that it is compared with.
fn wipe(figure: &FigureRecord) -> String {
    let partner = |panel: &PanelRecord| figure.panels.iter().find(|other| panel.against.as_ref() == Some(&other.name));
    let pairs: Vec<(&PanelRecord, &PanelRecord)> =
        figure.panels.iter().filter_map(|panel| Some((panel, partner(panel)?))).collect();
    let Some((first, truth)) = pairs.first() else { return String::new() };
    let mut tabs = String::new();
    for (result, truth) in &pairs {
        let _ = write!(
            tabs,
            "<button type=\"button\" aria-pressed=\"{}\" data-result=\"{}\" data-truth=\"{}\" data-other=\"{}\" \
             data-style=\"{}\">{}</button>",
            result.name == first.name,
            escape(&result.file),
            escape(&truth.file),
            attribute(&truth.caption),
            stage(result),
            set(&result.caption)
        );
    }
    let hidden = if pairs.len() == 1 { " hidden" } else { "" };
    let (style, result, other) = (stage(first), set(&first.caption), set(&truth.caption));
    let (alt, other_alt) = (attribute(&first.caption), attribute(&truth.caption));
    let lazy = lazy(first);
    format!(
        "<div class=\"wipe\"><div class=\"tabs\" role=\"group\" aria-label=\"Result\"{hidden}>{tabs}</div>\
         <div class=\"stage\" style=\"{style}\"><img class=\"under\" src=\"{}\" {lazy} alt=\"{alt}\">\
         <img class=\"over\" src=\"{}\" {lazy} alt=\"{other_alt}\"><span class=\"bar\"></span>\
         <input type=\"range\" min=\"0\" max=\"100\" step=\"0.5\" value=\"50\" \
         aria-label=\"Wipe between result and truth\"></div>\
         <p class=\"sides\"><span>{result}</span><span>{other}</span></p></div>",
        escape(&first.file),
        escape(&truth.file)
    )
}

/// Text inside an attribute, where powers are characters because markup is not possible.
pub fn attribute(text: &str) -> String {
    escape(&proper(text))
}

/// What keeps a picture's room free until it is scrolled to and loaded.
fn lazy(panel: &PanelRecord) -> String {
    let [width, height] = panel.size;
    format!("loading=\"lazy\" decoding=\"async\" width=\"{width}\" height=\"{height}\"")
}

/// Small pictures are enlarged by a whole number, so that every pixel keeps its shape.
fn stage(panel: &PanelRecord) -> String {
    const WIDEST: u32 = 520;
    let [width, height] = panel.size;
    let times = (WIDEST / width.max(1)).max(1);
    format!("width:{}px;aspect-ratio:{width}/{height}", width * times)
}

fn panel(panel: &PanelRecord) -> String {
    let (file, caption, alt) = (escape(&panel.file), set(&panel.caption), attribute(&panel.caption));
    let lazy = lazy(panel);
    let role = match panel.role {
        Role::Result => "",
        Role::Truth => "<span class=\"role truth\">truth</span>",
        Role::Error => "<span class=\"role error\">error</span>",
        Role::Map => "<span class=\"role\">data</span>",
    };
    let mut parameters = String::new();
    for (name, value) in &panel.parameters {
        let _ = write!(parameters, "<div><dt>{}</dt><dd>{}</dd></div>", set(name), set(value));
    }
    if panel.zoom > 1 {
        let _ = write!(parameters, "<div><dt>zoom</dt><dd>{} ×</dd></div>", panel.zoom);
    }
    let list = if parameters.is_empty() { String::new() } else { format!("<dl>{parameters}</dl>") };
    // Wider than a screen's column of pictures can show: all of the row.
    let wide = if panel.size[0] > 1024 { " class=\"wide\"" } else { "" };
    format!(
        "<figure{wide}><a href=\"{file}\" class=\"open\" data-caption=\"{alt}\" data-zoom=\"{}\"><img \
         src=\"{file}\" {lazy} alt=\"{alt}\"></a><figcaption><p>{caption}{role}</p>{list}\
         </figcaption></figure>\n",
        panel.zoom
    )
}

fn measures(measures: &[MeasureRecord]) -> String {
    if measures.is_empty() {
        return String::new();
    }
    let rows = joined(measures, |measure| {
        let (name, bound) = (set(&measure.name), set(&measure.bound_text()));
        let class = if measure.pass == Some(false) { " class=\"unmet\"" } else { "" };
        let told = if matches!(measure.bound, Bound::NotJudged(_)) { " told" } else { "" };
        format!(
            "<tr{class}><td>{}</td><td>{name}</td><td class=\"number\">{}</td><td class=\"bound{told}\">{bound}</td></tr>",
            mark(measure),
            value(measure)
        )
    });
    format!(
        "<div class=\"measures\"><table><thead><tr><th><span class=\"unseen\">Met</span></th><th>Measure</th><th \
         class=\"number\">Value</th><th class=\"bound\">Bound</th></tr></thead><tbody>{rows}</tbody></table></div>"
    )
}

/// A table; columns of numbers are aligned right. `caption` is HTML.
pub fn table(head: &[String], rows: &[Vec<String>], caption: &str) -> String {
    // A column of numbers is aligned right, its head too.
    let numbers = |column: usize| {
        let mut cells = rows.iter().filter_map(|row| row.get(column)).filter(|cell| !cell.is_empty()).peekable();
        cells.peek().is_some() && cells.all(|cell| cell.parse::<f64>().is_ok())
    };
    let cells = |row: &[String], tag: &str| {
        joined(row.iter().enumerate(), |(column, cell)| {
            let class = if numbers(column) { " class=\"number\"" } else { "" };
            format!("<{tag}{class}>{}</{tag}>", set(cell))
        })
    };
    let body = joined(rows, |row| format!("<tr>{}</tr>", cells(row, "td")));
    format!(
        "<div class=\"table\" tabindex=\"0\"><table>{caption}<thead><tr>{}</tr></thead><tbody>{body}</tbody></table></div>\n",
        cells(head, "th")
    )
}
