//! The workbench reads at every size, in every set of glyphs and colours, whatever the names in the file are.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::fmt::Write;
use std::path::{Path, PathBuf};

use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier};
use unicode_width::UnicodeWidthStr;
use wildpoint::session::{Preset, Session, Setup, method_of_id};
use wildpoint::stop::Stop;
use wildpoint::track::{LoadOptions, Source, load};
use wildpoint::tui::jobs::Judge;
use wildpoint::tui::message::{Effect, Message};
use wildpoint::tui::model::Model;
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::theme::{ColorDepth, Theme};
use wildpoint::tui::update::update;
use wildpoint::tui::{Look, Opening, view};

/// Sizes from too small to large; 60x16 and 40x10 are the least of their layouts.
const SIZES: [(u16, u16); 9] =
    [(200, 60), (120, 40), (110, 24), (80, 24), (70, 18), (60, 16), (40, 10), (39, 9), (3, 1)];

/// Names that a terminal would obey, reorder, hide or draw two cells wide.
const HOSTILE: [&str; 3] = [
    "\u{1b}]0;owned\u{7}a",
    "高度高度高度高度高度高度高度高度高度高度高度高度 (米)",
    "x\u{202e}\u{200b}\u{301}\u{301}\u{301}",
];

/// A record of 120 samples a channel, with a wild point in each.
fn record(folder: &Path, names: [&str; 3]) -> PathBuf {
    let mut text = format!("t,{}\n", names.map(|n| format!("\"{n}\"")).join(","));
    for i in 0..120 {
        let y = if i == 60 { 90.0 } else { f64::from(i * 37 % 11) * 0.1 };
        let _ = writeln!(text, "{i},{y},{},{}", y + 1.0, -y);
    }
    let path = folder.join("record.csv");
    std::fs::write(&path, text).unwrap();
    path
}

fn model(names: [&str; 3], glyphs: Glyphs, depth: ColorDepth, light: bool) -> Model {
    let folder = tempfile::TempDir::new().unwrap();
    let options = LoadOptions::default();
    let track = load(&Source::File(record(folder.path(), names)), &options).unwrap();
    assert_eq!(track.channels.len(), 3);
    let setup = Setup::new(method_of_id("hampel").unwrap(), Preset::Default);
    let session = Session::new(&track, options, &setup);
    let opening = Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() };
    let mut model = opening.model(Look { theme: Theme::choose(depth, light), glyphs });
    judge(&mut model, 0);
    assert_eq!(model.state().drawn.as_ref().map(|d| d.outcome.counts.flagged), Some(1));
    model
}

fn judge(model: &mut Model, plan: usize) {
    let result = Judge::new(model, plan).run(&Stop::never()).map(Box::new);
    model.awaited = Some(0);
    update(model, Message::Analysed { generation: 0, plan, result });
}

fn press(model: &mut Model, code: KeyCode) {
    for effect in update(model, Message::Key(KeyEvent::new(code, KeyModifiers::NONE))) {
        if let Effect::Analyse(plan) = effect {
            judge(model, plan);
        }
    }
}

fn type_in(model: &mut Model, keys: &str) {
    keys.chars().for_each(|c| press(model, if c == '\r' { KeyCode::Enter } else { KeyCode::Char(c) }));
}

fn frame(model: &Model) -> Buffer {
    let area = Rect::new(0, 0, model.size.0, model.size.1);
    let mut buffer = Buffer::empty(area);
    view::draw(model, area, &mut buffer);
    buffer
}

/// Everything that can lie on the screen, by the keys that lead there from the panels.
const SCREENS: [&str; 14] = ["", "n", "z", "3", "4", "5", "?", "m", "D", ":", ":channel ", "/", "a:w x", "dY"];

/// Sizes at which the layout changes, and the ends of what may come.
const EDGES: ([u16; 16], [u16; 13]) = (
    [0, 1, 2, 3, 39, 40, 59, 60, 72, 80, 109, 110, 120, 160, 230, 1000],
    [0, 1, 2, 3, 9, 10, 15, 16, 20, 24, 36, 60, 300],
);

/// What is drawn into an area while the last message about the size of the terminal said another.
fn drawn(model: &mut Model, told: (u16, u16), area: (u16, u16)) -> Buffer {
    model.size = told;
    let area = Rect::new(0, 0, area.0, area.1);
    let mut buffer = Buffer::empty(area);
    view::draw(model, area, &mut buffer);
    buffer
}

/// The window may have been resized since: nothing goes beyond the area, and what is drawn depends on it alone.
fn assert_laid_out_from_its_area(model: &mut Model, told: (u16, u16), area: (u16, u16), what: &str) {
    let other = drawn(model, told, area);
    assert!(other == drawn(model, area, area), "{what}: {area:?} is drawn otherwise when {told:?} was told");
}

