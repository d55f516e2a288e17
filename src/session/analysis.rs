//! From a plan to its result: detect, let the analyst's decisions win, repair what is left, fill gaps.

use std::ops::Range;
use std::sync::Arc;

use super::Setup;
use crate::error::{Error, Result};
use crate::method::noise::{self, Scales};
use crate::method::{Gated, Judged, Rate, Segment, Together, Verdict, judge_segments, segments};
use crate::repair::{self, Damage, Gap};
use crate::review::{Decision, Decisions};
use crate::stop::{Stop, Stopped};
use crate::track::{Channel, Samples, Series, Track};

mod gaps;
mod outcome;

use gaps::{GapPlaces, gaps_to_fill};
pub use outcome::{Counts, Fill, Mark, Outcome, Place, Run};

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
}

/// Runs the method of `setup` over a channel. With `previous`, a detection of the same channel that differs in a
/// multiplier that only gates, its scores are used again; the result is the same to the last bit.
///
/// # Errors
/// [`Error::Stopped`]; [`Error::Usage`] when the method needs a rate channel and has none.
pub fn detect(
    track: &Track,
    channel: &Channel,
    samples: &Samples,
    setup: &Setup,
    previous: Option<&Detection>,
    stop: &Stop,
) -> Result<Detection> {
    let series = samples.series(channel, &track.time);
    if let Some(previous) = previous
        && let Some(judged) = regated(previous, setup, &series)
    {
        let (segments, scales) = (previous.segments.clone(), previous.scales.clone());
        return Ok(Detection { setup: setup.clone(), segments, scales, judged });
    }
    let rate = rate_channel(track, channel, setup)?.map(|c| Series::of(c, &track.time));
    let rate = rate.as_ref().map(|r| Rate { t: &r.t, y: &r.y });
    let segments = segments(&series, &setup.settings);
    stop.check()?;
    let scales = noise::scales(&series, &segments, &setup.settings);
    let judged = judge_segments(setup.method, &series, (&segments, &scales), rate, &setup.settings, stop)?;
    Ok(Detection::new(setup.clone(), segments, scales, judged))
}

impl Detection {
    /// What a method said under `setup`.
    #[must_use]
    pub fn new(setup: Setup, segments: Vec<Range<usize>>, scales: Vec<Scales>, judged: Judged) -> Self {
        let k = setup.method.gate(&setup.settings).map(|key| setup.settings.real(key));
        Self { setup, segments, scales, judged: Gated::new(judged, k) }
    }

    /// The same detection under a setup that differs in the repair alone.
    #[must_use]
    pub fn with_repair(&self, setup: &Setup) -> Self {
        Self { setup: setup.clone(), ..self.clone() }
    }
}

fn rate_channel<'a>(track: &'a Track, channel: &Channel, setup: &Setup) -> Result<Option<&'a Channel>> {
    let id = setup.method.about().id;
    if !setup.method.about().needs_rate {
        return Ok(None);
    }
    let names = || track.channels.iter().map(|c| c.name.as_str()).collect::<Vec<_>>().join(", ");
    let Some(name) = &setup.rate else {
        return Err(Error::usage(
            format!("{id} needs a channel that measures the rate of the first"),
            format!("name it with --rate, or in the workbench at `rate` (3); channels: {}", names()),
        ));
    };
    let found = track.beside(channel, name);
    found.map(Some).ok_or_else(|| {
        Error::usage(format!("{name}: there is no such channel for the rate"), format!("channels: {}", names()))
    })
}

/// The judgement under `setup` when it differs from that of `previous` in the gate alone.
fn regated(previous: &Detection, setup: &Setup, series: &Series<'_>) -> Option<Gated> {
    let key = setup.method.gate(&setup.settings)?;
    let mut same = previous.setup.settings.clone();
    same.set(key, key, setup.settings.get(key)?).ok()?;
    let comparable = previous.setup.method.about().id == setup.method.about().id
        && same == setup.settings
        && previous.setup.rate == setup.rate;
    comparable.then(|| previous.judged.regated(&series.y, setup.settings.real(key))).flatten()
}

/// Runs a method that judges channels together ([`Method::together`](crate::method::Method::together)) over all
/// `channels` that share `setup`; one detection for each.
///
/// # Errors
/// [`Error::Stopped`].
pub fn detect_together(
    track: &Track,
    channels: &[(&Channel, &Samples)],
    setup: &Setup,
    stop: &Stop,
) -> Result<Vec<Detection>> {
    let series: Vec<Series<'_>> =
        channels.iter().map(|(channel, samples)| samples.series(channel, &track.time)).collect();
    let series: Vec<&Series<'_>> = series.iter().collect();
    let parts = setup.method.judge_together(&series, &setup.settings, stop)?;
    let detection = |part: Together| Detection::new(setup.clone(), part.segments, part.scales, part.judged.bounded());
    Ok(parts.into_iter().map(detection).collect())
}

