//! A page in a browser on this machine that shows what a program draws on request.
//!
//! [`Server`] listens on the loopback interface alone, under an address with a random [token](Server::address), and answers `GET` and nothing else. It
//! knows no scene, no recipe and no file: the program that has them implements [`Answers`], which is called for what a [`State`] of the page shows. The page
//! is plain
//! HTML, CSS and modules of JavaScript, compiled in; all that it shows stands in the fragment of its address, in the words that requests use.
//!
//! What keeps other programs and pages out: the token, 128 bits from the operating system; `Host`, which must be this machine's own, so that no name elsewhere
//! that is made to point here is believed; `Origin` and `Sec-Fetch-Site`, so that no other page can send requests; and a policy that lets the page load
//! nothing but itself. Heads are read for [`HEAD_TIME`] at most, a client that reads no bytes is dropped after [`STALL_TIME`], and no body is read.
//!
//! Pictures that are drawn at once come before those that take long: a quick one stops the slow one that is being made, which the page requests
//! again once nothing moves. When a client disconnects, what was being drawn for it is stopped.
//!
//! ```no_run
//! use std::sync::Arc;
//! use umbrage_view::{Answers, Ask, Picture, Refusal, Server, State, Stop};
//!
//! struct Grey;
//! impl Answers for Grey {
//!     fn about(&self) -> String {
//!         "{}".into()
//!     }
//!     fn lines(&self, _: &State) -> Result<String, Refusal> {
//!         Ok(r#"{"lines":[]}"#.into())
//!     }
//!     fn picture(&self, _: &Ask, _: &Stop) -> Result<Picture, Refusal> {
//!         Err(Refusal::Wrong("there is none".into()))
//!     }
//!     fn explanation(&self, _: &State, _: &Stop) -> Result<String, Refusal> {
//!         Err(Refusal::Stopped)
//!     }
//! }
//! let server = Server::bind(0)?;
//! println!("{}", server.address());
//! server.run(Arc::new(Grey))?;
//! # Ok::<(), std::io::Error>(())
//! ```

mod answers;
mod gate;
mod lanes;
mod page;
mod reply;
mod server;
mod stalls;
mod state;

pub use answers::{Answers, Picture, Refusal, Stop};
pub use server::{HEAD_TIME, MOST_CONNECTIONS, STALL_TIME, Server};
pub use state::{Ask, MOST_TURNS, Of, Show, State, StateError};
