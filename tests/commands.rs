//! The palette, the jumps, the mouse and the configured keys, driven through `update` and seen through the model.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::path::{Path, PathBuf};

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use ratatui::layout::Rect;
use wildpoint::param::Value;
use wildpoint::session::{Session, Setup};
use wildpoint::stop::Stop;
use wildpoint::track::{LoadOptions, Source, load};
use wildpoint::tui::config::Config;
use wildpoint::tui::jobs::Judge;
use wildpoint::tui::message::{Effect, Message};
use wildpoint::tui::model::{Model, Overlay};
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::theme::Theme;
use wildpoint::tui::update::{FORMS, suggestions, update};
use wildpoint::tui::{Look, Opening, text_of, view};

/// A workbench whose results are there at once.
struct Bench {
    model: Model,
    /// What the outside was asked for, besides results.
    asked: Vec<Effect>,
}

impl Bench {
    fn new() -> Self {
        Self::configured("")
    }

    /// With a configuration.
    fn configured(text: &str) -> Self {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("data/demo.csv");
        let options = LoadOptions::default();
        let track = load(&Source::File(path), &options).unwrap();
        let session = Session::new(&track, options, &Setup::standard());
        let opening = Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() };
        let mut model = opening.model(Look { theme: Theme::mono(), glyphs: Glyphs::Unicode });
        let config = Config::of_text(text, Path::new("config.toml")).unwrap();
        model.keys = config.keys;
        model.review.auto_advance = config.screen.auto_advance;
        let mut bench = Self { model, asked: Vec::new() };
        bench.send(Message::Resize(120, 40));
        bench.judge(0);
        bench
    }

    fn judge(&mut self, plan: usize) {
        let result = Judge::new(&self.model, plan).run(&Stop::never()).map(Box::new);
        self.model.awaited = Some(0);
        update(&mut self.model, Message::Analysed { generation: 0, plan, result });
    }

    fn send(&mut self, message: Message) {
        for effect in update(&mut self.model, message) {
            match effect {
                Effect::Analyse(plan) => self.judge(plan),
                other => self.asked.push(other),
            }
        }
    }

    fn press(&mut self, code: KeyCode) {
        self.send(Message::Key(KeyEvent::new(code, KeyModifiers::NONE)));
    }

    fn keys(&mut self, text: &str) -> &mut Self {
        text.chars().for_each(|c| self.press(if c == '\r' { KeyCode::Enter } else { KeyCode::Char(c) }));
        self
    }

    /// The data row under the cursor, from 1.
    fn row(&self) -> usize {
        self.model.series().row(self.model.state().cursor) + 1
    }

    fn mouse(&mut self, kind: MouseEventKind, (column, row): (u16, u16)) {
        self.send(Message::Mouse(MouseEvent { kind, column, row, modifiers: KeyModifiers::NONE }));
    }

    fn click(&mut self, cell: (u16, u16)) {
        self.mouse(MouseEventKind::Down(MouseButton::Left), cell);
        self.mouse(MouseEventKind::Up(MouseButton::Left), cell);
    }

    /// The typed line and what is wrong with it; none when nothing is being typed.
    fn prompt(&self) -> Option<(String, Option<String>)> {
        match &self.model.overlay {
            Overlay::Prompt(prompt) => Some((prompt.input.value().to_owned(), prompt.error.clone())),
            _ => None,
        }
    }

    fn toast(&self) -> &str {
        self.model.toast.as_ref().map_or("", |t| t.text.as_str())
    }

    fn set(&self, key: &str) -> Option<Value> {
        let setup = &self.model.plan().setup;
        setup.settings.get(key).or(setup.repair.get(key))
    }

    fn lines(&self) -> Vec<String> {
        let area = Rect::new(0, 0, self.model.size.0, self.model.size.1);
        let mut buffer = Buffer::empty(area);
        view::draw(&self.model, area, &mut buffer);
        text_of(&buffer).lines().map(str::to_owned).collect()
    }

    /// The cell in which a text of the screen begins.
    fn cell_of(&self, text: &str) -> (u16, u16) {
        let lines = self.lines();
        let row = lines.iter().position(|line| line.contains(text)).unwrap_or_else(|| panic!("{text}: {lines:#?}"));
        let column = lines[row].split(text).next().unwrap().chars().count();
        (u16::try_from(column).unwrap(), u16::try_from(row).unwrap())
    }
}

