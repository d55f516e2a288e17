//! An input of a format, and what must be understood of it.

use wildpoint_record::track::{CellChange, Changes, ColumnKind, LoadOptions, Source, Track, load, rewrite};

/// Rows of an input.
pub(crate) const ROWS: usize = 40;
/// The row whose cell is repaired, and the value that it gets.
const REPAIRED: usize = 7;
const VALUE: f64 = 123.456;

/// Makes the text of a file from the cells of the channel that is repaired, by row.
pub(crate) type Make = Box<dyn Fn(&dyn Fn(usize) -> String) -> String>;

pub(crate) struct Case {
    pub(crate) name: &'static str,
    /// The name of the format in the registry.
    pub(crate) format: &'static str,
    pub(crate) make: Make,
    /// The channel whose cells the text is made from, and its unit.
    pub(crate) channel: &'static str,
    pub(crate) unit: &'static str,
    /// How the label of the first time begins.
    pub(crate) start: &'static str,
    /// Seconds between two samples.
    pub(crate) step: f64,
    /// Columns that are not channels.
    pub(crate) asides: &'static [&'static str],
    /// A column and how many of its cells hold no value.
    pub(crate) missing: (&'static str, usize),
    /// Rows of the channel.
    pub(crate) rows: usize,
    /// How the repaired cell is written.
    pub(crate) written: &'static str,
    /// Line ends are those of Windows.
    pub(crate) windows: bool,
    /// The bytes are Latin-1.
    pub(crate) latin1: bool,
    pub(crate) table: Option<usize>,
}

pub(crate) fn case(
    name: &'static str,
    format: &'static str,
    make: impl Fn(&dyn Fn(usize) -> String) -> String + 'static,
) -> Case {
    Case {
        name,
        format,
        make: Box::new(make),
        channel: "",
        unit: "",
        start: "2021-03-04 10:00:00",
        step: 60.0,
        asides: &[],
        missing: ("", 0),
        rows: ROWS,
        written: "123.46",
        windows: false,
        latin1: false,
        table: None,
    }
}

/// A smooth curve with a little noise, the same in every run.
pub(crate) fn value(row: usize) -> f64 {
    let noise = (row * 7919 % 101) as f64 / 500.0;
    100.0 + 10.0 * (row as f64 / 9.0).sin() + noise
}

/// Another channel.
pub(crate) fn other(row: usize) -> f64 {
    7.0 + (row * row % 13) as f64 / 4.0
}

/// 2021-03-04 10:00:00 and `seconds` more, as year, month, day, hour, minute, second.
pub(crate) fn moment(seconds: usize) -> [usize; 6] {
    let all = 10 * 3600 + seconds;
    [2021, 3, 4 + all / 86_400, all / 3600 % 24, all / 60 % 60, all % 60]
}

/// The moment of a row, a minute after that before.
pub(crate) fn minute(row: usize) -> [usize; 6] {
    moment(60 * row)
}

pub(crate) fn iso(row: usize) -> String {
    let [y, mo, d, h, m, s] = minute(row);
    format!("{y}-{mo:02}-{d:02} {h:02}:{m:02}:{s:02}")
}

/// `head` above the rows.
pub(crate) fn table(head: &str, row: impl Fn(usize) -> String) -> String {
    (0..ROWS).fold(head.to_owned(), |text, i| text + &row(i) + "\n")
}

fn bytes(case: &Case, cell: &dyn Fn(usize) -> String) -> Vec<u8> {
    let text = (case.make)(cell);
    let text = if case.windows { text.replace('\n', "\r\n") } else { text };
    if case.latin1 { text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect() } else { text.into_bytes() }
}

/// The input as it is.
pub(crate) fn bytes_of(case: &Case) -> Vec<u8> {
    bytes(case, &|i| digits(i, if case.written.contains(',') { ',' } else { '.' }))
}

