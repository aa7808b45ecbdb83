//! The gallery: one page that holds its styles, its script and its plots, and refers to the pictures beside it.

use crate::made::{Table, Verdict};
use crate::measure::Bound;
use crate::panel::Role;
use crate::record::{FigureRecord, MeasureRecord, PanelRecord, Report};
use crate::text::figures;
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

/// What stands on top of a page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Words {
    /// The title of the window.
    pub title: String,
    /// The heading.
    pub heading: String,
    /// A sentence under it.
    pub lead: String,
    /// Questions that readers come with, each with the ids of the figures that answer it. Ids that the report does not hold are left out, and
    /// questions without one.
    pub questions: Vec<(String, Vec<String>)>,
}

impl Default for Words {
    /// The gallery of the papers' figures.
    fn default() -> Self {
        Self {
            title: "Umbrage: figures".into(),
            heading: "Shadows from depth maps".into(),
            lead: "The figures of the papers, made again from their algorithms and measured against ray-traced truth."
                .into(),
            questions: Vec::new(),
        }
    }
}

/// The page's text.
pub fn html(report: &Report, words: &Words, quick: bool, beside: &Beside) -> String {
    fill(include_str!("gallery/page.html"), |slot| match slot {
        "css" => include_str!("gallery/page.css").into(),
        "js" => include_str!("gallery/page.js").into(),
        "title" => attribute(&words.title),
        "heading" => set(&words.heading),
        "lead" => set(&words.lead),
        "tally" => tally(report),
        "quick" if quick => {
            "<p class=\"quick\">A quick run: pictures are smaller, and bounds that need full size are not judged.</p>"
                .into()
        }
        "nav" => nav(report),
        "questions" => questions(report, &words.questions),
        "summary" => report.figures.iter().map(summary_row).collect(),
        "sections" => sections(report, beside),
        _ => String::new(),
    })
}

/// Replaces `{{name}}` by what `value` says of it, in one pass: what is put in is not looked at again.
fn fill(template: &str, value: impl Fn(&str) -> String) -> String {
    let mut text = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        let Some((name, behind)) = after.split_once("}}") else { break };
        text.push_str(before);
        text.push_str(&value(name));
        rest = behind;
    }
    text + rest
}

/// The texts of several items, one behind the other.
fn joined<T>(items: impl IntoIterator<Item = T>, each: impl Fn(T) -> String) -> String {
    items.into_iter().fold(String::new(), |text, item| text + &each(item))
}

fn class(verdict: Verdict) -> String {
    format!("v-{}", verdict.word().replace(' ', "-"))
}

fn badge(verdict: Verdict) -> String {
    format!("<span class=\"badge {}\">{}</span>", class(verdict), verdict.word())
}

fn tally(report: &Report) -> String {
    let all = figures(report.figures.len());
    let mut text = match all.split_once(' ') {
        Some((count, word)) => format!("<li><b>{count}</b> {word}</li>"),
        None => String::new(),
    };
    for verdict in Verdict::ALL {
        let count = report.count(verdict);
        if count > 0 {
            let _ = write!(text, "<li class=\"{}\"><b>{count}</b> {}</li>", class(verdict), verdict.word());
        }
    }
    text
}

/// The figures of each paper, in order.
fn by_paper(report: &Report) -> Vec<(&str, &[FigureRecord])> {
    report.figures.chunk_by(|a, b| a.paper == b.paper).map(|chunk| (chunk[0].paper.as_str(), chunk)).collect()
}

fn nav(report: &Report) -> String {
    let mut text = String::new();
    for (paper, figures) in by_paper(report) {
        let _ = write!(text, "<div class=\"group\"><span class=\"paper\">{}</span>", escape(paper));
        for figure in figures {
            let (id, title, tip) = (escape(&figure.id), set(&figure.title), attribute(&figure.title));
            let class = class(figure.verdict);
            let _ = write!(
                text,
                "<a class=\"{class}\" href=\"#{id}\" title=\"{tip}\"><b>{id}</b> <span>{title}</span></a>"
            );
        }
        text.push_str("</div>");
    }
    text
}

/// The questions that figures of the report answer.
fn questions(report: &Report, questions: &[(String, Vec<String>)]) -> String {
    let items = joined(questions, |(question, ids)| {
        let known = report.figures.iter().filter(|figure| ids.contains(&figure.id));
        let links = joined(known, |figure| {
            format!("<li><a href=\"#{0}\">{0}</a> {1}</li>", escape(&figure.id), set(&figure.title))
        });
        if links.is_empty() { links } else { format!("<dt>{}</dt><dd><ul>{links}</ul></dd>", set(question)) }
    });
    if items.is_empty() {
        return items;
    }
    format!("<details id=\"questions\"><summary>Which figure answers my question?</summary><dl>{items}</dl></details>")
}

