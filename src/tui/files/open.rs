//! A record or session loaded, with the model of a workbench on it.

use std::path::PathBuf;

use super::super::model::{Model, Tone};
use super::super::words::counted;
use super::super::{Look, Opening};
use super::{Request, is_session};
use crate::error::Result;
use crate::session::{Session, Setup, open_all};
use crate::stop::Stop;
use crate::track::{Source, Track, Wanted, load_while};

/// What stays when the record that is open is loaded in another way.
pub(super) struct Keep {
    session: Session,
    file: Option<PathBuf>,
    unsaved: bool,
}

impl Keep {
    /// Of the workbench as it is.
    pub(super) fn of(model: &Model) -> Self {
        Self { session: model.session.clone(), file: model.file.clone(), unsaved: model.unsaved() }
    }
}

/// Loads what is asked for; with `keep`, setup and decisions of the session before stay where they fit.
///
/// # Errors
/// As [`load_while`] and [`open_all`]; [`crate::error::Error::Stopped`] when nobody waits for it any more.
pub(super) fn open(request: Request, keep: Option<Keep>, look: Look, stop: &Stop) -> Result<Model> {
    let still = || !stop.requested();
    let wanted = Wanted::as_long_as(&still);
    if let Source::File(path) = &request.source
        && is_session(path)
    {
        return Ok(Opening::from((open_all(path, false, wanted)?, path.clone())).model(look));
    }
    let track = load_while(&request.source, &request.options, wanted)?;
    let mut options = request.options;
    options.channels.clear();
    let mut session = Session::new(&track, options, &Setup::standard()).with_suggestions(&track);
    let Some(keep) = keep else {
        return Ok(Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() }.model(look));
    };
    let kept = carry(&keep.session, &mut session, &track);
    let mut model = Opening { track, session, file: keep.file, notes: Vec::new(), own: Vec::new() }.model(look);
    model.channels.iter_mut().zip(&kept.plans).for_each(|(channel, kept)| channel.touched |= kept);
    // What was saved is a session on the record as it was loaded then.
    model.revision = u64::from(keep.unsaved || model.file.is_some() || kept.decisions > 0);
    let notes = model.toast.take().map_or(String::new(), |t| format!(" · {}", t.text));
    model.say(Tone::Done, kept.words() + &notes);
    Ok(model)
}

/// What was carried over.
struct Kept {
    /// For each plan, whether it has a setup of its own or decisions.
    plans: Vec<bool>,
    decisions: usize,
    lost: usize,
    same_rows: bool,
}

impl Kept {
    fn words(&self) -> String {
        let lost = match (self.lost, self.same_rows) {
            (0, _) => String::new(),
            (n, true) => format!(", {n} without a sample now dropped"),
            (n, false) => format!(", {n} dropped: the rows are not the same"),
        };
        format!("loaded again; settings kept, {} kept{lost}", counted(self.decisions, "decision"))
    }
}

/// Takes setups over to channels of the same name, and decisions where rows are the same and have a sample.
fn carry(before: &Session, session: &mut Session, track: &Track) -> Kept {
    let same_rows = before.data.sha256 == track.sha256 && before.data.rows == track.rows;
    let mut kept = Kept { plans: Vec::new(), decisions: 0, lost: 0, same_rows };
    let total: usize = before.plans.iter().map(|p| p.decisions.len()).sum();
    for plan in &mut session.plans {
        let Some(old) = before.plans.iter().find(|p| p.channel == plan.channel) else {
            kept.plans.push(false);
            continue;
        };
        let own = old.setup != plan.setup || !old.decisions.is_empty();
        plan.setup = old.setup.clone();
        let channel = track.channel(&plan.channel);
        let there = |row: u32| {
            let timely = track.time.seconds.get(row as usize).is_some_and(|t| t.is_finite());
            timely && channel.is_some_and(|c| c.value(row as usize).is_finite())
        };
        for (row, decision) in old.decisions.iter().filter(|(row, _)| same_rows && there(*row)) {
            plan.decisions.set(row, Some(decision.clone()));
        }
        kept.decisions += plan.decisions.len();
        kept.plans.push(own);
    }
    kept.lost = total - kept.decisions;
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::review::{Decision, Ruling};
    use crate::track::LoadOptions;
    use crate::tui::plot::Glyphs;
    use crate::tui::theme::Theme;

    fn look() -> Look {
        Look { theme: Theme::mono(), glyphs: Glyphs::Ascii }
    }

    fn opened(text: &str, options: LoadOptions, keep: Option<Keep>) -> Model {
        let source = Source::BuiltIn { name: "test", bytes: text.as_bytes().into() };
        open(Request { source, options, again: keep.is_some() }, keep, look(), &Stop::never()).unwrap()
    }

    const TEXT: &str = "t,x,y\n0,1,5\n1,2,6\n2,-99,7\n3,4,8\n";

    #[test]
    fn setup_and_decisions_stay_where_the_rows_are_the_same() {
        let mut model = opened(TEXT, LoadOptions::default(), None);
        assert!(!model.unsaved());
        model.session.plans[0].setup.set_text("k", "7").unwrap();
        let decision = Decision { ruling: Ruling::Outlier, note: "glint".into(), said: None };
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
