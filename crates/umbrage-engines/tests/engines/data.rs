use std::collections::HashSet;
use umbrage_engines::Engine;

#[test]
fn every_engine_has_its_name_and_a_source_with_a_version() {
    let names: HashSet<&str> = Engine::ALL.into_iter().map(Engine::name).collect();
    assert_eq!(names.len(), Engine::ALL.len());
    for engine in Engine::ALL {
        let about = engine.about();
        assert_eq!(engine.name().parse(), Ok(engine));
        assert_eq!(engine.to_string(), engine.name());
        for text in [about.title, about.version, about.filter, about.note] {
            assert!(!text.is_empty(), "{engine}");
        }
        assert!(!about.sources.is_empty(), "{engine}");
        for source in about.sources {
            assert!(!source.place.is_empty(), "{engine}");
            assert!(source.version.contains(|letter: char| letter.is_ascii_digit()), "{engine}: {}", source.place);
        }
    }
}

#[test]
fn every_setting_has_a_unit_a_meaning_and_a_default_that_it_takes() {
    for engine in Engine::ALL {
        let settings = engine.about().settings;
        assert!(settings.len() >= 2, "{engine}");
        let names: HashSet<&str> = settings.iter().map(|info| info.name).collect();
        assert_eq!(names.len(), settings.len(), "{engine}");
        for info in settings {
            assert!(!info.unit.is_empty() && !info.meaning.is_empty(), "{engine} {}", info.name);
            assert_eq!(info.default.is_none(), engine == Engine::Unreal, "{engine} {}", info.name);
            let default = info.default.unwrap_or(0.0);
            assert!(default.is_finite() && (!info.whole || default.fract() == 0.0), "{engine} {}", info.name);
        }
    }
}

#[test]
fn no_text_has_a_line_of_its_own_or_a_gap() {
    for engine in Engine::ALL {
        let about = engine.about();
        let settings = about.settings.iter().flat_map(|info| [info.unit, info.meaning]);
        let sources = about.sources.iter().flat_map(|source| [source.place, source.version]);
        for text in [about.title, about.version, about.filter, about.note].into_iter().chain(settings).chain(sources) {
            assert!(!text.contains('\n') && !text.contains("  ") && text.trim() == text, "{engine}: {text}");
        }
    }
}
