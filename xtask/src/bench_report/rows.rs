//! The rows that the program prints, and whether they reach their goals.

use anyhow::{Context as _, bail, ensure};

/// All that one run printed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    pub rows: Vec<Row>,
    /// How many times as much two threads did as one.
    pub spin: f64,
    /// The instructions that were chosen while it ran.
    pub instructions: String,
}

/// One comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    pub group: String,
    pub what: String,
    pub unit: String,
    pub ours: f64,
    pub peer: String,
    pub theirs: f64,
    pub goal: Goal,
}

/// What a row should reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// The peer takes at least so many times as long.
    Faster(f64),
    /// It takes at most so many times the peer.
    Within(f64),
    Free,
}

impl Row {
    /// The peer's over ours where that is what the goal is about, ours over the peer's otherwise.
    pub fn ratio(&self) -> f64 {
        if let Goal::Faster(_) = self.goal { self.theirs / self.ours } else { self.ours / self.theirs }
    }

    /// Whether the goal is met; `None` where there is none.
    pub fn met(&self) -> Option<bool> {
        match self.goal {
            Goal::Faster(times) => Some(self.ratio() >= times),
            Goal::Within(times) => Some(self.ratio() <= times),
            Goal::Free => None,
        }
    }
}

impl Report {
    /// From what the program printed: lines of fields between tabs.
    pub fn parse(text: &str) -> anyhow::Result<Self> {
        let mut report = Self::default();
        for line in text.lines() {
            report.line(line).with_context(|| format!("a line of the program's: {line:?}"))?;
        }
        ensure!(!report.rows.is_empty(), "the program printed no row");
        Ok(report)
    }

    fn line(&mut self, line: &str) -> anyhow::Result<()> {
        match line.split('\t').collect::<Vec<_>>().as_slice() {
            ["fact", "spin", value] => self.spin = value.parse()?,
            ["fact", "instructions", value] => self.instructions = (*value).into(),
            ["row", group, what, unit, ours, peer, theirs, kind, times] => {
                let times = times.parse()?;
                let goal = match *kind {
                    "faster" => Goal::Faster(times),
                    "within" => Goal::Within(times),
                    "free" => Goal::Free,
                    other => bail!("there is no goal {other:?}"),
                };
                self.rows.push(Row {
                    group: (*group).into(),
                    what: (*what).into(),
                    unit: (*unit).into(),
                    ours: ours.parse()?,
                    peer: (*peer).into(),
                    theirs: theirs.parse()?,
                    goal,
                });
            }
            _ => bail!("it is neither a row nor a fact"),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_read_and_judged() {
        let text = "row\tpass 1\tlayers\tms\t2.0\teuc\t20.0\tfaster\t10\n\
                    row\tpass 1\tmidpoint\tms\t3.0\tfirst\t2.0\twithin\t1.4\n\
                    row\tmemory\tfacets\tKiB\t1.0\traw\t2.0\tfree\t0\nfact\tspin\t1.95\nfact\tinstructions\tAvx2\n";
        let report = Report::parse(text).unwrap();
        let judged: Vec<_> = report.rows.iter().map(|row| (row.ratio(), row.met())).collect();
        assert_eq!(judged, [(10.0, Some(true)), (1.5, Some(false)), (0.5, None)]);
        assert_eq!((report.spin, report.instructions.as_str()), (1.95, "Avx2"));
    }

    #[test]
    fn what_is_no_row_is_refused() {
        for text in ["", "row\ta", "fact\tspin\tfast", "row\ta\tb\tms\t1\tc\t2\tslower\t3"] {
            assert!(Report::parse(text).is_err(), "{text:?}");
        }
    }
}
