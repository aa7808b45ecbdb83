//! The catalogue: every figure, in the order of the gallery.

use crate::figure::Figure;
use crate::questions::QUESTIONS;
use crate::{burley, reeves, umbrage, wang_molnar, williams, woo};
use umbrage_report::Words;

/// Every figure, paper by paper.
pub fn figures() -> impl Iterator<Item = &'static Figure> {
    let papers =
        [williams::FIGURES, reeves::FIGURES, woo::FIGURES, wang_molnar::FIGURES, burley::FIGURES, umbrage::FIGURES];
    papers.into_iter().flatten().copied()
}

/// The text at the top of the gallery's page.
pub fn words() -> Words {
    let question =
        |(question, ids): &(&str, &[&str])| ((*question).into(), ids.iter().map(|id| (*id).into()).collect());
    Words { questions: QUESTIONS.iter().map(question).collect(), ..Words::default() }
}

/// The figures with these ids, in the order of the catalogue; all for no id.
///
/// # Errors
/// The first id that is unknown. Capital and small letters are the same.
pub fn choose(ids: &[String]) -> Result<Vec<&'static Figure>, String> {
    let known = |id: &String| figures().any(|figure| figure.id.eq_ignore_ascii_case(id));
    if let Some(unknown) = ids.iter().find(|id| !known(id)) {
        return Err(unknown.clone());
    }
    let asked = |figure: &&Figure| ids.is_empty() || ids.iter().any(|id| figure.id.eq_ignore_ascii_case(id));
    Ok(figures().filter(asked).collect())
}
