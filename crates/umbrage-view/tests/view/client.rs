//! A server that draws nothing, and requests written by hand.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use umbrage_view::{Answers, Ask, Picture, Refusal, Server, State, Stop};

/// How often each thing happened.
#[derive(Default)]
pub struct Counts {
    pub drawn: AtomicUsize,
    pub stopped: AtomicUsize,
}

/// Draws for a time that the number of samples says, in hundredths of a second, and looks at its stop.
struct Fake(Arc<Counts>);

impl Fake {
    fn draw(&self, state: &State, stop: &Stop) -> Result<(), Refusal> {
        let end = Instant::now() + Duration::from_millis(10 * u64::from(state.samples.unwrap_or(0)));
        while Instant::now() < end {
            if stop.is_set() {
                self.0.stopped.fetch_add(1, Ordering::SeqCst);
                return Err(Refusal::Stopped);
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        self.0.drawn.fetch_add(1, Ordering::SeqCst);
        Ok(())
    }
}

impl Answers for Fake {
    fn about(&self) -> String {
        r#"{"scene":"fake"}"#.into()
    }

    fn lines(&self, state: &State) -> Result<String, Refusal> {
        Ok(format!("{{\"query\":{:?}}}", state.query()))
    }

    fn picture(&self, ask: &Ask, stop: &Stop) -> Result<Picture, Refusal> {
        match ask.state.recipe.as_deref() {
            Some("wrong") => return Err(Refusal::Wrong("no\nsuch recipe".into())),
            Some("panic") => panic!("a fault of the fake"),
            // More than a socket's buffers hold.
            Some("large") => return Ok(Picture { png: vec![7; 32 << 20], about: "{}".into() }),
            _ => {}
        }
        self.draw(&ask.state, stop)?;
        Ok(Picture { png: b"png".to_vec(), about: r#"{"ms":1}"#.into() })
    }

    fn explanation(&self, state: &State, stop: &Stop) -> Result<String, Refusal> {
        self.draw(state, stop)?;
        Ok("{}".into())
    }
}

/// A server that runs.
pub struct Page {
    pub port: u16,
    pub token: String,
    pub counts: Arc<Counts>,
}

impl Page {
    pub fn new() -> Self {
        let server = Server::bind(0).expect("a free port");
        let address = server.address();
        let (port, token) = address
            .strip_prefix("http://127.0.0.1:")
            .and_then(|rest| rest.strip_suffix('/')?.split_once('/'))
            .expect("an address");
        let page = Self { port: port.parse().expect("a port"), token: token.into(), counts: Arc::default() };
        let fake = Arc::new(Fake(Arc::clone(&page.counts)));
        std::thread::spawn(move || server.run(fake));
        page
    }

    pub fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).expect("a connection");
        stream.set_read_timeout(Some(Duration::from_secs(60))).expect("a time");
        stream
    }

    /// The bytes of a request for something below the token, with further lines of its head.
    pub fn request(&self, inside: &str, lines: &str) -> String {
        format!(
            "GET /{}/{inside} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{lines}Connection: close\r\n\r\n",
            self.token, self.port
        )
    }

    /// Sends bytes, and returns the status, the head and the body; a status of 0 where the server closed without a word.
    pub fn send(&self, bytes: &[u8]) -> (u16, String, Vec<u8>) {
        let mut stream = self.connect();
        // A server that has refused already may have closed.
        let _ = stream.write_all(bytes);
        received(&mut stream)
    }

    pub fn get(&self, inside: &str) -> (u16, String, Vec<u8>) {
        self.send(self.request(inside, "").as_bytes())
    }

    pub fn count(&self, of: fn(&Counts) -> &AtomicUsize) -> usize {
        of(&self.counts).load(Ordering::SeqCst)
    }
}

/// All that comes until the server closes.
pub fn received(stream: &mut TcpStream) -> (u16, String, Vec<u8>) {
    let mut bytes = Vec::new();
    // What was received before a connection broke is a reply as well.
    let _ = stream.read_to_end(&mut bytes);
    let Some(end) = bytes.windows(4).position(|four| four == b"\r\n\r\n") else { return (0, String::new(), bytes) };
    let head = String::from_utf8_lossy(&bytes[..end]).to_ascii_lowercase();
    let status = head.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
    (status, head, bytes.split_off(end + 4))
}

/// Waits until something is so.
pub fn until(what: &str, is_so: impl Fn() -> bool) {
    let end = Instant::now() + Duration::from_secs(20);
    while !is_so() {
        assert!(Instant::now() < end, "{what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}
