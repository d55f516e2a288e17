//! The scales that methods judge by: the noise of a segment and the floor below which no scale may fall.
//! Section 1 of `docs/methods.md`; eq. (2) of \[000\] for `spline`.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use super::shared::{FLOOR, NOISE, RECORD, multiplier};
use super::{exceeds, zero_scale_of_many};
use crate::calibration::{Calibration, Rules, calibrate};
use crate::math::movement::smallest_movement;
use crate::math::order::{MAD_TO_SIGMA, Middle, median_of_many, median_of_smallest};
use crate::math::{difference, pieces, smoothing};
use crate::param::{Choice, Kind, Settings};
use crate::series::Series;
use crate::stop::{Stop, Stopped};

/// With fewer differences than this in a segment, those of all segments of the channel are pooled.
const ENOUGH: usize = 50;

/// The deviation of a third difference of white noise of deviation 1: sqrt(1 + 9 + 9 + 1).
const THIRD: f64 = 4.472_135_954_999_58;

/// The scales of one segment.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scales {
    /// Noise scale, at least `floor`; 0 where it counts as zero and there is no floor, or where no setting asks
    /// for it.
    pub sigma: f64,
    /// Lower bound on any scale; the median of `floors` where each sample has its own.
    pub floor: f64,
    /// Lower bound on the scale of each sample of the channel, where the setting `floor` asks for that.
    pub floors: Option<Arc<[f64]>>,
    /// How far each sample of the channel lies outside of what both sides expect; with `floors`.
    pub objections: Option<Arc<[Objection]>>,
}

/// What the calibration has against a sample, whatever the method.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Objection {
    /// How far it lies outside of what both sides expect ([`Calibration::objections`]), in channel units.
    pub outside: f64,
    /// The limit with tails that weigh once, as a share of the limit, where they weigh squared
    /// ([`Calibration::tails`]): above 0, at most 1. Less for a value that the record hardly takes elsewhere.
    pub lower: f64,
    /// True where it makes an outlier alone when it is gross, whatever the method says.
    pub decides: bool,
}

/// The scales of each segment under `settings` (which may have neither `sigma` nor `floor`); the channel is calibrated
/// where `floor` asks for it.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for them any more.
pub fn scales(
    series: &Series<'_>,
    segments: &[Range<usize>],
    settings: &Settings,
    stop: &Stop,
) -> Result<Vec<Scales>, Stopped> {
    let calibration = rules(settings).map(|rules| calibrate(series, rules, stop)).transpose()?;
    scales_by(series, segments, settings, calibration.as_ref(), stop)
}

/// True when these settings take the floor from the calibration of the record.
#[must_use]
pub fn by_calibration(settings: &Settings) -> bool {
    rules(settings).is_some()
}

/// The rules of the calibration that these settings take the floor from; none where they do not.
#[must_use]
pub fn rules(settings: &Settings) -> Option<Rules> {
    match choice(settings, FLOOR.key)? {
        Choice::Word(NOISE) => Some(Rules::Noise),
        Choice::Word(RECORD) => Some(Rules::Record),
        Choice::Word(_) | Choice::Number(_) => None,
    }
}

/// [`scales`] of a channel whose calibration is known.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for them any more.
pub fn scales_by(
    series: &Series<'_>,
    segments: &[Range<usize>],
    settings: &Settings,
    calibration: Option<&Calibration>,
    stop: &Stop,
) -> Result<Vec<Scales>, Stopped> {
    let calibration = calibration.filter(|c| rules(settings) == Some(c.rules));
    let own = calibration.map(|c| record_floors(c, settings, stop)).transpose()?;
    let objections = calibration.map(|c| objections(c, &series.y, stop)).transpose()?;
    let floors = match (choice(settings, "floor"), &own) {
        (None, _) => vec![0.0; segments.len()],
        (Some(Choice::Number(x)), _) => vec![x; segments.len()],
        (Some(Choice::Word(_)), Some(own)) => {
            let median = |s: &Range<usize>| median_of_many(s.len(), |i| own[s.start + i], &|| stop.check());
            segments.iter().map(median).collect::<Result<_, _>>()?
        }
        (Some(Choice::Word(_)), None) => auto_floor(series, segments, stop)?,
    };
    let sigmas = match choice(settings, "sigma") {
        None => vec![0.0; segments.len()],
        Some(Choice::Number(x)) => vec![x; segments.len()],
        Some(Choice::Word(_)) if !by_noise(settings) => vec![0.0; segments.len()],
        Some(Choice::Word("spline")) => by_spline(series, segments, stop)?,
        Some(Choice::Word(_)) => by_difference(series, segments, stop)?,
    };
    let asked = choice(settings, "sigma").is_some();
    let both = sigmas.into_iter().zip(floors).zip(segments);
    both.map(|((sigma, floor), segment)| {
        let sigma = if !asked {
            0.0
        } else if sigma > zero_scale_of_many(&series.y[segment.clone()], stop)? {
            sigma.max(floor)
        } else {
            floor
        };
        Ok(Scales { sigma, floor, floors: own.clone(), objections: objections.clone() })
    })
    .collect()
}

