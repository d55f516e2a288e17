//! Inputs on which common chart widgets draw what is not there (NaN as a spike, infinity as a diagonal, a constant
//! as nothing), and what backgrounds, cursor and layers do to cells.

mod plots;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier};
use ratatui::widgets::Widget;
use wildpoint::tui::plot::*;
use wildpoint::tui::theme::{ColorDepth, Theme};

use plots::{Record, text};

const WIDTH: u16 = 40;
const HEIGHT: u16 = 6;

/// The raw curve of some samples, one second apart, without its margin.
fn curve(y: &[f64], range: (f64, f64)) -> String {
    let t: Vec<f64> = (0..y.len()).map(|i| i as f64).collect();
    curve_at(Axis::Time(&t), y, View::whole(Axis::Time(&t)), range)
}

fn curve_at(axis: Axis<'_>, y: &[f64], view: View, range: (f64, f64)) -> String {
    let pyramid = Pyramid::build(y, |_| false);
    let span = |i: usize| Span::at(y[i]);
    let kept = Curve { pyramid: &pyramid, span: &span };
    let (flags, gap) = (Flags::default(), f64::INFINITY);
    let trace = Trace { axis, kept, flags: &flags, expected: None, band: None, repaired: None, filtered: None, gap };
    let columns = Columns::new(&trace, Grid { view, y: range, width: WIDTH, height: HEIGHT });
    let mut buffer = Buffer::empty(Rect::new(0, 0, WIDTH + GUTTER, HEIGHT));
    plot(&columns, &Theme::mono()).render(buffer.area, &mut buffer);
    let strip = |line: &str| line.chars().skip(usize::from(GUTTER)).chain(['\n']).collect::<String>();
    text(&buffer).lines().map(strip).collect()
}

fn plot<'a>(columns: &'a Columns, theme: &'a Theme) -> TracePlot<'a> {
    TracePlot { columns, theme, glyphs: Glyphs::Unicode, layers: Layers::ALL, cursor: None, selection: None }
}

/// How many cells of each row are not blank.
fn ink(picture: &str) -> Vec<usize> {
    picture.lines().map(|line| line.chars().filter(|c| *c != ' ').count()).collect()
}

#[test]
fn a_value_that_is_no_number_draws_nothing() {
    let flat = [1.0; 400];
    let mut holed = flat;
    holed.iter_mut().step_by(7).for_each(|y| *y = f64::NAN);
    assert_eq!(curve(&holed, (0.0, 2.0)), curve(&flat, (0.0, 2.0)));
    assert_eq!(ink(&curve(&[f64::NAN; 400], (0.0, 2.0))), [0; 6]);
    // Few samples, joined by lines: the line goes on from the sample before to the one after.
    let few = curve(&[1.0, f64::NAN, 1.0, 1.0], (0.0, 2.0));
    assert_eq!(ink(&few), [0, 0, 0, 40, 0, 0], "{few}");
}

#[test]
fn one_infinite_sample_is_a_spike_in_its_column_and_no_diagonal() {
    for value in [f64::INFINITY, 1e300, f64::MAX] {
        let mut y = [1.0; 400];
        y[200] = value;
        let picture = curve(&y, (0.0, 2.0));
        let ink = ink(&picture);
        // The flat line lies in row 3; above it is the spike alone, over the column of its sample and the next.
        assert!(ink[..3].iter().all(|n| (1..=2).contains(n)), "{value}:\n{picture}");
        assert_eq!(ink[3..], [40, 0, 0], "{value}:\n{picture}");
    }
}

#[test]
fn a_constant_is_a_line_whatever_its_range() {
    for (value, range) in [(5.0, (5.0, 5.0)), (0.0, (0.0, 0.0)), (-3e9, (-3e9, -3e9)), (1e308, (1e308, 1e308))] {
        let picture = curve(&[value; 50], range);
        assert_eq!(ink(&picture).iter().sum::<usize>(), 40, "{value}:\n{picture}");
    }
}

#[test]
fn a_range_that_is_no_number_piles_up_nothing() {
    for range in [(f64::NAN, 1.0), (f64::NEG_INFINITY, f64::INFINITY), (2.0, 0.0)] {
        let picture = curve(&[0.5; 50], range);
        let ink = ink(&picture);
        assert_eq!((ink[0], ink.iter().sum::<usize>()), (0, 40), "{range:?}:\n{picture}");
    }
}

