//! Opening a saved session: its record is loaded, and everything that the session says of it is verified.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::document::{Read, WrittenDecision, read_with_texts};
use super::flags::flags_sha256;
use super::output_value::filtered_of;
use super::save::known;
use super::{
    Data, Detection, Member, Outcome, Plan, Recorded, Session, Setup, changes, check_value, clean_sha256,
    detect_taught, detect_together, settle,
};
use crate::error::{Error, Result};
use crate::method::Filtered;
use crate::stop::Stop;
use crate::track::{
    Extent, LoadOptions, RowChecks, Samples, Source, Standing, Track, Wanted, covered, for_each_row, load_extent,
};

/// A session with its record.
#[derive(Debug)]
pub struct Opened {
    /// The session.
    pub session: Session,
    /// Its record.
    pub track: Track,
    /// What the user should know: for example decisions that no longer fit changed data.
    pub notes: Vec<String>,
    /// For each plan of the session, whether its file has it; [`open_all`] adds those that it does not have.
    pub own: Vec<bool>,
    /// Rows that were added to the record since the session was saved.
    pub appended: Option<Grown>,
    /// What was changed in the session file since it was saved, in words; none where the file does not tell (format 1).
    pub altered: Option<Vec<String>>,
}

/// What is done with rows that were added to the end of the record since the session was saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Appended {
    /// The session is refused.
    #[default]
    Refused,
    /// They are judged like the others.
    TakenIn,
    /// The session is about the rows before them.
    LeftOut,
}

/// Rows that were added to the end of the record since the session was saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grown {
    /// How many.
    pub rows: usize,
    /// True when they were not loaded.
    pub left_out: bool,
}

impl Grown {
    /// What happened, in words.
    #[must_use]
    pub fn words(self) -> String {
        let were = if self.rows == 1 { "1 row was".to_owned() } else { format!("{} rows were", self.rows) };
        let out = if self.left_out { ", and left out" } else { "" };
        format!("{were} added to the record since the session was saved{out}")
    }
}

/// How a record may differ from that of its session.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Accepted {
    /// True when any of it may have changed: decisions that no longer fit are left out.
    pub changed: bool,
    /// What is done with added rows.
    pub appended: Appended,
}

/// Reads the session at `path` and loads its record. The SHA-256, the number of rows, and the row, time and value
/// of each decision must be those of the session, but for what is `accepted`: decisions that no longer fit changed data
/// are left out, with a note each.
///
/// # Errors
/// [`Error::Changed`] with the first difference; [`Error::Appended`]; [`Error::Session`] for a decision that does not fit its row; and
/// what reading and loading give.
pub fn open(path: &Path, accepted: Accepted) -> Result<Opened> {
    open_with(path, accepted, true, Wanted::always())
}

/// [`open`] that loads every channel of the record, not only those of the session, and adds a plan with the default
/// method for each of the others, all in the order of the record: for the workbench. Rows that were added to the record
/// are left out.
///
/// # Errors
/// As [`open`]; [`Error::Stopped`] when the session is no longer wanted.
pub fn open_all(path: &Path, wanted: Wanted<'_>) -> Result<Opened> {
    let accepted = Accepted { appended: Appended::LeftOut, ..Accepted::default() };
    let mut opened = open_with(path, accepted, false, wanted)?;
    opened.own.clear();
    let others =
        Session::new(&opened.track, LoadOptions::default(), &Setup::standard()).with_suggestions(&opened.track);
    let mut own = std::mem::take(&mut opened.session.plans);
    // Several plans of one channel stay together, in the order of the file.
    for other in others.plans {
        let (here, rest): (Vec<Plan>, Vec<Plan>) = own.into_iter().partition(|p| p.channel == other.channel);
        own = rest;
        opened.own.extend(if here.is_empty() { vec![false] } else { vec![true; here.len()] });
        opened.session.plans.extend(if here.is_empty() { vec![other] } else { here });
    }
    opened.own.extend(own.iter().map(|_| true));
    opened.session.plans.extend(own);
    Ok(opened)
}

