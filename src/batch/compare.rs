//! `compare`: every applicable method on one channel, side by side; and the samples that enough of them agree on.

use std::io::Write;
use std::sync::Arc;
use std::time::Instant;

use super::candidates::{Candidates, candidates};
use super::comparison::{Row, Skipped, Told};
use super::consensus::written;
use super::{Ending, one_channel, print, print_json, set, set_threads};
use crate::cli::CompareArgs;
use crate::error::{Error, Result};
use crate::method::Verdict;
use crate::review::Decisions;
use crate::score::Score;
use crate::session::{Ballot, Setup, detect, settle};
use crate::stop::Stop;
use crate::track::{Samples, Track};

pub(super) fn run(args: &CompareArgs, out: &mut dyn Write) -> Result<Ending> {
    set_threads(args.threads)?;
    let writes = [&args.outputs.output, &args.outputs.flags, &args.outputs.diagnostics];
    if args.votes.is_none() && writes.iter().any(|w| w.is_some()) {
        return Err(Error::usage(
            "no consensus to write without --votes",
            "--votes K sets how many methods must agree",
        ));
    }
    let (setups, skipped) = setups(args)?;
    if let Some(votes) = args.votes
        && !(1..=setups.len()).contains(&votes)
    {
        let what = format!("--votes {votes}: {} methods take part", setups.len());
        return Err(Error::usage(what, format!("give 1 .. {}", setups.len())));
    }
    let (track, index, note) = one_channel(&args.file, &args.load, args.candidates.rate.as_deref())?;
    let channel = &track.channels[index];
    let samples = Samples::of(channel, &track.time);
    let preparation = args.candidates.prepare.of(&track, channel, args.candidates.preset)?;
    let setups: Vec<Setup> = setups.into_iter().map(|setup| setup.prepared(&preparation)).collect();
    let judged =
        set::for_all(&setups, args.outputs.quiet || args.outputs.json, |setup| judge(&track, index, &samples, setup));
    let judged: Vec<(Row, Vec<Verdict>)> = judged.into_iter().collect::<Result<_>>()?;
    let (rows, verdicts): (Vec<Row>, Vec<Vec<Verdict>>) = judged.into_iter().unzip();
    let mut ballot = Ballot::new(samples.series(channel, &track.time).len());
    rows.iter().zip(&verdicts).try_for_each(|(row, verdict)| ballot.add(row.method, verdict, &Stop::never()))?;
    let consensus = match args.votes {
        Some(votes) => Some(written(args, votes, &track, index, &samples, &ballot, &preparation)?),
        None => None,
    };
    let told = Told {
        file: args.file.display().to_string(),
        channel: channel.name.clone(),
        samples: ballot.samples(),
        methods: rows,
        skipped,
        agreement: ballot.agreement(),
        groups: ballot.groups(),
        consensus,
    };
    if args.outputs.json {
        print_json(out, &told)
    } else if args.outputs.quiet {
        Ok(Ending::Done)
    } else {
        print(out, &told.text(&note))
    }
}

/// The methods that take part with their settings, and those that cannot.
fn setups(args: &CompareArgs) -> Result<(Vec<Setup>, Vec<Skipped>)> {
    let Candidates { setups, left_out } = candidates(&(&args.candidates).into())?;
    let skipped = left_out.into_iter().map(|method| Skipped { method, why: "needs a rate channel (--rate)" }).collect();
    Ok((setups, skipped))
}

/// What one method says, and how long it took on one core.
fn judge(track: &Track, index: usize, samples: &Samples, setup: &Setup) -> Result<(Row, Vec<Verdict>)> {
    let channel = &track.channels[index];
    let stop = Stop::never();
    let timed = || {
        let start = Instant::now();
        let detection = detect(track, channel, samples, setup, None, &stop)?;
        Ok::<_, Error>((detection, start.elapsed().as_secs_f64() * 1e3))
    };
    // A pool of one thread: the time of a method would otherwise hold parts of others that run meanwhile.
    let (detection, ms) = match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(timed)?,
        Err(_) => timed()?,
    };
    let verdicts = detection.judged.verdict().to_vec();
    let outcome = settle(track, channel, samples, Arc::new(detection), &Decisions::default(), &stop)?;
    let series = samples.series(channel, &track.time);
    let score = track.truth_for(&channel.name).map(|truth| Score::of(&outcome, &series, truth));
    Ok((Row::of(setup.method.about().id, &outcome.counts, Some(ms), score), verdicts))
}
