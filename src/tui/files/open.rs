//! A record or session loaded, with the model of a workbench on it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::super::model::{ChannelState, Model, Tone};
use super::super::words::counted;
use super::super::{Look, Opening};
use super::{Purpose, Request, is_session};
use crate::error::{Error, Result};
use crate::review::History;
use crate::session::{Edit, Plan, Session, Setup, open_all};
use crate::stop::Stop;
use crate::track::{Source, Track, Wanted, covered, load_while, printable};

/// What stays when the record that is open is loaded again.
pub(super) struct Keep {
    track: Arc<Track>,
    session: Session,
    history: History<Edit>,
    file: Option<PathBuf>,
    /// Changes that are not saved.
    unsaved: u64,
    /// Where the user is.
    places: Vec<Place>,
    shown: String,
}

/// Where the user is in a channel.
struct Place {
    channel: String,
    cursor: usize,
    knob: usize,
}

impl Keep {
    /// Of the workbench as it is.
    pub(super) fn of(model: &Model) -> Self {
        let place = |(plan, state): (&Plan, &ChannelState)| Place {
            channel: plan.channel.clone(),
            cursor: state.cursor,
            knob: state.knob,
        };
        Self {
            track: Arc::clone(&model.track),
            session: model.session.clone(),
            history: model.history.clone(),
            file: model.file.clone(),
            unsaved: model.revision.abs_diff(model.saved_revision),
            places: model.session.plans.iter().zip(&model.channels).map(place).collect(),
            shown: model.plan().channel.clone(),
        }
    }

    /// Where the rows before are among those of `track`.
    fn rows_in(&self, track: &Track) -> Result<SameRows> {
        let (before, after) = (&self.session.data, &track.sha256);
        if before.sha256 == *after && before.rows == track.rows {
            return Ok(SameRows::All);
        }
        let grown = self.track.bytes < track.bytes
            && covered(&track.source, &self.track.sha256, Some(self.track.bytes))?.is_some();
        Ok(if grown { SameRows::First } else { SameRows::None })
    }
}

/// Which rows of a record are those of the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SameRows {
    All,
    /// The first ones: others were added.
    First,
    None,
}

/// Loads what is asked for; with `keep`, setup and decisions of the session before stay where they fit.
///
/// # Errors
/// As [`load_while`] and [`open_all`]; [`crate::error::Error::Stopped`] when nobody waits for it any more;
/// [`crate::error::Error::Input`] where rows that were added cannot be taken in without losing a decision.
pub(super) fn open(request: Request, keep: Option<Keep>, look: Look, stop: &Stop) -> Result<Model> {
    let still = || !stop.requested();
    let wanted = Wanted::as_long_as(&still);
    if let Source::File(path) = &request.source
        && is_session(path)
    {
        return Ok(Opening::from((open_all(path, wanted)?, path.clone())).model(look));
    }
    let track = load_while(&request.source, &request.options, wanted)?;
    let mut options = request.options;
    options.channels.clear();
    let mut session = Session::new(&track, options, &Setup::standard()).with_suggestions(&track);
    let Some(keep) = keep else {
        return Ok(Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() }.model(look));
    };
    let same = keep.rows_in(&track)?;
    let kept = carry(&keep, &mut session, &track, same);
    if request.purpose == Purpose::TakeIn {
        kept.all_there(&keep, &track)?;
    }
    let added = track.rows.saturating_sub(keep.track.rows);
    let mut model = Opening { track, session, file: keep.file.clone(), notes: Vec::new(), own: Vec::new() }.model(look);
    model.channels.iter_mut().zip(&kept.plans).for_each(|(channel, kept)| channel.touched |= kept);
    let notes = model.toast.take().map_or(String::new(), |t| format!(" · {}", t.text));
    if request.purpose == Purpose::TakeIn {
        stay(&mut model, keep, &kept);
        model.say(Tone::Done, kept.words_after(added) + &notes);
        return Ok(model);
    }
    // What was saved is a session on the record as it was loaded then.
    model.revision = u64::from(keep.unsaved > 0 || model.file.is_some() || kept.decisions > 0);
    model.say(Tone::Done, kept.words() + &notes);
    Ok(model)
}

/// The user goes on where he was: same channel, same sample, same way back.
fn stay(model: &mut Model, keep: Keep, kept: &Kept) {
    let touched = keep.unsaved > 0 || model.file.is_some() || kept.decisions > 0;
    model.revision = keep.unsaved.max(u64::from(touched));
    let same_plans = |(a, b): (&Plan, &Plan)| a.channel == b.channel;
    let plans = &model.session.plans;
    if plans.len() == keep.session.plans.len() && plans.iter().zip(&keep.session.plans).all(same_plans) {
        model.history = keep.history;
    }
    for place in keep.places {
        if let Some(plan) = model.session.plans.iter().position(|p| p.channel == place.channel) {
            let state = &mut model.channels[plan];
            (state.cursor, state.knob) = (place.cursor, place.knob);
        }
    }
    model.shown = model.session.plans.iter().position(|p| p.channel == keep.shown).unwrap_or(model.shown);
}

/// What was carried over.
struct Kept {
    /// For each plan, whether it has a setup of its own or decisions.
    plans: Vec<bool>,
    decisions: usize,
    /// Decisions that were not, by channel and row (from 0).
    lost: Vec<(String, u32)>,
    same_rows: SameRows,
}

impl Kept {
    fn words(&self) -> String {
        let lost = match (self.lost.len(), self.same_rows) {
            (0, _) => String::new(),
            (n, SameRows::All | SameRows::First) => format!(", {n} without a sample now dropped"),
            (n, SameRows::None) => format!(", {n} dropped: the rows are not the same"),
        };
        format!("loaded again; settings kept, {} kept{lost}", counted(self.decisions, "decision"))
    }

