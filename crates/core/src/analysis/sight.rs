//! What of a channel its method sees: the measured samples without those that checks object to or the analyst decided
//! to be wild, and on an unwrapped scale where the channel is circular; and how what the method says of them is put
//! back among the measured samples.

use std::ops::Range;
use std::sync::Arc;

use crate::check::{Applied, Objection, Subject};
use crate::math::circle::Circle;
use crate::method::noise::{self, Scales};
use crate::method::{Directions, Judged, Part, Restart, Verdict};
use crate::preparation::Preparation;
use crate::review::{Decision, Decisions, Ruling};
use crate::series::Series;
use crate::stop::{Stop, Stopped};

/// A sample that the method does not see.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Finding {
    /// Its position.
    pub(super) position: u32,
    /// What is said of it.
    pub(super) verdict: Verdict,
    /// Who says so.
    pub(super) by: By,
}

/// Who keeps a sample from the method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum By {
    /// The check of this index in the plan, with its evidence.
    Check(usize, Objection),
    /// The analyst.
    Analyst,
}

/// What the analyst's decisions change of what a method sees, by row.
pub(super) type Taught = Vec<Lesson>;

/// A decision that the method learns from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Lesson {
    /// Row, from 0.
    row: u32,
    ruling: Ruling,
    /// What is said of a sample that the method does not see: what it said when the analyst agreed, otherwise nothing.
    said: Verdict,
}

/// The decisions that `preparation` lets the method learn from.
pub(super) fn taught(preparation: &Preparation, decisions: Option<&Decisions>) -> Taught {
    let Some(decisions) = decisions.filter(|_| preparation.exclude_decided) else { return Vec::new() };
    let flagged = |v: &Verdict| matches!(v, Verdict::Outlier | Verdict::Suspect);
    let lesson = |(row, decision): (u32, &Decision)| Lesson {
        row,
        ruling: decision.ruling,
        said: decision.said.filter(flagged).unwrap_or(Verdict::Unchecked),
    };
    decisions.iter().map(lesson).collect()
}

/// What of a channel its method sees.
#[derive(Debug, Clone, Default)]
pub(super) struct Sight {
    /// The samples that it does not see, by position.
    pub(super) findings: Vec<Finding>,
    /// Positions of those that it sees; none where it sees all.
    kept: Option<Vec<u32>>,
    /// The unwrapped scale of a circular channel.
    circle: Option<Circle>,
}

