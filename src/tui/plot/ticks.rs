//! Labels of the x axis at round steps.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;
use unicode_width::UnicodeWidthStr;

use super::labels::{DECIMAL, round_step};
use super::paint::{Paint, right_of_margin};
use super::view::View;
use crate::tui::theme::Theme;

/// Which steps count as round.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TickSteps {
    /// 1, 2 and 5 times powers of ten: seconds of a file's own, sample numbers.
    Decimal,
    /// Parts of minutes, hours and days: calendar times and times of day.
    Clock,
}

/// Round steps of a clock from a second to a day, in seconds.
const CLOCK: [f64; 17] = [
    1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 900.0, 1800.0, 3600.0, 7200.0, 10800.0, 21600.0,
    43200.0,
];
const DAY: f64 = 86400.0;

/// The smallest round step whose labels of `label_width` columns leave room between them. A caller needs it to give
/// labels enough digits.
#[must_use]
pub fn tick_step(view: View, width: u16, label_width: u16, steps: TickSteps) -> f64 {
    let room = f64::from(label_width) + 3.0;
    let least = view.width() * room / f64::from(width.max(1));
    match steps {
        TickSteps::Clock if least > 1.0 => {
            let step = CLOCK.into_iter().find(|step| *step >= least);
            step.unwrap_or_else(|| if least <= DAY { DAY } else { DAY * round_step(least / DAY, &DECIMAL) })
        }
        TickSteps::Clock | TickSteps::Decimal => round_step(least, &DECIMAL),
    }
}

/// The row of labels under a plot with a margin.
#[derive(Clone)]
pub struct AxisLabels<'a> {
    /// The x range.
    pub view: View,
    /// Which steps are round.
    pub steps: TickSteps,
    /// What the clock shows where x is 0, in seconds: labels are round in x plus this.
    pub phase: f64,
    /// Columns that a label needs at most.
    pub label_width: u16,
    /// The label of an x; ASCII where the glyphs are.
    pub label: &'a dyn Fn(f64) -> String,
    /// What stands at the right end: a unit, a time zone. May be empty.
    pub unit: &'a str,
    /// Styles.
    pub theme: &'a Theme,
}

impl AxisLabels<'_> {
    /// The x of the labels over `width` columns.
    #[must_use]
    pub fn ticks(&self, width: u16) -> Vec<f64> {
        if self.view.width() == 0.0 || width == 0 {
            return Vec::new();
        }
        let step = tick_step(self.view, width, self.label_width, self.steps);
        let first = ((self.view.from + self.phase) / step).ceil();
        let x = |i: u16| (first + f64::from(i)) * step - self.phase;
        (0..width).map(x).take_while(|x| *x <= self.view.to).collect()
    }
}

impl Widget for AxisLabels<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = Rect { height: area.height.min(1), ..area };
        let margin = area.width - right_of_margin(area).width;
        let plot = right_of_margin(area).width;
        let mut paint = Paint::new(buffer, area);
        paint.clear_row(0);
        let unit_width = self.unit.width();
        let room = usize::from(area.width).saturating_sub(if unit_width > 0 { unit_width + 1 } else { 0 });
        let mut free_from = 0;
        for x in self.ticks(plot) {
            let text = (self.label)(x);
            let width = text.width();
            let share = (x - self.view.from) / self.view.width();
            // The middle of the label stands under its x; it may reach into the margin.
            let middle = usize::from(margin) + (share * f64::from(plot)) as usize;
            let start = middle.saturating_sub(width / 2);
            if width > 0 && start >= free_from && start + width <= room {
                paint.text(start as u16, 0, &text, self.theme.dim);
                free_from = start + width + 2;
            }
        }
        if unit_width > 0 && room > 0 && free_from <= room + 2 {
            paint.text((room + 1) as u16, 0, self.unit, self.theme.dim);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clock_steps_are_those_of_a_clock_and_decimal_ones_of_a_ruler() {
        let step = |width, steps| tick_step(View { from: 0.0, to: width }, 80, 8, steps);
        assert_eq!(step(3600.0, TickSteps::Clock), 600.0);
        assert_eq!(step(3600.0, TickSteps::Decimal), 500.0);
        assert_eq!(step(10.0 * DAY, TickSteps::Clock), 2.0 * DAY);
        assert_eq!(step(0.7, TickSteps::Clock), 0.1);
    }

    #[test]
    fn labels_are_round_on_the_clock_of_the_record() {
        let theme = Theme::mono();
        let view = View { from: 0.0, to: 200.0 };
        let label = |x: f64| format!("{:.0}", x + 17.0);
        let labels = AxisLabels {
            view,
            steps: TickSteps::Clock,
            phase: 17.0,
            label_width: 5,
            label: &label,
            unit: "s",
            theme: &theme,
        };
        assert_eq!(labels.ticks(72), [13.0, 43.0, 73.0, 103.0, 133.0, 163.0, 193.0]);
        let mut buffer = Buffer::empty(Rect::new(0, 0, 80, 1));
        labels.render(buffer.area, &mut buffer);
        let text: String = buffer.content().iter().map(|cell| cell.symbol()).collect();
        assert_eq!(text.split_whitespace().collect::<Vec<_>>(), ["30", "60", "90", "120", "150", "180", "s"]);
        // x = 13 of 200 on 72 columns is column 4 of the plot, 12 of the row.
        assert_eq!(&text[11..13], "30");
    }
}
