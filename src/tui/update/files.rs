//! Saving and exporting, and taking results in.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::super::message::{Effect, Written};
use super::super::model::{Model, Tone};
use super::super::plot::Flags;
use super::{is_session, queue};
use crate::error::Result;
use crate::plot::Drawn;
use crate::track::Source;

/// Where a session on this record is saved when nobody says where: in the current folder, since the record's own
/// may not be the analyst's.
#[must_use]
pub fn default_session(source: &Source) -> PathBuf {
    PathBuf::from(format!("{}.wild.toml", stem(source)))
}

/// Where the cleaned file goes when nobody says where.
#[must_use]
pub fn default_export(source: &Source) -> PathBuf {
    PathBuf::from(format!("{}.clean.csv", stem(source)))
}

fn stem(source: &Source) -> String {
    let name = match source {
        Source::File(path) => path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default(),
        Source::BuiltIn { name, .. } => name.rsplit(':').next().unwrap_or(name).to_owned(),
    };
    let name = name.strip_suffix(".gz").unwrap_or(&name);
    Path::new(name).file_stem().map_or_else(|| name.to_owned(), |s| s.to_string_lossy().into_owned())
}

pub(super) fn save(model: &mut Model, path: Option<PathBuf>, force: bool, then_quit: bool) -> Vec<Effect> {
    // The file this session was opened from or saved to before may be written again without asking.
    let known = path.is_none() || path == model.file;
    let overwrite = force || (known && model.file.is_some());
    let path = path.or_else(|| model.file.clone()).unwrap_or_else(|| default_session(&model.track.source));
    model.say(Tone::Done, format!("saving {} …", path.display()));
    vec![Effect::Save { path, overwrite, then_quit }]
}

pub(super) fn export(model: &mut Model, path: Option<PathBuf>, force: bool) -> Vec<Effect> {
    let path = path.unwrap_or_else(|| default_export(&model.track.source));
    model.say(Tone::Done, format!("writing {} …", path.display()));
    vec![Effect::Export { path, overwrite: force }]
}

pub(super) fn written(model: &mut Model, what: Written, path: &Path, result: Result<String>) -> Vec<Effect> {
    match result {
        Ok(text) => {
            model.say(Tone::Done, text);
            if let Written::Session { revision, then_quit } = what {
                model.saved_revision = revision;
                model.file = Some(path.to_path_buf());
                if then_quit && !model.unsaved() {
                    return vec![Effect::Quit];
                }
            }
        }
        Err(e) => {
            let way = if is_session(what) { ":w! NAME overwrites" } else { ":export! NAME overwrites" };
            let text = match e {
                crate::error::Error::Exists(path) => format!("{} is there already · {way}", path.display()),
                other => other.to_string().replace("\n  ", "; "),
            };
            let failed = if is_session(what) { "not saved" } else { "not written" };
            model.say(Tone::Error, format!("{failed}: {text}"));
        }
    }
    Vec::new()
}

/// Takes a result in.
pub(super) fn arrange(model: &mut Model, plan: usize, drawn: Drawn) {
    let channel = model.channels[plan].channel;
    let samples = Arc::clone(&model.channels[plan].samples);
    let series = samples.series(&model.track.channels[channel], &model.track.time);
    let flags = Flags::new(&drawn.flags(&series));
    let state = &mut model.channels[plan];
    state.flags = flags;
    state.results += 1;
    state.drawn = Some(Arc::new(drawn));
    state.stale = false;
    state.error = None;
    super::compare::refresh(model, plan);
    // What stood in the way no longer does.
    if model.toast.as_ref().is_some_and(|t| t.tone == Tone::Error) {
        model.toast = None;
    }
    queue::arrange(model, plan);
}
