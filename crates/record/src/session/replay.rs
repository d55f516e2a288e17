//! Opening a saved session: its record is loaded, and everything that the session says of it is verified.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::document::{Read, WrittenDecision, read_with_texts};
use super::{
    Detection, Member, Outcome, Plan, Recorded, Session, Setup, changes, clean_sha256, detect_taught, detect_together,
    settle,
};
use crate::error::{Error, Result};
use crate::stop::Stop;
use crate::track::{LoadOptions, RowChecks, Samples, Source, Track, Wanted, for_each_row, load_while};

/// A session with its record.
#[derive(Debug)]
pub struct Opened {
    /// The session.
    pub session: Session,
    /// Its record.
    pub track: Track,
    /// What the user should know: decisions that no longer fit changed data, say.
    pub notes: Vec<String>,
    /// For each plan of the session, whether its file has it; [`open_all`] adds those that it does not have.
    pub own: Vec<bool>,
}

/// Reads the session at `path` and loads its record. The SHA-256, the number of rows, and the row, time and value
/// of each decision must be those of the session; with `accept_changed` the data may differ, and decisions that
/// no longer fit them are left out, with a note each.
///
/// # Errors
/// [`Error::Changed`] with the first difference; [`Error::Session`] for a decision that does not fit its row; and
/// what reading and loading give.
pub fn open(path: &Path, accept_changed: bool) -> Result<Opened> {
    open_with(path, accept_changed, true, Wanted::always())
}

/// [`open`] that loads every channel of the record, not only those of the session, and adds a plan with the default
/// method for each of the others, all in the order of the record: for the workbench.
///
/// # Errors
/// As [`open`]; [`Error::Stopped`] when the session is no longer wanted.
pub fn open_all(path: &Path, accept_changed: bool, wanted: Wanted<'_>) -> Result<Opened> {
    let mut opened = open_with(path, accept_changed, false, wanted)?;
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

fn open_with(path: &Path, accept_changed: bool, only_planned: bool, wanted: Wanted<'_>) -> Result<Opened> {
    let Read { mut session, texts, rows_line } = read_with_texts(path)?;
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
    let track = load_while(&session.data.source, &options, wanted).map_err(|e| of_session(path, e))?;
    let mut notes = Vec::new();
    let changed = track.sha256 != session.data.sha256;
    let misfits = misfits(&track, &session.plans, &texts, wanted)?;
    if changed {
        let what = difference(&session, &track, misfits.first())?;
        if !accept_changed {
            return Err(Error::Changed { path: file_of(&session.data.source), what });
        }
        notes.push(format!("the data are not those of the session: {what}"));
    } else if session.data.rows != track.rows {
        return Err(Error::Session {
            path: path.to_path_buf(),
            line: rows_line,
            what: format!("rows = {}: the record has {}", session.data.rows, track.rows),
            help: "restore the session file, or save the session again".into(),
        });
    } else if let Some(misfit) = misfits.first() {
        return Err(Error::Session {
            path: path.to_path_buf(),
            line: misfit.line,
            what: misfit.what.clone(),
            help: "restore the session file, or take the decision out of it".into(),
        });
    }
    for misfit in misfits {
        session.plans[misfit.plan].decisions.set(misfit.row, None);
        notes.push(format!("left out: {}", misfit.what));
    }
    session.data.sha256.clone_from(&track.sha256);
    session.data.rows = track.rows;
    let own = vec![true; session.plans.len()];
    Ok(Opened { session, track, notes, own })
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
    plans: &[Plan],
    texts: &[Vec<WrittenDecision>],
    wanted_by: Wanted<'_>,
) -> Result<Vec<Misfit>> {
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
    for_each_row(track, |row, cells| {
        if row.is_multiple_of(Stop::STRIDE) && !wanted_by.still() {
            return Err(Error::Stopped);
        }
        for (plan, column, text) in wanted.get(&row).into_iter().flatten() {
            let value = cells.text(*column);
            if value != text.value.as_str() {
                misfit(*plan, text, format!("the value is {value:?}, the decision was made on {:?}", text.value));
                continue;
            }
            // Empty on both sides where the time is the number of the sample.
            let time = track.time.column.map(|c| cells.text(c)).unwrap_or_default();
            if time != text.time.as_str() {
                misfit(*plan, text, format!("the time is {time:?}, the decision was made at {:?}", text.time));
            } else if channel_value(track, &plans[*plan].channel, row).is_nan() {
                misfit(*plan, text, "decided on, but it has no value or no usable time".into());
            }
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
        Source::BuiltIn { name, .. } => PathBuf::from(name),
    }
}

/// The samples and outcomes of every plan of a session, in the order of the plans.
#[derive(Debug)]
pub struct Analysed {
    /// For each plan: index of its channel in the track, its samples, its outcome.
    pub channels: Vec<(usize, Samples, Outcome)>,
}

impl Analysed {
    /// Runs every plan of `session`.
    ///
    /// # Errors
    /// What [`detect`] and [`settle`] give; [`Error::Usage`] for a channel that the record does not have.
    pub fn of(session: &Session, track: &Track, stop: &Stop) -> Result<Self> {
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
        let channels = todo.map(one).collect::<Result<_>>()?;
        Ok(Self { channels })
    }

    /// What changes in the file.
    #[must_use]
    pub fn changes(&self, track: &Track) -> crate::track::Changes {
        let all: Vec<_> = self.channels.iter().map(|(i, s, o)| (*i, s, o)).collect();
        changes(track, &all)
    }

    /// Outliers of all channels.
    #[must_use]
    pub fn flagged(&self) -> usize {
        self.channels.iter().map(|(_, _, o)| o.counts.flagged).sum()
    }

    /// What a saved session records of this result.
    ///
    /// # Errors
    /// As [`clean_sha256`].
    pub fn recorded(&self, track: &Track) -> Result<Recorded> {
        let clean_sha256 = clean_sha256(track, &self.changes(track))?;
        Ok(Recorded { flagged: self.flagged(), clean_sha256 })
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
    differences
}