impl Sight {
    /// Makes the checks of `preparation`, and unwraps the channel where it is circular.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub(super) fn of(
        measured: &Series<'_>,
        companions: &[Vec<Vec<f64>>],
        (preparation, taught): (&Preparation, &Taught),
        stop: &Stop,
    ) -> Result<Self, Stopped> {
        if preparation.is_empty() {
            return Ok(Self::default());
        }
        let mut findings = Vec::new();
        let mut kept: Option<Vec<u32>> = None;
        for (index, applied) in preparation.checks.iter().enumerate().filter(|(_, applied)| applied.on) {
            let companions = companions.get(index).map_or(&[][..], Vec::as_slice);
            let objections = objections((measured, kept.as_deref()), companions, applied, preparation.period, stop)?;
            let good = |o: &Objection| is_taught(taught, measured.row(o.position), Ruling::Normal);
            let new = objections.into_iter().filter(|o| !good(o)).map(|o| finding(o, index));
            let before = findings.len();
            findings.extend(new);
            if findings.len() > before {
                findings.sort_unstable_by_key(|f: &Finding| f.position);
                kept = Some(others(measured.len(), &findings));
            }
        }
        for lesson in taught.iter().filter(|lesson| lesson.ruling == Ruling::Outlier) {
            let Some(position) = measured.position(lesson.row as usize) else { continue };
            #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
            let position = position as u32;
            if let Err(at) = findings.binary_search_by_key(&position, |f| f.position) {
                findings.insert(at, Finding { position, verdict: lesson.said, by: By::Analyst });
            }
        }
        kept = (!findings.is_empty()).then(|| others(measured.len(), &findings));
        let circle = preparation
            .period
            .map(|period| Circle::of(&measured.y, kept.as_deref(), period, &|| stop.check()))
            .transpose()?;
        Ok(Self { findings, kept, circle })
    }

    /// True when both let the method see the same samples of the same channel, on the same scale.
    pub(super) fn shows_the_same(&self, other: &Self) -> bool {
        self.kept == other.kept && self.circle == other.circle
    }

    /// The samples that the method sees.
    pub(super) fn series<'a>(&'a self, measured: &'a Series<'_>) -> Series<'a> {
        measured.seen(self.kept.as_deref(), self.circle.as_ref().map(|c| c.unwrapped.as_slice()))
    }

    /// Values of all measured samples on the scale that the method judges on.
    pub(super) fn values<'a>(&'a self, measured: &'a Series<'_>) -> &'a [f64] {
        self.circle.as_ref().map_or(&measured.y, |circle| &circle.unwrapped)
    }

    /// A value of that scale as the record writes it.
    pub(super) fn written(&self, value: f64) -> f64 {
        self.circle.as_ref().map_or(value, |circle| circle.wrapped(value))
    }

    /// A value at the turn of the measured sample at `position`, on the scale that the method judges on.
    pub(super) fn unwrapped(&self, value: f64, position: usize, measured: &[f64]) -> f64 {
        self.circle.as_ref().map_or(value, |circle| value + (circle.unwrapped[position] - measured[position]))
    }

    /// The finding about the sample at `position`.
    pub(super) fn finding(&self, position: usize) -> Option<&Finding> {
        let at = self.findings.binary_search_by_key(&position, |f| f.position as usize).ok()?;
        self.findings.get(at)
    }

    /// The positions among the seen samples of a stretch of measured ones.
    pub(super) fn seen_range(&self, measured: &Range<usize>) -> Range<usize> {
        let Some(kept) = &self.kept else { return measured.clone() };
        let before = |position: usize| kept.partition_point(|k| (*k as usize) < position);
        before(measured.start)..before(measured.end)
    }

    /// The position among the seen samples of the measured one at `position`, if the method sees it.
    pub(super) fn seen(&self, position: usize) -> Option<usize> {
        match &self.kept {
            None => Some(position),
            Some(kept) => kept.binary_search(&u32::try_from(position).ok()?).ok(),
        }
    }

    /// The stretches between cuts as they lie among all measured samples: each reaches to the beginning of the next.
    pub(super) fn segments(&self, seen: Vec<Range<usize>>, measured: usize) -> Vec<Range<usize>> {
        let Some(kept) = &self.kept else { return seen };
        let mut starts: Vec<usize> = seen.iter().filter_map(|s| kept.get(s.start)).map(|k| *k as usize).collect();
        match starts.first_mut() {
            Some(first) => *first = 0,
            None => return if measured > 0 { std::iter::once(0..measured).collect() } else { Vec::new() },
        }
        let ends = starts.iter().copied().skip(1).chain([measured]);
        starts.iter().copied().zip(ends).map(|(a, b)| a..b).collect()
    }

    /// The scales of [`Sight::segments`].
    pub(super) fn scales(&self, scales: Vec<Scales>, segments: usize) -> Vec<Scales> {
        if scales.len() < segments { vec![Scales::default(); segments] } else { scales }
    }

    /// What the method said of the seen samples, with an entry for each of the `y` that were measured. A multiplier that
    /// only gates is `k`; `by_calibration` is true where the calibration had a say.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub(super) fn spread(
        &self,
        said: Judged,
        y: &[f64],
        (k, by_calibration): (Option<f64>, bool),
        stop: &Stop,
    ) -> Result<Judged, Stopped> {
        let mut said = match &self.kept {
            None => said,
            Some(kept) => spread(said, kept, y.len()),
        };
        let Some(circle) = &self.circle else { return Ok(said) };
        circle.back(&mut said.expected, y);
        circle.back(&mut said.own, y);
        if by_calibration {
            // The distances on the measured values differ from those on the unwrapped ones in their last bits.
            said.scale.clear();
        } else if let Some(k) = k.filter(|_| said.scale.len() == y.len()) {
            // The multiplier is turned on the measured values: both ways give the same to the last bit.
            said.gate(y, k, stop)?;
        }
        Ok(said)
    }

    /// What the calibration has against the `n` measured samples, from what it has against the seen ones.
    pub(super) fn objections(&self, seen: &Arc<[noise::Objection]>, n: usize) -> Arc<[noise::Objection]> {
        match &self.kept {
            None => Arc::clone(seen),
            Some(kept) => over(seen, kept, n, noise::Objection::default()).into(),
        }
    }

    /// The verdicts of the samples that the method does not see.
    pub(super) fn unseen(&self) -> Vec<(u32, Verdict)> {
        self.findings.iter().map(|f| (f.position, f.verdict)).collect()
    }

    /// What the method said of the seen samples of a stretch, from what it is spread over the measured ones `y`.
    pub(super) fn gathered(&self, part: &Part<'_>, range: &Range<usize>, y: &[f64]) -> Option<Gathered> {
        if self.kept.is_none() && self.circle.is_none() {
            return None;
        }
        let all: Vec<u32> = match &self.kept {
            Some(kept) => kept[self.seen_range(range)].to_vec(),
            #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
            None => range.clone().map(|i| i as u32).collect(),
        };
        let at = |i: &u32| *i as usize - range.start;
        let shift = |i: &u32| self.circle.as_ref().map_or(0.0, |c| c.unwrapped[*i as usize] - y[*i as usize]);
        let numbers = |values: &[f64]| all.iter().filter_map(|i| values.get(at(i)).map(|v| v + shift(i))).collect();
        Some(Gathered {
            verdict: all.iter().filter_map(|i| part.verdict.get(at(i)).copied()).collect(),
            expected: numbers(part.expected),
            repair_code: all.iter().filter_map(|i| part.repair_code.get(at(i)).copied()).collect(),
            own: numbers(part.own),
        })
    }
}

