//! Zones that the name of a column tells: `Date Time, GMT+02:00`, `Zeit (UTC+1)`, `time PST`.

use super::super::calendar::SECOND;
use super::words;

/// The zone in the name (or the unit) of a column of times, as [`super::Zone::find`] takes it; none where there is none, or
/// where it is UTC.
pub(crate) fn zone_in(name: &str) -> Option<String> {
    if let Some(offset) = counted(name) {
        return written(offset);
    }
    let is_part = |c: char| !(c.is_alphanumeric() || matches!(c, '/' | '_'));
    let parts: Vec<&str> = name.split(is_part).filter(|w| !w.is_empty()).collect();
    // `Time (Europe/Berlin)`.
    let place = parts.iter().find(|p| p.contains('/') && super::Zone::find(p).is_ok());
    if let Some(place) = place {
        return Some((*place).to_owned());
    }
    let word = parts.last().filter(|w| w.len() >= 3 && w.chars().all(|c| c.is_ascii_uppercase()))?;
    written(words::zone(word.as_bytes())?)
}

/// The offset after `UTC` or `GMT`, in nanoseconds.
fn counted(name: &str) -> Option<i64> {
    let upper = name.to_ascii_uppercase();
    let rest = ["UTC", "GMT"].iter().find_map(|zone| Some(upper.split_once(zone)?.1))?.trim_start();
    let sign = match rest.chars().next()? {
        '+' => 1,
        '-' | '\u{2212}' => -1,
        _ => return None,
    };
    let rest = rest.trim_start_matches(['+', '-', '\u{2212}']).trim_start();
    let digits = |text: &str| text.chars().take_while(char::is_ascii_digit).collect::<String>();
    let first = digits(rest);
    let after = rest[first.len()..].strip_prefix(':').map(digits).filter(|m| m.len() == 2);
    let (hours, minutes): (i64, i64) = match (first.len(), after) {
        (1 | 2, minutes) => (first.parse().ok()?, minutes.map_or(Some(0), |m| m.parse().ok())?),
        (4, None) => (first[..2].parse().ok()?, first[2..].parse().ok()?),
        _ => return None,
    };
    (hours <= 14 && minutes < 60).then_some(sign * (hours * 60 + minutes) * 60 * SECOND)
}

fn written(offset: i64) -> Option<String> {
    let minutes = offset / (60 * SECOND);
    let sign = if minutes < 0 { '-' } else { '+' };
    (minutes != 0).then(|| format!("{sign}{:02}:{:02}", minutes.abs() / 60, minutes.abs() % 60))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_zones() {
        for (name, zone) in [
            ("Date Time, GMT+02:00", Some("+02:00")),
            ("Date Time, GMT-07:00", Some("-07:00")),
            ("Zeit (UTC+1)", Some("+01:00")),
            ("Timestamp (UTC-0330)", Some("-03:30")),
            ("time [UTC + 5:30]", Some("+05:30")),
            ("Zeit [MEZ]", Some("+01:00")),
            ("time PST", Some("-08:00")),
            ("Local time (America/New_York)", Some("America/New_York")),
            ("Time [UTC]", None),
            ("Date/Time (GMT)", None),
            ("Date/Time", None),
            ("TIME_TEST", None),
            ("West time", None),
            ("utc-corrected", None),
            ("UTC+99", None),
        ] {
            assert_eq!(zone_in(name).as_deref(), zone, "{name}");
        }
    }
}
