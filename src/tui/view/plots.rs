//! The plots of the channel on the screen: overview and trace.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Span as Words;
use ratatui::widgets::Widget;

use super::super::action::Panel;
use super::super::chart_data::Picture;
use super::super::layout::{TraceParts, trace_parts};
use super::super::model::{Model, YMode};
use super::super::plot::{
    AxisLabels, Columns, Cursor, FlagRail, Layers, Overview, SideMarks, SideRail, TickSteps, TracePlot, View,
};
use super::super::smoothing::Smoothed;
use super::super::update::layer_names;
use super::{compare, heading, thousands};
use crate::plot::TimeTicks;

/// The plots of the channel on the screen.
pub(super) struct Plots<'a> {
    pub(super) model: &'a Model,
    pub(super) picture: Picture<'a>,
}

impl<'a> Plots<'a> {
    pub(super) fn new(model: &'a Model) -> Self {
        Self { model, picture: Picture::of(model, model.shown) }
    }

    pub(super) fn overview(&self, area: Rect, buffer: &mut Buffer) {
        let (theme, glyphs) = (&self.model.theme, self.model.glyphs);
        let width = TracePlot::plot_area(area).width;
        let columns = &*self.picture.overview((width, area.height.saturating_sub(1)));
        Overview { columns, viewport: self.model.state().view, theme, glyphs }.render(area, buffer);
    }

    pub(super) fn trace(&self, area: Rect, buffer: &mut Buffer) {
        let model = self.model;
        let (theme, glyphs, state) = (&model.theme, model.glyphs, model.state());
        let sides = state.pinned.as_deref().and_then(|p| p.sides.as_ref());
        let parts = trace_parts(area, sides.is_some());
        let TraceParts { head, body, rail: rail_row, axis: axis_row, sides: side_row } = parts;
        let plot = TracePlot::plot_area(body);
        let columns = &*self.picture.trace((plot.width, body.height));
        // The rail never goes away, not even while the record is shown as it will be after repair, without its flags.
        let with_flags = state.after.then(|| self.picture.rail(plot.width));
        let cursor = self.picture.series.y.get(state.cursor).map(|&y| Cursor { position: state.cursor, y });
        let selection = model.selection();
        let widget = TracePlot { columns, theme, glyphs, layers: self.layers(), cursor, selection: selection.clone() };
        let note = widget.y_note();
        let words = self.trace_words(columns, &note);
        let words: Vec<Words<'_>> = words.iter().map(|w| Words::styled(w.as_str(), theme.dim)).collect();
        heading(model, Panel::Trace, &words, head, buffer);
        widget.render(body, buffer);
        let cursor = Some(state.cursor);
        if let Some(sides) = sides {
            SideMarks { sides, columns, y: &self.picture.series.y, theme }.render(body, buffer);
            SideRail { sides, columns, cursor, theme, glyphs }.render(side_row.unwrap_or_default(), buffer);
        }
        let columns = with_flags.as_deref().unwrap_or(columns);
        FlagRail { columns, theme, glyphs, label: "flags", cursor, selection }.render(rail_row, buffer);
        if let Some(row) = axis_row {
            self.axis_labels(row, state.view, buffer);
        }
    }

    /// After repair, the curve is what the picture is about.
    fn layers(&self) -> Layers {
        let state = self.model.state();
        if state.after { Layers::USUAL } else { state.layers }
    }

    fn trace_words(&self, columns: &Columns, note: &str) -> Vec<String> {
        let state = self.model.state();
        let inside = columns.in_view().len();
        let n = self.picture.series.len();
        let mut words = Vec::new();
        if inside < n {
            words.push(format!("{} of {} samples  ", thousands(inside), thousands(n)));
        } else {
            words.push(format!("all {} samples  ", thousands(n)));
        }
        words.extend(compare::counts(self.model));
        if !note.is_empty() {
            words.push(format!("y {note}  "));
        }
        let fit = match state.y_fit {
            YMode::Kept => "",
            YMode::All => "y: all  ",
            YMode::Robust => "y: robust  ",
            YMode::Fixed(..) => "y: fixed  ",
        };
        let layers = match (Layers { filtered: false, ..state.layers }) {
            _ if state.after => "AFTER REPAIR  ".to_owned(),
            Layers::USUAL => String::new(),
            Layers::RAW => "curve alone  ".to_owned(),
            Layers { raw: true, expected: true, repaired: true, .. } => "with expected  ".to_owned(),
            other => match layer_names(other).join(", ") {
                names if names.is_empty() => "flags alone  ".to_owned(),
                names => format!("{names}  "),
            },
        };
        let filtered = match Smoothed::of(self.model).map(|smoothed| smoothed.track.is_some()) {
            _ if state.after || !state.layers.filtered => "",
            Some(true) => "with filtered track  ",
            Some(false) | None => "filtered track: none yet  ",
        };
        words.extend([fit.to_owned(), layers, filtered.to_owned()].into_iter().filter(|w| !w.is_empty()));
        words
    }

    fn axis_labels(&self, row: Rect, view: View, buffer: &mut Buffer) {
        if self.model.by_number {
            self.row_labels(row, view, buffer);
            return;
        }
        let time = &self.model.track.time;
        let ticks = TimeTicks::new(time, view, TracePlot::plot_area(row).width);
        let label = |x: f64| ticks.label(time, x);
        let TimeTicks { steps, phase, label_width, unit, .. } = ticks;
        let theme = &self.model.theme;
        AxisLabels { view, steps, phase, label_width, label: &label, unit, theme }.render(row, buffer);
    }

    /// Rows of the file under positions: both count from the first sample, unless rows have no value.
    fn row_labels(&self, row: Rect, view: View, buffer: &mut Buffer) {
        let series = &self.picture.series;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates as wanted")]
        let label = |x: f64| series.row_of(x.round() as usize).map_or(String::new(), |row| format!("#{}", row + 1));
        let (steps, theme) = (TickSteps::Decimal, &self.model.theme);
        let label_width = u16::try_from(self.model.track.rows.to_string().len() + 1).unwrap_or(12);
        AxisLabels { view, steps, phase: 1.0, label_width, label: &label, unit: "row", theme }.render(row, buffer);
    }
}
