//! A track that a session was applied to.

use super::digest::{Summary, digest_of};
use super::{Prepare, Rows};
use crate::error::Result;
use crate::method::Verdict;
use crate::session::flags::{Evidence, evidence};
use crate::session::table::walks;
use crate::session::{Analysed, Place, Session};
use crate::stop::Stop;
use crate::track::{Reading, Track};

/// A track with its verdicts and repairs.
#[derive(Debug)]
pub struct Judged {
    id: String,
    track: Track,
    session: Session,
    analysed: Analysed,
    /// The moments of the rows as they are judged.
    moments: Vec<i64>,
    /// For each of them the row (from 0) that was handed over; none where the order is the same.
    order: Option<Vec<u32>>,
}

/// What holds for the rows of a channel, in the order in which they were handed over.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    /// What is said of each row.
    pub verdicts: Vec<Verdict>,
    /// The cleaned values, with all their digits; NaN where there is none.
    pub clean: Vec<f64>,
}

/// What the method expected of the rows of a channel, in the order in which they were handed over.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimates {
    /// Expected values; NaN where there is none.
    pub expected: Vec<f64>,
    /// Largest deviations that are not flagged; NaN where there is none.
    pub tolerance: Vec<f64>,
}

/// A sample that is not normal, or that somebody decided on.
#[derive(Debug, Clone)]
pub struct Flag {
    /// Index of its channel among those of the session.
    pub channel: usize,
    /// Row (from 0) that was handed over.
    pub row: usize,
    /// What is known of it; rows are those that were handed over, from 1.
    pub evidence: Evidence,
    /// Id of the method or the check that flagged it; empty where none did.
    pub by: String,
    /// The expected value as the channel counts it.
    pub expected: Option<f64>,
}

impl Judged {
    pub(super) fn of(
        rows: Rows,
        mut session: Session,
        order: Option<Vec<u32>>,
        (missing, prepare): (&Reading, &Prepare),
    ) -> Result<Self> {
        let Rows { track: id, moments, channels, .. } = rows;
        let track = Track::of_columns("time", moments.clone(), channels, missing);
        prepare.complete(&mut session, &track)?;
        let analysed = Analysed::of(&session, &track, &Stop::never())?;
        Ok(Self { id, track, session, analysed, moments, order })
    }

    /// Names of the channels, in the order of the session.
    pub fn channels(&self) -> impl ExactSizeIterator<Item = &str> {
        self.session.plans.iter().map(|plan| plan.channel.as_str())
    }

    /// What holds for the rows of a channel.
    #[must_use]
    pub fn samples(&self, channel: usize) -> Samples {
        self.in_given_order(self.in_order_of_time(channel))
    }

    fn in_order_of_time(&self, plan: usize) -> Samples {
        let (index, present, outcome) = &self.analysed.channels[plan];
        let channel = &self.track.channels[*index];
        let series = present.series(channel, &self.track.time);
        let mut samples =
            Samples { verdicts: vec![Verdict::Missing; self.moments.len()], clean: channel.values.clone() };
        for (position, verdict) in outcome.detection.judged.verdict().iter().enumerate() {
            samples.verdicts[series.row(position)] = *verdict;
        }
        for mark in &outcome.marks {
            samples.verdicts[series.row(mark.position as usize)] = mark.effective();
        }
        for (position, fix) in outcome.outliers.iter().zip(&outcome.fixes) {
            samples.clean[series.row(*position)] = *fix;
        }
        // As in a cleaned file with filtered values.
        let filtered = self.analysed.filtered_of(plan).map_or(&[][..], |f| &f.value);
        for (position, value) in filtered.iter().enumerate().filter(|(_, value)| value.is_finite()) {
            samples.clean[series.row(position)] = *value;
        }
        for fill in &outcome.fills {
            if let Place::Cell(row) = fill.place {
                samples.clean[row] = fill.value;
            }
        }
        samples
    }

    /// What the method expected of the rows of a channel, in the order in which they were handed over.
    #[must_use]
    pub fn estimates(&self, channel: usize) -> Estimates {
        let (index, present, outcome) = &self.analysed.channels[channel];
        let series = present.series(&self.track.channels[*index], &self.track.time);
        let mut estimates =
            Estimates { expected: vec![f64::NAN; self.moments.len()], tolerance: vec![f64::NAN; self.moments.len()] };
        let detection = &outcome.detection;
        for (position, expected) in detection.judged.expected().iter().enumerate() {
            let row = self.given(series.row(position));
            estimates.expected[row] = detection.written(*expected);
            estimates.tolerance[row] = detection.judged.tolerance(position).unwrap_or(f64::NAN);
        }
        estimates
    }

    /// Warnings about a channel, one line each.
    #[must_use]
    pub fn warnings(&self, channel: usize) -> Vec<String> {
        self.analysed.channels[channel].2.warnings()
    }

    fn in_given_order(&self, samples: Samples) -> Samples {
        let Some(order) = &self.order else { return samples };
        let mut given = samples.clone();
        for (at, row) in order.iter().enumerate() {
            given.verdicts[*row as usize] = samples.verdicts[at];
            given.clean[*row as usize] = samples.clean[at];
        }
        given
    }

    /// The row that was handed over for a row that is judged.
    fn given(&self, row: usize) -> usize {
        self.order.as_ref().map_or(row, |order| order[row] as usize)
    }

    /// The rows of the audit table, in the order of time and of the session.
    #[must_use]
    pub fn flags(&self) -> Vec<Flag> {
        let mut walks = walks(&self.track, &self.session, &self.analysed);
        let mut flags = Vec::new();
        for row in 0..self.moments.len() {
            for (channel, walk) in walks.iter_mut().enumerate() {
                let Some(position) = walk.position(row) else { continue };
                let Some(mut evidence) = evidence(&self.session, walk, row, position) else { continue };
                evidence.row = self.given(row) + 1;
                if let Some(run) = &mut evidence.run {
                    run.start = self.given(run.start - 1) + 1;
                }
                let detection = &walk.outcome.detection;
                let by = detection.by(position).to_owned();
                let expected = evidence.expected.map(|value| detection.written(value));
                flags.push(Flag { channel, row: self.given(row), evidence, by, expected });
            }
        }
        flags
    }

    /// Counts and digest of a channel.
    #[must_use]
    pub fn summary(&self, channel: usize) -> Summary {
        let (index, _, outcome) = &self.analysed.channels[channel];
        let samples = self.in_order_of_time(channel);
        Summary {
            track: self.id.clone(),
            channel: self.session.plans[channel].channel.clone(),
            counts: outcome.counts,
            digest: digest_of(&self.moments, &self.track.channels[*index].values, &samples),
        }
    }
}
