//! The consensus of several methods: counted, repaired and written like the result of one.

use std::path::Path;
use std::sync::Arc;

use super::clean;
use super::comparison::Row;
use crate::cli::CompareArgs;
use crate::error::{Error, Result};
use crate::method::consensus::{Consensus, VOTERS, VOTES, VOTING};
use crate::method::five_point::FivePoint;
use crate::method::shared::MAX_GAP;
use crate::method::{Gated, Judged};
use crate::param::{Value, Words};
use crate::repair;
use crate::report::Summary;
use crate::review::Decisions;
use crate::score::Score;
use crate::session::{Analysed, Ballot, Outcome, Preparation, Preset, Session, Setup, detect, settle};
use crate::stop::Stop;
use crate::track::{Outputs, Samples, Track};

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
    if let Some(voting) = Words::of(VOTERS, ballot.ids()) {
        setup.settings.set("consensus", VOTING.key, Value::Words(voting))?;
    }
    setup.repair.set_text("repair", repair::METHOD.key, args.repair.as_deref().unwrap_or("linear"))?;
    for (key, value) in [(repair::MAX_FILL.key, &args.max_fill), (MAX_GAP.key, &args.candidates.max_gap)] {
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
    // Of this one only the segments stay, and what the checks object to: the cheapest method will do.
    let cheapest = Setup { repair: setup.repair.clone(), ..Setup::new(&FivePoint, Preset::Default) };
    let mut cheapest = cheapest.prepared(&setup.preparation);
    if let Some(gap) = setup.settings.get(MAX_GAP.key) {
        cheapest.settings.set("five-point", MAX_GAP.key, gap)?;
    }
    let mut detection = detect(track, channel, samples, &cheapest, None, &stop)?;
    let interval = detection.setup.settings.interval().unwrap_or(f64::NAN);
    detection.setup = setup.at_interval(interval);
    let samples_seen = detection.judged.verdict().len();
    let judged = Judged { verdict: ballot.verdicts(votes), ..Judged::unchecked(samples_seen) };
    detection.judged = Gated::new(judged, None);
    Ok(settle(track, channel, samples, Arc::new(detection), &Decisions::default(), &stop)?)
}
