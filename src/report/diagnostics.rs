//! The diagnostics table: a row for every sample.

use std::io::Write;

use crate::error::{Error, Result};
use crate::method::Verdict;
use crate::session::table::{Column, cell, column, names, time_text, verdict_word, walk, write_row};
use crate::session::{Analysed, Session};
use crate::track::{Track, escape_formula};

/// The columns, in order.
pub const DIAGNOSTIC_COLUMNS: [Column; 8] = [
    column("row", "number of the data row, from 1"),
    column("time", "time of the row, as in the record"),
    column("channel", "name of the channel"),
    column("raw", "measured value"),
    column("verdict", "verdict in effect: `normal`, `outlier`, `suspect`, `unchecked` or `missing`"),
    column("expected", "value that the method expects"),
    column("tolerance", "distance from the expected value at which a sample is flagged"),
    column("clean", "value in the cleaned file"),
];

/// Writes the diagnostics table as CSV.
///
/// # Errors
/// When the input cannot be read again, or the table cannot be written.
pub fn diagnostics(track: &Track, session: &Session, analysed: &Analysed, out: &mut dyn Write) -> Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    write_row(&mut writer, &names(&DIAGNOSTIC_COLUMNS))?;
    walk(track, session, analysed, |row, cells, channel| {
        let position = channel.position(row);
        let judged = &channel.outcome.detection.judged;
        let flagged = position.is_some_and(|p| channel.outcome.verdict(p) == Verdict::Outlier);
        let clean = position.map_or_else(|| channel.fill(row), |p| channel.clean(p));
        let fields: [&str; 8] = [
            &(row + 1).to_string(),
            &time_text(track, row, cells),
            &escape_formula(channel.name),
            &cell(channel.raw(track, row, position)),
            verdict_word(channel.outcome, position),
            &cell(position.and_then(|p| judged.expected().get(p).map(|e| channel.outcome.detection.written(*e)))),
            &cell(position.and_then(|p| judged.tolerance(p)).filter(|h| *h > 0.0 || flagged)),
            &cell(clean),
        ];
        write_row(&mut writer, &fields)
    })?;
    writer.flush().map_err(Error::io("write", "the diagnostics"))
}
