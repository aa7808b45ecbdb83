use crate::Part;

/// What is known of an engine.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct About {
    /// The word that names it.
    pub name: &'static str,
    /// Its full name.
    pub title: &'static str,
    /// The version that its formulas are of.
    pub version: &'static str,
    /// What was read.
    pub sources: &'static [Source],
    /// Its bias settings, in the order in which they are reported.
    pub settings: &'static [SettingInfo],
    /// What its filter does by default: kernel, taps and radius.
    pub filter: &'static str,
    /// What holds for its conversions beyond the settings' meanings.
    pub note: &'static str,
    /// Why a part of a bias cannot be had from it, always or under some conditions.
    pub(crate) lacks: &'static [(Part, &'static str)],
}

impl About {
    /// Why a part cannot be had, or not in the wanted amount.
    pub(crate) fn why(&self, part: Part) -> &'static str {
        let known = self.lacks.iter().find(|(lacked, _)| *lacked == part);
        known.map_or("the engine limits its settings", |(_, why)| why)
    }
}

/// A public text that a formula or a value was taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Source {
    /// The file or page.
    pub place: &'static str,
    /// The release or the commit that was read, or the version that a page speaks of.
    pub version: &'static str,
}

/// A setting of an engine.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SettingInfo {
    /// Its name, as the engine spells it.
    pub name: &'static str,
    /// What 1 is.
    pub unit: &'static str,
    /// What it is when nobody sets it; `None` where nothing public says so.
    pub default: Option<f64>,
    /// True where it takes whole numbers only.
    pub whole: bool,
    /// What it does, in the terms of a [`WorldBias`](crate::WorldBias).
    pub meaning: &'static str,
}

/// A source, in data.
pub(crate) const fn source(place: &'static str, version: &'static str) -> Source {
    Source { place, version }
}

/// A setting that takes any number, in data.
pub(crate) const fn setting(
    name: &'static str,
    unit: &'static str,
    default: f64,
    meaning: &'static str,
) -> SettingInfo {
    SettingInfo { name, unit, default: Some(default), whole: false, meaning }
}

/// A setting that takes whole numbers, in data.
pub(crate) const fn whole(name: &'static str, unit: &'static str, default: f64, meaning: &'static str) -> SettingInfo {
    SettingInfo { name, unit, default: Some(default), whole: true, meaning }
}

/// A setting of which no default is known, in data.
pub(crate) const fn unknown(name: &'static str, unit: &'static str, meaning: &'static str) -> SettingInfo {
    SettingInfo { name, unit, default: None, whole: false, meaning }
}
