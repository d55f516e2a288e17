//! The picture below the trace: residual, histogram, steps of time.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Span as Words;
use ratatui::widgets::Widget;

use super::super::action::Panel;
use super::super::model::LowerKind;
use super::super::plot::{HistogramPlot, Pyramid, ResidualPlot, StepPlot, TracePlot, VotesPlot};
use super::super::words::plural;
use super::plots::Plots;
use super::{NOT_JUDGED, compare, detectability, heading_named, short, thousands};
use crate::plot::{Drawn, Histogram, Tally};
use crate::session::Ballot;

impl Plots<'_> {
    /// Draws the picture below the trace with its heading.
    pub(super) fn lower(&self, area: Rect, buffer: &mut Buffer) {
        let body = Rect { y: area.y + area.height.min(1), height: area.height.saturating_sub(1), ..area };
        let words = match self.model.lower.kind {
            LowerKind::Residual => self.residual(body, buffer),
            LowerKind::Histogram => self.histogram(body, buffer),
            LowerKind::Steps => self.steps(body, buffer),
            LowerKind::Consensus => self.consensus(body, buffer),
            LowerKind::Detectability => detectability::draw(self.model, body, buffer),
        };
        let head = Rect { height: area.height.min(1), ..area };
        heading_named(self.model, Panel::Residual, self.model.lower.kind.name(), &words, head, buffer);
    }

    fn dim(&self, text: String) -> Words<'static> {
        Words::styled(text, self.model.theme.dim)
    }

    fn unit(&self) -> &'static str {
        let in_scales = self.model.state().drawn.as_deref().is_some_and(Drawn::in_scales);
        if in_scales { "sigma" } else { "tolerances" }
    }

    fn residual(&self, area: Rect, buffer: &mut Buffer) -> Vec<Words<'static>> {
        let (model, state) = (self.model, self.model.state());
        let columns = &*self.picture.rail(TracePlot::plot_area(area).width);
        let nothing = Pyramid::default();
        let drawn = state.drawn.as_deref();
        let pyramid = drawn.map_or(&nothing, |d| &d.ratios);
        let ratio = |i: usize| drawn.and_then(|d| d.residual(&self.picture.series, i));
        let threshold = drawn.map_or(1.0, |d| d.threshold);
        let log = model.lower.log_residual;
        let whole =
            pyramid.span_over(|i| ratio(i).map_or(crate::plot::Span::EMPTY, crate::plot::Span::at), 0..usize::MAX);
        let worst = if log && !whole.is_empty() { whole.high.abs().max(whole.low.abs()) } else { 0.0 };
        let top = worst.max(ResidualPlot::top_after(state.residual_top, threshold));
        let (theme, glyphs, cursor) = (&model.theme, model.glyphs, Some(state.cursor));
        let widget = ResidualPlot { columns, ratio: &ratio, pyramid, threshold, top, log, theme, glyphs, cursor };
        let what = if widget.is_signed() { "in" } else { "largest per column, in" };
        let scale = if log { ", log scale" } else { "" };
        // How high it is stands beside it.
        let line = glyphs.threshold();
        let words = format!("{what} {}{scale}  {line} threshold  ", self.unit());
        widget.render(area, buffer);
        // A threshold without a result would be that of no method.
        vec![self.dim(if drawn.is_some() { words } else { NOT_JUDGED.into() })]
    }

    fn histogram(&self, area: Rect, buffer: &mut Buffer) -> Vec<Words<'static>> {
        let (model, state) = (self.model, self.model.state());
        let drawn = state.drawn.as_deref();
        let nothing = Histogram::default();
        let histogram = drawn.map_or(&nothing, |d| &d.histogram);
        let threshold = drawn.map_or(1.0, |d| d.threshold);
        let cursor = drawn.and_then(|d| d.residual(&self.picture.series, state.cursor));
        let (theme, glyphs, log) = (&model.theme, model.glyphs, model.lower.log_counts);
        HistogramPlot { histogram, threshold, log, cursor, theme, glyphs }.render(area, buffer);
        let scale = if log { ", log counts" } else { "" };
        let mut words = vec![self.dim(format!("{}{scale}  ", self.unit()))];
        let edge = short(histogram.top());
        for (tally, what) in [(histogram.below, format!("< -{edge}")), (histogram.above, format!("> {edge}"))] {
            words.extend(self.beyond(tally, &what));
        }
        if histogram.without.all > 0 {
            words.push(self.dim(format!("without {}  ", thousands(histogram.without.all as usize))));
        }
        words
    }

    /// What lies beyond an edge of the histogram.
    fn beyond(&self, tally: Tally, what: &str) -> Option<Words<'static>> {
        let theme = &self.model.theme;
        let style = if tally.flagged > 0 { theme.over } else { theme.dim };
        let flagged = match tally.flagged {
            0 => ", none flagged".to_owned(),
            n if n == tally.all => ", all flagged".to_owned(),
            n => format!(", {} flagged", thousands(n as usize)),
        };
        (tally.all > 0).then(|| Words::styled(format!("{what}: {}{flagged}  ", thousands(tally.all as usize)), style))
    }

    fn consensus(&self, area: Rect, buffer: &mut Buffer) -> Vec<Words<'static>> {
        let (model, state) = (self.model, self.model.state());
        let columns = &*self.picture.rail(TracePlot::plot_area(area).width);
        let (ballot, pyramid) = (Ballot::default(), Pyramid::default());
        let (ballot, pyramid) = state.consensus.as_deref().map_or((&ballot, &pyramid), |c| (&c.ballot, &c.pyramid));
        let (theme, glyphs, cursor) = (&model.theme, model.glyphs, Some(state.cursor));
        VotesPlot { ballot, pyramid, columns, cursor, theme, glyphs }.render(area, buffer);
        compare::consensus_words(model)
    }

    fn steps(&self, area: Rect, buffer: &mut Buffer) -> Vec<Words<'static>> {
        let (model, state) = (self.model, self.model.state());
        let columns = &*self.picture.rail(TracePlot::plot_area(area).width);
        let steps = &self.picture.step_columns(columns);
        let (theme, glyphs, interval) = (&model.theme, model.glyphs, self.picture.series.interval);
        StepPlot { steps, columns, interval, theme, glyphs, cursor: Some(state.cursor) }.render(area, buffer);
        let all = self.picture.steps();
        let cuts = state.drawn.as_deref().map_or(0, |d| d.outcome.detection.segments.len().saturating_sub(1));
        let mut words = vec![self.dim(format!("every {} s, log scale  ", short(interval)))];
        if all.gaps > 0 {
            let (lost, gaps) = (thousands(all.lost), thousands(all.gaps));
            let text = format!("{} {lost} lost in {gaps} gap{}  ", glyphs.lost(), plural(all.gaps));
            words.push(Words::styled(text, theme.warning));
        }
        if cuts > 0 {
            words.push(Words::styled(
                format!("{} {cuts} cut{}  ", glyphs.viewport(), if cuts == 1 { "" } else { "s" }),
                theme.over,
            ));
        }
        if all.unusable > 0 {
            let faults = &model.track.faults;
            let kinds = [(&faults.repeated_times, "repeated"), (&faults.backward_times, "backward")];
            let kinds = kinds.iter().filter(|(fault, _)| fault.count > 0);
            let kinds: Vec<String> = kinds.map(|(fault, word)| format!("{} {word}", fault.count)).collect();
            let kinds = if kinds.is_empty() { String::new() } else { format!(": {}", kinds.join(", ")) };
            let text = format!("! {} without usable time{kinds}  ", thousands(all.unusable));
            words.push(Words::styled(text, theme.error));
        }
        words
    }
}
