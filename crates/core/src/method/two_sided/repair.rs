//! Eq. (5) of \[000\]: one polynomial through the accepted samples on both sides of a run.

use super::candidates::{Candidate, TWO_POINT, candidates};
use crate::math::polyfit::Polynomial;
use crate::method::{Damaged, Part, Segment};
use crate::stop::{Stop, Stopped};

/// One value for each outlier; NaN where the sample is removed.
pub(super) fn repair(damaged: &Damaged<'_>, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let Damaged { segment, settings, judged, outliers } = *damaged;
    let list = candidates(settings);
    let matched = settings.word("repair_rule") == "matched";
    let mut accepted = vec![true; segment.len()];
    for &i in outliers {
        accepted[i] = false;
    }
    let mut values = Vec::with_capacity(outliers.len());
    for (n, run) in outliers.chunk_by(|a, b| a + 1 == *b).enumerate() {
        // A run costs some microseconds.
        stop.check_at(64 * n)?;
        let fit = if matched {
            agreed(segment, &judged, run, &list).and_then(|c| around(segment, &accepted, run, c)).map(|(fit, _)| fit)
        } else {
            best(segment, &accepted, run, &list)
        };
        values.extend(run.iter().map(|&i| fit.as_ref().map_or(f64::NAN, |fit| fit.at(segment.t[i]))));
    }
    Ok(values)
}

/// `best`: the candidate with the least sum of squares per degree of freedom among those with room on both sides.
fn best(segment: &Segment<'_>, accepted: &[bool], run: &[usize], list: &[Candidate]) -> Option<Polynomial> {
    let mut best: Option<(Polynomial, f64)> = None;
    for candidate in list {
        if allowed(segment, run, candidate)
            && let Some((fit, misfit)) = around(segment, accepted, run, candidate)
            && best.as_ref().is_none_or(|(_, least)| misfit < *least)
        {
            best = Some((fit, misfit));
        }
    }
    best.map(|(fit, _)| fit)
}

/// `matched`: the candidate that both directions remember, where the paper allows it.
fn agreed<'a>(segment: &Segment<'_>, judged: &Part<'_>, run: &[usize], list: &'a [Candidate]) -> Option<&'a Candidate> {
    let (&first, &last) = (run.first()?, run.last()?);
    let [forward, _] = *judged.repair_code.get(last)?;
    let [_, backward] = *judged.repair_code.get(first)?;
    let candidate = list.iter().find(|c| c.code == forward && c.code == backward)?;
    allowed(segment, run, candidate).then_some(candidate)
}

/// The two-point line is for a single outlier with no lost sample beside it: two points show nothing of what the track
/// does over a longer gap.
fn allowed(segment: &Segment<'_>, run: &[usize], candidate: &Candidate) -> bool {
    let (Some(&first), Some(&last)) = (run.first(), run.last()) else { return false };
    let lost = segment.lost_before(first) > 0 || (last + 1 < segment.len() && segment.lost_before(last + 1) > 0);
    candidate.code != TWO_POINT || (first == last && !lost)
}

/// The candidate's polynomial through its number of accepted samples before the run and as many after it, with the
/// sum of squares of its residuals per degree of freedom; none when either side has fewer.
fn around(segment: &Segment<'_>, accepted: &[bool], run: &[usize], c: &Candidate) -> Option<(Polynomial, f64)> {
    let (&first, &last) = (run.first()?, run.last()?);
    let mut at: Vec<usize> = (0..first).rev().filter(|&i| accepted[i]).take(c.points).collect();
    at.reverse();
    at.extend((last + 1..segment.len()).filter(|&i| accepted[i]).take(c.points));
    // Either side may be short; together they are whole only when neither is.
    if at.len() < 2 * c.points {
        return None;
    }
    let (t, y): (Vec<f64>, Vec<f64>) = at.iter().map(|&i| (segment.t[i], segment.y[i])).unzip();
    let fit = Polynomial::fit(&t, &y, c.order);
    let squares: f64 = t.iter().zip(&y).map(|(&t, y)| (y - fit.at(t)) * (y - fit.at(t))).sum();
    #[expect(clippy::cast_precision_loss, reason = "at most 180 points")]
    let freedom = (2 * c.points - c.order - 1) as f64;
    Some((fit, squares / freedom))
}

#[cfg(test)]
mod tests {
    use super::super::TwoSided;
    use super::*;
    use crate::method::{Judged, Method};
    use crate::param::Settings;

    fn segment<'a>(t: &'a [f64], y: &'a [f64]) -> Segment<'a> {
        Segment { t, y, interval: 1.0, sigma: 1.0, floor: 0.0, floors: &[], objections: &[], rate: None }
    }

    /// Section 6, Repair: the two-point line only for a single outlier with no lost sample beside it.
    #[test]
    fn two_points_carry_over_a_single_outlier_with_nothing_lost_beside_it() {
        let mut settings = Settings::defaults(TwoSided.about().params);
        settings.set_text("two-sided", "two_point", "true").unwrap();
        let list = candidates(&settings);
        let agree = |code: u8, run: &[usize], gap_before: usize| {
            // From `gap_before` on, everything comes three samples later.
            let t: Vec<f64> = (0..20).map(|i| if i < gap_before { i as f64 } else { i as f64 + 3.0 }).collect();
            let judged = Judged { repair_code: vec![[code, code]; 20], ..Judged::default() };
            agreed(&segment(&t, &t), &judged.part(0..20), run, &list).map(|c| c.code)
        };
        assert_eq!(agree(TWO_POINT, &[5], 20), Some(TWO_POINT));
        assert_eq!(agree(TWO_POINT, &[19], 20), Some(TWO_POINT), "nothing is lost after the last sample");
        assert_eq!(agree(TWO_POINT, &[5], 12), Some(TWO_POINT), "lost elsewhere");
        assert_eq!(agree(TWO_POINT, &[5, 6], 20), None, "two outliers");
        assert_eq!(agree(TWO_POINT, &[5], 5), None, "lost before it");
        assert_eq!(agree(TWO_POINT, &[5], 6), None, "lost after it");
        assert_eq!(agree(1, &[5, 6], 5), Some(1), "a line on more points is not held to that");
        assert_eq!(agree(9, &[5], 20), None, "no such candidate");
    }

    /// The line through (0, 1) (1, -1) (3, -1) (4, 1) is y = 0: squares 4, over 2 * 2 - 1 - 1 degrees of freedom.
    #[test]
    fn the_misfit_is_the_sum_of_squares_per_degree_of_freedom() {
        let (t, y) = ([0.0, 1.0, 2.0, 3.0, 4.0], [1.0, -1.0, 99.0, -1.0, 1.0]);
        let accepted = [true, true, false, true, true];
        let line = Candidate { order: 1, points: 2, code: 1 };
        let (fit, misfit) = around(&segment(&t, &y), &accepted, &[2], &line).unwrap();
        assert!(fit.at(2.0).abs() < 1e-12 && (misfit - 2.0).abs() < 1e-12, "{misfit}");
        assert!(around(&segment(&t, &y), &accepted, &[2], &Candidate { points: 3, ..line }).is_none());
    }
}