#[test]
fn nanoseconds_since_1970_and_views_of_nothing_are_no_trouble() {
    // 256 is the distance of neighbouring doubles there.
    let t: Vec<f64> = (0..40).map(|i| 1.7e18 + f64::from(i) * 256.0).collect();
    let y: Vec<f64> = (0..40).map(f64::from).collect();
    let picture = curve_at(Axis::Time(&t), &y, View::whole(Axis::Time(&t)), (0.0, 40.0));
    let first: Vec<Option<usize>> = picture.lines().map(|line| line.find(|c| c != ' ')).collect();
    assert!(ink(&picture).iter().all(|n| *n > 5) && first.is_sorted_by(|a, b| a > b), "{picture}");
    for view in [View { from: 1.0, to: 1.0 }, View { from: 9.0, to: 1.0 }, View { from: f64::NAN, to: 3.0 }] {
        assert_eq!(ink(&curve_at(Axis::Position(&t), &y, view, (0.0, 40.0))), [0; 6]);
    }
}

#[test]
fn a_curve_off_the_scale_is_marked_at_the_edge() {
    assert_eq!(curve(&[5.0; 400], (0.0, 2.0)).lines().next(), Some("▲".repeat(40).as_str()));
    assert_eq!(curve(&[-5.0; 400], (0.0, 2.0)).lines().last(), Some("▼".repeat(40).as_str()));
}

#[test]
fn lines_come_from_samples_out_of_view_and_go_to_them() {
    let t = [0.0, 45.0, 55.0, 100.0];
    let picture = curve_at(Axis::Time(&t), &[0.0, 1.0, 1.0, 0.0], View { from: 30.0, to: 70.0 }, (0.0, 2.0));
    // From 30 to 45 the line climbs from 2/3 to 1, of 2; from 55 to 70 it falls as much: from the edge of the fifth
    // row to that of the fourth, in every column.
    let inked = |row: usize, column: usize| {
        picture.lines().nth(row).and_then(|line| line.chars().nth(column)).is_some_and(|c| c != ' ')
    };
    assert!((0..40).all(|column| inked(3, column) || inked(4, column)), "{picture}");
    assert!([0, 39].iter().all(|column| inked(4, *column)) && (3..37).all(|c| !inked(4, c)), "{picture}");
}

#[test]
fn the_robust_range_leaves_out_one_sample_in_a_thousand_at_either_end() {
    let y: Vec<f64> = (0..=10_000).map(f64::from).collect();
    let pyramid = Pyramid::build(&y, |_| false);
    let (span, flags) = (|i: usize| Span::at(y[i]), Flags::default());
    let (axis, kept) = (Axis::Position(&y), Curve { pyramid: &pyramid, span: &span });
    let trace =
        Trace { axis, kept, flags: &flags, expected: None, band: None, repaired: None, filtered: None, gap: 1.5 };
    // Quantiles at 10 and 9990, with 4 % of room; the others with the ends of the record.
    let close = |(a, b): (f64, f64), (c, d): (f64, f64)| (a - c).abs() < 1e-6 && (b - d).abs() < 1e-6;
    assert!(close(YFit::Robust.range(&trace, View::whole(axis)), (10.0 - 399.2, 9990.0 + 399.2)));
    assert!(close(YFit::Kept.range(&trace, View::whole(axis)), (-400.0, 10_400.0)));
    assert!(close(YFit::Kept.range(&trace, View { from: 100.0, to: 200.0 }), (96.0, 204.0)));
}

#[test]
fn a_bar_of_the_overview_does_not_hide_a_flag() {
    let (record, theme) = (gapped(), Theme::mono());
    let columns = gapped_columns(&record);
    let area = Rect::new(0, 0, WIDTH + GUTTER, HEIGHT + 1);
    let mut buffer = Buffer::empty(area);
    let overview =
        Overview { columns: &columns, viewport: View { from: 5.0, to: 20.5 }, theme: &theme, glyphs: Glyphs::Unicode };
    assert_eq!(overview.bars(), Some((5, 20)));
    overview.render(area, &mut buffer);
    let bars: Vec<u16> = (0..WIDTH).filter(|c| buffer[(GUTTER + c, 0)].symbol() == "┃").collect();
    assert_eq!(bars, [5, 20]);
    let cell = &buffer[(GUTTER + 5, 3)];
    assert!(cell.symbol() != "┃" && cell.modifier.contains(Modifier::BOLD | Modifier::REVERSED), "{cell:?}");
}

/// Samples at 0 to 9 s and 30 to 39 s; the one at 5 s is flagged.
fn gapped() -> Record {
    let step = |i: usize| if i == 10 { 21.0 } else { 1.0 };
    let sample = |i: usize| (step(i), 1.0, (i == 5).then_some(FlagState::Unreviewed));
    let mut record = Record::new(&(0..20).map(sample).collect::<Vec<_>>(), 0.0);
    record.t.iter_mut().for_each(|t| *t -= 1.0);
    record
}

fn gapped_columns(record: &Record) -> Columns {
    let grid = Grid { view: View { from: 0.0, to: 40.0 }, y: (0.0, 2.0), width: WIDTH, height: HEIGHT };
    record.with_trace(2.0, |trace| Columns::new(trace, grid))
}

