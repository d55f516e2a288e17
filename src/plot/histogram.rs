//! How often which residual occurs, counted once so that a frame costs no more than its columns.

use std::ops::Range;

use rayon::prelude::*;

use crate::math::pieces::PIECE;
use crate::stop::{Stop, Stopped};

/// Bins between the edges: enough that columns made of them differ by a percent or two in width.
const BINS: usize = 8192;

/// Samples that one thread counts at a time.
const CHUNK: usize = 1 << 18;

/// How many samples, and how many of them are outliers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tally {
    /// Samples.
    pub all: u32,
    /// Outliers that hold among them.
    pub flagged: u32,
}

/// The residuals of a channel between two edges that lie as far below zero as above, in bins of one width. Every
/// sample is counted once: in a bin, below, above, or among those without a residual.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Histogram {
    top: f64,
    /// How many lie before each bin, and in all bins.
    before: Vec<Tally>,
    /// Those below the lower edge.
    pub below: Tally,
    /// Those above the upper edge.
    pub above: Tally,
    /// Those without a residual.
    pub without: Tally,
}

impl Tally {
    fn add(&mut self, flagged: bool) {
        self.all += 1;
        self.flagged += u32::from(flagged);
    }

    fn plus(self, other: Self) -> Self {
        Self { all: self.all + other.all, flagged: self.flagged + other.flagged }
    }

    fn minus(self, other: Self) -> Self {
        Self { all: self.all - other.all, flagged: self.flagged - other.flagged }
    }
}

/// Counts of a part of the samples.
struct Part {
    bins: Vec<Tally>,
    /// Below, above, without.
    others: [Tally; 3],
}

impl Part {
    fn new() -> Self {
        Self { bins: vec![Tally::default(); BINS], others: [Tally::default(); 3] }
    }

    fn count(&mut self, top: f64, range: Range<usize>, residual: &impl Fn(usize) -> Option<f64>, flagged: &[bool]) {
        for i in range {
            self.place(top, residual(i)).add(flagged[i]);
        }
    }

    /// Where a residual is counted.
    #[inline]
    fn place(&mut self, top: f64, residual: Option<f64>) -> &mut Tally {
        match residual {
            Some(r) if r < -top => &mut self.others[0],
            Some(r) if r > top => &mut self.others[1],
            Some(r) if !r.is_nan() => &mut self.bins[bin(top, r)],
            _ => &mut self.others[2],
        }
    }

    fn with(mut self, other: &Self) -> Self {
        self.bins.iter_mut().zip(&other.bins).for_each(|(a, b)| *a = a.plus(*b));
        self.others.iter_mut().zip(&other.others).for_each(|(a, b)| *a = a.plus(*b));
        self
    }
}

/// The bin of a residual between the edges.
fn bin(top: f64, residual: f64) -> usize {
    // A cast from float saturates; the upper edge belongs to the last bin.
    let share = (residual + top) / (2.0 * top);
    ((share * BINS as f64) as usize).min(BINS - 1)
}

impl Histogram {
    /// Counts the residuals between `-top` and `top` (positive) of as many samples as `flagged` has entries.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for it any more.
    pub fn new(
        top: f64,
        residual: impl Fn(usize) -> Option<f64> + Sync,
        flagged: &[bool],
        stop: &Stop,
    ) -> Result<Self, Stopped> {
        let starts = (0..flagged.len()).into_par_iter().step_by(CHUNK);
        let part = |start: usize| {
            let mut part = Part::new();
            let end = (start + CHUNK).min(flagged.len());
            for begin in (start..end).step_by(PIECE) {
                stop.check()?;
                part.count(top, begin..end.min(begin + PIECE), &residual, flagged);
            }
            Ok(part)
        };
        let all = starts.map(part).try_reduce(Part::new, |a, b| Ok(a.with(&b)))?;
        Ok(Self::summed(top, &all))
    }

    /// The same residuals, of which some have become those of outliers, or (false) are no longer. Each is given with
    /// its residual.
    #[must_use]
    pub fn turned(&self, samples: impl Iterator<Item = (Option<f64>, bool)>) -> Self {
        let bins = self.before.windows(2).map(|pair| pair[1].minus(pair[0])).collect();
        let mut part = Part { bins, others: [self.below, self.above, self.without] };
        for (residual, flagged) in samples {
            let place = part.place(self.top, residual);
            place.flagged = if flagged { place.flagged + 1 } else { place.flagged.saturating_sub(1) };
        }
        Self::summed(self.top, &part)
    }

