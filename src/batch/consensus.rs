//! The consensus of several methods: counted, repaired and written like the result of one.

use std::path::Path;
use std::sync::Arc;

use super::clean;
use super::comparison::Row;
use crate::cli::CompareArgs;
use crate::error::{Error, Result};
use crate::method::shared::MAX_GAP;
use crate::method::{About, Gated, Judged, Method, Own, Segment};
use crate::param::{Kind, Param, Settings, Value, always};
use crate::repair;
use crate::report::Summary;
use crate::review::Decisions;
use crate::score::Score;
use crate::session::{Analysed, Ballot, Outcome, Preparation, Preset, Session, Setup, detect, settle};
use crate::stop::{Stop, Stopped};
use crate::track::{Outputs, Samples, Track};

/// Stands for "at least so many methods flag it" in a result. It is none of the methods that can be chosen: by
/// itself it judges nothing.
struct Consensus;

const VOTES: Param = Param {
    key: "votes",
    help: "a sample is an outlier when at least this many methods flag it",
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
    advice: "The samples that at least this many methods flag.",
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
    preparation: &Preparation,
) -> Result<Row> {
    let channel = &track.channels[index];
    let mut setup = Setup::new(&Consensus, Preset::Default).prepared(preparation);
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
    let analysed = Analysed { channels: vec![(index, samples.clone(), outcome)], filtered: Vec::new() };
    let mut summary = Summary::of(track, &session, &analysed);
    let inputs: Vec<&Path> = track.source.path().into_iter().collect();
    let mut files = Outputs::new(args.outputs.force, &inputs).or_standard_output().dry(args.outputs.dry_run);
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
    let stop = Stop::never();
    let mut detection = detect(track, channel, samples, setup, None, &stop)?;
    let samples_seen = detection.judged.verdict().len();
    let judged = Judged { verdict: ballot.verdicts(votes), ..Judged::unchecked(samples_seen) };
    detection.judged = Gated::new(judged, None);
    Ok(settle(track, channel, samples, Arc::new(detection), &Decisions::default(), &stop)?)
}
