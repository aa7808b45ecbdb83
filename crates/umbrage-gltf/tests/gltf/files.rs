//! Files beside the scene, data URIs, and what may not be opened.

use crate::build::{Build, TRIANGLE, corners, triangle};
use serde_json::json;
use std::path::{Path, PathBuf};
use umbrage_gltf::{ReadOptions, read};

/// A folder for one test, empty at first.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("umbrage-gltf-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("parts")).unwrap();
    folder
}

/// The triangle with its buffer at an address.
fn at(uri: &str) -> Build {
    let mut build = triangle();
    build.node(json!({"mesh": 0}));
    build.document["buffers"] = json!([{"byteLength": build.bytes.len(), "uri": uri}]);
    build
}

fn write(folder: &Path, build: &Build) -> PathBuf {
    let path = folder.join("scene.gltf");
    std::fs::write(&path, build.document.to_string()).unwrap();
    path
}

fn refused(folder: &Path, uri: &str) -> String {
    let line = read(&write(folder, &at(uri)), &ReadOptions::default()).unwrap_err().to_string();
    assert!(!line.contains('\n'), "{line:?}");
    line.strip_prefix(&format!("{}: ", folder.join("scene.gltf").display())).unwrap().to_owned()
}

#[test]
fn buffers_lie_in_files_below_the_folder() {
    let folder = folder("beside");
    for (uri, file) in [("b.bin", "b.bin"), ("parts/b%20c.bin", "parts/b c.bin")] {
        let build = at(uri);
        std::fs::write(folder.join(file), &build.bytes).unwrap();
        let import = read(&write(&folder, &build), &ReadOptions::default()).unwrap();
        assert_eq!(corners(&import, 0), [TRIANGLE.map(|at| at.map(f64::from))]);
        assert_eq!(import.scene.name, "scene");
    }
    std::fs::write(folder.join("b.bin"), [0; 35]).unwrap();
    assert_eq!(refused(&folder, "b.bin"), "buffers[0].byteLength: 36, expected at most the 35 bytes that there are");
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn other_places_are_refused() {
    let folder = folder("other");
    let plain = "expected a plain relative path below the scene's folder";
    for uri in [
        "/dev/zero",
        "../b.bin",
        "parts/../../b.bin",
        "%2e%2e/b.bin",
        "%FF",
        "%2Fdev/zero",
        "%0Ab",
        "%",
        "%4",
        "%zz",
        "",
        ".",
        "a//b",
        "http://host/b.bin",
        "file:///b.bin",
        "c:\\b.bin",
        "b.bin?x",
        "b%00.bin",
    ] {
        assert_eq!(refused(&folder, uri), format!("buffers[0].uri: {uri:?}, {plain}"));
    }
    assert!(refused(&folder, "gone.bin").starts_with("buffers[0].uri \"gone.bin\": "));
    assert!(refused(&folder, "parts").ends_with("expected a regular file"));
    std::fs::remove_dir_all(folder).unwrap();
}

#[cfg(unix)]
#[test]
fn links_may_stay_below_the_folder_but_not_leave_it() {
    use std::os::unix::fs::symlink;
    let folder = folder("links");
    let build = at("link.bin");
    std::fs::write(folder.join("parts/b.bin"), &build.bytes).unwrap();
    symlink("parts/b.bin", folder.join("link.bin")).unwrap();
    read(&write(&folder, &build), &ReadOptions::default()).unwrap();
    symlink("/dev/zero", folder.join("zero.bin")).unwrap();
    let line = refused(&folder, "zero.bin");
    assert!(line.ends_with("expected a file below the scene's folder, not a link that leaves it"), "{line}");
    let line = read(Path::new("/dev/zero"), &ReadOptions::default()).unwrap_err().to_string();
    assert_eq!(line, r#"/dev/zero: file: "/dev/zero", expected a regular file"#);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn data_uris_hold_base64() {
    // Three corners: twelve bytes of zeros, then (1, 0, 0) and (0, 1, 0).
    let data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    for head in ["data:application/octet-stream;base64,", "DATA:;BASE64,"] {
        let import = at(&format!("{head}{data}")).read().unwrap();
        assert_eq!(corners(&import, 0), [TRIANGLE.map(|at| at.map(f64::from))]);
    }
    assert_eq!(
        at("data:text/plain,hello").refused(),
        r#"buffers[0].uri: "data:text/plain,hello", expected a data URI in base64"#
    );
    assert!(at("data:;base64,A!").refused().ends_with("expected base64 without faults"));
    assert!(at("data:;base64,AAAA").refused().ends_with("expected at most the 3 bytes that there are"));
    assert!(at("b.bin").refused().ends_with("expected a data URI: this scene has no folder"));
}
