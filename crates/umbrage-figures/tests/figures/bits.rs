//! Real figures under every storage and several numbers of threads: the same bytes of everything that is written.

use umbrage_depth::Storage;
use umbrage_figures::{Context, Run, catalogue};

#[test]
fn c9_x8_threads_and_storages_change_no_byte() {
    let chosen = ["W78-F4", "R87-F2", "R87-F6", "U-acne"];
    let figures = catalogue::choose(&chosen.map(String::from)).unwrap();
    let bytes = |storage, threads| {
        let name = format!("umbrage-figures-{}-{storage:?}-{threads}", std::process::id());
        let out = std::env::temp_dir().join(name);
        let _ = std::fs::remove_dir_all(&out);
        let context = Context { quick: true, storage, ..Context::default() };
        Run { figures: figures.clone(), context, threads: Some(threads), out: out.clone() }.make().unwrap();
        let mut files = vec![("report.json".to_string(), std::fs::read(out.join("report.json")).unwrap())];
        for id in chosen {
            for entry in std::fs::read_dir(out.join(id)).unwrap() {
                let path = entry.unwrap().path();
                let name = path.file_name().unwrap().to_string_lossy().into_owned();
                // The record names the storage it was made with, the timings tell times.
                if name != "figure.json" && name != "timings.json" {
                    files.push((format!("{id}/{name}"), std::fs::read(&path).unwrap()));
                }
            }
        }
        files.sort();
        std::fs::remove_dir_all(&out).unwrap();
        files
    };
    let expected = bytes(Storage::Raw, 1);
    assert!(expected.len() > 15);
    for (storage, threads) in [(Storage::Bbox, 2), (Storage::Tiled, 4)] {
        let found = bytes(storage, threads);
        let differing: Vec<&str> =
            found.iter().zip(&expected).filter(|(a, b)| a != b).map(|(a, _)| a.0.as_str()).collect();
        assert!(differing.is_empty() && found.len() == expected.len(), "{storage:?}: {differing:?}");
    }
}
