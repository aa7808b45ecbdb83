//! `umbrage view` as its page asks it, and the command lines that it shows.

use crate::examples::shell;
use crate::typed::{folder, good, refused, text};
use serde_json::Value;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// A page that is there until it is dropped.
pub struct Page {
    child: Child,
    pub address: String,
}

impl Page {
    pub fn new(args: &[&str]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_umbrage"));
        let command = command.arg("view").args(args).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the program");
        let mut address = String::new();
        let out = child.stdout.take().expect("its output");
        BufReader::new(out).read_line(&mut address).expect("an address");
        if !address.starts_with("http://127.0.0.1:") {
            let mut error = String::new();
            let _ = child.stderr.take().expect("its errors").read_to_string(&mut error);
            panic!("{args:?}: {error}");
        }
        Self { child, address: address.trim().into() }
    }

    /// The status and the body of a reply.
    pub fn get(&self, inside: &str) -> (u16, Vec<u8>) {
        let rest = self.address.strip_prefix("http://").expect("an address");
        let (host, path) = rest.split_once('/').expect("a path");
        let mut stream = TcpStream::connect(host).expect("a connection");
        stream.set_read_timeout(Some(Duration::from_secs(120))).expect("a time");
        let head = format!("GET /{path}{inside} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n");
        stream.write_all(head.as_bytes()).expect("a request");
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).expect("a reply");
        let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").expect("a head");
        let status = String::from_utf8_lossy(&bytes[9..12]).parse().expect("a status");
        (status, bytes.split_off(end + 4))
    }

    pub fn good(&self, inside: &str) -> Vec<u8> {
        let (status, body) = self.get(inside);
        assert_eq!(status, 200, "{inside}: {}", String::from_utf8_lossy(&body));
        body
    }

    fn json(&self, inside: &str) -> Value {
        serde_json::from_slice(&self.good(inside)).expect("JSON")
    }

    /// The command lines of a state.
    fn lines(&self, query: &str) -> Vec<String> {
        let lines = self.json(&format!("lines?{query}"));
        let line = |line: &Value| line["line"].as_str().expect("a line").to_owned();
        lines["lines"].as_array().expect("lines").iter().map(line).collect()
    }

    /// Runs the first command line of a state, and returns what it printed.
    fn run(&self, folder: &Path, query: &str) -> String {
        shell(folder, &self.lines(query)[0])
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn scene_folder(name: &str) -> std::path::PathBuf {
    let folder = folder(name);
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/scenes/suzi.glb");
    std::fs::copy(kept, folder.join("it's a head.glb")).expect("a scene");
    folder
}

/// The page's picture is that of the command line that it shows, bit for bit.
#[test]
fn command_lines_draw_what_the_page_shows() {
    let folder = scene_folder("view-lines");
    let file = folder.join("it's a head.glb");
    let scenes: [(&[&str], &[&str]); 3] = [
        (
            &["gallery:three-lights", "--size", "48x40", "--map-size", "64", "--seed", "3"],
            &[
                "",
                "recipe=reeves87%2Cbias%3D1..2&samples=4&map-size=32",
                "light=red&samples=1",
                "turn=red%3D20%2C60&turn=blue%3D-100%2C85.5&samples=1",
                "show=truth&samples=1&turn=green%3D5%2C5",
            ],
        ),
        (
            &[text(&file), "--size", "40x50", "--map-size", "128"],
            &["samples=4", "turn=Spot%3D10%2C30&samples=1", "show=truth&samples=1"],
        ),
        (
            &["gallery:grazing", "--size", "64x64", "--turn-light", "sun=100,20", "--frame", "7"],
            &["", "turn=sun%3D-160%2C70&recipe=woo92&samples=1"],
        ),
    ];
    for (args, states) in scenes {
        let page = Page::new(args);
        for state in states {
            let state = state.replace(
                "Spot",
                &page.json("about")["lights"][0]["name"].as_str().expect("a name").replace(' ', "%20"),
            );
            let shown = page.good(&format!("picture?{state}"));
            page.run(&folder, &state);
            let line = page.lines(&state)[0].clone();
            let written = line.rsplit(" -o ").next().expect("a file").trim_matches('\'').replace(r"'\''", "'");
            let drawn = std::fs::read(folder.join(written)).expect("a picture");
            assert!(shown == drawn, "{line}: another picture than that of {state:?}");
        }
    }
}

#[test]
fn explanations_and_faults_are_those_of_the_command_lines() {
    let folder = folder("view-explained");
    let page = Page::new(&["gallery:table", "--size", "96x72", "--map-size", "128"]);
    let state = "recipe=reeves87%2Cbias%3D0&pixel=60%2C44&samples=1";
    let why = page.json(&format!("explanation?{state}"));
    let lines = page.lines(state);
    assert_eq!(shell(&folder, &lines[1]), why["lights"][0]["words"].as_str().expect("words"));
    assert!(why["lights"][0]["svg"].as_str().is_some_and(|svg| svg.starts_with("<svg ")));

    let state = "show=faults&recipe=reeves87%2Cbias%3D0&samples=1";
    page.run(&folder, state);
    let report = std::fs::read(folder.join("compared/report.json")).expect("a report");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    let acne = report["rows"][0]["acne"].as_f64().expect("a share");
    assert!(acne > 0.05, "there is something to see: {acne}");
    let truth = page.good("picture?show=shadow&of=truth&samples=1");
    let mut seen = vec![truth];
    for show in ["shadow", "faults", "false-shadow", "false-light", "acne", "detachment", "leak", "difference"] {
        let png = page.good(&format!("picture?show={show}&recipe=reeves87%2Cbias%3D0&samples=1"));
        let picture = umbrage_io::decode_png(&png).expect("a picture");
        assert_eq!(picture.size.to_array(), [96, 72], "{show}");
        if show == "acne" {
            let orange = picture.rgb.iter().filter(|[r, g, b]| *r == 255 && *g > 100 && *b == 0).count();
            let judged = report["rows"][0]["judged-pixels"].as_f64().expect("a number");
            assert!((orange as f64 - acne * judged).abs() < 0.5, "{orange} pixels, {acne} of {judged}");
        }
        seen.push(png);
    }
    let faults = page.good("picture?show=faults&samples=1");
    assert!(!seen.contains(&faults), "another recipe has other faults");
    // No biased recipe, no detachment: the two maps are of one kind.
    seen.sort();
    seen.dedup();
    assert!(seen.len() >= 6, "{} pictures", seen.len());
}

#[test]
fn pictures_that_move_are_small() {
    let page = Page::new(&["gallery:knot", "--size", "512x384", "--map-size", "128"]);
    let picture = |query: &str| umbrage_io::decode_png(&page.good(&format!("picture?{query}"))).expect("a picture");
    assert_eq!(picture("draft=1").size.to_array(), [256, 192]);
    assert_eq!(picture("draft=1&of=truth").size.to_array(), [256, 192]);
    assert_eq!(picture("draft=1&show=leak").size.to_array(), [256, 192]);
    assert!(picture("draft=1") != picture("draft=1&turn=spot%3D0%2C60"));
    assert_eq!(picture("").size.to_array(), [512, 384]);
    assert_eq!(page.get("picture?draft=0&of=result").0, 200);
}

#[test]
fn what_the_page_cannot_have_is_one_line() {
    let folder = folder("view-wrong");
    let recipe = folder.join("own.toml");
    std::fs::write(&recipe, "preset = \"woo92\"\n").expect("a file");
    let page =
        Page::new(&["gallery:three-lights", "--size", "16x16", "--max-memory", "400MiB", "--recipe", text(&recipe)]);
    let about = page.json("about");
    assert_eq!(about["first"], "recipe=woo92");
    assert_eq!(about["lights"].as_array().map(Vec::len), Some(3));
    let recipes = about["recipes"].as_array().expect("recipes");
    assert!(recipes.iter().all(|recipe| recipe["fields"].as_array().is_some_and(|fields| !fields.is_empty())));
    for (query, part) in [
        ("recipe=reeves87%2Cjitter%3D1.5", "jitter = \"1.5\": expected a number from 0 to 1"),
        ("recipe=none", "expected"),
        // No request makes the program read a file.
        ("recipe=own.toml", "expected"),
        ("light=mauve", "light \"mauve\": the lights that cast shadows are "),
        ("turn=mauve%3D1%2C2", "light \"mauve\": the lights that cast shadows are "),
        ("turn=red%3D1%2C91", "turn = \"red=1,91\": expected NAME=AZIMUTH,ELEVATION"),
        ("pixel=16%2C0", "pixel = 16,0: the picture has 16 columns and 16 rows, counted from 0"),
        ("map-size=16384", "memory: "),
        ("show=shadow", "light: this picture is of one light, choose one of "),
    ] {
        let (status, body) = page.get(&format!("picture?{query}"));
        let line = String::from_utf8_lossy(&body);
        assert_eq!(status, 400, "{query}: {line}");
        assert!(line.contains(part) && line.lines().count() == 1, "{query}: {line}");
    }
    assert_eq!(page.get("explanation?").0, 400, "no pixel");
    assert_eq!(page.get("picture?").0, 200);
    drop(page);
    refused(2, &["view", "gallery:nothing"]);
    refused(2, &["view", "gallery:table", "--turn-light", "mauve=1,2"]);
    let taken = Page::new(&["gallery:grazing", "--size", "16x16", "-q"]);
    let port = taken.address.split([':', '/']).nth(4).expect("a port");
    let error = refused(1, &["view", "gallery:grazing", "--port", port]);
    assert!(error.starts_with(&format!("error: --port {port}: ")), "{error}");
}

#[test]
fn lights_are_turned_from_the_command_line() {
    let out = folder("turned");
    let shot = |name: &str, more: &[&str]| {
        let path = out.join(name);
        good(
            &[
                &[
                    "render",
                    "gallery:three-lights",
                    "--size",
                    "48x40",
                    "--map-size",
                    "64",
                    "--samples",
                    "4",
                    "-o",
                    text(&path),
                ],
                more,
            ]
            .concat(),
        );
        std::fs::read(path).expect("a picture")
    };
    let plain = shot("plain.png", &[]);
    let turned = shot("turned.png", &["--turn-light", "red=20,60"]);
    assert!(plain != turned);
    assert!(turned != shot("two.png", &["--turn-light", "red=20,60", "--turn-light", "blue=0,45"]));
    let twice = shot("twice.png", &["--turn-light", "red=90,10", "--turn-light", "red=20,60"]);
    assert!(turned == twice, "the last one counts");
    let truth = shot("truth.png", &["--truth", "--turn-light", "red=20,60"]);
    assert!(truth != shot("truth-plain.png", &["--truth"]));
    for command in ["shadow", "compare", "bake"] {
        let folder = out.join(command);
        let small: &[&str] = if command == "bake" { &[] } else { &["--samples", "1"] };
        let (one, other) = (folder.join("a"), folder.join("b"));
        for (into, angles) in [(&one, "red=20,60"), (&other, "red=21,60")] {
            let args = [
                command,
                "gallery:three-lights",
                "--size",
                "16x16",
                "--map-size",
                "32",
                "--light",
                "red",
                "--turn-light",
                angles,
                "-o",
                text(into),
            ];
            good(&[&args, small].concat());
        }
        let named = |name: &String| name.contains("red") && name.contains('.');
        let file = crate::typed::files(&one).into_iter().find(named).unwrap_or_else(|| "report.json".into());
        let [one, other] = [one, other].map(|folder| std::fs::read(folder.join(&file)).expect("a file"));
        assert!(one != other, "{command}");
    }
    let refuse = |angles: &str| refused(2, &["render", "gallery:three-lights", "--turn-light", angles, "-o", "a.png"]);
    assert!(refuse("mauve=1,2").starts_with("error: --turn-light \"mauve\": the lights that cast shadows are "));
    for wrong in ["red", "red=1", "red=1,91", "red=400,0", "red=NaN,0", "red=1,2,3"] {
        let ran = crate::typed::run(&["render", "gallery:three-lights", "--turn-light", wrong, "-o", "a.png"]);
        assert_eq!(ran.code, 2, "{wrong}");
        assert!(ran.err.contains("expected NAME=AZIMUTH,ELEVATION"), "{wrong}: {}", ran.err);
    }
}

/// A lamp that shines all around moves about the scene with all six of its maps, and a wide spot with its five.
#[test]
fn lamps_with_several_maps_are_turned() {
    let out = folder("turned-lamps");
    let file = crate::typed::lamps(&out);
    let shot = |name: &str, more: &[&str]| {
        let path = out.join(name);
        good(
            &[
                &["render", text(&file), "--size", "48x40", "--map-size", "64", "--samples", "1", "-o", text(&path)],
                more,
            ]
            .concat(),
        );
        umbrage_io::decode_png(&std::fs::read(path).expect("a picture")).expect("a picture").rgb
    };
    let page = Page::new(&[text(&file), "--size", "16x16"]);
    let about = page.json("about");
    for light in about["lights"].as_array().expect("lights") {
        let name = light["name"].as_str().expect("a name");
        let to = format!("{name}=140,50");
        let (maps, truth) = (
            shot("maps.png", &["--light", name, "--turn-light", &to]),
            shot("truth.png", &["--light", name, "--turn-light", &to, "--truth"]),
        );
        let differ =
            maps.iter().zip(&truth).filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 40)).count();
        assert!(differ * 50 < maps.len(), "{name}: {differ} of {} pixels differ from rays", maps.len());
        assert!(maps != shot("plain.png", &["--light", name]), "{name}");
    }
}

/// The page ends with the command, which an interrupt ends at once.
#[cfg(unix)]
#[test]
fn an_interrupt_ends_the_page() {
    let mut page = Page::new(&["gallery:grazing", "--size", "16x16", "--map-size", "32"]);
    assert_eq!(page.get("picture?draft=1").0, 200);
    let id = page.child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().expect("a signal").success());
    assert_eq!(page.child.wait().expect("its end").code(), Some(130));
    let host = page.address.split('/').nth(2).expect("a host");
    assert!(TcpStream::connect(host).is_err(), "nobody listens any more");
}
