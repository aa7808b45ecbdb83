//! `umbrage recipes` and `umbrage scenes`.

use crate::args::{Cli, RecipesArgs};
use crate::shell::{Shell, Usage};
use serde_json::{Value, json};
use umbrage_engines::{Engine, SettingInfo};
use umbrage_recipe::{Field, PresetName, Recipe, help};
use umbrage_scene::gallery;

pub fn scenes(cli: &Cli, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let names: Vec<String> = gallery::ALL.iter().map(|(name, _)| format!("gallery:{name}")).collect();
    if cli.json {
        writeln!(shell.out, "{}", json!(names))?;
        return Ok(());
    }
    for name in names {
        writeln!(shell.out, "{name}")?;
    }
    Ok(())
}

pub fn recipes(cli: &Cli, args: &RecipesArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let named = |name: &String| {
        let known = || PresetName::ALL.map(PresetName::name).join(", ");
        PresetName::named(name).ok_or_else(|| Usage(format!("recipe {name:?}: expected one of {}", known())))
    };
    let chosen = match &args.name {
        None => PresetName::ALL.to_vec(),
        Some(name) => vec![named(name)?],
    };
    if cli.json {
        let presets: Vec<Value> = chosen.into_iter().map(described).collect();
        writeln!(shell.out, "{}", json!(presets))?;
    } else if args.name.is_some() {
        for preset in chosen {
            write!(shell.out, "{}: {}\n\n{}", preset.name(), preset.about(), help(preset))?;
        }
    } else {
        let (engines, papers): (Vec<_>, Vec<_>) = chosen.into_iter().partition(|preset| preset.engine().is_some());
        for preset in papers {
            writeln!(shell.out, "{:20} {}", preset.name(), preset.about())?;
        }
        writeln!(shell.out, "\nEngines' defaults, each with its own kernel and bias:")?;
        for preset in engines {
            writeln!(shell.out, "{:20} {}", preset.name(), preset.about())?;
        }
    }
    Ok(())
}

fn described(preset: PresetName) -> Value {
    let field = |field: &Field| {
        json!({
            "name": field.name, "values": field.kind.to_string(), "default": field.default(preset),
            "about": field.doc, "source": field.source,
        })
    };
    let setting = |info: &SettingInfo| json!({ "name": info.name, "default": info.default, "unit": info.unit, "about": info.meaning });
    let settings = preset.engine().map_or(&[][..], |engine| engine.about().settings);
    json!({
        "name": preset.name(), "about": preset.about(), "engine": preset.engine().map(Engine::name), "stored": Recipe::from(preset).stored().name(),
        "fields": Field::of(preset).map(field).collect::<Vec<_>>(),
        "settings": settings.iter().map(setting).collect::<Vec<_>>(),
    })
}
