//! What a stream tells the user beside its output.

use std::io::Write;

use crate::method::Verdict;
use crate::track::printable;

/// What is told on standard error. Nobody may be listening: what goes wrong there ends nothing.
pub(super) struct Notes<'a> {
    err: &'a mut dyn Write,
    quiet: bool,
}

impl<'a> Notes<'a> {
    /// Notes to `err`; none at all when `quiet`.
    pub(super) fn new(err: &'a mut dyn Write, quiet: bool) -> Self {
        Self { err, quiet }
    }

    /// Tells one line.
    pub(super) fn tell(&mut self, text: &str) {
        if !self.quiet {
            let _ = writeln!(self.err, "wildpoint: {}", printable(text));
        }
    }
}

/// How many rows are what, by the last word about each.
#[derive(Debug, Default)]
pub(super) struct Counts {
    outliers: u64,
    suspects: u64,
    unchecked: u64,
    /// Rows without a value.
    pub(super) missing: u64,
    /// Rows whose time is not after the one before.
    pub(super) untimely: u64,
    /// Rows that cannot be read.
    pub(super) unreadable: u64,
    /// Models that were lost.
    pub(super) restarts: u64,
}

impl Counts {
    /// One more row has this verdict; one fewer has `before`, when it was said of the same row.
    pub(super) fn say(&mut self, verdict: Verdict, before: Option<Verdict>) {
        let mut of = |verdict: Verdict, change: fn(u64) -> u64| match verdict {
            Verdict::Outlier => self.outliers = change(self.outliers),
            Verdict::Suspect => self.suspects = change(self.suspects),
            Verdict::Unchecked => self.unchecked = change(self.unchecked),
            Verdict::Normal | Verdict::Missing => {}
        };
        of(verdict, |n| n + 1);
        if let Some(before) = before {
            of(before, |n| n - 1);
        }
    }

    /// A line about all of them.
    pub(super) fn text(&self, rows: u64) -> String {
        let c = self;
        let mut text = format!("{} rows: {} outliers", rows, c.outliers);
        for (count, what) in [
            (c.suspects, "suspects"),
            (c.unchecked, "unchecked"),
            (c.missing, "without a value"),
            (c.untimely, "with a time that is not after the one before"),
            (c.unreadable, "unreadable"),
            (c.restarts, "restarts"),
        ] {
            if count > 0 {
                text += &format!(", {count} {what}");
            }
        }
        text
    }
}
