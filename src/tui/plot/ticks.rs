//! Labels of the x axis at round steps.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;
use unicode_width::UnicodeWidthStr;

use super::paint::{Paint, right_of_margin};
use super::view::View;
use crate::plot::ticks;
pub use crate::plot::{TickSteps, tick_step};
use crate::tui::theme::Theme;

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
        ticks(self.view, step, self.phase, width)
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
