//! SP3: orbits and clocks of GNSS satellites, a block for each epoch (versions a to d).

use super::{Format, PLAIN};
use crate::error::Result;
use crate::track::Aside;
use crate::track::calendar::{Date, SECOND};
use crate::track::view::{Cell, Field, Nothing, Piece, Row, Sheet, SourceLine, Want, lines, stamp};

pub(super) const FORMAT: Format = Format {
    name: "SP3",
    about: "orbits and clocks of GNSS satellites, a block for each epoch",
    known_by: "`#aP` to `#dV` and a year at the start",
    maps: "a track for each satellite; `P` and `V` records of one epoch in one row: `x`, `y`, `z` in km, `clock` in µs, \
           velocities in dm/s; 0.000000 and 999999.999999 are no values; precisions are no channels",
    known: |text| {
        let head = text.as_bytes();
        matches!(head, [b'#', b'a'..=b'd', b'P' | b'V', year @ ..] if year.len() > 4 && year[..4].iter().all(u8::is_ascii_digit))
    },
    sheet: Some(sheet),
    utc: true,
    ..PLAIN
};

/// The columns after the time and the satellite: of a position record, of its precisions, of a velocity record.
const POSITION: usize = 2;
const PRECISION: usize = 6;
const VELOCITY: usize = 10;

/// Columns of the text (from 0) in which the four values of a record stand, and the four precisions of a position.
const VALUES: [(usize, usize); 4] = [(4, 18), (18, 32), (32, 46), (46, 60)];
const PRECISIONS: [(usize, usize); 4] = [(61, 63), (64, 66), (67, 69), (70, 73)];

/// A clock that is not known.
const NO_CLOCK: f64 = 999_999.0;

fn fields() -> Vec<Field> {
    let zero = || Nothing::text("0.000000");
    let clock = |name, unit| Field::new(name, unit).nothing(Nothing::text("999999.999999"));
    let mut fields = vec![Field::new("time", ""), Field::new("satellite", "").aside(Aside::Id)];
    fields.extend(["x", "y", "z"].map(|name| Field::new(name, "km").nothing(zero())));
    fields.push(clock("clock", "us"));
    fields.extend(["x_sdev", "y_sdev", "z_sdev", "clock_sdev"].map(|name| Field::new(name, "").aside(Aside::Quality)));
    fields.extend(["vx", "vy", "vz"].map(|name| Field::new(name, "dm/s").nothing(zero())));
    fields.push(clock("clock_rate", "1e-4 us/s"));
    fields
}

#[derive(Default)]
struct Reader {
    sheet: Sheet,
    epoch: Option<String>,
    /// The first row of the epoch.
    first: usize,
}

fn sheet(body: &[u8], _: Want) -> Result<Sheet> {
    let sheet = Sheet { fields: fields(), timed: true, track: Some(1), fixed_width: true, ..Sheet::default() };
    let mut reader = Reader { sheet, ..Reader::default() };
    for line in lines(body) {
        match line.all.bytes.first() {
            Some(b'*') => {
                reader.epoch = epoch(line.all.after(1));
                reader.first = reader.sheet.rows.len();
            }
            Some(b'P') => reader.record(line, POSITION),
            Some(b'V') => reader.record(line, VELOCITY),
            Some(b'%') if line.all.bytes.starts_with(b"%c") => reader.system(line),
            _ => {}
        }
    }
    let mut sheet = reader.sheet;
    sheet.without_unused();
    Ok(sheet)
}

impl Reader {
    /// The time system stands in the first `%c` line.
    fn system(&mut self, line: SourceLine<'_>) {
        let system = line.all.words().get(3).map(|w| w.text().to_owned()).filter(|s| s != "ccc");
        if let Some(system) = system.filter(|_| self.sheet.said.is_empty()) {
            self.sheet.said.push(format!("times are those of {system}, as the file writes them"));
        }
    }

    fn record(&mut self, line: SourceLine<'_>, from: usize) {
        let Some(epoch) = self.epoch.clone() else { return };
        let satellite = line.all.part(1..4).decoded().trim_end().replace(' ', "0");
        if satellite.is_empty() || line.all.bytes.len() < 18 {
            return;
        }
        let is_it = |row: &Row| row.cells.iter().any(|(f, c)| *f == 1 && matches!(c, Cell::Made(s) if *s == satellite));
        let found = self.sheet.rows[self.first..].iter().position(|row| is_it(row) && !row.has(from));
        let row = found.map(|at| self.first + at).unwrap_or_else(|| {
            let cells = vec![(0, Cell::Made(epoch)), (1, Cell::Made(satellite.clone()))];
            self.sheet.rows.push(Row { line: line.number, cells });
            self.sheet.rows.len() - 1
        });
        let cells = &mut self.sheet.rows[row].cells;
        let values = VALUES.map(|(a, b)| line.all.part(a..b).trimmed());
        // A position that is not known is all zeros.
        let absent = values[..3].iter().all(|v| v.number().is_none_or(|v| v == 0.0));
        for (i, value) in values.into_iter().enumerate().filter(|(_, v)| !v.bytes.is_empty()) {
            let missing = if i < 3 { absent } else { value.number().is_none_or(|v| v >= NO_CLOCK) };
            cells.push((from + i, cell(value, missing)));
        }
        for (i, (a, b)) in PRECISIONS.into_iter().enumerate().filter(|_| from == POSITION) {
            let value = line.all.part(a..b).trimmed();
            if !value.bytes.is_empty() {
                cells.push((PRECISION + i, cell(value, false)));
            }
        }
    }
}

fn cell(value: Piece<'_>, missing: bool) -> Cell {
    if missing { Cell::Missing(value.range()) } else { Cell::At(value.range()) }
}

/// `2021  3  4  0  0  0.00000000` as a stamp.
fn epoch(text: Piece<'_>) -> Option<String> {
    let words = text.words();
    let whole = |at: usize| words.get(at)?.text().parse::<i64>().ok();
    let days = Date { year: whole(0)?, month: whole(1)?, day: whole(2)? }.days()?;
    #[expect(clippy::cast_possible_truncation, reason = "seconds of a minute")]
    let ns = (words.get(5)?.number().filter(|s| (0.0..=60.0).contains(s))? * 1e8).round() as i64 * 10;
    let (hour, minute) = (whole(3)?, whole(4)?);
    let in_day = (0..=24).contains(&hour) && (0..60).contains(&minute);
    in_day.then(|| stamp(days, (hour * 60 + minute) * 60 * SECOND + ns))
}
