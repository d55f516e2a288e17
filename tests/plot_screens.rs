//! Small plots as a person sees them, and the inputs on which common chart widgets draw what is not there
//! (NaN as a spike, infinity as a diagonal, a constant as nothing).

mod plots;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;
use wildpoint::tui::plot::*;
use wildpoint::tui::theme::{ColorDepth, Theme};

use plots::{Record, text};

/// Noise that is the same everywhere: between -1 and 1.
fn noise(i: usize) -> f64 {
    (i as f64 * 12.9898).sin() * 43758.5453 % 1.0
}

/// A wave with noise, a stretch of lost samples and wild points of every state.
fn wave(n: usize, wild: &[(usize, f64, FlagState)]) -> Record {
    let smooth = |i: usize| 50.0 + 20.0 * (i as f64 / n as f64 * 9.0).sin();
    let sample = |i: usize| {
        let step = if i == n * 3 / 5 { n as f64 / 12.0 } else { 1.0 };
        let y = smooth(i) + 1.5 * noise(i);
        match wild.iter().find(|(at, ..)| *at == i) {
            Some(&(_, by, state)) => (step, y + by, Some(state)),
            None => (step, y, None),
        }
    };
    let record = Record::new(&(0..n).map(sample).collect::<Vec<_>>(), 0.0);
    Record { expected: (0..n).map(smooth).collect(), ..record }
}

fn long() -> Record {
    wave(
        4000,
        &[
            (700, 25.0, FlagState::Unreviewed),
            (710, -18.0, FlagState::Unreviewed),
            (1300, 90.0, FlagState::Unreviewed),
            (1700, -22.0, FlagState::Accepted),
            (2100, 15.0, FlagState::Rejected),
            (2900, -30.0, FlagState::ByHand),
            (3200, 9.0, FlagState::Suspect),
        ],
    )
}

/// A trace with rail and time labels over the whole of a record, or part of it.
fn trace(record: &Record, view: Option<View>, fit: YFit, glyphs: Glyphs, cursor: Option<usize>) -> Buffer {
    let theme = Theme::choose(ColorDepth::Indexed256, false);
    let area = Rect::new(0, 0, 80, 15);
    let (plot, rest) = (Rect { height: 13, ..area }, Rect { y: 13, height: 1, ..area });
    let inner = TracePlot::plot_area(plot);
    let view = view.unwrap_or_else(|| View::whole(Axis::Time(&record.t)));
    let columns = &record.with_trace(10.0, |trace| {
        let y = fit.range(trace, view);
        Columns::new(trace, Grid { view, y, width: inner.width, height: inner.height })
    });
    let mut buffer = Buffer::empty(area);
    let theme = &theme;
    let at = cursor.map(|position| Cursor { position, y: record.y[position] });
    TracePlot { columns, theme, glyphs, layers: Layers::ALL, cursor: at, selection: None }.render(plot, &mut buffer);
    FlagRail { columns, theme, glyphs, label: "flags", cursor: None, selection: None }.render(rest, &mut buffer);
    let label = |x: f64| format!("{}:{:02}", x as u32 / 60, x as u32 % 60);
    AxisLabels { view, steps: TickSteps::Clock, phase: 0.0, label_width: 5, label: &label, unit: "min", theme }
        .render(Rect { y: 14, ..rest }, &mut buffer);
    buffer
}

#[test]
fn a_whole_record_with_flags_of_every_state() {
    insta::assert_snapshot!(text(&trace(&long(), None, YFit::Kept, Glyphs::Unicode, Some(1300))));
}

#[test]
fn the_same_in_terminals_with_wide_symbols() {
    insta::assert_snapshot!(text(&trace(&long(), None, YFit::All, Glyphs::Braille, Some(1700))));
}

#[test]
fn the_same_in_ascii() {
    insta::assert_snapshot!(text(&trace(&long(), None, YFit::All, Glyphs::Ascii, Some(1700))));
}

#[test]
fn a_few_samples_joined_by_lines_that_break_at_lost_samples() {
    let mut record = wave(60, &[(12, 9.0, FlagState::Unreviewed), (45, -12.0, FlagState::Accepted)]);
    let view = View { from: 4.5, to: 68.0 };
    record.t.iter_mut().skip(37).for_each(|t| *t += 12.0);
    insta::assert_snapshot!(text(&trace(&record, Some(view), YFit::Kept, Glyphs::Unicode, None)));
}

#[test]
fn so_many_flags_that_dots_replace_markers() {
    let state = |i: usize| if i.is_multiple_of(3) { FlagState::Accepted } else { FlagState::Unreviewed };
    let wild: Vec<_> = (0..400).map(|i| (i * 10, 30.0 * noise(i * 7).signum() + 8.0 * noise(i), state(i))).collect();
    insta::assert_snapshot!(text(&trace(&wave(4000, &wild), None, YFit::All, Glyphs::Unicode, None)));
}

fn residual(record: &Record, view: View, glyphs: Glyphs) -> Buffer {
    let theme = &Theme::mono();
    let area = Rect::new(0, 0, 80, 9);
    let width = TracePlot::plot_area(area).width;
    let grid = Grid { view, y: (0.0, 1.0), width, height: 9 };
    let columns = &record.with_trace(10.0, |trace| Columns::new(trace, grid));
    // The tolerance is 4; nothing can be judged in a part of the record.
    let n = record.y.len();
    let unjudged = n * 2 / 5..n / 2;
    let ratio = |i: usize| (!unjudged.contains(&i)).then(|| (record.y[i] - record.expected[i]) / 4.0);
    let pyramid = ResidualPlot::pyramid(n, ratio);
    let mut buffer = Buffer::empty(area);
    ResidualPlot {
        columns,
        ratio: &ratio,
        pyramid: &pyramid,
        threshold: 1.0,
        top: 3.0,
        log: false,
        theme,
        glyphs,
        cursor: None,
    }
    .render(area, &mut buffer);
    buffer
}

#[test]
fn the_worst_residual_of_each_column() {
    let record = long();
    let view = View::whole(Axis::Time(&record.t));
    insta::assert_snapshot!(text(&residual(&record, view, Glyphs::Unicode)));
    insta::assert_snapshot!(text(&residual(&record, view, Glyphs::Ascii)));
}

#[test]
fn residuals_with_their_signs() {
    let view = View { from: 1200.0, to: 1400.0 };
    insta::assert_snapshot!(text(&residual(&long(), view, Glyphs::Unicode)));
}

#[test]
fn the_overview_with_the_part_that_is_in_view() {
    let record = long();
    let theme = &Theme::mono();
    let area = Rect::new(0, 0, 80, 3);
    let view = View::whole(Axis::Time(&record.t));
    let columns = &record.with_trace(10.0, |trace| {
        let y = YFit::Kept.range(trace, view);
        Columns::new(trace, Grid { view, y, width: 72, height: 2 })
    });
    let mut buffer = Buffer::empty(area);
    let viewport = View { from: 1000.0, to: 1500.0 };
    Overview { columns, viewport, theme, glyphs: Glyphs::Unicode }.render(area, &mut buffer);
    insta::assert_snapshot!(text(&buffer));
}
