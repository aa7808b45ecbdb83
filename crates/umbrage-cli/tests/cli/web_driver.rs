//! A browser that is driven through the W3C's WebDriver, as far as tests need it.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Keys that are no letters, as WebDriver has them.
pub const SHIFT: &str = "\u{E008}";
pub const RIGHT: &str = "\u{E014}";
pub const DOWN: &str = "\u{E015}";
pub const ENTER: &str = "\u{E007}";
pub const ESCAPE: &str = "\u{E00C}";

/// Headless Chromium with one window, until it is dropped.
pub struct Browser {
    driver: Child,
    port: u16,
    session: String,
}

impl Browser {
    /// `None` if chromedriver or its browser is not installed.
    pub fn new(width: u32, height: u32) -> Option<Self> {
        let mut command = Command::new("chromedriver");
        let mut driver = command.arg("--port=0").stdout(Stdio::piped()).stderr(Stdio::null()).spawn().ok()?;
        let lines = BufReader::new(driver.stdout.take().expect("its output")).lines();
        let port = lines.map_while(Result::ok).find_map(|line| {
            let (_, port) = line.split_once("started successfully on port ")?;
            port.trim_end_matches('.').parse().ok()
        });
        let mut browser = Self { driver, port: port?, session: String::new() };
        let size = format!("--window-size={width},{height}");
        let args = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", &size];
        let wanted = json!({ "capabilities": { "alwaysMatch": { "goog:chromeOptions": { "args": args } } } });
        browser.session = browser.ask("POST", "/session", &wanted)["sessionId"].as_str()?.into();
        Some(browser)
    }

    /// The value of a reply.
    fn ask(&self, method: &str, path: &str, body: &Value) -> Value {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("the driver");
        stream.set_read_timeout(Some(Duration::from_secs(60))).expect("a time");
        let body = body.to_string();
        let length = body.len();
        let head = format!(
            "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n"
        );
        stream.write_all((head + &body).as_bytes()).expect("a request");
        // The driver keeps the connection, whatever the request.
        let mut reply = BufReader::new(stream);
        let (mut line, mut length) = (String::new(), 0);
        while reply.read_line(&mut line).is_ok_and(|read| read > 2) {
            let lower = line.to_ascii_lowercase();
            length = lower.strip_prefix("content-length:").map_or(length, |rest| rest.trim().parse().unwrap_or(0));
            line.clear();
        }
        let mut body = vec![0; length];
        let _ = reply.read_exact(&mut body);
        let reply: Value = serde_json::from_slice(&body).unwrap_or_default();
        reply["value"].clone()
    }

    fn here(&self, path: &str, body: &Value) -> Value {
        let reply = self.ask("POST", &format!("/session/{}/{path}", self.session), body);
        assert!(reply["error"].is_null(), "{path} {body}: {reply}");
        reply
    }

    /// Opens an address.
    pub fn open(&self, address: &str) {
        self.here("url", &json!({ "url": address }));
    }

    /// What a script returns.
    pub fn script(&self, script: &str) -> Value {
        self.here("execute/sync", &json!({ "script": script, "args": [] }))
    }

    /// An expression's value as text.
    pub fn text(&self, expression: &str) -> String {
        self.script(&format!("return String({expression})")).as_str().unwrap_or_default().into()
    }

    /// Whether an expression is true.
    pub fn is(&self, expression: &str) -> bool {
        self.script(&format!("return Boolean({expression})")) == true
    }

    /// Waits until an expression is true.
    pub fn until(&self, expression: &str) {
        let end = Instant::now() + Duration::from_secs(60);
        while !self.is(expression) {
            let about =
                "[location.hash, ...['status', 'problem'].map((id) => document.getElementById(id)?.textContent)]";
            assert!(Instant::now() < end, "{expression}: {}", self.text(about));
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// Waits until the page sends no more requests.
    pub fn rest(&self) {
        // A light that moves comes to rest only a moment after its last move.
        std::thread::sleep(Duration::from_millis(350));
        self.until(
            "document.querySelector('#status').textContent === '' && document.querySelector('#lines').textContent",
        );
    }

    /// A pointer's stroke, in shares of the picture's width and height: down at the first place, over the others, up at the last.
    pub fn stroke(&self, places: &[[f64; 2]]) {
        let side = |side: &str| {
            let side = self.script(&format!("return document.querySelector('canvas').getBoundingClientRect().{side}"));
            side.as_f64().expect("a number")
        };
        let [left, top, width, height] = ["x", "y", "width", "height"].map(side);
        let to = |[x, y]: [f64; 2], ms: u32| {
            let (x, y) = ((left + x * width) as i64, (top + y * height) as i64);
            json!({ "type": "pointerMove", "duration": ms, "x": x, "y": y })
        };
        let mut all = vec![to(places[0], 0), json!({ "type": "pointerDown", "button": 0 })];
        all.extend(places[1..].iter().map(|place| to(*place, 200)));
        all.push(json!({ "type": "pointerUp", "button": 0 }));
        let mouse = json!({ "pointerType": "mouse" });
        let mouse = json!({ "type": "pointer", "id": "mouse", "parameters": mouse, "actions": all });
        self.here("actions", &json!({ "actions": [mouse] }));
    }

    /// Keys one after the other, while others are held.
    pub fn keys(&self, held: &[&str], keys: &[&str]) {
        let down = |key: &&str| json!({ "type": "keyDown", "value": key });
        let up = |key: &&str| json!({ "type": "keyUp", "value": key });
        let pressed = keys.iter().flat_map(|key| [down(key), up(key)]);
        let all: Vec<Value> = held.iter().map(down).chain(pressed).chain(held.iter().map(up)).collect();
        self.here("actions", &json!({ "actions": [{ "type": "key", "id": "keys", "actions": all }] }));
    }

    /// Gives a control a value, with the events of a reader who does.
    pub fn choose(&self, id: &str, value: &str) {
        let events = "for (const name of ['input', 'change']) at.dispatchEvent(new Event(name, { bubbles: true }))";
        self.script(&format!("const at = document.getElementById('{id}'); at.value = '{value}'; {events}"));
    }

    /// A number that stands for the pixels of the picture between two shares of its width.
    pub fn pixels(&self, from: f64, to: f64) -> String {
        self.text(&format!(
            "(() => {{ const at = document.querySelector('canvas'), wide = at.width; \
             const data = at.getContext('2d').getImageData({from} * wide, 0, ({to} - {from}) * wide, at.height).data; \
             return data.reduce((sum, value) => (sum * 31 + value) % 4294967291, 7); }})()"
        ))
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        if !self.session.is_empty() {
            self.ask("DELETE", &format!("/session/{}", self.session), &json!({}));
        }
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}
