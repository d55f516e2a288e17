//! The consensus of several methods: counted, repaired and written like the result of one.

use std::path::Path;
use std::sync::Arc;

use super::clean;
use super::comparison::{Agreement, Row};
use crate::cli::CompareArgs;
use crate::error::{Error, Result};
use crate::method::noise::Scales;
use crate::method::shared::MAX_GAP;
use crate::method::{About, Judged, Method, Own, Segment, Verdict, segments};
use crate::param::{Kind, Param, Settings, Value, always};
use crate::repair;
use crate::report::Summary;
use crate::review::Decisions;
use crate::score::Score;
use crate::session::{Analysed, Detection, Outcome, Preset, Session, Setup, settle};
use crate::stop::{Stop, Stopped};
use crate::track::{Outputs, Samples, Track};

/// Stands for "at least so many methods flag it" in a result. It is none of the methods that can be chosen: by
/// itself it judges nothing.
struct Consensus;

const VOTES: Param = Param {
    key: "votes",
    help: "a sample is an outlier when at least so many methods flag it",
    unit: "methods",
    kind: Kind::Whole { min: 1, max: 1000, step: 1 },
    default: Value::Whole(1),
    paper: None,
    matters: always,
};

static PARAMS: &[Param] = &[VOTES, MAX_GAP];

static ABOUT: About = About {
    id: "consensus",
    name: "consensus of several methods",
    family: "consensus",
    source: "beyond",
    advice: "What at least so many methods agree on.",
    params: PARAMS,
    own: Own::Remove,
    needs_rate: false,
};

impl Method for Consensus {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, _: &Settings, _: &Stop) -> std::result::Result<Judged, Stopped> {
        Ok(Judged::unchecked(segment.len()))
    }
}

/// How many methods flag each sample, and how many could judge it.
pub(super) struct Ballot {
    flagged: Vec<u16>,
    checked: Vec<u16>,
}

impl Ballot {
    /// The votes of the methods, each with a verdict for each of `samples`.
    pub(super) fn of(verdicts: &[Vec<Verdict>], samples: usize) -> Self {
        let count = |counts: fn(Verdict) -> bool| {
            let mut sums = vec![0_u16; samples];
            for verdict in verdicts {
                sums.iter_mut().zip(verdict).for_each(|(sum, v)| *sum += u16::from(counts(*v)));
            }
            sums
        };
        Self { flagged: count(|v| v == Verdict::Outlier), checked: count(|v| v != Verdict::Unchecked) }
    }

    /// How many samples there are.
    pub(super) fn samples(&self) -> usize {
        self.flagged.len()
    }

    /// How many samples are flagged by so many of `methods` methods, from one to all.
    pub(super) fn agreement(&self, methods: usize) -> Vec<Agreement> {
        let exactly = |k: usize| self.flagged.iter().filter(|f| usize::from(**f) == k).count();
        let mut at_least = 0;
        let mut all: Vec<Agreement> = Vec::new();
        for methods in (1..=methods).rev() {
            let exactly = exactly(methods);
            at_least += exactly;
            all.push(Agreement { methods, exactly, at_least });
        }
        all.reverse();
        all
    }

    /// The verdicts when `votes` methods must agree: unchecked where so few could judge that they cannot.
    fn verdicts(&self, votes: usize) -> Vec<Verdict> {
        let verdict = |(&flagged, &checked): (&u16, &u16)| {
            if usize::from(flagged) >= votes {
                Verdict::Outlier
            } else if usize::from(checked) < votes {
                Verdict::Unchecked
            } else {
                Verdict::Normal
            }
        };
        self.flagged.iter().zip(&self.checked).map(verdict).collect()
    }
}

/// The consensus, repaired and written where it was asked for.
///
/// # Errors
/// A setting of the repair that does not fit; what writing gives.
pub(super) fn written(
    args: &CompareArgs,
    votes: usize,
    track: &Track,
    index: usize,
    samples: &Samples,
    ballot: &Ballot,
) -> Result<Row> {
    let channel = &track.channels[index];
    let mut setup = Setup::new(&Consensus, Preset::Default);
    let count = i64::try_from(votes).map_err(|_| Error::usage("too many votes", "give fewer"))?;
    setup.settings.set("consensus", VOTES.key, Value::Whole(count))?;
    setup.repair.set_text("repair", repair::METHOD.key, args.repair.as_deref().unwrap_or("linear"))?;
    for (key, value) in [(repair::MAX_FILL.key, &args.max_fill), (MAX_GAP.key, &args.max_gap)] {
        if let Some(value) = value {
            setup.set_text(key, value)?;
        }
    }
    let outcome = consensus(votes, &setup, track, index, samples, ballot)?;
    let series = samples.series(channel, &track.time);
    let score = track.truth_for(&channel.name).map(|truth| Score::of(&outcome, &series, truth));
    let row = Row::of("consensus", &outcome.counts, None, score);
    let mut session = Session::new(track, args.load.options(None), &setup);
    session.plans.retain(|p| p.channel == channel.name);
    let analysed = Analysed { channels: vec![(index, samples.clone(), outcome)] };
    let mut summary = Summary::of(track, &session, &analysed);
    let inputs: Vec<&Path> = track.source.path().into_iter().collect();
    let mut files = Outputs::new(args.outputs.force, &inputs);
    clean::stage(&mut files, &args.outputs, track, &session, &analysed, &mut summary)?;
    files.commit()?;
    Ok(row)
}

fn consensus(
    votes: usize,
    setup: &Setup,
    track: &Track,
    index: usize,
    samples: &Samples,
    ballot: &Ballot,
) -> Result<Outcome> {
    let channel = &track.channels[index];
    let series = samples.series(channel, &track.time);
    let segments = segments(&series, &setup.settings);
    let judged = Judged { verdict: ballot.verdicts(votes), ..Judged::unchecked(series.len()) };
    let scales = vec![Scales::default(); segments.len()];
    let detection = Detection { setup: setup.clone(), segments, scales, judged };
    Ok(settle(track, channel, samples, Arc::new(detection), &Decisions::default(), &Stop::never())?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vote_counts_who_flags_and_who_could_judge() {
        use Verdict::{Normal as N, Outlier as O, Suspect as S, Unchecked as U};
        let ballot = Ballot::of(&[vec![O, O, N, U, S], vec![O, N, N, U, N], vec![O, O, U, O, U]], 5);
        assert_eq!(ballot.verdicts(1), [O, O, N, O, N]);
        assert_eq!(ballot.verdicts(2), [O, O, N, U, N], "one of three judged the fourth sample");
        assert_eq!(ballot.verdicts(3), [O, N, U, U, U]);
        let agreement = ballot.agreement(3);
        let of = |f: fn(&Agreement) -> usize| agreement.iter().map(f).collect::<Vec<_>>();
        assert_eq!((of(|a| a.exactly), of(|a| a.at_least)), (vec![1, 1, 1], vec![3, 2, 1]));
    }
}
