//! From a plan to its result: check, detect, let the analyst's decisions win, repair what is left, fill gaps.

use std::ops::Range;
use std::sync::Arc;

use crate::calibration::{Calibration, Rules, calibrate};
use crate::check;
use crate::error::{Error, Result};
use crate::math::pieces::{self, PIECE};
use crate::memory::Share;
use crate::method::noise::{self, Scales};
use crate::method::shared::DOUBT;
use crate::method::{self, Damaged, Gated, Judged, Rate, Record, Segment, Together, Verdict, judge_segments, segments};
use crate::preparation::Preparation;
use crate::repair::{self, Damage, Gap};
use crate::review::{Decision, Decisions};
use crate::series::Series;
use crate::setup::Setup;
use crate::stop::{Stop, Stopped};

mod doubts;
mod filtered;
mod gaps;
mod outcome;
mod serialize;
mod sight;
#[cfg(test)]
mod tests;

pub use filtered::filtered;
use gaps::{GapPlaces, gaps_to_fill};
pub use outcome::{Counts, Fill, Mark, Outcome, Place, Run};
use sight::{By, Sight, Taught, taught};

/// What a method says of a channel, before anybody decided anything.
#[derive(Debug, Clone)]
pub struct Detection {
    /// The setup it was made with.
    pub setup: Setup,
    /// The stretches between cuts, in positions.
    pub segments: Vec<Range<usize>>,
    /// The scales of each of them.
    pub scales: Vec<Scales>,
    /// One entry per present sample.
    pub judged: Gated,
    /// The memory that it takes.
    pub share: Arc<Share>,
    /// What the samples that the method saw were calibrated to, where the floor comes from that; one limit for each
    /// of them.
    pub calibration: Option<Arc<Calibration>>,
    /// What of the channel the method saw.
    sight: Arc<Sight>,
    /// The decisions that it was shown.
    taught: Taught,
}

/// What a [`Calibration`] found at a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoiseAt {
    /// The residual at which noise ends, in channel units; infinite where nothing is known.
    pub limit: f64,
    /// How far the sample lies outside of all that its neighbours let expect, in channel units.
    pub objection: f64,
}

/// Why the method did not see a sample.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Objected {
    /// Id of the check.
    pub by: &'static str,
    /// The evidence in a few words.
    pub evidence: String,
}

/// The samples of a channel, and those of the channel that measures its rate where the method needs one.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// The channel.
    pub series: &'a Series<'a>,
    /// The channel that measures its rate.
    pub rate: Option<&'a Series<'a>>,
    /// For each check of the setup, in its order: the values of the channels that it names, at the samples of `series`,
    /// NaN where there is none. May end early where no check names a channel.
    pub companions: &'a [Vec<Vec<f64>>],
    /// What the analyst decided, for setups under which the method learns from it.
    pub decisions: Option<&'a Decisions>,
}

impl<'a> Input<'a> {
    /// A channel without companions that is undecided.
    #[must_use]
    pub fn new(series: &'a Series<'a>, rate: Option<&'a Series<'a>>) -> Self {
        Self { series, rate, companions: &[], decisions: None }
    }

    /// The calibration of what a method sees of the channel under `preparation`: without what the checks object to, and
    /// unwrapped where the channel is circular.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn calibrated(&self, preparation: &Preparation, stop: &Stop) -> std::result::Result<Calibration, Stopped> {
        let taught = taught(preparation, self.decisions);
        let sight = Sight::of(self.series, self.companions, (preparation, &taught), stop)?;
        calibrate(&sight.series(self.series), Rules::default(), stop)
    }

    /// What of the channel the method sees.
    fn sight(&self, setup: &Setup, stop: &Stop) -> std::result::Result<(Arc<Sight>, Taught), Stopped> {
        let taught = taught(&setup.preparation, self.decisions);
        let sight = Sight::of(self.series, self.companions, (&setup.preparation, &taught), stop)?;
        Ok((Arc::new(sight), taught))
    }
}

impl<'a> From<&'a Series<'a>> for Input<'a> {
    fn from(series: &'a Series<'a>) -> Self {
        Self::new(series, None)
    }
}

