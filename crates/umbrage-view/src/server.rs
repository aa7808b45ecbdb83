//! The server.

use crate::answers::{Answers, Stop};
use crate::gate::Gate;
use crate::lanes::{Lanes, StopAtEnd};
use crate::reply::{Reply, no_answer, picture, refused, reply};
use crate::stalls::Stalls;
use crate::{Ask, State, StateError, page};
use hyper::body::{Body, Incoming};
use hyper::header::{CONNECTION, HeaderValue};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::{Request, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use std::convert::Infallible;
use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Semaphore;

/// How long a client may take for the head of a request, and how long a connection may be idle.
pub const HEAD_TIME: Duration = Duration::from_secs(5);
/// How long a client may read no bytes of a reply.
pub const STALL_TIME: Duration = Duration::from_secs(10);
/// Most connections at once; further ones wait.
pub const MOST_CONNECTIONS: usize = 256;
/// Most bytes of a request's head.
const MOST_HEAD: usize = 32 * 1024;

/// A server on the loopback interface.
pub struct Server {
    listener: TcpListener,
    gate: Gate,
}

impl Server {
    /// Listens on a port of 127.0.0.1, or on a free one for 0. Nothing is answered before [`Server::run`].
    ///
    /// # Errors
    /// Where the port is taken, or the operating system has no random bytes.
    pub fn bind(port: u16) -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
        listener.set_nonblocking(true)?;
        let gate = Gate::new(listener.local_addr()?.port())?;
        Ok(Self { listener, gate })
    }

    /// Where the page is: `http://127.0.0.1:PORT/TOKEN/`, with a new token for each server.
    pub fn address(&self) -> String {
        self.gate.address()
    }

    /// Answers for as long as the program runs.
    ///
    /// # Errors
    /// Where the operating system lacks the resources for the server's work.
    pub fn run(self, answers: Arc<dyn Answers>) -> io::Result<()> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        runtime.block_on(self.accept(answers))
    }

    async fn accept(self, answers: Arc<dyn Answers>) -> io::Result<()> {
        let listener = tokio::net::TcpListener::from_std(self.listener)?;
        let site = Arc::new(Site { gate: self.gate, lanes: Lanes::new(), answers });
        let places = Arc::new(Semaphore::new(MOST_CONNECTIONS));
        loop {
            let Ok(place) = Arc::clone(&places).acquire_owned().await else { return Ok(()) };
            let Ok((stream, _)) = listener.accept().await else {
                // Too many open files, or a client that is already gone: later ones may succeed.
                tokio::time::sleep(Duration::from_millis(20)).await;
                continue;
            };
            // Replies are written at once as a whole.
            let _ = stream.set_nodelay(true);
            let site = Arc::clone(&site);
            tokio::spawn(async move {
                let service = service_fn(|request| {
                    let site = Arc::clone(&site);
                    async move { Ok::<_, Infallible>(site.answer(request).await) }
                });
                let mut http = http1::Builder::new();
                http.timer(TokioTimer::new()).header_read_timeout(HEAD_TIME).max_buf_size(MOST_HEAD);
                // A client that disconnects is not an error of the server.
                let _ = http.serve_connection(TokioIo::new(Stalls::new(stream, STALL_TIME)), service).await;
                drop(place);
            });
        }
    }
}

/// What all connections share.
struct Site {
    gate: Gate,
    lanes: Lanes,
    answers: Arc<dyn Answers>,
}

impl Site {
    async fn answer(&self, request: Request<Incoming>) -> Reply {
        let mut reply = self.checked(&request).await;
        if !request.body().is_end_stream() {
            // What else the client sends is not read.
            reply.headers_mut().insert(CONNECTION, HeaderValue::from_static("close"));
        }
        reply
    }

    async fn checked(&self, request: &Request<Incoming>) -> Reply {
        if let Err((status, problem)) = self.gate.check(request.method(), request.headers()) {
            return refused(status, problem);
        }
        if !request.body().is_end_stream() {
            return refused(StatusCode::PAYLOAD_TOO_LARGE, "no body is read");
        }
        let Some(inside) = self.gate.inside(request.uri().path()) else {
            return refused(StatusCode::NOT_FOUND, "there is nothing here");
        };
        if let Some((kind, text)) = page::file(inside) {
            return reply(StatusCode::OK, kind, text);
        }
        let query = request.uri().query().unwrap_or("");
        let made = match inside {
            "about" => Ok(json(self.answers.about())),
            "lines" => {
                State::read(query).map(|state| self.answers.lines(&state).map_or_else(|no| no_answer(&no), json))
            }
            "picture" => self.picture(query).await,
            "explanation" => self.explanation(query).await,
            _ => return refused(StatusCode::NOT_FOUND, "there is nothing here"),
        };
        made.unwrap_or_else(|error| refused(StatusCode::BAD_REQUEST, &error.to_string()))
    }

    async fn picture(&self, query: &str) -> Result<Reply, StateError> {
        let ask = Ask::read(query)?;
        let is_slow = ask.is_slow();
        let work = move |answers: &dyn Answers, stop: &Stop| answers.picture(&ask, stop).map(picture);
        Ok(self.drawn(is_slow, work).await)
    }

    async fn explanation(&self, query: &str) -> Result<Reply, StateError> {
        let state = State::read(query)?;
        let work = move |answers: &dyn Answers, stop: &Stop| answers.explanation(&state, stop).map(json);
        Ok(self.drawn(false, work).await)
    }

    /// What is drawn, for as long as the client waits.
    async fn drawn(
        &self,
        is_slow: bool,
        work: impl FnOnce(&dyn Answers, &Stop) -> Result<Reply, crate::Refusal> + Send + 'static,
    ) -> Reply {
        let Some(_place) = self.lanes.enter() else {
            return refused(StatusCode::SERVICE_UNAVAILABLE, "too many pictures are waiting to be drawn");
        };
        let end = StopAtEnd(Stop::default());
        let (answers, stop) = (Arc::clone(&self.answers), end.0.clone());
        let work = move || work(&*answers, &stop);
        match self.lanes.run(is_slow, &end.0, work).await {
            Some(Ok(reply)) => reply,
            Some(Err(refusal)) => no_answer(&refusal),
            None => refused(StatusCode::INTERNAL_SERVER_ERROR, "the program failed: its command has printed the error"),
        }
    }
}

fn json(text: String) -> Reply {
    reply(StatusCode::OK, "application/json", text)
}