fn open_with(path: &Path, accepted: Accepted, only_planned: bool, wanted: Wanted<'_>) -> Result<Opened> {
    let Read { mut session, texts, rows_line, altered, archive: _ } = read_with_texts(path)?;
    let mut channels: Vec<String> = Vec::new();
    if only_planned {
        channels.extend(session.plans.iter().map(|p| p.channel.clone()));
        for rate in session.plans.iter().filter_map(|p| p.setup.rate.clone()) {
            if !channels.contains(&rate) {
                channels.push(rate);
            }
        }
    }
    let options = LoadOptions { channels, ..session.data.options.clone() };
    let (track, added) =
        load_covered(&session.data, &options, accepted.appended, wanted).map_err(|e| of_session(path, e))?;
    let misfits = misfits(&track, &session, &texts, wanted)?;
    let mut notes = Vec::new();
    let appended = added.map(|rows| Grown { rows, left_out: accepted.appended == Appended::LeftOut });
    match &appended {
        Some(grown) if accepted.appended == Appended::Refused => {
            return Err(Error::Appended { path: file_of(&session.data.source), what: grown.words() });
        }
        // What was recorded is the result of the rows before.
        Some(Grown { left_out: false, .. }) => session.result = None,
        _ if track.sha256 == session.data.sha256 => verify(path, &session, &track, (&misfits, rows_line))?,
        _ => {
            let what = difference(&session, &track, misfits.first())?;
            if !accepted.changed {
                return Err(Error::Changed { path: file_of(&session.data.source), what });
            }
            notes.push(format!("the data are not those of the session: {what}"));
        }
    }
    for misfit in misfits {
        session.plans[misfit.plan].decisions.set(misfit.row, None);
        notes.push(format!("left out: {}", misfit.what));
    }
    session.data.sha256.clone_from(&track.sha256);
    (session.data.bytes, session.data.rows) = (Some(track.bytes), track.rows);
    if let Some(was) = session.data.record_was.take() {
        notes.push(format!("the session was saved when its record {}: save it once more", Standing::Lost(was).words()));
    }
    let own = vec![true; session.plans.len()];
    Ok(Opened { session, track, notes, own, appended, altered })
}

/// On the record that it was made on, everything in a session must fit.
fn verify(
    path: &Path,
    session: &Session,
    track: &Track,
    (misfits, rows_line): (&[Misfit], Option<usize>),
) -> Result<()> {
    let fault = |line, what, help: &str| Error::Session { path: path.to_path_buf(), line, what, help: help.into() };
    if session.data.rows != track.rows {
        let what = format!("rows = {}: the record has {}", session.data.rows, track.rows);
        return Err(fault(rows_line, what, "restore the session file, or save the session again"));
    }
    match misfits.first() {
        None => Ok(()),
        Some(Misfit { line, what, .. }) => {
            Err(fault(*line, what.clone(), "restore the session file, or take the decision out of it"))
        }
    }
}

/// The record of a session and, where it only has more rows than the session says, how many more.
fn load_covered(
    data: &Data,
    options: &LoadOptions,
    appended: Appended,
    wanted: Wanted<'_>,
) -> Result<(Track, Option<usize>)> {
    let load = |extent| load_extent(&data.source, options, extent, wanted);
    let length = data.source.path().and_then(|path| path.metadata().ok()).map(|about| about.len());
    let start = match data.bytes {
        // Measured first: it may be growing just now.
        Some(bytes) if length.is_some_and(|length| length > bytes) => covered(&data.source, &data.sha256, Some(bytes))?,
        Some(_) => None,
        None => {
            let track = load(Extent::All)?;
            if track.sha256 == data.sha256 || track.dialect.packing.is_some() {
                return Ok((track, None));
            }
            match covered(&data.source, &data.sha256, None)? {
                None => return Ok((track, None)),
                start => start,
            }
        }
    };
    let Some(bytes) = start else {
        let as_saved = data.bytes.filter(|bytes| length == Some(*bytes));
        return Ok((load(as_saved.map_or(Extent::All, Extent::First))?, None));
    };
    if appended == Appended::LeftOut {
        let track = load(Extent::First(bytes))?;
        let rows = match Standing::of(&track) {
            Standing::Grown { rows } => rows,
            _ => 0,
        };
        return Ok((track, Some(rows).filter(|rows| *rows > 0)));
    }
    let track = load(Extent::All)?;
    let rows = track.rows.saturating_sub(data.rows);
    Ok((track, Some(rows)))
}

/// What loading the record of a session complained of, with the session it is about.
fn of_session(path: &Path, e: Error) -> Error {
    let (what, help) = match e {
        // A column that the session names and the record does not have.
        Error::Usage { what, help } => (what, help),
        Error::Io { source, path: record, .. } if source.kind() == std::io::ErrorKind::NotFound => (
            format!("its record {} is not there", record.display()),
            "`file` is looked for beside the session; put the record there, or correct the line".to_owned(),
        ),
        other => return other,
    };
    // The line is that of the first name in the session that the complaint quotes.
    let text = std::fs::read_to_string(path).unwrap_or_default();
    let quoted = what.split('`').nth(1).map(|name| format!("\"{name}\""));
    let key = if what.starts_with("its record") { Some("file =".to_owned()) } else { quoted };
    let line = key.and_then(|key| text.lines().position(|l| l.contains(&key))).map(|at| at + 1);
    Error::Session { path: path.to_path_buf(), line, what, help }
}

