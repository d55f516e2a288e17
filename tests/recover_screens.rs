//! The question whether unsaved work is wanted back, as an analyst sees it.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use insta::assert_snapshot;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use wildpoint::session::{Session, Setup};
use wildpoint::track::{LoadOptions, Source, load};
use wildpoint::tui::journal::Found;
use wildpoint::tui::model::Overlay;
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::theme::Theme;
use wildpoint::tui::{Look, Opening, text_of, view};

/// The lines of the question, and the footer.
fn question(found: Vec<Found>) -> String {
    let track = load(&Source::demo(), &LoadOptions::default()).unwrap();
    let session = Session::new(&track, LoadOptions::default(), &Setup::standard());
    let opening = Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() };
    let mut model = opening.model(Look { theme: Theme::mono(), glyphs: Glyphs::Ascii });
    model.overlay = Overlay::Recover(found);
    let area = Rect { x: 0, y: 0, width: 80, height: 24 };
    let mut buffer = Buffer::empty(area);
    view::draw(&model, area, &mut buffer);
    let text = text_of(&buffer);
    let lines: Vec<&str> = text.lines().collect();
    let first = lines.iter().position(|line| line.contains("unsaved work was found")).unwrap();
    let height = lines[first + 1..].iter().position(|line| line.contains("+----------")).unwrap() + 2;
    [&lines[first..first + height], &lines[lines.len() - 1..]].concat().join("\n")
}

fn found() -> Found {
    Found {
        path: "/state/a.journal".into(),
        time: std::time::SystemTime::UNIX_EPOCH,
        when: "2026-01-02 03:04 UTC".into(),
        changes: 14,
        entries: Vec::new(),
        complete: true,
        session: None,
        session_changed: false,
        base: Vec::new(),
        missing: None,
        added: 0,
    }
}

#[test]
fn the_question_says_how_much_and_from_when() {
    assert_snapshot!("plain", question(vec![found()]));
}

#[test]
fn the_question_says_what_stands_in_the_way() {
    let session = Some("/home/a/flight\u{1b}[2J.toml".into());
    let awkward = Found { changes: 1, complete: false, session, session_changed: true, ..found() };
    assert_snapshot!("awkward", question(vec![awkward, found()]));
    let missing = Some("pitch \u{202e}deg".into());
    assert_snapshot!("missing", question(vec![Found { missing, ..found() }]));
    assert_snapshot!("grown", question(vec![Found { added: 12, ..found() }]));
}
