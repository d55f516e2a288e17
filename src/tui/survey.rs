//! All channels judged one after the other in the background, for the overview of them.

use std::sync::Arc;

use crossbeam_channel::Sender;
use rayon::prelude::*;

use super::jobs::Judge;
use super::message::Message;
use super::model::Model;
use super::plot::FlagState;
use crate::error::{Error, Result};
use crate::job::Worker;
use crate::plot::{Drawn, Sparkline, state};
use crate::session::Counts;
use crate::stop::Stop;
use crate::track::Series;

/// Columns of a sparkline as it is kept; a narrower one is made from them.
const COLUMNS: usize = 64;

/// Channels that are judged at once: enough for the threads there are, and few enough for the rows on the screen to
/// come first.
const AT_ONCE: usize = 8;

/// What the overview tells of a channel.
#[derive(Debug, Clone, PartialEq)]
pub struct ChannelSummary {
    /// The counts of its result.
    pub counts: Counts,
    /// How many flags there are in each state, by [`FlagState::index`].
    pub by_state: [usize; FlagState::ALL.len()],
    /// The largest distance of an undecided sample from what is expected, in tolerances; none where no
    /// such sample is flagged or suspect.
    pub worst: Option<f64>,
    /// The record in a few columns.
    pub sparkline: Sparkline,
    /// Rows (from 0) of the undecided outliers.
    pub undecided: Vec<u32>,
}

impl ChannelSummary {
    /// The summary of a result.
    #[must_use]
    pub fn of(drawn: &Drawn, series: &Series<'_>) -> Self {
        let outcome = &drawn.outcome;
        let judged = &outcome.detection.judged;
        let flags: Vec<(u32, FlagState)> =
            outcome.marks.iter().filter_map(|mark| Some((mark.position, state(mark)?))).collect();
        let mut by_state = [0; FlagState::ALL.len()];
        flags.iter().for_each(|(_, state)| by_state[state.index()] += 1);
        let of = |wanted: &[FlagState]| {
            flags.iter().filter(|(_, s)| wanted.contains(s)).map(|(p, _)| *p as usize).collect::<Vec<usize>>()
        };
        let ratio = |at: usize| {
            let expected = judged.expected().get(at).copied()?;
            let ratio = (series.y[at] - expected).abs() / judged.tolerance(at).filter(|h| *h > 0.0)?;
            ratio.is_finite().then_some(ratio)
        };
        let worst =
            of(&[FlagState::Unreviewed, FlagState::Suspect]).into_iter().filter_map(ratio).max_by(f64::total_cmp);
        let row = |at: usize| u32::try_from(series.row(at)).ok();
        Self {
            counts: outcome.counts,
            by_state,
            worst,
            sparkline: Sparkline::of(&series.t, &series.y, &drawn.hidden, &flags, COLUMNS),
            undecided: of(&[FlagState::Unreviewed]).into_iter().filter_map(row).collect(),
        }
    }

    /// Flags that somebody decided on.
    #[must_use]
    pub fn decided(&self) -> usize {
        [FlagState::Accepted, FlagState::Rejected, FlagState::ByHand].iter().map(|s| self.by_state[s.index()]).sum()
    }

    /// Flags and decisions: what there is to decide on.
    #[must_use]
    pub fn to_decide(&self) -> usize {
        self.decided() + self.undecided.len()
    }
}

/// The channels that are judged, the first first.
#[derive(Debug)]
pub struct Survey {
    judges: Vec<Judge>,
}

impl Survey {
    /// The job for these plans of the model as it is now.
    #[must_use]
    pub fn new(model: &Model, plans: &[usize]) -> Self {
        // Samples that only the survey looks at are not kept: a record may have thousands of channels.
        Self { judges: plans.iter().map(|plan| Judge::new(model, *plan).apart()).collect() }
    }

    /// Judges them; `tell` hears of each as it is done.
    ///
    /// # Errors
    /// [`Error::Stopped`].
    pub fn run(&self, stop: &Stop, tell: impl Fn(usize, Result<ChannelSummary>) + Sync) -> Result<()> {
        for judges in self.judges.chunks(AT_ONCE) {
            judges.par_iter().try_for_each(|judge| match judge.summary(stop) {
                Err(Error::Stopped) => Err(Error::Stopped),
                other => {
                    tell(judge.plan(), other);
                    Ok(())
                }
            })?;
        }
        Ok(())
    }
}

/// A worker that judges channels and sends what comes out.
#[must_use]
pub fn survey(results: Sender<Message>) -> Worker<Survey> {
    Worker::new(move |generation, job: Survey, stop: &Stop| {
        let tell = |plan: usize, summary: Result<ChannelSummary>| {
            let summary = summary.map(Arc::new);
            let _ = results.send(Message::Surveyed { generation, plan, summary });
        };
        // A job that was replaced reports nothing.
        let _ = job.run(stop, tell);
    })
}
