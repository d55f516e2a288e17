//! `replay`: saved sessions again, to the same bytes; `--check` compares and writes nothing.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::progress::Progress;
use super::set;
use super::targets::{Target, file_name, targets};
use super::{Ending, clean, print, tell};
use crate::cli::OutputArgs;
use crate::error::{Error, Result, on_one_line};
use crate::report::Summary;
use crate::session::flags::flags_sha256;
use crate::session::{Accepted, Analysed, Appended, Grown, Recorded, check, open, read};
use crate::stop::Stop;
use crate::track::{Outputs, printable, unpacked_name};

pub(super) fn run_all(
    sessions: &[PathBuf],
    accepted: Accepted,
    outputs: &OutputArgs,
    out: &mut dyn Write,
) -> Result<Ending> {
    outputs.check_standard_output(None)?;
    let targets = targets(sessions, outputs, None, cleaned_name)?;
    // No output takes the place of a session or a record, be it that of another session.
    let records: Vec<PathBuf> = sessions.iter().filter_map(|path| record_of(path)).collect();
    let inputs: Vec<&Path> = sessions.iter().chain(&records).map(PathBuf::as_path).collect();
    let talks = !outputs.quiet && !outputs.json && !outputs.takes_standard_output();
    if let ([session], [target]) = (sessions, targets.as_slice()) {
        let progress = Progress::new(1, !talks);
        let done = run(session, accepted, (target, &inputs));
        drop(progress);
        let (summary, notes) = done?;
        if talks {
            tell_notes(session, &notes, out)?;
        } else if outputs.takes_standard_output() && !outputs.quiet {
            tell_notes(session, &notes, &mut std::io::stderr())?;
        }
        return tell(outputs, &summary, out);
    }
    let jobs: Vec<(&PathBuf, Target)> = sessions.iter().zip(targets).collect();
    let results = set::for_all(&jobs, !talks, |(session, target)| run(session, accepted, (target, &inputs)));
    let mut summaries = Vec::with_capacity(results.len());
    for (session, result) in sessions.iter().zip(results) {
        if let (true, Ok((_, notes))) = (talks, &result) {
            tell_notes(session, notes, out)?;
        }
        summaries.push(result.map(|(summary, _)| summary));
    }
    set::tell(sessions, &summaries, outputs, out)
}

/// A cleaned file is named after its session, with the ending of the record.
fn cleaned_name(session: &Path) -> String {
    let stem = session.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let record = record_of(session).map(|path| file_name(&path));
    let ending = record.as_deref().map(|name| {
        let (rest, packing) = unpacked_name(name);
        let ending = rest.rsplit_once('.').map(|(_, ending)| format!(".{ending}")).unwrap_or_default();
        ending + packing.map_or("", |packing| packing.ending)
    });
    stem + ending.as_deref().filter(|ending| !ending.is_empty()).unwrap_or(".csv")
}

/// The record of a session. One that cannot be read is told as an error when it is run.
fn record_of(session: &Path) -> Option<PathBuf> {
    read(session).ok()?.data.source.path().map(Path::to_path_buf)
}

fn tell_notes(session: &Path, notes: &[String], out: &mut dyn Write) -> Result<()> {
    notes.iter().try_for_each(|note| {
        print(out, &format!("{}: {}\n", printable(&session.display().to_string()), printable(note))).map(|_| ())
    })
}

