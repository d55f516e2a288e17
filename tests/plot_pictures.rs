//! What the histogram and the picture of step sizes promise, on random records, views and sizes.

use proptest::prelude::*;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;
use wildpoint::plot::{Histogram, Steps};
use wildpoint::stop::Stop;
use wildpoint::track::Series;
use wildpoint::tui::plot::*;
use wildpoint::tui::theme::{ColorDepth, Theme};

fn glyphs() -> impl Strategy<Value = Glyphs> {
    prop::sample::select(vec![Glyphs::Unicode, Glyphs::Braille, Glyphs::Ascii])
}

fn theme() -> Theme {
    Theme::choose(ColorDepth::Indexed256, false)
}

/// Rows of a buffer of characters that nobody draws, with the part that is drawn on in the middle.
fn canvas(width: u16, height: u16) -> (Buffer, Rect) {
    let whole = Rect::new(0, 0, width + 4, height + 2);
    let mut cell = ratatui::buffer::Cell::default();
    cell.set_char('?');
    (Buffer::filled(whole, cell), Rect::new(2, 1, width, height))
}

fn outside_is_untouched(buffer: &Buffer, area: Rect) -> bool {
    buffer.area().positions().all(|at| area.contains(at) || buffer[at].symbol() == "?")
}

fn is_drawn_as(
    buffer: &Buffer,
    column: u16,
    rows: std::ops::Range<u16>,
    is: impl Fn(&ratatui::buffer::Cell) -> bool,
) -> bool {
    rows.into_iter().any(|row| is(&buffer[(column, row)]))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn a_flagged_residual_is_never_hidden_in_the_histogram(
        samples in prop::collection::vec((prop_oneof![4 => -3.0..3.0_f64, 1 => -40.0..40.0_f64], prop::bool::weighted(0.1)), 0..300),
        (width, height) in (0_u16..130, 0_u16..30), glyphs in glyphs(), log in prop::bool::ANY, threshold in 0.1..9.0_f64,
    ) {
        let flagged: Vec<bool> = samples.iter().map(|s| s.1).collect();
        let histogram = &Histogram::new(10.0, |i| Some(samples[i].0), &flagged, &Stop::never()).expect("nobody stops it");
        let (mut buffer, area) = canvas(width, height);
        let theme = &theme();
        HistogramPlot { histogram, threshold, log, cursor: Some(1.0), theme, glyphs }.render(area, &mut buffer);
        prop_assert!(outside_is_untouched(&buffer, area));
        if width <= GUTTER || height < 2 {
            return Ok(());
        }
        let plot = area.width - GUTTER;
        for (residual, flagged) in samples {
            let column = histogram.column_of(residual, plot).unwrap_or(if residual < 0.0 { 0 } else { plot - 1 });
            let at = area.x + GUTTER + column;
            let rows = area.top()..area.bottom() - u16::from(height >= 3);
            let lit = is_drawn_as(&buffer, at, rows.clone(), |cell| cell.symbol() != " ");
            prop_assert!(lit, "{residual} shows nothing");
            let red = is_drawn_as(&buffer, at, rows, |cell| cell.symbol() != " " && Some(cell.fg) == theme.over.fg);
            prop_assert!(!flagged || red, "{residual} is flagged and does not look like it");
        }
        let ascii = glyphs != Glyphs::Ascii || area.positions().all(|at| buffer[at].symbol().is_ascii());
        prop_assert!(ascii);
    }

    #[test]
    fn a_lost_sample_is_never_hidden_in_the_steps(
        rows in prop::collection::vec((prop_oneof![20 => Just(1.0), 2 => 0.2..1.4_f64, 2 => 1.5..90.0_f64], prop::bool::weighted(0.05)), 0..300),
        (width, height) in (0_u16..130, 0_u16..20), glyphs in glyphs(), (a, b) in (0.0..1.0_f64, 0.0..1.0_f64),
        by_number in prop::bool::ANY, max_gap in prop_oneof![Just(None), (1_usize..40).prop_map(Some)],
    ) {
        let mut now = 0.0;
        let seconds: Vec<f64> = rows.iter().map(|(step, bad)| { now += step; if *bad { f64::NAN } else { now } }).collect();
        let y = vec![0.0; seconds.len()];
        let series = Series::new(&seconds, &y);
        let steps = Steps::of(&series, &seconds);
        let axis = if by_number { Axis::Position(&series.t) } else { Axis::Time(&series.t) };
        let whole = View::whole(axis);
        let view = View { from: whole.from + whole.width() * a.min(b), to: whole.from + whole.width() * a.max(b) };
        let pyramid = Pyramid::build(&series.y, |_| false);
        let span = |i: usize| series.y.get(i).copied().map_or(Span::EMPTY, Span::at);
        let (kept, flags) = (Curve { pyramid: &pyramid, span: &span }, &Flags::default());
        let trace = Trace { axis, kept, flags, expected: None, band: None, repaired: None, filtered: None, gap: 9.0 };
        let plot = width.saturating_sub(GUTTER);
        let columns = &Columns::new(&trace, Grid { view, y: (0.0, 1.0), width: plot, height: 1 });
        let found = steps.columns(columns, &series, max_gap);
        let (mut buffer, area) = canvas(width, height);
        let (theme, interval) = (&theme(), series.interval);
        StepPlot { steps: &found, columns, interval, theme, glyphs, cursor: Some(3) }.render(area, &mut buffer);
        prop_assert!(outside_is_untouched(&buffer, area));
        if plot == 0 || height < 2 {
            return Ok(());
        }
        let shows = |position: usize, glyph: char| {
            let column = columns.column_of(position)?;
            let at = area.x + GUTTER + column;
            Some(is_drawn_as(&buffer, at, area.top()..area.bottom(), |cell| cell.symbol() == glyph.to_string()))
        };
        for i in 1..series.len() {
            let step = series.t[i] - series.t[i - 1];
            // By plain arithmetic, away from the tie.
            if step > 1.5001 * interval {
                prop_assert_ne!(shows(i, glyphs.lost()), Some(false), "the step of {} before {}", step, i);
            }
            let bad = (series.row(i - 1) + 1..series.row(i)).any(|row| seconds[row].is_nan());
            prop_assert!(!bad || shows(i, '!') != Some(false), "rows without a time before {}", i);
        }
        let dark = glyphs != Glyphs::Ascii || area.positions().all(|at| buffer[at].symbol().is_ascii());
        prop_assert!(dark);
    }
}
