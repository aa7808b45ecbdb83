//! Command lines that draw what the page shows.

use super::base::{Base, Setting};
use crate::names::plain;
use crate::shell::quoted;
use crate::stage::GALLERY;
use std::path::Path;
use umbrage_view::Show;

/// Command lines, each with a description of what it draws.
pub fn lines(base: &Base, setting: &Setting) -> Vec<(&'static str, String)> {
    let mut all = Vec::new();
    let name = match base.source.strip_prefix(GALLERY) {
        Some(name) => plain(name),
        None => plain(&Path::new(&base.source).file_stem().unwrap_or_default().to_string_lossy()),
    };
    let mut add = |what, command: &str, rest: &[&str]| all.push((what, line(base, setting, command, rest)));
    let samples = setting.samples.to_string();
    let render = |add: &mut dyn FnMut(&'static str, &str, &[&str]), truth: bool| {
        let samples: &[&str] = if setting.samples == 16 { &[] } else { &["--samples", &samples] };
        if truth {
            add("by rays", "render", &[samples, &["--truth", "-o", &format!("{name}.truth.png")]].concat());
        } else {
            add("the picture", "render", &[samples, &["-o", &format!("{name}.png")]].concat());
        }
    };
    match setting.show {
        Show::Picture => render(&mut add, false),
        Show::Truth => render(&mut add, true),
        Show::Shadow => add("the fraction in shadow", "shadow", &["--samples", &samples, "-o", "shadows"]),
        _ => add("faults against truth", "compare", &["--samples", &samples, "-o", "compared"]),
    }
    if setting.wipe {
        match setting.show {
            Show::Picture => render(&mut add, true),
            Show::Shadow => add("by rays", "shadow", &["--truth", "--samples", &samples, "-o", "truth"]),
            _ => {}
        }
    }
    if let Some([x, y]) = setting.pixel {
        let at = format!("{x},{y}");
        let samples: &[&str] = if setting.samples == 1 { &[] } else { &["--samples", &samples] };
        add("the pixel", "explain", &[&["--pixel", &at], samples].concat());
    }
    all
}

/// A command line with all options that the scene has.
fn line(base: &Base, setting: &Setting, command: &str, rest: &[&str]) -> String {
    let args = &base.args;
    let mut words: Vec<String> = vec!["umbrage".into(), command.into()];
    // A name that begins like an option would be taken for one.
    words.push(if base.source.starts_with('-') { format!("./{}", base.source) } else { base.source.clone() });
    let mut option =
        |name: &str, value: Option<String>| words.extend(value.into_iter().flat_map(|value| [name.into(), value]));
    option("--size", args.size.map(|size| format!("{}x{}", size.x, size.y)));
    option("--map-size", (setting.map_size != 512).then(|| setting.map_size.to_string()));
    // Without a recipe `compare` judges all of them.
    let recipe = setting.recipe.map(|recipe| recipe.to_string());
    option("--recipe", recipe.or_else(|| (command == "compare").then(|| base.recipe_of_first(&setting.lights))));
    for name in &setting.lights {
        option("--light", Some(name.clone()));
    }
    for turn in &setting.turns {
        option("--turn-light", Some(turn.to_string()));
    }
    option("--camera", args.camera.clone());
    option("--time", args.time.map(|time| time.to_string()));
    option("--animation", args.animation.clone());
    option("--frame", (args.frame != 0).then(|| args.frame.to_string()));
    option("--seed", (base.seed != 0).then(|| base.seed.to_string()));
    option("--max-memory", base.max_memory.map(|bytes| bytes.to_string()));
    words.extend(rest.iter().map(|word| (*word).into()));
    words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
}
