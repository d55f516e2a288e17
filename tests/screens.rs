//! Whole frames of the workbench as an analyst sees them, driven by keys through `update` and drawn by `view`.
//!
//! Text is for people; a few frames are kept with their styles as well, where the style says something that the
//! text does not.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

#[path = "screens/matrix.rs"]
mod matrix;
#[path = "screens/queue.rs"]
mod queue;
mod workbench;

use insta::{assert_debug_snapshot, assert_snapshot};
use wildpoint::param::Value;
use wildpoint::session::sweep::Threshold;
use wildpoint::stop::Stop;
use wildpoint::tui::advice::Advise;
use wildpoint::tui::message::Message;
use wildpoint::tui::update::update;

use workbench::{ASCII_MONO, Bench, UNICODE_DARK, frames};

/// Keeps a frame at both sizes, under `name` and the size.
fn both(name: &str, keys: &str) {
    for (label, frame) in frames(keys) {
        assert_snapshot!(format!("{name}_{label}"), frame);
    }
}

/// Rejects the second flag, accepts the third, flags a sample by hand and looks at what lies around it.
const REVIEWED: &str = "n r a :goto Space #230 Enter o p z";

#[test]
fn start() {
    both("start", "");
}

#[test]
fn zoomed_on_a_flag_after_decisions() {
    both("reviewed", REVIEWED);
}

#[test]
fn parameters_with_the_keyboard() {
    both("parameters", "3 Down Down");
}

#[test]
fn queue_with_the_keyboard() {
    both("queue", "s s 4 Down Down");
}

#[test]
fn range_with_its_counts() {
    both("range", ":goto Space #180 Enter v :goto Space #230 Enter");
}

#[test]
fn queue_of_runs_longest_first() {
    both("runs", "K s s s 4 Down");
}

#[test]
fn reasons_for_a_note() {
    both("reasons", "a c Down Down");
}

#[test]
fn journal_of_edits_with_some_taken_back() {
    both("journal", "a r . . :repair Space linear Enter u u J");
}

#[test]
fn card_with_room() {
    both("card", "n a p 5 w");
}

#[test]
fn help() {
    both("help", "?");
}

#[test]
fn help_narrowed_by_what_was_typed() {
    both("help_narrowed", "?undo");
}

#[test]
fn list_of_methods() {
    both("methods", "m");
}

#[test]
fn list_of_methods_narrowed() {
    both("methods_narrowed", "mpredict Down");
}

#[test]
fn command_with_an_error() {
    both("command_error", ":set Space windov Space 9 Enter");
}

#[test]
fn palette_while_an_action_is_typed() {
    both("palette", ":next Down");
}

#[test]
fn palette_with_the_parameters_of_the_method() {
    both("palette_set", ":set Space ma");
}

#[test]
fn jump_with_its_forms_and_an_error() {
    both("jump", "/state:good Enter");
}

#[test]
fn question_before_quitting() {
    both("confirm_quit", "a q");
}

#[test]
fn keys_that_follow_g() {
    both("prefix", "g");
}

#[test]
fn record_after_repair_in_the_second_channel() {
    both("after_repair", "d n z b");
}

#[test]
fn too_small() {
    let bench = Bench::on("demo.csv", UNICODE_DARK).size((39, 9));
    assert_snapshot!(bench.frame());
    // The least size with something to see, and the largest without a residual.
    assert_snapshot!(Bench::on("demo.csv", UNICODE_DARK).size((40, 10)).frame());
    assert_snapshot!(Bench::on("demo.csv", UNICODE_DARK).size((70, 18)).frame());
}

#[test]
fn decimal_commas_and_other_names() {
    assert_snapshot!(Bench::on("descent.csv", UNICODE_DARK).keys("d").frame());
}

#[test]
fn without_colours_and_in_ascii() {
    for (label, size) in [("80x24", (80, 24)), ("120x40", (120, 40))] {
        let bench = Bench::on("demo.csv", ASCII_MONO).size(size);
        assert_snapshot!(format!("ascii_start_{label}"), bench.frame());
        assert_snapshot!(format!("ascii_reviewed_{label}"), bench.keys(REVIEWED).frame());
    }
    for keys in ["", REVIEWED, "m", "?", "a q"] {
        let bench = Bench::on("demo.csv", ASCII_MONO);
        let frame = if keys.is_empty() { bench } else { bench.keys(keys) }.frame();
        let strange: String = frame.chars().filter(|c| !c.is_ascii()).collect();
        assert_eq!(strange, "", "after {keys:?}\n{frame}");
    }
}

