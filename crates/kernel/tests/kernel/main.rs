//! The kernel as an engine runs it.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod common;
mod partitions;
mod sessions;
mod streams;
