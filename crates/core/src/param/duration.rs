//! Lengths of time as people write them: `30s`, `2min`, `1.5h`.

/// Names of units with their seconds, the longest first.
const UNITS: [(&str, f64); 5] = [("d", 86_400.0), ("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3)];

/// The seconds of a text like `30s` or `1.5 h`; none for another text and for what is not above 0.
pub(super) fn parse(text: &str) -> Option<f64> {
    let at = text.find(|c: char| c.is_ascii_alphabetic())?;
    let (number, unit) = (text[..at].trim_end(), &text[at..]);
    let seconds = UNITS.iter().find(|(name, _)| *name == unit)?.1;
    // `e` and `inf` never come this far: a number ends at its first letter.
    let value: f64 = number.parse().ok()?;
    Some(value * seconds).filter(|s| s.is_finite() && *s > 0.0)
}

/// The text of this many seconds, which reads back as the same.
pub(super) fn text(seconds: f64) -> String {
    let exact = |(name, unit): &(&str, f64)| {
        let count = seconds / unit;
        let text = format!("{count}{name}");
        (count >= 1.0 && count.fract() == 0.0 && count < 1e6 && parse(&text) == Some(seconds)).then_some(text)
    };
    UNITS.iter().find_map(exact).unwrap_or_else(|| format!("{seconds}s"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_read_and_written_back() {
        let cases = [
            ("30s", 30.0, "30s"),
            ("120 s", 120.0, "2min"),
            ("1.5h", 5400.0, "90min"),
            ("2d", 172_800.0, "2d"),
            ("50ms", 0.05, "50ms"),
            ("0.00025s", 0.00025, "0.00025s"),
            ("1e3s", f64::NAN, ""),
        ];
        for (written, seconds, again) in cases {
            match parse(written) {
                Some(read) => assert_eq!((read, text(read).as_str()), (seconds, again), "{written}"),
                None => assert!(seconds.is_nan(), "{written}"),
            }
        }
        for wrong in ["", "s", "-3s", "0s", "3 weeks", "inf s", "30", "3 s s"] {
            assert_eq!(parse(wrong), None, "{wrong}");
        }
    }
}
