//! `advise`: which method finds most on a record; `clean --method auto`, which takes it.

use std::fmt::Write as _;
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

use serde::Serialize;

use super::candidates::{Asked, Candidates, candidates};
use super::table::{columns, row};
use super::{Ending, one_channel, print, print_json, set_threads};
use crate::cli::{AUTO, AdviseArgs, Shared};
use crate::error::{Error, Result};
use crate::session::detectability::{Advice, Budget, Detected, Kind, Measured, OnChannel, SEED, Study, two_digits};
use crate::session::{Measurement, Preset, Session, Setup};
use crate::stop::Stop;
use crate::track::{Samples, Track, printable};

/// What `--json` prints.
#[derive(Serialize)]
struct Told<'a> {
    file: String,
    channel: &'a str,
    unit: &'a str,
    seed: u64,
    #[serde(flatten)]
    advice: &'a Advice,
    left_out: &'a [&'static str],
    reasons: Vec<String>,
}

pub(super) fn run(args: &AdviseArgs, out: &mut dyn Write) -> Result<Ending> {
    set_threads(args.threads)?;
    let methods: Vec<String> = args.tune.iter().chain(&args.candidates.method).cloned().collect();
    let asked = Asked { methods: &methods, ..(&args.candidates).into() };
    let Candidates { setups, left_out } = candidates(&asked)?;
    let (track, index, note) = one_channel(&args.file, &args.load, asked.rate)?;
    let channel = &track.channels[index];
    let samples = Samples::of(channel, &track.time);
    let preparation = args.candidates.prepare.of(&track, channel, asked.preset)?;
    let setups: Vec<Setup> = setups.into_iter().map(|setup| setup.prepared(&preparation)).collect();
    let on_channel = OnChannel { track: &track, channel, samples: &samples, seed: args.seed };
    if args.tune.is_some() {
        return tuned(args, &on_channel, &setups, out);
    }
    let progress = Progress { shown: !args.json && std::io::stderr().is_terminal() };
    let advice = on_channel.advise(setups, &Stop::never(), |study| progress.show(study));
    progress.clear();
    let advice = advice?;
    if args.json {
        let file = args.file.display().to_string();
        let reasons = advice.reasons(&channel.unit);
        let (name, unit) = (channel.name.as_str(), channel.unit.as_str());
        let told = Told { file, channel: name, unit, seed: args.seed, advice: &advice, left_out: &left_out, reasons };
        return print_json(out, &told);
    }
    if let Some(why) = advice.unsuitable {
        return Err(Error::input(&args.file, format!("{}: {why}", channel.name), why.way_out()));
    }
    let title = format!("{}: {}{note}\n\n", printable(&channel.name), what(&advice, args.seed));
    let mut text = title + &table(&advice.methods, &channel.unit);
    let _ = writeln!(text, "weights of the kinds (how many the record itself shows): {}\n", advice.weights_in_words());
    for id in left_out {
        let _ = writeln!(text, "{id}: needs a rate channel (--rate)");
    }
    for line in advice.reasons(&channel.unit) {
        let _ = writeln!(text, "{line}");
    }
    if let Some(best) = advice.best() {
        let _ = writeln!(text, "to take it: {}", options(&best.setup, asked.preset.into()));
    }
    print(out, &text)
}

/// What was done, in words.
fn what(advice: &Advice, seed: u64) -> String {
    let part = if advice.tried < advice.samples {
        format!(", of which {} in 16 pieces were tried", advice.tried)
    } else {
        String::new()
    };
    let copies = if advice.rounds[0] == 1 { "1 copy".to_owned() } else { format!("{} copies", advice.rounds[0]) };
    let events: usize =
        advice.methods.first().map_or(0, |m| m.kinds.iter().flat_map(|k| &k.points).map(|p| p.events).sum());
    format!("{} samples{part}; {events} wild points in {copies} (seed {seed})", advice.samples)
}

/// A row for each method.
fn table(methods: &[Measured], unit: &str) -> String {
    let kinds: Vec<Kind> = methods.first().map_or(Vec::new(), |m| m.kinds.iter().map(|c| c.kind).collect());
    let mut header = row(["95 % found from"]);
    header.extend(kinds.iter().map(|kind| kind.short().to_owned()));
    header.extend(row(["found %", "flags", "alone", "repair", "ms"]));
    let mut rows = vec![header];
    for measured in methods {
        let mut cells = vec![measured.setup.method.about().id.to_owned()];
        cells.extend(measured.detected().iter().map(Detected::cell));
        cells.push(format!("{:.1}", 100.0 * measured.recall));
        cells.extend([measured.untouched.flagged, measured.untouched.alone].map(|n| n.to_string()));
        cells.push(measured.repair_error.map_or_else(|| "-".to_owned(), two_digits));
        cells.push(format!("{:.0}", measured.milliseconds));
        rows.push(cells);
    }
    let unit = if unit.is_empty() { "channel units".to_owned() } else { printable(unit) };
    let legend = format!(
        "sizes and repair errors in {unit}; run 2: runs of 2 samples; -: none of the sizes; alone: flags that neither \
         half of the methods nor the calibration supports\n"
    );
    columns(&rows) + &legend
}

