//! Replies.

use crate::Refusal;
use http_body_util::Full;
use hyper::body::Bytes;
use hyper::header::{ALLOW, CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HeaderValue, RETRY_AFTER};
use hyper::{Response, StatusCode};

pub type Reply = Response<Full<Bytes>>;

/// The page loads nothing but itself, and cannot be embedded in another page.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; \
                      base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// The name of the header with facts about a picture.
const ABOUT: &str = "umbrage-about";

/// A reply of a type.
pub fn reply(status: StatusCode, kind: &'static str, bytes: impl Into<Bytes>) -> Reply {
    let mut reply = Response::new(Full::new(bytes.into()));
    *reply.status_mut() = status;
    let headers = reply.headers_mut();
    headers.insert(CONTENT_TYPE, HeaderValue::from_static(kind));
    headers.insert(CACHE_CONTROL, HeaderValue::from_static("no-store"));
    headers.insert(CONTENT_SECURITY_POLICY, HeaderValue::from_static(POLICY));
    for (name, value) in [
        ("x-content-type-options", "nosniff"),
        ("x-frame-options", "DENY"),
        ("referrer-policy", "no-referrer"),
        ("cross-origin-resource-policy", "same-origin"),
        ("cross-origin-opener-policy", "same-origin"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    reply
}

/// A line of text that names what is wrong.
pub fn refused(status: StatusCode, line: &str) -> Reply {
    let line = line.replace(['\n', '\r'], " ");
    let mut reply = reply(status, "text/plain; charset=utf-8", format!("{line}\n"));
    match status {
        StatusCode::METHOD_NOT_ALLOWED => {
            reply.headers_mut().insert(ALLOW, HeaderValue::from_static("GET"));
        }
        StatusCode::SERVICE_UNAVAILABLE => {
            reply.headers_mut().insert(RETRY_AFTER, HeaderValue::from_static("1"));
        }
        _ => {}
    }
    reply
}

/// Why there is no answer.
pub fn no_answer(refusal: &Refusal) -> Reply {
    match refusal {
        Refusal::Wrong(line) => refused(StatusCode::BAD_REQUEST, line),
        Refusal::Stopped => refused(StatusCode::SERVICE_UNAVAILABLE, "stopped for something that is drawn at once"),
    }
}

/// A picture.
pub fn picture(picture: crate::Picture) -> Reply {
    let mut reply = reply(StatusCode::OK, "image/png", picture.png);
    if let Ok(about) = HeaderValue::from_str(&picture.about) {
        reply.headers_mut().insert(ABOUT, about);
    }
    reply
}