/// The rows of the record that the samples of a channel were taken from.
#[derive(Debug, Clone, Copy)]
pub struct Rows<'a> {
    /// The time of every row in seconds; NaN where it has none.
    pub seconds: &'a [f64],
    /// The rows (from 0) that belong to the channel, ascending; none when all do.
    pub own: Option<&'a [u32]>,
}

impl Rows<'_> {
    /// How many rows belong to the channel.
    #[must_use]
    pub fn count(&self) -> usize {
        self.own.map_or(self.seconds.len(), <[u32]>::len)
    }
}

impl Detection {
    /// Runs the method of `setup` over a channel.
    ///
    /// # Errors
    /// [`Error::Stopped`]; [`Error::Memory`]; [`Error::Usage`] when the method needs a rate channel and has none.
    pub fn of(input: Input<'_>, setup: &Setup, stop: &Stop) -> Result<Self> {
        Self::calibrated(input, setup, None, stop)
    }

    /// [`Detection::of`] with another detection of the same channel: where its method saw the same samples, the channel
    /// is not calibrated again.
    ///
    /// # Errors
    /// As [`Detection::of`].
    pub fn calibrated(input: Input<'_>, setup: &Setup, previous: Option<&Self>, stop: &Stop) -> Result<Self> {
        let setup = &setup.at_interval(input.series.interval);
        let about = setup.method.about();
        if about.needs_rate && input.rate.is_none() {
            return Err(Error::usage(
                format!("{} needs a channel that measures the rate of the first", about.id),
                "hand in the samples of that channel as the rate",
            ));
        }
        let share = room(input.series)?;
        let sight = input.sight(setup, stop)?;
        let series = sight.0.series(input.series);
        let rate = input.rate.map(|r| Rate { t: &r.t, y: &r.y });
        let segments = segments(&series, &setup.settings, stop)?;
        let known = previous.filter(|p| p.sight.shows_the_same(&sight.0)).and_then(|p| p.calibration.clone());
        let calibration = match noise::rules(&setup.settings) {
            Some(rules) => match known.filter(|known| known.rules == rules) {
                None => Some(Arc::new(calibrate(&series, rules, stop)?)),
                known => known,
            },
            None => known,
        };
        let scales = noise::scales_by(&series, &segments, &setup.settings, calibration.as_deref(), stop)?;
        let judged = judge_segments(setup.method, &series, (&segments, &scales), rate, &setup.settings, stop)?;
        let said = Together { segments, scales, judged };
        let seen = Self::seen(setup, said, sight.clone(), input.series, stop)?;
        Ok(Self { share: kept(share), calibration, ..seen })
    }

