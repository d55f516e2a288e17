//! What lies under a cell of the screen.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::action::Panel;
use super::chart_data::Picture;
use super::layout::{self, trace_parts};
use super::model::Model;
use super::plot::TracePlot;
use super::update::queue::listed;
use super::view::overlay;
use super::view::parameters::Rows;

/// How many columns away from a flag a click still means it.
const NEAR: u16 = 2;

/// What lies under a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Spot {
    /// The overview, at this place on the x axis.
    Overview(f64),
    /// The curve, at this place on the x axis; with the sample that the cell points at.
    Trace(f64, Option<usize>),
    /// The rail of the trace, at this place on the x axis; with the first flag of its column.
    Rail(f64, Option<usize>),
    /// The residual, at this place on the x axis; with the sample.
    Residual(f64, Option<usize>),
    /// The channel beside the one on the screen, at this place on the x axis; with the sample of the one on the screen
    /// that is nearest in time to what the cell points at.
    Second(f64, Option<usize>),
    /// The queue; with the index of the flag.
    Queue(Option<u32>),
    /// The parameters; with the index of the parameter.
    Parameters(Option<usize>),
    /// The card.
    Card,
    /// Nothing that a mouse does something with.
    Elsewhere,
}

impl Spot {
    /// The panel it belongs to.
    pub(super) fn panel(self) -> Option<Panel> {
        match self {
            Self::Trace(..) | Self::Rail(..) => Some(Panel::Trace),
            Self::Residual(..) => Some(Panel::Residual),
            Self::Queue(_) => Some(Panel::Queue),
            Self::Parameters(_) => Some(Panel::Parameters),
            Self::Card => Some(Panel::Card),
            Self::Overview(_) | Self::Second(..) | Self::Elsewhere => None,
        }
    }

    /// The place on the x axis it is at.
    pub(super) fn x(self) -> Option<f64> {
        match self {
            Self::Overview(x) | Self::Trace(x, _) | Self::Rail(x, _) | Self::Residual(x, _) | Self::Second(x, _) => {
                Some(x)
            }
            Self::Queue(_) | Self::Parameters(_) | Self::Card | Self::Elsewhere => None,
        }
    }
}

/// What lies under the cell in this column and row. Drawers lie over the plots.
pub(super) fn spot(model: &Model, column: u16, row: u16) -> Spot {
    let Some(areas) = layout::arrange(model, model.screen()) else { return Spot::Elsewhere };
    let inside = |area: Option<Rect>| area.filter(|a| a.contains((column, row).into()));
    let drawn_over = |area: Rect| if areas.knobs.is_some() { layout::drawer(area) } else { area };
    if let Some(area) = inside(areas.queue) {
        return queue(model, drawn_over(area), row);
    }
    if let Some(area) = inside(areas.parameters) {
        return parameters(model, drawn_over(area), row);
    }
    if let Some(area) = inside(areas.overview) {
        let whole = model.whole();
        return x_at(TracePlot::plot_area(area), (whole.from, whole.to), column)
            .map_or(Spot::Elsewhere, Spot::Overview);
    }
    if let Some(area) = inside(areas.trace) {
        return trace(model, area, column, row);
    }
    if let Some(area) = inside(areas.second) {
        return second(model, area, column, row).unwrap_or(Spot::Elsewhere);
    }
    if let Some(area) = inside(areas.residual) {
        let plot = TracePlot::plot_area(below_heading(area));
        let view = model.state().view;
        let x = x_at(plot, (view.from, view.to), column).filter(|_| row > area.y);
        return x.map_or(Spot::Elsewhere, |x| Spot::Residual(x, model.nearest_x(x)));
    }
    if inside(areas.card).is_some() { Spot::Card } else { Spot::Elsewhere }
}

fn trace(model: &Model, area: Rect, column: u16, row: u16) -> Spot {
    let pinned = model.state().pinned.as_deref().is_some_and(|p| p.sides.is_some());
    let parts = trace_parts(area, pinned);
    let plot = TracePlot::plot_area(parts.body);
    let view = model.state().view;
    let Some(x) = x_at(plot, (view.from, view.to), column) else { return Spot::Elsewhere };
    let (picture, size) = (Picture::of(model, model.shown), (plot.width, parts.body.height));
    if parts.rail.contains((column, row).into()) {
        return Spot::Rail(x, picture.first_flag(size, column - plot.x));
    }
    if !plot.contains((column, row).into()) {
        return Spot::Elsewhere;
    }
    let columns = picture.trace(size);
    let after = model.state().after;
    Spot::Trace(x, picture.pointed(&columns, after, (column - plot.x, row - plot.y), NEAR))
}

/// What the second channel has there, as a time of the one on the screen.
fn second(model: &Model, area: Rect, column: u16, row: u16) -> Option<Spot> {
    let plan = model.second_plan()?;
    let parts = layout::second_parts(area);
    let plot = TracePlot::plot_area(parts.body);
    let at = column.checked_sub(plot.x).filter(|at| *at < plot.width && row >= plot.y)?;
    let (main, picture) = (Picture::of(model, model.shown), Picture::of(model, plan));
    let columns = picture.beside(&main, (plot.width, parts.body.height));
    let flag = columns.flag_in(&model.channels[plan].flags, at).filter(|_| row == parts.rail.y);
    let cell = (at, (row - plot.y).min(plot.height.saturating_sub(1)));
    let sample = flag.or_else(|| picture.pointed(&columns, false, cell, NEAR))?;
    let nearest = model.nearest(*picture.series.t.get(sample)?)?;
    let view = model.state().view;
    // By number, the samples of the two channels need not lie in the same columns.
    #[expect(clippy::cast_precision_loss, reason = "positions are below 2^32")]
    let x = if model.by_number { Some(nearest as f64) } else { x_at(plot, (view.from, view.to), column) };
    Some(Spot::Second(x?, Some(nearest)))
}

/// The index of the row at this place of what lies over the panels, where it can be chosen.
pub(super) fn choice(model: &Model, column: u16, row: u16) -> Option<usize> {
    // Only drawing knows where its rows come to lie: it is asked for, and thrown away.
    let area = model.screen();
    layout::arrange(model, area)?;
    let choices = overlay::draw(model, area, &mut Buffer::empty(area));
    choices.into_iter().find(|choice| choice.place.contains((column, row).into())).map(|choice| choice.index)
}

/// The place on the x axis in the middle of a column of a plot; none left or right of it.
fn x_at(plot: Rect, (from, to): (f64, f64), column: u16) -> Option<f64> {
    let at = column.checked_sub(plot.x).filter(|at| *at < plot.width)?;
    Some(from + (to - from) * (f64::from(at) + 0.5) / f64::from(plot.width))
}

fn below_heading(area: Rect) -> Rect {
    let head = area.height.min(1);
    Rect { y: area.y + head, height: area.height - head, ..area }
}

fn queue(model: &Model, area: Rect, row: u16) -> Spot {
    let rows = layout::queue_rows(area);
    let first = area.bottom() - u16::try_from(rows).unwrap_or(0).min(area.height);
    Spot::Queue(row.checked_sub(first).and_then(|at| listed(model, rows).get(usize::from(at)).copied()))
}

fn parameters(model: &Model, area: Rect, row: u16) -> Spot {
    let body = below_heading(area);
    let rows = Rows::of(model, body);
    let at = row.checked_sub(body.y).map(usize::from).filter(|r| *r < rows.visible).map(|r| rows.from + r);
    Spot::Parameters(at.filter(|i| *i < model.knobs().len()))
}
