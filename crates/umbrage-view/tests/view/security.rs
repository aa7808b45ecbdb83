//! Who is let in, and what a reply allows.

use crate::client::Page;
use umbrage_view::Server;

#[test]
fn the_page_and_its_files_are_there() {
    let page = Page::new();
    for (file, kind, part) in [
        ("", "text/html", "<canvas"),
        ("main.js", "text/javascript", "import"),
        ("state.js", "text/javascript", "class State"),
        ("recipe.js", "text/javascript", "class Recipe"),
        ("picture.js", "text/javascript", "class Picture"),
        ("asking.js", "text/javascript", "class Asking"),
        ("style.css", "text/css", ":root"),
        ("icon.svg", "image/svg+xml", "<svg"),
        ("about", "application/json", "fake"),
    ] {
        let (status, head, body) = page.get(file);
        assert_eq!(status, 200, "{file}");
        assert!(head.contains(&format!("content-type: {kind}")), "{head}");
        assert!(String::from_utf8_lossy(&body).contains(part), "{file}");
        for line in [
            "cache-control: no-store",
            "x-content-type-options: nosniff",
            "referrer-policy: no-referrer",
            "default-src 'none'; script-src 'self'",
            "frame-ancestors 'none'",
            "cross-origin-resource-policy: same-origin",
        ] {
            assert!(head.contains(line), "{file}: {line}: {head}");
        }
        assert!(!head.contains("access-control"), "{head}");
    }
    let (status, head, body) = page.get("picture?show=shadow&draft=1");
    assert_eq!((status, &*body), (200, &b"png"[..]));
    assert!(head.contains("umbrage-about: {\"ms\":1}"), "{head}");
}

/// The page has no script and no style in its own text, which its policy would not run.
#[test]
fn the_page_keeps_to_its_own_policy() {
    let (_, _, body) = Page::new().get("");
    let text = String::from_utf8(body).expect("text");
    assert!(!text.contains("style=") && !text.contains("<style"), "no style of its own");
    let handlers = text.split_whitespace().filter(|word| word.starts_with("on") && word.contains('='));
    assert_eq!(handlers.count(), 0, "no script of its own");
    assert_eq!(text.matches("<script").count(), 1);
    assert!(!text.contains("://"), "nothing from elsewhere");
}

#[test]
fn tokens_are_long_and_new_each_time() {
    let token = |server: &Server| server.address().split('/').nth(3).expect("a token").to_owned();
    let servers: Vec<Server> = (0..8).map(|_| Server::bind(0).expect("a port")).collect();
    let mut tokens: Vec<String> = servers.iter().map(token).collect();
    assert!(tokens.iter().all(|token| token.len() == 32 && token.bytes().all(|byte| byte.is_ascii_hexdigit())));
    tokens.sort();
    tokens.dedup();
    assert_eq!(tokens.len(), 8);
}

#[test]
fn nobody_else_is_let_in() {
    let page = Page::new();
    let Page { port, token, .. } = &page;
    let host = format!("Host: 127.0.0.1:{port}\r\n");
    let ask = |method: &str, path: &str, lines: &str| {
        page.send(format!("{method} {path} HTTP/1.1\r\n{lines}Connection: close\r\n\r\n").as_bytes()).0
    };
    let inside = format!("/{token}/about");
    assert_eq!(ask("GET", &inside, &host), 200);
    assert_eq!(ask("GET", &inside, &format!("Host: localhost:{port}\r\n")), 200);
    // Another name that points here, another port, none, and two.
    for lines in [
        format!("Host: example.org:{port}\r\n"),
        "Host: 127.0.0.1\r\n".into(),
        format!("Host: 127.0.0.1:{}\r\n", port ^ 1),
        format!("Host: 127.0.0.1:{port}.example.org\r\n"),
        String::new(),
        format!("{host}Host: example.org\r\n"),
    ] {
        assert!([400, 403].contains(&ask("GET", &inside, &lines)), "{lines:?}");
    }
    for (origin, status) in [
        (format!("http://127.0.0.1:{port}"), 200),
        (format!("http://localhost:{port}"), 200),
        ("http://example.org".into(), 403),
        (format!("https://127.0.0.1:{port}"), 403),
        (format!("http://127.0.0.1:{}", port ^ 1), 403),
        ("null".into(), 403),
    ] {
        assert_eq!(ask("GET", &inside, &format!("{host}Origin: {origin}\r\n")), status, "{origin}");
    }
    for (site, status) in [("same-origin", 200), ("none", 200), ("cross-site", 403), ("same-site", 403)] {
        assert_eq!(ask("GET", &inside, &format!("{host}Sec-Fetch-Site: {site}\r\n")), status, "{site}");
    }
    for method in ["POST", "PUT", "DELETE", "HEAD", "OPTIONS", "PATCH", "TRACE"] {
        let reply = page.send(format!("{method} {inside} HTTP/1.1\r\n{host}Connection: close\r\n\r\n").as_bytes());
        assert_eq!(reply.0, 405, "{method}");
        assert!(reply.1.contains("allow: get"), "{}", reply.1);
    }
    let wrong = format!("/{}{}/about", &token[1..], if token.starts_with('0') { '1' } else { '0' });
    for path in [
        "/",
        "/about",
        &wrong,
        &format!("/{token}"),
        &format!("/{token}0/about"),
        &format!("/{}/about", &token[..31]),
        "//about",
    ] {
        assert_eq!(ask("GET", path, &host), 404, "{path}");
    }
    for path in ["nothing", "../about", "%61bout", "about/", "page/main.js"] {
        assert_eq!(ask("GET", &format!("/{token}/{path}"), &host), 404, "{path}");
    }
    assert_eq!(ask("GET", &inside, &format!("{host}Content-Length: 5\r\n")), 413);
    assert_eq!(ask("GET", &inside, &format!("{host}Transfer-Encoding: chunked\r\n")), 413);
}

#[test]
fn what_cannot_be_had_is_one_line() {
    let page = Page::new();
    for (inside, line) in [
        ("picture?recipe=wrong", "no such recipe\n"),
        ("picture?pixel=-1,2", "pixel = \"-1,2\": expected X,Y, whole numbers from 0\n"),
        ("picture?of=both", "of = \"both\": expected result or truth\n"),
        ("picture?draft=2", "draft = \"2\": expected 0 or 1\n"),
        (
            "lines?of=truth",
            "name = \"of\": expected one of show, recipe, map-size, light, turn, samples, wipe, pixel\n",
        ),
    ] {
        let (status, _, body) = page.get(inside);
        assert_eq!((status, String::from_utf8_lossy(&body).as_ref()), (400, line), "{inside}");
    }
    let (status, _, body) = page.get("picture?recipe=panic");
    assert_eq!(status, 500, "{}", String::from_utf8_lossy(&body));
    assert_eq!(page.get("picture").0, 200, "the next one is drawn");
}
