//! The filtered track, ready for drawing.

use super::{Pyramid, Span};
use crate::method::Filtered;
use crate::stop::{Stop, Stopped};

/// The filtered values, ready for drawing.
#[derive(Debug)]
pub struct FilteredTrack {
    /// The values and their deviations.
    pub values: Filtered,
    /// Their extremes.
    pub pyramid: Pyramid,
}

impl FilteredTrack {
    /// Arranges the values.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for it any more.
    pub fn new(values: Filtered, stop: &Stop) -> Result<Self, Stopped> {
        let span = |i: usize| span(&values, i);
        let pyramid = Pyramid::build_spans_unless(values.value.len(), span, stop)?;
        Ok(Self { values, pyramid })
    }

    /// The value of a sample, for drawing.
    #[must_use]
    pub fn span(&self, i: usize) -> Span {
        span(&self.values, i)
    }
}

fn span(values: &Filtered, i: usize) -> Span {
    values.value.get(i).copied().filter(|value| value.is_finite()).map_or(Span::EMPTY, Span::at)
}
