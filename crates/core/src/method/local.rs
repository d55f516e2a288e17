//! The floor of each sample, applied to what a method says: noise that changes along the record needs a limit that
//! changes with it, whatever the method.

use rayon::prelude::*;

use super::noise::Objection;
use super::shared::{DOUBT, multiplier};
use super::{Direction, Directions, Judged, Segment, Verdict, reaches};
use crate::math::line::LineSums;
use crate::math::pieces::{self, PIECE};
use crate::math::sliding::Summary;
use crate::param::Settings;
use crate::stop::{Stop, Stopped};

/// An outlier lies outside of what both sides expect by this share of its tolerance at least: then no real change of
/// the target, which one side agrees with, is removed.
const OUTSIDE: f64 = 0.3;

/// Where the calibration decides, an objection of this many tolerances makes an outlier, also if the method has started
/// again on the level of the run.
const GROSS: f64 = 10.0;

/// What `judged` is with no tolerance below the multiplier times the floor of its sample. An objection that does not
/// reach that is withdrawn, and one with which only one side of the sample agrees leaves it suspect. Suspect is also
/// what both reach with the share `doubt` of the lower limit, and where a real change, if it is one, begins.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub(super) fn bounded_below(
    mut judged: Judged,
    segment: &Segment<'_>,
    settings: &Settings,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    if segment.floors.len() != judged.verdict.len() {
        return Ok(judged);
    }
    let (k, doubt) = (multiplier(settings), settings.real(DOUBT.key));
    if judged.scale.len() == judged.verdict.len() {
        pieces::over(&mut judged.scale, &|| stop.check(), |first, scale| {
            // A scale that is not known stays so.
            scale
                .iter_mut()
                .zip(&segment.floors[first..])
                .filter(|(s, _)| !s.is_nan())
                .for_each(|(s, f)| *s = s.max(*f));
        })?;
        judged.gate_by(segment.y, k, Some((segment.objections, doubt)), stop)?;
        return Ok(judged);
    }
    let changes = changes(&judged);
    let Judged { verdict, tolerance, expected, .. } = &mut judged;
    let pieces = verdict.par_chunks_mut(PIECE).zip(tolerance.par_chunks_mut(PIECE)).enumerate();
    let judge = |(piece, (verdict, tolerance)): (usize, (&mut [Verdict], &mut [f64]))| {
        stop.check()?;
        let mut followed = false;
        for (i, (said, tolerance)) in (piece * PIECE..).zip(verdict.iter_mut().zip(tolerance)) {
            if tolerance.is_nan() || expected[i].is_nan() {
                continue;
            }
            *tolerance = tolerance.max(k * segment.floors[i]);
            let sample = Sample { distance: (segment.y[i] - expected[i]).abs(), objection: segment.objections[i] };
            let change = changes.get(i).copied().unwrap_or(false);
            *said = sample.verdict(*said, *tolerance, doubt, change);
            followed |= sample.is_followed(*tolerance);
        }
        Ok(followed)
    };
    if pieces.map(judge).try_reduce(|| false, |a, b| Ok(a | b))? {
        object_to_followed(&mut judged, segment);
    }
    Ok(judged)
}

/// Corrects what is said of gross runs that the method has followed: both directions object, and the line between the
/// samples before and after the run is expected.
fn object_to_followed(judged: &mut Judged, segment: &Segment<'_>) {
    let Judged { tolerance, expected, directions, .. } = judged;
    let followed: Vec<bool> = (0..tolerance.len())
        .map(|i| {
            let distance = (segment.y[i] - expected[i]).abs();
            Sample { distance, objection: segment.objections[i] }.is_followed(tolerance[i])
        })
        .collect();
    let mut first = 0;
    for run in followed.chunk_by(|a, b| a == b) {
        let end = first + run.len();
        if run[0] {
            let mut line = LineSums::default();
            let around = first.checked_sub(1).into_iter().chain(Some(end).filter(|&end| end < followed.len()));
            around.for_each(|i| line.add([segment.t[i], segment.y[i]]));
            for (i, expected) in (first..end).zip(&mut expected[first..end]) {
                *expected = line.at(segment.t[i]);
                if let Some(Directions { forward, backward }) = directions.get_mut(i) {
                    forward.iter_mut().chain(backward).for_each(|said| *said = Direction::Abnormal);
                }
            }
        }
        first = end;
    }
}