fn summary_row(figure: &FigureRecord) -> String {
    const KEY_MEASURES: usize = 2;
    let missed = figure.measures.iter().filter(|measure| measure.pass == Some(false));
    let met = figure.measures.iter().filter(|measure| measure.pass == Some(true));
    let unjudged = figure.measures.iter().filter(|measure| matches!(measure.bound, Bound::NotJudged(_)));
    let key = joined(missed.chain(met).chain(unjudged).take(KEY_MEASURES), |measure| {
        let (name, value, bound) = (set(&measure.name), value(measure), set(&measure.bound_text()));
        format!("<li>{} {name}: <b>{value}</b> <i>{bound}</i></li>", mark(measure))
    });
    let (id, title) = (escape(&figure.id), set(&figure.title));
    format!(
        "<tr><th scope=\"row\"><a href=\"#{id}\">{id}</a></th><td>{title}</td><td>{}</td><td><ul>{key}</ul></td></tr>\n",
        badge(figure.verdict)
    )
}

/// A value with its unit, as HTML.
fn value(measure: &MeasureRecord) -> String {
    let value = set(&measure.value_text());
    if measure.unit.is_empty() || measure.value.is_none() || measure.word().is_some() {
        return value;
    }
    format!("{value} <span class=\"unit\">{}</span>", set(&measure.unit))
}

fn mark(measure: &MeasureRecord) -> &'static str {
    match measure.pass {
        Some(true) => "<span class=\"mark met\" role=\"img\" aria-label=\"met\">✓</span>",
        Some(false) => "<span class=\"mark unmet\" role=\"img\" aria-label=\"not met\">✗</span>",
        None if matches!(measure.bound, Bound::NotJudged(_)) => {
            "<span class=\"mark unjudged\" role=\"img\" aria-label=\"not judged\">–</span>"
        }
        None => "<span class=\"mark\"></span>",
    }
}

fn sections(report: &Report, beside: &Beside) -> String {
    let mut text = String::new();
    for (index, (paper, figures)) in by_paper(report).into_iter().enumerate() {
        let _ = writeln!(text, "<section class=\"paper\" id=\"paper-{}\"><h2>{}</h2>", index + 1, escape(paper));
        for figure in figures {
            text.push_str(&article(figure, beside));
        }
        text.push_str("</section>\n");
    }
    text
}