#[test]
fn actions_are_run_by_a_few_letters_of_their_names() {
    let mut bench = Bench::new();
    bench.keys(":nf\r");
    assert_eq!(bench.row(), 91, "next-flag");
    bench.keys(":next flag\r");
    assert_eq!(bench.row(), 200, "blanks do not matter");
    bench.keys(":undo\r");
    assert_eq!((bench.toast(), bench.prompt()), ("nothing to undo", None));
    // Every action of the key map but the palette itself is there, and every command.
    let names: Vec<String> = suggestions(&bench.model, "").into_iter().map(|s| s.name).collect();
    for bound in bench.model.keys.rows() {
        let name = bound.row.action.name();
        assert!(name == "command" || names.contains(&name), "{name}");
    }
    assert!(["w", "set", "goto", "command-line"].iter().all(|c| names.iter().any(|n| n == c)));
}

#[test]
fn a_character_that_means_nothing_says_where_the_keys_are_and_hints_name_those_in_force() {
    let mut bench = Bench::new();
    let before = bench.model.revision;
    bench.keys("$");
    assert_eq!(bench.toast(), "$ does nothing here · ? shows the keys");
    bench.keys("gq");
    assert_eq!(bench.toast(), "gq does nothing here · ? shows the keys");
    assert_eq!(bench.model.revision, before);
    let mut bench = Bench::configured("[keys]\nundo = [\"ctrl-u\"]\nnext-flag = [\"S\"]\n");
    bench.keys("a");
    assert!(bench.toast().ends_with("· Ctrl-U undo"), "{}", bench.toast());
    bench.keys("jr");
    assert!(bench.toast().contains("S goes to the next"), "{}", bench.toast());
}

#[test]
fn a_command_that_is_spelt_out_goes_before_every_action() {
    // `q` is a command; letters of it are in many names.
    let mut bench = Bench::new();
    bench.asked.clear();
    bench.keys(":q\r");
    assert_eq!(bench.asked, [Effect::Quit]);
}

#[test]
fn only_the_keys_it_names_answer_the_question_before_quitting() {
    let mut bench = Bench::new();
    bench.asked.clear();
    bench.keys("aq");
    for modifiers in [KeyModifiers::CONTROL, KeyModifiers::ALT] {
        for letter in ['d', 'w'] {
            bench.send(Message::Key(KeyEvent::new(KeyCode::Char(letter), modifiers)));
        }
    }
    bench.keys("synq\r");
    assert_eq!(bench.asked, []);
    bench.keys("d");
    assert_eq!(bench.asked, [Effect::Quit]);
}

#[test]
fn parameters_are_set_with_a_blank_or_a_sign_and_wrong_ones_stay_in_the_prompt() {
    let mut bench = Bench::new();
    bench.keys(":set k 4.5\r");
    assert_eq!(bench.set("k"), Some(Value::Real(4.5)));
    bench.keys(":set k=5\r:set max_fill 10\r");
    assert_eq!((bench.set("k"), bench.set("max_fill")), (Some(Value::Real(5.0)), Some(Value::Whole(10))));
    bench.keys(":set k zero\r");
    let (line, error) = bench.prompt().unwrap();
    assert!(line == "set k zero" && error.as_ref().is_some_and(|e| e.contains("0.5 .. ")), "{error:?}");
    assert_eq!(bench.set("k"), Some(Value::Real(5.0)));
    // What is typed next takes the complaint away.
    bench.press(KeyCode::Backspace);
    assert_eq!(bench.prompt(), Some(("set k zer".into(), None)));
    bench.press(KeyCode::Esc);
    bench.keys(":zzzz\r");
    assert!(bench.prompt().unwrap().1.unwrap().contains("no such command"));
}

