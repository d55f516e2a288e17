//! Dialogs about files as an analyst sees them, and what they ask the outside for: keys and news in, effects out.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::path::PathBuf;
use std::sync::Arc;

use insta::assert_snapshot;
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use wildpoint::error::Error;
use wildpoint::session::{Analysed, Session, Setup, document};
use wildpoint::stop::Stop;
use wildpoint::track::{Encoding, LoadOptions, Source, load};
use wildpoint::tui::files::{FileEntry, FileKind, Glance, Listing, News, Purpose, Request, Seen, Task};
use wildpoint::tui::jobs::Judge;
use wildpoint::tui::message::{Effect, Message, Output, OutputKind, Written};
use wildpoint::tui::model::{Model, Overlay};
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::theme::{ColorDepth, Theme};
use wildpoint::tui::update::update;
use wildpoint::tui::{Look, Opening, text_of, view};

struct Bench(Model);

fn model(glyphs: Glyphs) -> Model {
    let track = load(&Source::demo(), &LoadOptions::default()).unwrap();
    let session = Session::new(&track, LoadOptions::default(), &Setup::standard());
    let depth = if glyphs == Glyphs::Ascii { ColorDepth::Never } else { ColorDepth::Indexed256 };
    let opening = Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() };
    opening.model(Look { theme: Theme::choose(depth, false), glyphs })
}

impl Bench {
    fn new() -> Self {
        Self::with(Glyphs::Unicode)
    }

    fn with(glyphs: Glyphs) -> Self {
        let mut model = model(glyphs);
        let drawn = Judge::new(&model, 0).run(&Stop::never()).unwrap();
        model.awaited = Some(0);
        update(&mut model, Message::Analysed { generation: 0, plan: 0, result: Ok(Box::new(drawn)) });
        Self(model)
    }

    fn size(mut self, (width, height): (u16, u16)) -> Self {
        update(&mut self.0, Message::Resize(width, height));
        self
    }

    fn key(&mut self, code: KeyCode) -> Vec<Effect> {
        update(&mut self.0, Message::Key(KeyEvent::new(code, KeyModifiers::NONE)))
    }

    fn control(&mut self, c: char) -> Vec<Effect> {
        update(&mut self.0, Message::Key(KeyEvent::new(KeyCode::Char(c), KeyModifiers::CONTROL)))
    }

    /// Types, and gives the effects of the last key.
    fn typed(&mut self, text: &str) -> Vec<Effect> {
        text.chars().map(|c| self.key(KeyCode::Char(c))).last().unwrap_or_default()
    }

    fn command(&mut self, line: &str) -> Vec<Effect> {
        self.typed(":");
        self.typed(line);
        self.key(KeyCode::Enter)
    }

    fn news(&mut self, news: News) -> Vec<Effect> {
        update(&mut self.0, Message::Files(news))
    }

    fn frame(&self) -> String {
        let (width, height) = self.0.size;
        let area = Rect { x: 0, y: 0, width, height };
        let mut buffer = Buffer::empty(area);
        view::draw(&self.0, area, &mut buffer);
        text_of(&buffer)
    }
}

fn entry(path: &str, kind: FileKind, size: u64, recent: bool) -> FileEntry {
    let name = if recent { path } else { path.rsplit('/').next().unwrap() };
    FileEntry {
        path: PathBuf::from(path),
        name: wildpoint::track::printable(name),
        kind,
        size,
        changed: "2026-03-04 11:49".into(),
        recent,
    }
}

fn listing() -> Listing {
    let entries = vec![
        entry("/home/ann/reviews/flight12/pass3-of-the-second-day.toml", FileKind::Session, 4_812, true),
        entry("/data/tracks/demo.csv", FileKind::File, 84_000, true),
        entry("/data/tracks/2026", FileKind::Folder, 0, false),
        entry("/data/tracks/.hidden.csv", FileKind::File, 10, false),
        entry("/data/tracks/demo.csv", FileKind::File, 84_000, false),
        entry("/data/tracks/esc\x1b[2J.csv", FileKind::File, 812, false),
        entry("/data/tracks/radar_week_17.csv.gz", FileKind::File, 210_000_000, false),
        entry("/data/tracks/高さ.csv", FileKind::File, 1_300_000, false),
    ];
    Listing { folder: PathBuf::from("/data/tracks"), entries, file: None, note: None }
}

