//! The mouse over what lies over the panels, and over the second channel: what is clicked is what is shown there.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

#[expect(dead_code, reason = "what other test programs need of it is not used here")]
mod workbench;

use std::path::PathBuf;

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use wildpoint::stop::Stop;
use wildpoint::tui::files::{FileEntry, FileKind, Listing, News, Request, Task};
use wildpoint::tui::jobs::Judge;
use wildpoint::tui::message::{Effect, Message};
use wildpoint::tui::model::{Dialog, Overlay};
use wildpoint::tui::update::update;

use workbench::{Bench, UNICODE_DARK};

/// A workbench under a mouse; effects are given back, not carried out.
struct Desk(Bench);

impl Desk {
    fn new(size: (u16, u16)) -> Self {
        Self(Bench::on("demo.csv", UNICODE_DARK).size(size))
    }

    fn keys(self, keys: &str) -> Self {
        Self(self.0.keys(keys))
    }

    fn control(&mut self, c: char) -> Vec<Effect> {
        update(&mut self.0.0, Message::Key(KeyEvent::new(KeyCode::Char(c), KeyModifiers::CONTROL)))
    }

    fn mouse(&mut self, kind: MouseEventKind, (column, row): (u16, u16)) -> Vec<Effect> {
        update(&mut self.0.0, Message::Mouse(MouseEvent { kind, column, row, modifiers: KeyModifiers::NONE }))
    }

    fn click(&mut self, cell: (u16, u16)) -> Vec<Effect> {
        let effects = self.mouse(MouseEventKind::Down(MouseButton::Left), cell);
        assert_eq!(self.mouse(MouseEventKind::Up(MouseButton::Left), cell), []);
        effects
    }

    /// Where a text begins on the screen.
    fn cell_of(&self, text: &str) -> (u16, u16) {
        let frame = self.0.frame();
        let (row, line) = frame.lines().enumerate().find(|(_, l)| l.contains(text)).unwrap_or_else(|| {
            panic!("{text:?} is not on the screen:\n{frame}");
        });
        let column = line.split(text).next().unwrap().chars().count();
        (u16::try_from(column).unwrap(), u16::try_from(row).unwrap())
    }

    /// The line of the screen with the mark of the row under the cursor.
    fn marked(&self) -> Vec<String> {
        let is = |line: &&str| line.starts_with('>') || line.contains("│ >");
        self.0.frame().lines().filter(is).map(str::to_owned).collect()
    }

    fn dialog(&self) -> &Dialog {
        match &self.0.0.overlay {
            Overlay::Files(dialog) => dialog,
            other => panic!("{other:?}"),
        }
    }

    /// With a folder of `n` files in the picker of files.
    fn in_folder(mut self, n: usize) -> Self {
        self.control('o');
        let entry = |i: usize| FileEntry {
            path: PathBuf::from(format!("/data/pass-{i:02}.csv")),
            name: format!("pass-{i:02}.csv"),
            kind: FileKind::File,
            size: 84_000,
            changed: "2026-03-04 11:49".into(),
            recent: i < 2,
        };
        let entries = (0..n).map(entry).collect();
        let listing = Listing { folder: PathBuf::from("/data"), entries, file: None, note: None };
        update(&mut self.0.0, Message::Files(News::Listed(Ok(listing))));
        self
    }
}

#[test]
fn a_click_chooses_in_a_list_and_a_second_takes_it() {
    for size in [(80, 24), (120, 40)] {
        let mut desk = Desk::new(size).keys("m");
        let cell = desk.cell_of(" hampel ");
        assert_eq!(desk.click(cell), []);
        assert!(desk.marked()[0].contains(" hampel "), "{}", desk.0.frame());
        // Not where the row is now, but where the first click was: that is what a double click does.
        assert_eq!(desk.click(cell), [Effect::Analyse(0)]);
        assert_eq!(desk.0.0.plan().setup.method.about().id, "hampel");
        assert!(matches!(desk.0.0.overlay, Overlay::None));
    }
}

#[test]
fn a_key_between_two_clicks_makes_them_two_first_ones() {
    let mut desk = Desk::new((80, 24)).keys("m");
    let cell = desk.cell_of(" hampel ");
    desk.click(cell);
    let mut desk = desk.keys("Down");
    assert!(!desk.marked()[0].contains(" hampel "));
    let below = desk.cell_of(" hampel ");
    assert_eq!(desk.click(below), []);
    assert!(desk.marked()[0].contains(" hampel "), "{}", desk.0.frame());
}