    fn words_after(&self, added: usize) -> String {
        let torn = self.lost.first().map_or(String::new(), |(channel, row)| {
            format!(", but that on row {} of {}, which had been half written", row + 1, printable(channel))
        });
        format!("{} taken in; {} kept{torn}", counted(added, "row"), counted(self.decisions, "decision"))
    }

    /// That no decision is lost, but for one on a row that had been written in part only.
    fn all_there(&self, keep: &Keep, track: &Track) -> Result<()> {
        let lost = self.lost.iter().find(|(_, row)| *row as usize + 1 != keep.track.rows);
        let Some((channel, row)) = lost.filter(|_| self.same_rows != SameRows::None) else {
            return match self.same_rows {
                SameRows::None => Err(Error::input(
                    Path::new(&track.source.name()),
                    "it no longer begins with the rows that were loaded",
                    ":w saves the decisions, :loader loads what is there now",
                )),
                _ => Ok(()),
            };
        };
        Err(Error::input(
            Path::new(&track.source.name()),
            format!("with the added rows, row {} of {} is not what it was", row + 1, printable(channel)),
            ":w saves the session on the rows before; the added ones may be of another form",
        ))
    }
}

/// Takes setups over to channels of the same name, and decisions where rows are the same and have a sample.
fn carry(keep: &Keep, session: &mut Session, track: &Track, same_rows: SameRows) -> Kept {
    let before = &keep.session;
    let mut kept = Kept { plans: Vec::new(), decisions: 0, lost: Vec::new(), same_rows };
    for plan in &mut session.plans {
        let Some(old) = before.plans.iter().find(|p| p.channel == plan.channel) else {
            kept.plans.push(false);
            continue;
        };
        let own = old.setup != plan.setup || !old.decisions.is_empty();
        plan.setup = old.setup.clone();
        for (row, decision) in old.decisions.iter() {
            let now = sample(track, &plan.channel, row);
            let stays = match same_rows {
                SameRows::All => now.is_some(),
                // Other rows may have another head, and the last one may have been written in part.
                SameRows::First => now.is_some() && now == sample(&keep.track, &plan.channel, row),
                SameRows::None => false,
            };
            if stays {
                plan.decisions.set(row, Some(decision.clone()));
            }
        }
        kept.decisions += plan.decisions.len();
        kept.plans.push(own);
    }
    for old in &before.plans {
        let now = session.plans.iter().find(|p| p.channel == old.channel);
        let lost = old.decisions.iter().filter(|(row, _)| now.is_none_or(|p| p.decisions.get(*row).is_none()));
        kept.lost.extend(lost.map(|(row, _)| (old.channel.clone(), row)));
    }
    kept
}

/// Time and value of a row of a channel as texts, where it has both.
fn sample(track: &Track, channel: &str, row: u32) -> Option<[String; 2]> {
    let seconds = track.time.seconds.get(row as usize).copied().filter(|t| t.is_finite())?;
    let value = track.channel(channel).map(|c| c.value(row as usize)).filter(|v| v.is_finite())?;
    Some([track.time.exact_label(seconds), value.to_string()])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::review::{Decision, Ruling, Signature};
    use crate::track::LoadOptions;
    use crate::tui::plot::Glyphs;
    use crate::tui::theme::Theme;

    fn look() -> Look {
        Look { theme: Theme::mono(), glyphs: Glyphs::Ascii }
    }

    fn opened(text: &str, options: LoadOptions, keep: Option<Keep>) -> Model {
        let source = Source::BuiltIn { name: "test", bytes: text.as_bytes().into() };
        let purpose = if keep.is_some() { Purpose::Correct } else { Purpose::Other };
        open(Request { source, options, purpose }, keep, look(), &Stop::never()).unwrap()
    }

    const TEXT: &str = "t,x,y\n0,1,5\n1,2,6\n2,-99,7\n3,4,8\n";

    #[test]
    fn setup_and_decisions_stay_where_the_rows_are_the_same() {
        let mut model = opened(TEXT, LoadOptions::default(), None);
        assert!(!model.unsaved());
        model.session.plans[0].setup.set_text("k", "7").unwrap();
        let decision =
            Decision { ruling: Ruling::Outlier, note: "glint".into(), said: None, signature: Signature::default() };
        for row in [1, 2] {
            model.session.plans[0].decisions.set(row, Some(decision.clone()));
        }
        let options = LoadOptions { missing: vec!["-99".into()], ..LoadOptions::default() };
        let again = opened(TEXT, options, Some(Keep::of(&model)));
        let plan = &again.session.plans[0];
        assert_eq!(plan.setup, model.session.plans[0].setup);
        // Row 3 has no value any more.
        assert_eq!((plan.decisions.len(), plan.decisions.get(1)), (1, Some(&decision)));
        assert!(again.unsaved() && again.channels[0].touched && !again.channels[1].touched);
        assert!(again.toast.is_some_and(|t| t.text.contains("1 decision kept, 1 without a sample now dropped")));
        // Without a header there is a row more: decisions would be about other samples.
        let options = LoadOptions { header: Some(false), channels: vec!["#2".into()], ..LoadOptions::default() };
        let other = opened("0,1,5\n1,2,6\n2,-99,7\n3,4,8\n", options, Some(Keep::of(&model)));
        assert!(other.session.plans.iter().all(|p| p.decisions.is_empty()));
        assert_eq!(other.track.channels.len(), 1);
    }
}