#[test]
fn tab_completes_commands_keys_ids_channels_and_values() {
    for (typed, completed) in [
        ("met", "method "),
        ("set max_f", "set max_fill "),
        ("set direction b", "set direction both"),
        ("method ham", "method hampel"),
        ("method kal", "method kalman"),
        ("channel alt", "channel alt_m"),
        ("repair lin", "repair linear"),
        ("preset p", "preset paper"),
        ("next-unr", "next-unreviewed"),
    ] {
        let mut bench = Bench::new();
        bench.keys(":").keys(typed);
        bench.press(KeyCode::Tab);
        assert_eq!(bench.prompt().unwrap().0, completed, "{typed}");
    }
}

#[test]
fn the_list_is_walked_and_earlier_lines_come_back() {
    let mut bench = Bench::new();
    bench.keys(":method ");
    bench.press(KeyCode::Down);
    bench.press(KeyCode::Down);
    bench.press(KeyCode::Enter);
    // The second of the registry.
    assert_eq!(bench.model.plan().setup.method.about().id, wildpoint::method::METHODS[1].about().id);
    bench.keys(":set k 6\r:");
    bench.press(KeyCode::Up);
    assert_eq!(bench.prompt().unwrap().0, "set k 6");
    bench.press(KeyCode::Up);
    let id = wildpoint::method::METHODS[1].about().id;
    assert_eq!(bench.prompt().unwrap().0, format!("method {id}"));
    bench.press(KeyCode::Down);
    bench.press(KeyCode::Down);
    assert_eq!(bench.prompt().unwrap().0, "");
    // A command that needs more is put into the prompt instead of run.
    bench.press(KeyCode::Esc);
    bench.keys(":channe\r");
    assert_eq!(bench.prompt(), Some(("channel ".into(), None)));
}

#[test]
fn jumps_go_to_times_rows_and_so_much_further_on() {
    let mut bench = Bench::new();
    bench.keys("/#500\r");
    assert_eq!(bench.row(), 500);
    // A sample a second, some are lost: row 500 is at 499 s or later.
    let t = bench.model.series().t[bench.model.state().cursor];
    let at = |bench: &Bench| bench.model.series().t[bench.model.state().cursor];
    bench.keys("/+5s\r");
    assert!((at(&bench) - t - 5.0).abs() <= 1.0);
    bench.keys("/+1m\r/-60s\r");
    assert!((at(&bench) - t - 5.0).abs() <= 1.0);
    let cursor = bench.model.state().cursor;
    bench.keys("/+100\r");
    assert_eq!(bench.model.state().cursor, cursor + 100);
    bench.keys("/-40\r");
    assert_eq!(bench.model.state().cursor, cursor + 60);
    bench.keys("/1239.5\r");
    assert!((at(&bench) - 1239.5).abs() <= 0.5);
    bench.keys("/-99999999\r");
    assert_eq!(bench.model.state().cursor, 0, "the record ends there");
}

#[test]
fn jumps_find_the_next_sample_that_is_looked_for_and_say_when_they_wrap() {
    let mut bench = Bench::new();
    // The values of the file are the judge: by hand over the series.
    let y = bench.model.series().y.to_vec();
    let over: Vec<usize> = (0..y.len()).filter(|i| y[*i] > 700.0).collect();
    assert!(over.len() >= 2, "the record has something to look for");
    bench.keys("/#1\r/y>700\r");
    assert_eq!(bench.model.state().cursor, over[0]);
    bench.keys("/\r");
    assert_eq!(bench.model.state().cursor, over[1]);
    bench.keys("\"");
    let third = over.get(2).copied().unwrap_or(over[0]);
    assert_eq!(bench.model.state().cursor, third);
    // After the last one comes the first again.
    let last = *over.last().unwrap();
    let row = bench.model.series().row(last) + 1;
    bench.keys(&format!("/#{row}\r/y>700\r"));
    assert_eq!(bench.model.state().cursor, over[0]);
    assert!(bench.toast().contains("from the start of the record again"), "{}", bench.toast());
    let step: Vec<usize> = (1..y.len()).filter(|i| (y[*i] - y[*i - 1]).abs() > 60.0).collect();
    bench.keys("/#1\r/step>60\r");
    assert_eq!(bench.model.state().cursor, step[0]);
    bench.keys("/y>1e99\r");
    assert!(bench.prompt().unwrap().1.unwrap().contains("no such sample"));
}

