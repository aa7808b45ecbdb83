//! What holds back the rows that miss their goals, and which rows of the same report show it.

use super::rows::{Goal, Row};

/// How far a row is from its goal, %; `None` where it has none.
fn missed_by(row: &Row) -> Option<f64> {
    match row.goal {
        Goal::Faster(times) => Some((times / row.ratio() - 1.0) * 100.0),
        Goal::Within(times) => Some((row.ratio() / times - 1.0) * 100.0),
        Goal::Free => None,
    }
}

/// A line about a row that misses its goal: by how much, and what holds it back; `None` for any other row.
pub fn line(row: &Row, rows: &[Row]) -> Option<String> {
    if row.met() != Some(false) {
        return None;
    }
    let by = missed_by(row)?;
    let why = why(row, rows).unwrap_or_else(|| "Not looked into".into());
    Some(format!("* {}, beside {}: {by:.0} % more time than its goal allows. {why}.", row.what, row.peer))
}

/// The value of ours in the row of a name, of the same map if the name has none.
fn ours(rows: &[Row], like: &Row, what: &str) -> Option<f64> {
    let map = like.what.rsplit_once(" at ").map_or("", |(_, map)| map);
    rows.iter().find(|row| row.what == format!("{what} at {map}")).map(|row| row.ours)
}