fn styled(plot: TracePlot<'_>) -> Buffer {
    let mut buffer = Buffer::empty(Rect::new(0, 0, WIDTH + GUTTER, HEIGHT));
    plot.render(buffer.area, &mut buffer);
    buffer
}

#[test]
fn lost_samples_break_the_line_and_show_as_background() {
    let (record, theme) = (gapped(), Theme::choose(ColorDepth::Indexed256, false));
    let columns = gapped_columns(&record);
    let buffer = styled(plot(&columns, &theme));
    assert!(theme.gap.bg.is_some());
    for column in 0..WIDTH {
        let cells = (0..HEIGHT).map(|row| &buffer[(GUTTER + column, row)]);
        let lost = (10..30).contains(&column);
        for cell in cells {
            assert_eq!(Some(cell.bg) == theme.gap.bg, lost, "column {column}");
            assert!(!lost || cell.symbol() == " ", "column {column} has {:?}", cell.symbol());
        }
    }
}

#[test]
fn the_cursor_reverses_its_cell_and_keeps_the_flag() {
    let (record, theme) = (gapped(), Theme::choose(ColorDepth::Indexed256, false));
    let columns = gapped_columns(&record);
    let buffer = styled(TracePlot { cursor: Some(Cursor { position: 5, y: 1.0 }), ..plot(&columns, &theme) });
    let cell = &buffer[(GUTTER + 5, 3)];
    assert_eq!((cell.symbol(), Some(cell.fg)), ("●", theme.flag_unreviewed.fg));
    let reversed = buffer.content().iter().filter(|c| c.modifier.contains(Modifier::REVERSED)).count();
    assert_eq!((reversed, cell.modifier.contains(Modifier::REVERSED)), (1, true));
    assert_eq!(buffer[(GUTTER + 5, 0)].symbol(), "│");
}

#[test]
fn a_selection_marks_its_columns_and_those_between() {
    let (record, theme) = (gapped(), Theme::choose(ColorDepth::Indexed256, false));
    let columns = gapped_columns(&record);
    let buffer = styled(TracePlot { selection: Some(8..12), ..plot(&columns, &theme) });
    let marked: Vec<u16> =
        (0..WIDTH).filter(|c| buffer[(GUTTER + c, 5)].bg == theme.selection.bg.unwrap_or_default()).collect();
    assert_eq!(marked, (8..32).collect::<Vec<_>>());
}

#[test]
fn layers_can_be_switched_off_but_flags_cannot() {
    let (record, theme) = (gapped(), Theme::mono());
    let columns = gapped_columns(&record);
    let none = Layers { raw: false, expected: false, band: false, repaired: false, filtered: false };
    let buffer = styled(TracePlot { layers: none, ..plot(&columns, &theme) });
    let strip = |line: &str| line.chars().skip(usize::from(GUTTER)).collect::<String>();
    let inked: String = text(&buffer).lines().map(strip).collect::<String>().replace(' ', "");
    assert_eq!(inked, "●");
}

#[test]
fn clicks_between_samples_go_to_the_nearest() {
    let record = gapped();
    let (columns, axis) = (gapped_columns(&record), Axis::Time(&record.t));
    let at = |column: u16| columns.position_at(axis, column);
    assert_eq!([0, 9, 15, 25, 30, 39].map(at), [0, 9, 9, 10, 10, 19].map(Some));
    assert_eq!((at(40), columns.column_of(5), columns.column_of(20)), (None, Some(5), None));
    assert_eq!((columns.flag_at(&record.index, 5, 3), columns.flag_at(&record.index, 5, 2)), (Some(5), None));
}

#[test]
fn classes_differ_without_colours_and_the_plain_theme_has_none() {
    let mono = Theme::choose(ColorDepth::Never, false);
    let color = |style: ratatui::style::Style| style.fg.or(style.bg);
    let plain = [mono.raw, mono.expected, mono.band, mono.repaired, mono.gap, mono.selection, mono.cursor, mono.error];
    assert!(plain.into_iter().chain(FlagState::ALL.map(|s| mono.flag(s))).all(|style| color(style).is_none()));
    for (a, state) in FlagState::ALL.iter().enumerate() {
        for other in &FlagState::ALL[a + 1..] {
            assert_ne!(mono.flag(*state), mono.flag(*other));
        }
        assert_ne!(mono.flag(*state), mono.raw);
    }
    for depth in [ColorDepth::Ansi16, ColorDepth::Indexed256, ColorDepth::True] {
        for light in [false, true] {
            let theme = Theme::choose(depth, light);
            assert!([theme.text, theme.raw].iter().all(|style| color(*style).is_none_or(|c| c == Color::Reset)));
            let mut colors: Vec<_> = FlagState::ALL.iter().map(|s| theme.flag(*s).fg).collect();
            colors.dedup();
            assert_eq!(colors.len(), 5);
        }
    }
}
