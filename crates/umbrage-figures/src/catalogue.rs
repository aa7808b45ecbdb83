//! The catalogue: every figure, in the order of the gallery.

use crate::figure::Figure;
use crate::{burley, reeves, umbrage, wang_molnar, williams, woo};

/// Every figure, paper by paper.
pub fn figures() -> impl Iterator<Item = &'static Figure> {
    let papers =
        [williams::FIGURES, reeves::FIGURES, woo::FIGURES, wang_molnar::FIGURES, burley::FIGURES, umbrage::FIGURES];
    papers.into_iter().flatten().copied()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_of_the_catalogue_are_unique_and_fit_for_folders() {
        let mut ids: Vec<&str> = figures().map(|figure| figure.id).collect();
        assert!(ids.iter().all(|id| id.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-')), "{ids:?}");
        ids.sort_unstable();
        assert!(ids.windows(2).all(|pair| !pair[0].eq_ignore_ascii_case(pair[1])), "{ids:?}");
        let papers: Vec<_> = figures().map(|figure| figure.paper).collect();
        assert!(papers.is_sorted(), "papers are told one after another");
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
}
