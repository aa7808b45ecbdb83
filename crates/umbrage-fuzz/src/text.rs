//! What people type: recipes, and lines of points to look up.

use crate::exr_seeds::{map, view};
use crate::promises::assert_line;
use glam::{DVec3, UVec2, Vec3};
use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::LazyLock;
use umbrage_depth::Storage;
use umbrage_io::write_shadow_map;
use umbrage_plane::SurfacePoint;
use umbrage_recipe::Recipe;
use umbrage_sample::Key;

/// Takes bytes as a recipe: a line of text, TOML, and RenderMan's parameters. Whether they are valid as any of these.
///
/// # Panics
/// When an error is longer than one line, when a recipe changes by being written and read again, or when its answer lies outside 0..=1.
pub fn recipe(text: &[u8]) -> bool {
    let text = String::from_utf8_lossy(text);
    let mut is_one = false;
    for read in [text.parse(), Recipe::from_toml(&text), Recipe::from_rsl(&text, 8)] {
        match read {
            Err(error) => assert_line(error),
            Ok(recipe) => {
                assert_eq!(recipe.to_string().parse(), Ok(recipe));
                assert_eq!(Recipe::from_toml(&recipe.to_toml()), Ok(recipe));
                is_one = true;
                answers(&recipe);
            }
        }
    }
    is_one
}

/// Looks one region up by a recipe in a map of 8 × 8 texels.
fn answers(recipe: &Recipe) {
    let shadow = recipe.bind_any(map(&view(UVec2::splat(8))), Storage::Raw);
    let corners = [(-0.4, -0.5), (0.6, -0.4), (0.5, 0.5), (-0.5, 0.6)].map(|(x, y)| DVec3::new(x, y, 0.0));
    let fraction = shadow.fraction(&SurfacePoint::at(Vec3::ZERO, Vec3::Z).with_corners(corners), Key::new(0, 0, 0));
    assert!((0.0..=1.0).contains(&fraction), "{recipe}: {fraction}");
}

/// Takes bytes as the input of `umbrage lookup`, once up to the first bad line and once to the end. Whether all lines are good.
///
/// # Panics
/// When the command prints anything but fractions, more than one line on stderr, or an answer behind the line at which it should stop.
pub fn lookup_lines(text: &[u8]) -> bool {
    static MAP: LazyLock<PathBuf> = LazyLock::new(|| {
        let path = std::env::temp_dir().join(format!("umbrage-fuzz-map-{}.exr", std::process::id()));
        write_shadow_map(&path, &map(&view(UVec2::splat(8)))).expect("a file in the folder of temporary ones");
        path
    });
    let run = |more: &[&str]| {
        let words = ["umbrage", "lookup", "-q"].iter().chain(more).map(OsString::from);
        let (mut input, mut out, mut err) = (text, Vec::new(), Vec::new());
        let code = umbrage_cli::run(words.chain([MAP.clone().into_os_string()]), &mut input, &mut out, &mut err, false);
        let [out, err] = [out, err].map(|bytes| String::from_utf8(bytes).expect("text"));
        if let Some(line) = err.strip_suffix('\n') {
            assert_line(line);
        }
        assert_eq!((code == 0, code <= 1), (err.is_empty(), true), "{code}: {err}");
        let answers: Vec<f64> = out.lines().map(|line| line.parse().expect("a number")).collect();
        (code == 0, answers)
    };
    let (good, answers) = run(&[]);
    assert!(answers.iter().all(|share| (0.0..=1.0).contains(share)));
    let (to_the_end, all) = run(&["--keep-going"]);
    assert!(to_the_end && all.iter().all(|share| share.is_nan() || (0.0..=1.0).contains(share)));
    assert_eq!(all[..answers.len()], answers, "what comes first is the same");
    assert!(all.len() > answers.len() || good, "the bad line has its answer");
    assert_eq!(good, !all.iter().any(|share| share.is_nan()));
    good
}
