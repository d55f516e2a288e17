//! Saving and exporting, and taking results in.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::super::action::Action;
use super::super::files::Task;
use super::super::message::{Effect, OutputKind, Written};
use super::super::model::{Dialog, Model, Overlay, PromptKind, Tone};
use super::super::plot::ResidualPlot;
use super::{dialog, prompt, queue};
use crate::error::{Error, Result, on_one_line};
use crate::plot::Drawn;
use crate::session::folder_of;
use crate::track::{Source, Track, unpacked_name};

pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    Some(match action {
        // Where it goes is shown before anything is written there for the first time.
        Action::Save if model.file.is_some() => save(model, None, false, false),
        Action::Save | Action::SaveAs => {
            let path = model.file.clone().unwrap_or_else(|| default_session(&model.track.source));
            prompt(model, PromptKind::SaveAs, &path.to_string_lossy())
        }
        Action::Export => dialog::export_dialog(model),
        Action::Open => dialog::browse(model),
        _ => return None,
    })
}

/// Where a session on this record is saved when nobody says where.
#[must_use]
pub fn default_session(source: &Source) -> PathBuf {
    beside(source, OutputKind::Session.ending())
}

/// Where the cleaned file goes when nobody says where: a record that stores columns has a copy of its kind.
#[must_use]
pub(super) fn default_export(track: &Track) -> PathBuf {
    let name = track
        .source
        .path()
        .filter(|_| track.dialect.packing.is_some_and(|packing| packing.is_columnar() && packing.is_written()));
    match name.and_then(Path::extension) {
        Some(own) => beside(&track.source, &format!(".clean.{}", own.to_string_lossy())),
        None => beside(&track.source, OutputKind::Cleaned.ending()),
    }
}

/// Where the report goes when nobody says where.
pub(super) fn default_report(source: &Source) -> PathBuf {
    beside(source, OutputKind::Report.ending())
}

/// Where whatever is made of a record lies when nobody says where: beside the record, wherever the workbench was
/// started; in the current folder for a record without one.
pub(super) fn beside(source: &Source, ending: &str) -> PathBuf {
    let folder = source.path().map(folder_of).filter(|f| f != Path::new(".")).unwrap_or_default();
    folder.join(format!("{}{ending}", stem(source)))
}

/// The name of a record without folder and ending.
fn stem(source: &Source) -> String {
    let name = match source {
        Source::File(path) => path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default(),
        Source::BuiltIn { name, .. } => name.rsplit(':').next().unwrap_or(name).to_owned(),
        Source::Input(_) => source.name(),
    };
    let (name, _) = unpacked_name(&name);
    Path::new(name).file_stem().map_or_else(|| name.to_owned(), |s| s.to_string_lossy().into_owned())
}

pub(super) fn save(model: &mut Model, path: Option<PathBuf>, force: bool, then_quit: bool) -> Vec<Effect> {
    // The file this session was opened from or saved to before is written again without asking, where nobody else has
    // changed it since: that is seen to when it is written.
    let path = path.or_else(|| model.file.clone()).unwrap_or_else(|| default_session(&model.track.source));
    model.say(Tone::Done, format!("saving {} …", path.display()));
    vec![Effect::Save { path, overwrite: force, then_quit }]
}

pub(super) fn written(model: &mut Model, what: &Written, path: &Path, result: Result<String>) -> Vec<Effect> {
    match result {
        Ok(text) => {
            model.say(Tone::Done, text);
            // A dialog that asked for the files has done its work.
            if matches!(&model.overlay, Overlay::Files(dialog) if matches!(**dialog, Dialog::Export(_))) {
                model.overlay = Overlay::None;
            }
            what.session(path).map(|path| saved(model, what, path)).unwrap_or_default()
        }
        Err(Error::Exists(there)) => {
            model.toast = None;
            dialog::ask_over(model, there, again(what, path));
            Vec::new()
        }
        Err(e) => {
            model.then_open = None;
            let failed = if matches!(what, Written::Session { .. }) { "not saved" } else { "not written" };
            model.say(Tone::Error, format!("{failed}: {}", on_one_line(&e)));
            Vec::new()
        }
    }
}

/// The session is in a file: what was waiting for that goes on.
fn saved(model: &mut Model, what: &Written, path: &Path) -> Vec<Effect> {
    model.saved_revision = what.revision();
    model.file = Some(path.to_path_buf());
    let remember = Effect::Files(Task::Remember(path.to_path_buf()));
    if model.unsaved() {
        return vec![remember];
    }
    if matches!(what, Written::Session { then_quit: true, .. }) {
        return vec![remember, Effect::Quit];
    }
    let mut effects = vec![remember];
    if let Some(request) = model.then_open.take() {
        effects.extend(dialog::begin_opening(model, request));
    }
    effects
}

/// The same once more, over what is there.
fn again(what: &Written, path: &Path) -> Effect {
    match what {
        Written::Session { then_quit, .. } => {
            Effect::Save { path: path.to_path_buf(), overwrite: true, then_quit: *then_quit }
        }
        Written::Exported { outputs, .. } => Effect::Export { outputs: outputs.clone(), overwrite: true },
    }
}

/// Takes a result in.
pub(super) fn arrange(model: &mut Model, plan: usize, mut drawn: Drawn) {
    let before = model.channels[plan].drawn.as_ref().map(|d| &d.outcome.detection);
    let judged = before.is_some_and(|before| !Arc::ptr_eq(before, &drawn.outcome.detection));
    let in_sight = if judged && plan == model.shown { queue::in_sight(model) } else { Vec::new() };
    let state = &mut model.channels[plan];
    state.flags = std::mem::take(&mut drawn.arranged);
    state.residual_top = ResidualPlot::top_after(state.residual_top, drawn.threshold);
    state.results += 1;
    state.drawn = Some(Arc::new(drawn));
    state.stale = false;
    // What stood in the way of a result no longer does. Whatever else is said stays.
    if let Some(error) = state.error.take() {
        model.toast.take_if(|toast| toast.text == error);
    }
    super::compare::refresh(model, plan);
    queue::arrange(model, plan);
    queue::stay(model, &in_sight);
}