fn seen(options: &LoadOptions) -> Seen {
    Glance { source: Source::demo(), options: options.clone() }.look(&Stop::never()).unwrap()
}

/// The picker with the folder listed.
fn picker(glyphs: Glyphs) -> Bench {
    let mut bench = Bench::with(glyphs);
    assert_eq!(bench.control('o'), [Effect::Files(Task::List(PathBuf::from(".")))]);
    let effects = bench.news(News::Listed(Ok(listing())));
    let first = PathBuf::from("/home/ann/reviews/flight12/pass3-of-the-second-day.toml");
    assert_eq!(effects, [Effect::Files(Task::Look(Glance::file(first)))]);
    bench
}

const DEMO: &str = "/data/tracks/demo.csv";

#[test]
fn the_picker_shows_recent_files_the_folder_and_what_a_file_is() {
    for (label, size) in [("80x24", (80, 24)), ("120x40", (120, 40))] {
        let mut bench = picker(Glyphs::Unicode).size(size);
        let effects = bench.key(KeyCode::Down);
        let glance = Glance::file(DEMO.into());
        assert_eq!(effects, [Effect::Files(Task::Look(glance.clone()))]);
        bench.news(News::Seen { glance, result: Ok(seen(&LoadOptions::default())), lines: Vec::new() });
        assert_snapshot!(format!("picker_{label}"), bench.frame());
    }
}

#[test]
fn typing_narrows_the_list_and_enter_opens() {
    let mut bench = picker(Glyphs::Unicode);
    bench.typed("week");
    assert!(bench.frame().contains("> radar_week_17.csv.gz") && !bench.frame().contains("2026/"));
    let effects = bench.key(KeyCode::Enter);
    let request = Request::file("/data/tracks/radar_week_17.csv.gz".into());
    assert_eq!(effects, [Effect::Files(Task::Open { ticket: 1, request })]);
    assert!(bench.frame().contains("loading radar_week_17.csv.gz"));
    // Esc leaves it: nobody reads on, and an answer that comes all the same is not taken.
    assert_eq!(bench.key(KeyCode::Esc), [Effect::Files(Task::Abandon)]);
    let late = bench.news(News::Opened { ticket: 1, result: Ok(Box::new(model(Glyphs::Unicode))) });
    assert!(late.is_empty() && matches!(bench.0.overlay, Overlay::Files(_)), "back in the picker");
    // Nor is it taken for the answer to the next request.
    bench.key(KeyCode::Enter);
    let late = bench.news(News::Opened { ticket: 1, result: Ok(Box::new(model(Glyphs::Unicode))) });
    assert!(late.is_empty() && bench.frame().contains("loading radar_week_17.csv.gz"));
    bench.key(KeyCode::Esc);
    bench.key(KeyCode::Esc);
    assert!(matches!(bench.0.overlay, Overlay::None));
}