fn why(row: &Row, rows: &[Row]) -> Option<String> {
    let part = |what: &str| ours(rows, row, what);
    let alone = |storages: [&str; 2]| -> Option<[f64; 2]> {
        let [a, b] = storages.map(|storage| part(&format!("sixteen depths alone, {storage}")));
        Some([a?, b?])
    };
    let share = |part: f64| format!("{:.0} %", part / row.ours * 100.0);
    let (what, map) = row.what.rsplit_once(" at ")?;
    let has = |text: &str| what.starts_with(text);
    Some(match row.group.as_str() {
        "pass 1" if row.peer == "euc" && has("1-texel") => {
            let binned = part(&format!("{what}, set up and binned alone"))?;
            let apart = rows.iter().find(|other| other.what == row.what && other.peer == "its triangles one by one")?;
            format!(
                "Setting triangles up and sorting them into tiles takes {}, before any is drawn: each is kept in 64 bytes, written once and read once, where euc \
                 draws it as it comes. Corners that triangles share are projected once for some thousands of them; one by one they take {:.0} % more",
                share(binned),
                (apart.theirs / row.ours - 1.0) * 100.0
            )
        }
        "pass 1" if row.peer == "euc" && has("100-texel") => {
            let binned = part(&format!("{what}, set up and binned alone"))?;
            format!(
                "{} go into triangles before any is drawn; the rest is spent on rows of 14 texels at most, of which eight at a time leave lanes empty",
                share(binned)
            )
        }
        "pass 1" if row.peer == "euc" || row.peer.starts_with("memory") => {
            "Writing the map once and reading it back for each layer bounds it: the row beside memory says by how much".into()
        }
        "pass 1" if has("refined facets") => {
            let second = part(what.replace("refined facets", "facets").as_str())?;
            format!(
                "A texel that an edge runs through is sampled sixteen times and its links sixteen times each; a map of facets without them takes {}",
                share(second)
            )
        }
        "pass 1" if has("midpoint") => {
            "It keeps two depths of each texel until both are known, and resolves them together: twice what a map of this size writes for one".into()
        }
        "pass 1" if has("facets") => {
            "Which facet is nearest is found by a second walk over the fragments, and indices and planes are packed tile by tile".into()
        }
        "look-ups" if has("burley") => {
            let closer = part("pcf-bias raw")?;
            format!("It looks at two sets of 16 places, blockers first and then the blur; 16 of a plain bias take {closer:.0} ns")
        }
        "look-ups" if has("pcf-bias facets") => {
            let [facets, tiled] = alone(["facets", "tiled"])?;
            format!(
                "Sixteen depths alone take {facets:.0} ns from facets, {tiled:.0} ns from tiles: at each place it finds a tile, the index of a facet among \
                 small numbers of the tile's own width, and that facet's plane in f64, where tiles have one f32"
            )
        }
        "look-ups" if row.peer == "listing" => {
            let (transform, from) = match what.split_once(", ") {
                Some((_, from)) => (String::new(), format!(", {from}")),
                None => (format!("the transform alone takes {:.1} ns; ", part("transform alone")?), String::new()),
            };
            let table = part(&format!("pcf-table raw{from}"))?;
            let goal = match row.goal {
                Goal::Faster(times) => row.theirs / times,
                _ => row.theirs,
            };
            format!(
                "The listing's {:.0} ns leave {goal:.1} ns by this goal; {transform}with the jitter from a table, without hashing, a look-up still takes \
                 {table:.1} ns: 16 comparisons at 16 places",
                row.theirs
            )
        }
        "look-ups" if row.peer == "raw" => {
            let [tiled, raw] = alone(["tiled", "raw"])?;
            format!(
                "Sixteen depths alone take {tiled:.0} ns from tiles, {raw:.0} ns from a plain array, where a place needs an index less; where a plane is \
                 compared, its bounds are made for the tiles' ranges besides"
            )
        }
        "look-ups" if has("auto") => format!(
            "At {map} these regions are wider than sixteen samples of the finer grid, and are judged place by place; at 1024² they are not",
        ),
        "look-ups" => {
            let transform = part("transform alone")?;
            format!("{transform:.1} ns of both are the transform; the rest compares a depth of its own at each of 16 places")
        }
        "whole job" => {
            let (kind, baked) = if has("bake and auto") { ("auto", "bake for auto alone") } else { ("pcf", "bake alone") };
            let triangles = what.split_once(", ").map_or("", |(_, triangles)| triangles);
            let bake = part(&format!("{baked}, {triangles}"))?;
            let goal = match row.goal {
                Goal::Faster(times) => row.theirs / times,
                _ => row.theirs,
            };
            format!(
                "The goal is {goal:.0} ms, of which the bake takes {bake:.0} ms; a million look-ups of {kind} take the other {:.0} ms, the peer takes {:.0} ns \
                 for each point, its tree included",
                row.ours - bake,
                row.theirs
            )
        }
        "pictures" => {
            let maps = part(&what.replacen("with shadows", "maps alone", 1))?;
            let added = row.ours - row.theirs;
            let (transform, look_up) = (part("transform alone")?, part("pcf-bias tiled")?);
            format!(
                "Of {added:.0} ms that shadows add, {maps:.0} ms are maps, and all else is look-ups of each surface in each pixel for each light; of a \
                 look-up's {look_up:.0} ns, {transform:.0} ns are the transform to the light's view"
            )
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(group: &str, what: &str, ours: f64, (peer, theirs): (&str, f64), goal: Goal) -> Row {
        Row { group: group.into(), what: what.into(), unit: "ms".into(), ours, peer: peer.into(), theirs, goal }
    }

    #[test]
    fn a_missed_goal_is_explained_by_rows_of_the_same_map() {
        let rows = [
            row("pass 1", "1-texel-grid at 1024²", 80.0, ("euc", 40.0), Goal::Faster(8.0)),
            row("pass 1", "1-texel-grid, set up and binned alone at 4096²", 10.0, ("all of it", 80.0), Goal::Free),
            row("pass 1", "1-texel-grid, set up and binned alone at 1024²", 60.0, ("all of it", 80.0), Goal::Free),
            row("pass 1", "1-texel-grid at 1024²", 80.0, ("its triangles one by one", 92.0), Goal::Free),
        ];
        let text = line(&rows[0], &rows).expect("a missed goal");
        assert!(
            text.starts_with("* 1-texel-grid at 1024², beside euc: 1500 % more time than its goal allows. "),
            "{text}"
        );
        assert!(text.contains("takes 75 %, before"), "{text}");
        assert!(text.ends_with("one by one they take 15 % more."), "{text}");
        assert_eq!(line(&rows[1], &rows), None, "a row without a goal");
    }

    #[test]
    fn what_nobody_looked_into_says_so() {
        let rows = [row("else", "a at 1", 3.0, ("b", 1.0), Goal::Within(2.0))];
        let text = line(&rows[0], &rows).expect("a missed goal");
        assert_eq!(text, "* a at 1, beside b: 50 % more time than its goal allows. Not looked into.");
    }
}
