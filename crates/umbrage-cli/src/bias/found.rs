//! What was found by trying.

use serde_json::{Value, json};
use std::fmt;
use umbrage_oracle::{BiasKind, BiasShares, BiasWindow};

/// One kind of bias.
pub struct Tried {
    pub kind: BiasKind,
    pub window: BiasWindow,
    /// The largest amount that was tried.
    pub most: f64,
    /// The smallest amount without false shadow, or the largest that was tried.
    pub amount: f64,
    /// The faults that it leaves.
    pub shares: BiasShares,
}

/// All kinds, over one map.
pub struct Found {
    /// Lit and shadowed pixels that were judged.
    pub pixels: [usize; 2],
    /// The faults without a bias.
    pub without: BiasShares,
    pub tried: [Tried; 3],
}

impl Found {
    /// The kind to use in engines: of those that work, the one with the least false light; otherwise the one that leaves the fewest faults.
    pub fn chosen(&self) -> &Tried {
        let wrong = |tried: &Tried| (!tried.window.works(), tried.shares.false_light + tried.shares.false_shadow);
        let mut chosen = &self.tried[0];
        for tried in &self.tried[1..] {
            if wrong(tried) < wrong(chosen) {
                chosen = tried;
            }
        }
        chosen
    }

    pub fn json(&self) -> Value {
        let kinds = self.tried.iter().map(|tried| {
            let BiasWindow { acne_free, keeps_contact } = tried.window;
            json!({
                "kind": tried.kind.to_string(), "unit": tried.kind.unit(),
                "acne_free": acne_free, "keeps_contact": keeps_contact, "works": tried.window.works(),
                "amount": tried.amount, "false_shadow": tried.shares.false_shadow, "false_light": tried.shares.false_light,
            })
        });
        json!({
            "lit_pixels": self.pixels[0], "shadowed_pixels": self.pixels[1],
            "without": { "false_shadow": self.without.false_shadow, "false_light": self.without.false_light },
            "biases": kinds.collect::<Vec<_>>(),
        })
    }
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [lit, dark] = self.pixels;
        writeln!(f, "judged: {lit} lit pixels and {dark} in shadow")?;
        let BiasShares { false_shadow, false_light } = self.without;
        writeln!(
            f,
            "without a bias there is {} false shadow on the lit pixels and {} false light on the others",
            percent(false_shadow),
            percent(false_light)
        )?;
        for Tried { kind, window, most, amount, shares } in &self.tried {
            let unit = kind.unit();
            let from = window.acne_free.map_or_else(|| "no amount".into(), |from| format!("{} {unit}", short(from)));
            let to = match window.keeps_contact {
                None => "none".into(),
                Some(to) if to >= *most => format!("at least {} {unit}", short(to)),
                Some(to) => format!("{} {unit}", short(to)),
            };
            write!(f, "{kind}: false shadow ends at {from}, contacts hold up to {to}: ")?;
            if window.works() {
                writeln!(f, "it works")?;
            } else {
                let (shadow, light) = (percent(shares.false_shadow), percent(shares.false_light));
                writeln!(f, "none exists; {} leaves {shadow} false shadow and {light} false light", short(*amount))?;
            }
        }
        writeln!(f, "`--recipe auto` needs none")
    }
}

fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}

/// Three significant digits.
pub fn short(value: f64) -> String {
    let digits = if value == 0.0 { 0 } else { (2 - value.abs().log10().floor() as i32).clamp(0, 12) };
    format!("{value:.*}", digits as usize)
}
