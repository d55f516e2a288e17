//! Plots of records with up to 10^7 samples in a terminal, which cannot hide a wild point.
//!
//! Samples become columns ([`Columns`]) through pyramids of extremes ([`Pyramid`]), columns become cells of a
//! buffer. All of it is pure: the same inputs give the same cells. Columns are kept from frame to frame for as long
//! as what they are made of stays ([`Memo`]). What the plots promise, and `tests/plot_laws.rs` checks:
//!
//! 1. every flag in view counts on the rail, in its column;
//! 2. every finite flag has its cell in a flag's style, or an arrow at the edge;
//! 3. every kept sample in range has its dot, or lies in a cell of a flag;
//! 4. any size, view and data are safe, and nothing is written outside the area;
//! 5. in ASCII mode, only ASCII is written;
//! 6. a click on a cell leads back to a sample that is drawn in it.
//!
//! ```
//! use ratatui::{buffer::Buffer, layout::Rect, widgets::Widget};
//! use wildpoint::tui::plot::*;
//! use wildpoint::tui::theme::{ColorDepth, Theme};
//!
//! let (t, y) = ([0.0, 1.0, 2.0, 3.0], [5.0, 5.1, 9.0, 5.2]);
//! let hidden = |i: usize| i == 2;
//! // Kept while the data and the flags stay:
//! let pyramid = Pyramid::build(&y, hidden);
//! let flags = Flags::new(&[Flag { position: 2, y: 9.0, state: FlagState::Unreviewed }]);
//! // Kept while view and size stay too:
//! let span = |i: usize| if hidden(i) { Span::EMPTY } else { Span::at(y[i]) };
//! let kept = Curve { pyramid: &pyramid, span: &span };
//! let axis = Axis::Time(&t);
//! let trace = Trace { axis, kept, flags: &flags, expected: None, band: None, repaired: None, filtered: None, gap: 3.5 };
//! let area = Rect::new(0, 0, 40, 9);
//! let Rect { width, height, .. } = TracePlot::plot_area(area);
//! let view = View::whole(axis);
//! let columns = Columns::new(&trace, Grid { view, y: YFit::All.range(&trace, view), width, height });
//! // Every frame:
//! let theme = Theme::choose(ColorDepth::Indexed256, false);
//! let mut buffer = Buffer::empty(area);
//! let cursor = Some(Cursor { position: 2, y: y[2] });
//! let (glyphs, layers, selection) = (Glyphs::Unicode, Layers::ALL, None);
//! TracePlot { columns: &columns, theme: &theme, glyphs, layers, cursor, selection }.render(area, &mut buffer);
//! assert!(buffer.content().iter().any(|cell| cell.symbol() == "●"));
//! ```

mod bars;
mod glyphs;
mod histogram;
mod memo;
mod overview;
mod paint;
mod rail;
mod recall;
mod residual;
mod sides;
mod steps;
mod ticks;
mod trace;
mod votes;

pub use crate::plot::{
    Axis, ColumnSummary, Columns, Curve, Flag, FlagState, Flags, Grid, LABEL_WIDTH, Pyramid, Span, Trace, ValueLabels,
    View, YFit, YScale, widened,
};
use crate::plot::{columns, dots, flags, labels, pyramid, scale, view};
pub use glyphs::Glyphs;
pub use histogram::HistogramPlot;
pub use memo::Memo;
pub use overview::Overview;
pub use rail::FlagRail;
pub use recall::RecallPlot;
pub use residual::ResidualPlot;
pub use sides::{SideMarks, SideRail};
pub use steps::StepPlot;
pub use ticks::{AxisLabels, TickSteps, tick_step};
pub use trace::{Cursor, Layers, TracePlot};
pub use votes::VotesPlot;

/// Columns left of a plot: labels of the y axis, and the axis.
pub const GUTTER: u16 = LABEL_WIDTH as u16 + 1;
