//! The files of the page.

/// A file's bytes and their type, by its name; the page itself has none.
pub fn file(name: &str) -> Option<(&'static str, &'static str)> {
    const SCRIPT: &str = "text/javascript; charset=utf-8";
    Some(match name {
        "" => ("text/html; charset=utf-8", include_str!("page/index.html")),
        "style.css" => ("text/css; charset=utf-8", include_str!("page/style.css")),
        "icon.svg" => ("image/svg+xml", include_str!("page/icon.svg")),
        "main.js" => (SCRIPT, include_str!("page/main.js")),
        "state.js" => (SCRIPT, include_str!("page/state.js")),
        "recipe.js" => (SCRIPT, include_str!("page/recipe.js")),
        "picture.js" => (SCRIPT, include_str!("page/picture.js")),
        "asking.js" => (SCRIPT, include_str!("page/asking.js")),
        _ => return None,
    })
}