/// A decision that does not fit the record.
struct Misfit {
    plan: usize,
    row: u32,
    line: Option<usize>,
    what: String,
}

fn misfits(
    track: &Track,
    session: &Session,
    texts: &[Vec<WrittenDecision>],
    wanted_by: Wanted<'_>,
) -> Result<Vec<Misfit>> {
    let plans = &session.plans;
    // All decisions about a row, with the plan and the column they are about.
    let mut wanted: BTreeMap<usize, Vec<(usize, usize, &WrittenDecision)>> = BTreeMap::new();
    for (index, (plan, texts)) in plans.iter().zip(texts).enumerate() {
        let column = track.channel(&plan.channel).map(|c| c.column).unwrap_or_default();
        for text in texts {
            wanted.entry(text.row as usize - 1).or_default().push((index, column, text));
        }
    }
    let mut misfits = Vec::new();
    if wanted.is_empty() {
        return Ok(misfits);
    }
    let mut misfit = |plan: usize, text: &WrittenDecision, what: String| {
        let what = format!("row {} of {}: {what}", text.row, plans[plan].channel);
        misfits.push(Misfit { plan, row: text.row - 1, line: text.line, what });
    };
    for (_, beyond) in wanted.range(track.rows..) {
        for (plan, _, text) in beyond {
            misfit(*plan, text, format!("decided on, but the record has {} rows", track.rows));
        }
    }
    let mut compare = |plan: usize, text: &WrittenDecision, (time, value): (&str, &str)| {
        if value != text.value {
            misfit(plan, text, format!("the value is {value:?}, the decision was made on {:?}", text.value));
        } else if time != text.time {
            misfit(plan, text, format!("the time is {time:?}, the decision was made at {:?}", text.time));
        } else if channel_value(track, &plans[plan].channel, text.row as usize - 1).is_nan() {
            misfit(plan, text, "decided on, but it has no value or no usable time".into());
        }
    };
    if session.data.record_was.is_some() {
        for (plan, _, text) in wanted.range(..track.rows).flat_map(|(_, here)| here) {
            let (time, value) = known(track, &plans[*plan].channel, text.row as usize - 1);
            compare(*plan, text, (&time, &value));
        }
        return Ok(misfits);
    }
    for_each_row(track, |row, cells| {
        if row.is_multiple_of(Stop::STRIDE) && !wanted_by.still() {
            return Err(Error::Stopped);
        }
        for (plan, column, text) in wanted.get(&row).into_iter().flatten() {
            // Empty on both sides where the time is the number of the sample.
            let time = track.time.column.map(|c| cells.text(c)).unwrap_or_default();
            compare(*plan, text, (&time, &cells.text(*column)));
        }
        Ok(())
    })?;
    Ok(misfits)
}

fn channel_value(track: &Track, channel: &str, row: usize) -> f64 {
    let value = track.channel(channel).map_or(f64::NAN, |c| c.value(row));
    let time = track.time.seconds.get(row).copied().unwrap_or(f64::NAN);
    if time.is_nan() { f64::NAN } else { value }
}

/// The first difference that can be seen between the record and what the session says of it.
fn difference(session: &Session, track: &Track, misfit: Option<&Misfit>) -> Result<String> {
    let checks = session.data.row_check.as_deref().and_then(RowChecks::parse);
    if let Some(then) = checks {
        return Ok(then.first_difference(&RowChecks::of(track)?, session.data.rows, track.rows));
    }
    if session.data.rows != track.rows {
        return Ok(format!("it has {} rows, the session was made on {}", track.rows, session.data.rows));
    }
    Ok(misfit.map_or_else(|| "same number of rows, but another SHA-256".into(), |m| m.what.clone()))
}

fn file_of(source: &Source) -> PathBuf {
    match source {
        Source::File(path) => path.clone(),
        other => PathBuf::from(other.name()),
    }
}

/// The samples and outcomes of every plan of a session, in the order of the plans.
#[derive(Debug)]
pub struct Analysed {
    /// For each plan: index of its channel in the track, its samples, its outcome.
    pub channels: Vec<(usize, Samples, Outcome)>,
    /// For each plan the filtered values, where the session has them written; empty otherwise.
    pub filtered: Vec<Option<Filtered>>,
}