/// The floor of each sample: the limit of the calibration over the default of the multiplier, so that the multiplier
/// still turns it. 0 where nothing is known.
fn record_floors(calibration: &Calibration, settings: &Settings, stop: &Stop) -> Result<Arc<[f64]>, Stopped> {
    let usual = multiplier(&Settings::defaults(settings.params()));
    let floor = |i: usize| {
        let limit = calibration.limits[i];
        if limit.is_finite() { limit / usual } else { 0.0 }
    };
    Ok(pieces::collect(calibration.limits.len(), &|| stop.check(), floor)?.into())
}

fn objections(calibration: &Calibration, y: &[f64], stop: &Stop) -> Result<Arc<[Objection]>, Stopped> {
    let decides = calibration.rules == Rules::Noise;
    let objection =
        |i: usize| Objection { outside: calibration.objections[i], lower: calibration.lower(i, y[i]), decides };
    Ok(pieces::collect(calibration.objections.len(), &|| stop.check(), objection)?.into())
}

/// False when the method measures a scale of its own and knows none of the words that ask for one of these.
pub(super) fn by_noise(settings: &Settings) -> bool {
    let knows = |kind| matches!(kind, Kind::RealOr { words, .. } if words.contains(&"difference"));
    settings.params().iter().any(|p| p.key == "sigma" && knows(p.kind))
}

fn choice(settings: &Settings, key: &str) -> Option<Choice> {
    settings.get(key).map(|_| settings.choice(key))
}

/// Noise scale from third differences: robust (1.07 at 5 %, 1.17 at 10 % isolated outliers, useless near 20 %) and
/// blind to smooth trends. 0 for a segment without four neighbours when no other segment has them.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for it any more.
pub fn by_difference(series: &Series<'_>, segments: &[Range<usize>], stop: &Stop) -> Result<Vec<f64>, Stopped> {
    pooled(segments, |segment| third_differences(series, segment, stop), |d| spread(d, stop).map(|scale| scale / THIRD))
}

/// Noise scale by eq. (2) of \[000\]: the sample standard deviation of the data about a natural cubic smoothing
/// spline with half power at a period of 20 intervals. Outliers inflate it.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for it any more.
pub fn by_spline(series: &Series<'_>, segments: &[Range<usize>], stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let of = |segment: &Range<usize>| {
        let (t, y) = (&series.t[segment.clone()], &series.y[segment.clone()]);
        smoothing::residual_deviation(t, y, series.interval, &|| stop.check())
    };
    segments.par_iter().map(of).collect()
}

/// The floor for quantised data: half the smallest non-zero step or third difference between neighbours.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for it any more.
pub fn auto_floor(series: &Series<'_>, segments: &[Range<usize>], stop: &Stop) -> Result<Vec<f64>, Stopped> {
    // For each segment: how many third differences it has, and its smallest movement.
    let of = |segment: &Range<usize>| {
        let y = &series.y[segment.clone()];
        let zero = zero_scale_of_many(y, stop)?;
        Ok((y.len().saturating_sub(3), smallest_movement(y, zero, &|| stop.check())?))
    };
    let each: Vec<(usize, f64)> = segments.par_iter().map(of).collect::<Result<_, Stopped>>()?;
    let all = each.iter().map(|e| e.1).fold(f64::INFINITY, f64::min);
    let half = |smallest: f64| if smallest.is_finite() { smallest / 2.0 } else { 0.0 };
    Ok(each.into_iter().map(|(n, own)| half(if n < ENOUGH { all } else { own })).collect())
}

