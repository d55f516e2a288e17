//! Opening a record or a session in place of the one that is open.

use std::path::PathBuf;

use super::super::super::files::{Purpose, Request, Task};
use super::super::super::message::Effect;
use super::super::super::model::{Dialog, Model, Overlay, Tone, Waiting};
use super::super::super::words::counted;
use super::{effect, keep};
use crate::error::{Result, on_one_line};
use crate::track::printable;

/// Opens the file of this name, asking when something is not saved.
pub(in super::super) fn open(model: &mut Model, path: PathBuf) -> Vec<Effect> {
    ask(model, Request::file(path), None)
}

/// Asks when something is not saved, otherwise begins.
pub(super) fn ask(model: &mut Model, request: Request, back: Option<Box<Dialog>>) -> Vec<Effect> {
    let at_stake = match request.purpose {
        Purpose::Other => true,
        // What fits is kept: only decisions can be lost.
        Purpose::Correct => model.session.plans.iter().any(|p| !p.decisions.is_empty()),
        Purpose::TakeIn => false,
    };
    if model.unsaved() && at_stake {
        return keep(model, Dialog::Unsaved(request));
    }
    begin(model, request, back)
}

/// Begins to load; the answer is awaited.
pub(in super::super) fn begin(model: &mut Model, request: Request, back: Option<Box<Dialog>>) -> Vec<Effect> {
    model.ticket += 1;
    let ticket = model.ticket;
    let name = printable(&request.source.name());
    keep(model, Dialog::Waiting(Waiting { ticket, name, back }));
    effect(Task::Open { ticket, request })
}

/// The answer: the new workbench takes the place of the old, unless nobody waits for it any more.
pub(super) fn opened(model: &mut Model, ticket: u64, result: Result<Box<Model>>) -> Vec<Effect> {
    let waiting = match std::mem::take(&mut model.overlay) {
        Overlay::Files(dialog) => match *dialog {
            Dialog::Waiting(waiting) if waiting.ticket == ticket => waiting,
            other => return keep(model, other),
        },
        other => {
            model.overlay = other;
            return Vec::new();
        }
    };
    match result {
        Ok(new) => replace(model, *new),
        Err(e) => {
            let text = on_one_line(&e);
            if let Some(dialog) = waiting.back {
                let dialog = match *dialog {
                    Dialog::Browser(mut browser) => {
                        browser.said = Some((text, true));
                        Dialog::Browser(browser)
                    }
                    other => {
                        model.say(Tone::Error, text);
                        other
                    }
                };
                return keep(model, dialog);
            }
            model.say(Tone::Error, text);
            Vec::new()
        }
    }
}

fn replace(model: &mut Model, new: Model) -> Vec<Effect> {
    let old = std::mem::replace(model, new);
    model.keep_screen_of(old);
    if model.toast.is_none() {
        let name = printable(&model.track.source.name());
        let (rows, channels) = (counted(model.track.rows, "row"), counted(model.channels.len(), "channel"));
        model.say(Tone::Done, format!("opened {name}: {rows}, {channels}"));
    }
    let path = model.file.clone().or_else(|| model.track.source.path().map(std::path::Path::to_path_buf));
    let mut effects = vec![Effect::Files(Task::Begin), Effect::Analyse(model.shown)];
    effects.extend(path.map(|path| Effect::Files(Task::Remember(path))));
    effects
}
