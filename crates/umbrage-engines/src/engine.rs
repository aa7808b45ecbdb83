use crate::error::either;
use crate::models::{self, Model, Span};
use crate::{About, Conditions, EngineError, Part, Setting, Translation, Unmet, WorldBias, WorldRange};
use std::fmt;
use std::str::FromStr;

/// A renderer, an engine or a graphics interface whose bias settings are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Engine {
    /// `shadow()` of the RenderMan Shading Language, as Aqsis has it.
    Rsl,
    /// three.js.
    Three,
    /// Babylon.js.
    Babylon,
    /// Filament.
    Filament,
    /// Bevy.
    Bevy,
    /// Godot 4, Forward+.
    Godot,
    /// Unity's Universal Render Pipeline.
    Urp,
    /// Unity's High Definition Render Pipeline.
    Hdrp,
    /// Unreal Engine: no public formula.
    Unreal,
    /// Direct3D 11 and 12.
    D3d,
    /// Vulkan.
    Vulkan,
    /// WebGPU.
    WebGpu,
}

impl Engine {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Rsl,
        Self::Three,
        Self::Babylon,
        Self::Filament,
        Self::Bevy,
        Self::Godot,
        Self::Urp,
        Self::Hdrp,
        Self::Unreal,
        Self::D3d,
        Self::Vulkan,
        Self::WebGpu,
    ];

    /// What is known of it.
    pub fn about(self) -> &'static About {
        self.model().about
    }

    /// The word that names it, which [`FromStr`] reads.
    pub fn name(self) -> &'static str {
        self.about().name
    }

    /// The settings that give a wanted bias, and what of it they do not give.
    ///
    /// # Errors
    /// A wanted part or a condition that is not a number in its range, a constant part that reaches the light, and an engine
    /// without a public formula.
    pub fn settings(self, wanted: &WorldBias, conditions: &Conditions) -> Result<Translation, EngineError> {
        conditions.check()?;
        wanted.check()?;
        let spans = (self.formulas()?.settings)(wanted, conditions)?;
        let settings = self.about().settings.iter().zip(&spans);
        let settings = settings.map(|(info, &[least, most])| Setting { info, least, most }).collect();
        Ok(Translation { settings, unmet: self.unmet(wanted, &spans, conditions)? })
    }

    /// The bias that settings give. A setting that is not given has its default value, so that none at all are what the engine does by itself.
    ///
    /// # Errors
    /// A name that is not a setting of this engine, or is given twice, a value or a condition that is not a number in its range, and
    /// an engine without a public formula.
    pub fn world(self, settings: &[(&str, f64)], conditions: &Conditions) -> Result<WorldRange, EngineError> {
        conditions.check()?;
        let about = self.about();
        let mut values: Vec<Option<f64>> = vec![None; about.settings.len()];
        for &(name, value) in settings {
            let at = about.settings.iter().position(|info| info.name == name);
            let at = at.ok_or_else(|| EngineError::setting(about, name))?;
            let name = about.settings[at].name;
            if !value.is_finite() {
                return Err(EngineError::Value { name, value });
            }
            if values[at].replace(value).is_some() {
                return Err(EngineError::Twice(name));
            }
        }
        let values: Vec<f64> =
            values.iter().zip(about.settings).map(|(value, info)| value.or(info.default).unwrap_or(0.0)).collect();
        (self.formulas()?.world)(&values, conditions)
    }

    /// The step of depth, from 0 at the near plane to 1 at the far one, that 1 of the constant setting of `d3d`, `vulkan` or
    /// `webgpu` adds: at least and at most. `None` for engines.
    ///
    /// For floating-point depth it is 2^(e − 23), where e is the exponent of the largest depth of the primitive that is drawn. That is
    /// known only from the receiver's own depth up to 1, so that this is a range.
    ///
    /// # Errors
    /// A condition that is out of its range.
    pub fn unit(self, conditions: &Conditions) -> Result<Option<[f64; 2]>, EngineError> {
        conditions.check()?;
        Ok(self.model().unit.map(|unit| unit(conditions)))
    }

    /// What of a wanted bias the settings do not give. The engine's own formulas are the judge.
    fn unmet(self, wanted: &WorldBias, spans: &[Span], conditions: &Conditions) -> Result<Vec<Unmet>, EngineError> {
        let world = self.formulas()?.world;
        let end = |end: usize| world(&spans.iter().map(|span| span[end]).collect::<Vec<f64>>(), conditions);
        let ends = [end(0)?, end(1)?];
        let mut unmet = Vec::new();
        for part in Part::ALL {
            let given = ends.map(|range| [range.least.part(part), range.most.part(part)]);
            let given = given.as_flattened();
            let least = given.iter().copied().fold(f64::INFINITY, f64::min);
            let most = given.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let amount = wanted.part(part);
            // Rounding only: what cancels in a constant part is as large as an offset.
            let all = wanted.constant.abs().max(wanted.normal.abs());
            let slack = 1e-9 * if part == Part::Slope { amount.abs() } else { all.max(least.abs()).max(most.abs()) };
            if amount < least - slack || amount > most + slack {
                unmet.push(Unmet { part, wanted: amount, least, most, why: self.about().why(part) });
            }
        }
        Ok(unmet)
    }

    fn formulas(self) -> Result<&'static models::Formulas, EngineError> {
        let model = self.model();
        let without = || EngineError::NoFormula { engine: model.about.name, why: model.about.note };
        model.formulas.as_ref().ok_or_else(without)
    }

    fn model(self) -> &'static Model {
        match self {
            Self::Rsl => &models::RSL,
            Self::Three => &models::THREE,
            Self::Babylon => &models::BABYLON,
            Self::Filament => &models::FILAMENT,
            Self::Bevy => &models::BEVY,
            Self::Godot => &models::GODOT,
            Self::Urp => &models::URP,
            Self::Hdrp => &models::HDRP,
            Self::Unreal => &models::UNREAL,
            Self::D3d => &models::D3D,
            Self::Vulkan => &models::VULKAN,
            Self::WebGpu => &models::WEB_GPU,
        }
    }
}

impl FromStr for Engine {
    type Err = EngineError;

    fn from_str(text: &str) -> Result<Self, EngineError> {
        let found = Self::ALL.into_iter().find(|engine| engine.name() == text);
        found.ok_or_else(|| EngineError::Name { given: text.into(), expected: either(&Self::ALL.map(Self::name)) })
    }
}

impl fmt::Display for Engine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
