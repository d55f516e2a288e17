//! Signatures of decisions as texts: in sessions and tables, and for people.

use wildpoint_core::review::Signature;

/// `at` of a signature as in sessions: `2026-12-01T02:15:00Z`. None where it is not known or outside the calendar.
pub(crate) fn at_text(signature: &Signature) -> Option<String> {
    Some(jiff::Timestamp::from_second(signature.at?).ok()?.to_string())
}

/// The seconds since 1970 that such a text says, in whole ones.
pub(crate) fn at_of_text(text: &str) -> Option<i64> {
    text.parse::<jiff::Timestamp>().ok().map(|at| at.as_second())
}

/// A signature for people: `M. Ito, 2026-12-01 02:15 UTC`. None where neither is known.
#[must_use]
pub fn signature_words(signature: &Signature) -> Option<String> {
    let at = signature.at.and_then(|at| jiff::Timestamp::from_second(at).ok());
    let at = at.map(|at| at.strftime("%Y-%m-%d %H:%M UTC").to_string());
    let by = signature.by.as_deref().map(str::to_owned);
    let parts: Vec<String> = by.into_iter().chain(at).collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_read_as_they_are_written() {
        // 20,788 days after 1970-01-01 is 2026-12-01.
        let at = 20_788 * 86_400 + 2 * 3600 + 15 * 60;
        let signature = Signature { by: Some("M. Ito".into()), at: Some(at) };
        assert_eq!(at_text(&signature).as_deref(), Some("2026-12-01T02:15:00Z"));
        assert_eq!(at_of_text("2026-12-01T02:15:00Z"), Some(at));
        assert_eq!(at_of_text("2026-12-01T03:15:00+01:00"), Some(at));
        assert_eq!(at_of_text("yesterday"), None);
        assert_eq!(signature_words(&signature).as_deref(), Some("M. Ito, 2026-12-01 02:15 UTC"));
        assert_eq!(signature_words(&Signature::default()), None);
        assert_eq!(at_text(&Signature { at: Some(i64::MAX), ..signature }), None);
    }
}
