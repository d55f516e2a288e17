//! The session file: TOML, meant to be read and diffed. Every value of every knob is written, so that a later
//! default cannot change an old result.

use crate::track::Delimiter;

mod read;
mod write;

pub(super) use read::{Read, WrittenDecision, read_with_texts};
pub use read::{parse, read};
pub use write::render;

/// The version of the file that this program writes and reads.
const FORMAT: i64 = 1;

/// The words for delimiters.
pub(in crate::session) const DELIMITERS: [(&str, Delimiter); 5] = [
    ("comma", Delimiter::Byte(b',')),
    ("semicolon", Delimiter::Byte(b';')),
    ("tab", Delimiter::Byte(b'\t')),
    ("pipe", Delimiter::Byte(b'|')),
    ("blanks", Delimiter::Blanks),
];
