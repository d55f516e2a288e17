//! Reviewing with keys, driven through `update` on records whose wild points are known because they were put there.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::fmt::Write as _;

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use wildpoint::method::METHODS;
use wildpoint::review::{Ruling, Signature};
use wildpoint::session::{Edit, Plan, Session, Setup};
use wildpoint::stop::Stop;
use wildpoint::track::{LoadOptions, Source, load};
use wildpoint::tui::advice::Advise;
use wildpoint::tui::jobs::Judge;
use wildpoint::tui::message::{Effect, Message};
use wildpoint::tui::model::Model;
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::theme::Theme;
use wildpoint::tui::update::update;
use wildpoint::tui::{text_of, view};

/// A record of slow sines with a little even noise, and `a` thrown off by 50 in these rows (from 1).
fn record(rows: usize, wild: &[usize]) -> String {
    thrown(rows, |row| if wild.contains(&row) { 50.0 } else { 0.0 })
}

/// The same, with `a` thrown off by what a row says.
fn thrown(rows: usize, off: impl Fn(usize) -> f64) -> String {
    let mut text = String::from("t,a,b\n");
    for row in 1..=rows {
        let t = row as f64;
        // A fixed sequence that repeats only after 61 samples.
        let noise = ((row * 37) % 61) as f64 / 61.0 - 0.5;
        let (a, b) = ((t / 40.0).sin() * 5.0 + 0.1 * noise + off(row), (t / 55.0).cos() * 3.0 + 0.1 * noise);
        writeln!(text, "{t},{a:.6},{b:.6}").unwrap();
    }
    text
}

/// A workbench whose results are there at once.
struct Bench {
    model: Model,
    pressed: usize,
    _folder: tempfile::TempDir,
}

impl Bench {
    fn on(text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("record.csv");
        std::fs::write(&path, text).unwrap();
        let track = load(&Source::File(path), &LoadOptions::default()).unwrap();
        let session = Session::new(&track, LoadOptions::default(), &Setup::standard());
        let model = Model::new(track.into(), session, None, Theme::mono(), Glyphs::Ascii);
        let mut bench = Self { model, pressed: 0, _folder: folder };
        bench.take(Message::Resize(120, 40));
        bench.carry_out(vec![Effect::Analyse(0)]);
        bench
    }

    fn take(&mut self, message: Message) {
        let effects = update(&mut self.model, message);
        self.carry_out(effects);
    }

    fn carry_out(&mut self, effects: Vec<Effect>) {
        for effect in effects {
            match effect {
                Effect::Analyse(plan) => {
                    let result = Judge::new(&self.model, plan).run(&Stop::never()).map(Box::new);
                    self.model.awaited = Some(0);
                    self.take(Message::Analysed { generation: 0, plan, result });
                }
                Effect::Advise(plan) => {
                    if let Ok(Some(steps)) = Advise::new(&self.model, plan).steps(&Stop::never()) {
                        self.take(Message::Stepped { plan, steps: Box::new(steps) });
                    }
                }
                Effect::Redraw => {}
                other => panic!("{other:?} is nothing for a review"),
            }
        }
    }

    fn press(&mut self, code: KeyCode) {
        self.pressed += 1;
        self.take(Message::Key(KeyEvent::new(code, KeyModifiers::NONE)));
    }

    fn keys(&mut self, keys: &str) {
        keys.chars().for_each(|c| self.press(if c == '\n' { KeyCode::Enter } else { KeyCode::Char(c) }));
    }

    /// What the program said last.
    fn said(&self) -> &str {
        self.model.toast.as_ref().map_or("", |toast| &toast.text)
    }

    /// Rows (from 1) and rulings of the decisions about a plan.
    fn decisions(&self, plan: usize) -> Vec<(u32, Ruling)> {
        self.model.session.plans[plan].decisions.iter().map(|(row, d)| (row + 1, d.ruling)).collect()
    }

    fn note(&self, row: u32) -> String {
        self.model.plan().decisions.get(row - 1).unwrap().note.clone()
    }

