//! The diagnostics table: a row for every sample.

use std::io::Write;

use rayon::prelude::*;

use crate::error::{Error, Result};
use crate::method::{Filtered, Verdict};
use crate::session::table::{Column, cell, column, names, time_text, verdict_word, walk, write_row};
use crate::session::{Analysed, Session, filtered};
use crate::stop::Stop;
use crate::track::{Track, escape_formula};

/// The columns, in order.
pub const DIAGNOSTIC_COLUMNS: [Column; 10] = [
    column("row", "number of the data row, from 1"),
    column("time", "time of the row, as in the record"),
    column("channel", "name of the channel"),
    column("raw", "measured value"),
    column("verdict", "verdict in effect: `normal`, `outlier`, `suspect`, `unchecked` or `missing`"),
    column("expected", "value that the method expects"),
    column("tolerance", "distance from the expected value at which a sample is flagged"),
    column("clean", "value in the cleaned file"),
    column("filtered", "value of the method's model with the samples that are not wild; empty where it has none"),
    column("filtered_deviation", "standard deviation of `filtered`; empty where the model has none"),
];

/// Writes the diagnostics table as CSV.
///
/// # Errors
/// When the input cannot be read again, or the table cannot be written.
pub fn diagnostics(track: &Track, session: &Session, analysed: &Analysed, out: &mut dyn Write) -> Result<()> {
    let filtered = analysed.channels.par_iter().map(|channel| filtered(track, channel, &Stop::never()));
    let filtered: Vec<Option<Filtered>> = filtered.collect::<Result<_>>()?;
    let mut writer = csv::Writer::from_writer(out);
    write_row(&mut writer, &names(&DIAGNOSTIC_COLUMNS))?;
    walk(track, session, analysed, |row, cells, channel| {
        let position = channel.position(row);
        let judged = &channel.outcome.detection.judged;
        let flagged = position.is_some_and(|p| channel.outcome.verdict(p) == Verdict::Outlier);
        let clean = position.map_or_else(|| channel.fill(row), |p| channel.clean(p));
        let own = filtered.get(channel.plan).and_then(Option::as_ref).zip(position);
        let smooth = own.and_then(|(filtered, p)| filtered.value.get(p).copied()).filter(|value| value.is_finite());
        let fields: [&str; 10] = [
            &(row + 1).to_string(),
            &time_text(track, row, cells),
            &escape_formula(channel.name),
            &cell(channel.raw(track, row, position)),
            verdict_word(channel.outcome, position),
            &cell(position.and_then(|p| judged.expected().get(p).map(|e| channel.outcome.detection.written(*e)))),
            &cell(position.and_then(|p| judged.tolerance(p)).filter(|h| *h > 0.0 || flagged)),
            &cell(clean),
            &cell(smooth.map(|value| channel.rounded(value))),
            &cell(own.and_then(|(filtered, p)| filtered.deviation.get(p).copied())),
        ];
        write_row(&mut writer, &fields)
    })?;
    writer.flush().map_err(Error::io("write", "the diagnostics"))
}
