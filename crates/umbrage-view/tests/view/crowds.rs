//! Many clients, slow ones and broken ones.

use crate::client::{Page, received, until};
use std::io::{Read, Write};
use std::time::{Duration, Instant};
use umbrage_view::{HEAD_TIME, STALL_TIME};

/// Numbers that look random and are the same each time (Marsaglia 2003, xorshift64).
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % sides as u64) as usize
    }
}

/// A request that may be right, nearly right or noise.
fn random(page: &Page, dice: &mut Dice) -> Vec<u8> {
    const WORDS: [&str; 24] = [
        "show=shadow",
        "show=leak",
        "recipe=auto",
        "recipe=wrong",
        "map-size=512",
        "map-size=99999999999",
        "light=%F0%9F%92%A1",
        "turn=a=1,2",
        "samples=1",
        "samples=x",
        "wipe=0.5",
        "wipe=inf",
        "pixel=1,2",
        "pixel=1,2,3",
        "of=truth",
        "draft=1",
        "%",
        "%00",
        "=",
        "a=%zz",
        "&&&",
        "\u{e9}",
        "show=",
        "x",
    ];
    const PLACES: [&str; 9] =
        ["", "main.js", "about", "lines", "picture", "explanation", "nothing", "../..", "%2e%2e/"];
    const LINES: [&str; 10] = [
        "Origin: http://example.org\r\n",
        "Content-Length: 10\r\n",
        "Content-Length: -1\r\n",
        "Transfer-Encoding: chunked\r\n",
        "Host: twice\r\n",
        "X: \u{0}\r\n",
        " folded\r\n",
        "Expect: 100-continue\r\n",
        "Connection: upgrade\r\nUpgrade: websocket\r\n",
        "Range: bytes=0-1\r\n",
    ];
    if dice.roll(8) == 0 {
        let length = dice.roll(600);
        return (0..length).map(|_| dice.roll(256) as u8).collect();
    }
    let query: Vec<&str> = (0..dice.roll(5)).map(|_| WORDS[dice.roll(WORDS.len())]).collect();
    let lines: String = (0..dice.roll(3)).map(|_| LINES[dice.roll(LINES.len())]).collect();
    let place = PLACES[dice.roll(PLACES.len())];
    let mut bytes = page.request(&format!("{place}?{}", query.join("&")), &lines).into_bytes();
    match dice.roll(6) {
        0 => bytes.truncate(dice.roll(bytes.len())),
        1 => {
            let at = dice.roll(bytes.len());
            bytes[at] = dice.roll(256) as u8;
        }
        2 => bytes.extend(std::iter::repeat_n(b'a', dice.roll(80_000))),
        _ => {}
    }
    bytes
}

#[test]
fn ten_thousand_random_requests_do_no_harm() {
    let page = Page::new();
    let mut dice = Dice(0x9E37_79B9_7F4A_7C15);
    let mut statuses = std::collections::BTreeMap::new();
    for _ in 0..10_000 {
        let bytes = random(&page, &mut dice);
        let mut stream = page.connect();
        let _ = stream.write_all(&bytes);
        // Nothing more will come: a request that is cut off is not waited for.
        let _ = stream.shutdown(std::net::Shutdown::Write);
        *statuses.entry(received(&mut stream).0).or_insert(0) += 1;
    }
    assert!(statuses.keys().all(|status| [0, 200, 400, 403, 404, 405, 413, 431, 503].contains(status)), "{statuses:?}");
    assert!(statuses.len() >= 5 && statuses[&400] > 500, "many kinds were tried: {statuses:?}");
    assert_eq!(page.get("about").0, 200);
}

#[test]
fn a_hundred_at_once_are_all_answered() {
    let page = Page::new();
    let paths = ["", "main.js", "lines?samples=4", "picture?samples=1", "explanation?samples=1&pixel=1,2"];
    let replies = std::thread::scope(|scope| {
        let ask = |index: usize| page.get(paths[index % paths.len()]).0;
        let threads: Vec<_> = (0..100).map(|index| scope.spawn(move || ask(index))).collect();
        threads.into_iter().map(|thread| thread.join().expect("a reply")).collect::<Vec<_>>()
    });
    assert_eq!(replies, [200; 100]);
}

/// Clients that send a head byte by byte, or none, are given up; meanwhile others are answered.
#[test]
fn slow_heads_are_given_up_and_block_nobody() {
    let page = Page::new();
    let start = Instant::now();
    let mut slow: Vec<_> = (0..100).map(|_| page.connect()).collect();
    let head = page.request("about", "");
    for (index, stream) in slow.iter_mut().enumerate() {
        stream.write_all(&head.as_bytes()[..index % 60]).expect("a part");
    }
    for _ in 0..20 {
        let asked = Instant::now();
        assert_eq!(page.get("picture?draft=1").0, 200);
        assert!(asked.elapsed() < Duration::from_secs(2), "{:?}", asked.elapsed());
    }
    let mut rest = [0; 1];
    for stream in &mut slow {
        assert!(matches!(stream.read(&mut rest), Ok(0) | Err(_)), "it is closed without a reply, or after one of 408");
    }
    let took = start.elapsed();
    assert!(took + Duration::from_secs(1) >= HEAD_TIME && took < HEAD_TIME + Duration::from_secs(15), "{took:?}");
}

/// A client that takes no bytes of a large reply loses its connection.
#[test]
fn replies_that_nobody_takes_are_given_up() {
    let page = Page::new();
    let mut stream = page.connect();
    stream.write_all(page.request("picture?recipe=large", "").as_bytes()).expect("a request");
    std::thread::sleep(STALL_TIME + Duration::from_secs(3));
    let mut bytes = Vec::new();
    let _ = stream.read_to_end(&mut bytes);
    assert!(!bytes.is_empty() && bytes.len() < 32 << 20, "{} bytes were kept for it", bytes.len());
    assert_eq!(page.get("picture?recipe=large").2.len(), 32 << 20, "whoever takes them gets them all");
}

/// What takes long gives way to what is drawn at once, and is stopped when its client goes away.
#[test]
fn slow_pictures_are_stopped() {
    let page = Page::new();
    let ask = |inside: &str| {
        let mut stream = page.connect();
        stream.write_all(page.request(inside, "").as_bytes()).expect("a request");
        stream
    };
    // Nobody waits any more.
    let gone = ask("picture?show=truth&samples=64");
    std::thread::sleep(Duration::from_millis(100));
    drop(gone);
    until("stopped for its client", || page.count(|counts| &counts.stopped) == 1);

    let mut slow = ask("picture?show=truth&samples=64");
    std::thread::sleep(Duration::from_millis(100));
    let asked = Instant::now();
    assert_eq!(page.get("picture?draft=1&samples=1").0, 200);
    assert!(asked.elapsed() < Duration::from_millis(400), "{:?}", asked.elapsed());
    let (status, head, _) = received(&mut slow);
    assert_eq!(status, 503);
    assert!(head.contains("retry-after"), "{head}");
    assert_eq!(page.get("picture?show=truth&samples=1").0, 200, "the next one is drawn");

    // Quick ones wait for one another, and those who went away are not drawn for.
    let before = page.count(|counts| &counts.drawn);
    let first = ask("picture?samples=16");
    std::thread::sleep(Duration::from_millis(30));
    for _ in 0..20 {
        drop(ask("picture?samples=16"));
    }
    std::thread::sleep(Duration::from_millis(100));
    assert_eq!(page.get("picture?samples=1").0, 200);
    drop(first);
    let drawn = page.count(|counts| &counts.drawn) - before;
    assert!(drawn <= 4, "{drawn} pictures were drawn");
}