#[test]
fn a_frame_is_laid_out_from_the_area_it_is_drawn_into_and_from_nothing_else() {
    let mut model = model(["a", "b", "c"], Glyphs::Unicode, ColorDepth::Indexed256, false);
    for width in EDGES.0 {
        for height in EDGES.1 {
            for told in [(0, 0), (80, 24), (120, 40), (200, 60)] {
                assert_laid_out_from_its_area(&mut model, told, (width, height), "panels");
            }
        }
    }
    let (mut runner, any) = (TestRunner::deterministic(), (0..=1000_u16, 0..=300_u16));
    for keys in SCREENS.iter().chain(&["4w", "3w", "2w", "5w", "R", "RR", "av", "aq", "J"]) {
        let mut model = self::model(HOSTILE, Glyphs::Unicode, ColorDepth::Indexed256, false);
        type_in(&mut model, keys);
        for round in 0..40 {
            let mut draw = || any.new_tree(&mut runner).unwrap().current();
            let (told, area) = (draw(), draw());
            // Small sizes are where little things have no room.
            let area = if round % 2 == 0 { (area.0 % 130, area.1 % 45) } else { area };
            assert_laid_out_from_its_area(&mut model, told, area, keys);
        }
    }
}

#[test]
fn no_name_of_a_file_reaches_the_terminal_as_it_is() {
    for glyphs in [Glyphs::Unicode, Glyphs::Braille, Glyphs::Ascii] {
        for keys in SCREENS {
            let mut model = model(HOSTILE, glyphs, ColorDepth::Indexed256, false);
            type_in(&mut model, keys);
            for size in SIZES {
                update(&mut model, Message::Resize(size.0, size.1));
                let buffer = frame(&model);
                for cell in buffer.content() {
                    let symbol = cell.symbol();
                    let safe = symbol.chars().all(|c| !c.is_control() && !('\u{202a}'..='\u{202e}').contains(&c));
                    assert!(safe && symbol.width() <= 2, "{symbol:?} after {keys:?} at {size:?}");
                    assert!(glyphs != Glyphs::Ascii || symbol.is_ascii(), "{symbol:?} after {keys:?} at {size:?}");
                }
            }
        }
    }
}

#[test]
fn the_screen_is_the_same_in_every_depth_but_for_its_colours() {
    let text = |buffer: &Buffer| buffer.content().iter().map(|c| c.symbol().to_owned()).collect::<Vec<_>>();
    // The command line names the record with its folder, which is another one each time.
    for keys in SCREENS.into_iter().filter(|keys| !keys.ends_with('Y')) {
        let mut frames = Vec::new();
        for depth in [ColorDepth::Never, ColorDepth::Ansi16, ColorDepth::Indexed256, ColorDepth::True] {
            for light in [false, true] {
                let mut model = model(["x", "y", "z"], Glyphs::Unicode, depth, light);
                type_in(&mut model, keys);
                let buffer = frame(&model);
                let allowed = |color: Color| match depth {
                    ColorDepth::Never => color == Color::Reset,
                    ColorDepth::Ansi16 => !matches!(color, Color::Indexed(_) | Color::Rgb(..)),
                    ColorDepth::Indexed256 => matches!(color, Color::Reset | Color::Indexed(_)),
                    ColorDepth::True => matches!(color, Color::Reset | Color::Rgb(..)),
                };
                assert!(buffer.content().iter().all(|c| allowed(c.fg) && allowed(c.bg)), "{depth:?} after {keys:?}");
                frames.push(text(&buffer));
            }
        }
        assert!(frames.windows(2).all(|pair| pair[0] == pair[1]), "after {keys:?}");
    }
}

#[test]
fn without_colours_the_chosen_line_and_the_cursor_are_still_told() {
    let reversed = |keys: &str| {
        let mut model = model(["x", "y", "z"], Glyphs::Ascii, ColorDepth::Never, false);
        type_in(&mut model, keys);
        frame(&model).content().iter().filter(|c| c.modifier.contains(Modifier::REVERSED)).count()
    };
    for keys in ["", "m", ":next", "/", "4"] {
        assert!(reversed(keys) > 0, "after {keys:?}");
    }
}

#[test]
fn the_first_key_of_two_and_a_half_typed_line_survive_a_resize() {
    let mut model = model(["x", "y", "z"], Glyphs::Unicode, ColorDepth::Indexed256, false);
    type_in(&mut model, ":set k 5");
    for size in SIZES {
        update(&mut model, Message::Resize(size.0, size.1));
        frame(&model);
    }
    type_in(&mut model, "\rg");
    update(&mut model, Message::Resize(80, 24));
    type_in(&mut model, "a");
    let toast = model.toast.as_ref().map(|t| t.text.clone()).unwrap_or_default();
    assert!(toast.starts_with("accepted 1 "), "{toast}");
    assert_eq!(model.plan().setup.settings.get("k").map(|v| v.to_string()).as_deref(), Some("5.0"));
}
