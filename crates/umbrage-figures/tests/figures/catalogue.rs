//! The catalogue's ids.

use umbrage_figures::catalogue::{choose, figures, words};

#[test]
fn ids_of_the_catalogue_are_unique_and_fit_for_folders() {
    let mut ids: Vec<&str> = figures().map(|figure| figure.id).collect();
    assert!(ids.iter().all(|id| id.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-')), "{ids:?}");
    ids.sort_unstable();
    assert!(ids.windows(2).all(|pair| !pair[0].eq_ignore_ascii_case(pair[1])), "{ids:?}");
    let papers: Vec<_> = figures().map(|figure| figure.paper).collect();
    assert!(papers.is_sorted(), "papers follow one another");
}

#[test]
fn figures_are_chosen_by_id_in_the_order_of_the_catalogue() {
    let ids = |only: &[&str]| {
        let only: Vec<String> = only.iter().map(ToString::to_string).collect();
        choose(&only).map(|chosen| chosen.iter().map(|figure| figure.id).collect::<Vec<_>>())
    };
    assert_eq!(ids(&[]).unwrap().len(), figures().count());
    assert_eq!(ids(&["r87-f7", "W78-F1"]).unwrap(), ["W78-F1", "R87-F7"]);
    assert_eq!(ids(&["W78-F1", "R87-F77"]).unwrap_err(), "R87-F77");
}

#[test]
fn every_figure_has_a_sentence_for_what_it_shows_and_one_for_where_to_look() {
    for figure in figures() {
        for text in [figure.claim, figure.look] {
            assert!(text.ends_with('.') && text.len() > 20, "{}: {text:?}", figure.id);
            assert!(!text.to_lowercase().starts_with("look"), "{}: the page says that itself", figure.id);
        }
    }
}

#[test]
fn every_question_leads_to_figures_that_there_are() {
    let words = words();
    assert!(words.questions.len() > 10);
    for (question, ids) in &words.questions {
        assert!(question.ends_with('?') && !ids.is_empty(), "{question:?}");
        let unknown = ids.iter().find(|id| !figures().any(|figure| figure.id == **id));
        assert_eq!(unknown, None, "{question}");
    }
}
