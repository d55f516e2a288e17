//! The cells of a row, as other parts of the program see them.

use std::borrow::Cow;

use super::Encoding;
use super::text::decoded;
use super::tokens::{Span, inner};

/// The cells of one data row.
#[derive(Debug)]
pub struct Cells<'a> {
    pub(crate) record: &'a [u8],
    pub(crate) spans: &'a [Span],
    pub(crate) quote: Option<u8>,
    pub(crate) encoding: Encoding,
    /// Line of the file (from 1) where the row starts.
    pub line: u64,
}

impl<'a> Cells<'a> {
    /// How many cells the row has; fewer or more than there are columns in a ragged row.
    #[must_use]
    pub fn len(&self) -> usize {
        self.spans.len()
    }

    /// True for a row without cells.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// The bytes of a cell as they are, with quotes and padding; empty where the row is too short. UTF-16 files
    /// give UTF-8.
    #[must_use]
    pub fn raw(&self, column: usize) -> &'a [u8] {
        self.spans.get(column).map_or(&[], |span| span.of(self.record))
    }

    /// The text of a cell without padding and quotes; empty where the row is too short.
    #[must_use]
    pub fn text(&self, column: usize) -> Cow<'a, str> {
        let raw = self.raw(column);
        let inner = inner(raw, self.quote);
        let text = decoded(&raw[inner.clone()], self.encoding);
        match self.quote {
            Some(q) if raw.trim_ascii().len() > inner.len() && raw[inner].contains(&q) => {
                let q = char::from(q);
                Cow::Owned(text.replace(&format!("{q}{q}"), &q.to_string()))
            }
            _ => text,
        }
    }
}
