//! The steps of time from sample to sample: where samples are lost, where the record is cut, and where rows have no
//! usable time.

use super::columns::Columns;
use super::pyramid::{Pyramid, Span};
use crate::track::{Series, lost_samples};

/// The steps of a channel. Made once for a channel, read in every frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Steps {
    pyramid: Pyramid,
    /// Positions of the samples before which rows without a usable time stand (after which, for the last).
    faults: Vec<u32>,
    /// Rows without a usable time.
    pub unusable: usize,
    /// Samples that are lost in all.
    pub lost: usize,
    /// Stretches in which they are lost.
    pub gaps: usize,
}

/// What the steps of one column of a picture are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepColumn {
    /// Shortest and longest step to a sample in the column, in seconds; in a column without samples, the step over
    /// it. Empty where there is none.
    pub span: Span,
    /// True when samples are lost in one of the steps.
    pub lost: bool,
    /// True when there are enough of them that the record is cut there.
    pub cut: bool,
    /// True when rows without a usable time stand in the column.
    pub fault: bool,
}

/// The step to the sample at `i`.
fn step(t: &[f64], i: usize) -> Span {
    match (i.checked_sub(1).and_then(|before| t.get(before)), t.get(i)) {
        (Some(before), Some(now)) => Span::at(now - before),
        _ => Span::EMPTY,
    }
}

impl Steps {
    /// The steps of a channel whose record has a row for each of `seconds` ([`TimeAxis::seconds`](crate::track::TimeAxis)).
    #[must_use]
    pub fn of(series: &Series<'_>, seconds: &[f64]) -> Self {
        let n = series.len();
        let pyramid = Pyramid::build_spans(n, |i| step(&series.t, i));
        let (mut lost, mut gaps, mut unusable) = (0_usize, 0, 0);
        let mut faults: Vec<u32> = Vec::new();
        let mut row = 0;
        for i in 0..n {
            let here = series.lost_before(i);
            lost = lost.saturating_add(here);
            gaps += usize::from(here > 0);
            // The rows between this sample and the one before it; after the last, the rest.
            let own = series.row(i);
            let end = if i + 1 == n { seconds.len() } else { own };
            let between = seconds.get(row..end).unwrap_or_default();
            let bad = between.iter().filter(|t| t.is_nan()).count();
            if bad > 0 {
                unusable += bad;
                faults.push(u32::try_from(i).unwrap_or(u32::MAX));
            }
            row = own + 1;
        }
        Self { pyramid, faults, unusable, lost, gaps }
    }

    /// The steps in each column of `columns` of the same channel; cut where more than `max_gap` samples are lost in a
    /// row (none: never).
    #[must_use]
    pub fn columns(&self, columns: &Columns, series: &Series<'_>, max_gap: Option<usize>) -> Vec<StepColumn> {
        let of = |column: u16| {
            let here = columns.positions(column);
            let span = if here.is_empty() {
                step(&series.t, here.start)
            } else {
                self.pyramid.span_over(|i| step(&series.t, i), here.clone())
            };
            let lost = if span.is_empty() { 0 } else { lost_samples(span.high, series.interval) };
            let first = self.faults.partition_point(|&p| (p as usize) < here.start);
            let fault = self.faults.get(first).is_some_and(|&p| here.contains(&(p as usize)));
            StepColumn { span, lost: lost > 0, cut: max_gap.is_some_and(|most| lost > most), fault }
        };
        (0..columns.grid().width).map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Curve, Flags, Grid, Trace, View};
    use super::*;

    /// The steps of times over a view on `width` columns.
    fn columns(seconds: &[f64], view: View, width: u16, max_gap: Option<usize>) -> (Steps, Vec<StepColumn>) {
        let y = vec![0.0; seconds.len()];
        let series = Series::new(seconds, &y);
        let steps = Steps::of(&series, seconds);
        let pyramid = Pyramid::build(&series.y, |_| false);
        let span = |i: usize| series.y.get(i).copied().map_or(Span::EMPTY, Span::at);
        let kept = Curve { pyramid: &pyramid, span: &span };
        let axis = Axis::Time(&series.t);
        let (flags, gap) = (&Flags::default(), f64::INFINITY);
        let trace = Trace { axis, kept, flags, expected: None, band: None, repaired: None, filtered: None, gap };
        let columns = Columns::new(&trace, Grid { view, y: (0.0, 1.0), width, height: 1 });
        let found = steps.columns(&columns, &series, max_gap);
        (steps, found)
    }

    #[test]
    fn lost_samples_cuts_and_rows_without_a_time_are_in_their_columns() {
        // One sample is lost before 4, three before 9; the rows after 1 and after 9 have no usable time.
        let seconds = [0.0, 1.0, f64::NAN, 2.0, 4.0, 5.0, 9.0, f64::NAN];
        let (steps, found) = columns(&seconds, View { from: 0.0, to: 10.0 }, 10, Some(2));
        assert_eq!((steps.lost, steps.gaps, steps.unusable), (4, 2, 2));
        let with = |is: fn(&StepColumn) -> bool| (0..10).filter(|&c| is(&found[c])).collect::<Vec<_>>();
        // Columns without samples show the step over them.
        assert_eq!(with(|c| c.lost), [3, 4, 6, 7, 8, 9]);
        assert_eq!(with(|c| c.cut), [6, 7, 8, 9]);
        assert_eq!(with(|c| c.fault), [2, 9]);
        assert_eq!((found[1].span, found[4].span, found[0].span.is_empty()), (Span::at(1.0), Span::at(2.0), true));
        let (_, never) = columns(&seconds, View { from: 0.0, to: 10.0 }, 1, None);
        assert_eq!(never, [StepColumn { span: Span { low: 1.0, high: 4.0 }, lost: true, cut: false, fault: true }]);
    }

    #[test]
    fn nothing_at_all_is_safe() {
        for seconds in [&[][..], &[f64::NAN], &[5.0]] {
            let (_, found) = columns(seconds, View { from: 0.0, to: 1.0 }, 3, Some(1));
            assert!(found.iter().all(|c| !c.lost && !c.cut && c.span.is_empty()), "{found:?}");
        }
    }
}