#[test]
fn the_palette_runs_what_is_clicked_twice() {
    let mut desk = Desk::new((80, 24)).keys(":flag");
    let cell = desk.cell_of("previous-flag");
    assert_eq!(desk.click((cell.0 + 3, cell.1)), []);
    assert!(desk.marked().iter().any(|line| line.contains("previous-flag")), "{}", desk.0.frame());
    let before = desk.0.0.state().cursor;
    desk.click((cell.0 + 3, cell.1));
    assert!(matches!(desk.0.0.overlay, Overlay::None));
    assert_ne!(desk.0.0.state().cursor, before);
}

#[test]
fn the_journal_goes_back_to_the_line_that_is_clicked_twice() {
    let mut desk = Desk::new((80, 24)).keys("a r a r J");
    let cell = desk.cell_of("as it was opened");
    desk.click(cell);
    assert_eq!(desk.0.0.history.len(), 4, "one click changes nothing");
    desk.click(cell);
    assert_eq!((desk.0.0.history.len(), desk.0.0.history.undone().len()), (0, 4));
}

#[test]
fn a_file_is_looked_at_by_one_click_and_opened_by_two() {
    for size in [(80, 24), (120, 40)] {
        let mut desk = Desk::new(size).in_folder(40);
        let cell = desk.cell_of("pass-05.csv");
        let path = PathBuf::from("/data/pass-05.csv");
        let looked = desk.click(cell);
        assert!(
            matches!(&looked[..], [Effect::Files(Task::Look(glance))] if glance.source.path() == Some(path.as_path()))
        );
        let request = Request::file(path);
        assert_eq!(desk.click(cell), [Effect::Files(Task::Open { ticket: 1, request })]);
    }
}

#[test]
fn every_file_in_sight_is_the_one_that_a_click_on_it_chooses() {
    let mut desk = Desk::new((80, 24)).in_folder(40);
    let choice = |desk: &Desk| match desk.dialog() {
        Dialog::Browser(browser) => browser.choice,
        other => panic!("{other:?}"),
    };
    let scroll_to = |desk: &mut Desk, to: usize| {
        (0..40).for_each(|_| drop(desk.mouse(MouseEventKind::ScrollUp, (10, 5))));
        (0..to).for_each(|_| drop(desk.mouse(MouseEventKind::ScrollDown, (10, 5))));
        assert_eq!(choice(desk), to);
    };
    for (width, height) in [(80, 24), (120, 40), (60, 16), (200, 60)] {
        update(&mut desk.0.0, Message::Resize(width, height));
        for scrolled in [0, 17, 39] {
            scroll_to(&mut desk, scrolled);
            let frame = desk.0.frame();
            let shown: Vec<usize> = (0..40).filter(|i| frame.contains(&format!("  pass-{i:02}.csv "))).collect();
            assert!(shown.len() >= 3, "{frame}");
            for i in shown {
                scroll_to(&mut desk, scrolled);
                let cell = desk.cell_of(&format!("  pass-{i:02}.csv "));
                desk.click((cell.0 + 4, cell.1));
                assert_eq!(choice(&desk), i, "{width}x{height}, {scrolled} down");
            }
        }
    }
}

#[test]
fn the_wheel_stops_at_the_ends_of_a_list() {
    let mut desk = Desk::new((80, 24)).in_folder(5);
    let chosen = |desk: &Desk| match desk.dialog() {
        Dialog::Browser(browser) => browser.choice,
        other => panic!("{other:?}"),
    };
    desk.mouse(MouseEventKind::ScrollUp, (10, 5));
    assert_eq!(chosen(&desk), 0);
    (0..9).for_each(|_| drop(desk.mouse(MouseEventKind::ScrollDown, (10, 5))));
    assert_eq!(chosen(&desk), 4);
    let mut journal = Desk::new((80, 24)).keys("a r J");
    (0..9).for_each(|_| drop(journal.mouse(MouseEventKind::ScrollUp, (10, 5))));
    assert!(matches!(journal.0.0.overlay, Overlay::Journal(0)));
    (0..9).for_each(|_| drop(journal.mouse(MouseEventKind::ScrollDown, (10, 5))));
    assert!(matches!(journal.0.0.overlay, Overlay::Journal(2)));
}