fn loaded(bytes: &[u8], case: &Case) -> Result<Track, String> {
    let options = LoadOptions { table: case.table, ..LoadOptions::default() };
    load(&Source::BuiltIn { name: "test", bytes: bytes.into() }, &options).map_err(|e| e.to_string())
}

fn digits(row: usize, point: char) -> String {
    format!("{:.2}", value(row)).replace('.', &point.to_string())
}

/// What is understood or written wrongly; none where all is right.
pub(crate) fn wrong(case: &Case) -> Option<String> {
    let point = if case.written.contains(',') { ',' } else { '.' };
    let old = bytes(case, &|i| digits(i, point));
    let track = match loaded(&old, case) {
        Ok(track) => track,
        Err(e) => return Some(e),
    };
    if !track.notes.iter().any(|n| n.starts_with(&format!("recognised as {}:", case.format))) {
        return Some(format!("not recognised: {:?}", track.notes));
    }
    misread(case, &track).or_else(|| miswritten(case, &track, point))
}

fn misread(case: &Case, track: &Track) -> Option<String> {
    let Some(channel) = track.channel(case.channel) else {
        let names: Vec<&str> = track.channels.iter().map(|c| c.name.as_str()).collect();
        return Some(format!("no channel {}: {names:?}; notes {:?}", case.channel, track.notes));
    };
    let series = channel.series(&track.time);
    let first = track.time.full_label(series.t.first().copied().unwrap_or(f64::NAN));
    let values = series.len() == case.rows && series.y.iter().enumerate().all(|(i, y)| i != 3 || near(*y, 3, case));
    if !first.starts_with(case.start) || (series.interval - case.step).abs() > 1e-6 * case.step || !values {
        return Some(format!(
            "{} samples from {first} every {} s; {:?}; notes {:?}",
            series.len(),
            series.interval,
            series.y.get(3),
            track.notes
        ));
    }
    if channel.unit != case.unit {
        return Some(format!("the unit of {} is `{}`", channel.name, channel.unit));
    }
    for aside in case.asides {
        match track.columns.iter().find(|c| c.name == *aside) {
            None => return Some(format!("no column {aside}: {:?}", names(track))),
            Some(column) if column.kind == ColumnKind::Number => return Some(format!("{aside} is a channel")),
            Some(_) => {}
        }
    }
    let (column, count) = case.missing;
    let found = track.columns.iter().find(|c| c.name == column).map(|c| c.missing);
    (!column.is_empty() && found != Some(count))
        .then(|| format!("{column}: {found:?} cells are missing; {:?}", names(track)))
}

fn names(track: &Track) -> Vec<&str> {
    track.columns.iter().map(|c| c.name.as_str()).collect()
}

/// The fourth sample is the one that was written; in a track among others it may be that of another row.
fn near(y: f64, row: usize, case: &Case) -> bool {
    case.rows < ROWS || (y - (value(row) * 100.0).round() / 100.0).abs() < 1e-9
}

fn miswritten(case: &Case, track: &Track, point: char) -> Option<String> {
    let channel = track.channel(case.channel)?;
    // The row in the order of the table, by the order of the time.
    let series = channel.series(&track.time);
    let position = if case.rows < ROWS { return None } else { REPAIRED };
    let row = u32::try_from(series.row(position)).ok()?;
    let cells = vec![CellChange { row, column: channel.column, value: Some(VALUE) }];
    let mut out = Vec::new();
    if let Err(e) = rewrite(track, &Changes { cells, rows: Vec::new() }, &mut out) {
        return Some(e.to_string());
    }
    let written = |i: usize| if i == REPAIRED { case.written.to_owned() } else { digits(i, point) };
    let expected = bytes(case, &written);
    (out != expected).then(|| {
        let (out, expected) = (String::from_utf8_lossy(&out), String::from_utf8_lossy(&expected));
        let at = out.lines().zip(expected.lines()).find(|(a, b)| a != b);
        format!("written otherwise: {at:?}")
    })
}