/// Lets the decisions win over the detection, repairs the outliers that hold, and fills gaps.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn settle(
    track: &Track,
    channel: &Channel,
    samples: &Samples,
    detection: Arc<Detection>,
    decisions: &Decisions,
    stop: &Stop,
) -> std::result::Result<Outcome, Stopped> {
    let series = samples.series(channel, &track.time);
    let marks = marks(detection.judged.verdict(), &series, decisions);
    let outliers: Vec<usize> =
        marks.iter().filter(|m| m.effective() == Verdict::Outlier).map(|m| m.position as usize).collect();
    let mut fixes = Vec::with_capacity(outliers.len());
    let mut runs = Vec::new();
    let mut fills = Vec::new();
    let gaps = gaps_to_fill(track, channel, &series, &detection);
    for (range, scales) in detection.segments.iter().zip(&detection.scales) {
        stop.check()?;
        let from = outliers.partition_point(|&i| i < range.start);
        let to = outliers.partition_point(|&i| i < range.end);
        let gap = |limit: usize| gaps.partition_point(|g| g.before < limit);
        let inside: &[GapPlaces] = &gaps[gap(range.start + 1)..gap(range.end)];
        if from == to && inside.is_empty() {
            continue;
        }
        let local: Vec<usize> = outliers[from..to].iter().map(|i| i - range.start).collect();
        let segment = Segment::of(&series, range, *scales, None);
        let part = detection.judged.slice(range.clone());
        let own = detection.setup.method.own_repair(&segment, &detection.setup.settings, &part, &local);
        let expected: Vec<f64> = local.iter().map(|&i| detection.judged.expected()[range.start + i]).collect();
        let damage = Damage { t: segment.t, y: segment.y, outliers: &local, own: &own, expected: &expected };
        fixes.extend(repair::repair(&damage, &detection.setup.repair));
        runs.extend(repair::runs(&local).map(|r| Run { start: range.start + local[r.start], length: r.len() }));
        let holes: Vec<Gap> = inside
            .iter()
            .map(|g| Gap { before: g.before - range.start, at: g.at.iter().map(|a| a.1).collect() })
            .collect();
        for (gap, values) in inside.iter().zip(repair::fill(&damage, &holes, &detection.setup.repair)) {
            let values = values.unwrap_or_default();
            fills.extend(gap.at.iter().zip(values).map(|(&(place, seconds), value)| Fill { place, seconds, value }));
        }
    }
    fills.sort_by_key(|f: &Fill| f.place);
    let counts = count(channel.rows(track), &detection, &marks, &fixes, &runs, fills.len());
    Ok(Outcome { detection, marks, outliers, fixes, runs, fills, counts })
}

/// So many verdicts at a time are counted in a byte each, which is as quick as reading them.
const STRIDE: usize = 64;

/// How many of at most 255 verdicts are wanted.
fn holds(verdict: &[Verdict], wanted: impl Fn(Verdict) -> bool) -> u8 {
    verdict.iter().map(|v| u8::from(wanted(*v))).fold(0, u8::wrapping_add)
}

fn marks(verdict: &[Verdict], series: &Series<'_>, decisions: &Decisions) -> Vec<Mark> {
    let flags = |v: Verdict| (v == Verdict::Outlier) | (v == Verdict::Suspect);
    let decided = |(row, d): (u32, &Decision)| series.position(row as usize).map(|p| (p, d.ruling, d.said));
    let mut decided = decisions.iter().filter_map(decided).peekable();
    let mut marks = Vec::new();
    for (chunk, part) in verdict.chunks(STRIDE).enumerate() {
        let first = chunk * STRIDE;
        // Most samples are normal and nobody decided on them.
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
    marks
}

fn count(rows: usize, detection: &Detection, marks: &[Mark], fixes: &[f64], runs: &[Run], filled: usize) -> Counts {
    let verdict = detection.judged.verdict();
    let unchecked = |part: &[Verdict]| usize::from(holds(part, |v| v == Verdict::Unchecked));
    let unchecked: usize = verdict.chunks(STRIDE).map(unchecked).sum();
    let decided_unchecked = marks.iter().filter(|m| m.verdict == Verdict::Unchecked).count();
    let removed = fixes.iter().filter(|v| v.is_nan()).count();
    let isolated = runs.iter().filter(|r| r.length == 1).count();
    Counts {
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
    }
}
