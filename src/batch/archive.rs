//! `replay --archive`: a session on the tracks of a folder, and the digest of what comes out.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use serde::Serialize;

use super::progress::Progress;
use super::{Ending, print, print_json};
use crate::cli::{ArchiveArgs, OutputArgs};
use crate::error::{Error, Result};
use crate::session::archive::{Archive, Named, Step, Template, recorded, replay_folder, with_archive};
use crate::track::{Outputs, printable};

/// What came out.
#[derive(Debug, Serialize)]
struct Told<'a> {
    session: String,
    archive: String,
    #[serde(flatten)]
    result: &'a Archive,
    /// How it differs from what the session recorded; only with --check.
    #[serde(skip_serializing_if = "Option::is_none")]
    differences: Option<Vec<String>>,
}

pub(super) fn run(
    sessions: &[PathBuf],
    (folder, args, check): (&Path, &ArchiveArgs, bool),
    outputs: &OutputArgs,
    out: &mut dyn Write,
) -> Result<Ending> {
    let [session] = sessions else {
        return Err(Error::usage(format!("{} sessions for one archive", sessions.len()), "give one session"));
    };
    let then = recorded(session)?;
    let mut columns = args.columns();
    if let Some(archive) = then.archive.as_ref().filter(|_| check) {
        let Named { time, track, unit_ns } = columns;
        columns = Named { time: time.or(archive.time.clone()), track: track.or(archive.track.clone()), unit_ns };
    }
    let template = Template::read(session, args.decisions(), columns.clone())?;
    let progress: OnceLock<Progress> = OnceLock::new();
    let quiet = outputs.quiet || outputs.json;
    let summaries = replay_folder(&template, folder, |step| match step {
        Step::Files(count) => drop(progress.set(Progress::new(count, quiet))),
        Step::Read => progress.get().into_iter().for_each(Progress::done),
    })?;
    drop(progress);
    let result = Archive { time: columns.time, track: columns.track, ..Archive::of(&summaries) };
    if args.record {
        write(session, &result)?;
    }
    let differences = check.then(|| {
        let mut found = then.altered.unwrap_or_default();
        found.extend(result.differences(then.archive.as_ref()));
        found
    });
    let ending = if differences.as_ref().is_none_or(Vec::is_empty) { Ending::Done } else { Ending::Differs };
    let (session, archive) = (session.display().to_string(), folder.display().to_string());
    let told = Told { session, archive, result: &result, differences };
    if outputs.json {
        print_json(out, &told)?;
    } else if !outputs.quiet || told.differences.as_ref().is_some_and(|found| !found.is_empty()) {
        print(out, &format!("{}: {}\n", printable(&told.session), printable(&words(&told))))?;
    }
    Ok(ending)
}

fn words(told: &Told<'_>) -> String {
    match &told.differences {
        Some(found) if found.is_empty() => "same result".to_owned(),
        Some(found) => found.join("; "),
        None => {
            let Archive { tracks, rows, flagged, digest, .. } = told.result;
            format!("{tracks} tracks, {rows} rows, {flagged} samples flagged, digest {digest}")
        }
    }
}

/// Writes the result into the session.
fn write(session: &Path, archive: &Archive) -> Result<()> {
    let text = std::fs::read_to_string(session).map_err(Error::io("read", session))?;
    let text = with_archive(session, &text, archive)?;
    let mut files = Outputs::new(true, &[]);
    files.stage(session, |w| w.write_all(text.as_bytes()).map_err(Error::io("write", session)))?;
    files.commit()
}
