//! From a plan to its result: detect, let the analyst's decisions win, repair what is left, fill gaps.

use std::ops::Range;
use std::sync::Arc;

use crate::error::{Error, Result};
use crate::math::pieces::{self, PIECE};
use crate::method::noise::{self, Scales};
use crate::method::{Damaged, Gated, Judged, Rate, Segment, Together, Verdict, judge_segments, segments};
use crate::repair::{self, Damage, Gap};
use crate::review::{Decision, Decisions};
use crate::series::Series;
use crate::setup::Setup;
use crate::stop::{Stop, Stopped};

mod gaps;
mod outcome;
mod serialize;

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

/// The samples of a channel, and those of the channel that measures its rate where the method needs one.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// The channel.
    pub series: &'a Series<'a>,
    /// The channel that measures its rate.
    pub rate: Option<&'a Series<'a>>,
}

impl<'a> From<&'a Series<'a>> for Input<'a> {
    fn from(series: &'a Series<'a>) -> Self {
        Self { series, rate: None }
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
    /// [`Error::Stopped`]; [`Error::Usage`] when the method needs a rate channel and has none.
    pub fn of(input: Input<'_>, setup: &Setup, stop: &Stop) -> Result<Self> {
        let Input { series, rate } = input;
        let about = setup.method.about();
        if about.needs_rate && rate.is_none() {
            return Err(Error::usage(
                format!("{} needs a channel that measures the rate of the first", about.id),
                "hand in the samples of that channel as the rate",
            ));
        }
        let rate = rate.map(|r| Rate { t: &r.t, y: &r.y });
        let segments = segments(series, &setup.settings, stop)?;
        let scales = noise::scales(series, &segments, &setup.settings, stop)?;
        let judged = judge_segments(setup.method, series, (&segments, &scales), rate, &setup.settings, stop)?;
        Ok(Self::new(setup.clone(), segments, scales, judged))
    }

    /// The detection under `setup` when that differs from the setup of this one in a multiplier that only gates: its
    /// scores are used again, and the result is the same to the last bit. None when the method must run again.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn regated(
        &self,
        series: &Series<'_>,
        setup: &Setup,
        stop: &Stop,
    ) -> std::result::Result<Option<Self>, Stopped> {
        let judged = regated(self, setup, series, stop)?;
        let (segments, scales) = (&self.segments, &self.scales);
        Ok(judged.map(|judged| Self {
            setup: setup.clone(),
            segments: segments.clone(),
            scales: scales.clone(),
            judged,
        }))
    }

    /// Runs a method that judges channels together ([`Method::together`](crate::method::Method::together)) over all
    /// `channels` that share `setup`; one detection for each.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn together(channels: &[&Series<'_>], setup: &Setup, stop: &Stop) -> std::result::Result<Vec<Self>, Stopped> {
        let parts = setup.method.judge_together(channels, &setup.settings, stop)?;
        let detection = |part: Together| {
            let judged = part.judged.bounded(stop)?;
            Ok(Self::new(setup.clone(), part.segments, part.scales, judged))
        };
        parts.into_iter().map(detection).collect()
    }

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
    for (index, range) in detection.segments.iter().enumerate() {
        stop.check_at(64 * index)?;
        let from = outliers.partition_point(|&i| i < range.start);
        let to = outliers.partition_point(|&i| i < range.end);
        let gap = |limit: usize| gaps.partition_point(|g| g.before < limit);
        let inside: &[GapPlaces] = &gaps[gap(range.start + 1)..gap(range.end)];
        if from < to || !inside.is_empty() {
            settled.mend(series, &detection, index, &outliers[from..to], inside, stop)?;
        }
    }
    let Settled { fixes, runs, mut fills } = settled;
    fills.sort_by_key(|f: &Fill| f.place);
    let counts = count(rows.count(), &detection, &marks, &fixes, &runs, fills.len(), stop)?;
    Ok(Outcome { detection, marks, outliers, fixes, runs, fills, counts })
}

/// What takes the place of outliers and lost samples, segment by segment.
#[derive(Debug, Default)]
struct Settled {
    fixes: Vec<f64>,
    runs: Vec<Run>,
    fills: Vec<Fill>,
}

impl Settled {
    /// Repairs the outliers and fills the gaps of the segment with this index.
    fn mend(
        &mut self,
        series: &Series<'_>,
        detection: &Detection,
        index: usize,
        outliers: &[usize],
        gaps: &[GapPlaces],
        stop: &Stop,
    ) -> std::result::Result<(), Stopped> {
        let check = || stop.check();
        let (range, setup) = (&detection.segments[index], &detection.setup);
        let local = pieces::collect(outliers.len(), &check, |i| outliers[i] - range.start)?;
        let segment = Segment::of(series, range, detection.scales[index], None);
        let own = match repair::chosen(&setup.repair).way {
            // Nobody asks for it otherwise.
            repair::Way::Own => {
                let judged = detection.judged.part(range.clone());
                let damaged = Damaged { segment: &segment, settings: &setup.settings, judged, outliers: &local };
                setup.method.own_repair(&damaged, stop)?
            }
            _ => Vec::new(),
        };
        let expected = detection.judged.expected();
        let expected = pieces::collect(local.len(), &check, |i| expected[outliers[i]])?;
        let damage = Damage { t: segment.t, y: segment.y, outliers: &local, own: &own, expected: &expected };
        self.fixes.extend(repair::repair(&damage, &setup.repair, stop)?);
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
                value,
            }));
        }
        Ok(())
    }
}

/// So many verdicts at a time are counted in a byte each, which is as quick as reading them.
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
