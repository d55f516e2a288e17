//! TMY3: typical meteorological years, put together from months of several years (NREL).

use super::{Format, PLAIN, names_in};
use crate::error::Result;
use crate::track::Aside;
use crate::track::calendar::{DAY, Date};
use crate::track::time::part_clock;
use crate::track::view::{Cell, Field, Nothing, Piece, Row, Sheet, SourceLine, Want, lines, stamp};

pub(super) const FORMAT: Format = Format {
    name: "TMY3",
    about: "typical meteorological years of NREL",
    known_by: "the names `Date (MM/DD/YYYY)`, `Time (HH:MM)` in the second line",
    maps: "time from both, all months in the year of the first row; units from the names; sources and uncertainties are not \
           channels; -9900 means missing",
    known: |text| {
        let names = text.lines().nth(1).map(names_in).unwrap_or_default();
        names.starts_with(&["Date (MM/DD/YYYY)", "Time (HH:MM)"])
    },
    sheet: Some(sheet),
    ..PLAIN
};

const NO_VALUE: &str = "-9900";

fn sheet(body: &[u8], _: Want) -> Result<Sheet> {
    let mut sheet = Sheet { timed: true, ..Sheet::default() };
    let mut dates = Vec::new();
    for line in lines(body).skip(1) {
        let cells = line.all.split(b',');
        if sheet.fields.is_empty() {
            sheet.fields = fields(&cells);
            continue;
        }
        let Some(moment) = cells.first().zip(cells.get(1)).and_then(|(d, t)| moment(*d, *t)) else { continue };
        dates.push(moment);
        sheet.rows.push(row(line, &cells));
    }
    let years = || dates.iter().map(|m| m.date.year);
    // Months of one year after the other are what was measured; a typical year goes back and forth.
    let typical = dates.windows(2).any(|w| w[1].date.year < w[0].date.year);
    if let (true, Some(first), Some(low), Some(high)) = (typical, years().next(), years().min(), years().max()) {
        dates.iter_mut().for_each(|m| m.date.year = first);
        sheet
            .said
            .push(format!("a typical year: its months are of the years {low} to {high}, and all taken for {first}"));
    }
    for (row, moment) in sheet.rows.iter_mut().zip(&dates) {
        let time = moment.date.days().map(|days| stamp(days, moment.of_day)).unwrap_or_default();
        row.cells.push((0, Cell::Made(time)));
    }
    Ok(sheet)
}

fn fields(names: &[Piece<'_>]) -> Vec<Field> {
    let mut fields = vec![Field::new("time", "")];
    for name in names.iter().skip(2).map(|n| n.decoded().trim_matches('"').to_owned()) {
        let unit = name.rsplit_once('(').and_then(|(_, unit)| unit.strip_suffix(')')).unwrap_or("").to_owned();
        let beside = name.contains("source") || name.contains("uncert");
        let field = Field::new(name, &unit).nothing(Nothing::text(NO_VALUE));
        fields.push(if beside { field.aside(Aside::Quality) } else { field });
    }
    fields
}

/// A date and the nanoseconds after its midnight; the last hour of a day is 24:00.
struct Moment {
    date: Date,
    of_day: i64,
}

fn moment(date: Piece<'_>, clock: Piece<'_>) -> Option<Moment> {
    let mut parts = date.text().split('/').map(|p| p.parse::<i64>().ok());
    let (month, day, year) = (parts.next()??, parts.next()??, parts.next()??);
    let date = Date { year, month, day };
    date.days()?;
    let of_day = part_clock(clock.bytes).filter(|t| (0..=DAY).contains(t))?;
    Some(Moment { date, of_day })
}

fn row(line: SourceLine<'_>, cells: &[Piece<'_>]) -> Row {
    let cell = |c: &Piece<'_>| {
        let missing = c.bytes.is_empty() || c.number() == Some(-9900.0);
        if missing { Cell::Missing(c.range()) } else { Cell::At(c.range()) }
    };
    Row { line: line.number, cells: cells.iter().enumerate().skip(2).map(|(at, c)| (at - 1, cell(c))).collect() }
}
