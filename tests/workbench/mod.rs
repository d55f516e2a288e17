//! A workbench whose results are there at once, driven by keys.

#![expect(unreachable_pub, reason = "it is shared by test programs")]

use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use wildpoint::session::{Session, Setup};
use wildpoint::stop::Stop;
use wildpoint::track::{LoadOptions, Source, load};
use wildpoint::tui::advice::Advise;
use wildpoint::tui::consensus::Poll;
use wildpoint::tui::detectability::{Job, Subject};
use wildpoint::tui::files::{FileEntry, FileKind, Listing, News, Task};
use wildpoint::tui::jobs::Judge;
use wildpoint::tui::message::{Effect, Message};
use wildpoint::tui::model::Model;
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::survey::Survey;
use wildpoint::tui::theme::{ColorDepth, Theme};
use wildpoint::tui::update::update;
use wildpoint::tui::{Look, Opening, text_of, view};

pub const UNICODE_DARK: (Glyphs, ColorDepth) = (Glyphs::Unicode, ColorDepth::Indexed256);
pub const ASCII_MONO: (Glyphs, ColorDepth) = (Glyphs::Ascii, ColorDepth::Never);

/// A workbench whose results are there at once.
pub struct Bench(pub Model);

impl Bench {
    /// On a record of `data/`, in a window of 80x24.
    pub fn on(name: &str, look: (Glyphs, ColorDepth)) -> Self {
        let mut bench = Self::unanswered(name, look);
        bench.judge(0);
        bench
    }

    /// The same while the first result is still awaited.
    pub fn unanswered(name: &str, look: (Glyphs, ColorDepth)) -> Self {
        // As a user would name it from the checkout: paths on the screen are the same wherever that lies.
        Self::of(Source::File(PathBuf::from("data").join(name)), look)
    }