fn article(figure: &FigureRecord, beside: &Beside) -> String {
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

/// Text inside an attribute, where no markup can raise a power.
fn attribute(text: &str) -> String {
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

fn table(head: &[String], rows: &[Vec<String>], caption: &str) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::made::Made;
    use crate::measure::Measure;
    use crate::panel::Panel;
    use crate::record::Heading;
    use glam::UVec2;

    fn report() -> Report {
        let panel = |name: &str| Panel::grey(name, "<b>caption</b>", UVec2::new(8, 4), vec![0.0; 32]);
        let made = Made {
            panels: vec![panel("result").with("\"p\"", "<v>").against("truth"), panel("truth").role(Role::Truth)],
            plots: vec![("curve".into(), "<svg id=\"plot\"></svg>".into())],
            tables: vec![Table { name: "t".into(), head: vec!["<h>".into()], rows: vec![vec!["{{css}}".into()]] }],
            measures: vec![Measure::new("<m>", 1.0, "<u>", Bound::AtMost(0.5))],
            run_tables: Vec::new(),
            note: "a & b".into(),
            caveat: Some("1 > 0.5".into()),
            timings: vec![("secret".into(), 12.345)],
        };
        let heading = Heading {
            id: "T-1".into(),
            paper: "Umbrage".into(),
            title: "<title>".into(),
            claim: "<claim>".into(),
            look: String::new(),
        };
        Report { figures: vec![FigureRecord::new(&heading, &made)] }
    }

    fn page() -> String {
        let plots = [(("T-1".to_string(), "curve".to_string()), "<svg id=\"plot\"></svg>".to_string())];
        html(&report(), &Words::default(), true, &Beside { plots: plots.into(), ..Beside::default() })
    }

    #[test]
    fn everything_a_figure_says_is_escaped() {
        let page = page();
        for raw in ["<b>caption", "\"p\"", "<v>", "<h>", "<m>", "<u>", "<claim>", "1 > 0.5", "a & b"] {
            assert!(!page.contains(raw), "{raw}");
        }
        assert!(page.contains("<td>{{css}}</td>"), "what is put in is not a slot");
        assert!(page.contains("&lt;title&gt;") && page.contains("1 &gt; 0.5"));
    }

    #[test]
    fn the_page_needs_nothing_from_elsewhere() {
        let page = page();
        assert!(!page.contains("http:") && !page.contains("https:") && !page.contains("src=\"/"), "an address outside");
        assert!(page.contains("src=\"T-1/result.png\"") && page.contains("<svg id=\"plot\">"));
        assert!(page.contains("aria-label=\"Wipe between") && page.contains("badge v-caveat"));
        assert!(!page.contains("12.345"), "x8 no times");
        assert!(
            page.contains("A quick run")
                && !html(&report(), &Words::default(), false, &Beside::default()).contains("A quick run")
        );
    }

    #[test]
    fn an_empty_report_is_a_page_too() {
        assert!(
            html(&Report { figures: Vec::new() }, &Words::default(), false, &Beside::default())
                .contains("<b>0</b> figures")
        );
    }

    fn one(measures: Vec<Measure>, claim: &str) -> String {
        let heading = Heading {
            id: "T-1".into(),
            paper: "P".into(),
            title: "T".into(),
            claim: claim.into(),
            look: String::new(),
        };
        let made = Made { measures, ..Made::default() };
        html(&Report { figures: vec![FigureRecord::new(&heading, &made)] }, &Words::default(), true, &Beside::default())
    }

    #[test]
    fn a_figure_of_which_nothing_is_judged_is_counted_apart() {
        let page = one(vec![Measure::at_most("m", 1e-3, "", 1.0).full_size(true)], "c");
        assert!(page.contains("<li><b>1</b> figure</li>"), "not several");
        assert!(page.contains("<li class=\"v-not-judged\"><b>1</b> not judged</li>"));
        assert!(!page.contains("</b> reproduced</li>"));
        assert!(page.contains("aria-label=\"not judged\"") && page.contains("not judged: ≤ 1 is meant for full size"));
    }

    #[test]
    fn an_answer_reads_as_a_word() {
        let page = one(vec![Measure::yes("falls", false)], "c");
        assert!(page.contains("<td>falls</td><td class=\"number\">no</td><td class=\"bound\">yes</td>"));
        assert!(!page.contains("yes = 1") && !page.contains("= 1<"));
    }

    #[test]
    fn what_was_measured_is_a_sentence() {
        let [good, bad] = [Measure::at_most("m", 0.25, "px", 1.0), Measure::at_most("n", 2.0, "px", 1.0)];
        let says = |measures: Vec<Measure>| {
            let page = one(measures, "c");
            page.split("<span>Measured</span> ").nth(1).map(|rest| rest.split("</p>").next().unwrap().to_owned())
        };
        assert_eq!(says(vec![]), None);
        assert_eq!(says(vec![good.clone()]).unwrap(), "m: 0.25 px (≤ 1).");
        assert_eq!(says(vec![bad.clone()]).unwrap(), "n: 2 px (≤ 1), which is not met.");
        assert_eq!(says(vec![good.clone(), good.clone()]).unwrap(), "m: 0.25 px (≤ 1), and 1 more, all met.");
        assert_eq!(says(vec![good, bad]).unwrap(), "n: 2 px (≤ 1), which is not met; 1 of 2 bounds are.");
    }

    #[test]
    fn questions_lead_to_figures_that_the_report_holds() {
        let question = |question: &str, id: &str| (question.to_string(), vec![id.to_string()]);
        let words =
            Words { questions: vec![question("Why <so>?", "T-1"), question("Who?", "T-2")], ..Words::default() };
        let page = html(&report(), &words, false, &Beside::default());
        assert!(
            page.contains("<dt>Why &lt;so&gt;?</dt><dd><ul><li><a href=\"#T-1\">T-1</a> &lt;title&gt;</li></ul></dd>")
        );
        assert!(!page.contains("Who?"));
        assert!(!html(&report(), &Words::default(), false, &Beside::default()).contains("<details id=\"questions\""));
    }

    #[test]
    fn powers_and_greek_are_set() {
        let page = one(vec![Measure::at_most("tau", 2e-9, "", 1e-6)], "as N^−¾, below 1e-3");
        assert!(page.contains("as N<sup>−¾</sup>, below 10⁻³") && page.contains("<td>τ</td>"));
        assert!(page.contains(">2 × 10⁻⁹<") && page.contains("≤ 10⁻⁶"));
    }

    #[test]
    fn pictures_keep_their_room_and_load_when_they_are_near() {
        let page = page();
        let pictures: Vec<&str> = page.split("<img ").skip(1).filter(|tag| tag.contains("src=")).collect();
        assert_eq!(pictures.len(), 4, "a wipe of two and two panels");
        for tag in pictures {
            let tag = tag.split('>').next().unwrap();
            assert!(["loading=\"lazy\"", "width=\"8\"", "height=\"4\""].iter().all(|part| tag.contains(part)), "{tag}");
        }
    }

    #[test]
    fn columns_of_numbers_are_aligned_right() {
        let rows = [vec!["a".to_string(), "-1.5".into()], vec!["b".into(), String::new()]];
        let text = table(&["name".into(), "n".into()], &rows, "");
        assert!(text.contains("<th>name</th><th class=\"number\">n</th>"), "{text}");
        assert!(text.contains("<td>a</td><td class=\"number\">−1.5</td>"), "{text}");
    }
}
