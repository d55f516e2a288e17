//! Windows that test each of their samples against a polynomial fitted to all of them.

use std::ops::Range;

use super::{Verdict, geometry, sweep};
use crate::math::pieces;
use crate::math::window_fit::WindowFit;
use crate::method::{Judged, Segment, reaches};
use crate::stop::{Stop, Stopped};

/// The settings of the sliding polynomial.
#[derive(Debug, Clone, Copy)]
pub(in crate::method) struct PolyRule {
    pub(in crate::method) width: usize,
    pub(in crate::method) order: usize,
    pub(in crate::method) feedback: bool,
    pub(in crate::method) guard: bool,
    pub(in crate::method) k: f64,
}

/// What a window on the data as given says: the residual of its first sample, which no later window tests, and the
/// tolerance, which is negative when it flags any of its samples. Zeros, which need no touching before they are written.
type Quick = [f64; 2];

/// Judges a segment by windows that begin at one sample after the other.
pub(in crate::method) fn judge(rule: &PolyRule, segment: &Segment<'_>, stop: &Stop) -> Result<Judged, Stopped> {
    let n = segment.len();
    if n < rule.order + 2 {
        return Ok(Judged::unchecked(n));
    }
    let level = geometry::level(segment.y);
    let check = || stop.check();
    let mut fits = Fits::new(rule, segment, stop)?;
    let mut run = Run {
        x: pieces::collect(n, &check, |i| segment.y[i] - level)?,
        replaced: pieces::collect(n, &check, |_| f64::NAN)?,
        judged: Judged::unchecked_many(n, stop)?,
    };
    // Most windows hold no wild point: they are worked out on the data as given, in parallel, and only those that
    // flag something or hold a replaced sample once more in their turn.
    let mut quick = vec![[0.0; 2]; n + 1 - fits.width];
    sweep(&mut quick, stop, || fits.clone(), |fits, start| fits.quick(&run.x, start))?;
    // No window that begins after this holds a replaced sample.
    let mut touched: Option<usize> = None;
    for (start, &[first, tolerance]) in quick.iter().enumerate() {
        if start.is_multiple_of(Stop::STRIDE / 16) {
            stop.check()?;
        }
        let clean = touched.is_none_or(|last| last < start);
        if clean && tolerance.is_sign_positive() && start + fits.width < n {
            run.keep(start, first, tolerance);
            continue;
        }
        let window = start..start + fits.width;
        let count = if clean { 0 } else { run.replaced[window.clone()].iter().filter(|v| !v.is_nan()).count() };
        if rule.guard && 3 * count > fits.width {
            continue;
        }
        let tolerance = fits.fit(&run.x, start).1;
        for i in window {
            let residual = fits.fit.residual()[i - start];
            if run.test(i, residual, tolerance, rule.feedback) {
                touched = Some(touched.map_or(i, |last| last.max(i)));
            }
        }
    }
    run.end(level, stop)
}

/// The polynomials of the windows.
#[derive(Debug, Clone)]
struct Fits<'a> {
    segment: Segment<'a>,
    zero: f64,
    k: f64,
    width: usize,
    fit: WindowFit,
    /// True while `fit` is set for even steps.
    even: bool,
    blank: WindowFit,
    /// How many steps before each sample differ from the nominal interval: none within a window, and its times are
    /// even.
    uneven: std::sync::Arc<Vec<u32>>,
}

impl<'a> Fits<'a> {
    fn new(rule: &PolyRule, segment: &Segment<'a>, stop: &Stop) -> Result<Self, Stopped> {
        let width = rule.width.min(segment.len());
        let mut count = 0;
        let mut uneven = Vec::with_capacity(segment.len());
        uneven.push(0);
        for (i, t) in segment.t.windows(2).enumerate() {
            stop.check_at(i)?;
            // Times are as exact as their digits: a step of a billionth more is none.
            let slack = 1e-9 * segment.interval + 4.0 * f64::EPSILON * t[1].abs().max(t[0].abs());
            count += u32::from((t[1] - t[0] - segment.interval).abs() > slack);
            uneven.push(count);
        }
        let blank = WindowFit::even(width, rule.order);
        Ok(Self {
            segment: *segment,
            zero: segment.zero(stop)?,
            k: rule.k,
            width,
            fit: blank.clone(),
            even: true,
            blank,
            uneven: std::sync::Arc::new(uneven),
        })
    }

    /// Fits the window that begins at `start`: the largest residual, and the tolerance.
    fn fit(&mut self, x: &[f64], start: usize) -> (f64, f64) {
        let window = start..start + self.width;
        let even = self.uneven[window.end - 1] == self.uneven[start];
        if !even {
            self.fit.set_times(&self.segment.t[window.clone()]);
        } else if !self.even {
            self.fit.clone_from(&self.blank);
        }
        self.even = even;
        let (squares, largest) = self.fit.fit(&x[window]);
        #[expect(clippy::cast_precision_loss, reason = "windows are short")]
        let scale = (squares / (self.width as f64 - 1.0)).sqrt();
        (largest, self.k * self.segment.bounded(scale, self.zero))
    }

