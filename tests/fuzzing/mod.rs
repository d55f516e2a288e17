//! What the fuzz targets do with bytes, and the laws they hold the program to. One table for both users: `fuzz/` runs
//! each body under libFuzzer, `tests/fuzz_cases.rs` replays its finds and seeded random bytes on the stable toolchain.

#![allow(
    clippy::allow_attributes,
    clippy::allow_attributes_without_reason,
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a body ends where a law is broken: that is how it reports"
)]

mod bytes;
mod cells;
mod config;
mod formats;
mod header;
mod journal;
mod keymap;
mod laws;
mod loader;
pub(crate) mod methods;
mod packings;
mod roles;
mod sanitiser;
mod session;
mod tables;
mod times;

/// Does something with arbitrary bytes; panics where a law is broken.
pub(crate) type Body = fn(&[u8]);

/// Every target: its name (that of `fuzz/targets/NAME.rs` and `fuzz/regressions/NAME/`) and its body.
pub(crate) static TARGETS: &[(&str, Body)] = &[
    ("loader", loader::body),
    ("tables", tables::body),
    ("header", header::body),
    ("roles", roles::body),
    ("cells", cells::body),
    ("formats", formats::body),
    ("packings", packings::body),
    ("session", session::body),
    ("keymap", keymap::body),
    ("config", config::body),
    ("times", times::body),
    ("sanitiser", sanitiser::body),
    ("methods", methods::body),
    ("journal", journal::body),
];

/// Runs the target of this name.
///
/// # Panics
/// Where a law is broken, and for a name that is not in [`TARGETS`].
#[allow(dead_code, reason = "each user calls one of the two")]
pub(crate) fn run(name: &str, data: &[u8]) {
    let body = TARGETS.iter().find(|t| t.0 == name).expect("a target of the table").1;
    body(data);
}