impl Analysed {
    /// Runs every plan of `session`.
    ///
    /// # Errors
    /// [`check_value`]; what [`detect_taught`] and [`settle`] give; [`Error::Usage`] for a channel that the record does not have.
    pub fn of(session: &Session, track: &Track, stop: &Stop) -> Result<Self> {
        check_value(session)?;
        use rayon::prelude::*;
        let prepare = |plan: &Plan| {
            let index = track.channels.iter().position(|c| c.name == plan.channel).ok_or_else(|| {
                let names: Vec<&str> = track.channels.iter().map(|c| c.name.as_str()).collect();
                Error::usage(
                    format!("{}: there is no such channel", plan.channel),
                    format!("channels: {}", names.join(", ")),
                )
            })?;
            Ok((index, Samples::of(&track.channels[index], &track.time)))
        };
        let prepared: Vec<(usize, Samples)> = session.plans.par_iter().map(prepare).collect::<Result<_>>()?;
        let mut detections = together(session, track, &prepared, stop)?;
        let todo = session.plans.par_iter().zip(prepared).zip(detections.par_iter_mut());
        let one = |((plan, (index, samples)), ready): ((&Plan, (usize, Samples)), &mut Option<Detection>)| {
            let channel = &track.channels[index];
            let detection = match ready.take() {
                Some(detection) => detection,
                None => detect_taught(track, channel, &samples, (&plan.setup, &plan.decisions), None, stop)?,
            };
            let outcome = settle(track, channel, &samples, Arc::new(detection), &plan.decisions, stop)?;
            Ok((index, samples, outcome))
        };
        let channels: Vec<(usize, Samples, Outcome)> = todo.map(one).collect::<Result<_>>()?;
        let filtered = filtered_of(session, track, &channels, stop)?;
        Ok(Self { channels, filtered })
    }

    /// What changes in the file.
    #[must_use]
    pub fn changes(&self, track: &Track) -> crate::track::Changes {
        let all: Vec<_> = self.channels.iter().map(|(i, s, o)| (*i, s, o)).collect();
        let filtered: Vec<_> = (0..all.len()).map(|plan| self.filtered_of(plan)).collect();
        changes(track, &all, &filtered)
    }

    /// The filtered values that the cleaned file has of a plan's channel; none where it has the measured ones.
    #[must_use]
    pub fn filtered_of(&self, plan: usize) -> Option<&Filtered> {
        self.filtered.get(plan).and_then(Option::as_ref)
    }

    /// Outliers of all channels.
    #[must_use]
    pub fn flagged(&self) -> usize {
        self.channels.iter().map(|(_, _, o)| o.counts.flagged).sum()
    }

    /// What a saved session records of this result.
    ///
    /// # Errors
    /// As [`clean_sha256`] and [`flags_sha256`].
    pub fn recorded(&self, session: &Session, track: &Track) -> Result<Recorded> {
        let clean_sha256 = clean_sha256(track, &self.changes(track))?;
        let flags_sha256 = Some(flags_sha256(track, session, self)?);
        Ok(Recorded { flagged: self.flagged(), clean_sha256, flags_sha256 })
    }
}

/// The detections of plans that are judged together with others, for the plans that are.
fn together(
    session: &Session,
    track: &Track,
    prepared: &[(usize, Samples)],
    stop: &Stop,
) -> Result<Vec<Option<Detection>>> {
    let plans = &session.plans;
    let mut detections: Vec<Option<Detection>> = vec![None; plans.len()];
    for first in 0..plans.len() {
        if !plans[first].setup.together() || detections[first].is_some() {
            continue;
        }
        let channel = |plan: usize| &track.channels[prepared[plan].0];
        let shares = |plan: usize| channel(plan).same_target(channel(first));
        let members: Vec<usize> =
            (first..plans.len()).filter(|&i| plans[i].setup.same_method(&plans[first].setup) && shares(i)).collect();
        let member = |&i: &usize| Member {
            channel: channel(i),
            samples: &prepared[i].1,
            setup: &plans[i].setup,
            decisions: &plans[i].decisions,
        };
        let found = detect_together(track, &members.iter().map(member).collect::<Vec<_>>(), stop)?;
        for (member, detection) in members.into_iter().zip(found) {
            detections[member] = Some(detection);
        }
    }
    Ok(detections)
}

/// How this result differs from what the session recorded; empty when it does not.
#[must_use]
pub fn check(recorded: Option<&Recorded>, now: &Recorded) -> Vec<String> {
    let Some(then) = recorded else {
        return vec!["the session has no [result] to compare with: save it once more".into()];
    };
    let mut differences = Vec::new();
    if then.flagged != now.flagged {
        differences.push(format!("{} samples flagged, the session recorded {}", now.flagged, then.flagged));
    }
    if then.clean_sha256 != now.clean_sha256 {
        differences.push(format!(
            "the cleaned file has SHA-256 {}, the session recorded {}",
            now.clean_sha256, then.clean_sha256
        ));
    }
    if let (Some(then), Some(now)) = (&then.flags_sha256, &now.flags_sha256)
        && then != now
    {
        differences.push(format!("the table of flags has SHA-256 {now}, the session recorded {then}"));
    }
    differences
}