#[test]
fn styles_of_a_review() {
    assert_debug_snapshot!(Bench::on("demo.csv", UNICODE_DARK).keys(REVIEWED).buffer());
    assert_debug_snapshot!(Bench::on("demo.csv", ASCII_MONO).keys(REVIEWED).buffer());
}

#[test]
fn the_threshold_that_the_record_suggests() {
    // What the advisor would send for the record, and the key that takes it.
    let mut bench = Bench::on("demo.csv", UNICODE_DARK).size((120, 40));
    let advice = Advise::new(&bench.0, 0).run(&Stop::never()).unwrap();
    let Threshold::Suggested { suggestion, .. } = advice.sweep.threshold else { panic!("no suggestion") };
    update(&mut bench.0, Message::Advised { plan: 0, advice: Box::new(advice) });
    insta::assert_snapshot!("advice_120x40", bench.frame());
    let bench = bench.keys("f");
    let now = bench.0.plan().setup.settings.get("k");
    assert_eq!(now, Some(Value::Real(suggestion)), "f takes the suggestion");
    // It does not depend on the multiplier it is about, and is not asked for again; another order drops it.
    assert!(bench.0.advice().is_some());
    let mut other = Bench::on("demo.csv", UNICODE_DARK);
    let advice = Advise::new(&other.0, 0).run(&Stop::never()).unwrap();
    update(&mut other.0, Message::Advised { plan: 0, advice: Box::new(advice) });
    let other = other.keys("; .");
    assert_eq!(other.0.plan().setup.settings.get("k"), Some(Value::Real(4.0)), "another knob was turned");
    assert!(other.0.advice().is_none(), "the counts of other settings are not shown");
}

#[test]
fn settings_without_a_result_show_none() {
    // `matched` without a rate channel; the list that asks for it is left.
    let bench = Bench::on("demo.csv", UNICODE_DARK).keys("m matched Enter Esc");
    let frame = bench.frame();
    let title = frame.lines().next().unwrap_or_default();
    assert!(title.contains("no result") && !title.contains("flagged"), "{frame}");
    assert!(frame.contains("needs a channel that measures the rate"), "{frame}");
    let back = bench.keys("u");
    assert!(back.frame().contains("74 flagged"), "{}", back.frame());
}

#[test]
fn every_key_after_g_that_decides_is_in_the_footer_at_80_columns() {
    let frame = Bench::on("demo.csv", UNICODE_DARK).keys("g").frame();
    let footer = frame.lines().last().unwrap_or_default();
    for words in ["ga accept all", "gr reject all", "gx clear all", "gn next suspect"] {
        assert!(footer.contains(words), "{words} is not in: {footer}");
    }
}

/// Half a number reads as another number: what the card has no room for, it leaves out whole.
#[test]
fn the_card_cuts_no_number() {
    let numbers = |bench: &Bench| {
        let (width, wide) = (usize::from(bench.0.size.0), bench.0.size.0 >= 110);
        let (columns, rows) = if wide { (width - 38, 5) } else { (width, 2) };
        let frame = bench.frame();
        let card = frame.lines().skip_while(|line| !line.contains("5 flag ")).skip(1).take(rows);
        let text = card.map(|line| line.chars().take(columns).collect::<String>() + " ").collect::<String>();
        let numbers = text.split(|c: char| !c.is_ascii_digit() && c != '.').filter(|word| !word.is_empty());
        numbers.map(str::to_owned).collect::<Vec<_>>()
    };
    // With room, all of them are there in full.
    let mut full = Bench::on("demo.csv", UNICODE_DARK).size((230, 60)).keys(":method Space hampel Enter");
    let sizes = [(60, 16), (64, 24), (72, 24), (80, 24), (109, 24), (110, 30), (113, 30), (120, 40)];
    let mut benches =
        sizes.map(|size| Bench::on("demo.csv", UNICODE_DARK).size(size).keys(":method Space hampel Enter"));
    for _ in 0..70 {
        full = full.keys("n");
        let known = numbers(&full);
        benches = benches.map(|bench| bench.keys("n"));
        for bench in &benches {
            let cut = numbers(bench).into_iter().find(|number| !known.contains(number));
            assert_eq!(cut, None, "{:?}\n{}\n{}", bench.0.size, bench.frame(), full.frame());
        }
    }
}

#[test]
fn when_most_samples_cannot_be_judged_the_screen_says_so() {
    // Too few for the method that is the standard.
    let few = Bench::on("../tests/data/one_truth.csv", UNICODE_DARK);
    assert!(few.frame().contains("100 % are not judged: too few neighbours for this method"), "{}", few.frame());
    assert!(!Bench::on("demo.csv", UNICODE_DARK).frame().contains("not judged"));
}