#[test]
fn jumps_know_states_verdicts_and_notes() {
    let mut bench = Bench::new();
    // Rows 61 and 91 are the first flags; row 200 the third.
    bench.keys("/#61\rar");
    bench.keys("/#91\rcstaging of the second stage\r");
    bench.keys("/#300\r/state:rejected\r");
    assert_eq!(bench.row(), 91);
    bench.keys("/state:accepted\r");
    assert_eq!(bench.row(), 61);
    bench.keys("/state:unreviewed\r");
    assert_eq!(bench.row(), 200);
    bench.keys("/note:SECOND\r");
    assert_eq!(bench.row(), 91);
    bench.keys("/#300\r/staging\r");
    assert_eq!(bench.row(), 91);
    bench.keys("/verdict:outlier\r");
    assert_eq!(bench.row(), 200);
    bench.keys("/nonsense\r");
    assert!(bench.prompt().unwrap().1.unwrap().contains("no time of this record"));
    // The forms stand over the prompt.
    let lines = bench.lines().join("\n");
    assert!(FORMS.iter().all(|(form, _)| lines.contains(form)), "{lines}");
}

#[test]
fn configured_keys_hold_everywhere() {
    let mut bench = Bench::configured("[keys]\nnext-flag = [\"f5\", \"g z\"]\nsort = []\n");
    bench.press(KeyCode::F(5));
    assert_eq!(bench.row(), 91);
    bench.keys("gz");
    assert_eq!(bench.row(), 200);
    bench.keys("n");
    assert_eq!(bench.row(), 200, "the key of the table is gone");
    // The help, the footer and the palette show what holds.
    let footer = bench.lines().pop().unwrap();
    assert!(footer.starts_with(" f5 next"), "{footer}");
    bench.keys("?next flag (");
    let help = bench.lines().join("\n");
    assert!(help.contains("f5 gz") && !help.contains("  n  "), "{help}");
    bench.press(KeyCode::Esc);
    bench.keys(":next-flag");
    assert!(bench.lines().iter().any(|line| line.contains("next-flag") && line.contains("f5 gz")));
}

#[test]
fn without_auto_advance_a_decision_stays_where_it_was_made() {
    let mut bench = Bench::configured("[screen]\nauto_advance = false\n");
    let row = bench.row();
    bench.keys("a");
    assert_eq!(bench.row(), row);
    let mut bench = Bench::new();
    bench.keys("a");
    assert_ne!(bench.row(), row);
}

#[test]
fn a_click_goes_to_the_flag_near_it_and_to_the_sample_where_there_is_none() {
    let mut bench = Bench::new();
    bench.keys("/#91\rz");
    let width = bench.model.state().view.width();
    // The marker of the flag in row 91, the only one in view.
    let (column, row) = bench.cell_of("●");
    bench.keys("/#80\r");
    for near in [column, column + 2, column - 2] {
        bench.click((near, row));
        assert_eq!(bench.row(), 91, "{} columns away", near.abs_diff(column));
        bench.keys("/#80\r");
    }
    bench.click((column + 8, row - 3));
    assert!((92..120).contains(&bench.row()), "{}", bench.row());
    assert!((bench.model.state().view.width() - width).abs() < 1e-9, "a click keeps the zoom");
}

