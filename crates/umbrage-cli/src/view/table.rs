//! The recipes and their fields for the page's controls.

use serde_json::{Value, json};
use umbrage_recipe::{Field, Kind, PresetName};

pub fn recipes() -> Vec<Value> {
    let field = |preset: PresetName| {
        move |field: &'static Field| {
            json!({
                "name": field.name, "about": field.doc, "source": field.source, "default": field.default(preset),
                "values": field.kind.to_string(), "control": control(field.kind),
            })
        }
    };
    let preset = |preset: PresetName| {
        json!({
            "name": preset.name(), "about": preset.about(),
            "fields": Field::of(preset).map(field(preset)).collect::<Vec<_>>(),
        })
    };
    PresetName::ALL.into_iter().map(preset).collect()
}

/// The kind of a control, and the bounds of its numbers where it has any.
fn control(kind: Kind) -> Value {
    let number = |least: f64, most: Option<f32>| json!({ "type": "number", "least": least, "most": most });
    match kind {
        Kind::Words(words) => json!({ "type": "words", "words": words }),
        Kind::Switch => json!({ "type": "words", "words": ["on", "off"] }),
        Kind::Whole(most) => json!({ "type": "whole", "least": 1, "most": most }),
        Kind::Number | Kind::Positive => number(0.0, None),
        Kind::UpTo(most) => number(0.0, Some(most)),
        Kind::BelowOne | Kind::Ratio => number(0.0, Some(1.0)),
        // Numbers with units, ranges, and kinds that are to come are written.
        _ => json!({ "type": "text" }),
    }
}
