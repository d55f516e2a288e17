//! The y axis: which range is shown, and on which row of dots a value falls.

use super::columns::Trace;
use super::pyramid::Span;
use super::view::View;

/// Rows of dots in a cell.
pub(crate) const DOTS_PER_ROW: usize = 4;

/// Share of the range left free above and below a fitted curve.
const MARGIN: f64 = 0.04;

/// At most this many samples are sorted for the robust range, taken at equal distances.
const ROBUST_SAMPLES: usize = 1 << 14;

/// How the y range follows the data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum YFit {
    /// Kept samples in view: wild points do not squash the curve, they are marked at the edge.
    Kept,
    /// Kept and flagged samples in view.
    All,
    /// From the 0.1 % to the 99.9 % quantile of the samples in view, flagged or not (of about 16 000 of them when
    /// there are more).
    Robust,
    /// This range.
    Fixed(f64, f64),
}

impl YFit {
    /// Lowest and highest value to show: finite, the first below the second, whatever the data are.
    #[must_use]
    pub fn range(self, trace: &Trace<'_>, view: View) -> (f64, f64) {
        let positions = view.positions(trace.axis);
        let kept = || trace.kept.pyramid.span_over(trace.kept.span, positions.clone());
        let all = || kept().union(trace.flags.span_over(&positions));
        let fitted = match self {
            Self::Fixed(low, high) => return widened(low, high),
            Self::All => all(),
            Self::Robust => robust(trace, view),
            Self::Kept => kept(),
        };
        let fitted = if fitted.is_empty() { all() } else { fitted };
        let (low, high) = widened(fitted.low, fitted.high);
        let margin = (high * 0.5 - low * 0.5) * (2.0 * MARGIN);
        widened(low - margin, high + margin)
    }
}

fn robust(trace: &Trace<'_>, view: View) -> Span {
    let positions = view.positions(trace.axis);
    let stride = positions.len().div_ceil(ROBUST_SAMPLES).max(1);
    let mut values: Vec<f64> = positions.clone().step_by(stride).map(|i| (trace.kept.span)(i).low).collect();
    // Hidden samples come from the flags, thinned alike.
    values.retain(|v| v.is_finite());
    values.extend(trace.flags.values_in(&positions).step_by(stride).filter(|v| v.is_finite()));
    if values.is_empty() {
        return Span::EMPTY;
    }
    let last = (values.len() - 1) as f64;
    let (low, high) = ((last * 0.001).round() as usize, (last * 0.999).round() as usize);
    let (_, &mut low, _) = values.select_nth_unstable_by(low, f64::total_cmp);
    let (_, &mut high, _) = values.select_nth_unstable_by(high, f64::total_cmp);
    Span { low, high }
}

/// A finite range with its ends in order and far enough apart to be drawn: around a single value by 5 % of it, or
/// by 1 around zero; from -1 to 1 where an end is NaN.
#[must_use]
pub fn widened(low: f64, high: f64) -> (f64, f64) {
    if low.is_nan() || high.is_nan() {
        return (-1.0, 1.0);
    }
    let (low, high) = if low <= high { (low, high) } else { (high, low) };
    let (low, high) = (low.clamp(-f64::MAX, f64::MAX), high.clamp(-f64::MAX, f64::MAX));
    let (middle, half) = (low * 0.5 + high * 0.5, high * 0.5 - low * 0.5);
    if half >= (middle.abs() * 1e-12).max(1e-290) {
        return (low, high);
    }
    let pad = if middle == 0.0 { 1.0 } else { (middle.abs() * 0.05).max(1e-280) };
    ((middle - pad).max(-f64::MAX), (middle + pad).min(f64::MAX))
}

/// Maps values to rows of dots, from 0 at the top.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YScale {
    low: f64,
    high: f64,
    half_high: f64,
    rows_per_half: f64,
    rows: i32,
}

