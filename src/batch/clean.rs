//! `clean`: detect and repair; and the writing of outputs that `replay` shares.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::advise;
use super::progress::Progress;
use super::set;
use super::suggest;
use super::targets::{Target, file_name, targets};
use super::{Ending, set_threads, tell};
use crate::cli::{OutputArgs, Shared};
use crate::error::{Error, Result};
use crate::report::written::{self, Written};
use crate::report::{Byline, Summary, diagnostics, flags, report};
use crate::session::{
    Analysed, FlagColumn, OutputValue, Plan, Session, Setup, changed, clean_sha256, document, flag_columns, unfiltered,
    write_cleaned, write_flagged, write_flagged_columns,
};
use crate::stop::Stop;
use crate::track::{Changes, CopyForm, Outputs, Source, Track, copy_form, load, printable, write_columns};

/// What is done with each record.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked<'a> {
    /// How to load and judge it.
    pub(super) shared: &'a Shared,
    /// True where the suggested thresholds are taken.
    pub(super) suggested: bool,
    /// Which values the cleaned file has.
    pub(super) value: OutputValue,
}

pub(super) fn run(
    files: &[PathBuf],
    asked: &Asked<'_>,
    outputs: &OutputArgs,
    save_session: Option<&Path>,
    out: &mut dyn Write,
) -> Result<Ending> {
    let Asked { shared, suggested, .. } = *asked;
    set_threads(shared.threads)?;
    let setup = if shared.is_auto() { shared.setup_before_choice()? } else { shared.setup()? };
    outputs.check_standard_output(save_session)?;
    if suggested {
        suggest::check(shared, &setup)?;
    }
    let all: Vec<&Path> = files.iter().map(PathBuf::as_path).collect();
    let work = |file: &Path, target: &Target| one(file, asked, &setup, (target, &all));
    let targets = targets(files, outputs, save_session, file_name)?;
    if let ([file], [target]) = (files, targets.as_slice()) {
        let progress = Progress::new(1, outputs.quiet || outputs.json);
        let done = work(file, target);
        drop(progress);
        return tell(outputs, &done?, out);
    }
    let jobs: Vec<(&PathBuf, Target)> = files.iter().zip(targets).collect();
    let quiet = outputs.quiet || outputs.json;
    let results = set::for_all(&jobs, quiet, |(file, target)| work(file, target));
    set::tell(files, &results, outputs, out)
}

fn one(
    file: &Path,
    &Asked { shared, suggested, value }: &Asked<'_>,
    setup: &Setup,
    (target, inputs): (&Target, &[&Path]),
) -> Result<Summary> {
    let outputs = &target.outputs;
    let mut options = shared.load.options(shared.rate.as_deref());
    options.beside.extend(shared.reference.clone());
    let track = load(&Source::of(file)?, &options)?;
    let mut session = Session { value, ..Session::new(&track, shared.load.options(None), setup) };
    shared.prepare.prepare(&mut session, &track, shared.preset)?;
    // A rate channel that was loaded beside the named ones is not judged.
    if !shared.load.channel.is_empty() {
        session.plans.retain(|p| any(&track, &shared.load.channel, p) || !any(&track, &shared.rate, p));
    }
    session.plans.retain(|p| !any(&track, &shared.reference, p));
    let chosen = if shared.is_auto() { advise::choose(&mut session, &track, shared)? } else { Vec::new() };
    // These have no key of their own in the session.
    let suggested = if suggested { suggest::suggest(&mut session, &track)? } else { Vec::new() };
    let analysed = Analysed::of(&session, &track, &Stop::never())?;
    let mut summary = Summary::of(&track, &session, &analysed);
    summary
        .channels
        .iter_mut()
        .zip(chosen.iter().chain(&suggested))
        .for_each(|(channel, note)| channel.warnings.insert(0, note.clone()));
    if let Some(reference) = &shared.reference {
        summary.compare_with(&track, &analysed, reference)?;
    }
    if !outputs.dry_run {
        target.make_folders()?;
    }
    let mut files = Outputs::new(outputs.force, inputs).or_standard_output().dry(outputs.dry_run);
    stage(&mut files, outputs, &track, &session, &analysed, &mut summary)?;
    if let Some(path) = &target.session {
        let text = suggest::noted(&document(&mut session, &track, &analysed, path)?, &suggested);
        files.stage(path, |w| w.write_all(text.as_bytes()).map_err(Error::io("write", path)))?;
    }
    if let Some(told) = &mut summary.written {
        told.note(written::SESSION, target.session.as_deref(), None);
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
    let mut told = Written { dry: outputs.dry_run, ..Written::default() };
    let changes = outputs.output.as_ref().map(|_| analysed.changes(track));
    let changed_cells = changes.as_ref().map(|changes| changes.cells.len());
    told.note(written::CLEANED, outputs.output.as_deref(), changed_cells);
    summary.notes.extend(unfiltered(session, analysed));
    if let (Some(path), Some(changes)) = (&outputs.output, &changes) {
        stage_cleaned(files, (path, outputs), track, (analysed, changes), summary)?;
    }
    told.note(written::CHANGES, outputs.changed.as_deref(), None);
    if let Some(path) = &outputs.changed {
        files.stage(path, |w| changed(track, session, analysed, w))?;
    }
    told.note(written::FLAGS, outputs.flags.as_deref(), None);
    if let Some(path) = &outputs.flags {
        files.stage(path, |w| flags(track, session, analysed, w))?;
    }
    told.note(written::DIAGNOSTICS, outputs.diagnostics.as_deref(), None);
    if let Some(path) = &outputs.diagnostics {
        files.stage(path, |w| diagnostics(track, session, analysed, w))?;
    }
    told.note(written::REPORT, outputs.report.as_deref(), None);
    if let Some(path) = &outputs.report {
        let byline = Byline::today(outputs.analyst.clone()).beside(path, outputs.flags.as_deref());
        files.stage(path, |w| report(track, session, analysed, (&byline, path), w))?;
    }
    summary.written = Some(told);
    Ok(())
}

/// Prepares the cleaned record.
fn stage_cleaned(
    files: &mut Outputs,
    (path, outputs): (&Path, &OutputArgs),
    track: &Track,
    (analysed, changes): (&Analysed, &Changes),
    summary: &mut Summary,
) -> Result<()> {
    let flags = outputs.flag_columns.map(|scheme| (scheme, flag_columns(track, analysed)));
    let columns = copy_form(path, track)? == CopyForm::Columns;
    if let Some((_, flags)) = flags.as_ref().filter(|_| !columns) {
        summary.notes.extend(nameless(track, flags));
    }
    let mut text = None;
    let write = |w: &mut dyn Write| match (&flags, columns) {
        (None, true) => write_columns(track, changes, None, w),
        (Some((scheme, flags)), true) => write_flagged_columns(track, (changes, flags), scheme, w),
        (None, false) => write_cleaned(track, changes, w).map(|sha256| text = Some(sha256)),
        (Some((scheme, flags)), false) => {
            write_flagged(track, (changes, flags), scheme, w).map(|sha256| text = Some(sha256))
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
        None => clean_sha256(track, changes)?,
    });
    Ok(())
}
