//! Eq. (2) of \[000\]: how far a channel strays from a smooth curve, before the repair and after it.

use std::ops::Range;

use rayon::prelude::*;

use crate::analysis::Outcome;
use crate::math::{pieces, smoothing};
use crate::series::Series;
use crate::stop::{Stop, Stopped};

/// The standard deviation of a channel about its smoothing spline (half power at a period of 20 intervals), in the units
/// of the channel: the root mean square over the segments, weighted by their samples.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct SplineResidual {
    /// Of the samples as measured.
    pub before: f64,
    /// With the outliers repaired; those that are removed are left out.
    pub after: f64,
}

/// The residual before and after the repair; none for a circular channel, whose values jump where they wrap, and where no
/// segment has three samples.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for it any more.
pub fn spline_residual(outcome: &Outcome, series: &Series<'_>, stop: &Stop) -> Result<Option<SplineResidual>, Stopped> {
    let detection = &outcome.detection;
    if detection.setup.preparation.period.is_some() {
        return Ok(None);
    }
    let before = |s: &Range<usize>| deviation(series, &series.t[s.clone()], &series.y[s.clone()], stop);
    let before = || pooled(&detection.segments, before);
    if outcome.outliers.is_empty() {
        return Ok(before()?.map(|before| SplineResidual { before, after: before }));
    }
    let after = |s: &Range<usize>| {
        let (t, y) = repaired(outcome, series, s, stop)?;
        deviation(series, &t, &y, stop)
    };
    // A record without gaps is one segment: side by side, both take the time of one.
    let (before, after) = rayon::join(before, || pooled(&detection.segments, after));
    Ok(before?.zip(after?).map(|(before, after)| SplineResidual { before, after }))
}

/// Deviation and number of samples; none for fewer than three.
fn deviation(series: &Series<'_>, t: &[f64], y: &[f64], stop: &Stop) -> Result<Option<(f64, usize)>, Stopped> {
    let deviation = smoothing::residual_deviation(t, y, series.interval, &|| stop.check())?;
    Ok((y.len() >= 3).then_some((deviation, y.len())))
}

/// A segment with its outliers repaired or left out.
fn repaired(
    outcome: &Outcome,
    series: &Series<'_>,
    segment: &Range<usize>,
    stop: &Stop,
) -> Result<(Vec<f64>, Vec<f64>), Stopped> {
    let value = |i: usize| outcome.fix(i).unwrap_or(series.y[i]);
    let check = || stop.check();
    let mut y = pieces::collect(segment.len(), &check, |k| value(segment.start + k))?;
    let mut t = series.t[segment.clone()].to_vec();
    if y.iter().any(|y| y.is_nan()) {
        let kept: Vec<bool> = y.iter().map(|y| y.is_finite()).collect();
        let mut kept = kept.iter().cycle();
        t.retain(|_| *kept.next().unwrap_or(&true));
        y.retain(|y| y.is_finite());
    }
    Ok((t, y))
}

#[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
fn pooled(
    segments: &[Range<usize>],
    of: impl Fn(&Range<usize>) -> Result<Option<(f64, usize)>, Stopped> + Sync + Send,
) -> Result<Option<f64>, Stopped> {
    let parts: Vec<Option<(f64, usize)>> = segments.par_iter().map(of).collect::<Result<_, _>>()?;
    let (squares, samples) =
        parts.into_iter().flatten().fold((0.0, 0.0), |(s, n), (d, count)| (s + count as f64 * d * d, n + count as f64));
    Ok((samples > 0.0).then(|| (squares / samples).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Detection;
    use crate::review::Decisions;
    use crate::setup::Setup;

    /// Noise of +1, -1 in turn is all residual (next to nothing of a period of 2 intervals passes a spline of half power
    /// at 20): sqrt(200 / 199) = 1.0025 at most. With 41 in place of 1 the dense solution of Reinsch's equations gives
    /// 2.886, and with -1, the linear repair, 1.0002.
    #[test]
    fn a_spike_is_in_the_residual_before_and_not_after() {
        let t: Vec<f64> = (0..200).map(f64::from).collect();
        let mut y: Vec<f64> = (0..200).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        y[100] = 41.0;
        let series = Series::new(&t, &y);
        let residual = |repair: &str| {
            let mut setup = Setup::standard();
            setup.set_text("sigma", "1").unwrap();
            setup.set_text("floor", "auto").unwrap();
            setup.repair.set_text("repair", crate::repair::METHOD.key, repair).unwrap();
            let detection = Detection::of((&series).into(), &setup, &Stop::never()).unwrap();
            let rows = crate::analysis::Rows { seconds: &t, own: None };
            let outcome =
                crate::analysis::settle(&series, rows, detection.into(), &Decisions::default(), &Stop::never())
                    .unwrap();
            assert_eq!(outcome.outliers, [100]);
            spline_residual(&outcome, &series, &Stop::never()).unwrap().unwrap()
        };
        for repair in ["linear", "remove"] {
            let SplineResidual { before, after } = residual(repair);
            assert!((before - 2.886).abs() < 5e-4, "{before}");
            assert!((after - 1.0002).abs() < 2e-3, "{repair}: {after}");
        }
    }
}
