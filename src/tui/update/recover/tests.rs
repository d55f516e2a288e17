use super::*;

use std::path::PathBuf;
use std::sync::Arc;

use crate::review::{Decision, Ruling, Signature};
use crate::session::journal::Entry;
use crate::session::{Session, Setup};
use crate::track::{LoadOptions, Source, load};
use crate::tui::plot::Glyphs;
use crate::tui::theme::Theme;

/// A workbench that has been offered these.
fn model(offered: Vec<Found>) -> Model {
    let track = load(&Source::demo(), &LoadOptions::default()).unwrap();
    let session = Session::new(&track, LoadOptions::default(), &Setup::standard());
    let mut model = Model::new(Arc::new(track), session, None, Theme::mono(), Glyphs::Ascii);
    // The work began from the record alone.
    let base = model.session.plans.clone();
    model.overlay = Overlay::Recover(offered.into_iter().map(|f| Found { base: base.clone(), ..f }).collect());
    model
}

fn found(name: &str) -> Found {
    let decision =
        Decision { ruling: Ruling::Normal, note: "seen".into(), said: None, signature: Signature::default() };
    let decisions = |row, d| Entry::Decide { channel: "alt_m".into(), decisions: vec![(row, d)] };
    Found {
        path: name.into(),
        time: std::time::SystemTime::UNIX_EPOCH,
        when: "2026-01-02 03:04 UTC".into(),
        changes: 3,
        entries: vec![decisions(60, Some(decision.clone())), decisions(70, Some(decision)), decisions(60, None)],
        complete: true,
        session: Some("/nowhere/a.toml".into()),
        session_changed: false,
        added: 0,
        base: Vec::new(),
        missing: None,
    }
}

fn press(model: &mut Model, code: KeyCode) -> Vec<Effect> {
    super::super::update(model, crate::tui::message::Message::Key(KeyEvent::new(code, KeyModifiers::NONE)))
}

fn offered(name: &str, fate: Fate) -> Effect {
    Effect::Offered { path: name.into(), fate }
}

#[test]
fn what_is_taken_back_in_is_unsaved_and_can_be_undone_change_by_change() {
    let mut model = model(vec![found("a"), found("b")]);
    let plan = model.session.plans.iter().position(|p| p.channel == "alt_m").unwrap();
    let effects = press(&mut model, KeyCode::Char('r'));
    let taken = offered("a", Fate::Taken { changes: 3 });
    assert_eq!(effects, [taken, Effect::Analyse(plan)]);
    assert!(matches!(&model.overlay, Overlay::Recover(rest) if rest.len() == 1), "the next is offered");
    assert_eq!(press(&mut model, KeyCode::Esc), [offered("b", Fate::Left)]);
    let rows = |model: &Model| model.session.plans[plan].decisions.iter().map(|(row, _)| row).collect::<Vec<_>>();
    assert_eq!((rows(&model), model.unsaved(), model.shown), (vec![70], true, plan));
    assert_eq!(model.file, Some(PathBuf::from("/nowhere/a.toml")));
    for expected in [vec![60, 70], vec![60], vec![]] {
        press(&mut model, KeyCode::Char('u'));
        assert_eq!(rows(&model), expected);
    }
    assert_eq!(model.unjournalled.len(), 3, "undoing is journalled, taking back in is how the new journal begins");
}

#[test]
fn a_session_that_has_changed_since_is_not_saved_over() {
    let mut model = model(vec![Found { session_changed: true, ..found("a") }]);
    press(&mut model, KeyCode::Char('r'));
    assert_eq!((model.file.clone(), model.unsaved()), (None, true));
}

#[test]
fn what_is_dropped_makes_room_for_the_next_and_what_is_left_is_left() {
    let mut model = model(vec![found("a"), found("b"), found("c")]);
    assert_eq!(press(&mut model, KeyCode::Char('d')), [offered("a", Fate::Dropped)]);
    assert!(matches!(&model.overlay, Overlay::Recover(rest) if rest.len() == 2));
    // Any other key is not about this, and does nothing behind its back.
    assert_eq!(press(&mut model, KeyCode::Char('q')), []);
    let effects = press(&mut model, KeyCode::Esc);
    assert_eq!(effects, [offered("b", Fate::Left), offered("c", Fate::Left)]);
    assert!(matches!(model.overlay, Overlay::None) && !model.unsaved());
}

#[test]
fn what_cannot_be_taken_in_whole_is_not_taken_in() {
    let mut model = model(vec![Found { missing: Some("pitch".into()), ..found("a") }]);
    assert_eq!(press(&mut model, KeyCode::Char('r')), []);
    assert!(matches!(model.overlay, Overlay::Recover(_)) && !model.unsaved());
}
