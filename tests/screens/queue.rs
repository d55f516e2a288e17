//! The queue beside a parameter that turns: what is in sight stays where it is.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use wildpoint::tui::message::{Effect, Message};
use wildpoint::tui::update::update;

use super::workbench::{Bench, UNICODE_DARK};

/// The rows of the queue's panel at 120x40: the row of the sample and its mark.
fn rows(bench: &Bench) -> Vec<String> {
    let frame = bench.frame();
    let lines = frame.lines().skip_while(|line| !line.contains("sigma") || !line.contains("time")).skip(1);
    let panel = |line: &str| line.chars().skip(82).collect::<String>();
    let cells = |panel: String| {
        let cells: Vec<&str> = panel.trim_start_matches(['>', ' ']).split_whitespace().collect();
        (cells.len() == 4).then(|| format!("{} {}", cells[0], cells[3]))
    };
    lines.map(panel).map_while(cells).collect()
}

#[test]
fn a_flag_that_a_knob_takes_away_keeps_its_row_until_the_cursor_moves_on() {
    let bench = Bench::on("demo.csv", UNICODE_DARK)
        .size((120, 40))
        .keys(":set Space floor Space auto Enter :set Space k Space 4 Enter")
        .keys("np");
    let before = rows(&bench);
    assert_eq!(before[..5], ["61 ●", "91 ●", "200 ●", "222 ●", "239 ●"]);
    assert_eq!(before[5], "323 ●", "276 is a suspect from k = 3.9 down: {before:?}");
    let bench = bench.keys(",");
    let down = rows(&bench);
    assert_eq!(down[4..7], ["239 ●", "276 ~", "323 ●"]);
    // Back again the rows are where they were, and the one that went has no mark.
    let bench = bench.keys(".");
    let up = rows(&bench);
    assert_eq!(up[4..7], ["239 ●", "276 ·", "323 ●"]);
    let of = |rows: &[String]| rows.iter().map(|row| row.split(' ').next().map(str::to_owned)).collect::<Vec<_>>();
    assert_eq!(of(&up)[..down.len() - 1], of(&down)[..down.len() - 1]);
    // A step down brings it back into its row.
    let bench = bench.keys(",");
    assert_eq!(rows(&bench)[..down.len() - 1], down[..down.len() - 1]);
    // The cursor passes it by, and then it is no longer there.
    let bench = bench.keys(".n");
    assert!(rows(&bench).contains(&"91 ●".to_owned()));
    assert!(!of(&rows(&bench)).contains(&Some("276".to_owned())));
}

#[test]
fn when_much_goes_at_once_the_flags_that_are_left_take_the_rows() {
    let bench = Bench::on("demo.csv", UNICODE_DARK).size((120, 40)).keys(":set Space k Space 60 Enter");
    let rows = rows(&bench);
    assert!(rows.len() > 5 && !rows.iter().any(|row| row.ends_with('·')), "{rows:?}");
}

#[test]
fn a_row_that_is_gone_can_be_clicked_and_stays_under_the_cursor() {
    let bench = Bench::on("demo.csv", UNICODE_DARK)
        .size((120, 40))
        .keys(":set Space floor Space auto Enter :set Space k Space 4 Enter");
    let mut bench = bench.keys(",").keys(".");
    let at = bench.frame().lines().position(|line| line.contains("276   276.0")).unwrap();
    assert!(rows(&bench).contains(&"276 ·".to_owned()));
    bench.0.mouse = true;
    let place = |kind| MouseEvent { kind, column: 100, row: at as u16, modifiers: KeyModifiers::NONE };
    for kind in [MouseEventKind::Down(MouseButton::Left), MouseEventKind::Up(MouseButton::Left)] {
        update(&mut bench.0, Message::Mouse(place(kind)));
    }
    let frame = bench.frame();
    let line = frame.lines().nth(at).unwrap();
    assert!(line.contains(">  276   276.0") && line.contains('·'), "{frame}");
}

#[test]
fn drawing_the_screen_again_leaves_lists_and_prompts_as_they_are() {
    let mut bench = Bench::on("demo.csv", UNICODE_DARK).keys("m Down Down");
    let before = bench.frame();
    let redraw = Message::Key(KeyEvent::new(KeyCode::Char('l'), KeyModifiers::CONTROL));
    assert!(matches!(update(&mut bench.0, redraw)[..], [Effect::Redraw]));
    assert_eq!(bench.frame(), before);
}

#[test]
fn of_a_long_path_in_a_prompt_the_end_is_seen_where_one_types() {
    let bench = Bench::on("demo.csv", UNICODE_DARK).keys(":w Space").keys(&"/folder".repeat(20)).keys("XYZ");
    let frame = bench.frame();
    let line = frame.lines().find(|line| line.contains("XYZ")).unwrap_or_else(|| panic!("{frame}"));
    assert!(line.starts_with(":…") && line.trim_end().ends_with("/folderXYZ"), "{line}");
}
