//! Files of the formats that are known by name, mangled: refused in words, or tables of which all holds.

use wildpoint::track::{LoadOptions, format_of};

use super::bytes::Bytes;
use super::laws;

pub(super) fn body(data: &[u8]) {
    let mut bytes = Bytes(data);
    let table = [None, None, None, Some(1), Some(2), Some(7)][bytes.below(6)];
    let value = [Some(-2.0), Some(1234.5678), None][bytes.below(3)];
    let text = bytes.0;
    if let Some((format, _)) = format_of(text) {
        assert!(!format.name.is_empty());
    }
    let options = LoadOptions { table, ..LoadOptions::default() };
    if let Some(track) = laws::loaded(text, &options) {
        laws::changed(&track, text, value);
    }
}