    /// The detection under `setup` when that differs from the setup of this one in a multiplier that only gates: its
    /// scores are used again, and the result is the same to the last bit. None when the method must run again.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn regated(&self, input: Input<'_>, setup: &Setup, stop: &Stop) -> std::result::Result<Option<Self>, Stopped> {
        if self.taught != taught(&setup.preparation, input.decisions) {
            return Ok(None);
        }
        let judged = regated(self, setup, input.series, stop)?;
        let setup = setup.at_interval(input.series.interval);
        Ok(judged.map(|judged| Self { setup, judged, ..self.clone() }))
    }

    /// Runs a method that judges channels together ([`Method::together`](crate::method::Method::together)) over all
    /// `channels`, each with its setup: method and settings are those of the first. One detection for each.
    ///
    /// # Errors
    /// [`Error::Stopped`]; [`Error::Memory`].
    pub fn together(channels: &[(Input<'_>, &Setup)], stop: &Stop) -> Result<Vec<Self>> {
        let counted = |(input, setup): &(Input<'_>, &Setup)| setup.at_interval(input.series.interval);
        let setups: Vec<Setup> = channels.iter().map(counted).collect();
        let channels: Vec<(Input<'_>, &Setup)> = channels.iter().map(|c| c.0).zip(&setups).collect();
        let Some((_, first)) = channels.first() else { return Ok(Vec::new()) };
        let shares: Vec<Share> = channels.iter().map(|(input, _)| room(input.series)).collect::<Result<_>>()?;
        let sights = channels.iter().map(|(input, setup)| input.sight(setup, stop));
        let sights: Vec<(Arc<Sight>, Taught)> = sights.collect::<std::result::Result<_, Stopped>>()?;
        let seen = channels.iter().zip(&sights);
        let series: Vec<Series<'_>> = seen.map(|((input, _), (sight, _))| sight.series(input.series)).collect();
        let series: Vec<&Series<'_>> = series.iter().collect();
        let parts = first.method.judge_together(&series, &first.settings, stop)?;
        let mut found = Vec::with_capacity(parts.len());
        for (((part, (input, setup)), sight), share) in parts.into_iter().zip(&channels).zip(&sights).zip(shares) {
            let part = Together { judged: part.judged.bounded(stop)?, ..part };
            let seen = Self::seen(setup, part, sight.clone(), input.series, stop)?;
            found.push(Self { share: kept(share), ..seen });
        }
        Ok(found)
    }

    /// What a method said under `setup`.
    #[must_use]
    pub fn new(setup: Setup, segments: Vec<Range<usize>>, scales: Vec<Scales>, judged: Judged) -> Self {
        let judged = Gated::new(judged, gate_of(&setup));
        let (sight, taught) = (Arc::default(), Taught::new());
        Self { setup, segments, scales, judged, share: Arc::default(), calibration: None, sight, taught }
    }

    /// What a method said of the samples that it saw.
    fn seen(
        setup: &Setup,
        said: Together,
        (sight, taught): (Arc<Sight>, Taught),
        measured: &Series<'_>,
        stop: &Stop,
    ) -> std::result::Result<Self, Stopped> {
        let segments = sight.segments(said.segments, measured.len());
        let objections = said.scales.first().and_then(|scales| scales.objections.clone());
        let scales = sight.scales(said.scales, segments.len());
        let judged = sight.spread(said.judged, &measured.y, (gate_of(setup), objections.is_some()), stop)?;
        let found = Self::new(setup.clone(), segments, scales, judged);
        let record = objections.map(|seen| Record {
            objections: sight.objections(&seen, measured.len()),
            doubt: setup.settings.real(DOUBT.key),
        });
        let judged = found.judged.with_record(record).with_unseen(sight.unseen());
        Ok(Self { judged, sight, taught, ..found })
    }

    /// The same detection under a setup that differs in the repair alone.
    #[must_use]
    pub fn with_repair(&self, setup: &Setup) -> Self {
        let interval = self.setup.settings.interval().unwrap_or(f64::NAN);
        Self { setup: setup.at_interval(interval), ..self.clone() }
    }

    /// True when it is what [`Detection::of`] would find under this setup with these decisions, but for the repair.
    #[must_use]
    pub fn holds_for(&self, setup: &Setup, decisions: &Decisions) -> bool {
        self.setup.same_detection(setup) && self.taught == taught(&setup.preparation, Some(decisions))
    }

    /// What the calibration found at the sample at `position`; none where there is no calibration, or where the method
    /// does not see the sample.
    #[must_use]
    pub fn noise_at(&self, position: usize) -> Option<NoiseAt> {
        let calibration = self.calibration.as_ref()?;
        let at = self.sight.seen(position)?;
        Some(NoiseAt { limit: *calibration.limits.get(at)?, objection: *calibration.objections.get(at)? })
    }

    /// The check that objects to the sample at `position`, with its evidence; none where none does.
    #[must_use]
    pub fn objected(&self, position: usize) -> Option<Objected> {
        let By::Check(index, objection) = self.sight.finding(position)?.by else { return None };
        let check = self.setup.preparation.checks.get(index)?.check;
        Some(Objected { by: check.about().id, evidence: check.evidence(&objection) })
    }

    /// Who judged the sample at `position`: the id of the check that objects to it, otherwise of the method.
    #[must_use]
    pub fn by(&self, position: usize) -> &'static str {
        self.objected(position).map_or(self.setup.method.about().id, |objected| objected.by)
    }

    /// Positions of the samples that a check objects to, ascending.
    pub fn checked(&self) -> impl Iterator<Item = usize> + '_ {
        self.sight.findings.iter().filter(|f| matches!(f.by, By::Check(..))).map(|f| f.position as usize)
    }

    /// What checks object to: the index of the check in the plan, and its verdict, by position.
    pub fn objections(&self) -> impl Iterator<Item = (usize, Verdict)> + '_ {
        self.sight.findings.iter().filter_map(|f| match f.by {
            By::Check(check, _) => Some((check, f.verdict)),
            By::Analyst => None,
        })
    }

    /// A value of the method's scale as the record writes it: on a circular channel within one period.
    #[must_use]
    pub fn written(&self, value: f64) -> f64 {
        self.sight.written(value)
    }
}

