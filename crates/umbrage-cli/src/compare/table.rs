//! The rows as a table for people.

use crate::scores::{NUMBERS, Number, Row, SHOWN};

/// Heads, and the cells of each row.
pub type Table = (Vec<String>, Vec<Vec<String>>);

/// Heads and cells: the light where there are several, what was compared, and its numbers.
pub fn table<'a>(rows: impl IntoIterator<Item = &'a Row>) -> Table {
    let rows: Vec<&Row> = rows.into_iter().collect();
    let several = rows.iter().any(|row| row.light != rows[0].light);
    let light = several.then(|| "light".to_owned());
    let shown = &NUMBERS[..SHOWN];
    let head = |number: &Number| format!("{}{}", number.head, if number.is_share { " %" } else { "" });
    let fixed = |words: &[&str]| words.iter().map(ToString::to_string).collect::<Vec<_>>();
    let heads = light.into_iter().chain(fixed(&["recipe", "map size"])).chain(shown.iter().map(head));
    let heads = heads.chain(fixed(&["bytes", "bake ms", "ns per look-up"])).collect();
    let cells = |row: &Row| {
        let made = row.made.as_ref();
        let or_dash = |text: Option<String>| text.unwrap_or_else(|| "-".into());
        let light = several.then(|| row.light.clone());
        let size = or_dash(made.map(|made| made.map_size.to_string()));
        let number = |number: &Number| {
            let text = |value: f64| {
                if number.is_share { format!("{:.3}", 100.0 * value) } else { format!("{value:.5}") }
            };
            or_dash((number.of)(row).map(text))
        };
        let bytes = or_dash(made.map(|made| made.bytes.to_string()));
        let bake = or_dash(made.map(|made| format!("{:.1}", made.bake_ms)));
        let look_up = or_dash(made.and_then(|made| made.look_up_ns).map(|time| format!("{time:.0}")));
        let cells = light.into_iter().chain([row.what.clone(), size]).chain(shown.iter().map(number));
        cells.chain([bytes, bake, look_up]).collect()
    };
    (heads, rows.into_iter().map(cells).collect())
}

/// The numbers that [`table`] leaves out.
pub fn further<'a>(rows: impl IntoIterator<Item = &'a Row>) -> Table {
    let others = NUMBERS[SHOWN..].iter().filter(|number| !["bake-ms", "look-up-ns"].contains(&number.name));
    let others: Vec<&Number> = others.collect();
    let fixed = ["recipe", "map size"].map(String::from);
    let heads = fixed.into_iter().chain(others.iter().map(|number| number.head.to_owned())).collect();
    let cells = |row: &Row| {
        let size = row.made.as_ref().map_or_else(|| "-".into(), |made| made.map_size.to_string());
        let number = |number: &&Number| (number.of)(row).map_or_else(|| "-".into(), |value| format!("{value:.4}"));
        [row.what.clone(), size].into_iter().chain(others.iter().map(number)).collect()
    };
    (heads, rows.into_iter().map(cells).collect())
}

/// The table in columns: words to the left, numbers to the right.
pub fn aligned((heads, rows): &Table) -> Vec<String> {
    let lines = || std::iter::once(heads).chain(rows);
    let length = |text: &String| text.chars().count();
    let widths: Vec<usize> =
        (0..heads.len()).map(|at| lines().map(|line| length(&line[at])).max().unwrap_or(0)).collect();
    let words = heads.iter().position(|head| head == "map size").unwrap_or(0);
    let line = |line: &Vec<String>| {
        let cell = |(at, cell): (usize, &String)| {
            let width = widths[at];
            if at < words { format!("{cell:width$}") } else { format!("{cell:>width$}") }
        };
        line.iter().enumerate().map(cell).collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    lines().map(line).collect()
}
