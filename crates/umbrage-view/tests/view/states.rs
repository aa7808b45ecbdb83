//! States as addresses have them.

use umbrage_view::{Ask, MOST_TURNS, Of, Show, State};

fn states() -> Vec<State> {
    let mut all: Vec<State> = Show::ALL.map(|show| State { show, ..State::default() }).to_vec();
    all.push(State {
        show: Show::Leak,
        recipe: Some("reeves87,bias=0.3..0.4,samples=32".into()),
        map_size: Some(256),
        light: Some("lamp & spot=2 + ünïcode #%".into()),
        turns: vec!["a=b=12.5,-30".into(), "sun=0,90".into(), "a=b=1,2".into()],
        samples: Some(64),
        wipe: Some(0.25),
        pixel: Some([0, 16383]),
    });
    all
}

#[test]
fn a_state_comes_back_as_it_was() {
    for state in states() {
        let query = state.query();
        assert!(query.is_ascii() && !query.contains([' ', '#']), "{query}");
        assert_eq!(State::read(&query), Ok(state.clone()), "{query}");
        let ask = Ask::read(&format!("{query}&of=truth&draft=1")).expect("a request");
        assert_eq!(ask, Ask { state, of: Of::Truth, draft: true });
        assert!(!ask.is_slow(), "a small picture is drawn at once");
    }
    assert_eq!(State::default().query(), "");
    let slow: Vec<Show> = Show::ALL
        .into_iter()
        .filter(|show| Ask::read(&format!("show={}", show.name())).expect("a request").is_slow())
        .collect();
    assert_eq!(slow, Show::ALL[2..], "rays are slow");
    assert!(Ask::read("of=truth").expect("a request").is_slow());
}

#[test]
fn what_a_state_cannot_be_is_named() {
    for (query, line) in [
        ("colour=red", "name = \"colour\": expected one of show, recipe, map-size, light, turn, samples, wipe, pixel"),
        ("samples=3", "samples = \"3\": expected 1, 4, 16 or 64"),
        ("map-size=0", "map-size = \"0\": expected 1 to 16384 texels"),
        ("map-size=%2B5", "map-size = \"+5\": expected 1 to 16384 texels"),
        ("wipe=NaN", "wipe = \"NaN\": expected a number from 0 to 1"),
        ("wipe=2", "wipe = \"2\": expected a number from 0 to 1"),
        ("pixel=1", "pixel = \"1\": expected X,Y, whole numbers from 0"),
        ("light=a%0Ab", "light = \"a\\nb\": expected a line of at most 4096 bytes"),
        ("samples=4&samples=4", "samples = \"4\": expected it once"),
    ] {
        assert_eq!(State::read(query).map_err(|error| error.to_string()), Err(line.into()), "{query}");
    }
    let shows = State::read("show=nothing").expect_err("no such picture").to_string();
    assert!(
        shows.ends_with(
            "expected picture, shadow, truth, faults, false-shadow, false-light, acne, detachment, leak, difference"
        ),
        "{shows}"
    );
    assert!(State::read(&format!("recipe={}", "a".repeat(4097))).is_err());
    assert!(State::read(&"turn=a=1,2&".repeat(MOST_TURNS)).is_ok());
    assert!(State::read(&"turn=a=1,2&".repeat(MOST_TURNS + 1)).is_err());
}
