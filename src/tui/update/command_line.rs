//! The command line that is equivalent, without a screen.

use std::path::{Path, PathBuf};

use super::super::message::Effect;
use super::super::model::{Model, Overlay, Tone};
use super::files::default_export;
use crate::session::{clean_command, replay_command};
use crate::track::Source;

/// What is said about a line that needs no session.
const ALONE: &str = "It gives the same bytes as :export, on any machine with the record.";
/// What is said about a line that runs a session.
const WITH_SESSION: &str = "Decisions, and channels set up differently, are in the session only.";

/// Shows the line, and copies it to the clipboard of the terminal.
pub(super) fn show(model: &mut Model, output: Option<PathBuf>) -> Vec<Effect> {
    let output = output.unwrap_or_else(|| default_export(&model.track));
    let (line, about) = match clean_command(&model.document(), &model.track, &output) {
        Some(line) => (line, ALONE),
        None => match saved(model).map(|session| replay_command(session, &output)) {
            Some(line) => (line, WITH_SESSION),
            None => {
                let why = match &model.track.source {
                    Source::BuiltIn { .. } => "the built-in record is replayed from a session",
                    Source::File(_) | Source::Input(_) => {
                        "decisions and differences between channels are in a session only"
                    }
                };
                model.say(Tone::Warning, format!("{why}: :w saves one, then this shows the line that replays it"));
                return Vec::new();
            }
        },
    };
    model.overlay = Overlay::CommandLine(line.clone(), about);
    vec![Effect::Copy(line)]
}

/// The saved session, as long as it says what is on the screen.
fn saved(model: &Model) -> Option<&Path> {
    model.file.as_deref().filter(|_| !model.unsaved())
}