    /// On a record, while the first result is still awaited.
    pub fn of(source: Source, (glyphs, depth): (Glyphs, ColorDepth)) -> Self {
        let options = LoadOptions::default();
        let track = load(&source, &options).unwrap();
        let session = Session::new(&track, options, &Setup::standard());
        let opening = Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() };
        let model = opening.model(Look { theme: Theme::choose(depth, false), glyphs });
        let mut bench = Self(model);
        bench.0.awaited = Some(0);
        bench
    }

    pub fn judge(&mut self, plan: usize) {
        let result = Judge::new(&self.0, plan).run(&Stop::never()).map(Box::new);
        self.0.awaited = Some(0);
        for effect in update(&mut self.0, Message::Analysed { generation: 0, plan, result }) {
            match effect {
                Effect::Poll(plan) => self.poll(plan),
                Effect::Advise(plan) => self.advise(plan),
                Effect::Study(plan, subject) => self.study(plan, subject),
                Effect::CancelStudy => {}
                other => panic!("{other:?} follows on a result"),
            }
        }
    }

    /// What a step of the active parameter changes is there at once. The sweep comes when nothing else is to do: not in
    /// a still frame.
    fn advise(&mut self, plan: usize) {
        if let Some(steps) = Advise::new(&self.0, plan).steps(&Stop::never()).unwrap() {
            update(&mut self.0, Message::Stepped { plan, steps: Box::new(steps) });
        }
    }

    /// Asks all methods.
    fn poll(&mut self, plan: usize) {
        let poll = Poll::new(&self.0, plan);
        self.0.polling = Some(poll.started(7));
        let consensus = Box::new(poll.run(&Stop::never(), |_| {}).unwrap());
        update(&mut self.0, Message::Polled { generation: 7, plan, consensus });
    }

    /// Judges the channels of the overview.
    fn survey(&mut self, plans: &[usize]) {
        let survey = Survey::new(&self.0, plans);
        self.0.surveying = Some(7);
        let told = Mutex::new(Vec::new());
        survey.run(&Stop::never(), |plan, summary| told.lock().unwrap().push((plan, summary))).unwrap();
        for (plan, summary) in told.into_inner().unwrap() {
            let summary = summary.map(Arc::new);
            assert!(update(&mut self.0, Message::Surveyed { generation: 7, plan, summary }).is_empty());
        }
    }

    /// A measurement of detectability is under way.
    fn study(&mut self, plan: usize, subject: Subject) {
        self.0.studying = Some(Job::new(&self.0, plan, subject).started(7));
    }

    pub fn size(mut self, (width, height): (u16, u16)) -> Self {
        update(&mut self.0, Message::Resize(width, height));
        self
    }

    /// Presses keys: names stand between blanks, everything else is typed letter by letter.
    pub fn keys(mut self, keys: &str) -> Self {
        for name in keys.split(' ') {
            let named = match name {
                "Enter" => Some(KeyCode::Enter),
                "Esc" => Some(KeyCode::Esc),
                "Down" => Some(KeyCode::Down),
                "Tab" => Some(KeyCode::Tab),
                "Space" => Some(KeyCode::Char(' ')),
                _ => None,
            };
            match named {
                Some(code) => self.press(code),
                None => name.chars().for_each(|c| self.press(KeyCode::Char(c))),
            }
        }
        self
    }

    fn press(&mut self, code: KeyCode) {
        let effects = update(&mut self.0, Message::Key(KeyEvent::new(code, KeyModifiers::NONE)));
        for effect in effects {
            match effect {
                Effect::Analyse(plan) => self.judge(plan),
                Effect::Poll(plan) => self.poll(plan),
                Effect::Advise(plan) => self.advise(plan),
                Effect::Study(plan, subject) => self.study(plan, subject),
                Effect::Survey(plans) => self.survey(&plans),
                Effect::CancelPoll | Effect::CancelStudy | Effect::CancelSurvey => {}
                Effect::Files(task) => self.answer(task),
                other => panic!("{other:?} is nothing for a still frame"),
            }
        }
    }

    /// News of files: a folder that is the same everywhere, what its files are, and nothing where outputs would go.
    fn answer(&mut self, task: Task) {
        let news = match task {
            Task::List(folder) => News::Listed(Ok(Listing { folder, entries: entries(), file: None, note: None })),
            Task::Look(glance) => News::Seen { result: glance.look(&Stop::never()), glance, lines: Vec::new() },
            Task::Check(paths) => News::Checked(paths.into_iter().map(|path| (path, false)).collect()),
            other => panic!("{other:?} is nothing for a still frame"),
        };
        for effect in update(&mut self.0, Message::Files(news)) {
            match effect {
                Effect::Files(task) => self.answer(task),
                other => panic!("{other:?} follows on news of files"),
            }
        }
    }

    pub fn buffer(&self) -> Buffer {
        let (width, height) = self.0.size;
        let area = Rect { x: 0, y: 0, width, height };
        let mut buffer = Buffer::empty(area);
        view::draw(&self.0, area, &mut buffer);
        buffer
    }

    pub fn frame(&self) -> String {
        text_of(&self.buffer())
    }
}

/// A recent session, a recent record, and a folder with one of each kind; one of them is there to be looked into.
fn entries() -> Vec<FileEntry> {
    let entry = |path: &str, kind: FileKind, size: u64, recent: bool| FileEntry {
        path: PathBuf::from(path),
        name: if recent { path } else { path.rsplit('/').next().unwrap() }.to_owned(),
        kind,
        size,
        changed: "2026-03-04 11:49".into(),
        recent,
    };
    vec![
        entry("data/demo.csv", FileKind::File, 84_000, true),
        entry("reviews/flight-12/second-pass.toml", FileKind::Session, 4_812, true),
        entry("data/2026", FileKind::Folder, 0, false),
        entry("data/demo.csv", FileKind::File, 84_000, false),
        entry("data/radar_week_17.csv.gz", FileKind::File, 210_000_000, false),
    ]
}

/// The frames at both sizes after some keys, each with the name of its size.
pub fn frames(keys: &str) -> [(&'static str, String); 2] {
    [("80x24", (80, 24)), ("120x40", (120, 40))].map(|(label, size)| {
        let bench = Bench::on("demo.csv", UNICODE_DARK).size(size);
        let bench = if keys.is_empty() { bench } else { bench.keys(keys) };
        (label, bench.frame())
    })
}
