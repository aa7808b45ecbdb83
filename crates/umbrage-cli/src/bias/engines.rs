//! A bias in engines' own settings.

use super::found::{Found, Tried, short};
use anyhow::Context;
use serde_json::{Map as Object, Value, json};
use std::fmt;
use umbrage_depth::Map;
use umbrage_engines::{Conditions, Engine, Translation, WorldBias};
use umbrage_oracle::{BiasKind, BiasTrial};
use umbrage_plane::View;

/// A bias, and the settings of engines that give it.
pub struct Translated {
    kind: BiasKind,
    amount: f64,
    works: bool,
    /// Where it holds; `None` where no pixel is judged.
    at: Option<Conditions>,
    engines: Vec<(Engine, Result<Translation, String>)>,
    /// Whether sources are printed as well.
    in_full: bool,
}

/// The settings of one engine, or of all, for the bias that was chosen; at the median receiver.
///
/// # Errors
/// A receiver for which engines have no settings.
pub fn translated(
    found: &Found,
    view: &View,
    trial: &BiasTrial<'_, Map>,
    engine: Option<Engine>,
) -> anyhow::Result<Translated> {
    let Tried { kind, amount, window, .. } = found.chosen();
    let wanted = match kind {
        BiasKind::Constant => WorldBias::constant(*amount),
        BiasKind::Slope => WorldBias::slope(*amount),
        BiasKind::Normal => WorldBias::normal(*amount),
    };
    let at =
        trial.median().map(|receiver| Conditions::of(view, &receiver)).transpose().context("the median receiver")?;
    let all = engine.map_or(Engine::ALL.to_vec(), |engine| vec![engine]);
    let engines = at.iter().flat_map(|at| {
        let settings = |engine: Engine| engine.settings(&wanted, at).map_err(|error| error.to_string());
        all.iter().map(move |engine| (*engine, settings(*engine))).collect::<Vec<_>>()
    });
    let engines = engines.collect();
    Ok(Translated { kind: *kind, amount: *amount, works: window.works(), at, engines, in_full: engine.is_some() })
}

impl Translated {
    pub fn json(&self) -> Value {
        let engines: Object<String, Value> = self
            .engines
            .iter()
            .map(|(engine, settings)| {
                let value = match settings {
                    Err(error) => json!({ "error": error }),
                    Ok(Translation { settings, unmet, .. }) => {
                        let one = |setting: &umbrage_engines::Setting| {
                            (setting.info.name.to_owned(), json!([setting.least, setting.most]))
                        };
                        let settings: Object<String, Value> = settings.iter().map(one).collect();
                        json!({ "settings": settings, "unmet": unmet.iter().map(ToString::to_string).collect::<Vec<_>>() })
                    }
                };
                (engine.name().to_owned(), value)
            })
            .collect();
        json!({ "kind": self.kind.to_string(), "amount": self.amount, "settings": engines })
    }
}

impl fmt::Display for Translated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(at) = &self.at else { return writeln!(f, "no pixel is judged: no bias is translated") };
        let what = if self.works { "" } else { ", which leaves the least wrong" };
        writeln!(
            f,
            "{} of {} {}{what}, {} world units from the light at N·L = {}:",
            self.kind,
            short(self.amount),
            self.kind.unit(),
            short(at.distance),
            short(at.facing)
        )?;
        for (engine, settings) in &self.engines {
            let name = engine.name();
            match settings {
                Err(error) => writeln!(f, "  {name:<9} {error}")?,
                Ok(Translation { settings, unmet, .. }) => {
                    let settings: Vec<String> = settings.iter().map(ToString::to_string).collect();
                    writeln!(f, "  {name:<9} {}", settings.join(", "))?;
                    for unmet in unmet {
                        writeln!(f, "            {unmet}")?;
                    }
                }
            }
            if self.in_full {
                let about = engine.about();
                writeln!(f, "  {}, version {}", about.title, about.version)?;
                for setting in about.settings {
                    writeln!(f, "    {}: {}; {}", setting.name, setting.unit, setting.meaning)?;
                }
                writeln!(f, "    {}", about.note)?;
                for source in about.sources {
                    writeln!(f, "    source: {}, {}", source.place, source.version)?;
                }
            }
        }
        Ok(())
    }
}
