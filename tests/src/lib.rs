//! Cross-crate laws live in `tests/`; this library holds what they share.