/// The options of `clean` that mean a setup.
fn options(setup: &Setup, preset: Preset) -> String {
    let own = preset.settings(setup.method);
    let mut text = format!("--method {}", setup.method.about().id);
    if preset == Preset::Paper {
        text += " --preset paper";
    }
    for (param, value) in setup.settings.iter().filter(|(param, value)| own.get(param.key) != Some(*value)) {
        let _ = write!(text, " --set {}={}", param.key, value);
    }
    text
}

/// What a search gained, for programs.
#[derive(Serialize)]
struct ToldTuned<'a> {
    file: String,
    channel: &'a str,
    unit: &'a str,
    seed: u64,
    #[serde(flatten)]
    tuned: &'a crate::session::detectability::Tuned,
}

/// `advise --tune`.
fn tuned(args: &AdviseArgs, on_channel: &OnChannel<'_>, setups: &[Setup], out: &mut dyn Write) -> Result<Ending> {
    let channel = on_channel.channel;
    let setup = setups.first().cloned().unwrap_or_else(Setup::standard);
    let end = Instant::now() + Duration::from_secs_f64(args.seconds);
    let budget = Budget { flags: args.flags, is_over: &|| Instant::now() >= end };
    let tuned = match on_channel.tune(&setup, &budget, &Stop::never())? {
        Ok(tuned) => tuned,
        Err(why) => return Err(Error::input(&args.file, format!("{}: {why}", channel.name), why.way_out())),
    };
    if args.json {
        let (file, name, unit) = (args.file.display().to_string(), channel.name.as_str(), channel.unit.as_str());
        return print_json(out, &ToldTuned { file, channel: name, unit, seed: args.seed, tuned: &tuned });
    }
    let id = setup.method.about().id;
    let end = if tuned.cut_short { format!(", until {} s were over", args.seconds) } else { String::new() };
    let mut text = format!("{}: {id}, {} settings tried{end}\n\n", printable(&channel.name), tuned.tried);
    text += &table(&[tuned.before.clone(), tuned.after.clone()], &channel.unit);
    text.push('\n');
    let changed = tuned.after.setup.settings != tuned.before.setup.settings;
    if changed {
        let _ = writeln!(text, "second row: {}", options(&tuned.after.setup, args.candidates.preset.into()));
    } else {
        let _ = writeln!(text, "no other settings find more: {id} stays as it is");
    }
    print(out, &text)
}

/// How far a study is, on the terminal.
struct Progress {
    shown: bool,
}

impl Progress {
    fn show(&self, study: &Study) {
        let rounds = study.rounds();
        if self.shown && rounds.all > 0 {
            let _ = write!(std::io::stderr(), "\r{} of {} copies", rounds.done, rounds.all);
        }
    }

    fn clear(&self) {
        if self.shown {
            let _ = write!(std::io::stderr(), "\r\x1b[K");
        }
    }
}

/// Gives each plan of `session` the method that is recommended for its channel, with its settings, and what was measured;
/// the repair stays. Returns what was chosen and why, a line for each plan. A channel that cannot be asked keeps its
/// method.
///
/// # Errors
/// [`crate::error::Error::Usage`] for a key that no method has; what [`OnChannel::advise`] gives.
pub(super) fn choose(session: &mut Session, track: &Track, shared: &Shared) -> Result<Vec<String>> {
    let asked = Asked {
        methods: &[],
        preset: shared.preset,
        rate: shared.rate.as_deref(),
        max_gap: shared.max_gap.as_deref(),
        set: &shared.method_settings(),
    };
    let Candidates { setups, .. } = candidates(&asked)?;
    let mut lines = Vec::with_capacity(session.plans.len());
    for plan in &mut session.plans {
        let Some(channel) = track.channel(&plan.channel) else { continue };
        let samples = Samples::of(channel, &track.time);
        let prepared = setups.iter().map(|setup| setup.clone().prepared(&plan.setup.preparation)).collect();
        let on_channel = OnChannel { track, channel, samples: &samples, seed: SEED };
        let advice = on_channel.advise(prepared, &Stop::never(), |_| ())?;
        let reasons = advice.reasons(&channel.unit).join("; ");
        lines.push(match advice.best() {
            Some(best) => {
                let repair = plan.setup.repair.clone();
                plan.setup = Setup { repair, ..best.setup.clone() };
                format!("method {AUTO}: {reasons}")
            }
            None => format!("method {AUTO}: {reasons}; {} stays", plan.setup.method.about().id),
        });
        plan.measured = Measurement::of(&advice, SEED, &channel.unit, &plan.setup);
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::method_of_id;

    #[test]
    fn options_name_what_differs_from_the_preset() {
        let mut setup = Setup::new(method_of_id("hampel").unwrap(), Preset::Default);
        assert_eq!(options(&setup, Preset::Default), "--method hampel");
        setup.set_text("window", "31").unwrap();
        assert_eq!(options(&setup, Preset::Default), "--method hampel --set window=31");
    }
}