#[test]
fn folders_are_entered_and_left_and_a_path_can_be_typed() {
    let mut bench = picker(Glyphs::Unicode);
    assert_eq!(bench.key(KeyCode::Backspace), [Effect::Files(Task::List("/data".into()))]);
    bench.news(News::Listed(Ok(listing())));
    bench.typed("2026");
    // Every recent entry has no such name: the folder is the only one left.
    assert_eq!(bench.key(KeyCode::Enter), [Effect::Files(Task::List("/data/tracks/2026".into()))]);
    bench.news(News::Listed(Ok(listing())));
    bench.typed("../elsewhere/x.csv");
    assert!(bench.frame().contains("no match; Enter opens it as a path"));
    let effects = bench.key(KeyCode::Enter);
    assert_eq!(effects, [Effect::Files(Task::List("/data/tracks/../elsewhere/x.csv".into()))]);
    // It is a file: it is opened.
    let file = Some(PathBuf::from("/data/elsewhere/x.csv"));
    let found = Listing { folder: "/data/elsewhere".into(), entries: Vec::new(), file, note: None };
    let effects = bench.news(News::Listed(Ok(found)));
    let request = Request::file("/data/elsewhere/x.csv".into());
    assert_eq!(effects, [Effect::Files(Task::Open { ticket: 1, request })]);
    // It is none: the picker says so.
    let e = Error::input("/data/elsewhere/x.csv", "no rows", "name a file with rows");
    bench.news(News::Opened { ticket: 1, result: Err(e) });
    assert!(bench.frame().contains("x.csv: no rows; name a file with rows"), "{}", bench.frame());
}

#[test]
fn why_a_file_cannot_be_opened_is_said_once() {
    let mut bench = picker(Glyphs::Unicode);
    bench.key(KeyCode::Down);
    let wrong = || Error::input(DEMO, "no rows", "name a file with rows");
    bench.news(News::Seen { glance: Glance::file(DEMO.into()), result: Err(wrong()), lines: Vec::new() });
    let said = |bench: &Bench| bench.frame().matches("no rows; name a file").count();
    assert_eq!(said(&bench), 1, "before anything is pressed\n{}", bench.frame());
    bench.key(KeyCode::Enter);
    bench.news(News::Opened { ticket: 1, result: Err(wrong()) });
    assert_eq!(said(&bench), 1, "{}", bench.frame());
}

#[test]
fn hidden_files_are_shown_when_asked_for() {
    let mut bench = picker(Glyphs::Unicode);
    assert!(!bench.frame().contains(".hidden"));
    bench.typed(".h");
    assert!(bench.frame().contains("> .hidden.csv"));
}

#[test]
fn another_record_takes_the_place_of_the_one_that_is_open() {
    let mut bench = Bench::new().size((120, 40));
    bench.key(KeyCode::Char('2'));
    let effects = bench.command("open x.csv");
    assert_eq!(effects, [Effect::Files(Task::Open { ticket: 1, request: Request::file("x.csv".into()) })]);
    let track = Arc::clone(&bench.0.track);
    let effects = bench.news(News::Opened { ticket: 1, result: Ok(Box::new(model(Glyphs::Unicode))) });
    assert_eq!(effects, [Effect::Files(Task::Begin), Effect::Analyse(0)]);
    assert!(!Arc::ptr_eq(&track, &bench.0.track));
    assert_eq!((bench.0.size, bench.0.focus.digit()), ((120, 40), 2), "the screen stays as it was");
    assert!(bench.0.toast.as_ref().unwrap().text.contains("opened wildpoint:demo: 2356 rows, 2 channels"));
}

#[test]
fn unsaved_work_is_asked_about_before_another_record_is_opened() {
    let mut bench = Bench::new();
    bench.typed("a");
    assert!(bench.command("open x.csv").is_empty());
    assert_snapshot!("unsaved_80x24", bench.frame());
    bench.key(KeyCode::Esc);
    assert!(matches!(bench.0.overlay, Overlay::None));
    bench.command("open x.csv");
    let effects = bench.typed("w");
    let path = PathBuf::from("demo.wild.toml");
    assert_eq!(effects, [Effect::Save { path: path.clone(), overwrite: false, then_quit: false }]);
    let what = Written::Session { revision: bench.0.revision, then_quit: false };
    let effects = update(&mut bench.0, Message::Written { what, path: path.clone(), result: Ok("saved".into()) });
    let request = Request::file("x.csv".into());
    assert_eq!(effects, [Effect::Files(Task::Remember(path)), Effect::Files(Task::Open { ticket: 1, request })]);
}

