//! The gallery: one page that holds its styles, its script and its plots, and refers to the pictures beside it.

use crate::article::{Beside, article, attribute, badge, class, joined, mark, value};
use crate::made::Verdict;
use crate::measure::Bound;
use crate::record::{FigureRecord, Report};
use crate::text::figures;
use crate::text::{escape, html as set};
use std::fmt::Write;

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::article::table;
    use crate::made::{Made, Table};
    use crate::measure::Measure;
    use crate::panel::{Panel, Role};
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
