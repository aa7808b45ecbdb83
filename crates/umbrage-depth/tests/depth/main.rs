//! What maps store and how: laws of every rule and storage, and published results. One program, so that it is linked once.

mod deep;
mod facets;
mod moments;
mod quantise;
mod rules;
mod storages;
mod stored;
