//! Words in times: months, days of the week, halves of the day, zones.

use super::super::calendar::SECOND;

/// The month (1 to 12) that a word names, in full or by its first letters: English, German, French, Spanish, Italian,
/// Portuguese and Dutch.
pub(super) fn month(word: &[u8]) -> Option<i64> {
    // The first letters, in lower case; longer ones stand before shorter ones where they decide.
    const STARTS: [(&str, i64); 33] = [
        ("jan", 1),
        ("janv", 1),
        ("ene", 1),
        ("gen", 1),
        ("feb", 2),
        ("fév", 2),
        ("fev", 2),
        ("mar", 3),
        ("mär", 3),
        ("mrz", 3),
        ("maa", 3),
        ("mrt", 3),
        ("apr", 4),
        ("avr", 4),
        ("abr", 4),
        ("may", 5),
        ("mai", 5),
        ("mag", 5),
        ("mei", 5),
        ("juin", 6),
        ("jun", 6),
        ("giu", 6),
        ("juil", 7),
        ("jul", 7),
        ("lug", 7),
        ("aug", 8),
        ("aoû", 8),
        ("aou", 8),
        ("ago", 8),
        ("sep", 9),
        ("set", 9),
        ("oct", 10),
        ("okt", 10),
    ];
    const LATE: [(&str, i64); 6] = [("out", 10), ("ott", 10), ("nov", 11), ("dec", 12), ("dez", 12), ("déc", 12)];
    let word = std::str::from_utf8(word).ok()?.to_lowercase();
    if !(3..=12).contains(&word.chars().count()) {
        return None;
    }
    STARTS.iter().chain(&LATE).chain(&[("dic", 12)]).find(|(start, _)| word.starts_with(start)).map(|(_, month)| *month)
}

/// True for the name of a day of the week, in full or by its first letters, in English or German.
pub(super) fn is_weekday(word: &[u8]) -> bool {
    const STARTS: [&[u8]; 7] = [b"mon", b"tue", b"wed", b"thu", b"fri", b"sat", b"sun"];
    const GERMAN: [&[u8]; 7] = [b"mo", b"di", b"mi", b"do", b"fr", b"sa", b"so"];
    let lower = word.to_ascii_lowercase();
    STARTS.iter().any(|s| lower.starts_with(s)) || GERMAN.iter().any(|s| lower == **s)
}

/// `AM` is false, `PM` is true.
pub(super) fn afternoon(word: &[u8]) -> Option<bool> {
    match word.to_ascii_lowercase().as_slice() {
        b"am" | b"a" => Some(false),
        b"pm" | b"p" => Some(true),
        _ => None,
    }
}

/// How far a zone of this name lies ahead of UTC, in nanoseconds. Names of time scales (TAI, GPST) are those of the
/// clock that the file was written with: 0.
pub(super) fn zone(word: &[u8]) -> Option<i64> {
    const HALF_HOURS: [(&str, i64); 39] = [
        ("z", 0),
        ("utc", 0),
        ("gmt", 0),
        ("ut", 0),
        ("ut1", 0),
        ("utcg", 0),
        ("gps", 0),
        ("gpst", 0),
        ("tai", 0),
        ("tt", 0),
        ("tdb", 0),
        ("wet", 0),
        ("west", 2),
        ("bst", 2),
        ("cet", 2),
        ("mez", 2),
        ("cest", 4),
        ("mesz", 4),
        ("eet", 4),
        ("sast", 4),
        ("eest", 6),
        ("msk", 6),
        ("hkt", 16),
        ("awst", 16),
        ("jst", 18),
        ("kst", 18),
        ("acst", 19),
        ("aest", 20),
        ("aedt", 22),
        ("nzst", 24),
        ("nzdt", 26),
        ("est", -10),
        ("edt", -8),
        ("cst", -12),
        ("cdt", -10),
        ("mst", -14),
        ("mdt", -12),
        ("pst", -16),
        ("pdt", -14),
    ];
    const FAR: [(&str, i64); 3] = [("akst", -18), ("akdt", -16), ("hst", -20)];
    let word = std::str::from_utf8(word).ok()?.to_ascii_lowercase();
    let found = HALF_HOURS.iter().chain(&FAR).find(|(name, _)| word == *name);
    found.map(|(_, half_hours)| half_hours * 1_800 * SECOND)
}

/// The English name of a month (1 to 12), in full.
pub(super) fn month_name(month: i64) -> &'static str {
    const NAMES: [&str; 12] = [
        "January",
        "February",
        "March",
        "April",
        "May",
        "June",
        "July",
        "August",
        "September",
        "October",
        "November",
        "December",
    ];
    usize::try_from(month - 1).ok().and_then(|m| NAMES.get(m)).unwrap_or(&"")
}