/// `1.4826 * median |d - median(d)|`, again and again on the differences within three such scales of the median of
/// all until it stands still: the outliers' share of the tails is cut off.
fn spread(differences: &[f64], stop: &Stop) -> Result<f64, Stopped> {
    if differences.is_empty() {
        return Ok(0.0);
    }
    let check = || stop.check();
    let n = differences.len();
    let center = median_of_many(n, |i| differences[i], &check)?;
    let distance = |i: usize| (differences[i] - center).abs();
    let median = median_of_many(n, distance, &check)?;
    let mut scale = MAD_TO_SIGMA * median;
    // Without the tails the median is a little less: those values, and the tails that such medians cut off, are
    // looked for once.
    let middle = Middle::of(n, distance, 0.9 * median..=median, 0.9 * (3.0 * scale), &check)?;
    for _ in 0..20 {
        // What lies within are the smallest of all; the limit is taken anew from all of them each time.
        let limit = 3.0 * scale;
        let beyond = |d: f64| exceeds(d, limit);
        let count = n - if limit >= middle.tail_from() {
            middle.tail().iter().filter(|d| beyond(**d)).count()
        } else {
            pieces::map(n, &check, |piece| piece.filter(|i| beyond(distance(*i))).count())?.into_iter().sum()
        };
        let next = match middle.median_of_smallest(count, &check)? {
            Some(next) => next,
            None => median_of_smallest(n, count, distance, &check)?,
        };
        let next = MAD_TO_SIGMA * next;
        // Standing still is meant literally: the same subset has the same median, bit for bit.
        #[expect(clippy::float_cmp, reason = "a fixed point of a selection")]
        if next == scale {
            break;
        }
        scale = next;
    }
    Ok(scale)
}

/// The third differences over the quadruples of a segment without a lost sample.
fn third_differences(series: &Series<'_>, segment: &Range<usize>, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let (t, y) = (&series.t[segment.clone()], &series.y[segment.clone()]);
    let losses = series.losses(segment.clone(), 0, &|| stop.check())?;
    // A stretch without a loss has one for each of its samples but the first three.
    let begins = std::iter::once(0).chain(losses.iter().map(|at| at - segment.start));
    let ends = losses.iter().map(|at| at - segment.start).chain(std::iter::once(y.len()));
    let stretches: Vec<Range<usize>> =
        begins.zip(ends).filter(|(begin, end)| begin + 3 < *end).map(|(b, e)| b..e).collect();
    let mut differences = vec![0.0; stretches.iter().map(|stretch| stretch.len() - 3).sum()];
    let mut rest = differences.as_mut_slice();
    for stretch in stretches {
        let (own, others) = rest.split_at_mut(stretch.len() - 3);
        rest = others;
        pieces::over(own, &|| stop.check(), |first, out| {
            let at = stretch.start + first;
            let ([t0, t1, t2, t3], [y0, y1, y2, y3]) = (four(&t[at..], out.len()), four(&y[at..], out.len()));
            for (i, d) in out.iter_mut().enumerate() {
                *d = difference::third([t0[i], t1[i], t2[i], t3[i]], [y0[i], y1[i], y2[i], y3[i]]);
            }
        })?;
    }
    Ok(differences)
}

/// The `n` values from each of the first four on, so that quadruples may be handled with vector instructions.
fn four(x: &[f64], n: usize) -> [&[f64]; 4] {
    std::array::from_fn(|i| &x[i..i + n])
}