fn run(path: &Path, accepted: Accepted, (target, inputs): (&Target, &[&Path])) -> Result<(Summary, Vec<String>)> {
    let outputs = &target.outputs;
    let opened = open(path, accepted)?;
    let analysed = Analysed::of(&opened.session, &opened.track, &Stop::never())?;
    let mut summary = Summary::of(&opened.track, &opened.session, &analysed);
    if !outputs.dry_run {
        target.make_folders()?;
    }
    let mut files = Outputs::new(outputs.force, inputs).or_standard_output().dry(outputs.dry_run);
    clean::stage(&mut files, outputs, &opened.track, &opened.session, &analysed, &mut summary)?;
    files.commit()?;
    let mut notes: Vec<String> = opened.appended.map(Grown::words).into_iter().collect();
    notes.extend(opened.notes);
    if outputs.json {
        summary.notes.splice(0..0, notes.iter().cloned());
    }
    if let Some(then) = opened.session.result.as_ref().filter(|_| outputs.json || !outputs.quiet) {
        // Columns of flags are no part of the cleaned file that the session recorded.
        let cleaned = summary.clean_sha256.clone().filter(|_| outputs.flag_columns.is_none());
        let now = match cleaned {
            Some(clean_sha256) => Recorded {
                flagged: analysed.flagged(),
                clean_sha256,
                flags_sha256: Some(flags_sha256(&opened.track, &opened.session, &analysed)?),
            },
            None => analysed.recorded(&opened.session, &opened.track)?,
        };
        let mut differs = opened.altered.unwrap_or_default();
        differs.extend(check(Some(then), &now));
        summary.differs = Some(differs);
    }
    Ok((summary, notes))
}

/// What was found out about one session.
#[derive(Debug, Default, serde::Serialize)]
struct Checked {
    session: String,
    matches: bool,
    differences: Vec<String>,
    /// What was not looked at, and why.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<String>,
    /// Why it could not be run.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

impl Checked {
    /// In a line.
    fn words(&self) -> String {
        let verdict = match &self.error {
            Some(_) => "failed".to_owned(),
            None if self.matches => "same result".to_owned(),
            None => self.differences.join("; "),
        };
        [&[verdict], self.notes.as_slice()].concat().join("; ")
    }
}

pub(super) fn check_all(
    sessions: &[PathBuf],
    accepted: Accepted,
    outputs: &OutputArgs,
    out: &mut dyn Write,
) -> Result<Ending> {
    let mut results = set::for_all(sessions, outputs.quiet || outputs.json, |path| checked(path, accepted));
    // One session alone fails like any command.
    if let ([_], true) = (sessions, results.iter().any(Result::is_err)) {
        results.pop().transpose()?;
    }
    set::tell_errors(sessions, &results);
    let failed = results.iter().any(Result::is_err);
    let mut all = Vec::with_capacity(results.len());
    for (path, result) in sessions.iter().zip(results) {
        let checked = result.unwrap_or_else(|e| Checked { error: Some(e.to_string()), ..Checked::default() });
        all.push(Checked { session: path.display().to_string(), ..checked });
    }
    let ending = if failed {
        Ending::Failed
    } else if all.iter().all(|c| c.matches) {
        Ending::Done
    } else {
        Ending::Differs
    };
    if outputs.json {
        super::print_json(out, &all)?;
        return Ok(ending);
    }
    for checked in all.iter().filter(|c| !outputs.quiet || !c.matches) {
        print(out, &format!("{}: {}\n", printable(&checked.session), printable(&checked.words())))?;
    }
    Ok(ending)
}

/// How the result of a session differs from what it recorded, and how the session from the one that was saved. Data
/// that have changed are a difference, not an error, unless they can no longer be loaded. Rows that were added to the
/// record are left out where they are accepted: what was recorded is the result without them.
fn checked(path: &Path, accepted: Accepted) -> Result<Checked> {
    let appended = match accepted.appended {
        Appended::TakenIn => Appended::LeftOut,
        other => other,
    };
    let opened = match open(path, Accepted { appended, ..accepted }) {
        Ok(opened) => opened,
        Err(e @ (Error::Changed { .. } | Error::Appended { .. })) => {
            return Ok(Checked { differences: vec![on_one_line(&e)], ..Checked::default() });
        }
        Err(e) => return Err(e),
    };
    let analysed = Analysed::of(&opened.session, &opened.track, &Stop::never())?;
    let now = analysed.recorded(&opened.session, &opened.track)?;
    let mut notes: Vec<String> = opened.appended.map(Grown::words).into_iter().collect();
    if opened.altered.is_none() {
        notes.push("not checked: settings, decisions and notes against the saved ones (format 1 has no digest)".into());
    }
    let mut differences = opened.notes;
    differences.extend(opened.altered.unwrap_or_default());
    differences.extend(check(opened.session.result.as_ref(), &now));
    Ok(Checked { matches: differences.is_empty(), differences, notes, ..Checked::default() })
}