/// The multiplier that only gates.
fn gate_of(setup: &Setup) -> Option<f64> {
    setup.method.gate(&setup.settings).map(|key| setup.settings.real(key))
}

/// Bytes that a method takes for each sample while it works, and of those what it keeps: verdict, expected value,
/// tolerance, and what a repair of its own has to know.
const OF_SAMPLE: u64 = 100;
const KEPT_OF_SAMPLE: u64 = 32;

/// The memory to judge a series.
fn room(series: &Series<'_>) -> Result<Share> {
    let share = Share::of((series.len() as u64).saturating_mul(OF_SAMPLE));
    share.map_err(|full| Error::Memory { subject: format!("judging {} samples", series.len()), full })
}

/// What is kept of it.
fn kept(mut share: Share) -> Arc<Share> {
    // Less than before is never refused.
    let _ = share.set(share.bytes() / OF_SAMPLE * KEPT_OF_SAMPLE);
    Arc::new(share)
}

/// The judgement under `setup` when it differs from that of `previous` in the gate alone.
fn regated(
    previous: &Detection,
    setup: &Setup,
    series: &Series<'_>,
    stop: &Stop,
) -> std::result::Result<Option<Gated>, Stopped> {
    let Some((key, value)) = setup.method.gate(&setup.settings).and_then(|key| Some((key, setup.settings.get(key)?)))
    else {
        return Ok(None);
    };
    let mut same = previous.setup.settings.clone();
    let comparable = same.set(key, key, value).is_ok()
        && previous.setup.method.about().id == setup.method.about().id
        && same == setup.settings
        && previous.setup.preparation == setup.preparation
        && previous.setup.rate == setup.rate;
    if comparable { previous.judged.regated(&series.y, setup.settings.real(key), stop) } else { Ok(None) }
}

/// Lets the decisions win over the detection, repairs the outliers that hold, and fills gaps.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn settle(
    series: &Series<'_>,
    rows: Rows<'_>,
    detection: Arc<Detection>,
    decisions: &Decisions,
    stop: &Stop,
) -> std::result::Result<Outcome, Stopped> {
    let marks = marks(detection.judged.verdict(), series, decisions, stop)?;
    let outlier = |mark: &Mark| (mark.effective() == Verdict::Outlier).then_some(mark.position as usize);
    let of = |piece: Range<usize>| marks[piece].iter().filter_map(outlier).collect::<Vec<usize>>();
    let outliers = pieces::map(marks.len(), &|| stop.check(), of)?.concat();
    let gaps = gaps_to_fill(rows, series, &detection, stop)?;
    let mut settled = Settled { fixes: Vec::with_capacity(outliers.len()), ..Settled::default() };
    let seen = Seen { measured: series, series: detection.sight.series(series), detection: &detection };
    for (index, range) in detection.segments.iter().enumerate() {
        stop.check_at(64 * index)?;
        let from = outliers.partition_point(|&i| i < range.start);
        let to = outliers.partition_point(|&i| i < range.end);
        let gap = |limit: usize| gaps.partition_point(|g| g.before < limit);
        let inside: &[GapPlaces] = &gaps[gap(range.start + 1)..gap(range.end)];
        if from < to || !inside.is_empty() {
            settled.mend(&seen, index, &outliers[from..to], inside, stop)?;
        }
    }
    let Settled { fixes, runs, mut fills, notes } = settled;
    fills.sort_by_key(|f: &Fill| f.place);
    let mut counts = count(rows.count(), &detection, &marks, &fixes, &runs, fills.len(), stop)?;
    counts.by_checks = detection.checked().filter(|position| outliers.binary_search(position).is_ok()).count();
    drop(seen);
    let doubts = doubts::doubts(&detection, &counts);
    Ok(Outcome { detection, marks, outliers, fixes, runs, fills, counts, doubts, notes })
}

/// What a method's own repair puts in, and what should be known of it.
#[derive(Debug, Default)]
struct OwnRepair {
    values: Vec<f64>,
    notes: Vec<String>,
}

