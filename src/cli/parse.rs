//! Values of options that are more than a word or a number.

/// A parameter and its value.
pub(super) fn pair(text: &str) -> std::result::Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err("expected KEY=VALUE, for example k=4.5".into()),
    }
}

/// Bytes, as `500M` or `4G`.
pub(super) fn memory_size(text: &str) -> std::result::Result<u64, String> {
    crate::memory::parse(text).ok_or_else(|| "expected a size, for example 500M or 4G".to_owned())
}

/// Columns and rows of a window, each from 1 to 1000.
pub(super) fn size(text: &str) -> std::result::Result<(u16, u16), String> {
    let sizes = text.split_once(['x', 'X']).and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    sizes
        .filter(|&(w, h)| (1..=1000).contains(&w) && (1..=1000).contains(&h))
        .ok_or_else(|| "expected WIDTHxHEIGHT, for example 120x40".to_owned())
}
