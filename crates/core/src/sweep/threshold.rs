//! The threshold that the counts along a parameter suggest.

use std::fmt;

use super::{Plateau, Point};

/// From a value to this many times it …
const FURTHER: f64 = 1.4;
/// … the count of normal noise falls to a small part of itself, and that of wild points that lie anywhere to
/// 1 / 1.4. A count that falls by less than the square root of that is not one of noise.
const KEPT: f64 = 0.845_154_254_728_516_6;

/// What the counts say about the value to take.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Threshold {
    /// The first value from the default upwards from which the count hardly falls.
    Suggested {
        /// The value, to three digits so that it stays readable in the panel and in the session.
        suggestion: f64,
        /// The values over which the count hardly falls.
        range: Plateau,
    },
    /// No value suggests itself.
    None {
        /// The reason.
        no_suggestion: NoSuggestion,
    },
}

/// Why no value is suggested.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NoSuggestion {
    /// Nothing is flagged at the default and above.
    NothingFlagged,
    /// More than a tenth of the samples is flagged wherever the count stands still.
    TooManyFlagged,
    /// The count falls all along: no gap lies between noise and wild points.
    NoGap,
}

impl Threshold {
    fn at(range: Plateau) -> Self {
        let suggestion = format!("{:.2e}", range.from).parse().unwrap_or(range.from);
        Self::Suggested { suggestion, range }
    }

    fn none(no_suggestion: NoSuggestion) -> Self {
        Self::None { no_suggestion }
    }
}

impl fmt::Display for NoSuggestion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NothingFlagged => "nothing is flagged at the default or above",
            Self::TooManyFlagged => "wherever the count is stable, more than a tenth of the samples is flagged",
            Self::NoGap => "no clear gap between noise and outliers",
        })
    }
}

/// The suggestion for counts by ascending value; `few` says which counts are few enough to be wild points.
pub(super) fn threshold(points: &[Point], few: impl Fn(usize) -> bool, from: Option<f64>) -> Threshold {
    let least = from.unwrap_or(0.0) * (1.0 - 1e-9);
    let first = points.iter().position(|p| p.value >= least && p.value > 0.0).unwrap_or(points.len());
    let above = &points[first..];
    if above.iter().all(|p| p.flagged == 0) {
        return Threshold::none(NoSuggestion::NothingFlagged);
    }
    let still: Vec<Plateau> = (0..above.len()).filter_map(|i| still(&above[i..])).collect();
    match still.iter().find(|p| few(p.most)) {
        Some(found) => Threshold::at(*found),
        None if still.is_empty() => Threshold::none(NoSuggestion::NoGap),
        None => Threshold::none(NoSuggestion::TooManyFlagged),
    }
}

/// The range from the first of `points` on over which the count keeps its share of the first, if it is long enough.
fn still(points: &[Point]) -> Option<Plateau> {
    let first = points.first().filter(|p| p.flagged > 0)?;
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    let keeps = |p: &&Point| p.flagged as f64 >= KEPT * first.flagged as f64;
    let kept: Vec<&Point> = points.iter().take_while(keeps).collect();
    let counts = || kept.iter().map(|p| p.flagged);
    let (to, least, most) = (kept.last()?.value, counts().min()?, counts().max()?);
    // A grid that was computed may end a rounding short of the factor.
    (to >= FURTHER * first.value * (1.0 - 1e-9)).then_some(Plateau { from: first.value, to, least, most })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(counts: &[(f64, usize)]) -> Vec<Point> {
        counts.iter().map(|&(value, flagged)| Point { value, flagged, missed: None, false_alarms: None }).collect()
    }

    fn found(counts: &[(f64, usize)]) -> Threshold {
        threshold(&points(counts), |n| n <= 100, Some(4.0))
    }

    fn value(counts: &[(f64, usize)]) -> Option<f64> {
        match found(counts) {
            Threshold::Suggested { suggestion, .. } => Some(suggestion),
            Threshold::None { .. } => None,
        }
    }

    #[test]
    fn the_first_value_from_the_default_upwards_with_a_gap_above_it_is_suggested() {
        let counts = [(2.0, 90), (2.8, 90), (4.0, 60), (5.6, 28), (8.0, 28), (11.2, 27), (16.0, 3), (22.4, 0)];
        let Threshold::Suggested { suggestion, range: p } = found(&counts) else { panic!("no suggestion") };
        assert_eq!((suggestion, p.to, p.least, p.most), (5.6, 11.2, 27, 28));
        assert_eq!(value(&[(4.0, 9), (5.6, 9), (8.0, 9)]), Some(4.0), "the default itself");
    }

    #[test]
    fn saturation_is_no_plateau() {
        let counts = [(4.0, 990), (5.6, 980), (8.0, 970), (11.2, 500), (16.0, 40), (22.4, 38), (32.0, 5)];
        assert_eq!(value(&counts), Some(16.0));
        assert_eq!(found(&counts[..3]), Threshold::none(NoSuggestion::TooManyFlagged));
    }

    #[test]
    fn without_a_gap_the_reason_is_given() {
        let falling = [(4.0, 90), (5.6, 60), (8.0, 40), (11.2, 20), (16.0, 8), (22.4, 2), (32.0, 0)];
        assert_eq!(found(&falling), Threshold::none(NoSuggestion::NoGap));
        assert_eq!(found(&[(1.0, 50), (4.0, 0), (8.0, 0)]), Threshold::none(NoSuggestion::NothingFlagged));
        assert_eq!(found(&[(4.0, 1), (5.6, 0)]), Threshold::none(NoSuggestion::NoGap), "one and none are no plateau");
    }
}
