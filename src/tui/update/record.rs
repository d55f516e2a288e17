//! What becomes of the file of the record while it is open: recorders go on writing, people replace files.

use super::super::files::{Purpose, Request};
use super::super::message::Effect;
use super::super::model::{Model, Tone};
use super::super::words::counted;
use super::dialog;
use crate::track::Standing;

/// Takes in what a look at the file has shown. It is said once, after what was said before: an answer to a key stays
/// readable. The title goes on showing it.
pub(super) fn stands(model: &mut Model, standing: Standing) {
    let before = std::mem::replace(&mut model.standing, standing);
    match (before, standing) {
        (Standing::Grown { .. }, Standing::Grown { .. }) | (_, Standing::Grown { rows: 0 }) => {}
        (_, Standing::Grown { rows }) => {
            let were = if rows == 1 { "was" } else { "were" };
            let what = format!("{} {were} added to the record", counted(rows, "row"));
            model.say_too(Tone::Warning, &format!("{what} · :reload takes them in, every decision stays"));
        }
        (Standing::Lost(_), Standing::Same) => model.say_too(Tone::Done, "the record is back as it was"),
        (_, Standing::Lost(_)) if before != standing => {
            let what = format!("the record {}", standing.words());
            let ways = ":w still saves the decisions, :decisions writes them as a table";
            model.say_too(Tone::Warning, &format!("{what} · {ways}"));
        }
        _ => {}
    }
}

/// Loads the record with the rows that were added to it.
pub(super) fn take_in(model: &mut Model) -> Vec<Effect> {
    match model.standing {
        Standing::Same | Standing::Grown { rows: 0 } => {
            model.say(Tone::Done, "no rows were added to the record");
            return Vec::new();
        }
        Standing::Lost(_) => {
            let what = format!("the record {}", model.standing.words());
            model.say(Tone::Error, format!("{what}; :w saves the decisions, :loader loads what is there now"));
            return Vec::new();
        }
        Standing::Grown { .. } => {}
    }
    let (source, options) = (model.track.source.clone(), model.session.data.options.clone());
    dialog::begin_opening(model, Request { source, options, purpose: Purpose::TakeIn })
}