#[test]
fn clicks_choose_what_is_written_and_write_nothing() {
    let mut desk = Desk::new((80, 24));
    desk.control('e');
    let cell = desk.cell_of("[ ] report");
    let on = |desk: &Desk| match desk.dialog() {
        Dialog::Export(form) => form.rows.iter().filter(|r| r.on).map(|r| r.kind.name()).collect::<Vec<_>>(),
        other => panic!("{other:?}"),
    };
    for wanted in [vec!["cleaned"], vec!["cleaned", "report"], vec!["cleaned"]] {
        assert_eq!(desk.click(cell), []);
        assert_eq!(on(&desk), wanted);
    }
    // A name that is being typed stays.
    let mut desk = desk.keys("e");
    let above = desk.cell_of("] cleaned");
    assert_eq!(desk.click(above), []);
    assert!(matches!(desk.dialog(), Dialog::Export(form) if form.typing.is_some()));
}

#[test]
fn a_second_click_on_an_option_of_the_loader_gives_it_the_next_value() {
    let mut desk = Desk::new((80, 24));
    update(&mut desk.0.0, Message::Key(KeyEvent::new(KeyCode::Char(':'), KeyModifiers::NONE)));
    for c in "loader".chars().map(KeyCode::Char).chain([KeyCode::Enter]) {
        update(&mut desk.0.0, Message::Key(KeyEvent::new(c, KeyModifiers::NONE)));
    }
    let cell = desk.cell_of("header line");
    assert_eq!(desk.click(cell), []);
    let asked = desk.click(cell);
    assert!(
        matches!(&asked[..], [Effect::Files(Task::Look(glance))] if glance.options.header_line == Some(1)),
        "{asked:?}"
    );
    // Texts have no next one: they are typed.
    let cell = desk.cell_of("missing markers");
    assert_eq!(desk.click(cell), []);
    assert_eq!(desk.click(cell), []);
    assert!(matches!(desk.dialog(), Dialog::Loader(form) if form.typing.is_some()));
}

#[test]
fn questions_and_help_are_for_keys() {
    for keys in ["a q", "?", "/"] {
        let mut desk = Desk::new((80, 24)).keys(keys);
        let before = desk.0.frame();
        for cell in (0..24).flat_map(|y| (0..80).step_by(3).map(move |x| (x, y))) {
            assert_eq!(desk.click(cell), [], "{keys}");
        }
        assert_eq!(desk.0.frame(), before, "{keys}");
    }
}

#[test]
fn every_list_is_safe_under_the_mouse_at_any_size() {
    for keys in ["m", "e", "D", ":", ":set Space ", "J", "c", "?"] {
        let mut desk = Desk::new((80, 24)).keys(keys);
        for (width, height) in [(200, 60), (120, 40), (80, 24), (60, 16), (40, 10), (39, 9), (1, 1)] {
            update(&mut desk.0.0, Message::Resize(width, height));
            for cell in (0..height + 2).map(|y| (width / 3, y)) {
                desk.click(cell);
                desk.mouse(MouseEventKind::ScrollDown, cell);
            }
            desk.0.frame();
        }
    }
}

#[test]
fn a_click_in_the_second_channel_moves_the_cursor_in_time() {
    for keys in ["n", "n X"] {
        let mut desk = Desk::new((200, 60)).keys(keys);
        // Both channels judged: flags of the second can be pointed at.
        let result = Judge::new(&desk.0.0, 1).run(&Stop::never()).map(Box::new);
        desk.0.0.awaited = Some(0);
        update(&mut desk.0.0, Message::Analysed { generation: 0, plan: 1, result });
        let heading = desk.cell_of("V another");
        let trace = desk.cell_of("1 trace");
        let (width, gutter) = (200 - 38, 8);
        for column in [gutter, 50, 100, width - 1] {
            desk.click((column, heading.1 + 2));
            let second = desk.0.0.state().cursor;
            // The same column of the trace is the same time, but for a flag near by that either click may mean, and
            // for times that are lost in one channel alone.
            let model = &desk.0.0;
            let per_column = model.series().len() as f64 / f64::from(width - gutter);
            let wanted = (f64::from(column - gutter) + 0.5) * per_column;
            assert!((second as f64 - wanted).abs() <= 3.5 * per_column, "{keys}: {column}: {second}, {wanted}");
        }
        // Beside it and on its heading there is nothing to point at.
        let before = desk.0.0.state().cursor;
        desk.click((2, heading.1 + 2));
        desk.click((60, heading.1));
        assert_eq!(desk.0.0.state().cursor, before);
        // The wheel zooms both.
        let view = desk.0.0.state().view;
        desk.mouse(MouseEventKind::ScrollUp, (80, heading.1 + 3));
        assert!(desk.0.0.state().view.width() < view.width());
        assert!(trace.1 < heading.1);
    }
}
