//! The catalogue, what is kept of it, and the program.

mod bits;
mod catalogue;
mod command_line;
mod goldens;
mod times;
