//! Records and drawing for the tests of the plots.

#![expect(dead_code, unreachable_pub, reason = "each test program uses a part of this")]

use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::Rect;
use ratatui::widgets::Widget;
use wildpoint::tui::plot::*;
use wildpoint::tui::theme::Theme;

/// A record with flags; every flag but that of a suspect hides its sample from the curve.
#[derive(Debug, Clone)]
pub struct Record {
    pub t: Vec<f64>,
    pub y: Vec<f64>,
    pub flags: Vec<Flag>,
    pub index: Flags,
    /// Expected values, 0.3 above the samples unless a test says better.
    pub expected: Vec<f64>,
    pub hidden: Vec<bool>,
}

impl Record {
    /// From steps of time, values and states.
    pub fn new(samples: &[(f64, f64, Option<FlagState>)], offset: f64) -> Self {
        let t = samples.iter().scan(0.0, |t, sample| {
            *t += sample.0;
            Some(*t)
        });
        let y: Vec<f64> = samples.iter().map(|sample| sample.1 + offset).collect();
        let flag = |(i, sample): (usize, &(f64, f64, Option<FlagState>))| {
            sample.2.map(|state| Flag { position: i as u32, y: y[i], state })
        };
        let flags: Vec<Flag> = samples.iter().enumerate().filter_map(flag).collect();
        let hidden = samples.iter().map(|sample| sample.2.is_some_and(|s| s != FlagState::Suspect)).collect();
        Self {
            t: t.collect(),
            index: Flags::new(&flags),
            flags,
            hidden,
            expected: y.iter().map(|y| y + 0.3).collect(),
            y,
        }
    }

    /// Calls `then` with the trace of the record: a band of 4 about the expected values, which are the repaired ones.
    pub fn with_trace<T>(&self, gap: f64, then: impl FnOnce(&Trace<'_>) -> T) -> T {
        let kept = |i: usize| if self.hidden[i] { Span::EMPTY } else { Span::at(self.y[i]) };
        let expected = |i: usize| Span::at(self.expected[i]);
        let band = |i: usize| Span { low: self.expected[i] - 4.0, high: self.expected[i] + 4.0 };
        let repaired = |i: usize| if self.hidden[i] { Span::at(self.expected[i]) } else { Span::EMPTY };
        let n = self.y.len();
        let (a, b) = (Pyramid::build_spans(n, kept), Pyramid::build_spans(n, expected));
        let (c, d) = (Pyramid::build_spans(n, band), Pyramid::build_spans(n, repaired));
        then(&Trace {
            axis: Axis::Time(&self.t),
            kept: Curve { pyramid: &a, span: &kept },
            flags: &self.index,
            expected: Some(Curve { pyramid: &b, span: &expected }),
            band: Some(Curve { pyramid: &c, span: &band }),
            repaired: Some(Curve { pyramid: &d, span: &repaired }),
            filtered: None,
            gap,
        })
    }
}

pub fn is_hidden(record: &Record, position: usize) -> bool {
    record.hidden[position]
}

/// A plot area and the row of its rail.
pub fn split(area: Rect) -> (Rect, Rect) {
    let rows = area.height.saturating_sub(1);
    (Rect { height: rows, ..area }, Rect { y: area.y + rows, height: area.height - rows, ..area })
}

pub fn filled(area: Rect, glyph: char) -> Buffer {
    let mut cell = Cell::default();
    cell.set_char(glyph);
    Buffer::filled(area, cell)
}

/// Is the dot of a sample lit in this symbol of its cell? By plain arithmetic, from the braille standard. A value
/// within rounding of the edge of a dot may be in either.
pub fn dot_lit(glyphs: Glyphs, symbol: &str, grid: &Grid, x: f64, y: f64) -> bool {
    let symbol = symbol.chars().next().unwrap_or(' ');
    let row = (grid.y.1 - y) / (grid.y.1 - grid.y.0) * f64::from(grid.height) * 4.0;
    let rows = [row - 1e-4, row + 1e-4].map(|row| row.clamp(0.0, f64::from(grid.height) * 4.0 - 1.0) as usize % 4);
    let column = (x - grid.view.from) / (grid.view.to - grid.view.from) * f64::from(grid.width) * 2.0;
    let column = (column.floor() as usize).min(usize::from(grid.width) * 2 - 1) % 2;
    rows.iter().any(|&row| match glyphs {
        Glyphs::Ascii => match symbol {
            ':' | '=' => true,
            '\'' => row < 2,
            '.' => row >= 2,
            _ => false,
        },
        _ => {
            let bit = [[0, 1, 2, 6], [3, 4, 5, 7]][column][row];
            let pattern = u32::from(symbol);
            (0x2800..0x2900).contains(&pattern) && (pattern - 0x2800) >> bit & 1 == 1
        }
    })
}

/// Draws every widget over the same area, and shows the buffer after each.
pub fn all_widgets(
    record: &Record,
    grid: Grid,
    gap: f64,
    glyphs: Glyphs,
    at: usize,
    (area, buffer): (Rect, &mut Buffer),
    look: &dyn Fn(&Buffer),
) {
    let theme = &Theme::mono();
    let columns = &record.with_trace(gap, |trace| Columns::new(trace, grid));
    let cursor = record.y.get(at).map(|&y| Cursor { position: at, y });
    let ratio = |i: usize| record.y.get(i).map(|y| y * 3.0);
    let pyramid = ResidualPlot::pyramid(record.y.len(), ratio);
    let label = |x: f64| format!("{x:.3}");
    TracePlot { columns, theme, glyphs, layers: Layers::ALL, cursor, selection: Some(at / 2..at) }.render(area, buffer);
    look(buffer);
    FlagRail { columns, theme, glyphs, label: "flags", cursor: Some(at), selection: None }.render(area, buffer);
    look(buffer);
    ResidualPlot {
        columns,
        ratio: &ratio,
        pyramid: &pyramid,
        threshold: 1.0,
        top: 3.0,
        log: false,
        theme,
        glyphs,
        cursor: Some(at),
    }
    .render(area, buffer);
    look(buffer);
    let viewport = View { from: grid.view.from, to: grid.view.to / 2.0 };
    Overview { columns, viewport, theme, glyphs }.render(area, buffer);
    look(buffer);
    for steps in [TickSteps::Clock, TickSteps::Decimal] {
        AxisLabels { view: grid.view, steps, phase: 7.0, label_width: 8, label: &label, unit: "s", theme }
            .render(area, buffer);
        look(buffer);
    }
}

/// The characters of a buffer, a line per row.
pub fn text(buffer: &Buffer) -> String {
    let rows = buffer.content().chunks(usize::from(buffer.area().width).max(1));
    rows.map(|row| row.iter().map(Cell::symbol).collect::<String>().trim_end().to_owned() + "\n").collect()
}
