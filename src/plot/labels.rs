//! Numbers along an axis: round ticks, and labels short enough for the margin that still differ.

/// Longest label of the y axis.
pub const LABEL_WIDTH: usize = 7;

/// Round values between `low` and `high`, with their labels, and what the labels leave out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ValueLabels {
    /// Values from low to high, with their text of at most [`LABEL_WIDTH`] characters.
    pub ticks: Vec<(f64, String)>,
    /// What turns a label into the value: `+6378137` (add this), `e-9` (times this power of ten), or both, the power
    /// first. Empty when the labels are the values.
    pub note: String,
}

impl ValueLabels {
    /// About `wanted` labels (2 to 3 at least) for a finite range.
    #[must_use]
    pub fn new(low: f64, high: f64, wanted: usize) -> Self {
        let largest = low.abs().max(high.abs());
        // Ranges near the ends of the doubles are labelled in halves or not at all; elsewhere this is exact.
        let span = high - low;
        if !(span > 0.0 && largest.is_finite()) {
            return Self::default();
        }
        if span.is_infinite() {
            return Self::scaled(low, high, 0.0, wanted);
        }
        let plain = Self::plain(low, high, 0.0, 1.0, wanted);
        if plain.fits() {
            return plain;
        }
        let offset = if span < largest * 1e-3 { round_offset(low, span) } else { 0.0 };
        let shifted = Self::plain(low, high, offset, 1.0, wanted);
        if offset != 0.0 && shifted.fits() { shifted } else { Self::scaled(low, high, offset, wanted) }
    }

    fn fits(&self) -> bool {
        let short = self.ticks.iter().all(|(_, text)| text.len() <= LABEL_WIDTH);
        short && self.ticks.len() > 1 && self.ticks.windows(2).all(|pair| pair[0].1 != pair[1].1)
    }

    /// Labels in powers of a thousand.
    fn scaled(low: f64, high: f64, offset: f64, wanted: usize) -> Self {
        let largest = (low - offset).abs().max((high - offset).abs());
        let exponent = ((largest.log10() / 3.0).floor() * 3.0).clamp(-300.0, 306.0) as i32;
        let mut labels = Self::plain(low, high, offset, 10.0_f64.powi(exponent), wanted);
        labels.note = match labels.note.as_str() {
            "" => format!("e{exponent}"),
            offset => format!("e{exponent} {offset}"),
        };
        labels.ticks.retain(|(_, text)| text.len() <= LABEL_WIDTH);
        labels
    }

    /// Labels `(value - offset) / unit`.
    fn plain(low: f64, high: f64, offset: f64, unit: f64, wanted: usize) -> Self {
        let (a, b) = ((low - offset) / unit, (high - offset) / unit);
        let mut step = round_step((b - a) / wanted.max(2) as f64, &DECIMAL);
        // A tick on an edge of the range stays, however its product rounds.
        let first = |step: f64| (a / step - 1e-9).ceil();
        if (b / step + 1e-9).floor() - first(step) < 1.0 {
            step = round_step(step / 2.5, &DECIMAL);
        }
        let decimals = (-step.log10().floor()).clamp(0.0, 12.0) as usize;
        let sign = if offset == 0.0 { "" } else { "+" };
        let last = b + step * 1e-9;
        let values = (0..50).map(|i| (first(step) + f64::from(i)) * step).take_while(|v| *v <= last);
        let ticks = values.map(|v| {
            let v = if v == 0.0 { 0.0 } else { v };
            ((v * unit + offset).clamp(low, high), format!("{sign}{v:.decimals$}"))
        });
        let note = if offset == 0.0 { String::new() } else { format!("{offset:+}") };
        Self { ticks: ticks.filter(|(v, _)| v.is_finite()).collect(), note }
    }
}

/// A round number at or below `low`, as coarse as keeps the differences to it short.
fn round_offset(low: f64, span: f64) -> f64 {
    let exponent = span.log10().ceil() as i32 + 1;
    let power = 10.0_f64.powi(exponent.abs());
    // A negative power of ten is no double: dividing by the positive one rounds only once.
    let offset = if exponent < 0 { (low * power).floor() / power } else { (low / power).floor() * power };
    if offset.is_finite() { offset } else { low }
}

/// Steps within a factor of ten that read well.
pub(crate) const DECIMAL: [f64; 3] = [1.0, 2.0, 5.0];

/// The smallest of `steps`, times a power of ten, that is at least `least`.
pub(crate) fn round_step(least: f64, steps: &[f64]) -> f64 {
    if !(least.is_finite() && least > 0.0) {
        return 1.0;
    }
    let power = 10.0_f64.powf(least.log10().floor());
    let candidates = steps.iter().map(|s| s * power).chain([10.0 * power]);
    candidates.into_iter().find(|step| *step >= least * (1.0 - 1e-9)).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn texts(low: f64, high: f64) -> (Vec<String>, String) {
        let labels = ValueLabels::new(low, high, 3);
        (labels.ticks.into_iter().map(|tick| tick.1).collect(), labels.note)
    }

    #[test]
    fn ordinary_ranges_have_plain_round_labels() {
        assert_eq!(texts(-18.0, 12.0), (["-10", "0", "10"].map(String::from).to_vec(), String::new()));
        assert_eq!(texts(0.0, 0.3), (["0.0", "0.1", "0.2", "0.3"].map(String::from).to_vec(), String::new()));
        assert_eq!(texts(100_000.0, 400_000.0).0, ["100000", "200000", "300000", "400000"]);
    }

    #[test]
    fn a_constant_offset_and_a_power_of_ten_are_factored_out() {
        assert_eq!(
            texts(6_378_137.0, 6_378_137.002_9),
            (["+0.000", "+0.001", "+0.002"].map(String::from).to_vec(), "+6378137".to_owned())
        );
        assert_eq!(texts(0.0, 3e-9), (["0", "1", "2", "3"].map(String::from).to_vec(), "e-9".to_owned()));
        assert_eq!(texts(0.0, 3.2e12).1, "e12");
    }

    proptest! {
        #[test]
        fn labels_are_short_and_differ_and_lie_in_the_range(
            middle in prop_oneof![Just(0.0), -1e3..1e3, Just(6.4e6), Just(1.7e9), -1e12..1e12], exponent in -9..12,
            share in 1.0..9.9_f64,
        ) {
            let half = share * 10.0_f64.powi(exponent);
            prop_assume!(half > f64::abs(middle) * 1e-9);
            let (low, high) = (middle - half, middle + half);
            let labels = ValueLabels::new(low, high, 4);
            prop_assert!(labels.ticks.len() >= 2, "{} to {}: {:?}", low, high, labels);
            for pair in labels.ticks.windows(2) {
                prop_assert!(pair[0].1 != pair[1].1, "{:?}", labels);
            }
            for (value, text) in &labels.ticks {
                prop_assert!(text.len() <= LABEL_WIDTH, "{:?}", labels);
                prop_assert!(*value >= low - half * 1e-6 && *value <= high + half * 1e-6, "{:?}", labels);
            }
        }

        #[test]
        fn any_range_is_safe(low in any::<f64>(), high in any::<f64>(), wanted in 0_usize..9) {
            for (_, text) in ValueLabels::new(low, high, wanted).ticks {
                prop_assert!(text.len() <= LABEL_WIDTH);
            }
        }
    }
}