    fn quick(&mut self, x: &[f64], start: usize) -> Quick {
        let (largest, tolerance) = self.fit(x, start);
        let first = self.fit.residual().first().copied().unwrap_or(f64::NAN);
        [first, tolerance.copysign(if reaches(largest, tolerance) { -1.0 } else { 1.0 })]
    }
}

/// The samples as they are being judged.
struct Run {
    /// Values less the level, flagged ones replaced.
    x: Vec<f64>,
    /// What a sample was replaced by last; NaN where it was not.
    replaced: Vec<f64>,
    judged: Judged,
}

impl Run {
    /// Takes down what a window says of a sample that it does not flag.
    #[inline]
    fn keep(&mut self, i: usize, residual: f64, tolerance: f64) {
        self.judged.expected[i] = self.x[i] - residual;
        self.judged.tolerance[i] = tolerance;
        if self.judged.verdict[i] == Verdict::Unchecked {
            self.judged.verdict[i] = Verdict::Normal;
        }
    }

    /// Tests a sample; true when it was replaced.
    fn test(&mut self, i: usize, residual: f64, tolerance: f64, feedback: bool) -> bool {
        self.keep(i, residual, tolerance);
        if !reaches(residual.abs(), tolerance) {
            return false;
        }
        self.judged.verdict[i] = Verdict::Outlier;
        if feedback {
            self.x[i] = self.judged.expected[i];
            self.replaced[i] = self.x[i];
        }
        feedback
    }

    fn end(mut self, level: f64, stop: &Stop) -> Result<Judged, Stopped> {
        let check = || stop.check();
        let add_level = |_: usize, values: &mut [f64]| values.iter_mut().for_each(|v| *v += level);
        pieces::over(&mut self.judged.expected, &check, add_level)?;
        let any = |piece: Range<usize>| self.replaced[piece].iter().any(|v| !v.is_nan());
        if pieces::map(self.replaced.len(), &check, any)?.contains(&true) {
            pieces::over(&mut self.replaced, &check, add_level)?;
            self.judged.own = self.replaced;
        }
        Ok(self.judged)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::math::polyfit::Polynomial;

    /// The page's words, window by window.
    fn plain(t: &[f64], y: &[f64], rule: &PolyRule) -> (Vec<Verdict>, Vec<f64>, Vec<f64>) {
        let n = rule.width.min(y.len());
        let (mut x, mut own) = (y.to_vec(), vec![f64::NAN; y.len()]);
        let (mut verdict, mut expected) = (vec![Verdict::Unchecked; y.len()], vec![f64::NAN; y.len()]);
        for s in 0..=y.len() - n {
            if rule.guard && own[s..s + n].iter().filter(|v| !v.is_nan()).count() > n / 3 {
                continue;
            }
            let fit = Polynomial::fit(&t[s..s + n], &x[s..s + n], rule.order);
            let rest: Vec<f64> = (s..s + n).map(|i| x[i] - fit.at(t[i])).collect();
            let rms = (rest.iter().map(|r| r * r).sum::<f64>() / (n as f64 - 1.0)).sqrt();
            let rms = if rms > super::super::super::zero_scale(y) { rms } else { 0.0 };
            for i in s..s + n {
                expected[i] = fit.at(t[i]);
                let flagged = reaches(rest[i - s].abs(), rule.k * rms);
                if flagged {
                    verdict[i] = Verdict::Outlier;
                    if rule.feedback {
                        x[i] = expected[i];
                        own[i] = x[i];
                    }
                } else if verdict[i] != Verdict::Outlier {
                    verdict[i] = Verdict::Normal;
                }
            }
        }
        (verdict, expected, own)
    }

    proptest! {
        #[test]
        fn it_equals_its_plain_twin(
            y in prop::collection::vec(prop_oneof![8 => -1.0..1.0, 1 => 5.0..40.0, 1 => -40.0..-5.0], 7..120),
            width in 8usize..40, order in 1usize..=5, feedback: bool, guard: bool, even: bool,
        ) {
            // Even times with a gap, or uneven ones.
            let gap = |i: usize| if i >= 60 { 3.0 } else { 0.0 };
            let t: Vec<f64> =
                (0..y.len()).map(|i| i as f64 + if even { gap(i) } else { 0.3 * (i % 3) as f64 }).collect();
            let rule = PolyRule { width, order, feedback, guard: guard && feedback, k: 2.3 };
            let segment = Segment { t: &t, y: &y, interval: 1.0, sigma: 0.0, floor: 0.0, floors: &[], objections: &[], rate: None };
            let judged = judge(&rule, &segment, &Stop::never()).unwrap();
            let (verdict, expected, own) = plain(&t, &y, &rule);
            prop_assert_eq!(&judged.verdict, &verdict);
            for i in 0..y.len() {
                prop_assert!(expected[i].is_nan() || (judged.expected[i] - expected[i]).abs() < 1e-9, "{}", i);
                prop_assert!(own[i].is_nan() || (judged.own[i] - own[i]).abs() < 1e-9, "{}", i);
            }
        }
    }
}
