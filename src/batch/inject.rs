//! `inject`: known wild points in a record, with truth and the raw values beside.

use std::io::Write;
use std::path::Path;

use serde::Serialize;

use super::{Ending, print, print_json};
use crate::cli::InjectArgs;
use crate::error::{Error, Result};
use crate::experiment::{Injection, inject};
use crate::track::{
    CellChange, Cells, Channel, DASH, NewColumn, NewRow, Outputs, Series, Source, Track, for_each_row, load, printable,
    widen,
};

/// What was done, for programs.
#[derive(Serialize)]
struct Injected<'a> {
    channel: &'a str,
    raw_column: &'a str,
    truth_column: &'a str,
    seed: u64,
    sigma: f64,
    isolated: usize,
    patches: usize,
    wild: usize,
    steps: usize,
}

pub(super) fn run(args: &InjectArgs, out: &mut dyn Write) -> Result<Ending> {
    let track = load(&Source::of(&args.file)?, &args.load.options(None))?;
    if args.json && args.output == Path::new(DASH) {
        return Err(Error::usage("--json and -o - both mean standard output", "give the output a name"));
    }
    let channel = channel_of(&track)?;
    let (raw, truth) = (format!("{}_raw", channel.name), format!("{}_truth", channel.name));
    if let Some(there) = track.columns.iter().find(|c| c.name == raw || c.name == truth) {
        let what = format!("there is a column `{}` already", there.name);
        return Err(Error::input(&args.file, what, "inject into the original record, or into another channel"));
    }
    let series = channel.series(&track.time);
    let was_wild = |row: usize| track.truth.as_ref().is_some_and(|t| t.get(row).copied().unwrap_or(false));
    let already: Vec<usize> = (0..series.len()).filter(|&i| was_wild(series.row(i))).collect();
    let injection = inject::inject(&series, &already, &args.plan())?;
    let changes = changes(&track, channel, &series, &injection)?;
    let mut wild = vec![false; track.rows];
    injection.wild.iter().for_each(|&i| wild[series.row(i)] = true);
    let raw_cell =
        |_: usize, cells: &Cells<'_>| String::from_utf8_lossy(cells.raw(channel.column).trim_ascii()).into_owned();
    let truth_cell = |row: usize, _: &Cells<'_>| u8::from(wild[row] || was_wild(row)).to_string();
    let no_row = |_: &NewRow| String::new();
    let columns = [
        NewColumn { name: raw.clone(), cell: &raw_cell, new_row: &no_row },
        NewColumn { name: truth.clone(), cell: &truth_cell, new_row: &no_row },
    ];
    let inputs: [&Path; 1] = [&args.file];
    let mut files = Outputs::new(args.force, &inputs).or_standard_output();
    files.stage(&args.output, |w| widen(&track, &changes, &columns, w))?;
    files.commit()?;
    let told = Injected {
        channel: &channel.name,
        raw_column: &raw,
        truth_column: &truth,
        seed: args.seed,
        sigma: injection.sigma,
        isolated: injection.isolated,
        patches: injection.patches,
        wild: injection.wild.len(),
        steps: injection.steps.len(),
    };
    let words = told.text(track.truth.is_some());
    match (args.output == Path::new(DASH), args.json) {
        (true, _) => print(&mut std::io::stderr(), &words),
        (false, true) => print_json(out, &told),
        (false, false) => print(out, &words),
    }
}

impl Injected<'_> {
    fn text(&self, two_truths: bool) -> String {
        let mut text = format!(
            "{}: {} outliers added ({} isolated, {} runs) and {} steps; noise scale {}\n  raw values in `{}`, \
             truth in `{}`\n",
            printable(self.channel),
            self.wild,
            self.isolated,
            self.patches,
            self.steps,
            self.sigma,
            printable(self.raw_column),
            printable(self.truth_column)
        );
        if two_truths {
            text.push_str("  the record had a truth column already: name the new one with --truth\n");
        }
        text
    }
}

/// The one channel that was named, or the first.
fn channel_of(track: &Track) -> Result<&Channel> {
    track.channels.first().ok_or_else(|| {
        Error::usage("the record has no channel to add outliers to", "name a column of numbers with --channel")
    })
}

/// The cells that change, with as many decimals as the channel has anywhere.
fn changes(track: &Track, channel: &Channel, series: &Series<'_>, injection: &Injection) -> Result<Vec<CellChange>> {
    let unit = decimals(track, channel.column)?.map(|d| (0..d).fold(1.0, |unit, _| unit * 10.0));
    let change = |i: usize| {
        let value = series.y[i] + injection.added[i];
        let rounded = unit.map_or(value, |unit| (value * unit).round() / unit);
        // A change too small for the decimals of the file is still a change.
        #[expect(clippy::float_cmp, reason = "whether the rounding took the change away")]
        let value = if rounded == series.y[i] || !rounded.is_finite() { value } else { rounded };
        #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
        let row = series.row(i) as u32;
        CellChange { row, column: channel.column, value: Some(value) }
    };
    Ok((0..series.len()).filter(|&i| injection.added[i] != 0.0).map(change).collect())
}

/// The largest number of decimals in a column; none when a cell has an exponent, or more than doubles can tell apart.
fn decimals(track: &Track, column: usize) -> Result<Option<usize>> {
    let mut most = Some(0);
    for_each_row(track, |_, cells| {
        let text = cells.text(column);
        let number = text.bytes().any(|b| b.is_ascii_digit());
        let of = match text.rfind(if track.dialect.decimal_comma { ',' } else { '.' }) {
            Some(at) => text.len() - at - 1,
            None => 0,
        };
        if number {
            most = most.filter(|_| of <= 12 && !text.contains(['e', 'E'])).map(|m: usize| m.max(of));
        }
        Ok(())
    })?;
    Ok(most)
}
