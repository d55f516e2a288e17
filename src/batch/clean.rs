//! `clean`: detect and repair; and the writing of outputs that `replay` shares.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::set;
use super::suggest;
use super::targets::{Target, file_name, targets};
use super::{Ending, set_threads, tell};
use crate::cli::{OutputArgs, Shared};
use crate::error::{Error, Result};
use crate::report::{Summary, diagnostics, flags, report};
use crate::session::{
    Analysed, FlagColumn, Plan, Session, Setup, changed, clean_sha256, document, flag_columns, write_cleaned,
    write_flagged, write_flagged_columns,
};
use crate::stop::Stop;
use crate::track::{CopyForm, Outputs, Source, Track, copy_form, load, printable, write_columns};

pub(super) fn run(
    files: &[PathBuf],
    (shared, suggested): (&Shared, bool),
    outputs: &OutputArgs,
    save_session: Option<&Path>,
    out: &mut dyn Write,
) -> Result<Ending> {
    set_threads(shared.threads)?;
    let setup = shared.setup()?;
    outputs.check_standard_output(save_session)?;
    if suggested {
        suggest::check(shared)?;
    }
    let all: Vec<&Path> = files.iter().map(PathBuf::as_path).collect();
    let work = |file: &Path, target: &Target| one(file, (shared, suggested), &setup, (target, &all));
    let targets = targets(files, outputs, save_session, file_name)?;
    if let ([file], [target]) = (files, targets.as_slice()) {
        return tell(outputs, &work(file, target)?, out);
    }
    let jobs: Vec<(&PathBuf, Target)> = files.iter().zip(targets).collect();
    let quiet = outputs.quiet || outputs.json;
    let results = set::for_all(&jobs, quiet, |(file, target)| work(file, target));
    set::tell(files, &results, outputs, out)
}

fn one(
    file: &Path,
    (shared, suggested): (&Shared, bool),
    setup: &Setup,
    (target, inputs): (&Target, &[&Path]),
) -> Result<Summary> {
    let outputs = &target.outputs;
    let mut options = shared.load.options(shared.rate.as_deref());
    options.beside.extend(shared.reference.clone());
    let track = load(&Source::of(file)?, &options)?;
    let mut session = Session::new(&track, shared.load.options(None), setup);
    shared.prepare.prepare(&mut session, &track, shared.preset)?;
    // A rate channel that was loaded beside the named ones is not judged.
    if !shared.load.channel.is_empty() {
        session.plans.retain(|p| any(&track, &shared.load.channel, p) || !any(&track, &shared.rate, p));
    }
    session.plans.retain(|p| !any(&track, &shared.reference, p));
    let notes = if suggested { suggest::suggest(&mut session, &track)? } else { Vec::new() };
    let analysed = Analysed::of(&session, &track, &Stop::never())?;
    let mut summary = Summary::of(&track, &session, &analysed);
    summary.channels.iter_mut().zip(&notes).for_each(|(channel, note)| channel.warnings.insert(0, note.clone()));
    if let Some(reference) = &shared.reference {
        summary.compare_with(&track, &analysed, reference)?;
    }
    target.make_folders()?;
    let mut files = Outputs::new(outputs.force, inputs).or_standard_output();
    stage(&mut files, outputs, &track, &session, &analysed, &mut summary)?;
    if let Some(path) = &target.session {
        let text = suggest::noted(&document(&mut session, &track, &analysed, path)?, &notes);
        files.stage(path, |w| w.write_all(text.as_bytes()).map_err(Error::io("write", path)))?;
    }
    files.commit()?;
    Ok(summary)
}

/// True when one of the names means the channel of a plan.
fn any<'a>(track: &Track, names: impl IntoIterator<Item = &'a String>, plan: &Plan) -> bool {
    track.channel(&plan.channel).is_some_and(|c| names.into_iter().any(|name| track.means(name, c)))
}

/// What the columns of flags are called, where no line of the file can say it.
fn nameless(track: &Track, flags: &[FlagColumn]) -> Option<String> {
    let names: Vec<String> = flags.iter().map(|flag| printable(&flag.name)).collect();
    let words = || format!("no line names the columns; the last are {}", names.join(", "));
    (!track.dialect.rows.names_columns()).then(words)
}

/// Prepares the outputs that were asked for.
pub(super) fn stage(
    files: &mut Outputs,
    outputs: &OutputArgs,
    track: &Track,
    session: &Session,
    analysed: &Analysed,
    summary: &mut Summary,
) -> Result<()> {
    if let Some(path) = &outputs.output {
        let changes = analysed.changes(track);
        let flags = outputs.flag_columns.map(|scheme| (scheme, flag_columns(track, analysed)));
        let columns = copy_form(path, track)? == CopyForm::Columns;
        if let Some((_, flags)) = flags.as_ref().filter(|_| !columns) {
            summary.notes.extend(nameless(track, flags));
        }
        let mut text = None;
        let write = |w: &mut dyn Write| match (&flags, columns) {
            (None, true) => write_columns(track, &changes, None, w),
            (Some((scheme, flags)), true) => write_flagged_columns(track, (&changes, flags), scheme, w),
            (None, false) => write_cleaned(track, &changes, w).map(|sha256| text = Some(sha256)),
            (Some((scheme, flags)), false) => {
                write_flagged(track, (&changes, flags), scheme, w).map(|sha256| text = Some(sha256))
            }
        };
        if columns {
            files.stage_columns(path, write)?
        } else {
            files.stage(path, write)?
        }
        // Of the table as text, whatever form it has.
        summary.clean_sha256 = Some(match text {
            Some(sha256) => sha256,
            None => clean_sha256(track, &changes)?,
        });
    }
    if let Some(path) = &outputs.changed {
        files.stage(path, |w| changed(track, session, analysed, w))?;
    }
    if let Some(path) = &outputs.flags {
        files.stage(path, |w| flags(track, session, analysed, w))?;
    }
    if let Some(path) = &outputs.diagnostics {
        files.stage(path, |w| diagnostics(track, session, analysed, w))?;
    }
    if let Some(path) = &outputs.report {
        files.stage(path, |w| report(track, session, analysed, path, w))?;
    }
    Ok(())
}