#[test]
fn the_wheel_zooms_at_the_pointer_and_drags_select_and_move() {
    let mut bench = Bench::new();
    let whole = bench.model.state().view;
    let cell = bench.cell_of("600┤");
    let at = (cell.0 + 40, cell.1);
    bench.mouse(MouseEventKind::ScrollUp, at);
    let near = bench.model.state().view;
    assert!(near.width() < whole.width());
    // What was under the pointer is still under it: the same share of the view lies left of it.
    let plot = 120.0 - 38.0 - 8.0;
    let share = (f64::from(at.0 - 8) + 0.5) / plot;
    let under = |view: wildpoint::tui::plot::View| view.from + share * view.width();
    assert!((under(near) - under(whole)).abs() < whole.width() / plot, "{near:?}");
    bench.mouse(MouseEventKind::ScrollDown, at);
    bench.keys("0");
    // A drag over twenty columns selects the samples under them; what it means is that of `v`.
    let (from, to) = ((at.0 - 10, at.1), (at.0 + 10, at.1 + 3));
    bench.mouse(MouseEventKind::Down(MouseButton::Left), from);
    bench.mouse(MouseEventKind::Drag(MouseButton::Left), (at.0, at.1 + 1));
    bench.mouse(MouseEventKind::Drag(MouseButton::Left), to);
    bench.mouse(MouseEventKind::Up(MouseButton::Left), to);
    let range = bench.model.selection().unwrap();
    let n = bench.model.series().len() as f64;
    let wanted = n * 20.0 / plot;
    // Samples are lost here and there: a tenth more or less.
    assert!((range.len() as f64 - wanted).abs() < wanted / 10.0, "{range:?}");
    bench.press(KeyCode::Esc);
    assert_eq!(bench.model.selection(), None);
    // The right button holds the record: what was under it stays under it.
    bench.keys("+++");
    let before = bench.model.state().view;
    bench.mouse(MouseEventKind::Down(MouseButton::Right), at);
    bench.mouse(MouseEventKind::Drag(MouseButton::Right), (at.0 + 12, at.1));
    let after = bench.model.state().view;
    let moved = (before.from - after.from) / before.width() * plot;
    assert!((moved - 12.0).abs() < 0.5, "{moved}");
}

#[test]
fn clicks_choose_flags_and_knobs_and_the_overview_leads_there() {
    let mut bench = Bench::new();
    let cell = bench.cell_of("323   323.0");
    bench.click(cell);
    assert_eq!(bench.row(), 323);
    bench.click(bench.cell_of("323   323.0"));
    assert!(bench.model.state().view.width() < bench.model.whole().width(), "the second click zooms");
    let knob = bench.cell_of("points         ");
    bench.click(knob);
    assert_eq!(bench.model.knob().name(), "points");
    bench.mouse(MouseEventKind::ScrollUp, knob);
    assert_eq!(bench.set("points"), Some(Value::Whole(9)));
    bench.click((60, 2));
    let whole = bench.model.whole();
    let t = bench.model.series().t[bench.model.state().cursor];
    let wanted = whole.from + whole.width() * (60.0 - 8.0 + 0.5) / (120.0 - 38.0 - 8.0);
    assert!((t - wanted).abs() < whole.width() / 74.0, "{t} {wanted}");
}

#[test]
fn the_mouse_is_safe_anywhere_at_any_size() {
    let mut bench = Bench::new();
    for size in [(120, 40), (80, 24), (60, 16), (40, 10), (39, 9), (1, 1)] {
        bench.send(Message::Resize(size.0, size.1));
        for keys in ["3", "4", "w", "w", "1"] {
            bench.keys(keys);
            for cell in (0..size.1 + 2).flat_map(|y| (0..size.0 + 2).step_by(7).map(move |x| (x, y))) {
                bench.click(cell);
                bench.mouse(MouseEventKind::ScrollDown, cell);
                bench.mouse(MouseEventKind::Drag(MouseButton::Right), (cell.1, cell.0));
                bench.model.overlay = Overlay::None;
            }
        }
    }
}