/// What is known of a sample besides its tolerance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    /// How far it lies from its expected value.
    pub(super) distance: f64,
    /// What the calibration has against it.
    pub(super) objection: Objection,
}

impl Sample {
    /// What is said of it by both sides of the record, where the method has `said` something of it; `change` is true
    /// where a real change begins, if it is one.
    #[inline]
    fn verdict(self, said: Verdict, tolerance: f64, doubt: f64, change: bool) -> Verdict {
        match said {
            Verdict::Outlier | Verdict::Suspect | Verdict::Normal if self.is_gross(tolerance) => Verdict::Outlier,
            Verdict::Outlier if self.both_sides(tolerance) => Verdict::Outlier,
            Verdict::Outlier if reaches(self.distance, tolerance) => Verdict::Suspect,
            // What only one direction objects to: its expected value is that of the other one.
            Verdict::Suspect if doubt >= 1.0 || change => Verdict::Suspect,
            Verdict::Outlier | Verdict::Suspect | Verdict::Normal if self.is_doubtful(tolerance, doubt) => {
                Verdict::Suspect
            }
            Verdict::Outlier | Verdict::Suspect => Verdict::Normal,
            other => other,
        }
    }

    /// The same where the multiplier only gates: the method says no more than that the distance reaches the tolerance.
    #[inline]
    pub(super) fn gated(self, tolerance: f64, doubt: f64) -> Verdict {
        if self.is_gross(tolerance) {
            Verdict::Outlier
        } else if reaches(self.distance, tolerance) {
            if self.both_sides(tolerance) { Verdict::Outlier } else { Verdict::Suspect }
        } else if self.is_doubtful(tolerance, doubt) {
            Verdict::Suspect
        } else {
            Verdict::Normal
        }
    }

    fn both_sides(self, limit: f64) -> bool {
        reaches(self.distance, limit) && self.objection.outside >= OUTSIDE * limit
    }

    fn is_gross(self, tolerance: f64) -> bool {
        // On a constant both are 0.
        self.objection.decides && self.objection.outside > 0.0 && self.objection.outside >= GROSS * tolerance
    }

    /// True for a gross sample that the method agrees with, because it has followed the run that the sample is in.
    fn is_followed(self, tolerance: f64) -> bool {
        self.is_gross(tolerance) && !reaches(self.distance, tolerance)
    }

    fn is_doubtful(self, tolerance: f64, doubt: f64) -> bool {
        doubt < 1.0 && self.both_sides(doubt * self.objection.lower * tolerance)
    }

    /// The multipliers of `scale` at which its verdict changes.
    #[inline]
    pub(super) fn turns(self, scale: f64, doubt: f64) -> [f64; 5] {
        let (ratio, outside) = (self.distance / scale, self.objection.outside / (OUTSIDE * scale));
        let lower = doubt * self.objection.lower;
        // Where nothing is doubtful, the lower limit turns nothing.
        let gross = if self.objection.decides { self.objection.outside / (GROSS * scale) } else { ratio };
        if doubt < 1.0 {
            [ratio, outside, gross, ratio / lower, outside / lower]
        } else {
            [ratio, outside, gross, ratio, outside]
        }
    }
}

/// The samples at which a real change begins, if it is one: of each run that is suspect, those with which an objection
/// begins, or both ends where none does. Empty where there is none.
fn changes(judged: &Judged) -> Vec<bool> {
    if !judged.verdict.contains(&Verdict::Suspect) {
        return Vec::new();
    }
    let mut changes = vec![false; judged.verdict.len()];
    let mut first = 0;
    for run in judged.verdict.chunk_by(|a, b| (*a == Verdict::Suspect) == (*b == Verdict::Suspect)) {
        let places = first..first + run.len();
        first += run.len();
        if run[0] != Verdict::Suspect {
            continue;
        }
        let begun: Vec<usize> = places.clone().filter(|&i| begins(&judged.directions, i)).collect();
        let ends = [places.start, places.end - 1];
        for &i in if begun.is_empty() { &ends[..] } else { &begun } {
            changes[i] = true;
        }
    }
    changes
}