impl YScale {
    /// The scale that shows `low` to `high` on `rows` rows of cells.
    #[must_use]
    pub fn new(low: f64, high: f64, rows: u16) -> Self {
        let (low, high) = widened(low, high);
        let rows = i32::from(rows) * DOTS_PER_ROW as i32;
        // Half values, so that the range of the largest doubles does not overflow.
        let (half_low, half_high) = (low * 0.5, high * 0.5);
        Self { low, high, half_high, rows_per_half: f64::from(rows) / (half_high - half_low), rows }
    }

    /// The lowest value shown.
    #[must_use]
    pub fn low(&self) -> f64 {
        self.low
    }

    /// The highest value shown.
    #[must_use]
    pub fn high(&self) -> f64 {
        self.high
    }

    /// Rows of dots.
    pub(crate) fn rows(&self) -> i32 {
        self.rows
    }

    /// The row of cells of a value; none when it is out of range or NaN.
    #[must_use]
    pub fn row(&self, y: f64) -> Option<u16> {
        self.shows(y).then(|| u16::try_from(self.dot_row(y) / DOTS_PER_ROW as i32).unwrap_or(u16::MAX))
    }

    /// True when the value is in range.
    #[inline]
    pub(crate) fn shows(&self, y: f64) -> bool {
        self.low <= y && y <= self.high && self.rows > 0
    }

    /// Height in rows of dots below the top, as a real number.
    #[inline]
    pub(crate) fn depth(&self, y: f64) -> f64 {
        (self.half_high - y * 0.5) * self.rows_per_half
    }

    /// The row of dots of a value; -1 above the range, the number of rows below it.
    #[inline]
    pub(crate) fn dot_row(&self, y: f64) -> i32 {
        if y > self.high {
            return -1;
        }
        if y < self.low {
            return self.rows;
        }
        // In range: rounding at the lower edge must not push the lowest value out.
        (self.depth(y) as i32).clamp(0, (self.rows - 1).max(0))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn any_value() -> impl Strategy<Value = f64> {
        prop_oneof![
            any::<f64>(),
            -10.0..10.0,
            Just(1e308),
            Just(-1e308),
            Just(f64::INFINITY),
            Just(f64::NAN),
            Just(6.378e6),
            Just(0.0),
            Just(5e-324)
        ]
    }

    proptest! {
        #[test]
        fn any_range_is_made_finite_and_wide(low in any_value(), high in any_value()) {
            let (a, b) = widened(low, high);
            prop_assert!(a.is_finite() && b.is_finite() && a < b);
            let scale = YScale::new(low, high, 10);
            prop_assert_eq!((scale.dot_row(b), scale.dot_row(a)), (0, 39));
        }

        #[test]
        fn rows_fall_as_values_rise(a in any_value(), b in any_value(), low in any_value(), high in any_value()) {
            let scale = YScale::new(low, high, 7);
            if a <= b {
                prop_assert!(scale.dot_row(a) >= scale.dot_row(b));
            }
            prop_assert_eq!(scale.row(a).is_some(), scale.low() <= a && a <= scale.high());
        }
    }

    #[test]
    fn values_fall_on_the_rows_of_a_hand_drawn_scale() {
        // 0 to 8 on two rows of cells: eight rows of dots, one per unit, from the top.
        let scale = YScale::new(0.0, 8.0, 2);
        assert_eq!([8.0, 7.5, 6.9, 4.0, 0.5, 0.0].map(|y| scale.dot_row(y)), [0, 0, 1, 4, 7, 7]);
        assert_eq!((scale.row(4.1), scale.row(3.9), scale.row(8.1), scale.dot_row(-0.1)), (Some(0), Some(1), None, 8));
    }

    #[test]
    fn a_single_value_is_shown_in_the_middle_of_a_range() {
        assert_eq!(widened(0.0, 0.0), (-1.0, 1.0));
        assert_eq!(widened(20.0, 20.0), (19.0, 21.0));
        assert_eq!(widened(3.0, -1.0), (-1.0, 3.0));
        assert_eq!(widened(6.4e6, 6.4e6 + 0.01), (6.4e6, 6.4e6 + 0.01));
    }
}
