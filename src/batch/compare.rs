//! `compare`: every applicable method on one channel, side by side; and what so many of them agree on.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use super::consensus::{Consensus, VOTES};
use super::{Ending, clean, one_channel, print, print_json, set, set_threads};
use crate::cli::CompareArgs;
use crate::error::{Error, Result};
use crate::method::noise::Scales;
use crate::method::shared::MAX_GAP;
use crate::method::{Judged, METHODS, Method, Verdict, segments};
use crate::param::Value;
use crate::repair;
use crate::report::Summary;
use crate::review::Decisions;
use crate::score::Score;
use crate::session::{Analysed, Detection, Outcome, Preset, Session, Setup, detect, method_of_id, settle};
use crate::stop::Stop;
use crate::track::{Outputs, Samples, Track};

mod told;

use told::{Agreement, Row, Skipped, Told};

pub(super) fn run(args: &CompareArgs, out: &mut dyn Write) -> Result<Ending> {
    set_threads(args.threads)?;
    let writes = [&args.outputs.output, &args.outputs.flags, &args.outputs.diagnostics];
    if args.votes.is_none() && writes.iter().any(|w| w.is_some()) {
        return Err(Error::usage("there is no consensus to write", "say with --votes K how many methods must agree"));
    }
    let (setups, skipped) = setups(args)?;
    if let Some(votes) = args.votes
        && !(1..=setups.len()).contains(&votes)
    {
        let what = format!("--votes {votes}: {} methods take part", setups.len());
        return Err(Error::usage(what, format!("give 1 .. {}", setups.len())));
    }
    let (track, index, note) = one_channel(&args.file, &args.load, args.rate.as_deref())?;
    let channel = &track.channels[index];
    let samples = Samples::of(channel, &track.time);
    let judged =
        set::for_all(&setups, args.outputs.quiet || args.outputs.json, |setup| judge(&track, index, &samples, setup));
    let judged: Vec<(Row, Vec<Verdict>)> = judged.into_iter().collect::<Result<_>>()?;
    let (rows, verdicts): (Vec<Row>, Vec<Vec<Verdict>>) = judged.into_iter().unzip();
    let ballot = Ballot::of(&verdicts, samples.series(channel, &track.time).len());
    let consensus = match args.votes {
        Some(votes) => Some(written_consensus(args, votes, &track, index, &samples, &ballot)?),
        None => None,
    };
    let told = Told {
        file: args.file.display().to_string(),
        channel: channel.name.clone(),
        samples: ballot.flagged.len(),
        methods: rows,
        skipped,
        agreement: ballot.agreement(setups.len()),
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
    let named: Vec<&'static dyn Method> = args.method.iter().map(|id| method_of_id(id)).collect::<Result<_>>()?;
    let all = if named.is_empty() { METHODS } else { named.as_slice() };
    let (mut setups, mut skipped) = (Vec::new(), Vec::new());
    for &method in all {
        let about = method.about();
        if about.needs_rate && args.rate.is_none() {
            skipped.push(Skipped { method: about.id, why: "needs a rate channel (--rate)" });
            continue;
        }
        let mut setup = Setup::new(method, Preset::from(args.preset));
        setup.rate.clone_from(&args.rate);
        setups.push(setup);
    }
    if setups.is_empty() {
        return Err(Error::usage("no method takes part", "name a rate channel with --rate, or another --method"));
    }
    if let Some(gap) = &args.max_gap {
        assign(&mut setups, MAX_GAP.key, gap)?;
    }
    for (key, value) in &args.set {
        assign(&mut setups, key, value)?;
    }
    Ok((setups, skipped))
}

/// Sets `ID.KEY` of one method, or `KEY` of all that have it.
fn assign(setups: &mut [Setup], key: &str, value: &str) -> Result<()> {
    if let Some((id, key)) = key.split_once('.') {
        let method = method_of_id(id)?.about().id;
        return match setups.iter_mut().find(|s| s.method.about().id == method) {
            Some(setup) => setup.settings.set_text(method, key, value),
            None => {
                Err(Error::usage(format!("{id}: does not take part"), "name it with --method, or leave out its --set"))
            }
        };
    }
    let mut known = false;
    for setup in setups.iter_mut().filter(|s| s.settings.get(key).is_some()) {
        known = true;
        setup.settings.set_text(setup.method.about().id, key, value).map_err(|e| match e {
            Error::Usage { what, help } => Error::usage(
                format!("{}: {what}", setup.method.about().id),
                format!("{help}\n  or set it for some methods only: --set ID.{key}=VALUE"),
            ),
            other => other,
        })?;
    }
    if known {
        return Ok(());
    }
    Err(Error::usage(format!("{key}: no method has such a parameter"), "see `wildpoint methods`; --set ID.KEY=VALUE"))
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
    let verdicts = detection.judged.verdict.clone();
    let outcome = settle(track, channel, samples, Arc::new(detection), &Decisions::default(), &stop)?;
    let series = samples.series(channel, &track.time);
    let score = track.truth.as_ref().map(|truth| Score::of(&outcome, &series, truth));
    Ok((Row::of(setup.method.about().id, &outcome.counts, Some(ms), score), verdicts))
}

/// How many methods flag each sample, and how many could judge it.
struct Ballot {
    flagged: Vec<u16>,
    checked: Vec<u16>,
}

impl Ballot {
    fn of(verdicts: &[Vec<Verdict>], samples: usize) -> Self {
        let count = |counts: fn(Verdict) -> bool| {
            let mut sums = vec![0_u16; samples];
            for verdict in verdicts {
                sums.iter_mut().zip(verdict).for_each(|(sum, v)| *sum += u16::from(counts(*v)));
            }
            sums
        };
        Self { flagged: count(|v| v == Verdict::Outlier), checked: count(|v| v != Verdict::Unchecked) }
    }

    fn agreement(&self, methods: usize) -> Vec<Agreement> {
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
fn written_consensus(
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
    let score = track.truth.as_ref().map(|truth| Score::of(&outcome, &series, truth));
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

    #[test]
    fn a_setting_goes_to_one_method_or_to_all_that_have_it() {
        let ids = ["hampel", "two-sided"];
        let mut setups: Vec<Setup> =
            ids.iter().map(|id| Setup::new(method_of_id(id).unwrap(), Preset::Default)).collect();
        assign(&mut setups, "hampel.k", "7").unwrap();
        assign(&mut setups, "max_gap", "off").unwrap();
        assert_eq!((setups[0].settings.real("k"), setups[1].settings.real("k")), (7.0, 4.0));
        assert!(setups.iter().all(|s| s.settings.whole_or_off("max_gap").is_none()));
        for (key, value) in [("gesd.alpha", "0.1"), ("nonsense", "1"), ("hampel.nonsense", "1"), ("k", "x")] {
            assert!(assign(&mut setups, key, value).is_err(), "{key}={value}");
        }
    }
}