    fn cursor_row(&self) -> usize {
        self.model.series().row(self.model.state().cursor) + 1
    }

    fn frame(&self) -> String {
        let (width, height) = self.model.size;
        let area = Rect { x: 0, y: 0, width, height };
        let mut buffer = Buffer::empty(area);
        view::draw(&self.model, area, &mut buffer);
        text_of(&buffer)
    }

    fn plans(&self) -> Vec<Plan> {
        self.model.session.plans.clone()
    }
}

#[test]
fn a_review_of_100_flags_takes_100_to_110_keystrokes() {
    let wild: Vec<usize> = (0..100).map(|i| 40 + 29 * i).collect();
    let mut bench = Bench::on(&record(3000, &wild));
    assert_eq!(bench.model.state().drawn.as_ref().unwrap().outcome.counts.flagged, 100, "what was put there");
    while !bench.said().contains("every flag is decided") {
        // Every seventh is overruled.
        bench.keys(if bench.pressed % 7 == 6 { "r" } else { "a" });
        assert!(bench.pressed <= 110, "still not through: {}", bench.frame());
    }
    assert!((100..=110).contains(&bench.pressed), "{} keystrokes", bench.pressed);
    let rulings = bench.decisions(0);
    assert_eq!(rulings.iter().map(|d| d.0 as usize).collect::<Vec<_>>(), wild);
    assert!(rulings.iter().enumerate().all(|(i, d)| (d.1 == Ruling::Normal) == (i % 7 == 6)));
}

#[test]
fn a_range_is_decided_on_at_once_and_undone_at_once() {
    let mut bench = Bench::on(&record(400, &[100, 110, 130]));
    bench.keys(":goto #95\n");
    bench.keys("v:goto #115\n");
    assert_eq!(bench.model.selection(), Some(94..115), "the cursor is its other end, wherever it goes");
    assert!(bench.frame().contains("rows 95 to 115: 21 samples, 2 flags"), "{}", bench.frame());
    bench.keys("r");
    assert_eq!(bench.decisions(0), [(100, Ruling::Normal), (110, Ruling::Normal)]);
    assert!(bench.said().contains("rejected 2 flags of 21 samples selected"), "{}", bench.said());
    assert_eq!((bench.model.selection(), bench.model.history.len()), (None, 1));
    bench.keys("u");
    assert_eq!(bench.decisions(0), []);
    // By hand, all samples; taking back, all decisions; and leaving does nothing.
    bench.keys(":goto #200\nv:goto #204\no");
    assert_eq!(bench.decisions(0), (200..=204).map(|row| (row, Ruling::Outlier)).collect::<Vec<_>>());
    bench.keys(":goto #203\nv:goto #300\nx");
    assert_eq!(bench.decisions(0), (200..=202).map(|row| (row, Ruling::Outlier)).collect::<Vec<_>>());
    let edits = bench.model.history.len();
    bench.keys(":goto #1\nv:goto #300\n");
    bench.press(KeyCode::Esc);
    assert_eq!((bench.model.selection(), bench.model.history.len()), (None, edits));
}

#[test]
fn panning_carries_the_end_of_a_range_along() {
    let mut bench = Bench::on(&record(400, &[100]));
    bench.keys(":goto #100\nv");
    bench.press(KeyCode::Right);
    let range = bench.model.selection().unwrap();
    assert_eq!(range.start, 99);
    assert!((130..=145).contains(&range.end), "a tenth of 400: {range:?}");
}