/// [`Part`] of the samples that the method sees.
#[derive(Debug)]
pub(super) struct Gathered {
    verdict: Vec<Verdict>,
    expected: Vec<f64>,
    repair_code: Vec<[u8; 2]>,
    own: Vec<f64>,
}

impl Gathered {
    pub(super) fn part(&self) -> Part<'_> {
        Part { verdict: &self.verdict, expected: &self.expected, repair_code: &self.repair_code, own: &self.own }
    }
}

fn is_taught(taught: &Taught, row: usize, ruling: Ruling) -> bool {
    let Ok(row) = u32::try_from(row) else { return false };
    taught.binary_search_by_key(&row, |lesson| lesson.row).is_ok_and(|at| taught[at].ruling == ruling)
}

#[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
fn finding(objection: Objection, check: usize) -> Finding {
    let Objection { position, verdict, .. } = objection;
    Finding { position: position as u32, verdict, by: By::Check(check, objection) }
}

/// Positions of `0 .. n` that no finding is about.
#[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
fn others(n: usize, findings: &[Finding]) -> Vec<u32> {
    let mut findings = findings.iter().map(|f| f.position).peekable();
    (0..n as u32).filter(|i| findings.next_if_eq(i).is_none()).collect()
}

/// What one check objects to among the samples that are left, in positions of all. `companions` are the values of the
/// channels that it names, at all samples.
fn objections(
    (measured, kept): (&Series<'_>, Option<&[u32]>),
    companions: &[Vec<f64>],
    applied: &Applied,
    period: Option<f64>,
    stop: &Stop,
) -> Result<Vec<Objection>, Stopped> {
    let left = measured.seen(kept, None);
    let of_left = |all: &Vec<f64>| match kept {
        Some(kept) => kept.iter().filter_map(|i| all.get(*i as usize).copied()).collect(),
        None => all.clone(),
    };
    let channels: Vec<Vec<f64>> = companions.iter().map(of_left).collect();
    let subject = Subject { t: &left.t, y: &left.y, period, channels: &channels };
    let mut found = applied.check.examine(&subject, &applied.settings, stop)?;
    if let Some(kept) = kept {
        found.iter_mut().for_each(|o| o.position = kept[o.position] as usize);
    }
    Ok(found)
}

/// Values of the samples at `kept`, with `nothing` for the others of all `n`; none where there are none.
fn over<T: Copy>(values: &[T], kept: &[u32], n: usize, nothing: T) -> Vec<T> {
    if values.is_empty() {
        return Vec::new();
    }
    let mut all = vec![nothing; n];
    kept.iter().zip(values).for_each(|(at, value)| all[*at as usize] = *value);
    all
}

/// A judgement of the samples at `kept` as one of all `n` samples: nothing is said of the others.
fn spread(said: Judged, kept: &[u32], n: usize) -> Judged {
    let nan = |values: &[f64]| over(values, kept, n, f64::NAN);
    let mut all = Judged {
        verdict: over(&said.verdict, kept, n, Verdict::Unchecked),
        expected: nan(&said.expected),
        tolerance: nan(&said.tolerance),
        scale: nan(&said.scale),
        directions: over(&said.directions, kept, n, Directions { forward: None, backward: None }),
        repair_code: over(&said.repair_code, kept, n, [0, 0]),
        own: nan(&said.own),
        restarts: said.restarts.iter().map(|r| Restart { at: kept[r.at] as usize, ..*r }).collect(),
        warnings: said.warnings,
    };
    if said.verdict.is_empty() {
        all = Judged { warnings: all.warnings, ..Judged::unchecked(n) };
    }
    all
}