/// A channel as it was measured and as its method saw it.
struct Seen<'a> {
    measured: &'a Series<'a>,
    series: Series<'a>,
    detection: &'a Detection,
}

impl Seen<'_> {
    /// What the method's own repair puts in place of `outliers` of the segment with this index, and for those that the
    /// method did not see, what the check does that objects to them.
    fn own_repair(&self, index: usize, outliers: &[usize], stop: &Stop) -> std::result::Result<OwnRepair, Stopped> {
        let Self { measured, series, detection } = self;
        let (range, setup, sight) = (&detection.segments[index], &detection.setup, &detection.sight);
        let seen_range = sight.seen_range(range);
        let judged = detection.judged.part(range.clone());
        let gathered = sight.gathered(&judged, range, &measured.y);
        let places: Vec<Option<usize>> = outliers.iter().map(|&o| sight.seen(o)).collect();
        let local: Vec<usize> = places.iter().flatten().map(|place| place - seen_range.start).collect();
        let mut own = Vec::new();
        let mut notes = Vec::new();
        if !seen_range.is_empty() {
            let segment = Segment::of(series, &seen_range, &detection.scales[index], None);
            let judged = gathered.as_ref().map_or(judged, sight::Gathered::part);
            let settings = &setup.settings.at_interval(segment.interval);
            let damaged = Damaged { segment: &segment, settings, judged, outliers: &local };
            own = setup.method.own_repair(&damaged, stop)?;
            notes = setup.method.own_notes(&damaged);
        }
        if local.len() == outliers.len() {
            return Ok(OwnRepair { values: own, notes });
        }
        let line = self.line(range, outliers, stop)?;
        let mut own = own.into_iter();
        let value = |(i, place): (usize, &Option<usize>)| match place {
            Some(_) => own.next().unwrap_or(f64::NAN),
            None if detection.draws_line(outliers[i]) => line[i],
            None => f64::NAN,
        };
        Ok(OwnRepair { values: places.iter().enumerate().map(value).collect(), notes })
    }

    /// The line between the accepted samples on both sides of each of `outliers`.
    fn line(&self, range: &Range<usize>, outliers: &[usize], stop: &Stop) -> std::result::Result<Vec<f64>, Stopped> {
        let local: Vec<usize> = outliers.iter().map(|o| o - range.start).collect();
        let y = &self.detection.sight.values(self.measured)[range.clone()];
        let t = &self.measured.t[range.clone()];
        repair::line(&Damage { t, y, outliers: &local, own: &[], expected: &[] }, stop)
    }
}

impl Detection {
    /// True when `own` repair puts the line between its neighbours in place of a sample that the method did not see.
    fn draws_line(&self, position: usize) -> bool {
        match self.sight.finding(position).map(|f| f.by) {
            Some(By::Check(index, _)) => {
                let applied = self.setup.preparation.checks.get(index);
                applied.is_some_and(|applied| applied.check.about().own == check::Own::Line)
            }
            Some(By::Analyst) => self.setup.method.about().own == method::Own::Expected,
            None => false,
        }
    }
}

/// What takes the place of outliers and lost samples, segment by segment.
#[derive(Debug, Default)]
struct Settled {
    fixes: Vec<f64>,
    runs: Vec<Run>,
    fills: Vec<Fill>,
    /// What should be known of repairs.
    notes: Vec<String>,
}

