//! Packed files, mangled: refused in words, or the records that are in them.

use wildpoint::track::LoadOptions;

use super::laws;

pub(super) fn body(data: &[u8]) {
    if let Some(track) = laws::loaded(data, &LoadOptions::default()) {
        laws::changed(&track, data, Some(-2.0));
    }
}