    fn summed(top: f64, all: &Part) -> Self {
        let mut before = Vec::with_capacity(BINS + 1);
        before.push(Tally::default());
        let sums = all.bins.iter().scan(Tally::default(), |sum, tally| {
            *sum = sum.plus(*tally);
            Some(*sum)
        });
        before.extend(sums);
        let [below, above, without] = all.others;
        Self { top, before, below, above, without }
    }

    /// The upper edge.
    #[must_use]
    pub fn top(&self) -> f64 {
        self.top
    }

    /// The counts of each of `width` columns from edge to edge.
    #[must_use]
    pub fn columns(&self, width: u16) -> Vec<Tally> {
        let edge = |column: usize| (column * BINS).div_ceil(usize::from(width).max(1));
        let before = |bin: usize| self.before.get(bin).copied().unwrap_or_default();
        (0..usize::from(width)).map(|c| before(edge(c + 1)).minus(before(edge(c)))).collect()
    }

    /// The column of a residual among `width` columns; none beyond the edges.
    #[must_use]
    pub fn column_of(&self, residual: f64, width: u16) -> Option<u16> {
        let inside = residual.abs() <= self.top && width > 0;
        inside.then(|| u16::try_from(bin(self.top, residual) * usize::from(width) / BINS).unwrap_or(u16::MAX))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn residual() -> impl Strategy<Value = Option<f64>> {
        let edge = [0.0, 10.0, -10.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1e308, 5e-324];
        prop_oneof![
            6 => (-11.0..11.0_f64).prop_map(Some),
            2 => prop::sample::select(edge.to_vec()).prop_map(Some),
            1 => Just(None),
        ]
    }

    proptest! {
        #[test]
        fn every_sample_is_counted_once_and_in_the_column_that_is_said(
            samples in prop::collection::vec((residual(), prop::bool::weighted(0.2)), 0..400), width in 1_u16..400,
        ) {
            let flagged: Vec<bool> = samples.iter().map(|s| s.1).collect();
            let histogram = Histogram::new(10.0, |i| samples[i].0, &flagged, &Stop::never()).unwrap();
            let columns = histogram.columns(width);
            let mut expected = vec![Tally::default(); usize::from(width)];
            let (mut beyond, mut without) = (Tally::default(), Tally::default());
            for (residual, flagged) in &samples {
                match residual.filter(|r| !r.is_nan()) {
                    None => without.add(*flagged),
                    Some(r) => match histogram.column_of(r, width) {
                        None => {
                            prop_assert!(r.abs() > 10.0);
                            beyond.add(*flagged);
                        }
                        Some(column) => {
                            // By plain arithmetic: a column starts with a bin, at most one bin after its place.
                            let plain = (r + 10.0) / 20.0 * f64::from(width);
                            let bin = f64::from(width) / BINS as f64;
                            let inside = plain - f64::from(column);
                            prop_assert!((-1e-9..=1.0 + bin + 1e-9).contains(&inside), "{} in column {}", r, column);
                            expected[usize::from(column)].add(*flagged);
                        }
                    },
                }
            }
            prop_assert_eq!(columns, expected);
            prop_assert_eq!((histogram.below.plus(histogram.above), histogram.without), (beyond, without));
        }
    }

    #[test]
    fn parts_of_a_long_record_add_up() {
        let n = 2 * CHUNK + 5;
        let flagged = vec![true; n];
        let histogram =
            Histogram::new(1.0, |i| Some(if i.is_multiple_of(2) { 0.5 } else { -2.0 }), &flagged, &Stop::never())
                .unwrap();
        let half = (n as u32).div_ceil(2);
        assert_eq!(histogram.columns(2), [Tally::default(), Tally { all: half, flagged: half }]);
        assert_eq!((histogram.below.all, histogram.above.all), (n as u32 - half, 0));
        assert_eq!(Histogram::default().columns(3), [Tally::default(); 3]);
    }
}
