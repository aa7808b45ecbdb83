//! Commands as a user would type them, and a scene with lamps.

use std::path::{Path, PathBuf};
use umbrage_io::decode_png;

/// What a command line gave.
pub struct Ran {
    pub code: u8,
    pub out: String,
    pub err: String,
}

pub fn run_with(input: &str, args: &[&str]) -> Ran {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let args = std::iter::once("umbrage").chain(args.iter().copied()).map(Into::into);
    let code = umbrage_cli::run(args, &mut input.as_bytes(), &mut out, &mut err, false);
    let text = |bytes| String::from_utf8(bytes).expect("text");
    Ran { code, out: text(out), err: text(err) }
}

pub fn run(args: &[&str]) -> Ran {
    run_with("", args)
}

/// Runs what must succeed.
pub fn good(args: &[&str]) -> Ran {
    let ran = run(args);
    assert_eq!(ran.code, 0, "{args:?}: {}", ran.err);
    ran
}

/// The one line of a failure.
pub fn refused(code: u8, args: &[&str]) -> String {
    let ran = run(args);
    assert_eq!(ran.code, code, "{args:?}: {}", ran.err);
    assert_eq!(ran.err.lines().count(), 1, "{args:?}: {}", ran.err);
    ran.err.trim_end().to_owned()
}

/// An empty folder of a test's own.
pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

pub fn text(path: &Path) -> &str {
    path.to_str().expect("a path of text")
}

pub fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("text")).collect();
    names.sort();
    names
}

/// A scene file with a floor, a wall and a board between them and the lights: a lamp that shines all around and a spot 170° wide.
pub fn lamps(folder: &Path) -> PathBuf {
    let quads: [[[f32; 3]; 4]; 4] = [
        [[-5.0, 0.0, -5.0], [-5.0, 0.0, 5.0], [5.0, 0.0, 5.0], [5.0, 0.0, -5.0]],
        [[-5.0, 0.0, -5.0], [5.0, 0.0, -5.0], [5.0, 6.0, -5.0], [-5.0, 6.0, -5.0]],
        [[-0.8, 1.5, -0.7], [-0.8, 1.5, 0.9], [0.7, 1.7, 0.9], [0.7, 1.7, -0.7]],
        [[1.4, 2.2, -1.0], [1.6, 3.6, -1.0], [1.5, 3.6, 1.1], [1.7, 2.2, 1.1]],
    ];
    let corners = quads.iter().flat_map(|[a, b, c, d]| [a, b, c, a, c, d]).flatten();
    let bytes: Vec<u8> = corners.flat_map(|number| number.to_le_bytes()).collect();
    std::fs::write(folder.join("lamps.bin"), &bytes).expect("a file");
    let gltf = serde_json::json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "point", "intensity": 100}, {"type": "spot", "spot": {"outerConeAngle": 1.4835}}]}},
        "nodes": [
            {"mesh": 0}, {"camera": 0, "translation": [0, 3, 12]},
            {"name": "bulb", "translation": [0, 3, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"name": "wide", "translation": [0.2, 3.2, 0.1], "rotation": [-0.6, 0.0, 0.0, 0.8],
             "extensions": {"KHR_lights_punctual": {"light": 1}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": bytes.len() / 12, "type": "VEC3",
            "min": [-5, 0, -5], "max": [5, 6, 5]}],
        "bufferViews": [{"buffer": 0, "byteLength": bytes.len()}],
        "buffers": [{"uri": "lamps.bin", "byteLength": bytes.len()}],
    });
    let path = folder.join("lamps.gltf");
    std::fs::write(&path, gltf.to_string()).expect("a file");
    path
}

/// Values of a 16-bit picture, rounded to 8 bits as the reader does.
pub fn values(path: &Path) -> Vec<f64> {
    let codes = decode_png(&std::fs::read(path).expect("a file")).expect("a picture");
    codes.rgb.iter().map(|rgb| f64::from(rgb[0]) / 255.0).collect()
}

pub fn rms(a: &[f64], b: &[f64]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
    (squares / a.len() as f64).sqrt()
}

/// A map of facets for look-ups.
pub fn facets(name: &str) -> PathBuf {
    let out = folder(name);
    good(&["bake", "gallery:contact-box", "-o", text(&out), "--map-size", "64", "-q"]);
    out.join("contact-box.exr")
}
