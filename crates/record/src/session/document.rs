//! The session file: TOML, meant to be read and diffed. Every value of every parameter is written, so that a later
//! default cannot change an old result.

mod measurement;
mod read;
mod write;

pub(super) use read::{Read, WrittenDecision, read_with_texts};
pub use read::{parse, read};
pub(super) use write::quoted;
pub use write::render;

/// The version of the file that this program writes.
const FORMAT: i64 = 2;
/// The oldest that it reads.
const OLDEST: i64 = 1;