#[test]
fn what_cannot_be_saved_is_not_left() {
    let mut bench = Bench::new();
    bench.typed("a");
    bench.command("open x.csv");
    bench.typed("w");
    let what = Written::Session { revision: bench.0.revision, then_quit: false };
    let failed = Error::input("demo.wild.toml", "no room", "make some");
    let effects = update(&mut bench.0, Message::Written { what, path: "demo.wild.toml".into(), result: Err(failed) });
    assert!(effects.is_empty() && bench.0.unsaved() && bench.0.then_open.is_none());
    // A later save does not open what was asked for then.
    let what = Written::Session { revision: bench.0.revision, then_quit: false };
    let effects = update(&mut bench.0, Message::Written { what, path: "b.toml".into(), result: Ok("saved".into()) });
    assert_eq!(effects, [Effect::Files(Task::Remember("b.toml".into()))]);
}

#[test]
fn the_loader_shows_what_its_options_make_of_the_record() {
    for (label, size) in [("80x24", (80, 24)), ("120x40", (120, 40))] {
        let mut bench = Bench::new().size(size);
        let effects = bench.command("loader");
        let told = LoadOptions { time: Some("t_s".into()), ..LoadOptions::default() };
        let glance = Glance { source: Source::demo(), options: told.clone() };
        assert_eq!(effects, [Effect::Files(Task::Look(glance.clone()))]);
        bench.news(News::Seen { glance, result: Ok(seen(&told)), lines: Vec::new() });
        assert_snapshot!(format!("loader_{label}"), bench.frame());
    }
}

#[test]
fn every_field_of_the_loader_can_be_reached_at_the_least_size() {
    let mut bench = Bench::new().size((40, 10));
    bench.command("loader");
    let told = LoadOptions { time: Some("t_s".into()), ..LoadOptions::default() };
    let glance = Glance { source: Source::demo(), options: told.clone() };
    bench.news(News::Seen { glance, result: Ok(seen(&told)), lines: Vec::new() });
    for field in wildpoint::tui::update::FIELDS {
        let frame = bench.frame();
        assert!(
            frame.contains(&format!("> {}", field.name)) && frame.contains("Enter: reload with these settings"),
            "{frame}"
        );
        bench.key(KeyCode::Down);
    }
    assert!(bench.frame().contains("> time column"));
}

#[test]
fn track_and_encoding_are_told_and_go_into_the_session() {
    let mut bench = Bench::new();
    bench.command("loader");
    let told = LoadOptions { time: Some("t_s".into()), ..LoadOptions::default() };
    let glance = Glance { source: Source::demo(), options: told.clone() };
    bench.news(News::Seen { glance, result: Ok(seen(&told)), lines: Vec::new() });
    (0..5).for_each(|_| drop(bench.key(KeyCode::Down)));
    bench.typed("ealt_m");
    let options = LoadOptions { track: Some("alt_m".into()), ..told };
    let glance = Glance { source: Source::demo(), options: options.clone() };
    assert_eq!(bench.key(KeyCode::Enter), [Effect::Files(Task::Look(glance))]);
    // The encoding is the last field; after recognised and UTF-8 comes Latin-1.
    (0..6).for_each(|_| drop(bench.key(KeyCode::Up)));
    bench.key(KeyCode::Right);
    bench.key(KeyCode::Right);
    assert!(bench.frame().contains("> encoding         latin-1"), "{}", bench.frame());
    let options = LoadOptions { encoding: Some(Encoding::Latin1), ..options };
    let request = Request { source: Source::demo(), options: options.clone(), purpose: Purpose::Correct };
    assert_eq!(bench.key(KeyCode::Enter), [Effect::Files(Task::Open { ticket: 1, request })]);
    let mut session = bench.0.session.clone();
    session.data.options = options;
    let analysed = Analysed::of(&session, &bench.0.track, &Stop::never()).unwrap();
    let text = document(&mut session, &bench.0.track, &analysed, "s.toml".as_ref()).unwrap();
    let lines = ["track = \"alt_m\"", "encoding = \"latin-1\""];
    assert!(lines.iter().all(|line| text.lines().any(|l| l == *line)), "{text}");
}

