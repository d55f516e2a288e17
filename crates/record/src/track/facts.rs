//! What a file that stores columns says of its table besides the text of its cells.

use super::style::Style;
use super::{Aside, LoadOptions, Track};

/// What such a file says of its table.
#[derive(Debug, Default)]
pub(crate) struct Facts {
    /// The columns, in order.
    pub(crate) columns: Vec<ColumnFacts>,
    /// The name of the column of the time, where the file tells it.
    pub(crate) time: Option<String>,
    /// What is to be said, in a line each.
    pub(crate) said: Vec<String>,
}

/// What it says of a column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ColumnFacts {
    /// Its unit, where the file tells it.
    pub(crate) unit: Option<String>,
    pub(crate) decimals: Decimals,
    /// Why it is not a channel, where it is none.
    pub(crate) aside: Option<Aside>,
}

/// How many decimals its numbers have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Decimals {
    /// As many as its cells show.
    AsShown,
    /// As many as each number needs: no digit of it was chosen by somebody.
    AsNeeded,
    /// A number of them.
    So(usize),
}

impl Facts {
    /// Takes the decimals of the columns.
    pub(crate) fn settle(&self, track: &mut Track) {
        for (style, column) in track.dialect.styles.iter_mut().zip(&self.columns) {
            match column.decimals {
                Decimals::AsShown => {}
                Decimals::AsNeeded => *style = None,
                Decimals::So(decimals) => *style = Some(Style::with_decimals(decimals)),
            }
        }
    }

    /// Completes what the user told by the time.
    pub(crate) fn with_time(&self, options: LoadOptions) -> LoadOptions {
        LoadOptions { time: options.time.or_else(|| self.time.clone()), ..options }
    }
}
