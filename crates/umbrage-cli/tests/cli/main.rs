//! The commands as a user would type them. One program, so that it is linked once.

mod bad_luck;
mod biases;
mod browser;
mod commands;
mod compare;
mod examples;
mod explained;
mod file_names;
mod lamps;
mod lookups;
mod maps;
mod pages;
mod scenes;
mod shards;
mod templates;
mod typed;
mod web_driver;
