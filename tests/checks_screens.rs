//! Checks, periods and decisions that teach, in the workbench: driven through `update`, seen through model and screen.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::fmt::Write as _;

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use wildpoint::method::Verdict;
use wildpoint::session::{Preparation, Session, Setup};
use wildpoint::stop::Stop;
use wildpoint::track::{LoadOptions, Source, load};
use wildpoint::tui::jobs::Judge;
use wildpoint::tui::message::{Effect, Message};
use wildpoint::tui::model::Model;
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::theme::Theme;
use wildpoint::tui::update::update;
use wildpoint::tui::{Look, Opening, text_of, view};

/// A workbench on a record of the test's own, whose results are there at once.
struct Bench(Model);

impl Bench {
    fn on(text: &str) -> Self {
        let track =
            load(&Source::BuiltIn { name: "test", bytes: text.as_bytes().into() }, &LoadOptions::default()).unwrap();
        let session = Session::new(&track, LoadOptions::default(), &Setup::standard()).with_suggestions(&track);
        let opening = Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() };
        let mut bench = Self(opening.model(Look { theme: Theme::mono(), glyphs: Glyphs::Unicode }));
        let toast = bench.0.toast.take();
        bench.send(Message::Resize(120, 40));
        bench.judge(0);
        bench.0.toast = toast;
        bench
    }

    fn judge(&mut self, plan: usize) {
        let result = Judge::new(&self.0, plan).run(&Stop::never()).map(Box::new);
        self.0.awaited = Some(0);
        update(&mut self.0, Message::Analysed { generation: 0, plan, result });
    }

    fn send(&mut self, message: Message) {
        for effect in update(&mut self.0, message) {
            if let Effect::Analyse(plan) = effect {
                self.judge(plan);
            }
        }
    }

    fn keys(&mut self, text: &str) -> &mut Self {
        for c in text.chars() {
            let code = if c == '\r' { KeyCode::Enter } else { KeyCode::Char(c) };
            self.send(Message::Key(KeyEvent::new(code, KeyModifiers::NONE)));
        }
        self
    }

    fn toast(&self) -> &str {
        self.0.toast.as_ref().map_or("", |t| t.text.as_str())
    }

    fn done(&self) -> &Preparation {
        &self.0.plan().setup.preparation
    }

    fn verdict(&self, position: usize) -> Verdict {
        self.0.state().drawn.as_ref().unwrap().outcome.verdict(position)
    }

    fn screen(&self) -> String {
        let area = Rect::new(0, 0, self.0.size.0, self.0.size.1);
        let mut buffer = Buffer::empty(area);
        view::draw(&self.0, area, &mut buffer);
        text_of(&buffer)
    }
}

fn record(values: impl IntoIterator<Item = f64>) -> String {
    let mut text = String::from("time_s,v\n");
    for (i, value) in values.into_iter().enumerate() {
        let _ = writeln!(text, "{i},{value:.2}");
    }
    text
}

fn level(i: usize) -> f64 {
    40.0 + 8.0 * (i as f64 * 0.03).sin() + 0.3 * ((i * 7919) % 13) as f64 / 13.0
}

#[test]
fn what_is_certain_is_done_and_told_and_what_is_doubtful_is_offered_on_one_key() {
    let text = record((0..300).map(|i| match i {
        100..=140 => -9999.0,
        200 => 9999.0,
        _ => level(i),
    }));
    let mut bench = Bench::on(&text);
    assert!(bench.toast().contains("-9999.0 41 times (13.67 %) is a fill value"), "{}", bench.toast());
    assert!(bench.toast().contains("9999.0 once may be a fill value: gf takes it"), "{}", bench.toast());
    assert_eq!((bench.done().checks.len(), bench.verdict(120)), (1, Verdict::Outlier));
    bench.keys("gf");
    assert_eq!(bench.done().checks.len(), 2);
    assert!(bench.keys("gf").toast().contains("already set"));
    bench.keys("gk");
    assert!(!bench.done().checks_anything() && bench.done().checks.len() == 2, "kept, but off");
    bench.keys("gk");
    assert!(bench.done().checks_anything());
    bench.keys("uuu");
    assert_eq!(bench.done().checks.len(), 1, "every change can be undone");
}

#[test]
fn a_check_is_made_by_a_command_stands_in_the_panel_and_says_why_on_the_card() {
    let mut bench = Bench::on(&record((0..300).map(|i| if i == 150 { 500.0 } else { level(i) })));
    bench.keys(":check valid-range:low=0,high=100\r");
    let check = bench.0.state().drawn.as_ref().unwrap().outcome.detection.objected(150).unwrap();
    assert_eq!((check.by, check.evidence.as_str()), ("valid-range", "above 100"));
    bench.keys("3");
    bench.keys(
        &"j".repeat(bench.0.knobs().iter().position(|k| k.name() == "valid-range").unwrap() - bench.0.state().knob),
    );
    let screen = bench.screen();
    assert!(screen.contains("valid-range") && screen.contains("‹ on ›"), "{screen}");
    bench.keys("h");
    assert!(
        bench.toast().contains("valid-range off")
            && bench.0.state().drawn.as_ref().unwrap().outcome.detection.objected(150).is_none()
    );
    bench.keys(":goto #151\r");
    bench.keys("gk");
    assert!(bench.screen().contains("valid-range: outlier: above 100"), "{}", bench.screen());
    bench.keys(":uncheck all\r");
    assert!(bench.done().is_empty());
    bench.keys(":check valid-range\r");
    assert!(bench.screen().contains("needs a limit"), "{}", bench.screen());
}

#[test]
fn a_period_and_a_position_are_told() {
    let mut text = String::from("time_s,lat,lon\n");
    for i in 0..300 {
        let off = if i == 150 { 0.02 } else { 0.0 };
        let _ = writeln!(text, "{i},{:.6},{:.6}", 48.0 + 1e-5 * f64::from(i), 11.0 + 2e-5 * f64::from(i) + off);
    }
    let mut bench = Bench::on(&text);
    bench.keys(":position lat,lon\r");
    let names: Vec<usize> = bench.0.session.plans.iter().map(|p| p.setup.preparation.checks.len()).collect();
    assert_eq!(names, [1, 1]);
    assert_eq!(bench.verdict(150), Verdict::Outlier, "the latitude of a fix that is off in the longitude");
    bench.keys(":period 360\r");
    assert_eq!(bench.done().period, Some(360.0));
    bench.keys("uu");
    assert!(bench.0.session.plans.iter().all(|p| p.setup.preparation.is_empty()));
}

#[test]
fn a_decision_teaches_at_the_next_judgement() {
    let wild = |i: usize| {
        if (200..215).contains(&i) {
            60.0
        } else if i == 225 {
            9.0
        } else {
            0.0
        }
    };
    let noise = |i: usize| ((i * 7919) % 101) as f64 / 50.0 - 1.0;
    let mut bench = Bench::on(&record((0..400).map(|i| 20.0 + noise(i) + wild(i))));
    bench.keys(":method mean-window\r:set scale rms\r:set window 61\r:set feedback false\r");
    bench.keys(":goto #201\rv:goto #215\ro");
    assert_eq!(bench.0.plan().decisions.len(), 15, "{}", bench.toast());
    assert_eq!(bench.verdict(225), Verdict::Normal);
    bench.keys("gt");
    assert!(bench.done().exclude_decided);
    assert_eq!((bench.verdict(205), bench.verdict(225)), (Verdict::Outlier, Verdict::Outlier));
    bench.keys("gt");
    assert_eq!(bench.verdict(225), Verdict::Normal);
}