#[test]
fn runs_are_one_thing_where_they_are_reviewed_so() {
    let mut bench = Bench::on(&record(400, &[100, 200, 201, 202, 203, 300, 301]));
    assert_eq!(bench.model.state().queue.len(), 7);
    bench.keys("K");
    assert_eq!(bench.model.state().queue, [99, 199, 299]);
    assert!(bench.frame().contains("200..203 x4"), "{}", bench.frame());
    bench.keys("n");
    assert_eq!(bench.cursor_row(), 200);
    bench.keys("r");
    assert_eq!(bench.decisions(0), (200..=203).map(|row| (row, Ruling::Normal)).collect::<Vec<_>>());
    assert_eq!(bench.cursor_row(), 300, "on to the next run");
    assert!(bench.said().contains("rejected a run of 4, rows 200 to 203"), "{}", bench.said());
    // Longest first.
    bench.keys("sss");
    assert_eq!(bench.model.state().queue, [199, 299, 99]);
    bench.keys("s");
    // A rejected run is still one: the space bar turns all of it.
    bench.keys(":goto #202\n ");
    assert_eq!(bench.decisions(0), (200..=203).map(|row| (row, Ruling::Outlier)).collect::<Vec<_>>());
    bench.keys("uu");
    assert_eq!((bench.decisions(0).len(), bench.model.history.len()), (0, 0), "two steps");
}

#[test]
fn a_walk_over_runs_meets_each_once_and_says_when_it_wraps() {
    let mut bench = Bench::on(&record(400, &[100, 200, 201, 202, 300]));
    bench.keys("K:goto #201\np");
    assert_eq!(bench.cursor_row(), 100, "the run before, not the head of this one");
    bench.keys("nn");
    assert_eq!(bench.cursor_row(), 300);
    bench.keys("n");
    assert_eq!((bench.cursor_row(), bench.said()), (100, "from the first flag again"));
}

#[test]
fn without_auto_advance_a_decision_stays() {
    let mut bench = Bench::on(&record(400, &[100, 200, 300]));
    bench.keys(":auto-advance off\na");
    assert_eq!(bench.cursor_row(), 100);
    assert!(bench.frame().contains("auto-advance off"), "{}", bench.frame());
    bench.keys("g.Na");
    assert_eq!(bench.cursor_row(), 300, "on again");
}

#[test]
fn conflicts_are_counted_marked_and_walked() {
    // The noise is 0.03: one of these is far off, two only somewhat.
    let mut bench = Bench::on(&thrown(400, |row| match row {
        100 => 50.0,
        200 | 300 => 0.6,
        _ => 0.0,
    }));
    bench.keys("aaa");
    assert_eq!(bench.decisions(0).len(), 3);
    bench.keys("gc");
    assert_eq!(bench.said(), "no decision contradicts the method");
    bench.keys(":set k 90\n");
    assert_eq!(bench.model.state().drawn.as_ref().unwrap().outcome.counts.conflicts, 2);
    assert!(bench.frame().lines().next().unwrap().contains(" !2"), "{}", bench.frame());
    bench.keys(":goto #1\ngc");
    assert_eq!(bench.cursor_row(), 200);
    bench.keys("gc");
    assert_eq!(bench.cursor_row(), 300);
    bench.keys("gC");
    assert_eq!(bench.cursor_row(), 200);
    assert!(bench.frame().contains("contradicts the method"), "{}", bench.frame());
    let rows: Vec<String> = bench.frame().lines().filter(|l| l.contains('!')).map(str::to_owned).collect();
    assert!(rows.iter().any(|l| l.contains(" 200 ")) && rows.iter().any(|l| l.contains(" 300 ")), "{rows:?}");
    // In the order of the state they come first.
    bench.keys("ss");
    assert_eq!(bench.model.state().queue[..2], [199, 299]);
}

#[test]
fn what_is_typed_after_c_is_a_note_and_never_keys() {
    let mut bench = Bench::on(&record(400, &[100, 200, 300]));
    // Nothing is decided yet: the note waits for it.
    bench.keys("cruax\n");
    assert_eq!((bench.decisions(0).len(), bench.model.history.len()), (0, 0));
    assert!(bench.said().contains("waits for a, r or o"), "{}", bench.said());
    bench.keys("a");
    assert_eq!(bench.note(100), "ruax");
    assert_eq!(bench.model.history.len(), 1, "the note came with the decision");
    // On the next flag already: the note is about the decision just made.
    bench.keys("ac");
    bench.press(KeyCode::Down);
    bench.keys(": 12 km\n");
    assert_eq!((bench.cursor_row(), bench.note(200).as_str()), (300, "glint: 12 km"));
    bench.keys("c");
    bench.press(KeyCode::Down);
    bench.keys("\n");
    assert_eq!(bench.note(200), "multipath: 12 km");
    // Away from there, it is about the sample under the cursor.
    bench.keys(":goto #50\nco\n");
    assert_eq!((bench.decisions(0).len(), bench.note(200).as_str()), (2, "multipath: 12 km"));
    bench.keys("o");
    assert_eq!(bench.note(50), "o");
}

