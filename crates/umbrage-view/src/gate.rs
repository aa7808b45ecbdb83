//! Who is let in.

use hyper::header::{HOST, HeaderMap, HeaderValue, ORIGIN};
use hyper::{Method, StatusCode};
use std::fmt::Write;

/// Bytes of a token.
const TOKEN_BYTES: usize = 16;

/// The address of a page, and who may ask there.
pub struct Gate {
    port: u16,
    token: String,
}

impl Gate {
    /// A new token.
    ///
    /// # Errors
    /// Where the operating system has no random bytes.
    pub fn new(port: u16) -> std::io::Result<Self> {
        let mut bytes = [0; TOKEN_BYTES];
        getrandom::fill(&mut bytes).map_err(std::io::Error::other)?;
        let mut token = String::with_capacity(2 * TOKEN_BYTES);
        for byte in bytes {
            // Writing to a string cannot fail.
            let _ = write!(token, "{byte:02x}");
        }
        Ok(Self { port, token })
    }

    /// Where the page is.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    /// Nothing, for a request that the page itself, or its reader, may have made.
    ///
    /// # Errors
    /// The status, and a line that says what is wrong.
    pub fn check(&self, method: &Method, headers: &HeaderMap) -> Result<(), (StatusCode, &'static str)> {
        let forbidden = |problem| Err((StatusCode::FORBIDDEN, problem));
        let own = ["127.0.0.1", "localhost"].map(|host| format!("{host}:{}", self.port));
        let mut hosts = headers.get_all(HOST).iter();
        if !(hosts.next().is_some_and(|host| own.iter().any(|own| host == own)) && hosts.next().is_none()) {
            return forbidden("Host is not this machine's own");
        }
        let is_own = |origin: &HeaderValue| own.iter().any(|own| *origin == format!("http://{own}"));
        if !headers.get_all(ORIGIN).iter().all(is_own) {
            return forbidden("Origin is another page");
        }
        if !headers.get_all("sec-fetch-site").iter().all(|site| site == "same-origin" || site == "none") {
            return forbidden("Sec-Fetch-Site is another page");
        }
        if method != Method::GET {
            return Err((StatusCode::METHOD_NOT_ALLOWED, "only GET is answered"));
        }
        Ok(())
    }

    /// The part of the path below the token; `None` for a wrong token.
    pub fn inside<'a>(&self, path: &'a str) -> Option<&'a str> {
        let (token, inside) = path.strip_prefix('/')?.split_once('/')?;
        // All bytes are compared, so that the time does not reveal how many are right.
        let differ = token.bytes().zip(self.token.bytes()).fold(0, |differ, (a, b)| differ | (a ^ b));
        (token.len() == self.token.len() && differ == 0).then_some(inside)
    }
}
