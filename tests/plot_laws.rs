//! What the plots promise (`tui::plot`), on random records, views and sizes. Each promise is checked against the
//! plain samples, without the pyramids.

mod plots;

use proptest::prelude::*;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;
use wildpoint::tui::plot::*;
use wildpoint::tui::theme::{ColorDepth, Theme};

use plots::{Record, dot_lit, is_hidden};

/// A record, a view, a y range and a size.
#[derive(Debug, Clone)]
struct Case {
    record: Record,
    grid: Grid,
    fit: YFit,
    glyphs: Glyphs,
}

fn value() -> impl Strategy<Value = f64> {
    prop_oneof![8 => -1.0..1.0_f64, 2 => -30.0..30.0_f64, 1 => Just(0.0)]
}

fn hostile_value() -> impl Strategy<Value = f64> {
    let edge = [0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e308, -1e308, 5e-324, 1e7, 1.7e18];
    prop_oneof![3 => -1e3..1e3_f64, 1 => prop::sample::select(edge.to_vec())]
}

fn states() -> impl Strategy<Value = Option<FlagState>> {
    let some = prop::sample::select(FlagState::ALL.to_vec()).prop_map(Some);
    prop_oneof![6 => Just(None), 1 => some]
}

fn glyphs() -> impl Strategy<Value = Glyphs> {
    prop::sample::select(vec![Glyphs::Unicode, Glyphs::Braille, Glyphs::Ascii])
}

fn fit() -> impl Strategy<Value = YFit> {
    prop_oneof![
        3 => Just(YFit::Kept),
        1 => Just(YFit::All),
        1 => Just(YFit::Robust),
        1 => (-2.0..2.0_f64, -2.0..2.0_f64).prop_map(|(a, b)| YFit::Fixed(a, b)),
    ]
}

fn case() -> impl Strategy<Value = Case> {
    let step = prop_oneof![30 => Just(1.0), 2 => 0.1..2.0_f64, 1 => 2.0..60.0_f64];
    let sample = (step, value(), states()).boxed();
    let few = prop::collection::vec(sample.clone(), 0..40);
    // Flags enough to fill columns, on both sides of the curve: what is skipped for speed must not be missed.
    let side = prop_oneof![5.0..30.0_f64, -30.0..-5.0_f64];
    let flagged = prop::sample::select(vec![Some(FlagState::Unreviewed), Some(FlagState::Rejected)]);
    let wild = (Just(1.0), prop_oneof![4 => side, 1 => -5.0..5.0], flagged).boxed();
    let many = prop::collection::vec(prop_oneof![1 => sample.clone(), 2 => wild], 500..3000);
    let samples = prop_oneof![few, prop::collection::vec(sample, 0..3000), many];
    let view = (0.0..1.0_f64, 0.0..1.0_f64, prop::bool::ANY);
    (
        samples,
        prop_oneof![Just(0.0), Just(6.4e6), Just(-1e7)],
        view,
        (prop_oneof![1_u16..8, 1_u16..100], 1_u16..30),
        fit(),
        glyphs(),
    )
        .prop_map(|(samples, offset, (a, b, whole), (width, height), fit, glyphs): (Vec<_>, _, _, _, _, _)| {
            let record = Record::new(samples.as_slice(), offset);
            let all = View::whole(Axis::Time(&record.t));
            let at = |share: f64| all.from + (all.to - all.from) * share;
            let view = if whole || a == b { all } else { View { from: at(a.min(b)), to: at(a.max(b)) } };
            let y = record.with_trace(5.0, |trace| fit.range(trace, view));
            Case { record, grid: Grid { view, y, width, height }, fit, glyphs }
        })
}

fn drawn(case: &Case) -> (Columns, Buffer) {
    let theme = Theme::choose(ColorDepth::Indexed256, false);
    let columns = case.record.with_trace(5.0, |trace| Columns::new(trace, case.grid));
    let area = Rect::new(0, 0, case.grid.width + GUTTER, case.grid.height + 1);
    let mut buffer = Buffer::empty(area);
    let (plot, rail) = plots::split(area);
    let (columns_ref, glyphs) = (&columns, case.glyphs);
    TracePlot { columns: columns_ref, theme: &theme, glyphs, layers: Layers::ALL, cursor: None, selection: None }
        .render(plot, &mut buffer);
    FlagRail { columns: columns_ref, theme: &theme, glyphs, label: "flags", cursor: None, selection: None }
        .render(rail, &mut buffer);
    (columns, buffer)
}

