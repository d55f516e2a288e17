//! The time of day.

/// Now; the moment of `SOURCE_DATE_EPOCH` (seconds since 1970) where the environment has it, so that a report or a
/// session can be made again to the same bytes.
pub(crate) fn now() -> jiff::Timestamp {
    let told = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|text| text.trim().parse().ok());
    told.and_then(|seconds| jiff::Timestamp::from_second(seconds).ok()).unwrap_or_else(jiff::Timestamp::now)
}
