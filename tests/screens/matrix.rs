//! The matrix of frames: every state of the workbench at both sizes, in colour and on a plain terminal. Each
//! snapshot holds the text, for people, and the styles, which say what the text does not.

use insta::assert_debug_snapshot;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use wildpoint::tui::message::Message;
use wildpoint::tui::update::update;

use crate::workbench::{ASCII_MONO, Bench, UNICODE_DARK};

/// The sizes, by their names in the snapshots.
const SIZES: [(&str, (u16, u16)); 2] = [("80x24", (80, 24)), ("120x40", (120, 40))];

/// Makes a state at a size and keeps its frame, for each size and look.
fn matrix(name: &str, make: impl Fn(Bench) -> Bench) {
    for (look_name, look) in [("dark", UNICODE_DARK), ("ascii_mono", ASCII_MONO)] {
        for (size_name, size) in SIZES {
            let bench = make(Bench::unanswered("demo.csv", look).size(size));
            assert_debug_snapshot!(format!("{name}_{size_name}_{look_name}"), bench.buffer());
        }
    }
}

fn judged(mut bench: Bench) -> Bench {
    bench.judge(0);
    bench
}

#[test]
fn start() {
    matrix("start", |bench| bench);
}

#[test]
fn loaded() {
    matrix("loaded", judged);
}

#[test]
fn review() {
    matrix("review", |bench| judged(bench).keys("n r a n c Tab Enter n z"));
}

#[test]
fn range() {
    matrix("range", |bench| judged(bench).keys("n z v j j j j"));
}

#[test]
fn help() {
    matrix("help", |bench| judged(bench).keys("?"));
}

#[test]
fn palette() {
    matrix("palette", |bench| judged(bench).keys(":flag"));
}

#[test]
fn picker() {
    matrix("picker", |bench| judged(bench).keys("m wind"));
}

#[test]
fn files() {
    // The first line under the cursor has been looked into.
    matrix("files", |bench| judged(bench).keys(":open Enter"));
}

#[test]
fn loader() {
    matrix("loader", |bench| judged(bench).keys(":loader Enter Down Down"));
}

#[test]
fn export() {
    matrix("export", |bench| judged(bench).keys(":export Enter Down Space"));
}

#[test]
fn computing() {
    matrix("computing", |bench| {
        let mut bench = judged(bench);
        update(&mut bench.0, Message::Key(KeyEvent::new(KeyCode::Char('.'), KeyModifiers::NONE)));
        bench.0.awaited = Some(1);
        bench
    });
}

#[test]
fn error() {
    // A command that cannot be carried out stays in its line with the reason.
    matrix("error", |bench| judged(bench).keys(":set Space k Space -3 Enter"));
}

#[test]
fn too_small() {
    for (look_name, look) in [("dark", UNICODE_DARK), ("ascii_mono", ASCII_MONO)] {
        let bench = judged(Bench::unanswered("demo.csv", look).size((39, 9)));
        assert_debug_snapshot!(format!("too_small_39x9_{look_name}"), bench.buffer());
    }
}
