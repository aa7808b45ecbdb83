//! The server as a browser, a stranger and a broken client find it.

mod client;
mod crowds;
mod security;
mod states;