#[test]
fn the_journal_leads_back_and_forth() {
    let mut bench = Bench::on(&record(400, &[100, 200, 300]));
    let first = bench.plans();
    bench.keys("ar:set k 6\n:method hampel\n:repair linear\n");
    let last = bench.plans();
    bench.keys("J");
    let frame = bench.frame();
    for words in ["row 100 outlier", "row 200 normal", "k 4.0 > 6.0", "two-sided > hampel", "as it was opened"] {
        assert!(frame.contains(words), "{words} is not in\n{frame}");
    }
    bench.press(KeyCode::Home);
    bench.keys("\n");
    assert_eq!((bench.plans(), bench.model.history.len()), (first, 0));
    assert_eq!(bench.model.history.undone().len(), 5);
    bench.keys("J");
    assert!(bench.frame().contains("row 100 outlier  (undone)"), "{}", bench.frame());
    bench.press(KeyCode::Down);
    bench.keys("\n");
    assert_eq!(bench.decisions(0), [(100, Ruling::Outlier)]);
    bench.keys("J");
    bench.press(KeyCode::End);
    bench.keys("\n");
    assert_eq!(bench.plans(), last);
}

#[test]
fn settings_go_to_all_channels_in_one_step() {
    let mut bench = Bench::on(&record(400, &[100]));
    bench.keys(":method hampel\n:set k 7\n:repair linear\n");
    let before = bench.plans();
    bench.keys("gs");
    let setups: Vec<&Setup> = bench.model.session.plans.iter().map(|p| &p.setup).collect();
    assert_eq!(setups[0], setups[1]);
    assert!(bench.said().contains("1 other channel"), "{}", bench.said());
    bench.keys("u");
    assert_eq!(bench.plans(), before);
    // A rate is a channel's own: b cannot measure its own rate.
    bench.keys(":method matched\n\n");
    assert_eq!(bench.model.plan().setup.rate.as_deref(), Some("b"));
    bench.keys("gs");
    assert_eq!(bench.model.session.plans[1].setup.rate, None);
    assert!(bench.said().contains("none is chosen for b"), "{}", bench.said());
}

#[test]
fn an_epoch_is_decided_on_in_all_channels_in_one_step() {
    let mut text = record(400, &[100, 200]);
    // Row 200 has nothing in b.
    let line = text.lines().nth(200).unwrap().to_owned();
    let cut = line.rsplit_once(',').unwrap().0;
    text = text.replace(&line, &format!("{cut},"));
    let mut bench = Bench::on(&text);
    bench.keys("ge");
    assert_eq!((bench.decisions(0), bench.decisions(1)), (vec![(100, Ruling::Outlier)], vec![(100, Ruling::Outlier)]));
    assert!(matches!(bench.model.history.last(), Some(Edit::Several(parts)) if parts.len() == 2));
    assert_eq!(bench.cursor_row(), 200, "on to the next flag");
    bench.keys("pr:goto #100\nge");
    assert_eq!(bench.decisions(1), [(100, Ruling::Normal)], "what was decided here goes there");
    bench.keys(":goto #200\nge");
    assert!(bench.said().contains("no value in b"), "{}", bench.said());
    bench.keys("uuuu");
    assert_eq!((bench.decisions(0), bench.decisions(1)), (Vec::new(), Vec::new()));
    bench.keys("U");
    assert_eq!((bench.decisions(0).len(), bench.decisions(1).len()), (1, 1));
}