/// True for the first sample of a run to which a direction objects: the others tell an analyst nothing more.
fn begins(directions: &[Directions], i: usize) -> bool {
    let at = |j: Option<usize>| j.and_then(|j| directions.get(j));
    let forward = |j| at(j).is_some_and(|d| d.forward == Some(Direction::Abnormal));
    let backward = |j| at(j).is_some_and(|d| d.backward == Some(Direction::Abnormal));
    (forward(Some(i)) && !forward(i.checked_sub(1))) || (backward(Some(i)) && !backward(i.checked_add(1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::Method;
    use crate::method::hampel::Hampel;
    use crate::method::noise::{Objection, Scales};

    #[test]
    fn a_flag_needs_the_floor_of_its_sample_and_the_objection_of_both_sides() {
        let y = [0.0, 9.0, 9.0, 9.0];
        // The multiplier of hampel is 3 by default; that of these settings is 4.
        let mut settings = Settings::defaults(Hampel.about().params);
        settings.set_text("hampel", "k", "4").unwrap();
        settings.set_text("hampel", "doubt", "1").unwrap();
        let floors = [1.0, 1.0, 3.0, 1.0];
        let objections = [0.0, 9.0, 9.0, 1.0].map(|outside| Objection { outside, lower: 1.0, decides: false });
        let t = [0.0, 1.0, 2.0, 3.0];
        let segment = Segment {
            t: &t,
            y: &y,
            interval: 1.0,
            sigma: 1.0,
            floor: 1.0,
            floors: &floors,
            objections: &objections,
            rate: None,
        };
        let said = Judged {
            verdict: vec![Verdict::Normal, Verdict::Outlier, Verdict::Outlier, Verdict::Outlier],
            expected: vec![0.0; 4],
            tolerance: vec![2.0; 4],
            ..Judged::default()
        };
        let judged = bounded_below(said, &segment, &settings, &Stop::never()).unwrap();
        let wanted = [Verdict::Normal, Verdict::Outlier, Verdict::Normal, Verdict::Suspect];
        assert_eq!((judged.verdict, judged.tolerance), (wanted.to_vec(), vec![4.0, 4.0, 12.0, 4.0]));
    }

    /// What a segment with floors of 1 (multiplier 3) and these objections makes of samples at `y`, expected at 0.
    fn said(y: &[f64], objections: &[Objection], judged: Judged, doubt: &str) -> Vec<Verdict> {
        let n = y.len();
        let mut settings = Settings::defaults(Hampel.about().params);
        settings.set_text("hampel", "doubt", doubt).unwrap();
        let (t, floors): (Vec<f64>, Vec<f64>) = ((0..n).map(|i| i as f64).collect(), vec![1.0; n]);
        let scales =
            Scales { sigma: 1.0, floor: 1.0, floors: Some(floors.into()), objections: Some(objections.into()) };
        let series = crate::series::Series::new(&t, y);
        let segment = Segment::of(&series, &(0..n), &scales, None);
        let judged = Judged { expected: vec![0.0; n], tolerance: vec![1.0; n], ..judged };
        bounded_below(judged, &segment, &settings, &Stop::never()).unwrap().verdict
    }

    #[test]
    fn a_gross_run_that_the_method_follows_is_an_outlier_with_the_line_over_it() {
        let n = 6;
        let y = [0.0, 1.0, 5002.0, 5003.0, 4.0, 5.0];
        let objections = [0.0, 0.0, 5000.0, 5000.0, 0.0, 0.0];
        let mut settings = Settings::defaults(Hampel.about().params);
        settings.set_text("hampel", "doubt", "1").unwrap();
        let t: Vec<f64> = (0..n).map(f64::from).collect();
        let with = |decides, outside: [f64; 6]| {
            let objections = outside.map(|outside| Objection { outside, lower: 1.0, decides });
            let floors = vec![1.0; 6].into();
            let scales = Scales { sigma: 1.0, floor: 1.0, floors: Some(floors), objections: Some(objections.into()) };
            let series = crate::series::Series::new(&t, &y);
            let segment = Segment::of(&series, &(0..6), &scales, None);
            let said = Judged {
                verdict: vec![Verdict::Normal; 6],
                expected: y.to_vec(),
                tolerance: vec![1.0; 6],
                directions: vec![Directions { forward: Some(Direction::Normal), backward: None }; 6],
                ..Judged::default()
            };
            bounded_below(said, &segment, &settings, &Stop::never()).unwrap()
        };
        let found = with(true, objections);
        let objects = |d: &Directions| (d.forward, d.backward) == (Some(Direction::Abnormal), None);
        assert_eq!(found.directions.iter().map(objects).collect::<Vec<_>>(), [false, false, true, true, false, false]);
        let outliers: Vec<usize> = (0..6).filter(|&i| found.verdict[i] == Verdict::Outlier).collect();
        assert_eq!((outliers, &found.expected[..]), (vec![2, 3], &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0][..]));
        // By the first rules, and with less than ten tolerances of 3, the method has the last word.
        for other in [with(false, objections), with(true, objections.map(|o| o * 29.0 / 5000.0))] {
            assert_eq!((other.verdict, other.expected), (vec![Verdict::Normal; 6], y.to_vec()));
        }
    }

    #[test]
    fn on_a_constant_nothing_is_gross() {
        let objection = Objection { outside: 0.0, lower: 1.0, decides: true };
        assert_eq!(Sample { distance: 0.0, objection }.verdict(Verdict::Normal, 0.0, 1.0, false), Verdict::Normal);
        assert_ne!(Sample { distance: 0.0, objection }.gated(1.0, 1.0), Verdict::Outlier);
    }

    #[test]
    fn doubt_begins_at_its_share_of_the_tolerance() {
        use Verdict::{Normal, Outlier, Suspect};
        let y = [0.0, 2.0, 2.0, 1.0, 4.0];
        let objections = [9.0, 2.0, 0.1, 2.0, 4.0].map(|outside| Objection { outside, lower: 1.0, decides: false });
        let judged = || Judged { verdict: vec![Normal, Outlier, Outlier, Outlier, Outlier], ..Judged::default() };
        assert_eq!(said(&y, &objections, judged(), "0.5"), [Normal, Suspect, Normal, Normal, Outlier]);
        assert_eq!(said(&y, &objections, judged(), "0.3"), [Normal, Suspect, Normal, Suspect, Outlier]);
        assert_eq!(said(&y, &objections, judged(), "1"), [Normal, Normal, Normal, Normal, Outlier]);
        // With heavy tails the lower limit lies farther below.
        let heavy = objections.map(|o| Objection { lower: 0.6, ..o });
        assert_eq!(said(&y, &heavy, judged(), "0.5"), [Normal, Suspect, Normal, Suspect, Outlier]);
    }

    #[test]
    fn of_what_one_direction_objects_to_the_first_sample_is_suspect() {
        use Verdict::{Normal, Suspect};
        let one = |forward, backward| Directions { forward: Some(forward), backward: Some(backward) };
        let (normal, abnormal) = (Direction::Normal, Direction::Abnormal);
        let mut directions = vec![one(normal, abnormal); 2];
        directions.extend(vec![one(abnormal, normal); 3]);
        let judged = || Judged { verdict: vec![Suspect; 5], directions: directions.clone(), ..Judged::default() };
        assert_eq!(
            said(&[0.0; 5], &[Objection { outside: 0.0, lower: 1.0, decides: false }; 5], judged(), "0.5"),
            [Normal, Suspect, Suspect, Normal, Normal]
        );
        assert_eq!(
            said(&[0.0; 5], &[Objection { outside: 0.0, lower: 1.0, decides: false }; 5], judged(), "1"),
            [Suspect; 5]
        );
    }
}
