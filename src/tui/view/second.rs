//! The channel beside the one on the screen, over the same times.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Span as Words;
use ratatui::widgets::Widget;

use super::super::chart_data::Picture;
use super::super::layout::{SecondParts, second_parts};
use super::super::plot::{Cursor, FlagRail, TracePlot};
use super::plots::Plots;
use super::{rule, rule_glyph, thousands};
use crate::track::printable;

impl Plots<'_> {
    /// Draws the trace of the second channel with its heading and its rail.
    pub(super) fn second(&self, area: Rect, buffer: &mut Buffer) {
        let model = self.model;
        let Some(plan) = model.second_plan() else { return };
        let (theme, glyphs, state) = (&model.theme, model.glyphs, &model.channels[plan]);
        let picture = Picture::of(model, plan);
        let SecondParts { head, body, rail } = second_parts(area);
        let width = TracePlot::plot_area(body).width;
        let columns = &*picture.beside(&self.picture, (width, body.height));
        // The sample nearest to the time of the cursor.
        let time = self.picture.series.t.get(model.state().cursor);
        let nearest = time.and_then(|&t| {
            let after = picture.series.before(t);
            let near = |i: &usize| picture.series.t.get(*i).map_or(f64::INFINITY, |x| (x - t).abs());
            [after.saturating_sub(1), after].into_iter().min_by(|a, b| near(a).total_cmp(&near(b)))
        });
        let cursor = nearest.and_then(|i| picture.series.y.get(i).map(|&y| Cursor { position: i, y }));
        let widget = TracePlot { columns, theme, glyphs, layers: state.layers, cursor, selection: None };
        let channel = &model.track.channels[state.channel];
        let unit = printable(channel.unit_beside_name());
        let unit = if unit.is_empty() { unit } else { format!(" [{unit}]") };
        let result = match state.drawn.as_deref() {
            Some(drawn) => format!("{} flagged  ", thousands(drawn.outcome.counts.flagged)),
            None => "not judged yet (d shows it)  ".to_owned(),
        };
        let note = widget.y_note();
        let note = if note.is_empty() { note } else { format!("y {note}  ") };
        let spans = vec![
            Words::styled(format!("{} ", rule_glyph(model)), theme.dim),
            Words::styled(format!("{}{unit}  ", printable(&channel.name)), theme.title),
            Words::styled(format!("{result}{note}V another  "), theme.dim),
        ];
        rule(model, spans, head, buffer);
        widget.render(body, buffer);
        let cursor = cursor.map(|cursor| cursor.position);
        FlagRail { columns, theme, glyphs, label: "flags", cursor, selection: None }.render(rail, buffer);
    }
}