#[test]
fn a_changed_option_is_looked_at_and_taken_with_enter() {
    let mut bench = Bench::new();
    bench.command("loader");
    let told = LoadOptions { time: Some("t_s".into()), ..LoadOptions::default() };
    let old = Glance { source: Source::demo(), options: told.clone() };
    bench.news(News::Seen { glance: old.clone(), result: Ok(seen(&told)), lines: Vec::new() });
    // From t_s on to the next column.
    let options = LoadOptions { time: Some("vx_mps".into()), ..LoadOptions::default() };
    let glance = Glance { source: Source::demo(), options: options.clone() };
    assert_eq!(bench.key(KeyCode::Right), [Effect::Files(Task::Look(glance.clone()))]);
    // What the options before made of it comes late: it is not shown for these.
    bench.news(News::Seen { glance: old, result: Err(Error::input("x", "late", "never mind")), lines: Vec::new() });
    assert!(!bench.frame().contains("late") && bench.frame().contains("looking"));
    let e = Error::input("demo", "these are no times", "choose another column");
    bench.news(News::Seen { glance, result: Err(e), lines: Vec::new() });
    assert!(bench.frame().contains("these are no times; choose another column"), "{}", bench.frame());
    // Missing markers are typed.
    (0..7).for_each(|_| drop(bench.key(KeyCode::Down)));
    bench.typed("e-99, x");
    bench.key(KeyCode::Enter);
    let options = LoadOptions { missing: vec!["-99".into(), "x".into()], ..options };
    let request = Request { source: Source::demo(), options, purpose: Purpose::Correct };
    assert_eq!(bench.key(KeyCode::Enter), [Effect::Files(Task::Open { ticket: 1, request })]);
}

#[test]
fn the_picker_corrects_how_its_choice_is_loaded() {
    let mut bench = picker(Glyphs::Unicode);
    bench.key(KeyCode::Tab);
    assert!(bench.frame().contains("a session already says how its record is loaded"), "{}", bench.frame());
    bench.key(KeyCode::Down);
    let effects = bench.key(KeyCode::Tab);
    assert_eq!(effects, [Effect::Files(Task::Look(Glance::file(DEMO.into())))]);
    assert!(bench.frame().contains("how to load demo.csv"));
    bench.key(KeyCode::Esc);
    assert!(bench.frame().contains("radar_week_17.csv.gz"), "back in the picker");
}

#[test]
fn outputs_are_chosen_named_and_written_together() {
    for (label, size) in [("80x24", (80, 24)), ("120x40", (120, 40))] {
        let mut bench = Bench::new().size(size);
        let effects = bench.control('e');
        let names = [
            "demo.clean.csv",
            "demo.flags.csv",
            "demo.diagnostics.csv",
            "demo.html",
            "demo.wild.toml",
            "demo.decisions.csv",
        ];
        assert_eq!(effects, [Effect::Files(Task::Check(names.map(PathBuf::from).to_vec()))]);
        bench.news(News::Checked(vec![("demo.flags.csv".into(), true), ("demo.html".into(), false)]));
        bench.key(KeyCode::Down);
        bench.typed(" ");
        assert_snapshot!(format!("export_{label}"), bench.frame());
        // The report under another name.
        (0..2).for_each(|_| drop(bench.key(KeyCode::Down)));
        bench.typed("e");
        (0..9).for_each(|_| drop(bench.key(KeyCode::Backspace)));
        bench.typed("out/r.pdf");
        bench.key(KeyCode::Enter);
        assert!(bench.key(KeyCode::Enter).is_empty(), "there is no such report");
        assert!(bench.frame().contains("unknown report format"), "{}", bench.frame());
        bench.typed("e");
        (0..3).for_each(|_| drop(bench.key(KeyCode::Backspace)));
        bench.typed("md");
        bench.key(KeyCode::Enter);
        let output = |kind, path: &str| Output { kind, path: path.into() };
        let outputs = vec![
            output(OutputKind::Cleaned, "demo.clean.csv"),
            output(OutputKind::Flags, "demo.flags.csv"),
            output(OutputKind::Report, "out/r.md"),
        ];
        let effects = bench.key(KeyCode::Enter);
        assert_eq!(effects, [Effect::Export { outputs: outputs.clone(), overwrite: false }]);
        // One is there: nothing was written, and it is asked.
        let what = Written::Exported { outputs: outputs.clone(), revision: 0 };
        let result = Err(Error::Exists("demo.flags.csv".into()));
        update(&mut bench.0, Message::Written { what: what.clone(), path: "demo.clean.csv".into(), result });
        assert_snapshot!(format!("overwrite_{label}"), bench.frame());
        assert_eq!(bench.typed("o"), [Effect::Export { outputs, overwrite: true }]);
        let done = Message::Written { what, path: "demo.clean.csv".into(), result: Ok("wrote 3 files".into()) };
        assert!(update(&mut bench.0, done).is_empty());
        assert!(matches!(bench.0.overlay, Overlay::None) && bench.frame().contains("wrote 3 files"));
    }
}