impl Settled {
    /// Repairs the outliers and fills the gaps of the segment with this index.
    fn mend(
        &mut self,
        seen: &Seen<'_>,
        index: usize,
        outliers: &[usize],
        gaps: &[GapPlaces],
        stop: &Stop,
    ) -> std::result::Result<(), Stopped> {
        let check = || stop.check();
        let (detection, sight) = (seen.detection, &seen.detection.sight);
        let (range, setup) = (&detection.segments[index], &detection.setup);
        let local = pieces::collect(outliers.len(), &check, |i| outliers[i] - range.start)?;
        let own = match repair::chosen(&setup.repair).way {
            // Nobody asks for it otherwise.
            repair::Way::Own => seen.own_repair(index, outliers, stop)?,
            _ => OwnRepair::default(),
        };
        self.notes.extend(own.notes);
        let (values, measured) = (sight.values(seen.measured), &seen.measured.y);
        let expected = detection.judged.expected();
        let expected =
            pieces::collect(local.len(), &check, |i| sight.unwrapped(expected[outliers[i]], outliers[i], measured))?;
        let (t, y) = (&seen.measured.t[range.clone()], &values[range.clone()]);
        let damage = Damage { t, y, outliers: &local, own: &own.values, expected: &expected };
        let fixes = repair::repair(&damage, &setup.repair, stop)?;
        self.fixes.extend(fixes.into_iter().map(|fix| sight.written(fix)));
        self.runs.extend(repair::runs(&local).map(|r| Run { start: range.start + local[r.start], length: r.len() }));
        let holes: Vec<Gap> = gaps
            .iter()
            .map(|g| Gap { before: g.before - range.start, at: g.at.iter().map(|a| a.1).collect() })
            .collect();
        for (gap, values) in gaps.iter().zip(repair::fill(&damage, &holes, &setup.repair, stop)?) {
            let values = values.unwrap_or_default();
            self.fills.extend(gap.at.iter().zip(values).map(|(&(place, seconds), value)| Fill {
                place,
                seconds,
                value: sight.written(value),
            }));
        }
        Ok(())
    }
}

/// This many verdicts at a time are counted in a byte each, which is as quick as reading them.
const STRIDE: usize = 64;

/// How many of at most 255 verdicts are wanted.
fn holds(verdict: &[Verdict], wanted: impl Fn(Verdict) -> bool) -> u8 {
    verdict.iter().map(|v| u8::from(wanted(*v))).fold(0, u8::wrapping_add)
}

fn marks(
    verdict: &[Verdict],
    series: &Series<'_>,
    decisions: &Decisions,
    stop: &Stop,
) -> std::result::Result<Vec<Mark>, Stopped> {
    let flags = |v: Verdict| (v == Verdict::Outlier) | (v == Verdict::Suspect);
    let decided = |(row, d): (u32, &Decision)| series.position(row as usize).map(|p| (p, d.ruling, d.said));
    let mut decided = decisions.iter().filter_map(decided).peekable();
    let mut marks = Vec::new();
    for (chunk, part) in verdict.chunks(STRIDE).enumerate() {
        let first = chunk * STRIDE;
        if first.is_multiple_of(PIECE) {
            stop.check()?;
        }
        // Most samples are normal and undecided.
        if holds(part, flags) == 0 && decided.peek().is_none_or(|d| d.0 >= first + part.len()) {
            continue;
        }
        #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
        for (i, &verdict) in (first..).zip(part) {
            let decision = decided.next_if(|d| d.0 == i);
            if decision.is_some() || flags(verdict) {
                let (ruling, said) = (decision.map(|d| d.1), decision.and_then(|d| d.2));
                marks.push(Mark { position: i as u32, verdict, ruling, said });
            }
        }
    }
    Ok(marks)
}

fn count(
    rows: usize,
    detection: &Detection,
    marks: &[Mark],
    fixes: &[f64],
    runs: &[Run],
    filled: usize,
    stop: &Stop,
) -> std::result::Result<Counts, Stopped> {
    let verdict = detection.judged.verdict();
    let unchecked = |part: &[Verdict]| usize::from(holds(part, |v| v == Verdict::Unchecked));
    let unchecked = |piece: Range<usize>| verdict[piece].chunks(STRIDE).map(unchecked).sum::<usize>();
    let unchecked: usize = pieces::map(verdict.len(), &|| stop.check(), unchecked)?.into_iter().sum();
    let decided_unchecked = marks.iter().filter(|m| m.verdict == Verdict::Unchecked).count();
    let removed = fixes.iter().filter(|v| v.is_nan()).count();
    let isolated = runs.iter().filter(|r| r.length == 1).count();
    Ok(Counts {
        by_checks: 0,
        rows,
        present: verdict.len(),
        missing: rows - verdict.len(),
        flagged: fixes.len(),
        isolated,
        patches: runs.len() - isolated,
        suspects: marks.iter().filter(|m| m.effective() == Verdict::Suspect).count(),
        unchecked: unchecked - decided_unchecked,
        repaired: fixes.len() - removed,
        removed,
        filled,
        decisions: marks.iter().filter(|m| m.ruling.is_some()).count(),
        conflicts: marks.iter().filter(|m| m.conflict()).count(),
    })
}