#[test]
fn what_a_step_gains_and_loses_is_what_comes_of_it() {
    // Offsets of all sizes, so that every step of a threshold moves some flag.
    let text = thrown(600, |row| if row % 12 == 0 { row as f64 / 700.0 } else { 0.0 });
    let flagged = |bench: &Bench| bench.model.state().drawn.as_ref().unwrap().outcome.counts.flagged;
    let mut moved = 0;
    for method in METHODS.iter().filter(|m| !m.about().needs_rate) {
        let mut bench = Bench::on(&text);
        bench.keys(&format!(":method {}\n", method.about().id));
        // The documents' own values: their floors do not come from the record.
        bench.keys("i");
        // A decision of each kind: these do not change, whatever the method says.
        bench.keys("aar");
        for key in [".", ",,"] {
            let Some(steps) = bench.model.steps().cloned() else { continue };
            let step = if key == "." { steps.up } else { steps.down };
            let Some(step) = step else { continue };
            let (gained, lost) = step.counts(&bench.model.plan().decisions);
            let before = flagged(&bench);
            bench.keys(&key[..1]);
            assert_eq!(flagged(&bench), before + gained - lost, "{} {key}", method.about().id);
            moved += usize::from(gained + lost > 0);
        }
    }
    assert!(moved >= 2, "{moved} steps changed something: too few to tell");
}

#[test]
fn rows_of_the_queue_stay_where_they_are_when_a_flag_comes_above_them() {
    // 60 far off, and one near the beginning that only a low threshold flags.
    let text = thrown(2000, |row| match row {
        50 => 0.5,
        _ if row % 30 == 10 && row > 90 => 50.0,
        _ => 0.0,
    });
    let mut bench = Bench::on(&text);
    bench.keys(":set k 40\n:goto #1000\nn");
    let queue = |bench: &Bench| -> Vec<String> {
        let frame = bench.frame();
        let column = |line: &str| line.chars().skip(83).collect::<String>();
        frame.lines().skip(24).take(12).map(column).collect()
    };
    let (before, flags) = (queue(&bench), bench.model.state().queue.len());
    assert!(before.iter().any(|row| row.contains("1000") || row.contains("1030")), "{before:?}");
    bench.keys(":set k 6\n");
    assert!(bench.model.state().queue.len() > flags, "row 50 is flagged now");
    let after = queue(&bench);
    // All but the heading, which counts them.
    let rows = |lines: &[String]| lines.iter().filter(|l| !l.contains("queue")).cloned().collect::<Vec<_>>();
    assert_eq!(rows(&before), rows(&after));
    // Walking to the next row moves the mark, not the rows.
    bench.keys("n");
    let unmarked = |lines: &[String]| rows(lines).iter().map(|l| l.replace('>', " ")).collect::<Vec<_>>();
    assert_eq!(unmarked(&after), unmarked(&queue(&bench)));
}

#[test]
fn decisions_are_signed_and_whoever_decided_first_keeps_it() {
    let mut bench = Bench::on(&record(600, &[100, 300]));
    (bench.model.analyst, bench.model.now) = (Some("M. Ito".into()), Some(5));
    bench.keys("a");
    let signature = |bench: &Bench| bench.model.plan().decisions.get(99).map(|d| d.signature.clone());
    let first = Signature { by: Some("M. Ito".into()), at: Some(5) };
    assert_eq!(signature(&bench), Some(first.clone()));
    // The same again, by another: nothing has changed, and there is nothing to undo but the first.
    (bench.model.analyst, bench.model.now) = (Some("A. Kim".into()), Some(9));
    bench.keys("pa");
    assert_eq!((signature(&bench), bench.decisions(0).len()), (Some(first.clone()), 1));
    bench.keys("pr");
    let second = Signature { by: Some("A. Kim".into()), at: Some(9) };
    assert_eq!((signature(&bench), bench.decisions(0)), (Some(second), vec![(100, Ruling::Normal)]));
    bench.keys("p");
    assert!(bench.frame().contains("by A. Kim, 1970-01-01 00:00 UTC"), "{}", bench.frame());
    bench.keys("u");
    assert_eq!(signature(&bench), Some(first));
}
