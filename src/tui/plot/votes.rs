//! How many methods flag each sample.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::bars::{Bar, Bars};
use super::columns::Columns;
use super::glyphs::Glyphs;
use super::paint::{Paint, right_of_margin};
use super::pyramid::{Pyramid, Span};
use super::scale::YScale;
use crate::session::Ballot;
use crate::stop::{Stop, Stopped};
use crate::tui::theme::Theme;

/// The widget of votes: the most votes of a sample in each column, with a dotted line at half of the methods.
#[derive(Clone)]
pub struct VotesPlot<'a> {
    /// The votes.
    pub ballot: &'a Ballot,
    /// Their extremes, from [`VotesPlot::pyramid`].
    pub pyramid: &'a Pyramid,
    /// Tells which samples each column holds.
    pub columns: &'a Columns,
    /// Position of the sample under the cursor.
    pub cursor: Option<usize>,
    /// Styles.
    pub theme: &'a Theme,
    /// Characters.
    pub glyphs: Glyphs,
}

fn span(ballot: &Ballot, position: usize) -> Span {
    Span::at(f64::from(u16::try_from(ballot.votes(position)).unwrap_or(u16::MAX)))
}

impl VotesPlot<'_> {
    /// The extremes of the votes.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for them any more.
    pub fn pyramid(ballot: &Ballot, stop: &Stop) -> Result<Pyramid, Stopped> {
        Pyramid::build_spans_unless(ballot.samples(), |i| span(ballot, i), stop)
    }
}

impl Widget for VotesPlot<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = area.intersection(*buffer.area());
        let count = |n: usize| f64::from(u16::try_from(n).unwrap_or(u16::MAX));
        let (all, half) = (count(self.ballot.methods()), count(self.ballot.half()));
        let scale = YScale::new(0.0, all.max(1.0), area.height);
        let mut paint = Paint::new(buffer, area);
        for row in 0..area.height {
            paint.margin(row, "", self.glyphs.vertical(), self.theme.dim);
        }
        for value in [0.0, all, half] {
            if let Some(row) = scale.row(value) {
                paint.margin(row, &format!("{value}"), self.glyphs.tick(), self.theme.dim);
            }
        }
        let mut paint = Paint::new(buffer, right_of_margin(area));
        (0..paint.height()).for_each(|row| paint.clear_row(row));
        let cursor = self.cursor.and_then(|position| self.columns.column_of(position));
        let look = Bars { theme: self.theme, glyphs: self.glyphs, line: scale.row(half) };
        for column in 0..paint.width().min(self.columns.grid().width) {
            let most = self.pyramid.span_over(|i| span(self.ballot, i), self.columns.positions(column));
            // No vote is no bar: a row of stubs would hide single votes.
            let share = (!most.is_empty() && most.high > 0.0 && all > 0.0).then(|| most.high / all);
            let bar = Bar { share, over: most.high >= half, beyond: false };
            look.column(&mut paint, column, bar, cursor == Some(column));
        }
    }
}