/// One figure per segment from its differences, or from those of all segments where it has too few.
fn pooled(
    segments: &[Range<usize>],
    differences: impl Fn(&Range<usize>) -> Result<Vec<f64>, Stopped> + Sync,
    figure: impl Fn(&[f64]) -> Result<f64, Stopped> + Sync,
) -> Result<Vec<f64>, Stopped> {
    let each: Vec<Vec<f64>> = segments.par_iter().map(&differences).collect::<Result<_, _>>()?;
    let few = each.iter().any(|d| d.len() < ENOUGH);
    let all = if few { figure(&each.concat())? } else { 0.0 };
    each.par_iter().map(|d| if d.len() < ENOUGH { Ok(all) } else { figure(d) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::zero_scale;

    fn by_difference(series: &Series<'_>, segments: &[Range<usize>]) -> Vec<f64> {
        super::by_difference(series, segments, &Stop::never()).unwrap()
    }

    fn auto_floor(series: &Series<'_>, segments: &[Range<usize>]) -> Vec<f64> {
        super::auto_floor(series, segments, &Stop::never()).unwrap()
    }

    /// Noise of deviation close to 1 from a fixed low-discrepancy walk: no generator is needed to make it.
    fn noise(n: usize) -> Vec<f64> {
        let golden = 0.618_033_988_749_894_9;
        let uniform = |i: usize, k: u32| (i as f64 * golden * f64::from(k) + 0.1 * f64::from(k)).fract();
        (0..n).map(|i| (1..=12).map(|k| uniform(i * 7919 % 104_729, k * k + 1)).sum::<f64>() - 6.0).collect()
    }

    #[test]
    fn smooth_tracks_do_not_count_as_noise_and_outliers_hardly_do() {
        let n = 4000;
        let t: Vec<f64> = (0..n).map(|i| i as f64 * 0.1).collect();
        let e = noise(n);
        let clean: Vec<f64> = t.iter().zip(&e).map(|(t, e)| 3.0 * t * t - 40.0 * t + e).collect();
        let white = Series::new(&t, &e);
        let segments = white.segments(Some(5));
        let of_noise = by_difference(&white, &segments)[0];
        let of_track = by_difference(&Series::new(&t, &clean), &segments)[0];
        assert!((of_track / of_noise - 1.0).abs() < 1e-6, "{of_track} {of_noise}");
        let mut spiked = clean;
        (0..n).step_by(20).for_each(|i| spiked[i] += 30.0);
        let of_spiked = by_difference(&Series::new(&t, &spiked), &segments)[0];
        assert!((of_spiked / of_noise - 1.0).abs() < 0.15, "{of_spiked} {of_noise}");
        assert!(by_spline(&Series::new(&t, &spiked), &segments, &Stop::never()).unwrap()[0] > 3.0 * of_noise);
    }

    #[test]
    fn an_exact_parabola_and_a_constant_have_no_noise() {
        let t: Vec<f64> = (0..100).map(f64::from).collect();
        let y: Vec<f64> = t.iter().map(|t| 0.1 * t * t).collect();
        for y in [y, vec![5.0; 100]] {
            let series = Series::new(&t, &y);
            let segments = series.segments(None);
            assert!(by_difference(&series, &segments)[0] <= zero_scale(&y));
        }
    }

    #[test]
    fn the_floor_of_data_in_steps_is_half_a_step() {
        let t: Vec<f64> = (0..200).map(f64::from).collect();
        let y: Vec<f64> = (0..200).map(|i| 25.0 * f64::from(40 - i / 5)).collect();
        let series = Series::new(&t, &y);
        assert_eq!(auto_floor(&series, &series.segments(None)), [12.5]);
        assert_eq!(auto_floor(&Series::new(&t, &[7.0; 200]), &series.segments(None)), [0.0]);
    }

    /// Two stretches a gap apart: the first of `n` samples in steps of 4, the second of 60 in steps of 1.
    fn two_stretches(n: usize) -> (Vec<f64>, Vec<f64>) {
        let t: Vec<f64> = (0..n + 60).map(|i| if i < n { i as f64 } else { i as f64 + 100.0 }).collect();
        let values = noise(n + 60);
        let y =
            values.iter().enumerate().map(|(i, v)| if i < n { (v * 3.0).round() * 4.0 } else { v.round() }).collect();
        (t, y)
    }

    /// Section 1: with fewer than 50 third differences, of all segments.
    #[test]
    fn fifty_third_differences_are_enough_and_one_fewer_are_not() {
        for (n, enough) in [(53, true), (52, false)] {
            let (t, y) = two_stretches(n);
            let both = Series::new(&t, &y);
            let segments = both.segments(Some(5));
            assert_eq!(segments.len(), 2);
            let alone = by_difference(&both, &segments[..1])[0];
            assert!(alone > 1.0, "{n}: steps of 4");
            assert_eq!(by_difference(&both, &segments)[0].to_bits() == alone.to_bits(), enough, "{n}");
            assert_eq!(auto_floor(&both, &segments), if enough { [2.0, 0.5] } else { [0.5, 0.5] }, "{n}");
        }
    }
}