/// The column of cells of an x by plain arithmetic, and whether it is so near an edge that rounding may decide.
fn plain_column(grid: &Grid, x: f64) -> (u16, bool) {
    let share = (x - grid.view.from) / (grid.view.to - grid.view.from) * f64::from(grid.width) * 2.0;
    let near_edge = (share - share.round()).abs() < 1e-6;
    (((share / 2.0).floor() as u16).min(grid.width - 1), near_edge)
}

fn is_flag_style(style: ratatui::style::Style) -> bool {
    let theme = Theme::choose(ColorDepth::Indexed256, false);
    FlagState::ALL.iter().any(|state| theme.flag(*state).fg == style.fg)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn every_flag_in_view_is_on_the_rail_and_in_its_cell(case in case()) {
        let (columns, buffer) = drawn(&case);
        let (grid, scale) = (case.grid, columns.scale());
        for flag in &case.record.flags {
            let x = case.record.t[flag.position as usize];
            if x < grid.view.from || x > grid.view.to {
                prop_assert_eq!(columns.column_of(flag.position as usize), None);
                continue;
            }
            let column = columns.column_of(flag.position as usize);
            let (plain, near_edge) = plain_column(&grid, x);
            prop_assert!(column.is_some(), "flag {:?} has no column", flag);
            let column = column.unwrap_or(0);
            prop_assert!(column == plain || near_edge, "flag {:?}: column {}, expected {}", flag, column, plain);
            // (i) the rail
            let rail = &buffer[(GUTTER + column, grid.height)];
            prop_assert!(rail.symbol() != case.glyphs.rail(0).to_string(), "{:?} missing on the rail", flag);
            prop_assert!(columns.summary(column).counts[flag.state.index()] > 0);
            // (ii) its cell, or the arrow
            let row = scale.row(flag.y).unwrap_or(if flag.y > scale.high() { 0 } else { grid.height - 1 });
            let cell = &buffer[(GUTTER + column, row)];
            prop_assert!(is_flag_style(cell.style()) && cell.symbol() != " ", "{:?} is hidden", flag);
            if scale.row(flag.y).is_none() {
                let above = flag.y > scale.high();
                let arrows = [case.glyphs.beyond(above, !above), case.glyphs.beyond(true, true)];
                prop_assert!(arrows.iter().any(|arrow| cell.symbol() == arrow.to_string()), "{:?} without an arrow", flag);
            }
            // (vii) back from the cell and from the rail
            let found = columns.flag_at(&case.record.index, column, row);
            let found = found.and_then(|at| case.record.flags.iter().find(|f| f.position as usize == at));
            prop_assert!(found.is_some_and(|f| columns.column_of(f.position as usize) == Some(column)));
            prop_assert!(columns.flag_in(&case.record.index, column).is_some());
        }
        let in_view = |f: &&Flag| (grid.view.from..=grid.view.to).contains(&case.record.t[f.position as usize]);
        let counted: u32 = (0..grid.width).map(|c| columns.summary(c).counts.iter().sum::<u32>()).sum();
        prop_assert_eq!(counted as usize, case.record.flags.iter().filter(in_view).count());
    }

    #[test]
    fn every_kept_sample_in_range_has_its_dot_or_a_flag_in_its_cell(case in case()) {
        let (columns, buffer) = drawn(&case);
        let grid = case.grid;
        for (i, (&x, &y)) in case.record.t.iter().zip(&case.record.y).enumerate() {
            let (column, near_edge) = plain_column(&grid, x);
            let row = columns.scale().row(y);
            if is_hidden(&case.record, i) || x < grid.view.from || x > grid.view.to || row.is_none() || near_edge {
                continue;
            }
            let cell = &buffer[(GUTTER + column, row.unwrap_or(0))];
            let lit = dot_lit(case.glyphs, cell.symbol(), &grid, x, y);
            prop_assert!(lit || is_flag_style(cell.style()), "sample {} ({}, {}) has no dot: {:?}", i, x, y, cell);
            // (vii) a click on the cell leads to a kept sample drawn in it.
            let found = case.record.with_trace(5.0, |trace| columns.sample_at(trace, column, row.unwrap_or(0)));
            let found = found.map(|at| (columns.column_of(at), columns.scale().row(case.record.y[at])));
            prop_assert_eq!(found, Some((Some(column), row)));
        }
    }

    #[test]
    fn a_cell_without_flags_never_looks_like_one(case in case()) {
        let (columns, buffer) = drawn(&case);
        let grid = case.grid;
        let theme = Theme::choose(ColorDepth::Indexed256, false);
        for column in 0..grid.width {
            let flags = || case.record.flags.iter().filter(|f| columns.column_of(f.position as usize) == Some(column));
            for row in 0..grid.height {
                let cell = &buffer[(GUTTER + column, row)];
                if cell.style().fg == theme.flag_unreviewed.fg {
                    let edge = |f: &Flag| columns.scale().row(f.y).is_none() && (row == 0 || row + 1 == grid.height);
                    let here = |f: &Flag| columns.scale().row(f.y) == Some(row) || edge(f);
                    prop_assert!(flags().any(|f| f.state == FlagState::Unreviewed && here(f)));
                }
            }
        }
    }

    #[test]
    fn drawing_is_pure_and_ascii_is_ascii(case in case()) {
        let case = Case { glyphs: Glyphs::Ascii, ..case };
        let (columns, buffer) = drawn(&case);
        let again = drawn(&case);
        prop_assert_eq!((&columns, &buffer), (&again.0, &again.1));
        let area = *buffer.area();
        plots::all_widgets(&case.record, case.grid, 5.0, Glyphs::Ascii, 3, (area, &mut Buffer::empty(area)), &|buffer| {
            for cell in buffer.content() {
                assert!(cell.symbol().chars().all(|c| (' '..='~').contains(&c)), "{cell:?}");
            }
        });
    }

    #[test]
    fn a_fitted_range_holds_what_it_promises(case in case()) {
        let (low, high) = case.grid.y;
        prop_assert!(low.is_finite() && high.is_finite() && low < high);
        let in_view = |i: &usize| (case.grid.view.from..=case.grid.view.to).contains(&case.record.t[*i]);
        for i in (0..case.record.y.len()).filter(in_view) {
            let promised = match case.fit {
                YFit::Kept => !is_hidden(&case.record, i),
                YFit::All => true,
                YFit::Robust | YFit::Fixed(..) => false,
            };
            prop_assert!(!promised || (low..=high).contains(&case.record.y[i]));
        }
    }

    #[test]
    fn any_data_view_and_size_are_safe_and_stay_in_the_area(
        samples in prop::collection::vec((0.0..2.0_f64, hostile_value(), states()), 0..300),
        times in prop::option::of(hostile_value()),
        view in (hostile_value(), hostile_value()), y in (hostile_value(), hostile_value()),
        size in (0_u16..300, 0_u16..100), grid_size in (0_u16..300, 0_u16..100), at in (0_u16..40, 0_u16..40),
        glyphs in glyphs(), gap in hostile_value(), spot in (0_usize..400, 0_u16..300, 0_u16..100),
    ) {
        let mut record = Record::new(&samples, 0.0);
        if let Some(t) = times {
            record.t.iter_mut().step_by(3).for_each(|x| *x += t);
        }
        let view = View { from: view.0, to: view.1 };
        let grid = Grid { view, y, width: grid_size.0, height: grid_size.1 };
        let buffer_area = Rect::new(0, 0, 200, 80);
        let area = Rect::new(at.0, at.1, size.0, size.1);
        let mut buffer = plots::filled(buffer_area, '\u{7f}');
        plots::all_widgets(&record, grid, gap, glyphs, spot.0, (area, &mut buffer), &|_| ());
        for (i, cell) in buffer.content().iter().enumerate() {
            let (x, y) = buffer.pos_of(i);
            prop_assert!(cell.symbol() == "\u{7f}" || area.contains((x, y).into()), "wrote at {} {}", x, y);
        }
        record.with_trace(gap, |trace| {
            let columns = Columns::new(trace, grid);
            let _ = (columns.flag_at(&record.index, spot.1, spot.2), columns.sample_at(trace, spot.1, spot.2));
            let _ = (columns.position_at(trace.axis, spot.1), columns.column_of(spot.0), columns.summary(spot.1));
            for fit in [YFit::Kept, YFit::All, YFit::Robust, YFit::Fixed(y.0, y.1)] {
                let (low, high) = fit.range(trace, view);
                assert!(low.is_finite() && high.is_finite() && low < high, "{fit:?} gives {low} to {high}");
            }
        });
    }
}
