//! `replay`: saved sessions again, to the same bytes; `--check` compares and writes nothing.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::{Ending, clean, print, tell};
use crate::cli::OutputArgs;
use crate::error::{Error, Result};
use crate::report::Summary;
use crate::session::{Analysed, Recorded, check, open};
use crate::stop::Stop;
use crate::track::{Outputs, printable};

pub(super) fn run_all(
    sessions: &[PathBuf],
    accept_changed: bool,
    outputs: &OutputArgs,
    out: &mut dyn Write,
) -> Result<Ending> {
    let writes = outputs.output.is_some() || outputs.flags.is_some() || outputs.diagnostics.is_some();
    if writes && sessions.len() > 1 {
        return Err(Error::usage(
            "several sessions cannot be written to one output",
            "replay them one by one, or use --check to compare them all",
        ));
    }
    let mut ending = Ending::Done;
    for path in sessions {
        if run(path, accept_changed, outputs, out)? == Ending::Differs {
            ending = Ending::Differs;
        }
    }
    Ok(ending)
}

fn run(path: &Path, accept_changed: bool, outputs: &OutputArgs, out: &mut dyn Write) -> Result<Ending> {
    let opened = open(path, accept_changed)?;
    let analysed = Analysed::of(&opened.session, &opened.track, &Stop::never())?;
    let mut summary = Summary::of(&opened.track, &opened.session, &analysed);
    let mut inputs: Vec<&Path> = opened.track.source.path().into_iter().collect();
    inputs.push(path);
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
    if !outputs.quiet && !outputs.json {
        for note in &opened.notes {
            print(out, &format!("{}: {}\n", path.display(), printable(note)))?;
        }
    }
    tell(outputs, &summary, out)
}

/// What was found out about one session.
#[derive(Debug, serde::Serialize)]
struct Checked {
    session: String,
    matches: bool,
    differences: Vec<String>,
}

pub(super) fn check_all(
    sessions: &[PathBuf],
    accept_changed: bool,
    outputs: &OutputArgs,
    out: &mut dyn Write,
) -> Result<Ending> {
    let mut all = Vec::new();
    for path in sessions {
        let differences = differences(path, accept_changed)?;
        let session = path.display().to_string();
        all.push(Checked { session, matches: differences.is_empty(), differences });
    }
    let ending = if all.iter().all(|c| c.matches) { Ending::Done } else { Ending::Differs };
    if outputs.json {
        super::print_json(out, &all)?;
        return Ok(ending);
    }
    for checked in all.iter().filter(|c| !outputs.quiet || !c.matches) {
        let verdict = if checked.matches { "same result".to_owned() } else { checked.differences.join("; ") };
        print(out, &format!("{}: {}\n", checked.session, printable(&verdict)))?;
    }
    Ok(ending)
}

/// How the result of a session differs from what it recorded. Data that have changed are a difference, not an
/// error, unless they can no longer be loaded.
fn differences(path: &Path, accept_changed: bool) -> Result<Vec<String>> {
    let opened = match open(path, accept_changed) {
        Ok(opened) => opened,
        Err(e @ Error::Changed { .. }) => return Ok(vec![e.to_string().replace("\n  ", "; ")]),
        Err(e) => return Err(e),
    };
    let analysed = Analysed::of(&opened.session, &opened.track, &Stop::never())?;
    let now = analysed.recorded(&opened.track)?;
    let mut differences = check(opened.session.result.as_ref(), &now);
    differences.splice(0..0, opened.notes);
    Ok(differences)
}