#[test]
fn a_session_among_the_outputs_is_saved() {
    let mut bench = Bench::new();
    bench.typed("a");
    let outputs = vec![Output { kind: OutputKind::Session, path: "s.toml".into() }];
    let what = Written::Exported { outputs, revision: bench.0.revision };
    update(&mut bench.0, Message::Written { what, path: "s.toml".into(), result: Ok("wrote".into()) });
    assert!(!bench.0.unsaved() && bench.0.file == Some("s.toml".into()));
}

#[test]
fn save_as_completes_the_path() {
    let mut bench = Bench::new();
    bench.typed("W");
    bench.control('u');
    bench.typed("rev");
    assert_eq!(bench.key(KeyCode::Tab), [Effect::Files(Task::Complete("rev".into()))]);
    bench.news(News::Completed { typed: "re".into(), completed: "record".into() });
    assert!(bench.frame().contains("save as: rev"), "what was typed before is not completed late");
    bench.news(News::Completed { typed: "rev".into(), completed: "reviews/".into() });
    bench.typed("a.toml");
    let path = PathBuf::from("reviews/a.toml");
    assert_eq!(bench.key(KeyCode::Enter), [Effect::Save { path, overwrite: false, then_quit: false }]);
    let what = Written::Session { revision: 0, then_quit: false };
    let result = Err(Error::Exists("reviews/a.toml".into()));
    update(&mut bench.0, Message::Written { what, path: "reviews/a.toml".into(), result });
    let path = PathBuf::from("reviews/a.toml");
    assert_eq!(bench.typed("o"), [Effect::Save { path, overwrite: true, then_quit: false }]);
}

#[test]
fn dialogs_are_drawn_at_any_size_and_in_ascii() {
    for size in [(40, 10), (60, 16), (80, 24), (200, 60)] {
        let mut ascii = picker(Glyphs::Ascii).size(size);
        ascii.key(KeyCode::Down);
        ascii.news(News::Seen {
            glance: Glance::file(DEMO.into()),
            result: Ok(seen(&LoadOptions::default())),
            lines: Vec::new(),
        });
        let mut frames = vec![ascii.frame()];
        ascii.key(KeyCode::Tab);
        ascii.news(News::Seen {
            glance: Glance::file(DEMO.into()),
            result: Ok(seen(&LoadOptions::default())),
            lines: Vec::new(),
        });
        (0..10).for_each(|_| drop(ascii.key(KeyCode::Down)));
        assert!(ascii.frame().contains("> skipped lines"), "the field under the cursor is in sight\n{}", ascii.frame());
        frames.push(ascii.frame());
        let mut export = Bench::with(Glyphs::Ascii).size(size);
        export.control('e');
        frames.push(export.frame());
        for frame in frames {
            assert!(!frame.contains('\x1b'));
            let strange: String = frame.chars().filter(|c| !c.is_ascii() && !"高さ".contains(*c)).collect();
            assert_eq!(strange, "", "{size:?}\n{frame}");
        }
    }
}
