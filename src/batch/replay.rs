//! `replay`: saved sessions again, to the same bytes; `--check` compares and writes nothing.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::set;
use super::targets::{Target, file_name, targets};
use super::{Ending, clean, print, tell};
use crate::cli::OutputArgs;
use crate::error::{Error, Result, on_one_line};
use crate::report::Summary;
use crate::session::{Analysed, Recorded, check, open, read};
use crate::stop::Stop;
use crate::track::{Outputs, printable};

pub(super) fn run_all(
    sessions: &[PathBuf],
    accept_changed: bool,
    outputs: &OutputArgs,
    out: &mut dyn Write,
) -> Result<Ending> {
    let targets = targets(sessions, outputs, None, cleaned_name)?;
    let talks = !outputs.quiet && !outputs.json;
    if let ([session], [target]) = (sessions, targets.as_slice()) {
        let (summary, notes) = run(session, accept_changed, target)?;
        if talks {
            tell_notes(session, &notes, out)?;
        }
        return tell(outputs, &summary, out);
    }
    let jobs: Vec<(&PathBuf, Target)> = sessions.iter().zip(targets).collect();
    let results = set::for_all(&jobs, !talks, |(session, target)| run(session, accept_changed, target));
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
    // A session that cannot be read is told as an error when it is run.
    let record = read(session).ok().and_then(|s| s.data.source.path().map(file_name));
    let ending = record.as_deref().and_then(|name| {
        let (rest, packed) = name.strip_suffix(".gz").map_or((name, ""), |rest| (rest, ".gz"));
        rest.rsplit_once('.').map(|(_, ending)| format!(".{ending}{packed}"))
    });
    stem + ending.as_deref().unwrap_or(".csv")
}

fn tell_notes(session: &Path, notes: &[String], out: &mut dyn Write) -> Result<()> {
    notes.iter().try_for_each(|note| {
        print(out, &format!("{}: {}\n", printable(&session.display().to_string()), printable(note))).map(|_| ())
    })
}

fn run(path: &Path, accept_changed: bool, target: &Target) -> Result<(Summary, Vec<String>)> {
    let outputs = &target.outputs;
    let opened = open(path, accept_changed)?;
    let analysed = Analysed::of(&opened.session, &opened.track, &Stop::never())?;
    let mut summary = Summary::of(&opened.track, &opened.session, &analysed);
    let mut inputs: Vec<&Path> = opened.track.source.path().into_iter().collect();
    inputs.push(path);
    target.make_folders()?;
    let mut files = Outputs::new(outputs.force, &inputs);
    clean::stage(&mut files, outputs, &opened.track, &opened.session, &analysed, &mut summary)?;
    files.commit()?;
    if let Some(then) = opened.session.result.as_ref().filter(|_| outputs.json || !outputs.quiet) {
        let now = match summary.clean_sha256.clone() {
            Some(clean_sha256) => Recorded { flagged: analysed.flagged(), clean_sha256 },
            None => analysed.recorded(&opened.track)?,
        };
        summary.differs = Some(check(Some(then), &now));
    }
    Ok((summary, opened.notes))
}

/// What was found out about one session.
#[derive(Debug, serde::Serialize)]
struct Checked {
    session: String,
    matches: bool,
    differences: Vec<String>,
    /// Why it could not be run.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

pub(super) fn check_all(
    sessions: &[PathBuf],
    accept_changed: bool,
    outputs: &OutputArgs,
    out: &mut dyn Write,
) -> Result<Ending> {
    let mut results = set::for_all(sessions, outputs.quiet || outputs.json, |path| differences(path, accept_changed));
    // One session alone fails like any command.
    if let ([_], true) = (sessions, results.iter().any(Result::is_err)) {
        results.pop().transpose()?;
    }
    set::tell_errors(sessions, &results);
    let failed = results.iter().any(Result::is_err);
    let mut all = Vec::with_capacity(results.len());
    for (path, result) in sessions.iter().zip(results) {
        let session = path.display().to_string();
        all.push(match result {
            Ok(differences) => Checked { session, matches: differences.is_empty(), differences, error: None },
            Err(e) => Checked { session, matches: false, differences: Vec::new(), error: Some(e.to_string()) },
        });
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
        let verdict = match &checked.error {
            Some(_) => "failed".to_owned(),
            None if checked.matches => "same result".to_owned(),
            None => checked.differences.join("; "),
        };
        print(out, &format!("{}: {}\n", printable(&checked.session), printable(&verdict)))?;
    }
    Ok(ending)
}

/// How the result of a session differs from what it recorded. Data that have changed are a difference, not an
/// error, unless they can no longer be loaded.
fn differences(path: &Path, accept_changed: bool) -> Result<Vec<String>> {
    let opened = match open(path, accept_changed) {
        Ok(opened) => opened,
        Err(e @ Error::Changed { .. }) => return Ok(vec![on_one_line(&e)]),
        Err(e) => return Err(e),
    };
    let analysed = Analysed::of(&opened.session, &opened.track, &Stop::never())?;
    let now = analysed.recorded(&opened.track)?;
    let mut differences = check(opened.session.result.as_ref(), &now);
    differences.splice(0..0, opened.notes);
    Ok(differences)
}
