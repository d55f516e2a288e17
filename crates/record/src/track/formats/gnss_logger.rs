//! Android GNSS logs (GnssLogger, GPSTest): rows of several kinds, each with its names in a comment at the start.

use super::{Format, PLAIN};
use crate::error::Result;
use crate::track::Aside;
use crate::track::view::{Cell, Field, Kinds, Piece, Row, Sheet, SourceLine, Want, lines};

mod satellites;
mod times;

use satellites::Satellites;
use times::Times;

pub(super) const FORMAT: Format = Format {
    name: "Android GNSS log",
    about: "measurements, positions and sensors of phones, as GnssLogger and GPSTest write them",
    known_by: "comments `# Raw,` or `# Fix,Provider` with the names of a kind of rows",
    maps: "a table for each kind of rows (`--table`), by default the one with the most rows; time of `Raw` in GPS time, from `TimeNanos` and \
           the biases of the clock, of other kinds the time since 1970, or since the phone was started where that is finer; a \
           track for each satellite and signal, or for each provider; units from the names; states are not channels",
    known: |text| {
        let first = text.lines().take(200).filter_map(names_of);
        first.into_iter().any(|line| {
            ["Raw,ElapsedRealtimeMillis,", "Raw,utcTimeMillis,", "Fix,Provider,"]
                .iter()
                .any(|start| line.starts_with(start))
        })
    },
    sheet: Some(sheet),
    utc: true,
    ..PLAIN
};

/// Kinds of rows without measurements.
const NO_TABLES: [&str; 2] = ["Nav", "NMEA"];

/// What a comment says after its mark.
fn names_of(line: &str) -> Option<&str> {
    line.trim_start().strip_prefix('#').map(str::trim)
}

/// A kind of rows: its name, and those of its columns.
struct Kind {
    name: String,
    columns: Vec<String>,
}

/// The kinds that the comments tell.
fn kinds(body: &[u8]) -> Vec<Kind> {
    let mut found: Vec<Kind> = Vec::new();
    for line in lines(body).filter(|l| l.all.bytes.trim_ascii_start().starts_with(b"#")) {
        let text = line.all.decoded();
        let mut cells = names_of(&text).unwrap_or("").split(',').map(|c| c.trim().to_owned());
        let name = cells.next().unwrap_or_default();
        let columns: Vec<String> = cells.collect();
        let word = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric());
        if word && columns.len() > 1 && !found.iter().any(|k| k.name == name) {
            found.push(Kind { name, columns });
        }
    }
    found
}

fn sheet(body: &[u8], want: Want) -> Result<Sheet> {
    let mut sheet = Sheet { timed: true, ..Sheet::default() };
    let known = kinds(body);
    let of_line = |line: &SourceLine<'_>| {
        let first = line.all.bytes.split(|b| *b == b',').next().unwrap_or_default();
        known.iter().find(|k| k.name.as_bytes() == first && !NO_TABLES.contains(&k.name.as_str()))
    };
    let mut counted = Kinds::default();
    lines(body).filter_map(|l| of_line(&l)).for_each(|kind| counted.count(&kind.name));
    let Some(chosen) = counted.chosen(want, &[], &mut sheet.said)?.map(str::to_owned) else { return Ok(sheet) };
    let Some(kind) = known.iter().find(|k| k.name == chosen) else { return Ok(sheet) };
    let rows: Vec<(u64, Vec<Piece<'_>>)> = lines(body)
        .filter(|l| of_line(l).is_some_and(|k| k.name == chosen))
        .map(|l| (l.number, l.all.split(b',').into_iter().skip(1).take(kind.columns.len()).collect()))
        .collect();
    let cells: Vec<&[Piece<'_>]> = rows.iter().map(|(_, cells)| cells.as_slice()).collect();
    let times = Times::of(kind, &cells);
    let satellites = Satellites::of(kind, &cells, &times);
    // The time stands first, then what tells the tracks apart, then the columns as they are.
    sheet.fields = vec![times.field(), Field::new("satellite", "").aside(Aside::Id)];
    sheet.fields.extend(kind.columns.iter().map(|name| field(name)));
    let provider = kind.columns.iter().position(|c| c == "Provider");
    sheet.track = match (&satellites, provider) {
        (Some(_), _) => Some(1),
        (None, Some(at)) => Some(at + 2).filter(|_| differ(&cells, at)),
        _ => None,
    };
    sheet.said.extend(times.said());
    for (row, (line, pieces)) in rows.iter().enumerate() {
        let mut made = vec![(0, times.cell(pieces))];
        made.extend(satellites.as_ref().map(|s| (1, Cell::Made(s.label(row)))));
        let own = pieces.iter().enumerate().filter(|(at, _)| !times.is(*at));
        made.extend(own.map(|(at, piece)| (at + 2, cell(piece))));
        sheet.rows.push(Row { line: *line, cells: made });
    }
    sheet.without_unused();
    Ok(sheet)
}

fn cell(piece: &Piece<'_>) -> Cell {
    if piece.bytes.is_empty() { Cell::Missing(piece.range()) } else { Cell::At(piece.range()) }
}

/// True where the cells of a column are not all the same.
fn differ(rows: &[&[Piece<'_>]], at: usize) -> bool {
    let mut texts = rows.iter().filter_map(|r| r.get(at)).map(|c| c.bytes);
    texts.next().is_some_and(|first| texts.any(|t| t != first))
}

/// Ends of names, and the units that they tell.
const UNITS: [(&str, &str); 19] = [
    ("MetersPerSecond", "m/s"),
    ("NanosPerSecond", "ns/s"),
    ("RadPerSec", "rad/s"),
    ("MicroT", "uT"),
    ("Mps2", "m/s2"),
    ("Mps", "m/s"),
    ("Meters", "m"),
    ("Degrees", "deg"),
    ("Deg", "deg"),
    ("DbHz", "dB-Hz"),
    ("Db", "dB"),
    ("Hz", "Hz"),
    ("Nanos", "ns"),
    ("Millis", "ms"),
    ("Latitude", "deg"),
    ("Longitude", "deg"),
    ("Altitude", "m"),
    ("Speed", "m/s"),
    ("Accuracy", "m"),
];

/// Beginnings and wholes of names that tell states, counts and other times.
fn aside(name: &str) -> Option<Aside> {
    let ends = |end: &str| name.ends_with(end);
    match name {
        "Svid" | "ConstellationType" | "Provider" | "CodeType" | "SignalIndex" => Some(Aside::Id),
        "MultipathIndicator" | "LeapSecond" | "UsedInFix" | "MockLocation" => Some(Aside::Quality),
        "SignalCount" | "CarrierFrequencyHz" => Some(Aside::Quality),
        _ if ends("State") || name.starts_with("Has") || ends("DiscontinuityCount") => Some(Aside::Quality),
        _ if times::is_time(name) => Some(Aside::Time),
        _ => None,
    }
}

fn field(name: &str) -> Field {
    let unit = UNITS.iter().find(|(end, _)| name.ends_with(end)).map_or("", |(_, unit)| unit);
    let field = Field::new(name, unit);
    match aside(name) {
        Some(aside) => field.aside(aside),
        None => field,
    }
}
