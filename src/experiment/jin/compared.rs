//! What both examples of \[002\] compare: Wright's criterion alone, and after a least-squares trend.

use crate::experiment::reproduction::{Cell, Runs, Table};
use crate::experiment::shown::Picture;
use crate::experiment::trial::Keys;
use crate::session::Preset;

/// The criterion alone.
pub(in crate::experiment) const ALONE: &str = "wright";
/// After a trend.
pub(in crate::experiment) const TREND: &str = "trend-wright";

/// A method as a figure of the document shows it.
#[derive(Debug, Clone, Copy)]
pub(in crate::experiment) struct Compared {
    /// Id of the method.
    pub(in crate::experiment) method: &'static str,
    /// The figure with its result.
    pub(in crate::experiment) figure: &'static str,
    /// What the document says of it.
    pub(in crate::experiment) said: &'static str,
    /// Title of the picture that stands for its figures.
    pub(in crate::experiment) title: &'static str,
}

/// Their pictures, with the paper's settings and these keys.
pub(in crate::experiment) fn pictures(both: &[Compared; 2], keys: Keys) -> [Picture; 2] {
    both.map(|compared| Picture { title: compared.title, method: compared.method, preset: Preset::Paper, keys })
}

/// A count over the runs: its name, and its figure for a method.
pub(in crate::experiment) struct Count<'a> {
    /// Heading of the column.
    pub(in crate::experiment) name: &'static str,
    /// The number.
    pub(in crate::experiment) of: &'a dyn Fn(Runs<'_>, &str) -> f64,
    /// Its decimals.
    pub(in crate::experiment) decimals: usize,
}

/// The figures as counts, a row for each method.
pub(in crate::experiment) fn table(title: String, both: &[Compared; 2], counts: &[Count<'_>], runs: Runs<'_>) -> Table {
    let row = |compared: &Compared| {
        let words = [compared.method, compared.figure, compared.said].map(Cell::text);
        let numbers = counts.iter().map(|count| Cell::number((count.of)(runs, compared.method), count.decimals));
        words.into_iter().chain(numbers).collect()
    };
    let names = counts.iter().map(|count| count.name);
    let columns = ["method", "figure", "the document"].into_iter().chain(names).collect();
    Table { title, columns, rows: both.iter().map(row).collect() }
}
